#pragma once
/// Pictures of a state for ParaView and for tools/plot.py: one VTKHDF file for the blocks, one for the contacts, one for the bolts, one for the linings.

#include "core/model/model.h"
#include "core/state/state.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hdem
{
struct Frame
{
    int number = 0;  ///< NNNNNN of its files
    std::int64_t cycle = 0;
    double time = 0.0;               ///< [s]
    std::string stage;               ///< name
    std::vector<std::string> kinds;  ///< that it has files of: "blocks", "contacts", ...
};

/// Files: FOLDER/frames/blocks_NNNNNN.hdf, contacts_NNNNNN.hdf, bolts_NNNNNN.hdf and liners_NNNNNN.hdf, and FOLDER/blocks.hdf.series and so on, which
/// name them with their times. The layout stands in io/hdf5_format.md. Every file is complete or not there; the series
/// names complete files only. All are written with Flush::later: results.h5 brings them to the disk.
/// @see verification/unit/io/frame_writer_test.cpp
class FrameWriter
{
  public:
    /// Contact frames are written when model.output.contacts says so, frames of bolts and linings where the case has any. Frames of an earlier run in the folder are removed.
    FrameWriter(std::filesystem::path folder, const Model& model);
    /// To go on after a restart at `state`: frames of the folder that are not younger than it stay, the others leave the series.
    /// A file that cannot be read leaves it too; it counts as younger when its number does.
    FrameWriter(std::filesystem::path folder, const Model& model, const State& state);
    /// Remove the files of frames younger than the restart, once nothing names them any more.
    void remove_younger_frames();

    const Frame& write(const Model& model, const State& state);
    /// The .series of all frames until now.
    void write_series() const;

    [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }
    /// "blocks", and "contacts", "bolts" and "liners" where they are written, or were before a restart
    [[nodiscard]] const std::vector<std::string>& kinds() const { return kinds_; }

  private:
    void take(const Frame& frame, const std::string& kind);
    void write_series(const std::string& kind) const;

    std::filesystem::path folder_;
    std::vector<std::string> kinds_;
    std::vector<Frame> frames_;
    std::vector<std::filesystem::path> younger_;  ///< files of frames that a restart does away with
};

/// Remove the frames in a folder, and first the series that name them.
void remove_frames(const std::filesystem::path& folder);

/// "frames/blocks_000012.hdf": where a frame lies in the run's folder. kind: "blocks", "contacts", "bolts" or "liners"
std::string frame_file(const std::string& kind, int number);

/// One file each. Throw RunError when it cannot be written.
void write_block_frame(const std::filesystem::path& file, const Model& model, const State& state);
void write_contact_frame(const std::filesystem::path& file, const Model& model, const State& state);
void write_bolt_frame(const std::filesystem::path& file, const Model& model, const State& state);
void write_liner_frame(const std::filesystem::path& file, const Model& model, const State& state);
}  // namespace hdem
