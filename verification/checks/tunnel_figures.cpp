#include "verification/checks/tunnel_figures.h"

#include "core/contact/contact_report.h"
#include "core/motion/equilibrium.h"
#include "core/rock/excavation.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace hdem::verification
{
namespace
{
/// Convex parts of a block where it is now, in the user's coordinates.
std::vector<Polygon> parts_of(const Model& model, const BlockMotion& motion, Index block)
{
    std::vector<Polygon> parts;
    const Shapes& shapes = model.shapes;
    for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
    {
        Polygon& polygon = parts.emplace_back();
        for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
        {
            const Vec2& at = shapes.vertex[v];
            polygon.emplace_back(model.origin + Vec2(motion.x + motion.c * at.x() - motion.s * at.y(),
                                                     motion.y + motion.s * at.x() + motion.c * at.y()));
        }
    }
    return parts;
}

BlockMap map_of(const TunnelRun& tunnel)
{
    const Model& model = tunnel.run.model();
    const Blocks& blocks = tunnel.run.state().blocks;
    const std::vector<MeanStress> stress = mean_stresses(model, tunnel.run.state());
    BlockMap map{.title = tunnel.name,
                 .parts = {},
                 .detached = {},
                 .fields = {{"total displacement [mm]", false, {}},
                            {"displacement in y [mm]", true, {}},
                            {"displacement in x [mm]", true, {}},
                            {"mean stress in the block [kPa]", false, {}}}};
    for (const Index i : model.slot_of_user)
    {
        if (blocks.present[i] == 0)
            continue;
        const Vec2 moved = blocks.displacement(i);
        map.parts.push_back(parts_of(model, blocks.motion[i], i));
        map.detached.push_back(moved.norm() > model.convergence.detached_distance ? 1 : 0);
        const std::array<double, 4> values{1e3 * moved.norm(), 1e3 * moved.y(), 1e3 * moved.x(), 1e-3 * stress[i].magnitude()};
        for (std::size_t f = 0; f < values.size(); ++f)
            map.fields[f].values.push_back(values[f]);
    }
    return map;
}

Series profile_series(const TunnelRun& tunnel, double angle_deg)
{
    const Ray ray = profile_ray(tunnel.run, angle_deg);
    Series series{.name = tunnel.method, .dots = true};
    for (const StressPoint& point : stress_along(ray, tunnel.run.model(), tunnel.run.state()))
    {
        series.x.push_back(point.distance - ray.begins_at);
        series.y.push_back(1e-3 * point.traction);
    }
    return series;
}
}  // namespace

TunnelRun::TunnelRun(const std::string& run_name, const std::string& run_method, double restitution)
    : name(run_name),
      method(run_method),
      run("paper_tunnel/tunnel.toml", {set("contact.method", run_method), set("contact.restitution", restitution)}),
      kinetic{.name = run_name}
{
    const auto watch = [this](const Model& model, const State& state)
    {
        Equilibrium now;
        add_equilibrium({0, model.blocks()}, model, state, ConvergenceBlocks::all, now);
        limit = now.kinetic_energy_at(model.convergence.mean_speed);
        if (now.kinetic_energy > 0.0)  // a logarithm knows no zero
        {
            kinetic.x.push_back(static_cast<double>(state.cycle));
            kinetic.y.push_back(now.kinetic_energy);
        }
    };
    run.run(watch, kinetic_every);
}

Ray profile_ray(const CaseRun& run, double angle_deg)
{
    const ExcavationDef& opening = run.definition().excavations.at(0);
    const Vec2 centre = opening.position + Vec2(0.0, 0.5 * opening.height);
    const double boundary = distance_to_outline(centre, angle_deg, outline_polygon(opening));
    return {.from = centre - run.model().origin, .angle_deg = angle_deg, .begins_at = boundary, .reaches_to = boundary + 10.0};
}

double mean_traction(const CaseRun& run, double angle_deg, double from, double to)
{
    double sum = 0.0;
    int count = 0;
    for (const StressPoint& point : stress_along(profile_ray(run, angle_deg), run.model(), run.state()))
        if (point.distance >= from && point.distance <= to)
        {
            sum += point.traction;
            ++count;
        }
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

Figure displacement_figure(const TunnelRun& force, const TunnelRun& hybrid)
{
    return {.id = "fig11",
            .title = "Displacements and stresses around the tunnel",
            .source = "Fig. 11",
            .note = "Displacements since the excavation; y points up, x to the right. Grey: detached blocks, where they lie at the "
                    "end. The paper lets six "
                    "blocks of its "
                    "own joints fall. Mean stress: Frobenius norm of the mean stress tensor of the contact forces on the block.",
            .columns = 2,
            .panels = {},
            .maps = {map_of(force), map_of(hybrid)}};
}

Figure stress_figure(const TunnelRun& force, const TunnelRun& hybrid)
{
    Figure figure{
        .id = "fig12",
        .title = "Contact stresses along radial profiles",
        .source = "Fig. 12",
        .note = "Size of the traction vector, √(F_N² + F_S²) / L, of every contact that the ray from the tunnel's centre crosses. "
                "The "
                "paper shows six profiles, 8 to 10 m long, without printing their angles; 90° is straight up, 270° straight down.",
        .columns = 3};
    for (const double angle : profile_angles_deg)
        figure.panels.push_back({.title = fmt::format("{:g}°", angle),
                                 .x_label = "distance from the boundary [m]",
                                 .y_label = "contact stress [kPa]",
                                 .series = {profile_series(force, angle), profile_series(hybrid, angle)},
                                 .marks = {}});
    return figure;
}

Figure kinetic_figure(const TunnelRun& force, const TunnelRun& hybrid, const TunnelRun& matched)
{
    const double end = std::max({force.kinetic.x.back(), hybrid.kinetic.x.back(), matched.kinetic.x.back()});
    Panel panel{
        .title = "",
        .x_label = "cycle",
        .y_label = "kinetic energy of all blocks [J]",
        .log_y = true,
        .series = {force.kinetic, hybrid.kinetic, matched.kinetic, level("counts as rest", Origin::exact, force.limit, 0.0, end)},
        .marks = {{"paper, force: first impact, 28 017", Origin::paper, 28017.0},
                  {"paper, force: converged, 99 502", Origin::paper, 99502.0},
                  {"paper, hybrid: first impact, 27 507", Origin::paper, 27507.0},
                  {"paper, hybrid: converged, 37 709", Origin::paper, 37709.0}}};
    return {.id = "fig13",
            .title = "Kinetic energy after the excavation",
            .source = "Fig. 13",
            .note = "The tunnel is excavated at cycle 5000. Each curve ends where its run has converged.",
            .columns = 1,
            .panels = {panel},
            .maps = {}};
}
}  // namespace hdem::verification
