#include "verification/checks/turned_case.h"

#include "verification/checks/checks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
Polygon turned_polygon(Polygon polygon, double angle)
{
    for (Vec2& p : polygon)
        p = turned(p, angle);
    return polygon;
}

void turn_rock(const CaseDef& def, double angle, Overrides& turns)
{
    if (!def.domain.polygon.empty())
        turns.push_back(set("domain.polygon", turned_polygon(def.domain.polygon, angle)));
    for (std::size_t i = 0; i < def.joint_sets.size(); ++i)
    {
        const std::string key = fmt::format("joint_set[{}].", i);
        turns.push_back(set(key + "dip_deg", def.joint_sets[i].dip_deg + angle * 180.0 / std::numbers::pi));
        if (def.joint_sets[i].origin)
            turns.push_back(set(key + "origin", turned(*def.joint_sets[i].origin, angle)));
    }
    for (std::size_t i = 0; i < def.excavations.size(); ++i)
        turns.push_back(set(fmt::format("excavation[{}].polygon", i), turned_polygon(def.excavations[i].polygon, angle)));
    for (std::size_t i = 0; i < def.blocks.size(); ++i)
    {
        const std::string key = fmt::format("block[{}].", i);
        turns.push_back(set(key + "polygon", turned_polygon(def.blocks[i].polygon, angle)));
        turns.push_back(set(key + "velocity", turned(def.blocks[i].velocity, angle)));
    }
}

void turn_loads(const CaseDef& def, double angle, Overrides& turns)
{
    for (std::size_t i = 0; i < def.loads.size(); ++i)
    {
        const LoadDef& load = def.loads[i];
        const std::string key = fmt::format("load[{}].", i);
        turns.push_back(set(key + "acceleration", turned(load.acceleration, angle)));
        turns.push_back(set(key + "force", turned(load.force, angle)));
        if (load.velocity_x && load.velocity_y)
        {
            const Vec2 velocity = turned(Vec2(*load.velocity_x, *load.velocity_y), angle);
            turns.push_back(set(key + "velocity_x", velocity.x()));
            turns.push_back(set(key + "velocity_y", velocity.y()));
        }
    }
    turns.push_back(set("gravity.vector", turned(def.gravity, angle)));
}

void turn_water(const CaseDef& def, double angle, Overrides& turns)
{
    if (!def.water.table.empty())
        turns.push_back(set("water.table", turned_polygon(def.water.table, angle)));
    for (std::size_t i = 0; i < def.stages.size(); ++i)
        if (!def.stages[i].water_table.empty())
            turns.push_back(set(fmt::format("stage[{}].water_table", i), turned_polygon(def.stages[i].water_table, angle)));
    for (std::size_t i = 0; i < def.water_cracks.size(); ++i)
    {
        const std::string key = fmt::format("water_crack[{}].", i);
        turns.push_back(set(key + "crack", turned_polygon(def.water_cracks[i].crack, angle)));
        turns.push_back(set(key + "outlet", turned_polygon(def.water_cracks[i].outlet, angle)));
    }
}

/// Directions [deg].
Vec2 turned_arc(const Vec2& arc, double angle)
{
    return arc + Vec2::Constant(angle * 180.0 / std::numbers::pi);
}

void turn_support(const CaseDef& def, double angle, Overrides& turns)
{
    for (std::size_t i = 0; i < def.bolts.size(); ++i)
    {
        const std::string key = fmt::format("bolt[{}].", i);
        if (def.bolts[i].arc)
            turns.push_back(set(key + "arc", turned_arc(*def.bolts[i].arc, angle)));
        if (!def.bolts[i].from)
            continue;
        turns.push_back(set(key + "from", turned(*def.bolts[i].from, angle)));
        turns.push_back(set(key + "to", turned(*def.bolts[i].to, angle)));
    }
}

void turn_liners(const CaseDef& def, double angle, Overrides& turns)
{
    for (std::size_t i = 0; i < def.liners.size(); ++i)
    {
        const std::string key = fmt::format("liner[{}].", i);
        if (def.liners[i].arc)
            turns.push_back(set(key + "arc", turned_arc(*def.liners[i].arc, angle)));
        if (!def.liners[i].path.empty())
            turns.push_back(set(key + "path", turned_polygon(def.liners[i].path, angle)));
    }
}

Override turned_stress(const StressDef& s, double angle)
{
    const double c = std::cos(angle), n = std::sin(angle);
    return {"insitu.stress",
            fmt::format("[{:.17g}, {:.17g}, {:.17g}]", c * c * s.xx + n * n * s.yy - 2.0 * c * n * s.xy,
                        n * n * s.xx + c * c * s.yy + 2.0 * c * n * s.xy, c * n * (s.xx - s.yy) + (c * c - n * n) * s.xy)};
}
}  // namespace

std::vector<std::pair<const char*, double>> methods_and_angles()
{
    std::vector<std::pair<const char*, double>> all;
    for (const char* method : all_methods)
        for (const double angle : {0.0, 23.0})
            all.emplace_back(method, angle);
    return all;
}

Vec2 turned(const Vec2& p, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

Overrides turned_case(const std::string& case_file, const Overrides& overrides, double angle)
{
    const CaseDef def = load_case(case_folder() / case_file, overrides).file.def;
    Overrides turns = overrides;
    turn_rock(def, angle, turns);
    turn_loads(def, angle, turns);
    turn_water(def, angle, turns);
    turn_support(def, angle, turns);
    turn_liners(def, angle, turns);
    if (def.insitu.stress)
        turns.push_back(turned_stress(*def.insitu.stress, angle));
    return turns;
}
}  // namespace hdem::verification
