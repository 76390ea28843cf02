#pragma once
/// All checks of hdem_verify. Each group of problems stands in a file of its own.

#include "verification/checks/report.h"

#include <array>
#include <string>
#include <vector>

namespace hdem::verification
{
struct Check
{
    enum class Length
    {
        is_short,  ///< part of `ctest`
        is_long    ///< more than about twenty seconds
    };
    std::string name;  ///< "paper.table2", "closed_form.A1"
    std::string what;
    void (*run)(Report&) = nullptr;
    Length length = Length::is_short;
};

inline constexpr std::array<const char*, 3> all_methods{"force", "impulse", "hybrid"};

std::vector<Check> static_block_checks();
std::vector<Check> bounce_checks();
std::vector<Check> transition_checks();
std::vector<Check> tunnel_checks();
std::vector<Check> sliding_checks();
std::vector<Check> column_checks();
std::vector<Check> wall_checks();
std::vector<Check> stability_checks();
std::vector<Check> cyclic_shear_checks();
std::vector<Check> order_checks();
std::vector<Check> ledger_checks();
std::vector<Check> recycling_checks();
std::vector<Check> robust_checks();
std::vector<Check> insitu_checks();
std::vector<Check> joint_checks();
std::vector<Check> stage_end_checks();
std::vector<Check> water_checks();
std::vector<Check> fos_checks();
std::vector<Check> support_checks();
std::vector<Check> liner_checks();
std::vector<Check> large_model_checks();
std::vector<Check> rock_mass_checks();
std::vector<Check> static_rock_checks();

/// In the order of the table.
std::vector<Check> all_checks();
}  // namespace hdem::verification
