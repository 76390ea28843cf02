/// How rock gives way as a whole: sets of joints and a running bond, by stresses at the sides and by moving the outer blocks.

#include "core/contact/contact_report.h"
#include "verification/checks/case_run.h"
#include "verification/checks/insitu_checks.h"
#include "verification/checks/turned_case.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace hdem::verification
{
namespace
{
using Tensor = Eigen::Matrix2d;

Tensor tensor(double xx, double yy, double xy)
{
    return (Tensor() << xx, xy, xy, yy).finished();
}

/// R t R^T: a tensor turned by `angle` [rad].
Tensor turned(const Tensor& t, double angle)
{
    const Tensor r = (Tensor() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
    return r * t * r.transpose();
}

/// Gradient of the displacement, du_i/dx_j, that fits all blocks best, in the axes of the case as written [-].
Tensor gradient_of(const CaseRun& run, double angle)
{
    const Blocks& blocks = run.state().blocks;
    Vec2 middle(0.0, 0.0), moved(0.0, 0.0);
    for (Index b = 0; b < blocks.size(); ++b)
    {
        middle += blocks.reference_position[b] / blocks.size();
        moved += blocks.displacement(b) / blocks.size();
    }
    Tensor mixed = Tensor::Zero(), square = Tensor::Zero();
    for (Index b = 0; b < blocks.size(); ++b)
    {
        const Vec2 x = blocks.reference_position[b] - middle;
        mixed += (blocks.displacement(b) - moved) * x.transpose();
        square += x * x.transpose();
    }
    return turned(Tensor(mixed * square.inverse()), -angle);
}

double greatest_turn(const CaseRun& run)
{
    double greatest = 0.0;
    for (const BlockMotion& motion : run.state().blocks.motion)
        greatest = std::max(greatest, std::abs(motion.angle));
    return greatest;
}

/// The case with a little stress more at its four sides, which were pressed with 1e5 Pa. Edges run anticlockwise.
CaseRun pressed(Report& report, const std::string& file, const Tensor& stress, double angle, Overrides overrides = {})
{
    const CaseDef def = load_case(case_folder() / file, {}).file.def;
    const Polygon& polygon = def.domain.polygon;
    for (std::size_t k = 0; k < polygon.size(); ++k)
    {
        const Vec2 along = (polygon[(k + 1) % polygon.size()] - polygon[k]).normalized(), out = -turned_left(along);
        const Vec2 traction = stress * out;
        overrides.push_back(set(fmt::format("boundary.side{}.stress", k), Vec2(1e5 - out.dot(traction), along.dot(traction))));
    }
    return CaseRun(report, file, turned_case(file, overrides, angle));
}

/// The case with its fixed blocks moved by a gradient du_i/dx_j of the displacement in 2000 cycles.
CaseRun moved(Report& report, const std::string& file, const Overrides& overrides, const Tensor& gradient, double angle)
{
    constexpr double cycles = 2000.0;
    const Overrides all = turned_case(file, overrides, angle);
    const CaseRun drawn(file, all);
    const Blocks& blocks = drawn.state().blocks;
    std::string loads;
    for (Index b = 0; b < blocks.size(); ++b)
    {
        const Vec2 velocity = turned(gradient, angle) * (blocks.reference_position[b] + drawn.model().origin) /
                              (cycles * drawn.step());
        if (!blocks.is_free(b))
            loads += fmt::format("{}{{blocks = [\"{}\"], velocity_x = {:.17g}, velocity_y = {:.17g}, until_cycle = {:g}}}",
                                 loads.empty() ? "" : ", ", drawn.model().name[b], velocity.x(), velocity.y(), cycles);
    }
    return CaseRun(report, file, all + Overrides{{"load", "[" + loads + "]"}});
}

/// Mean stress that was added in the free block next to the middle, tension positive, in the axes of the case as written [Pa].
Tensor stress_inside(const CaseRun& run, double angle)
{
    const Blocks& blocks = run.state().blocks;
    Vec2 middle(0.0, 0.0);
    for (Index b = 0; b < blocks.size(); ++b)
        middle += blocks.reference_position[b] / blocks.size();
    Index nearest = no_index;
    for (Index b = 0; b < blocks.size(); ++b)
        if (blocks.is_free(b) && (nearest == no_index || (blocks.reference_position[b] - middle).norm() <
                                                             (blocks.reference_position[nearest] - middle).norm()))
            nearest = b;
    const MeanStress s = mean_stresses(run.model(), run.state())[static_cast<std::size_t>(nearest)];
    return turned(tensor(1e5 - s.xx, 1e5 - s.yy, -s.xy), -angle);
}

const Tensor test_stress = tensor(-8e3, -5e3, 1e3);  ///< a thousandth of that of I1 [Pa]

/// S11, S12, S22, S66 [1/Pa]
struct Compliance
{
    double s11 = 0.0, s12 = 0.0, s22 = 0.0, s66 = 0.0;
};

/// By two stresses and a shear stress at the sides.
Compliance compliance_of(Report& report, const std::string& file, double angle)
{
    const Tensor xx = gradient_of(pressed(report, file, tensor(-8e3, 0.0, 0.0), angle), angle);
    const Tensor yy = gradient_of(pressed(report, file, tensor(0.0, -5e3, 0.0), angle), angle);
    const Tensor xy = gradient_of(pressed(report, file, tensor(0.0, 0.0, 1e3), angle), angle);
    return {xx(0, 0) / -8e3, xx(1, 1) / -8e3, yy(1, 1) / -5e3, (xy(0, 1) + xy(1, 0)) / 1e3};
}

/// J = sum over the sets of C sigma n (x) n / s, C = n n / K_N + e e / K_S: rigid blocks of two sets follow it without turning.
Tensor gradient_under(const CaseDef& def, const Tensor& stress)
{
    const JointDef& joint = def.joints.front();
    Tensor gradient = Tensor::Zero();
    for (const JointSetDef& set : def.joint_sets)
    {
        const Vec2 e(std::cos(radians(set.dip_deg)), std::sin(radians(set.dip_deg))), n = turned_left(e);
        const Vec2 jump = n * n.dot(stress * n) / joint.normal_stiffness + e * e.dot(stress * n) / joint.shear_stiffness;
        gradient += jump * n.transpose() / set.spacing;
    }
    return gradient;
}

/// The outer blocks are moved as the joints give way under test_stress: it must be found inside.
void check_moved_sides(Report& report, const std::string& file, double angle, const std::string& turn, double bar)
{
    const CaseDef def = load_case(case_folder() / file, {}).file.def;
    const Overrides driven{{"boundary", "[]"}, {"domain.fixed_edges", "[0, 1, 2, 3]"}, {"stage[0].fix", "[]"}};
    const CaseRun run = moved(report, file, driven, gradient_under(def, test_stress), angle);
    const Tensor found = stress_inside(run, angle);
    const std::string name = turn + "outer blocks moved by J: ";
    report.require({name + "σ_xx inside [kPa]", "rigid blocks of two sets", -8.0, 1e-3 * found(0, 0)}, relative(bar));
    report.require({name + "σ_yy inside [kPa]", "rigid blocks of two sets", -5.0, 1e-3 * found(1, 1)}, relative(bar));
    report.require({name + "σ_xy inside [kPa]", "rigid blocks of two sets", 1.0, 1e-3 * found(0, 1)}, relative(bar));
    report.require({name + "greatest turn, of 1e-6 strain", "blocks do not turn", bar, 1e6 * greatest_turn(run)}, at_most());
}
}  // namespace

void check_two_sets(Report& report)
{
    const std::string file = "insitu/two_sets.toml", source = "Morland (1974)";
    for (const double degrees : {0.0, 23.0})
    {
        const double angle = radians(degrees);
        const std::string turn = fmt::format("turned {:g}°: ", degrees);
        const Compliance s = compliance_of(report, file, angle);
        report.require({turn + "S11 [1e-10/Pa]", source, 5.968037, 1e10 * s.s11}, relative(1e-3));
        report.require({turn + "S12 [1e-10/Pa]", source, -5.019126, 1e10 * s.s12}, relative(1e-3));
        report.require({turn + "S22 [1e-10/Pa]", source, 6.101027, 1e10 * s.s22}, relative(1e-3));
        report.require({turn + "S66 [1e-10/Pa]", source, 8.354869, 1e10 * s.s66}, relative(1e-3));
        const auto require_strains = [&](const CaseRun& run, const std::string& name)
        {
            const Tensor h = gradient_of(run, angle);
            report.require({name + "strain xx [1e-6]", source, -2.75878, 1e6 * h(0, 0)}, relative(1e-3));
            report.require({name + "strain yy [1e-6]", source, 1.50619, 1e6 * h(1, 1)}, relative(1e-3));
            report.require({name + "γ_xy [1e-6]", source, 2.07974, 1e6 * (h(0, 1) + h(1, 0))}, relative(1e-3));
        };
        const CaseRun run = pressed(report, file, test_stress, angle);
        const std::string name = turn + "under (-8, -5, 1) kPa: ";
        require_strains(run, name);
        report.require({name + "greatest turn, of 1e-6 strain", "blocks do not turn", 1e-3, 1e6 * greatest_turn(run)}, at_most());
        const Overrides held{{"domain.hold", "mean"}, {"stage[0].fix", "[]"}};
        require_strains(pressed(report, file, test_stress, angle, held), turn + "held on average: ");
        check_moved_sides(report, file, angle, turn, 1e-3);
    }
}

void check_squares(Report& report)
{
    const std::string file = "insitu/squares.toml";
    for (const double degrees : {0.0, 23.0})
    {
        const double angle = radians(degrees);
        const std::string turn = fmt::format("turned {:g}°: ", degrees);
        const Compliance s = compliance_of(report, file, angle);
        report.require({turn + "E along x [GPa]", "K_N s", 10.0, 1e-9 / s.s11}, relative(1e-4));
        report.require({turn + "E along y [GPa]", "K_N s", 10.0, 1e-9 / s.s22}, relative(1e-4));
        report.require({turn + "ν", "0", 0.0, -s.s12 / s.s11}, absolute(1e-4));
        report.require({turn + "G [GPa]", "K_S s / 2", 5.0, 1e-9 / s.s66}, relative(1e-4));
        check_moved_sides(report, file, angle, turn, 1e-4);
    }
}

void check_bond(Report& report)
{
    const std::string file = "insitu/bond.toml";
    constexpr double b = 2.0, h = 1.0, kn = 7e9, ks = 5e8, strain = 1e-6;
    const double g = 1.0 / (1.0 / (ks * h) + 1.0 / (ks * b + kn * b * b / (4.0 * h)));
    const double beds = g / (ks * h);  // the beds' share of the shear strain
    for (const double degrees : {0.0, 23.0})
    {
        const double angle = radians(degrees);
        const std::string turn = fmt::format("turned {:g}°: ", degrees);
        const auto stiffness = [&](double xx, double yy, double xy, double yx)
        {
            const Tensor gradient = strain * (Tensor() << xx, xy, yx, yy).finished();
            return Tensor(stress_inside(moved(report, file, {}, gradient, angle), angle) / strain);
        };
        report.require({turn + "C11 [GPa]", "K_N b + K_S b² / 4h", 14.5, 1e-9 * stiffness(1, 0, 0, 0)(0, 0)}, relative(1e-3));
        report.require({turn + "C22 [GPa]", "K_N h", 7.0, 1e-9 * stiffness(0, 1, 0, 0)(1, 1)}, relative(1e-3));
        report.require({turn + "G [MPa]", "1/G = 1/(K_S h) + 1/(K_S b + K_N b² / 4h)", 470.5882,
                        1e-6 * stiffness(0, 0, beds, 1.0 - beds)(0, 1)},
                       relative(1e-3));
    }
}
}  // namespace hdem::verification
