#include "core/rock/short_edges.h"

#include "core/rock/block_outline.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace hdem
{
namespace
{
using Slot = std::size_t;  // position in mass.blocks

class ShortEdges
{
  public:
    ShortEdges(CutMass& mass, double smallest, SmallCells& cells, RockMass& counts)
        : mass_(mass),
          smallest_(smallest),
          cells_(cells),
          counts_(counts),
          owner_(mass.blocks.size())
    {
        std::iota(owner_.begin(), owner_.end(), Slot{0});
        for (Slot b = 0; b < mass_.blocks.size(); ++b)
            for (const CutPolygon& part : mass_.blocks[b].parts)
                for (const EdgeTag& edge : part.edges)
                    if (edge.chord != no_index && edge.source >= cells_.first_source)
                        users_[edge.chord].push_back(b);
    }

    std::int64_t run()
    {
        std::int64_t left = 0;
        for (Slot b = 0; b < mass_.blocks.size(); ++b)
            while (!mass_.blocks[b].parts.empty())
            {
                std::int64_t kept = 0;
                const std::optional<Slot> neighbour = best_neighbour(b, kept);
                if (!neighbour)
                {
                    left += kept;
                    break;
                }
                join(b, *neighbour);
            }
        std::erase_if(mass_.blocks, [](const CutBlock& block) { return block.parts.empty(); });
        return left;
    }

  private:
    Slot owner_of(Slot b) const
    {
        while (owner_[b] != b)
            b = owner_[b];
        return b;
    }

    /// Across which a short edge of the block goes straight on. @param kept  gets the number of short edges
    std::optional<Slot> best_neighbour(Slot b, std::int64_t& kept) const
    {
        std::optional<Slot> best;
        double least = std::numeric_limits<double>::infinity();
        for (const std::vector<OutlineEdge>& ring : outline_of(mass_.blocks[b].parts, mass_.tolerance))
            for (std::size_t i = 0; i < ring.size(); ++i)
            {
                if (ring.size() < 3 || ring[i].length() >= smallest_)
                    continue;
                ++kept;
                for (const bool is_behind : {false, true})
                {
                    const OutlineEdge& side = ring[is_behind ? next(i, ring.size()) : previous(i, ring.size())];
                    const std::optional<Slot> other = neighbour(b, side, ring[i], is_behind);
                    if (other && side.length() < least)
                    {
                        least = side.length();
                        best = other;
                    }
                }
            }
        return best;
    }

    /// The block beyond `side` whose own edge continues the short one.
    std::optional<Slot> neighbour(Slot b, const OutlineEdge& side, const OutlineEdge& small, bool is_behind) const
    {
        const auto users = users_.find(side.tag.chord);
        if (side.tag.source < cells_.first_source || small.tag.chord == no_index || users == users_.end())
            return std::nullopt;
        const Vec2& corner = is_behind ? small.to : small.from;
        for (const Slot user : users->second)
        {
            const Slot other = owner_of(user);
            if (other == b || mass_.blocks[other].parts.empty() || mass_.blocks[other].excavation != mass_.blocks[b].excavation)
                continue;
            for (const CutPolygon& part : mass_.blocks[other].parts)
                for (std::size_t i = 0; i < part.edges.size(); ++i)
                {
                    const Vec2& end = is_behind ? part.vertices[i] : part.vertices[next(i, part.vertices.size())];
                    if (part.edges[i] == small.tag && (end - corner).norm() <= mass_.tolerance && touches(other, side))
                        return other;
                }
        }
        return std::nullopt;
    }

    /// Does the block share some of an edge?
    [[nodiscard]] bool touches(Slot other, const OutlineEdge& side) const
    {
        const double a = mass_.chords.position(side.tag.chord, side.from), b = mass_.chords.position(side.tag.chord, side.to);
        for (const CutPolygon& part : mass_.blocks[other].parts)
            for (std::size_t i = 0; i < part.edges.size(); ++i)
                if (part.edges[i] == side.tag)
                {
                    const double c = mass_.chords.position(side.tag.chord, part.vertices[i]);
                    const double d = mass_.chords.position(side.tag.chord, part.vertices[next(i, part.vertices.size())]);
                    if (std::min(std::max(a, b), std::max(c, d)) - std::max(std::min(a, b), std::min(c, d)) > mass_.tolerance)
                        return true;
                }
        return false;
    }

    void join(Slot b, Slot other)
    {
        CutBlock& to = mass_.blocks[b];
        CutBlock& from = mass_.blocks[other];
        for (CutPolygon& mine : to.parts)
            for (CutPolygon& theirs : from.parts)
            {
                add_shared_lengths(mine, theirs, mass_.chords, mass_.tolerance, cells_.welded);
                set_shared_source(mine, theirs, edge_internal, mass_.chords, mass_.tolerance);
            }
        std::move(from.parts.begin(), from.parts.end(), std::back_inserter(to.parts));
        from.parts.clear();
        owner_[other] = b;
        ++counts_.merged_slivers;
    }

    CutMass& mass_;
    double smallest_;
    SmallCells& cells_;
    RockMass& counts_;
    std::vector<Slot> owner_;
    std::unordered_map<Index, std::vector<Slot>> users_;
};
}  // namespace

std::int64_t join_at_short_edges(CutMass& mass, double smallest, SmallCells& cells, RockMass& counts)
{
    return ShortEdges(mass, smallest, cells, counts).run();
}
}  // namespace hdem
