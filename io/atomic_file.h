#pragma once
/// Files that stand under their name complete or not at all, whenever a run is killed.

#include <filesystem>
#include <span>
#include <string_view>

namespace hdem
{
enum class Flush
{
    now,   ///< on the disk when the function returns
    later  ///< whole under its name for every program, also after this one was killed; on the disk after flush_folder()
};

/// Write `bytes` to a new file beside FILE (io/fresh_file.h), fsync, rename to FILE, fsync the folder: whoever opens FILE sees the old content or the new,
/// never a part. Makes the folder when it is missing.
/// With `previous`, an old FILE is kept under that name; one of the two is there at any moment.
/// Throws RunError with the file, the system's reason (disk full, no permission) and what may help; FILE is then as it was.
void write_atomically(const std::filesystem::path& file, std::span<const std::byte> bytes,
                      const std::filesystem::path& previous = {}, Flush flush = Flush::now);
void write_atomically(const std::filesystem::path& file, std::string_view text, Flush flush = Flush::now);

/// Bring all that was written with Flush::later to the disk, at once: one by one each file would wait for the disk.
/// Throws RunError as above.
void flush_folder(const std::filesystem::path& folder);

/// Remove FILE if it is there. Throws RunError as above.
void remove_file(const std::filesystem::path& file);
}  // namespace hdem
