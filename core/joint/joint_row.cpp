#include "core/joint/joint_row.h"

#include "core/joint/all_laws.h"

namespace hdem
{
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

JointStress stress_at_rest(const JointRow& row, double closure, double shear, double normal, JointMemory memory)
{
    const JointStep step{closure, 0.0, shear, normal};
    return with_law(row.kind,
                    [&](auto law)
                    {
                        return with_curve(row.curve, [&](auto curve)
                                          { return decltype(law)::template react<decltype(curve)>(row.numbers, step, memory); });
                    });
}

JointMemory drawn_memory(const JointRow& row, double normal_stress, double shear_stress)
{
    const double broken = row.begins_broken ? 1.0 : 0.0;
    JointMemory memory{.state = broken, .broken = broken};
    if (row.has_memory())
        with_law(row.kind,
                 [&](auto law)
                 {
                     if constexpr (requires { decltype(law)::drawn_state(row.numbers, 0.0, 0.0); })
                         memory.state = decltype(law)::drawn_state(row.numbers, normal_stress, shear_stress);
                 });
    return memory;
}

double damage(const JointRow& row, const JointMemory& memory)
{
    if (!row.has_memory())
        return memory.broken;
    return with_law(row.kind, [&](auto law) { return decltype(law)::damage_of(row.numbers, memory); });
}

double peak_strength(const JointRow& row, double stress)
{
    return with_law(row.kind, [&](auto law) { return decltype(law)::peak_strength(row.numbers, stress); });
}
}  // namespace hdem
