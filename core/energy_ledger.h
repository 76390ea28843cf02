#pragma once
/// Where the energy of a run came from and went.

#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
/// Energy now in the system, at the half step at which velocities are known [J].
struct StoredEnergy
{
    double kinetic = 0.0;
    double elastic_normal = 0.0;
    double elastic_shear = 0.0;
    double pending = 0.0;        ///< of elastic_normal, see SpringEnergies
    double one_step_fall = 0.0;  ///< kinetic energy that gravity and impulses give in one step, for scale
    [[nodiscard]] double total() const { return kinetic + elastic_normal + elastic_shear; }
};

/// Sum over all blocks and closed force points, in their order.
///
/// Velocities live half a step after the poses, so the energy of a spring is taken there too: 1/2 F(t) u(t + dt). With it
/// the undamped oscillator keeps its energy to rounding; 1/2 F u at one time swings by (omega dt)^2. In the cycles in which a spring closes or opens, this
/// differs from the energy in the spring by `pending`, which the next cycle makes up for. The ledger's sums explain total(); the energy in the
/// system is total() - pending.
[[nodiscard]] StoredEnergy stored_energy(const Model& model, const State& state);

/// Energy in the springs of one contact at the time of its last forces, 1/2 F u + 1/2 F_S^2 / (K_S L), whatever has moved since [J].
[[nodiscard]] double held_energy(const Model& model, const Contact& contact);

/// Sums over closed force points [J].
struct SpringEnergies
{
    double held = 0.0;  ///< as held_energy
    double shear =
        0.0;  ///< 1/2 F_S u_S at the same half step. Exact to second order in the rotation of a step, so only the split into terms is taken from here
    /// 1/2 F_N u(t + dt) less 1/2 K L u(t)+ u(t + dt)+, u+ = max(u, 0): not 0 only where the spring closes or opens (contact/closing.h).
    double pending = 0.0;
};

/// A force changes the velocity by half before and half after its time, so that its work in a cycle is exactly
///
///   W = 1/2 F v dt + 1/2 F v' dt      v, v' velocities before and after, along F at the poses at which F acts
///
/// The first half is known where the force is found, contact by contact. The second is summed block by block once the velocities are known
/// (EnergyLedger::coasting), so that no pose has to be turned back. With what the spring holds, 1/2 F u, the sum of all over a cycle leaves
///
///   1/2 (F(t - dt) u(t - dt) - F(t) (u(t) - v dt)) - 1/2 F(t - dt) v dt
///
/// which vanishes for a closed linear spring whose points go straight ahead. It is what closing or opening between two cycles, turning, a change of contact length
/// and a hand-over between regimes take (or give): the ledger's contact_changes. What a change of features does to the springs is there too.
template <typename R>
[[nodiscard]] inline R change_energy(R last_force, R last_overlap, R force, R overlap_before)
{
    return R(0.5) * (last_force * last_overlap - force * overlap_before);
}

/// Energy that came in less what is stored or spent; what the ledger cannot explain [J].
[[nodiscard]] double residual(const EnergyLedger& ledger, const StoredEnergy& stored);
/// The same as a share of the energy that went through: the largest of the ledger's terms, or of one step's fall where nothing moves [-].
[[nodiscard]] double relative_residual(const EnergyLedger& ledger, const StoredEnergy& stored);

/// Largest relative residual of a sound run: of springs alone, and with impulses [-]. Ten times as much is an error of the run.
inline constexpr double springs_residual = 1e-6;
inline constexpr double impulses_residual = 1e-4;
inline constexpr double wrong_residual = 10.0;

/// Remember the present residual if it is the worst so far, compared with its limit.
void watch_ledger(const Model& model, State& state);
}  // namespace hdem
