#include "core/joint/joint_row.h"

#include "core/joint/barton_bandis.h"
#include "core/joint/continuously_yielding.h"
#include "core/joint/coulomb_residual.h"
#include "core/joint/patton.h"
#include "core/joint/plesha.h"
#include "core/joint/saeb_amadei.h"

namespace hdem
{
namespace
{
/// Call `use` with the curve's type.
template <typename Use>
auto with_curve(CurveKind kind, const Use& use)
{
    switch (kind)
    {
    case CurveKind::hyperbolic:
        return use(Hyperbolic{});
    case CurveKind::power_law:
        return use(PowerLaw{});
    case CurveKind::linear:
        break;
    }
    return use(Linear{});
}

double barton_roughness(const JointNumbers& n, double stress)
{
    const double free = n[BartonBandis::roughness] * (n[BartonBandis::log_strength] - log(max(stress, 1.0)));
    return min(max(free, 0.0), n[BartonBandis::greatest_roughness]);
}
}  // namespace

double closure_under(const JointRow& row, double stress)
{
    return with_curve(row.curve, [&](auto curve) { return decltype(curve)::closure_under(row.numbers, stress); });
}

NormalState normal_state(const JointRow& row, double closure)
{
    return with_curve(row.curve,
                      [&](auto curve)
                      {
                          const BasicCurvePoint<double> p = decltype(curve)::at(row.numbers, closure);
                          return NormalState{p.stress, p.stiffness, p.energy};
                      });
}

JointMemory drawn_memory(const JointRow& row, double normal_stress, double shear_stress)
{
    const double broken = row.begins_broken ? 1.0 : 0.0;
    JointMemory memory{.state = broken, .broken = broken};
    if (row.kind != JointKind::barton_bandis || normal_stress <= 0.0)
        return memory;
    const double i = barton_roughness(row.numbers, normal_stress);
    double low = 0.0, high = 1.0;  // of delta / delta_p
    for (int k = 0; k < 60; ++k)
    {
        const double x = 0.5 * (low + high);
        const bool bears = normal_stress * tan(BartonBandis::friction_angle(row.numbers, x, i)) >= magnitude(shear_stress);
        (bears ? high : low) = x;
    }
    memory.state = shear_stress == 0.0 ? 0.0 : high * row.numbers[BartonBandis::peak_displacement];
    return memory;
}

double damage(const JointRow& row, const JointMemory& memory)
{
    const JointNumbers& n = row.numbers;
    switch (row.kind)
    {
    case JointKind::barton_bandis:
    {
        const double x = memory.state / n[BartonBandis::peak_displacement];
        return x > 1.0 ? 1.0 - BartonBandis::mobilised(x) : 0.0;
    }
    case JointKind::continuously_yielding:
        return 1.0 - exp(-memory.state * n[ContinuouslyYielding::roughness]);
    case JointKind::plesha:
        return 1.0 - exp(-n[Plesha::wear] * memory.state);
    case JointKind::saeb_amadei:
        return min(memory.state / n[SaebAmadei::residual_slip], 1.0);
    case JointKind::plain:
    case JointKind::patton:
    case JointKind::coulomb:
        break;
    }
    return memory.broken;
}

double peak_strength(const JointRow& row, double stress)
{
    const JointNumbers& n = row.numbers;
    switch (row.kind)
    {
    case JointKind::barton_bandis:
        return stress * tan(n[BartonBandis::residual_friction] + barton_roughness(n, stress));
    case JointKind::patton:
        return Patton::strength(n, stress);
    case JointKind::continuously_yielding:
        return stress * n[ContinuouslyYielding::first_friction];
    case JointKind::plesha:
    {
        const double tilt = tan(n[Plesha::roughness]), phi = n[Plesha::friction];
        return stress * (phi + tilt) / (1.0 - phi * tilt);
    }
    case JointKind::saeb_amadei:
        return SaebAmadei::strength(n, stress, 0.0).value;
    case JointKind::plain:
    case JointKind::coulomb:
        break;
    }
    return max(n[CoulombResidual::cohesion] + stress * n[CoulombResidual::friction], 0.0);
}
}  // namespace hdem
