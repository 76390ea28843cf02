#pragma once
/// rest.*: what a stage that runs until it has converged makes of random scenes whose rest is known. See verification/rest.md.

#include "verification/checks/checks.h"

#include <filesystem>
#include <optional>

namespace hdem::verification
{
/// What the command line says about the scenes of rest.*.
struct RestOptions
{
    std::optional<int> scene;          ///< only this one, and all that was found of it
    std::optional<int> scenes;         ///< the first so many of each family
    std::filesystem::path write_case;  ///< folder for the case files of `scene`
};

/// Set once by the program.
RestOptions& rest_options();

std::vector<Check> rest_checks();
}  // namespace hdem::verification
