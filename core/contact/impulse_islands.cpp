#include "core/contact/impulse_islands.h"

#include "core/contact/impact_energy.h"
#include "core/contact/impulse_clusters.h"
#include "core/contact/impulse_kick.h"
#include "core/contact/impulse_law.h"
#include "core/contact/island_solution.h"
#include "core/contact/position_correction.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace hdem
{
namespace
{
/// Share of the velocity by a cycle's forces and impacts that sweeps may leave unsolved, and share of that which a solution may leave [-].
constexpr double left_by_sweeps = 1e-3;
constexpr double solved = 1e-2;
/// The share that sweeps may leave in a stage that seeks rest, of the unbalance that a block at rest may have. With more, the stage could wait for ever
/// for an unbalance that is not solved. (Where one block has most of the weight, of the unbalance that all blocks together may have.)
constexpr double left_at_rest = 0.3;
/// The same in an impact, which no later cycle corrects.
constexpr double left_in_impact = 1e-6;
/// The same for the position correction, of the overlap to be removed and of the allowed one.
constexpr double noticeable_overlap = 1e-2;
/// Share of the greatest velocity that rounding leaves, at a block of a millionth of the mass of those that press it.
constexpr double rounding = 1e-9;
/// Greatest number of points of an island that is solved as a whole.
constexpr std::size_t small_island = 100;
/// Greatest number of points of a cluster that is solved at all: the time grows faster than their number.
constexpr std::size_t small_cluster = 200;
/// A cluster is solved where sweeps have left this many times what they have left around it.
constexpr double worth = 3.0;
/// Sweeps of a larger cluster, as a multiple of those of a cycle.
constexpr int more_sweeps = 10;

double noticeable(const Model& model, ExactIslands which, bool suits_sweeps)
{
    if (which != ExactIslands::small)
        return left_by_sweeps;
    const ConvergenceDef& rest = model.convergence;
    const double together = suits_sweeps ? rest.block_unbalanced_ratio : rest.unbalanced_force_ratio;
    return std::min(left_by_sweeps, left_at_rest * std::min(rest.block_unbalanced_ratio, together));
}

/// Least error of a velocity at the point that counts [m/s].
double velocity_limit(double share, const ImpulsePoint& p, const Blocks& blocks)
{
    const auto speed = [](const BlockMotion& m) { return std::abs(m.vx) + std::abs(m.vy); };
    return share * (p.load_velocity + std::max(0.0, p.approach)) +
           rounding * (speed(blocks.motion[p.ref]) + speed(blocks.motion[p.inc]));
}

double correction_scale(const Model& model, const Steps& step, const ImpulsePoint& p)
{
    return (model.contact.allowed_overlap + std::abs(p.excess_overlap)) / step.next;
}

/// The point as the position correction sees it: it has no friction.
ImpulsePoint as_correction(const Model& model, const Steps& step, ImpulsePoint p)
{
    p.target = -correction_velocity(model, step, p);
    p.friction = p.cohesive_impulse = 0.0;
    p.impulse_normal = p.correction;
    p.impulse_shear = 0.0;
    return p;
}

double impulse_error(const ImpulsePoint& p, const Blocks& blocks)
{
    return law_error(p, relative_velocity(p, blocks.motion[p.ref], blocks.motion[p.inc]));
}

double correction_error(const Model& model, const ImpulsePoint& p, const Blocks& blocks, const std::vector<Triple>& pseudo)
{
    const Triple& ref = pseudo[p.ref];
    const Triple& inc = pseudo[p.inc];
    return law_error(as_correction(model, blocks.step, p), relative_velocity(p, inc.x - ref.x, inc.y - ref.y, ref, inc));
}

bool leave_more_than(double share, const Model& model, const std::vector<ImpulsePoint>& points, const Blocks& blocks,
                     const std::vector<Triple>& pseudo)
{
    double limit = 0.0, pseudo_scale = 0.0, error = 0.0, pseudo_error = 0.0;
    for (const ImpulsePoint& p : points)
    {
        limit = std::max(limit, velocity_limit(share, p, blocks));
        error = std::max(error, impulse_error(p, blocks));
        pseudo_scale = std::max(pseudo_scale, correction_scale(model, blocks.step, p));
        pseudo_error = std::max(pseudo_error, correction_error(model, p, blocks, pseudo));
    }
    return error > limit || pseudo_error > noticeable_overlap * pseudo_scale;
}
}  // namespace

MassRange mass_range(const std::vector<ImpulsePoint>& points, const Blocks& blocks)
{
    MassRange range;
    Index last = no_index;
    for (const ImpulsePoint& p : points)
    {
        if (std::exchange(last, p.contact) == p.contact)
            continue;
        range.add(blocks.inertia[p.ref]);
        range.add(blocks.inertia[p.inc]);
    }
    return range;
}

bool are_unsolved(const Model& model, ExactIslands which, const MassRange& masses, const std::vector<ImpulsePoint>& points,
                  const Blocks& blocks, const std::vector<Triple>& pseudo)
{
    const double share = which == ExactIslands::hit ? left_in_impact
                                                    : noticeable(model, which, masses.suits_sweeps(model.contact.impulse_sweeps));
    return leave_more_than(share, model, points, blocks, pseudo);
}

namespace
{
class IslandCopy
{
  public:
    template <typename Velocity, typename PointOf>
    IslandCopy(const std::vector<ImpulsePoint*>& points, const Blocks& blocks, const Velocity& velocity, const PointOf& point_of)
    {
        std::unordered_map<Index, Index> place;
        const auto copy = [&](Index block)
        {
            const auto [at, is_new] = place.try_emplace(block, static_cast<Index>(problem.blocks.size()));
            if (is_new)
            {
                problem.blocks.push_back({blocks.inertia[block], velocity(block)});
                block_of.push_back(block);
            }
            return at->second;
        };
        for (const ImpulsePoint* p : points)
        {
            problem.points.push_back(point_of(*p));
            problem.points.back().ref = copy(p->ref);
            problem.points.back().inc = copy(p->inc);
        }
    }
    IslandProblem problem;
    std::vector<Index> block_of;
};

/// Points that are solved all at once.
struct Cluster
{
    std::vector<ImpulsePoint*> points;
    double outside = 0.0, outside_correction = 0.0;  ///< greatest errors of the points around them [m/s]
};

std::vector<Cluster> cut(const Model& model, const Island& island, const Blocks& blocks, const std::vector<Triple>& pseudo)
{
    std::vector<Cluster> clusters;
    const std::vector<Index> cluster_of = clusters_of(island, blocks, MassRange::greatest_ratio(model.contact.impulse_sweeps));
    const auto for_ends = [&](bool inside, const auto& visit)
    {
        for (std::size_t i = 0; i < cluster_of.size(); ++i)
            for (const Index block : island.ends[i])
                if (block != no_index && (cluster_of[i] != no_index) == inside)
                    visit(i, block);
    };
    std::vector<char> takes_part(island.blocks.size(), 0);
    for_ends(true, [&](std::size_t, Index block) { takes_part[block] = 1; });
    std::vector<std::array<double, 2>> around(island.blocks.size());
    for_ends(false,
             [&](std::size_t i, Index block)
             {
                 if (takes_part[block] == 0)
                     return;
                 around[block][0] = std::max(around[block][0], impulse_error(*island.points[i], blocks));
                 around[block][1] = std::max(around[block][1], correction_error(model, *island.points[i], blocks, pseudo));
             });
    for (std::size_t i = 0; i < cluster_of.size(); ++i)
    {
        if (cluster_of[i] == no_index)
            continue;
        clusters.resize(std::max(clusters.size(), static_cast<std::size_t>(cluster_of[i]) + 1));
        Cluster& cluster = clusters[cluster_of[i]];
        cluster.points.push_back(island.points[i]);
        for (const Index block : island.ends[i])
            if (block != no_index)
            {
                cluster.outside = std::max(cluster.outside, around[block][0]);
                cluster.outside_correction = std::max(cluster.outside_correction, around[block][1]);
            }
    }
    return clusters;
}

/// More sweeps over a cluster, until they have left as little as needs no solution.
/// @param share  of the velocity that forces and impacts give: as little may be left
/// @return as of sweep_impulses [J]
double sweep_more(const Model& model, double share, Blocks& blocks, std::vector<Triple>& pseudo, const Cluster& cluster)
{
    double loss = 0.0;
    std::vector<ImpulsePoint> points;
    for (const ImpulsePoint* p : cluster.points)
        points.push_back(*p);
    for (int round = 0; round < more_sweeps && leave_more_than(share, model, points, blocks, pseudo); ++round)
        for (int sweep = 0; sweep < model.contact.impulse_sweeps; ++sweep)
        {
            loss += sweep_impulses(points, blocks);
            sweep_correction(model, blocks, points, pseudo);
        }
    for (std::size_t i = 0; i < points.size(); ++i)
        *cluster.points[i] = points[i];
    return loss;
}

/// @return as of sweep_impulses [J]
double solve_velocities(double share, Blocks& blocks, const Cluster& cluster)
{
    double limit = 0.0, error = 0.0;
    for (const ImpulsePoint* p : cluster.points)
    {
        limit = std::max(limit, velocity_limit(share, *p, blocks));
        error = std::max(error, impulse_error(*p, blocks));
    }
    if (error <= std::max(limit, worth * cluster.outside))
        return 0.0;
    const auto velocity = [&](Index b) { return Triple{blocks.motion[b].vx, blocks.motion[b].vy, blocks.motion[b].w}; };
    const IslandCopy copy(cluster.points, blocks, velocity, [](const ImpulsePoint& p) { return p; });
    const IslandProblem found = solve_all_at_once(copy.problem, std::max(solved * limit, 0.01 * cluster.outside));
    double loss = 0.0;
    for (std::size_t i = 0; i < cluster.points.size(); ++i)
    {
        ImpulsePoint& p = *cluster.points[i];
        const ImpulsePoint& q = found.points[i];
        loss += push(p, q.impulse_shear - p.impulse_shear, p.impulse_normal - q.impulse_normal, blocks);
        p.impulse_normal = q.impulse_normal;
        p.impulse_shear = q.impulse_shear;
    }
    return loss;
}

void solve_correction(const Model& model, const Blocks& blocks, std::vector<Triple>& pseudo, const Cluster& cluster)
{
    double scale = 0.0, error = 0.0;
    for (const ImpulsePoint* p : cluster.points)
    {
        scale = std::max(scale, correction_scale(model, blocks.step, *p));
        error = std::max(error, correction_error(model, *p, blocks, pseudo));
    }
    if (error <= std::max(noticeable_overlap * scale, worth * cluster.outside_correction))
        return;
    const IslandCopy copy(
        cluster.points, blocks, [&](Index b) { return pseudo[b]; },
        [&](const ImpulsePoint& p) { return as_correction(model, blocks.step, p); });
    const double goal = 0.01 * std::max(noticeable_overlap * scale, cluster.outside_correction);
    const IslandProblem found = solve_all_at_once(copy.problem, goal);
    for (std::size_t i = 0; i < copy.block_of.size(); ++i)
        if (can_move(blocks.inertia[copy.block_of[i]]))
            pseudo[copy.block_of[i]] = found.blocks[i].velocity;
    for (std::size_t i = 0; i < cluster.points.size(); ++i)
        cluster.points[i]->correction = found.points[i].impulse_normal;
}

/// All points at once if they are few, else cluster by cluster.
void solve_clusters(const Model& model, double share, bool suits_sweeps, Blocks& blocks, std::vector<Triple>& pseudo,
                    Island& island)
{
    const bool whole = island.points.size() <= small_island;
    for (const Cluster& cluster : whole ? std::vector<Cluster>{{.points = island.points}} : cut(model, island, blocks, pseudo))
    {
        if (cluster.points.size() > small_cluster)
        {
            if (!suits_sweeps)
                island.loss += sweep_more(model, share, blocks, pseudo, cluster);
            continue;
        }
        island.loss += solve_velocities(share, blocks, cluster);
        solve_correction(model, blocks, pseudo, cluster);
    }
}
}  // namespace

void solve_island(const Model& model, ExactIslands which, Blocks& blocks, std::vector<Triple>& pseudo, Island& island)
{
    MassRange masses;
    for (const Index block : island.blocks)
        masses.add(blocks.inertia[block]);
    const bool suits_sweeps = masses.suits_sweeps(model.contact.impulse_sweeps);
    const bool is_small = island.points.size() <= small_cluster;
    const bool is_hit = is_small && which != ExactIslands::great_mass_ratios &&
                        std::any_of(island.points.begin(), island.points.end(),
                                    [](const ImpulsePoint* p) { return is_impact(*p); });
    if (which == ExactIslands::hit && is_hit)
        island.loss += sweep_more(model, left_in_impact, blocks, pseudo, {.points = island.points});
    if (!suits_sweeps || which == ExactIslands::small)
        solve_clusters(model, noticeable(model, which, suits_sweeps), suits_sweeps, blocks, pseudo, island);
    if (is_hit)
        island.loss += restrain_impacts(island.points, blocks,
                                        [&] { return solve_velocities(left_in_impact, blocks, {.points = island.points}); });
}
}  // namespace hdem
