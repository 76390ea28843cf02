#include "verification/rest/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hdem::verification::rest
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

class Judge
{
  public:
    Judge(const Scene& scene, const Outcome& outcome) : scene_(scene), outcome_(outcome) {}

    Findings run()
    {
        const bool may_stop = scene_.overlap_stops && outcome_.failure.find("overlap_limit") != std::string::npos;
        add(Judged::finished, outcome_.failure.empty() || may_stop ? 0.0 : infinity, outcome_.failure);
        if (!outcome_.failure.empty())
            return std::move(findings_);
        end();
        fates();
        places();
        energy();
        if (outcome_.converged)
        {
            balance();
            support();
            overlap();
            carried();
        }
        return std::move(findings_);
    }

  private:
    void add(Judged what, double share, std::string text) { findings_.push_back({what, share, std::move(text)}); }
    [[nodiscard]] const std::string& name(std::size_t block) const { return scene_.def.blocks[block].name; }
    [[nodiscard]] std::size_t size() const { return outcome_.bodies.size(); }

    void end()
    {
        if (!scene_.def.stages.back().until_converged)
            return;
        const bool late = scene_.end == End::rests && !outcome_.converged;
        const bool early = scene_.end == End::never && outcome_.converged;
        add(Judged::converged, late || early ? infinity : 0.0,
            fmt::format("{} after {} cycles, {:.3g} s", outcome_.converged ? "called converged" : "not at rest", outcome_.cycles,
                        outcome_.time));
    }

    void fates()
    {
        const double farthest = farthest_way(outcome_);
        if (scene_.someone_moves)
            add(Judged::moves, scene_.least_way / farthest,
                fmt::format("they cannot stand: the farthest moved {:.3g} m (at least {:.3g})", farthest, scene_.least_way));
        for (std::size_t i = 0; i < size(); ++i)
        {
            const double way = rim_way(outcome_, i);
            if (scene_.fate[i] == Fate::stays)
                add(Judged::stays, way / scene_.stay,
                    fmt::format("\"{}\" stands: moved {:.3g} m (at most {:.3g})", name(i), way, scene_.stay));
            if (scene_.fate[i] == Fate::moves)
                add(Judged::moves, scene_.least_way / way,
                    fmt::format("\"{}\" cannot stand: moved {:.3g} m (at least {:.3g})", name(i), way, scene_.least_way));
        }
    }

    void places()
    {
        for (const Place& place : scene_.places)
        {
            if (!outcome_.converged && scene_.def.stages.back().until_converged)
                break;
            const Vec2& at = outcome_.bodies[place.block].centroid;
            add(Judged::place, (at - place.centroid).norm() / place.tolerance,
                fmt::format("\"{}\" lies at ({:.6g}, {:.6g}) m (should: {:.6g}, {:.6g} ± {:.2g})", name(place.block), at.x(),
                            at.y(), place.centroid.x(), place.centroid.y(), place.tolerance));
        }
        for (const MostWay& most : scene_.most_ways)
            add(Judged::place, outcome_.way[most.block].norm() / most.way,
                fmt::format("\"{}\" moved {:.4g} m (at most {:.4g})", name(most.block), outcome_.way[most.block].norm(), most.way));
        for (std::size_t i = 0; scene_.region && i < size(); ++i)
        {
            const Vec2& at = outcome_.bodies[i].centroid;
            const bool inside = scene_.is_fixed(i) || scene_.region->meets({at, at});
            add(Judged::place, inside ? 0.0 : infinity,
                fmt::format("\"{}\" ends {} the scene: ({:.4g}, {:.4g}) m", name(i), inside ? "in" : "outside", at.x(), at.y()));
        }
    }

    void energy()
    {
        const Peak& peak = outcome_.peak;
        add(Judged::speed, peak.share,
            fmt::format("\"{}\" has {:.4g} m/s in cycle {}, energy allows {:.4g}", name(peak.block), peak.speed, peak.cycle,
                        peak.allowed));
        add(Judged::energy, outcome_.rise / bars.energy_rise, fmt::format("energy rises by {:.2g} of the greatest", outcome_.rise));
        const double bar = outcome_.had_impulses ? bars.ledger_impulses : bars.ledger_springs;
        add(Judged::ledger, outcome_.residual / bar,
            fmt::format("the energy ledger leaves {:.2g} of its greatest term unexplained (at most {:.0e})", outcome_.residual,
                        bar));
    }

    void balance()
    {
        double heaviest = 0.0;
        for (const Body& body : outcome_.bodies)
            heaviest = body.fixed ? heaviest : std::max(heaviest, body.mass);
        for (std::size_t i = 0; i < size(); ++i)
        {
            const Body& body = outcome_.bodies[i];
            if (body.fixed)
                continue;
            const double off = (outcome_.net[i].head<2>().norm() + std::abs(outcome_.net[i][2]) / body.radius) /
                               (std::max(body.mass, light_share * heaviest) * g);
            add(Judged::balance, off / bars.balance,
                fmt::format("at rest \"{}\" is out of balance by {:.2g} of its weight", name(i), off));
        }
    }

    /// Static theorem at the places where the blocks lie: a little more friction and cohesion than there is, and all that is nearly touched. Not asked of blocks with
    /// cohesion that have moved far: how much of it a corner has on the face that it stands on is a law of hdem (core/README.md), not of statics.
    void support()
    {
        const double least = least_size(scene_);
        const JointDef& joint = scene_.def.joints.front();
        if (joint.cohesion > 0.0 && farthest_way(outcome_) > 0.1 * least)
            return;
        const Strength strength{1.02 * std::tan(radians(joint.friction_angle_deg)) + 1e-3, 1.05 * joint.cohesion};
        const std::vector<TouchingPoint> points = find_touching(outcome_.bodies, 1e-4 * least + 2e-6, bars.overlap * least);
        const double off = least_unbalance(outcome_.bodies, points, strength, scene_.def.gravity);
        add(Judged::support, off / bars.balance,
            fmt::format("at rest the places where blocks touch cannot carry {:.2g} of a block's weight", off));
    }

    void overlap()
    {
        for (std::size_t i = 0; i < size(); ++i)
            for (std::size_t j = i + 1; j < size(); ++j)
            {
                const Body& a = outcome_.bodies[i];
                const Body& b = outcome_.bodies[j];
                if (a.fixed && b.fixed)
                    continue;
                const double size_a = a.fixed ? infinity : size_of(scene_.def.blocks[i].polygon);
                const double size_b = b.fixed ? infinity : size_of(scene_.def.blocks[j].polygon);
                const double depth = overlap_depth(a, b);
                if (depth > 0.0)
                    add(Judged::overlap, depth / (bars.overlap * std::min(size_a, size_b) + 10.0 * scene_.settle),
                        fmt::format("\"{}\" ends {:.3g} m deep in \"{}\"", name(i), depth, name(j)));
            }
    }

    void carried()
    {
        for (std::size_t k = 0; k < scene_.supports.size(); ++k)
        {
            const Support& s = scene_.supports[k];
            const double force = outcome_.carried[k].y();
            add(Judged::carried, std::abs(force - s.force) / s.tolerance,
                fmt::format("\"{}\" carries {:.6g} N of \"{}\" (should: {:.6g})", name(s.lower), force, name(s.upper), s.force));
        }
    }

    const Scene& scene_;
    const Outcome& outcome_;
    Findings findings_;
};
}  // namespace

const char* name_of(Judged what)
{
    constexpr std::array<const char*, judged_kinds> names{"runs to its end",           "converged only at rest",
                                                          "what stands stays",         "what cannot stand moves",
                                                          "where blocks lie",          "greatest speed",
                                                          "energy never rises",        "energy ledger",
                                                          "unbalanced block at rest",  "support at rest",
                                                          "forces between blocks",     "overlap at rest",
                                                          "same in another placement", "same bits on 1, 2, 3 threads"};
    return names[static_cast<std::size_t>(what)];
}

Findings judge(const Scene& scene, const Outcome& outcome)
{
    return Judge(scene, outcome).run();
}

Findings judge_twins(const Scene& scene, const Outcome& outcome, const Outcome& twin)
{
    Findings findings;
    if (!scene.same_in_twin || !outcome.failure.empty() || !twin.failure.empty())
        return findings;
    for (std::size_t i = 0; i < outcome.way.size(); ++i)
    {
        if (scene.is_fixed(i))
            continue;
        const double off = (outcome.way[i] - twin.way[i]).norm() +
                           std::abs(outcome.rotation[i] - twin.rotation[i]) * outcome.bodies[i].radius;
        const double way = std::max(rim_way(outcome, i), rim_way(twin, i));
        const double bar = bars.same_place + scene.same_settle * scene.settle +
                           (scene.fate[i] == Fate::stays ? 0.0 : bars.same_way * way);
        findings.push_back({Judged::orientation, off / bar,
                            fmt::format("\"{}\" ends {:.3g} m from where it does {} (at most {:.2g})", scene.def.blocks[i].name,
                                        off, scene.twin.name(), bar)});
    }
    return findings;
}
}  // namespace hdem::verification::rest
