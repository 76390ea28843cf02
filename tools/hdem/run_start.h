#pragma once
/// How a run begins: anew from a case file, or again from a checkpoint.

#include "io/checkpoint.h"
#include "io/load_case.h"
#include "io/run_lock.h"
#include "tools/hdem/options.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hdem
{
struct RunStart
{
    LoadedCase loaded;  ///< its state is the first one, or the checkpoint's
    RunRecord record;
    std::filesystem::path folder;   ///< of the results
    std::unique_ptr<RunLock> lock;  ///< on that folder
    bool restarted = false;
    bool moved = false;              ///< restarted from a checkpoint of another folder
    std::vector<std::string> notes;  ///< for the user
};

/// Throws InputError for what the user must change, also when another run is in the folder.
RunStart start_run(const RunOptions& options);

/// The same of a case that has been read already; --set stands in it. Its folder is options.folder.
RunStart start_loaded(LoadedCase loaded, std::vector<std::string> overrides, const RunOptions& options);

/// A case and the state that a checkpoint file holds, without the folder of the run. Throws InputError.
RunStart read_moment(const std::filesystem::path& checkpoint);
}  // namespace hdem
