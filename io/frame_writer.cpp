#include "io/frame_writer.h"

#include "core/check.h"
#include "core/observer.h"
#include "io/atomic_file.h"
#include "io/hdf5_reader.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace hdem
{
namespace
{
/// Number of blocks_NNNNNN.hdf and the like, -1 for any other name (and for what a killed run left behind).
int frame_number(const std::string& file)
{
    for (const std::string kind : {"blocks_", "contacts_", "bolts_", "liners_"})
    {
        const std::string digits = file.substr(std::min(kind.size(), file.size()), 6);
        if (file == kind + digits + ".hdf" && digits.find_first_not_of("0123456789") == std::string::npos)
            return std::stoi(digits);
    }
    return -1;
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// Nothing for a file that was on its way to the disk when the power failed.
std::optional<Frame> read_frame(const std::filesystem::path& file)
try
{
    const Hdf5Reader in(file);
    return Frame{.number = frame_number(file.filename().string()),
                 .cycle = in.attribute<std::int64_t>("/hdem", "cycle", {}).front(),
                 .time = in.attribute<double>("/hdem", "time", {}).front(),
                 .stage = in.text("/hdem", "stage")};
}
catch (const RunError&)
{
    return std::nullopt;
}

std::vector<std::string> kinds_of(const Model& model)
{
    std::vector<std::string> kinds{"blocks"};
    if (model.output.contacts)
        kinds.emplace_back("contacts");
    if (!model.support.bolts.empty())
        kinds.emplace_back("bolts");
    if (!model.support.liners.empty())
        kinds.emplace_back("liners");
    return kinds;
}

/// Would the run have no frame of this cycle, had it gone on?
bool is_of_interruption(const Model& model, const State& state)
{
    return state.cycle > state.stage_begin_cycle && next_multiple(state.cycle - 1, model.output.frame_every) != state.cycle;
}
}  // namespace

void remove_frames(const std::filesystem::path& folder)
{
    for (const char* series : {"blocks.hdf.series", "contacts.hdf.series", "bolts.hdf.series", "liners.hdf.series"})
        remove_file(folder / series);
    for (const std::filesystem::path& file : files_in(folder / "frames"))
        if (frame_number(file.filename().string()) >= 0)
            remove_file(file);
}

std::string frame_file(const std::string& kind, int number)
{
    return fmt::format("frames/{}_{:06d}.hdf", kind, number);
}

FrameWriter::FrameWriter(std::filesystem::path folder, const Model& model) : folder_(std::move(folder)), kinds_(kinds_of(model))
{
    remove_frames(folder_);
}

FrameWriter::FrameWriter(std::filesystem::path folder, const Model& model, const State& state)
    : folder_(std::move(folder)),
      kinds_(kinds_of(model))
{
    for (const std::filesystem::path& file : files_in(folder_ / "frames"))
    {
        const std::string name = file.filename().string();
        if (frame_number(name) < 0)
            continue;
        const std::optional<Frame> frame = read_frame(file);
        if (!frame || frame->cycle > state.cycle || (frame->cycle == state.cycle && is_of_interruption(model, state)))
            younger_.push_back(file);
        else
            take(*frame, name.substr(0, name.find('_')));
    }
    const int last = frames_.empty() ? -1 : frames_.back().number;
    std::erase_if(younger_,
                  [&](const auto& file) { return frame_number(file.filename().string()) <= last; });  // older, but damaged
    write_series();
}

/// Files come by their names: those of blocks first.
void FrameWriter::take(const Frame& frame, const std::string& kind)
{
    if (kind == "blocks")
        frames_.push_back(frame);
    const auto it = std::ranges::find(frames_, frame.number, &Frame::number);
    if (it == frames_.end())
        return;
    it->kinds.push_back(kind);
    if (std::ranges::find(kinds_, kind) == kinds_.end())
        kinds_.push_back(kind);
}

void FrameWriter::remove_younger_frames()
{
    for (const std::filesystem::path& file : younger_)
        remove_file(file);
    younger_.clear();
}

const Frame& FrameWriter::write(const Model& model, const State& state)
{
    const int number = frames_.empty() ? 0 : frames_.back().number + 1;
    Frame frame{.number = number, .cycle = state.cycle, .time = state.time, .stage = {}, .kinds = kinds_of(model)};
    if (state.stage >= 0 && static_cast<std::size_t>(state.stage) < model.stages.size())
        frame.stage = model.stages[static_cast<std::size_t>(state.stage)].name;
    if (model.output.contacts)
        write_contact_frame(folder_ / frame_file("contacts", number), model, state);
    if (!model.support.bolts.empty())
        write_bolt_frame(folder_ / frame_file("bolts", number), model, state);
    if (!model.support.liners.empty())
        write_liner_frame(folder_ / frame_file("liners", number), model, state);
    write_block_frame(folder_ / frame_file("blocks", number), model, state);
    frames_.push_back(std::move(frame));
    return frames_.back();
}

void FrameWriter::write_series() const
{
    for (const std::string& kind : kinds_)
        write_series(kind);
}

void FrameWriter::write_series(const std::string& kind) const
{
    nlohmann::ordered_json series = {{"file-series-version", "1.0"}, {"files", nlohmann::ordered_json::array()}};
    for (const Frame& frame : frames_)
        if (std::ranges::find(frame.kinds, kind) != frame.kinds.end())
            series["files"].push_back({{"name", frame_file(kind, frame.number)}, {"time", frame.time}});
    write_atomically(folder_ / (kind + ".hdf.series"), series.dump(1) + "\n", Flush::later);
}
}  // namespace hdem
