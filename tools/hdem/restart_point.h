#pragma once
/// The checkpoint that a run goes on from.

#include "io/checkpoint.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hdem
{
struct RestartPoint
{
    std::filesystem::path file;
    CheckpointReader reader;
    /// Checkpoints of the same folder that may not stay under their names, and the names they get.
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> aside{};
};

/// That a checkpoint lies in, or the folder given itself.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& given);

[[nodiscard]] bool can_be_read(const std::filesystem::path& checkpoint);

/// The checkpoint itself, or the last one of a folder that can be read. Throws InputError.
/// @param notes  for the user, behind those that are there
[[nodiscard]] RestartPoint find_checkpoint(const std::filesystem::path& given, std::vector<std::string>& notes);

/// A damaged checkpoint would soon take the place of the sound one; from a younger one a restart would go on without the rows and frames that are dropped now.
/// Once nothing can refuse the run any more.
void put_aside(const RestartPoint& point, std::vector<std::string>& notes);
}  // namespace hdem
