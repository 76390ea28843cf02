#include "io/checkpoint.h"

#include "core/check.h"
#include "core/state/state_hash.h"
#include "core/version.h"
#include "io/provenance.h"
#include "io/state_archive.h"

#include <fmt/format.h>

#include <cmath>

namespace hdem
{
namespace
{
constexpr const char* file_type = "hdem-checkpoint";
const std::vector<std::int64_t> layout = {2, 8};  // a state goes on with the program that knows all of it: others are refused

void write_record(Hdf5Writer& file, const RunRecord& record)
{
    std::vector<std::string> names, texts;
    for (const auto& [name, text] : record.files)
    {
        names.push_back(name);
        texts.push_back(text);
    }
    file.make_group("/case");
    file.set_text("/case", "file", record.case_file);
    file.write_texts("/case/text", {record.case_text});
    file.write_texts("/case/overrides", record.overrides);
    file.write_texts("/case/file_names", names);
    for (std::size_t i = 0; i < texts.size(); ++i)
        file.write_texts(fmt::format("/case/files/{}", i), {texts[i]});
    file.make_group("/run");
    file.set_text("/run", "begin", record.begin);
    file.write_texts("/run/restarts", record.restarts);
    file.write_texts("/run/warnings", record.warnings);
    file.set_attribute("/run", "wall_seconds", record.wall_seconds);
    file.set_attribute("/run", "finished", static_cast<std::uint8_t>(record.finished));
    std::vector<double> axes;
    for (const Vec2& axis : record.history_axes)
        axes.insert(axes.end(), {axis.x(), axis.y()});
    file.write("/run/history_axes", axes, {record.history_axes.size(), 2});
}

std::string one_text(const Hdf5Reader& file, const std::string& path)
{
    std::vector<std::string> texts = file.read_texts(path);
    if (texts.size() != 1)
        file.fail(path, "not one text");
    return std::move(texts.front());
}

RunRecord read_record(const Hdf5Reader& file)
{
    RunRecord record;
    record.case_file = file.text("/case", "file");
    record.case_text = one_text(file, "/case/text");
    record.overrides = file.read_texts("/case/overrides");
    const std::vector<std::string> names = file.read_texts("/case/file_names");
    for (std::size_t i = 0; i < names.size(); ++i)
        record.files.emplace(names[i], one_text(file, fmt::format("/case/files/{}", i)));
    record.begin = file.text("/run", "begin");
    record.restarts = file.read_texts("/run/restarts");
    if (file.has("/run/warnings"))  // not in those of earlier programs
        record.warnings = file.read_texts("/run/warnings");
    record.wall_seconds = file.attribute<double>("/run", "wall_seconds", {}).front();
    record.finished = file.attribute<std::uint8_t>("/run", "finished", {}).front() != 0;
    const auto axes = file.read<double>("/run/history_axes", {any_extent, 2});
    for (std::size_t i = 0; i < axes.size(); i += 2)
        record.history_axes.emplace_back(axes[i], axes[i + 1]);
    const auto is_finite = [](const Vec2& axis) { return axis.allFinite(); };
    if (!(record.wall_seconds >= 0.0) || !std::all_of(record.history_axes.begin(), record.history_axes.end(), is_finite))
        file.fail("/run", "not finite numbers: the file is damaged");
    return record;
}

void check_version(const Hdf5Reader& file, const std::string& name)
{
    if (!file.has_attribute("/", "filetype") || file.text("/", "filetype") != file_type)
        file.fail("/@filetype", "not a checkpoint of hdem");
    const auto found = file.attribute<std::int64_t>("/", "version", {2});
    if (found != layout)
        throw InputError(
            Problem{.key = {},
                    .text = fmt::format(
                        "{}: version = {}.{} (this hdem {} reads version {}.{}). Go on with the hdem that wrote it: {}, commit {}.",
                        name, found[0], found[1], version().number, layout[0], layout[1], file.text("/", "hdem_version"),
                        file.text("/", "git_commit"))});
}

/// Calls `read`; whatever it finds wrong with the file becomes an error of the input.
template <typename Read>
auto checked(const std::filesystem::path& file, const Read& read)
{
    try
    {
        return read();
    }
    catch (const RunError& error)
    {
        const std::filesystem::path previous = previous_checkpoint_file(file.parent_path());
        const bool has_other = previous.filename() != file.filename() && std::filesystem::exists(previous);
        throw InputError(
            Problem{.key = {},
                    .text = std::string(error.what()) + (has_other ? " Give another checkpoint: " + previous.string() + "."
                                                                   : " Give another checkpoint, or begin the run anew.")});
    }
}
}  // namespace

std::filesystem::path checkpoint_file(const std::filesystem::path& folder)
{
    return folder / "checkpoint.h5";
}

std::filesystem::path previous_checkpoint_file(const std::filesystem::path& folder)
{
    return folder / "checkpoint.previous.h5";
}

void write_checkpoint(const std::filesystem::path& folder, const RunRecord& record, const Model& model, const State& state)
{
    Hdf5Writer file(checkpoint_file(folder));
    file.set_text("/", "filetype", file_type);
    file.set_attribute("/", "version", layout);
    file.set_text("/", "hdem_version", version().number);
    file.set_text("/", "git_commit", version().commit);
    file.set_text("/", "date_and_time", timestamp());
    file.set_attribute("/", "model_hash", model_hash(model));
    write_record(file, record);
    save_state(model, state, file);
    file.commit(previous_checkpoint_file(folder));
}

CheckpointReader::CheckpointReader(const std::filesystem::path& file)
    : file_(checked(file, [&] { return Hdf5Reader(file); })),
      name_(file.string())
{
    checked(file,
            [&]
            {
                check_version(file_, name_);
                record_ = read_record(file_);
                model_hash_ = file_.attribute<std::uint64_t>("/", "model_hash", {}).front();
                cycle_ = file_.attribute<std::int64_t>("/state", "cycle", {}).front();
            });
}

State CheckpointReader::state(Model& model) const
{
    return checked(
        name_,
        [&]
        {
            if (model_hash(model) != model_hash_)
                throw InputError(
                    Problem{.key = {},
                            .text = fmt::format(
                                "{}: model_hash (this hdem {}, commit {}, makes other blocks, joints or another time step of the "
                                "checkpoint's case). Go on with the hdem that wrote it: {}, commit {}.",
                                name_, version().number, version().commit, file_.text("/", "hdem_version"),
                                file_.text("/", "git_commit"))});
            State state = load_state(file_, model);
            if (record_.history_axes.size() != model.histories.size())
                file_.fail("/run/history_axes", "not one for each history of the case");
            return state;
        });
}
}  // namespace hdem
