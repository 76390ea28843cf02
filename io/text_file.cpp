#include "io/text_file.h"

#include <fmt/format.h>

#include <fstream>

namespace hdem
{
namespace
{
TextFile unreadable(std::string obstacle, std::string remedy)
{
    return {.text = {}, .obstacle = std::move(obstacle), .remedy = std::move(remedy)};
}
}  // namespace

TextFile read_text_file(const std::filesystem::path& file, std::size_t most)
{
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(file, ignored);
    if (!std::filesystem::status_known(status))
        return unreadable("cannot be opened", "Check the rights of its folder.");
    if (!std::filesystem::exists(status))
        return unreadable("does not exist", "Check its name.");
    if (std::filesystem::is_directory(status))
        return unreadable("is a folder", "Give a file in it.");
    if (!std::filesystem::is_regular_file(status))
        return unreadable("is a pipe, a socket or a device", "Write the text to a file first, and give that.");
    const auto too_large = [most]
    {
        return unreadable(fmt::format("larger than {} bytes", most),
                          "Make it smaller; a case may have its blocks in a blocks_file of their own.");
    };
    if (const auto size = std::filesystem::file_size(file, ignored); !ignored && size > most)
        return too_large();
    std::ifstream in(file, std::ios::binary);
    if (!in)
        return unreadable("cannot be opened", "Check its rights.");
    TextFile read;
    std::string piece(1U << 16U, '\0');
    while (read.text.size() <= most && (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0))
        read.text.append(piece, 0, static_cast<std::size_t>(in.gcount()));
    if (read.text.size() > most)
        return too_large();
    return read;
}
}  // namespace hdem
