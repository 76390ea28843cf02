#include "core/history_columns.h"

#include "core/motion/equilibrium.h"
#include "core/water/pore_pressure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
/// All names that select something, each once.
template <class Known>
std::vector<std::string> names_of(const std::vector<Known>& all)
{
    std::vector<std::string> names;
    for (const Known& known : all)
        for (const std::string& name : {std::string(known.quantity), known.column.name})
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(name);
    return names;
}
}  // namespace

const std::vector<KnownOfPoint>& known_of_point()
{
    static const std::vector<KnownOfPoint> all = {
        {"pore_pressure", {"pore_pressure", "Pa"}, [](const Model& m, const State& s, const Vec2& at) {
             return m.water.given ? pressure_at(m.water, s.stage, at) : 0.0;
         }}};
    return all;
}

const std::vector<KnownOfBlock>& known_of_block()
{
    static const std::vector<KnownOfBlock> all = {
        {"displacement",
         {"displacement_x", "m"},
         [](const Model&, const State& s, Index i) { return s.blocks.displacement(i).x(); }},
        {"displacement",
         {"displacement_y", "m"},
         [](const Model&, const State& s, Index i) { return s.blocks.displacement(i).y(); }},
        {"position",
         {"position_x", "m"},
         [](const Model& m, const State& s, Index i) { return m.origin.x() + s.blocks.motion[i].x; }},
        {"position",
         {"position_y", "m"},
         [](const Model& m, const State& s, Index i) { return m.origin.y() + s.blocks.motion[i].y; }},
        {"velocity", {"velocity_x", "m/s"}, [](const Model&, const State& s, Index i) { return s.blocks.velocity(i).x(); }},
        {"velocity", {"velocity_y", "m/s"}, [](const Model&, const State& s, Index i) { return s.blocks.velocity(i).y(); }},
        {"speed", {"speed", "m/s"}, [](const Model&, const State& s, Index i) { return s.blocks.velocity(i).norm(); }},
        {"rotation",
         {"rotation", "rad"},
         [](const Model&, const State& s, Index i) { return s.blocks.motion[i].angle - s.blocks.reference_angle[i]; }},
        {"angular_velocity",
         {"angular_velocity", "rad/s"},
         [](const Model&, const State& s, Index i) { return s.blocks.motion[i].w; }},
        {"force", {"force_x", "N"}, [](const Model&, const State& s, Index i) { return s.blocks.force[i].x; }},
        {"force", {"force_y", "N"}, [](const Model&, const State& s, Index i) { return s.blocks.force[i].y; }},
        {"kinetic_energy",
         {"kinetic_energy", "J"},
         [](const Model& m, const State& s, Index i) { return kinetic_energy(m, s.blocks, i); }},
    };
    return all;
}

const std::vector<KnownOfPair>& known_of_pair()
{
    static const std::vector<KnownOfPair> all = {
        {"normal_force", {"normal_force", "N"}, [](const Model&, const PairSample& p) { return p.normal_force; }},
        {"shear_force", {"shear_force", "N"}, [](const Model&, const PairSample& p) { return p.shear_force; }},
        {"tilt_force", {"tilt_force", "N"}, [](const Model&, const PairSample& p) { return p.tilt_force; }},
        {"overlap", {"overlap", "m"}, [](const Model&, const PairSample& p) { return p.overlap; }},
        {"shear_displacement", {"shear_displacement", "m"}, [](const Model&, const PairSample& p) { return p.shear_displacement; }},
        {"contact_length", {"contact_length", "m"}, [](const Model&, const PairSample& p) { return p.length; }},
        {"normal_impulse", {"normal_impulse", "N s"}, [](const Model&, const PairSample& p) { return p.normal_force * p.step; }},
        {"shear_impulse", {"shear_impulse", "N s"}, [](const Model&, const PairSample& p) { return p.shear_force * p.step; }},
        {"impulse_points",
         {"impulse_points", "1"},
         [](const Model&, const PairSample& p) { return static_cast<double>(p.impulse_points); }},
        {"plastic_slip", {"plastic_slip", "m"}, [](const Model&, const PairSample& p) { return p.plastic_slip; }},
        {"opening", {"opening", "m"}, [](const Model&, const PairSample& p) { return p.opening; }},
        {"damage", {"damage", "1"}, [](const Model&, const PairSample& p) { return p.damage; }},
        {"broken", {"broken", "1"}, [](const Model&, const PairSample& p) { return p.broken; }},
        {"mobilised_friction",
         {"mobilised_friction", "deg"},
         [](const Model&, const PairSample& p)
         { return std::atan2(std::abs(p.shear_force), std::max(p.normal_force, 0.0)) * 180.0 / std::numbers::pi; }},
    };
    return all;
}

/// Forces are those of one bolt.
const std::vector<KnownOfBolt>& known_of_bolt()
{
    static const std::vector<KnownOfBolt> all = {
        {"axial_force", {"axial_force", "N"}, [](const Bolt& b, const BoltRecord& r) { return b.spacing * r.force; }},
        {"across_force", {"across_force", "N"}, [](const Bolt& b, const BoltRecord& r) { return b.spacing * r.shear_force; }},
        {"greatest_force",
         {"greatest_force", "N"},
         [](const Bolt& b, const BoltRecord& r) { return b.spacing * r.greatest_force; }},
        {"elongation", {"elongation", "m"}, [](const Bolt&, const BoltRecord& r) { return r.elongation; }},
        {"status", {"status", "1"}, [](const Bolt&, const BoltRecord& r) { return static_cast<double>(r.status); }},
    };
    return all;
}

const std::vector<KnownOfLiner>& known_of_liner()
{
    static const std::vector<KnownOfLiner> all = {
        {"thrust", {"thrust", "N"}, [](const Liner&, const LinerRecord& r) { return r.thrust; }},
        {"moment", {"moment", "N m"}, [](const Liner&, const LinerRecord& r) { return r.moment; }},
        {"liner_displacement", {"liner_displacement", "m"}, [](const Liner&, const LinerRecord& r) { return r.displacement; }},
        {"hinges", {"hinges", "1"}, [](const Liner&, const LinerRecord& r) { return static_cast<double>(r.hinges); }},
        {"parted", {"parted", "m"}, [](const Liner&, const LinerRecord& r) { return r.parted; }}};
    return all;
}

const std::vector<std::string>& block_history_quantities()
{
    static const std::vector<std::string> all = names_of(known_of_block());
    return all;
}

const std::vector<std::string>& contact_history_quantities()
{
    static const std::vector<std::string> all = names_of(known_of_pair());
    return all;
}

const std::vector<std::string>& bolt_history_quantities()
{
    static const std::vector<std::string> all = names_of(known_of_bolt());
    return all;
}

const std::vector<std::string>& liner_history_quantities()
{
    static const std::vector<std::string> all = names_of(known_of_liner());
    return all;
}

const std::vector<std::string>& point_history_quantities()
{
    static const std::vector<std::string> all = names_of(known_of_point());
    return all;
}
}  // namespace hdem
