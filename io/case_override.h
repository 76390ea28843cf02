#pragma once
/// `--set key.path=value`: values from the command line laid over a case file.

#include "core/check.h"
#include "io/case_source.h"
#include "io/toml_tree.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hdem
{
struct Override
{
    std::string key;    ///< "joint.default.friction_angle_deg", "stage[1].max_cycles", "joint_set.bedding.dip_deg"
    std::string value;  ///< TOML, a bare word taken as text, or one number as the length of a vector (a force, a velocity)
};

/// Splits "key=value" at the first '='. Throws InputError when there is none.
Override parse_override(std::string_view argument);

/// Writes the values into the document, as if the file said them; their places name the --set. Whether the keys exist in the
/// schema is left to the reader. Returns located problems.
std::vector<Problem> apply_overrides(TomlNode& document, std::span<const Override> overrides, CaseSource& source);
}  // namespace hdem
