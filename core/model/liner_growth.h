#pragma once
/// Loads of a lining that grow from its installation on.

#include "core/model/support.h"

#include <algorithm>
#include <cstdint>

namespace hdem
{
/// Over so many cycles the weight grows. Applied at once it would make the lining swing, and fall off even if its bond bears 1.6 times the weight.
inline constexpr std::int64_t liner_weight_cycles = 500;

/// Share that is reached at an age, of a load that grows over so many cycles [-].
[[nodiscard]] inline double grown_share(std::int64_t over, std::int64_t age)
{
    return age < over ? static_cast<double>(age) / static_cast<double>(over) : 1.0;
}

/// Factor of modulus and strengths: linear between rows, constant before and behind them.
[[nodiscard]] inline double hardening_at(const Liner& liner, std::int64_t cycles)
{
    if (liner.hardening.empty())
        return 1.0;
    const auto age = static_cast<double>(cycles);
    const auto next = std::ranges::find_if(liner.hardening, [&](const auto& row) { return row[0] > age; });
    if (next == liner.hardening.begin())
        return (*next)[1];
    const auto& last = *std::prev(next);
    if (next == liner.hardening.end())
        return last[1];
    return last[1] + ((*next)[1] - last[1]) * (age - last[0]) / ((*next)[0] - last[0]);
}

/// Age from which on hardening changes nothing.
[[nodiscard]] inline std::int64_t hardened_at(const Liner& liner)
{
    return liner.hardening.empty() ? 0 : static_cast<std::int64_t>(liner.hardening.back()[0]);
}

/// Age up to which a liner may begin to move: its weight or its pressure grows, or its strength falls. Hardening changes no forces.
[[nodiscard]] inline std::int64_t settled_at(const Liner& liner)
{
    const auto weaker = [](const auto& a, const auto& b) { return b[1] < a[1]; };
    const bool falls = std::ranges::adjacent_find(liner.hardening, weaker) != liner.hardening.end();
    return std::max({liner_weight_cycles, liner.pressure != 0.0 ? liner.pressure_cycles : 0, falls ? hardened_at(liner) : 0});
}
}  // namespace hdem
