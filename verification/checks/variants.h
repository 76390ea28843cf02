#pragma once
/// The ways each closed-form problem is solved: methods, damping, stiffness of the joint.

#include "verification/checks/case_run.h"

#include <string>
#include <vector>

namespace hdem::verification
{
struct Variant
{
    std::string method;
    std::string damping;  ///< preset
    double factor = 1.0;  ///< on both stiffnesses of the case file
    [[nodiscard]] std::string name() const;
    /// The paper's 5e-5 s, and a fourth of it at ten times the stiffness: whole cycles in every duration [s].
    [[nodiscard]] double step() const { return factor == 1.0 ? 5e-5 : 1.25e-5; }
    /// Overrides of method, damping, time step, and the stiffnesses 7e9 and 5e8 Pa/m times the factor.
    [[nodiscard]] Overrides overrides() const;
};

/// Three methods with `dynamic` damping and the hybrid one with its default, each at two stiffnesses.
[[nodiscard]] std::vector<Variant> all_variants();
/// The three methods with one damping preset, at two stiffnesses.
[[nodiscard]] std::vector<Variant> all_variants(const std::string& damping);

inline constexpr double normal_stiffness = 7e9;  ///< of the closed-form case files [Pa/m]
inline constexpr double shear_stiffness = 5e8;
inline constexpr double g = 9.81;
inline constexpr double density = 2700.0;
}  // namespace hdem::verification
