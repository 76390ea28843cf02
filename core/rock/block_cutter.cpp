#include "core/rock/block_cutter.h"

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace hdem
{
namespace
{
using Parts = std::vector<CutPolygon>;

/// What a joint would do to a block.
struct BlockCut
{
    Parts left;
    Parts right;
    std::vector<ConvexCut> cuts;  // pieces of the parts the joint crosses; not yet in left and right
};

struct Cutter
{
    CutMass& mass;
    const JointTraces& joints;
    const JointSetDef& set;
    const GeneratorDef& generator;
    RockMass& counts;
    boost::random::mt19937_64 engine;
    CutLengths lengths = {};
    boost::random::uniform_real_distribution<double> chance{0.0, 1.0};
};

bool in_path(const Parts& parts, const CutLine& line, double tolerance)
{
    bool left = false;
    bool right = false;
    for (const CutPolygon& part : parts)
    {
        const Side side = side_of(part.vertices, line, tolerance);
        left = left || side != Side::right;
        right = right || side != Side::left;
    }
    return left && right;
}

BlockCut plan(const Cutter& cutter, const Parts& parts, const CutLine& line)
{
    BlockCut out;
    for (const CutPolygon& part : parts)
    {
        const Side side = side_of(part.vertices, line, cutter.mass.tolerance);
        if (side == Side::crossed)
        {
            out.cuts.push_back(plan_cut(part, line, cutter.joints.source, cutter.mass.chords, cutter.mass.tolerance));
        }
        else
        {
            (side == Side::left ? out.left : out.right).push_back(part);
        }
    }
    return out;
}

/// Of the joint within the block [m].
double length_of(const BlockCut& cut)
{
    double length = 0.0;
    for (const ConvexCut& part : cut.cuts)
    {
        length += (part.to - part.from).norm();
    }
    return length;
}

/// New edges are the chord and what is left of the edges the joint crossed: those that end in a new point.
bool leaves_short_edge(const ConvexCut& cut, double smallest)
{
    if (smallest <= 0.0)
    {
        return false;
    }
    for (const CutPolygon* piece : {&cut.left, &cut.right})
    {
        const std::size_t n = piece->vertices.size();
        for (std::size_t i = 0; i < n; ++i)
        {
            const Vec2& a = piece->vertices[i];
            const Vec2& b = piece->vertices[next(i, n)];
            const bool is_new = a == cut.from || a == cut.to || b == cut.from || b == cut.to;
            if (is_new && piece->edges[i].source != edge_internal && (b - a).norm() < smallest)
            {
                return true;
            }
        }
    }
    return false;
}

/// Around a piece, along x and y: no less than the length of its edges [m].
double way_around(const CutPolygon& piece)
{
    double way = 0.0;
    for (std::size_t i = 0; i < piece.vertices.size(); ++i)
    {
        way += (piece.vertices[next(i, piece.vertices.size())] - piece.vertices[i]).lpNorm<1>();
    }
    return way;
}

/// Smaller than the user wants, or narrower than the distance below which a line goes through a vertex: as where a joint runs almost along an edge. Nothing
/// would be left of such a piece.
bool is_too_small(double area, double around, const Cutter& cutter)
{
    return area < cutter.generator.smallest_block_area || area < cutter.mass.tolerance * around;
}

bool leaves_small_piece(const Parts& side, const Cutter& cutter)
{
    const std::vector<std::size_t> group = connected_groups(side, cutter.mass.chords, cutter.mass.tolerance);
    std::vector<double> area(side.size(), 0.0), around(side.size(), 0.0);
    for (std::size_t p = 0; p < side.size(); ++p)
    {
        area[group[p]] += signed_area(side[p].vertices);
        around[group[p]] += way_around(side[p]);
    }
    const std::size_t groups = *std::max_element(group.begin(), group.end()) + 1;
    for (std::size_t g = 0; g < groups; ++g)
    {
        if (is_too_small(area[g], around[g], cutter))
        {
            return true;
        }
    }
    return false;
}

bool is_refused(const BlockCut& cut, const Cutter& cutter)
{
    for (const ConvexCut& part : cut.cuts)
    {
        if (leaves_short_edge(part, cutter.generator.smallest_edge))
        {
            return true;
        }
    }
    if (cut.cuts.size() == 1 && cut.left.empty() && cut.right.empty())
    {
        const auto is_small = [&](const CutPolygon& piece)
        { return is_too_small(signed_area(piece.vertices), way_around(piece), cutter); };
        return is_small(cut.cuts[0].left) || is_small(cut.cuts[0].right);
    }
    Parts left = cut.left;
    Parts right = cut.right;
    for (const ConvexCut& part : cut.cuts)
    {
        left.push_back(part.left);
        right.push_back(part.right);
    }
    return leaves_small_piece(left, cutter) || leaves_small_piece(right, cutter);
}

void add_connected(Parts&& side, const Cutter& cutter, std::vector<Parts>& pieces)
{
    if (side.size() == 1)
    {
        pieces.push_back(std::move(side));
        return;
    }
    const std::vector<std::size_t> group = connected_groups(side, cutter.mass.chords, cutter.mass.tolerance);
    const std::size_t before = pieces.size();
    for (std::size_t p = 0; p < side.size(); ++p)
    {
        pieces.resize(std::max(pieces.size(), before + group[p] + 1));
        pieces[before + group[p]].push_back(std::move(side[p]));
    }
}

/// The pieces, first those on the left of the joint.
std::vector<Parts> make(BlockCut& cut, Cutter& cutter)
{
    // Parts that the joint goes between were one block until now: their common edge becomes a joint.
    for (CutPolygon& a : cut.left)
    {
        for (CutPolygon& b : cut.right)
        {
            set_shared_source(a, b, cutter.joints.source, cutter.mass.chords, cutter.mass.tolerance);
        }
    }
    for (ConvexCut& part : cut.cuts)
    {
        commit(part, cutter.mass.chords);
        cut.left.push_back(std::move(part.left));
        cut.right.push_back(std::move(part.right));
    }
    std::vector<Parts> pieces;
    add_connected(std::move(cut.left), cutter, pieces);
    add_connected(std::move(cut.right), cutter, pieces);
    return pieces;
}

/// The pieces a joint leaves, or nothing when the block stays whole.
std::optional<std::vector<Parts>> try_joint(Cutter& cutter, const Parts& parts, const CutLine& line)
{
    if (!in_path(parts, line, cutter.mass.tolerance))
    {
        return std::nullopt;
    }
    if (cutter.set.persistence < 1.0 && cutter.chance(cutter.engine) >= cutter.set.persistence)
    {
        ++cutter.counts.skipped_cuts;
        cutter.lengths.skipped += length_of(plan(cutter, parts, line));
        return std::nullopt;
    }
    BlockCut cut = plan(cutter, parts, line);
    if (is_refused(cut, cutter))
    {
        ++cutter.counts.refused_cuts;
        cutter.lengths.refused += length_of(cut);
        return std::nullopt;
    }
    ++cutter.counts.cuts;
    cutter.lengths.cut += length_of(cut);
    return make(cut, cutter);
}

/// A piece that has met all joints before `joint`.
struct Task
{
    Parts parts;
    Index joint = 0;
};

void cut_one_block(Cutter& cutter, Parts&& block, std::vector<CutBlock>& out)
{
    std::vector<Task> tasks;
    tasks.push_back({std::move(block), 0});
    while (!tasks.empty())
    {
        Task task = std::move(tasks.back());
        tasks.pop_back();
        // The hull of all parts is what the joints must reach; parts are few, so the widest range of them is taken.
        IndexRange range = cutter.joints.near(task.parts.front().vertices);
        for (const CutPolygon& part : task.parts)
        {
            const IndexRange of_part = cutter.joints.near(part.vertices);
            range = {std::min(range.begin, of_part.begin), std::max(range.end, of_part.end)};
        }
        std::optional<std::vector<Parts>> pieces;
        Index joint = std::max(task.joint, range.begin);
        for (; joint < range.end && !pieces; ++joint)
        {
            pieces = try_joint(cutter, task.parts, cutter.joints.lines[static_cast<std::size_t>(joint)]);
        }
        if (!pieces)
        {
            out.push_back({std::move(task.parts), no_index, no_index});
            continue;
        }
        for (auto piece = pieces->rbegin(); piece != pieces->rend(); ++piece)
        {
            tasks.push_back({std::move(*piece), joint});
        }
    }
}
}  // namespace

CutMass uncut_mass(const Polygon& domain, double tolerance)
{
    CutMass mass;
    mass.tolerance = tolerance;
    CutPolygon whole;
    for (std::size_t i = 0; i < domain.size(); ++i)
    {
        whole.add(domain[i], {edge_plain, mass.chords.add(domain[i], domain[next(i, domain.size())])});
    }
    mass.domain = convex_parts(whole);
    give_chords(mass.domain, mass.chords);
    mass.blocks.push_back({mass.domain, no_index, no_index});
    return mass;
}

CutLengths cut_blocks(CutMass& mass, const JointTraces& joints, const JointSetDef& set, const GeneratorDef& generator,
                      RockMass& counts, const std::function<bool(const CutBlock&)>& is_meant)
{
    Cutter cutter = {mass,      joints, set,
                     generator, counts, boost::random::mt19937_64(stream_seed(generator, set, joints.set, RandomUse::persistence))};
    std::vector<CutBlock> out;
    out.reserve(2 * mass.blocks.size());
    for (CutBlock& block : mass.blocks)
    {
        if (is_meant && !is_meant(block))
        {
            out.push_back(std::move(block));
            continue;
        }
        cut_one_block(cutter, std::move(block.parts), out);
    }
    mass.blocks = std::move(out);
    return cutter.lengths;
}
}  // namespace hdem
