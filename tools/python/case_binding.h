#pragma once
/// A case that has been read and whose blocks have been made.

#include "io/load_case.h"
#include "tools/python/block_arrays.h"
#include "tools/python/made_only.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
struct BuiltCase
{
    std::shared_ptr<const LoadedCase> loaded;
    std::vector<std::string> overrides;

    [[nodiscard]] Look look() const { return {loaded->setup.model, loaded->setup.state}; }
};

/// @param text  of the case; none: the file is read
/// @param file  its name in messages; other files are looked up beside it,
/// @param files  or here, when given
[[nodiscard]] BuiltCase build_case(const std::optional<std::string>& text, const std::string& file,
                                   std::vector<std::string> overrides, const NamedFiles* files = nullptr);
}  // namespace hdem

template <>
class pybind11::detail::type_caster<hdem::BuiltCase> : public hdem::CasterOfMade<hdem::BuiltCase>
{
};
