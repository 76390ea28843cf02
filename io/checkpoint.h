#pragma once
/// Checkpoints: everything a run needs to go on as if it had never stopped, in one file.

#include "core/model/model.h"
#include "core/state/state.h"
#include "io/case_reader.h"
#include "io/hdf5_reader.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hdem
{
/// What a run is, besides its state: where it comes from, and what those who watch it remember.
struct RunRecord
{
    std::string case_file;               ///< as given on the command line
    std::string case_text;               ///< whole, as read
    NamedFiles files;                    ///< that the case names
    std::vector<std::string> overrides;  ///< key.path=value, also for --method
    std::string begin;                   ///< of the run, UTC
    std::vector<std::string> restarts;   ///< "UTC cycle", one for each
    std::vector<std::string> warnings;   ///< of the state at the start, for the summary at the end
    double wall_seconds = 0.0;           ///< spent until now [s]
    bool finished = false;               ///< the run came to its end
    std::vector<Vec2> history_axes;      ///< of RunRecorder
};

/// FOLDER/checkpoint.h5, and FOLDER/checkpoint.previous.h5, the one before it.
std::filesystem::path checkpoint_file(const std::filesystem::path& folder);
std::filesystem::path previous_checkpoint_file(const std::filesystem::path& folder);

/// Write FOLDER/checkpoint.h5; the one that was there becomes the previous one. Throws RunError when that fails; both are then as they were.
/// @pre a stage has begun
void write_checkpoint(const std::filesystem::path& folder, const RunRecord& record, const Model& model, const State& state);

/// Reads files that somebody else may have made or damaged. All its members throw InputError with the file, what is wrong, and a remedy.
/// @see verification/unit/io/checkpoint_test.cpp
class CheckpointReader
{
  public:
    /// Refuses what is not a checkpoint, and layouts of another major version.
    explicit CheckpointReader(const std::filesystem::path& file);

    [[nodiscard]] const RunRecord& record() const { return record_; }
    [[nodiscard]] std::int64_t cycle() const { return cycle_; }

    /// The state, for a model made of the record's case: its blocks are brought into the order they had in the run.
    [[nodiscard]] State state(Model& model) const;

  private:
    Hdf5Reader file_;
    std::string name_;
    RunRecord record_;
    std::uint64_t model_hash_ = 0;
    std::int64_t cycle_ = 0;
};
}  // namespace hdem
