#include "tools/hdem/run_folder.h"

#include "io/atomic_file.h"
#include "io/frame_writer.h"
#include "io/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

constexpr std::size_t longest_summary = 1'000'000'000;  // bytes

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

/// @return whose results are replaced, where they are those of another case
std::vector<std::string> refuse_unfinished_run(const RunStart& start)
{
    const fs::path& folder = start.folder;
    const fs::path checkpoint = checkpoint_file(folder);
    if (!fs::exists(checkpoint))
        return {};
    std::optional<CheckpointReader> reader;
    try
    {
        reader.emplace(checkpoint);
    }
    catch (const InputError&)
    {
        refuse(checkpoint, "(cannot be read). Write to another folder with -o, or begin anew with --overwrite.");
    }
    if (!reader->record().finished)
        refuse(checkpoint,
               fmt::format("(the run in this folder was cut short, its last checkpoint is of cycle {}). Go on with --restart {}, "
                           "write to another folder with -o, or begin anew with --overwrite.",
                           reader->cycle(), folder.string()));
    if (reader->record().case_text == start.record.case_text)
        return {};
    return {fmt::format("note      the results of {} in this folder, begun at {}, are replaced",
                        printable(reader->record().case_file, 200), reader->record().begin)};
}
}  // namespace

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
    }
    remove_file(folder / "summary.json");  // first what tells of the others
    remove_file(checkpoint_file(folder));
    remove_file(previous_checkpoint_file(folder));
    remove_file(folder / "trials.json");
    for (const char* part : {"before_last_stage", "failure"})  // of hdem fos
        fs::remove_all(folder / part);
    remove_file(folder / "results.h5");  // it names frames that are about to go
    remove_frames(folder);
    for (const char* page : {"view.html", "report.html"})  // they would show the run before
        remove_file(folder / page);
    return notes;
}
}  // namespace hdem
