#pragma once
/// One point of a joint, driven by displacements: laws by themselves, without blocks.

#include "core/joint/joint_law.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace hdem
{
template <typename Law, typename Curve>
struct LawPoint
{
    JointNumbers n;
    JointMemory memory{};
    JointStress now{};
    double closure = 0.0, u = 0.0;
    double work = 0.0, heat = 0.0, freed = 0.0, least_heat = 0.0, greatest_work = 0.0;

    /// Closed under a stress, without shear.
    LawPoint(const JointNumbers& numbers, double normal) : n(numbers), closure(Curve::closure_under(n, normal))
    {
        now = Law::template react<Curve>(n, {closure, 0.0, 0.0, normal}, memory);
    }

    [[nodiscard]] double stored() const { return now.energy + 0.5 * now.shear * now.shear * now.shear_compliance; }

    void step(double du, double to_closure)
    {
        const JointStress last = now;
        now = Law::template react<Curve>(n, {to_closure, -du, last.shear, last.normal}, memory);
        work += 0.5 * (last.shear + now.shear) * du + 0.5 * (last.normal + now.normal) * (to_closure - closure);
        heat += now.heat;
        freed += now.freed;
        least_heat = std::min(least_heat, now.heat);
        greatest_work = std::max(greatest_work, std::abs(work));
        closure = to_closure;
        u += du;
    }

    /// One step behind a normal spring of this stiffness, which holds `normal` at `from`; stiffness 0: constant stress.
    void step_behind(double du, double stiffness, double normal, double from)
    {
        const auto off = [&](double c)
        {
            JointMemory trial = memory;
            return stiffness * (c - from) + Law::template react<Curve>(n, {c, -du, now.shear, now.normal}, trial).normal - normal;
        };
        double c = closure, at = off(c), width = 1e-8;
        double other = c, there = at;
        for (; at * there > 0.0; width *= 2.0)
        {
            c = other, at = there;
            other = c + (at > 0.0 ? -width : width);
            there = off(other);
        }
        for (int k = 0; k < 100 && std::abs(at) > 1e-12 * normal && there != at; ++k)  // Illinois
        {
            const double next = c - at * (c - other) / (at - there), f = off(next);
            if (f * at < 0.0)
                other = c, there = at;
            else
                there *= 0.5;
            c = next, at = f;
        }
        step(du, c);
    }

    void go(double to, int steps, double normal, double stiffness = 0.0, double from = 0.0)
    {
        const double start = u;
        for (int k = 1; k <= steps; ++k)
            step_behind(start + (to - start) * k / steps - u, stiffness, normal, from);
    }
};

/// Where the work went that was put into a point [J/m2].
struct ReversalEnergy
{
    double work = 0.0, stored = 0.0, heat = 0.0, freed = 0.0;
    double least_heat = 0.0;     ///< of a step
    double greatest_work = 0.0;  ///< at any time

    [[nodiscard]] double unexplained() const { return work - stored - heat - freed; }
};

/// Ten cycles of +-5 mm, behind a normal spring of this stiffness (0: under constant stress).
template <typename Law, typename Curve>
[[nodiscard]] ReversalEnergy ten_reversals(const JointNumbers& n, double normal, double stiffness, int steps)
{
    LawPoint<Law, Curve> p(n, normal);
    const double start = p.stored(), from = p.closure;
    for (int cycle = 0; cycle < 10; ++cycle)
    {
        p.go(5e-3, steps, normal, stiffness, from);
        p.go(-5e-3, 2 * steps, normal, stiffness, from);
        p.go(0.0, steps, normal, stiffness, from);
    }
    return {p.work, p.stored() - start, p.heat, p.freed, p.least_heat, p.greatest_work};
}

/// Slip under a small shear displacement to and fro, opened and closed again, in four lanes and point by point.
/// @return  first of 2000 cycles in which the bits of a lane differ from those of its point, or a number is not finite; -1: none
template <typename Law, typename Curve>
[[nodiscard]] int first_difference_of_lanes(const std::array<JointNumbers, lanes>& numbers, double closure)
{
    BasicJointNumbers<Pack> n;
    for (int i = 0; i < joint_numbers; ++i)
        for (int lane = 0; lane < lanes; ++lane)
            n[i].v[lane] = numbers[static_cast<std::size_t>(lane)][i];
    BasicJointMemory<Pack> four{};
    std::array<JointMemory, lanes> one{};
    BasicJointStress<Pack> now{};
    now.shear = now.normal = 0.0;
    four.broken.v[3] = one[3].broken = 1.0;
    for (int k = 0; k < 2000; ++k)
    {
        BasicJointStep<Pack> step;
        for (int lane = 0; lane < lanes; ++lane)
        {
            step.closure.v[lane] = closure * (std::sin(0.01 * k * (lane + 1)) + 0.6);
            step.slide.v[lane] = 2e-5 * std::cos(0.007 * k * (lane + 1));
        }
        step.last_shear = now.shear;
        step.last_normal = now.normal;
        now = Law::template react<Curve>(n, step, four);
        for (int lane = 0; lane < lanes; ++lane)
        {
            JointMemory& m = one[static_cast<std::size_t>(lane)];
            const JointStress s = Law::template react<Curve>(
                numbers[static_cast<std::size_t>(lane)],
                {step.closure.v[lane], step.slide.v[lane], step.last_shear.v[lane], step.last_normal.v[lane]}, m);
            const auto same = [&](double a, const Pack& b)
            { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(double{b.v[lane]}); };
            const bool agrees = same(s.normal, now.normal) && same(s.shear, now.shear) && same(s.strength, now.strength) &&
                                same(s.slid, now.slid) && same(s.opening, now.opening) && same(s.energy, now.energy) &&
                                same(s.heat, now.heat) && same(s.freed, now.freed) &&
                                same(s.normal_stiffness, now.normal_stiffness) && same(s.shear_compliance, now.shear_compliance) &&
                                same(m.slip, four.slip) && same(m.state, four.state) && same(m.turn, four.turn) &&
                                same(m.opening, four.opening) && same(m.broken, four.broken);
            if (!agrees ||
                !std::isfinite(s.normal + s.shear + s.strength + s.heat + s.freed + s.energy + s.normal_stiffness + m.turn))
                return k;
        }
    }
    return -1;
}
}  // namespace hdem
