#pragma once
/// Which hdem this is and how it was built. Written into every result, so that a number can be traced to its program.

#include <string>
#include <string_view>

namespace hdem
{
struct Version
{
    std::string_view number;      ///< "0.2.0"
    std::string_view commit;      ///< full git hash, "unknown" without a git checkout
    bool dirty = false;           ///< tracked files differed from the commit
    std::string_view compiler;    ///< "GNU 12.2.0"
    std::string_view flags;       ///< compiler flags except warnings
    std::string_view build_type;  ///< "Release"
};

/// Version of the library this program is linked with.
[[nodiscard]] const Version& version();

/// One line for a screen or a log, e.g. "hdem 0.2.0 (1a2b3c4d5e, changed; GNU 12.2.0, Release)".
[[nodiscard]] std::string version_line();
}  // namespace hdem
