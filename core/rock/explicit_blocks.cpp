#include "core/rock/explicit_blocks.h"

#include "core/geometry/convex_decomposition.h"
#include "core/rock/block_overlap.h"
#include "core/rock/problem_text.h"

#include <cmath>
#include <string>
#include <unordered_set>
#include <utility>

namespace hdem
{
namespace
{
/// Explicit blocks may overlap by this share of the smaller one's area: coordinates are typed with a few digits.
constexpr double accepted_overlap = 1e-6;

/// Sine of the turn at a vertex that belongs to a straight side: coordinates are typed with a few digits.
constexpr double straight_turn = 1e-6;

/// Vertices on a straight side go, as maps have them where neighbours meet: a contact bears along one edge of each block, so that a side in two pieces would bear
/// along the longer one only.
void drop_straight_vertices(Polygon& polygon)
{
    for (std::size_t i = polygon.size(); i-- > 0 && polygon.size() > 3;)
        if (std::abs(turn(polygon, i)) <= straight_turn)
            polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
}

RockBlock explicit_block(const BlockDef& def)
{
    CutPolygon whole{def.polygon, {}};
    make_anticlockwise(whole.vertices);
    drop_straight_vertices(whole.vertices);
    whole.edges.assign(whole.vertices.size(), {edge_plain, no_index});
    RockBlock block;
    block.name = def.name;
    block.material = def.material;
    block.fix_x = def.fix_x;
    block.fix_y = def.fix_y;
    block.fix_rotation = def.fix_rotation;
    block.velocity = def.velocity;
    block.angular_velocity = def.angular_velocity;
    for (CutPolygon& part : convex_parts(whole))
    {
        ConvexPart out{std::move(part.vertices), {}};
        for (const EdgeTag& edge : part.edges)
        {
            out.source.push_back(edge.source);
        }
        block.parts.push_back(std::move(out));
    }
    return block;
}
}  // namespace

void add_explicit_blocks(const CaseDef& def, RockMass& rock)
{
    if (def.blocks.empty())
    {
        return;
    }
    const std::size_t generated = rock.blocks.size();
    std::vector<Problem> problems;
    std::unordered_set<std::string> names;
    for (const RockBlock& block : rock.blocks)
    {
        names.insert(block.name);
    }
    for (std::size_t i = 0; i < def.blocks.size(); ++i)
    {
        rock.blocks.push_back(explicit_block(def.blocks[i]));
        RockBlock& block = rock.blocks.back();
        block.name = block.name.empty() ? "block" + std::to_string(i + 1) : block.name;
        if (!names.insert(block.name).second)
        {
            problems.push_back({Problem::Severity::error, "block[" + std::to_string(i) + "].name",
                                "block: name = \"" + block.name + "\" (another block has it). Give each block its own name."});
        }
    }
    for (const BlockOverlap& overlap : find_overlaps(rock.blocks, generated, accepted_overlap))
    {
        problems.push_back({Problem::Severity::error, "block[" + std::to_string(overlap.b - generated) + "].polygon",
                            "block \"" + rock.blocks[overlap.b].name + "\": polygon overlaps block \"" +
                                rock.blocks[overlap.a].name + "\" by " + text(overlap.area) +
                                " m2 (blocks may touch, not overlap). Move one of them."});
    }
    if (!problems.empty())
    {
        throw InputError(std::move(problems));
    }
}
}  // namespace hdem
