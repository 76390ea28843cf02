#include "core/rock/slivers.h"

#include "core/rock/problem_text.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>

namespace hdem
{
namespace
{
using Slot = std::size_t;  // position in mass.blocks

double perimeter(const CutBlock& block)
{
    double around = 0.0;
    for (const CutPolygon& part : block.parts)
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
            if (part.edges[i].source != edge_internal)
                around += (part.vertices[next(i, part.vertices.size())] - part.vertices[i]).norm();
    return around;
}

class SliverMerger
{
  public:
    /// Pieces of outlines.
    SliverMerger(CutMass& mass, double smallest_area, std::int32_t first_joint, RockMass& counts)
        : SliverMerger(mass, counts,
                       {.smallest_area = smallest_area,
                        .first_source = std::numeric_limits<std::int32_t>::min(),
                        .preferred_source = first_joint})
    {
        for (Slot b = 0; b < mass_.blocks.size(); ++b)
        {
            const double area = mass_.blocks[b].outline == no_index ? smallest_area : total_area(mass_.blocks[b].parts);
            if (area < smallest_area)
            {
                queue_.insert({area, b});
            }
        }
    }

    /// Cells between lines.
    SliverMerger(CutMass& mass, RockMass& counts, const SmallCells& cells)
        : mass_(mass),
          counts_(counts),
          cells_(cells),
          owner_(mass.blocks.size())
    {
        std::iota(owner_.begin(), owner_.end(), Slot{0});
    }

    void find_small_cells()
    {
        for (Slot b = 0; b < mass_.blocks.size(); ++b)
        {
            if (is_small(mass_.blocks[b]))
            {
                queue_.insert({total_area(mass_.blocks[b].parts), b});
            }
        }
    }

    void run()
    {
        index_chords();
        while (!queue_.empty())
        {
            const auto [area, sliver] = *queue_.begin();
            queue_.erase(queue_.begin());
            merge(sliver, area);
        }
        std::erase_if(mass_.blocks, [](const CutBlock& block) { return block.parts.empty(); });
    }

    [[nodiscard]] const std::map<std::int32_t, double>& welded() const { return cells_.welded; }

  private:
    /// Who has an edge on a chord of a sliver: only those can become its neighbours.
    void index_chords()
    {
        for (const auto& [area, sliver] : queue_)
        {
            for_each_chord(mass_.blocks[sliver], [this](Index chord) { users_[chord]; });
        }
        for (Slot b = 0; b < mass_.blocks.size(); ++b)
        {
            for_each_chord(mass_.blocks[b],
                           [this, b](Index chord)
                           {
                               const auto users = users_.find(chord);
                               if (users != users_.end())
                               {
                                   users->second.push_back(b);
                               }
                           });
        }
    }

    template <class Visit>
    static void for_each_chord(const CutBlock& block, const Visit& visit)
    {
        for (const CutPolygon& part : block.parts)
        {
            for (const EdgeTag& edge : part.edges)
            {
                if (edge.source != edge_internal)
                {
                    visit(edge.chord);
                }
            }
        }
    }

    Slot owner_of(Slot b) const
    {
        while (owner_[b] != b)
        {
            b = owner_[b];
        }
        return b;
    }

    [[nodiscard]] bool is_small(const CutBlock& block) const
    {
        const double area = total_area(block.parts);
        return area < cells_.smallest_area || area < cells_.narrowest * perimeter(block);
    }

    [[nodiscard]] std::map<std::int32_t, double> lengths_between(const CutBlock& a, const CutBlock& b) const
    {
        std::map<std::int32_t, double> lengths;
        for (const CutPolygon& of_a : a.parts)
        {
            for (const CutPolygon& of_b : b.parts)
            {
                add_shared_lengths(of_a, of_b, mass_.chords, mass_.tolerance, lengths);
            }
        }
        return lengths;
    }

    /// Along edges across which blocks may be joined: first of those that are preferred.
    [[nodiscard]] std::pair<double, double> lengths_across(const CutBlock& a, const CutBlock& b) const
    {
        double preferred = 0.0, sum = 0.0;
        for (const auto& [source, length] : lengths_between(a, b))
        {
            preferred += source >= std::max(cells_.first_source, cells_.preferred_source) ? length : 0.0;
            sum += source >= cells_.first_source ? length : 0.0;
        }
        return {preferred, sum};
    }

    /// The block on the same side with the greatest shared length, or the sliver itself.
    Slot best_neighbour(Slot sliver) const
    {
        std::set<Slot> candidates;
        for_each_chord(mass_.blocks[sliver],
                       [&](Index chord)
                       {
                           for (const Slot b : users_.at(chord))
                           {
                               candidates.insert(owner_of(b));
                           }
                       });
        Slot best = sliver;
        std::pair<double, double> most;
        for (const Slot b : candidates)
        {
            if (b == sliver || mass_.blocks[b].excavation != mass_.blocks[sliver].excavation)
            {
                continue;
            }
            const std::pair<double, double> lengths = lengths_across(mass_.blocks[sliver], mass_.blocks[b]);
            if (lengths > most)
            {
                best = b;
                most = lengths;
            }
        }
        return best;
    }

    void merge(Slot sliver, double area)
    {
        const Slot target = best_neighbour(sliver);
        if (target == sliver)
        {
            if (mass_.blocks[sliver].outline != no_index)
            {
                warn(mass_.blocks[sliver], area,
                     "below generator.smallest_block_area, and no neighbour on its side of the outline to join). Move the outline, "
                     "or expect a small time step.");
            }
            return;
        }
        if (lengths_across(mass_.blocks[sliver], mass_.blocks[target]).first == 0.0)
        {
            warn(mass_.blocks[sliver], area,
                 "below generator.smallest_block_area) and no neighbour but across a fault or the boundary of a region. It is "
                 "joined to that one and has its material. Move the outline.");
        }
        CutBlock& from = mass_.blocks[sliver];
        CutBlock& to = mass_.blocks[target];
        const double target_area = total_area(to.parts);
        for (const auto& [source, length] : lengths_between(from, to))
        {
            cells_.welded[source] += length;
        }
        for (CutPolygon& a : from.parts)
        {
            for (CutPolygon& b : to.parts)
            {
                set_shared_source(a, b, edge_internal, mass_.chords, mass_.tolerance);
            }
        }
        std::move(from.parts.begin(), from.parts.end(), std::back_inserter(to.parts));
        from.parts.clear();
        owner_[sliver] = target;
        ++counts_.merged_slivers;
        const bool stays_small = cells_.narrowest > 0.0 ? is_small(to) : target_area + area < cells_.smallest_area;
        if (queue_.erase({target_area, target}) > 0 && stays_small)
        {
            queue_.insert({total_area(to.parts), target});
        }
    }

    void warn(const CutBlock& block, double area, const char* why)
    {
        const std::string outline = std::to_string(block.outline);
        const Vec2 at = area_moments(block.parts.front().vertices).centroid;
        counts_.warnings.push_back({Problem::Severity::warning, "excavation[" + outline + "]",
                                    "excavation: a piece at " + text(at) + " has area = " + text(area) + " m2 (" + why});
    }

    CutMass& mass_;
    RockMass& counts_;
    SmallCells cells_;
    std::set<std::pair<double, Slot>> queue_;  // area and block: smallest first
    std::vector<Slot> owner_;                  // the block a merged sliver now belongs to
    std::unordered_map<Index, std::vector<Slot>> users_;
};
}  // namespace

void merge_slivers(CutMass& mass, double smallest_area, std::int32_t first_joint, RockMass& counts)
{
    SliverMerger(mass, smallest_area, first_joint, counts).run();
}

void merge_cells(CutMass& mass, SmallCells& cells, RockMass& counts)
{
    SliverMerger merger(mass, counts, cells);
    merger.find_small_cells();
    merger.run();
    cells.welded = merger.welded();
}
}  // namespace hdem
