#pragma once
/// A joint of the case, in the form that its law needs.

#include "core/joint/joint_law.h"

namespace hdem
{
/// A law with a memory: its position in the list of all_laws.h.
enum class JointKind : std::int8_t
{
    plain = -1
};

/// The normal spring of a joint, see normal_closure.h.
enum class CurveKind : std::uint8_t
{
    linear,
    hyperbolic,
    power_law
};

/// One joint. A plain one is a CoulombSlip and nothing more: springs, friction and cohesion without memory.
struct JointRow
{
    JointKind kind = JointKind::plain;
    CurveKind curve = CurveKind::linear;
    JointNumbers numbers{};
    double reach = 0.0;              ///< gap up to which the law of an intact point is evaluated: it bears tension, or breaks [m]
    double torn_reach = 0.0;         ///< the same for a broken point: 0 without residual tension [m]
    double tension = 0.0;            ///< T [Pa]
    double residual_friction = 0.0;  ///< tan phi_r of impulses at broken points [-]
    double residual_cohesion = 0.0;  ///< c_r of the same [Pa]
    bool is_bonded = false;          ///< intact points have cohesion or tension, which impulses cannot break
    bool begins_broken = false;      ///< broken also where the blocks are drawn

    [[nodiscard]] bool has_memory() const { return kind != JointKind::plain; }
};

/// Closure at which a joint with a memory bears a stress; below 0 where it is pulled [m].
[[nodiscard]] double closure_under(const JointRow& row, double stress);

/// Stress, stiffness and energy at a closure, without tension cut-off.
struct NormalState
{
    double stress, stiffness, energy;  ///< [Pa], [Pa/m], [J/m2]
};
[[nodiscard]] NormalState normal_state(const JointRow& row, double closure);

/// Stress of a joint with a memory where nothing moves.
[[nodiscard]] JointStress stress_at_rest(const JointRow& row, double closure, double shear, double normal, JointMemory memory);

/// Memory of a joint that bears these stresses where it is drawn.
[[nodiscard]] JointMemory drawn_memory(const JointRow& row, double normal_stress, double shear_stress);

/// How far a joint has lost its roughness or its bond: 0 as drawn, 1 nothing left [-].
[[nodiscard]] double damage(const JointRow& row, const JointMemory& memory);

/// Greatest shear stress that a joint with a memory can reach under a normal stress, from where it is drawn [Pa].
[[nodiscard]] double peak_strength(const JointRow& row, double stress);
}  // namespace hdem
