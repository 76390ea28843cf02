#include "core/rock/rock_warnings.h"

#include "core/geometry/convex_decomposition.h"
#include "core/rock/problem_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
/// Of the cuts of a set that may be refused without a word [-]
constexpr double most_refused = 0.5;

/// Stage that removes an excavation; the number of stages if none does.
std::size_t stage_of(const CaseDef& def, const ExcavationDef& excavation)
{
    const auto removes = [&](const StageDef& stage) { return std::ranges::count(stage.excavate, excavation.name) > 0; };
    return static_cast<std::size_t>(std::ranges::find_if(def.stages, removes) - def.stages.begin());
}
}  // namespace

void warn_of_no_joints(const JointSetDef& set, std::size_t number, std::int64_t joints, RockMass& rock)
{
    if (joints == 0)
    {
        rock.warnings.push_back({Problem::Severity::warning, "joint_set[" + std::to_string(number) + "]",
                                 "joint set \"" + set.name + "\": no joint crosses the domain. Check its spacing and origin."});
    }
}

void warn_of_refused_cuts(const JointSetDef& set, std::size_t number, std::int64_t refused, std::int64_t cuts, RockMass& rock)
{
    if (static_cast<double>(refused) <= most_refused * static_cast<double>(refused + cuts))
        return;
    rock.warnings.push_back({Problem::Severity::warning, "joint_set[" + std::to_string(number) + "]",
                             "joint set \"" + set.name + "\": " + std::to_string(refused) + " of " +
                                 std::to_string(refused + cuts) +
                                 " cuts of blocks were refused (a piece or an edge would be too small; the rock stays whole "
                                 "there, and is stronger than with the joint). Reduce generator.smallest_block_area and "
                                 "smallest_edge, or give a greater spacing."});
}

void warn_of_large_cells(const CaseDef& def, const Polygon& domain, RockMass& rock)
{
    const Box box = bounding_box(domain);
    if (def.voronoi.given && def.voronoi.edge > (box.high - box.low).maxCoeff())
        rock.warnings.push_back(
            {Problem::Severity::warning, "voronoi.edge",
             "[voronoi]: edge = " + text(def.voronoi.edge) + " m (a cell is larger than the whole domain). Give a shorter edge."});
}

void warn_of_overlaps(const CaseDef& def, const std::vector<Polygon>& outlines, RockMass& rock)
{
    for (std::size_t later = 1; later < outlines.size(); ++later)
        for (std::size_t first = 0; first < later; ++first)
            if (stage_of(def, def.excavations[later]) < stage_of(def, def.excavations[first]))
                if (const double common = overlap_area(outlines[first], outlines[later]);
                    common > 1e-6 * std::abs(signed_area(outlines[later])))
                    rock.warnings.push_back(
                        {Problem::Severity::warning, "excavation[" + std::to_string(later) + "]",
                         "excavation \"" + def.excavations[later].name + "\": " + text(common) + " m2 of it lie in \"" +
                             def.excavations[first].name +
                             "\" (which comes first in the file, and is removed later: this rock stays until then). Write the "
                             "one that is removed first before the other."});
}

void check_area(const RockMass& rock)
{
    double sum = 0.0;
    for (const RockBlock& block : rock.blocks)
        for (const ConvexPart& part : block.parts)
            sum += std::abs(signed_area(part.vertices));  // parts in the wrong sense lie over others
    if (!(std::abs(sum - rock.domain_area) <= 1e-6 * rock.domain_area))
        throw InputError(Problem{
            .key = "domain",
            .text = "rock mass: its blocks have an area of " + text(sum) + " m2, and the domain one of " + text(rock.domain_area) +
                    " m2 (joints, faults or outlines that meet almost in one point could not be cut). Move one of "
                    "them by a millimetre."});
}

void warn_of_small_blocks(const CaseDef& def, RockMass& rock)
{
    const RockBlock* smallest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const RockBlock& block : rock.blocks)
    {
        const double a = area(block);
        smallest = a < least ? &block : smallest;
        least = std::min(least, a);
    }
    const double mean = rock.domain_area / static_cast<double>(rock.blocks.size());
    if (def.generator.smallest_block_area <= 0.0 && least < 1e-3 * mean)
    {
        rock.warnings.push_back({Problem::Severity::warning, "generator.smallest_block_area",
                                 "block \"" + smallest->name + "\": area = " + text(least) + " m2 (the mean is " + text(mean) +
                                     " m2, and the smallest block decides the time step). Set generator.smallest_block_area."});
    }
}
}  // namespace hdem
