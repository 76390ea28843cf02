#pragma once
/// Text files that users name: read whole, or not at all.

#include <cstddef>
#include <filesystem>
#include <string>

namespace hdem
{
struct TextFile
{
    std::string text;
    std::string obstacle;  ///< why there is no text, e.g. "does not exist"; empty when all is well
    std::string remedy;    ///< e.g. "Check its name."
};

/// A pipe is not read: whoever should write to it may never come. Nor is a device, which may have no end.
/// @param most  bytes; a larger file is not kept
[[nodiscard]] TextFile read_text_file(const std::filesystem::path& file, std::size_t most);
}  // namespace hdem
