#include "core/contact/joint_points.h"

#include "core/contact/joint_reaction.h"

namespace hdem
{
namespace
{
using Numbers = BasicJointNumbers<Pack>;
using Step = BasicJointStep<Pack>;
using Memory = BasicJointMemory<Pack>;
using Stress = BasicJointStress<Pack>;

/// Lanes with different laws, some of which may be plain. Each law is evaluated once, for all its lanes: no lane depends on the laws of the others.
struct MixedLaws
{
    static constexpr bool has_all_lanes = false;

    template <typename>
    [[gnu::noinline]] static Stress react(const RowLanes& rows, const Step& step, Memory& memory)
    {
        const Pack zero = 0.0;
        Stress stress{zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
        Mask left = rows.has_memory;
        for (int j = 0; j < lanes; ++j)
        {
            if (!left.has(j))
                continue;
            Mask same{};
            for (int i = j; i < lanes; ++i)
                if (rows.has_memory.has(i) && rows.kind[i] == rows.kind[j] && rows.curve[i] == rows.curve[j])
                    same.set(i);
            Memory next = memory;
            const Stress answer = with_law(
                rows.kind[j], [&](auto law)
                { return with_curve(rows.curve[j], [&](auto curve) { return ask(law, curve, rows.numbers, step, next); }); });
            next.opening = answer.opening;
            take<Pack>(same, answer, stress);
            take<Pack>(same, next, memory);
            left = left & !same;
        }
        return stress;
    }

    template <typename Law, typename Curve>
    [[gnu::noinline]] static Stress ask(Law, Curve, const Numbers& numbers, const Step& step, Memory& memory)
    {
        return Law::template react<Curve>(numbers, step, memory);
    }

    template <typename>
    [[nodiscard]] static Mask dilate_by_slip(const RowLanes& rows, Mask held)
    {
        for (int i = 0; i < lanes; ++i)
            if (rows.kind[i] != kind_of<CoulombResidual>())
                held.clear(i);
        return held;
    }
};
}  // namespace

void evaluate_joint_points(const ContactGroup& g, Mask impulsive, const std::array<Pack, 2>& share, Pack dt,
                           const BasicJointPlace<Pack>& place, Sums& sums)
{
    const RowLanes& rows = place.rows;
    if (rows.is_uniform)
    {
        evaluate_by_one_law<Pack, law_count>(g, impulsive, share, dt, place, sums);
        return;
    }
    const ContactLanes last = place.lanes;
    if (any(!rows.has_memory))
    {
        Sums plain;
        for (int k = 0; k < 2; ++k)
            evaluate_point<Contact4::any, Joints::laws>(g, k, impulsive, share[k], dt, place.lanes, place.regime[k], plain);
        sums.take(!rows.has_memory, plain);
    }
    evaluate_points_by<MixedLaws, Pack>(g, impulsive, share, dt, place, last, sums);
}
}  // namespace hdem
