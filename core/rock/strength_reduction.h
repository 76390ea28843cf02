#pragma once
/// Joint laws with their strength divided by a factor.

#include "core/model/model.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hdem
{
/// How the laws of a case are changed.
struct StrengthReduction
{
    double factor = 1.0;               ///< F
    std::vector<std::uint8_t> joints;  ///< per [joint.NAME]: is its strength divided? Empty: of all
    bool bolts = false;                ///< the strength of bolts is divided too
    bool keeps_peak = false;           ///< no strength is lost by breaking, slip or wear: residual values are the peak ones
    double stiffness = 1.0;            ///< normal and shear stiffness are multiplied by this
};

/// The laws of `table`, those of blocks that have met since the start included:
///
///   coulomb                 tan phi / F, c / F, T / F; residual values likewise
///   patton                  tan(phi + i) / F, tan phi_r / F, c_x / F
///   others                  tau_max / F: all of the envelope
///
/// Dilation and, but for `stiffness`, springs stay as they are.
/// `keeps_peak`: `keep_peak` of each law (core/joint). The residual values of coulomb become the peak ones; asperities do not wear. A law without
/// that function has nothing to lose, or its curve has its peak in it (barton_bandis).
/// @see verification/unit/core/rock/strength_reduction_test.cpp
[[nodiscard]] StageLaws reduced_laws(const JointTable& table, const StrengthReduction& how);

/// Divide the strength of bolts: axial, across, and of their bond.
void weaken_bolts(Support& support, double factor);

/// Has any of these joints a strength that slip or breaking takes?
[[nodiscard]] bool loses_strength(const JointTable& table, const std::vector<std::uint8_t>& joints);

/// Greatest F at which dilation of each joint takes no more work than its reduced friction gives; slip above it would make energy. Infinite where nothing dilates.
[[nodiscard]] double greatest_factor_for_dilation(const JointTable& table, const std::vector<std::uint8_t>& joints);
}  // namespace hdem
