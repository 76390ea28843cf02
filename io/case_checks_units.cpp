#include "io/case_check.h"
#include "io/case_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace hdem
{
namespace
{
/// Warns of numbers that nobody means: those of another unit.
class UnitCheck : public CaseCheck
{
  public:
    using CaseCheck::CaseCheck;

    void check()
    {
        for (const MaterialDef& material : def_.materials)
            check_density(material);
        for (const JointDef& joint : def_.joints)
            check_joint(joint);
        for (std::size_t i = 0; i < def_.bolts.size(); ++i)
            check_bolt(def_.bolts[i], fmt::format("bolt[{}].", i));
        for (std::size_t i = 0; i < def_.liners.size(); ++i)
            check_liner(def_.liners[i], fmt::format("liner[{}].", i));
        for (std::size_t i = 0; i < def_.boundaries.size(); ++i)
            check_boundary(def_.boundaries[i], fmt::format("boundary[{}].", i));
        if (def_.insitu.given)
            check_insitu();
        if (def_.water.given)
            check_water();
    }

  private:
    void check_density(const MaterialDef& material)
    {
        if (material.density > 0.0 && (material.density < 200.0 || material.density > 2e4))
            problems_.warn("material." + material.name + ".density", fmt::format("material \"{}\"", printable(material.name)),
                           fmt::format("density = {:.6g}", material.density), "rock has 1500 to 3500 kg/m3",
                           "Give it in kg/m3, not in t/m3 or kN/m3.");
    }

    void check_water()
    {
        const double density = def_.water.density;
        if (density > 0.0 && (density < 500.0 || density > 2e3))
            problems_.warn("water.density", "[water]", fmt::format("density = {:.6g}", density), "water has 1000 kg/m3",
                           "Give it in kg/m3, not in t/m3 or kN/m3.");
        const bool is_upright = def_.gravity.x() == 0.0 && def_.gravity.y() < 0.0;
        const auto [lowest, highest] = heights_of_rock();
        if (!def_.water.level || !is_upright || lowest > highest)
            return;
        const std::string said = fmt::format("level = {:.6g}", *def_.water.level);
        if (*def_.water.level <= lowest)
            problems_.warn("water.level", "[water]", said, "all rock lies above it: it presses on nothing",
                           "Give the y of the water table in the axes of the model, not a depth.");
        if (*def_.water.level > highest + 1000.0)
            problems_.warn("water.level", "[water]", said, "more than a kilometre above all rock", "Give it in m.");
    }

    void check_joint(const JointDef& joint)
    {
        const std::string path = "joint." + joint.name + ".";
        const std::string object = fmt::format("joint \"{}\"", printable(joint.name));
        const double greatest_angle_in_rad = std::numbers::pi / 2.0;
        if (joint.friction_angle_deg > 0.0 && joint.friction_angle_deg < greatest_angle_in_rad)
            problems_.warn(path + "friction_angle_deg", object,
                           fmt::format("friction_angle_deg = {:.6g}", joint.friction_angle_deg), "hardly any friction",
                           "Give it in degrees, not in radians or as a tangent.");
        if (joint.jcs > 0.0 && joint.jcs < 1e5)
            problems_.warn(path + "jcs", object, fmt::format("jcs = {:.6g}", joint.jcs), "walls of joints have 1e7 to 3e8 Pa",
                           "Give it in Pa, not in MPa.");
        double unit_weight = 0.0;
        for (const MaterialDef& material : def_.materials)
            unit_weight = std::max(unit_weight, material.density * def_.gravity.norm());
        const double share = unit_weight / joint.normal_stiffness;  // of its height, whatever that is
        if (joint.normal_stiffness > 0.0 && !joint.normal_exponent && share > most_overlap)
            problems_.warn(
                path + "normal_stiffness", object, fmt::format("normal_stiffness = {:.4g}", joint.normal_stiffness),
                fmt::format("so soft that the weight of a block presses it into the next one by {:.2g} of its height", share),
                fmt::format("Give it in Pa/m: at least {:.1g}, if the answer is not to depend on it.", unit_weight / most_overlap));
    }

    void check_bolt(const BoltDef& bolt, const std::string& path)
    {
        const std::string object = fmt::format("bolt \"{}\"", printable(bolt.name));
        if (bolt.area > 0.05)
            problems_.warn(path + "area", object, fmt::format("area = {:.6g}", bolt.area),
                           fmt::format("a bar with a diameter of {:.3g} m", std::sqrt(4.0 * bolt.area / std::numbers::pi)),
                           "Give it in m2: 4.9e-4 for 25 mm.");
        if (bolt.area > 0.0 && bolt.modulus < 1e9)
            problems_.warn(path + "modulus", object, fmt::format("modulus = {:.6g}", bolt.modulus), "steel has 2e11 Pa",
                           "Give it in Pa, not in GPa.");
        if (bolt.area > 0.0 && bolt.yield && *bolt.yield < 1e6 * bolt.area)
            problems_.warn(path + "yield", object, fmt::format("yield = {:.6g}", *bolt.yield),
                           fmt::format("a stress of {:.2g} MPa in the bar", 1e-6 * *bolt.yield / bolt.area),
                           "Give the force in N, not in kN.");
        if (bolt.kind == BoltKind::grouted && bolt.bond_stiffness > 0.0 && bolt.bond_stiffness < 1e5)
            problems_.warn(path + "bond_stiffness", object, fmt::format("bond_stiffness = {:.6g}", bolt.bond_stiffness),
                           "grout has 1e7 to 1e10 N/m for a metre of bar", "Give it in N/m/m, not in MN or GN.");
        if (bolt.kind == BoltKind::grouted && bolt.bond_strength > 0.0 && bolt.bond_strength < 2e3)
            problems_.warn(path + "bond_strength", object, fmt::format("bond_strength = {:.6g}", bolt.bond_strength),
                           "grout has 1e5 to 1e6 N for a metre of bar", "Give it in N/m, not in kN/m.");
    }

    static constexpr const char* small_stress = "less than a centimetre of rock weighs";
    [[nodiscard]] static bool is_small_stress(double stress) { return stress > 0.0 && stress < 200.0; }

    void check_liner(const LinerDef& liner, const std::string& path)
    {
        if (liner.compressive_strength && *liner.compressive_strength > 0.0 && *liner.compressive_strength < 1e5)
            problems_.warn(path + "compressive_strength", fmt::format("liner \"{}\"", printable(liner.name)),
                           fmt::format("compressive_strength = {:.6g}", *liner.compressive_strength), "shotcrete has 1e7 to 6e7 Pa",
                           "Give it in Pa, not in MPa.");
        if (liner.modulus > 0.0 && liner.modulus < 1e8)
            problems_.warn(path + "modulus", fmt::format("liner \"{}\"", printable(liner.name)),
                           fmt::format("modulus = {:.6g}", liner.modulus), "concrete has 1e10 to 4e10 Pa, steel 2e11 Pa",
                           "Give it in Pa, not in GPa or MPa.");
    }

    /// In [insitu] compression is negative, at a boundary positive: a sign that is easily mistaken.
    void check_boundary(const BoundaryDef& boundary, const std::string& path)
    {
        const std::string object = fmt::format("boundary \"{}\"", printable(boundary.name));
        if (boundary.kind == BoundaryKind::stress && boundary.stress)
        {
            const Vec2& stress = *boundary.stress;
            const std::string said = fmt::format("stress = [{:.4g}, {:.4g}]", stress.x(), stress.y());
            if (stress.x() < 0.0)
                problems_.warn(path + "stress", object, said, "it pulls at the rock",
                               "Compression is positive here, though it is negative in [insitu].");
            else if (is_small_stress(stress.norm()) && boundary.stress_gradient.isZero(0.0))
                problems_.warn(path + "stress", object, said, small_stress, "Give it in Pa, not in MPa.");
        }
        if (boundary.kind == BoundaryKind::servo && is_small_stress(boundary.target))
            problems_.warn(path + "target", object, fmt::format("target = {:.4g}", boundary.target), small_stress,
                           "Give it in Pa, not in MPa.");
    }

    /// Lowest and highest y of what the case gives; the lowest above the highest where it gives nothing.
    [[nodiscard]] std::array<double, 2> heights_of_rock() const
    {
        constexpr double endless = std::numeric_limits<double>::infinity();
        std::array<double, 2> range{endless, -endless};
        const auto add = [&](double y) { range = {std::min(range[0], y), std::max(range[1], y)}; };
        if (def_.domain.given && def_.domain.polygon.empty())
        {
            add(def_.domain.origin.y());
            add(def_.domain.origin.y() + def_.domain.height);
        }
        for (const Vec2& v : def_.domain.polygon)
            add(v.y());
        for (const BlockDef& block : def_.blocks)
            for (const Vec2& v : block.polygon)
                add(v.y());
        return range;
    }

    void check_insitu()
    {
        const InsituDef& insitu = def_.insitu;
        if (insitu.stress && insitu.stress->xx > 0.0 && insitu.stress->yy > 0.0)
            problems_.warn(
                "insitu.stress", "[insitu]",
                fmt::format("stress = [{:.4g}, {:.4g}, {:.4g}]", insitu.stress->xx, insitu.stress->yy, insitu.stress->xy),
                "tension in all directions", "Compression is negative here.");
        if (insitu.surface && *insitu.surface <= heights_of_rock()[0])
            problems_.warn("insitu.surface", "[insitu]", fmt::format("surface = {:.6g}", *insitu.surface),
                           "all rock lies above it: there is no stress anywhere",
                           "Give the y of the ground in the axes of the model, not a depth.");
        if (insitu.ratio && *insitu.ratio > 10.0)
            problems_.warn("insitu.ratio", "[insitu]", fmt::format("ratio = {:.6g}", *insitu.ratio),
                           "the horizontal stress is more than ten times the vertical one", "Give it as a number, not in percent.");
    }

    static constexpr double most_overlap = 1e-3;  ///< of a block's height [-]
};
}  // namespace

void warn_of_units(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    UnitCheck(def, source, problems).check();
}
}  // namespace hdem
