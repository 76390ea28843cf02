#include "tools/hdem/run_folder.h"

#include "io/atomic_file.h"
#include "io/frame_writer.h"
#include "io/hdf5_reader.h"
#include "io/text_file.h"
#include "tools/hdem/restart_point.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <memory>
#include <string_view>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

constexpr std::size_t longest_summary = 1'000'000'000;  // bytes

/// What a run writes, without frames. summary.json first: it tells of the others.
constexpr std::array files_of_run = {"summary.json", "checkpoint.h5", "checkpoint.previous.h5", "trials.json", "results.h5",
                                     "view.html",    "report.html"};
constexpr std::array parts_of_search = {"before_last_stage", "failure"};  // folders that hdem fos writes

[[noreturn]] void refuse(const fs::path& file, const std::string& what)
{
    throw InputError(Problem{.key = {}, .text = fmt::format("{}: {}", printable(file.string(), 300), what)});
}

bool has_factor(const fs::path& summary)
{
    const auto read = nlohmann::json::parse(read_text_file(summary, longest_summary).text, nullptr, false);
    return read.is_object() && read.contains("factor_of_safety");
}

void refuse_searches(const fs::path& folder)
{
    const fs::path trials = folder / "trials.json";
    if (!fs::exists(trials))
        return;
    if (!fs::exists(folder / "results.h5"))
        refuse(trials, "(is of hdem critical, whose search this folder holds). Give another folder with -o, or --overwrite.");
    if (!has_factor(folder / "summary.json"))
        refuse(trials,
               "(the search for a factor of safety in this folder was cut short). hdem fos with the same case and --set goes on "
               "with it. Give another folder with -o, or begin anew with --overwrite.");
}

bool holds_results(const fs::path& folder)
try
{
    return !Hdf5Reader(folder / "results.h5").text("/provenance", "begin").empty();
}
catch (const std::exception&)
{
    return false;
}

bool holds_log(const fs::path& folder)
{
    std::array<char, 5> first = {};
    const bool is_file = fs::is_regular_file(fs::symlink_status(folder / "run.log"));
    return is_file && std::ifstream(folder / "run.log").read(first.data(), first.size()) &&
           std::string_view(first.data(), 5) == "hdem ";
}

bool holds_trials(const fs::path& folder)
{
    const auto read = nlohmann::json::parse(read_text_file(folder / "trials.json", longest_summary).text, nullptr, false);
    return read.is_object() && read.contains("question") && read.contains("trials");
}

/// Do the files here come from hdem? What another program or the user put here is not ours to remove.
bool is_of_hdem(const fs::path& folder)
{
    return holds_log(folder) || holds_results(folder) || can_be_read(checkpoint_file(folder)) || holds_trials(folder);
}

void refuse_if_filled(const fs::path& file)
{
    std::error_code missing;
    if (fs::is_regular_file(fs::symlink_status(file)) && fs::file_size(file, missing) > 0)  // a link goes, what it leads to stays
        refuse(file, "(no run of hdem has left its log or its results beside it: it may be somebody else's, and would be removed). "
                     "Move it away, write to another folder with -o, or remove it with --overwrite.");
}

/// Held while they are removed: a run may be in one of them.
std::vector<std::unique_ptr<RunLock>> lock_parts(const fs::path& folder)
{
    std::vector<std::unique_ptr<RunLock>> locks;
    for (const char* part : parts_of_search)
        if (fs::exists(folder / part))
            locks.push_back(std::make_unique<RunLock>(folder / part));
    return locks;
}

void remove_if_empty(const fs::path& part)
{
    std::error_code failed;
    fs::remove(part / "frames", failed);
    fs::remove(part, failed);
}

void remove_files_of_run(const fs::path& folder)
{
    for (const char* name : files_of_run)
        remove_file(folder / name);
    remove_frames(folder);
}

/// @return what is replaced, where that is not what this run will write again
std::vector<std::string> refuse_unfinished_run(const RunStart& start)
{
    const fs::path& folder = start.folder;
    const fs::path checkpoint = checkpoint_file(folder);
    if (!fs::exists(checkpoint))
        return {};
    if (!can_be_read(checkpoint))
        refuse(checkpoint, "(cannot be read). Write to another folder with -o, or begin anew with --overwrite.");
    const CheckpointReader reader(checkpoint);
    const RunRecord& before = reader.record();
    if (!before.finished)
        refuse(checkpoint,
               fmt::format("(the run in this folder was cut short, its last checkpoint is of cycle {}). Go on with --restart {}, "
                           "write to another folder with -o, or begin anew with --overwrite.",
                           reader.cycle(), folder.string()));
    std::vector<std::string> notes;
    if (before.case_text != start.record.case_text || before.overrides != start.record.overrides)
        notes.push_back(fmt::format("note      the results of {} in this folder, begun at {}, are replaced",
                                    printable(before.case_file, 200), before.begin));
    if (has_factor(folder / "summary.json"))
        notes.push_back("note      the factor of safety in this folder is replaced");
    return notes;
}
}  // namespace

void refuse_factor(const fs::path& folder)
{
    if (has_factor(folder / "summary.json"))
        refuse(folder / "summary.json",
               "(holds the factor of safety that hdem fos found, and a run that goes on here would remove it). Give another folder "
               "with -o.");
}

void refuse_files_of_others(const fs::path& folder)
{
    if (is_of_hdem(folder))
        return;
    for (const char* name : files_of_run)
        refuse_if_filled(folder / name);
    refuse_if_filled(folder / "run.log");
    std::error_code missing;
    for (const fs::directory_entry& frame : fs::directory_iterator(folder / "frames", missing))
        if (frame.path().extension() == ".hdf")
            refuse_if_filled(frame.path());
}

void check_folder(const fs::path& folder)
{
    for (const char* name : {"frames", "before_last_stage", "failure"})
    {
        const fs::file_status status = fs::symlink_status(folder / name);
        if (fs::is_symlink(status))
            refuse(folder / name,
                   "(is a link: files of another run may lie behind it). Remove it, or make a link of the whole folder.");
        if (fs::exists(status) && !fs::is_directory(status))
            refuse(folder / name, "(is no folder, and one is to be made). Move it away, or write to another folder with -o.");
    }
    for (const char* name : {"summary.json", "checkpoint.h5", "checkpoint.previous.h5", "results.h5", "run.log", "trials.json",
                             "view.html", "report.html"})
        if (fs::is_directory(fs::symlink_status(folder / name)))
            refuse(folder / name,
                   "(is a folder, where a file is to be written). Move it away, or write to another folder with -o.");
}

std::vector<std::string> clear_for_run(const RunStart& start, bool overwrite)
{
    const fs::path& folder = start.folder;
    if (start.restarted && !start.moved)
        return {};
    check_folder(folder);
    std::vector<std::string> notes;
    if (!overwrite)
    {
        notes = refuse_unfinished_run(start);
        refuse_searches(folder);
        refuse_files_of_others(folder);
    }
    const bool is_ours = overwrite || is_of_hdem(folder);
    {
        const std::vector<std::unique_ptr<RunLock>> held = is_ours ? lock_parts(folder) : std::vector<std::unique_ptr<RunLock>>{};
        remove_files_of_run(folder);
        for (const std::unique_ptr<RunLock>& lock : held)
            remove_files_of_run(lock->folder());
    }
    for (const char* part : parts_of_search)
        remove_if_empty(folder / part);
    return notes;
}

void remove_run(const fs::path& folder)
{
    if (!fs::exists(folder))
        return;
    {
        const RunLock lock(folder);
        remove_files_of_run(folder);
    }
    remove_if_empty(folder);
}
}  // namespace hdem
