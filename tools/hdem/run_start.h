#pragma once
/// How a run begins: anew from a case file, or again from a checkpoint.

#include "io/checkpoint.h"
#include "io/load_case.h"
#include "tools/hdem/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hdem
{
struct RunStart
{
    LoadedCase loaded;  ///< its state is the first one, or the checkpoint's
    RunRecord record;
    std::filesystem::path folder;  ///< of the results
    bool restarted = false;
    std::vector<std::string> notes;  ///< for the user
};

/// Throws InputError for what the user must change.
RunStart start_run(const RunOptions& options);

/// Throws InputError when the folder holds a run that was cut short and nothing says that it may go. Removes checkpoints and results of an
/// older run: they must not be taken for those of this one.
void clear_for_new_run(const std::filesystem::path& folder, bool overwrite);
}  // namespace hdem
