#pragma once
/// What module.cpp puts together.

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <optional>

namespace hdem
{
inline constexpr int most_threads = 4096;  ///< as of hdem run --threads

/// Throws ValueError.
inline void check_threads(const std::optional<int>& threads)
{
    if (threads && (*threads < 1 || *threads > most_threads))
        throw pybind11::value_error(
            fmt::format("threads = {} (must be 1 to {}). Give None for as many as are fastest.", *threads, most_threads));
}

void bind_case(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_factor(pybind11::module_& module);
}  // namespace hdem
