#pragma once
/// A joint law of a shared library of the user (core/joint/hdem_joint_law.h).

#include "core/joint/hdem_joint_law.h"
#include "core/joint/normal_closure.h"

#include <vector>

namespace hdem
{
using JointFunction = void (*)(const hdem_joint_points*);

/// One joint of the case with such a law.
struct UserLawInput
{
    JointFunction function = nullptr;
    std::vector<double> parameters;
    double shear_stiffness = 0.0;  ///< K_S [Pa/m]
};

/// Input and output of a call, for one to four points.
struct UserLawPoints
{
    static constexpr int most = 4;
    using Values = std::array<double, most>;
    Values closure, slide, last_shear, last_normal, slip;
    Values state, second, opening;
    Values normal, shear, strength, energy, normal_tangent;
};

/// Keep a joint for the run. @return its number, from 1 on
[[nodiscard]] int keep_user_law(const UserLawInput& input);

/// K_N and K_S that the function sees [Pa/m].
struct UserLawSprings
{
    double normal, shear;
};

/// Points `from` to `from + count - 1` of the joint with that number.
void ask_user_law(int number, const UserLawSprings& springs, int from, int count, UserLawPoints& points);

/// Memory: state and turn are the law's own; opening is w; broken means nothing.
/// @see verification/unit/core/joint/user_law_test.cpp
struct UserLaw
{
    enum Number : int
    {
        shear_stiffness = curve_numbers,
        shear_compliance,           ///< 1 / K_S
        strength_share,             ///< 1; under strength reduction by F 1/F
        number = joint_numbers - 1  ///< of keep_user_law; no other law has anything but 0 here
    };

    [[nodiscard]] static JointNumbers numbers(const UserLawInput& in, JointNumbers n)
    {
        n[shear_stiffness] = in.shear_stiffness;
        n[shear_compliance] = compliance_of(in.shear_stiffness);
        n[strength_share] = 1.0;
        n[number] = keep_user_law(in);
        return n;
    }

    [[nodiscard]] static double peak_strength(const JointNumbers& n, double stress)
    {
        JointMemory fresh;
        return react<Linear>(n, JointStep{stress / n[curve_stiffness], 0.0, 0.0, stress}, fresh).strength;
    }
    static void weaken(JointNumbers& n, double factor) { n[strength_share] /= factor; }
    static void stiffen(JointNumbers& n, double times)
    {
        n[shear_stiffness] *= times;
        n[shear_compliance] /= times;
    }
    [[nodiscard]] static double damage_of(const JointNumbers&, const JointMemory& m) { return m.broken; }

    static void ask(const BasicJointNumbers<double>& n, UserLawPoints& points)
    {
        ask_user_law(static_cast<int>(n[number]), {n[curve_stiffness], n[shear_stiffness] / n[strength_share]}, 0, 1, points);
    }
    /// Lanes of one joint at once. Lanes of other laws have the number 0: no function is called.
    static void ask(const BasicJointNumbers<Pack>& n, UserLawPoints& points)
    {
        const Pack::V& joint = n[number].v;
        const bool is_one = joint[0] == joint[1] && joint[1] == joint[2] && joint[2] == joint[3];
        for (int i = 0; i < (is_one ? 1 : lanes); ++i)
            if (joint[i] != 0.0)
                ask_user_law(static_cast<int>(joint[i]),
                             {n[curve_stiffness].v[i], n[shear_stiffness].v[i] / n[strength_share].v[i]}, i, is_one ? lanes : 1,
                             points);
    }

    template <typename R>
    [[nodiscard]] static R loaded(const UserLawPoints::Values& values)
    {
        R value;
        std::memcpy(&value, values.data(), sizeof value);
        return value;
    }

    template <typename Curve, typename R>
    [[nodiscard]] static BasicJointStress<R> react(const BasicJointNumbers<R>& n, const BasicJointStep<R>& step,
                                                   BasicJointMemory<R>& m)
    {
        UserLawPoints points{};
        const auto give = [](UserLawPoints::Values& to, const R& value) { std::memcpy(to.data(), &value, sizeof value); };
        give(points.closure, step.closure);
        give(points.slide, step.slide);
        // For a strength tau_max / F, the law gets F times the shear stress and a shear spring F times as stiff. Its answer is divided by F.
        const R share = n[strength_share];
        give(points.last_shear, select(share > R(0.0), step.last_shear / max(share, R(1e-200)), R(0.0)));
        give(points.last_normal, step.last_normal);
        give(points.slip, m.slip);
        give(points.state, m.state);
        give(points.second, m.turn);
        give(points.opening, m.opening);
        ask(n, points);
        const R zero = 0.0, w = m.opening, k = n[shear_compliance];
        BasicJointStress<R> now;
        now.normal = loaded<R>(points.normal);
        now.shear = loaded<R>(points.shear) * share;
        now.strength = loaded<R>(points.strength) * share;
        now.opening = loaded<R>(points.opening);
        now.energy = loaded<R>(points.energy);
        now.normal_stiffness = loaded<R>(points.normal_tangent);
        now.shear_compliance = k;
        now.slid = -step.slide - (now.shear - step.last_shear) * k;
        now.heat = slip_heat(step, now, w);
        now.freed = zero;
        const auto open = step.closure + now.opening <= zero;
        empty_where_open(open, step, w, now);
        m.state = select(open, m.state, loaded<R>(points.state));
        m.turn = select(open, m.turn, loaded<R>(points.second));
        m.opening = now.opening;
        m.slip += now.slid;
        return now;
    }
};
}  // namespace hdem
