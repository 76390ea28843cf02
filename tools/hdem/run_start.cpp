#include "tools/hdem/run_start.h"

#include "core/stage/load_changes.h"
#include "core/stage/rules.h"
#include "io/hdf5_reader.h"
#include "io/provenance.h"
#include "io/text_file.h"
#include "tools/hdem/restart_point.h"
#include "tools/hdem/run_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <span>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& text)
{
    throw InputError(Problem{.key = {}, .text = text});
}

std::vector<Override> parsed(const std::vector<std::string>& texts)
{
    std::vector<Override> overrides;
    for (const std::string& text : texts)
        overrides.push_back(parse_override(text));
    return overrides;
}

/// --set and --method, as a case would say them.
std::vector<std::string> overrides_of(const RunOptions& options)
{
    std::vector<std::string> texts = options.overrides;
    if (options.method)
        texts.push_back("contact.method=\"" + *options.method + '"');
    return texts;
}

/// What is known of a case once it has been read.
void take_case(LoadedCase loaded, RunStart& start)
{
    start.loaded = std::move(loaded);
    start.record.case_file = start.loaded.file.source.file();
    start.record.case_text = start.loaded.file.source.text();
    start.record.files = start.loaded.file.files;
    start.record.begin = timestamp();
}

/// A stage may have a method of its own, which --method would not reach.
void check_methods(const RunOptions& options, const Model& model)
{
    if (!options.method)
        return;
    for (const StageDef& stage : model.stages)
        if (stage.method && std::string(name_of(*stage.method)) != *options.method)
            refuse(fmt::format("--method {}: (stage \"{}\" has method = \"{}\" of its own). Leave --method away, or give --set "
                               "stage.{}.method={} as well.",
                               *options.method, printable(stage.name, 60), name_of(*stage.method), printable(stage.name, 60),
                               *options.method));
}

RunStart start_anew(const RunOptions& options)
{
    RunStart start;
    start.folder = options.folder.empty() ? fs::path(fs::path(options.case_file).stem()) : fs::path(options.folder);
    start.record.overrides = overrides_of(options);
    start.lock = std::make_unique<RunLock>(start.folder);
    take_case(load_case(options.case_file, parsed(start.record.overrides)), start);
    check_methods(options, start.loaded.setup.model);
    return start;
}

/// May a run that goes on have another value? Everything but what says how far it goes and what is written.
bool is_free_to_change(const std::string& key)
{
    const std::string section = key.substr(0, key.find_first_of(".["));
    const auto dot = std::min(key.rfind('.'), key.size());
    const bool is_of_one_stage = section == "stage" && dot > section.size();  // stage[1].cycles or stage.NAME.cycles
    const std::string name = key.substr(std::min(dot, key.size() - 1) + 1);
    return section == "output" || section == "convergence" ||
           (is_of_one_stage && (name == "cycles" || name == "max_cycles" || name == "duration"));
}

std::string last_word(const std::string& key)
{
    return key.substr(key.find_last_of(".]") + 1);
}

/// Is this what the case has already? Not where a later one may have changed the same number of a stage under its other name, stage[0] or stage.NAME.
bool is_said(const std::string& text, const std::vector<std::string>& overrides)
{
    const std::string key = parse_override(text).key;
    for (auto it = overrides.rbegin(); it != overrides.rend(); ++it)
    {
        const std::string before = parse_override(*it).key;
        if (before == key)
            return *it == text;
        if (before.starts_with("stage") && last_word(before) == last_word(key))
            return false;
    }
    return false;
}

/// Overrides given now, behind those the run began with.
std::vector<std::string> merged_overrides(const RunOptions& options, std::vector<std::string> overrides)
{
    const std::vector<std::string> at_first = overrides;
    for (const std::string& text : overrides_of(options))
    {
        const std::string key = parse_override(text).key;
        if (is_said(text, overrides))
            continue;
        if (!is_free_to_change(key))
            refuse(fmt::format(
                "{}: (a run that goes on keeps its blocks, joints and laws; it began with {}). Leave it away, or begin a "
                "new run. Free to change are output, convergence, and how long stages last.",
                text, at_first.empty() ? "the case file alone" : fmt::format("{}", fmt::join(at_first, ", "))));
        overrides.push_back(text);
    }
    return overrides;
}

/// Number of the stage that `key` belongs to, stage[1].cycles or stage.NAME.cycles.
std::optional<std::size_t> stage_of(const std::string& key, const std::vector<StageDef>& stages)
{
    if (key.starts_with("stage["))
        return std::stoul(key.substr(6));
    if (!key.starts_with("stage."))
        return std::nullopt;
    const std::string name = key.substr(6, key.rfind('.') - 6);
    const auto it = std::ranges::find(stages, name, &StageDef::name);
    return it != stages.end() ? std::optional(static_cast<std::size_t>(it - stages.begin())) : std::nullopt;
}

/// A stage that is over cannot last longer, and the last one of a finished run cannot be shorter than it was. (A smaller number ends a stage that runs.)
void check_stages_to_come(std::span<const std::string> overrides, const Setup& setup, bool is_finished)
{
    const Model& model = setup.model;
    const State& state = setup.state;
    for (const std::string& text : overrides)
    {
        const auto stage = stage_of(parse_override(text).key, model.stages);
        if (!stage || *stage >= model.stages.size())
            continue;
        const auto running = static_cast<std::size_t>(state.stage);
        const StageDef& def = model.stages[*stage];
        if (*stage < running)
            refuse(fmt::format("{}: (stage \"{}\" is over: the run is in stage \"{}\"). Leave it away, or begin a new run.",
                               printable(text, 60), printable(def.name, 60), printable(model.stages[running].name, 60)));
        if (is_finished && *stage == running && state.stage_begun &&
            last_cycle(def, state.stage_begin_cycle, model.time_step) < state.cycle)
            refuse(fmt::format("{}: (stage \"{}\" has lasted {} cycles already). Give more, or begin a new run.",
                               printable(text, 60), printable(def.name, 60), state.cycle - state.stage_begin_cycle));
    }
}

void check_same_case(const RunOptions& options, const RunRecord& record)
{
    if (options.case_file.empty())
        return;
    TextFile given = read_text_file(options.case_file, largest_case_file);
    if (given.obstacle.empty() && given.text != record.case_text)
        given.obstacle = "is not the one that the run began with";
    if (!given.obstacle.empty())
        refuse(fmt::format("{}: case: ({}). Leave it away: the checkpoint holds the case.", options.case_file, given.obstacle));
}

/// Does one of the two begin with the other? Restarts add to what a run began with.
bool is_beginning(std::span<const std::string> one, std::span<const std::string> other)
{
    const std::size_t common = std::min(one.size(), other.size());
    return std::ranges::equal(one.first(common), other.first(common));
}

/// Rows and frames of two runs would stand in one file.
/// @param overrides  of the checkpoint
void check_same_run(const fs::path& folder, const RunRecord& record, std::span<const std::string> overrides)
{
    const fs::path file = folder / "results.h5";
    std::string case_text, begin;
    std::vector<std::string> set;
    try
    {
        const Hdf5Reader results(file);
        begin = results.text("/provenance", "begin");
        case_text = results.read_texts("/provenance/case_text").at(0);
        set = results.read_texts("/provenance/overrides");
    }
    catch (const std::exception&)
    {
        return;  // missing or damaged: what becomes of it is told elsewhere
    }
    if (begin != record.begin || case_text != record.case_text || !is_beginning(set, overrides))
        refuse(fmt::format("{}: (is of a run that began at {}, and the checkpoint of another one, that began at {}). Put back the "
                           "checkpoint that belongs to it, or give another folder with -o.",
                           printable(file.string(), 300), begin, record.begin));
}

RunStart start_again(const RunOptions& options)
{
    const fs::path given = options.restart;
    if (!fs::exists(given))
        refuse(fmt::format("--restart {}: (does not exist). Give a checkpoint, or the folder of a run.", given.string()));
    const fs::path home = folder_of(given);
    RunStart start;
    start.restarted = true;
    start.folder = options.folder.empty() ? home : fs::path(options.folder);
    start.moved = !fs::exists(start.folder) || !fs::equivalent(start.folder, home);
    start.lock = std::make_unique<RunLock>(start.folder);
    const RestartPoint point = find_checkpoint(given, start.notes);
    start.record = point.reader.record();
    RunRecord& record = start.record;
    check_same_case(options, record);
    const std::size_t at_first = record.overrides.size();
    record.overrides = merged_overrides(options, record.overrides);
    start.loaded = load_case(record.case_text, record.files, record.case_file, parsed(record.overrides));
    start.loaded.setup.state = point.reader.state(start.loaded.setup.model);
    check_stages_to_come(std::span(record.overrides).subspan(at_first), start.loaded.setup, record.finished);
    if (!start.moved)
    {
        check_folder(start.folder);
        check_same_run(start.folder, record, std::span(record.overrides).first(at_first));
        if (!options.is_of_search)
            refuse_factor(start.folder);
        put_aside(point, start.notes);
        if (!fs::exists(start.folder / "results.h5"))
            start.notes.push_back(fmt::format("warning: {} is not there: histories and energies begin at cycle {}",
                                              (start.folder / "results.h5").string(), point.reader.cycle()));
    }
    record.restarts.push_back(fmt::format("{} {}", timestamp(), point.reader.cycle()));
    start.notes.push_back(
        fmt::format("restart   {} at cycle {}; the run began at {}", point.file.string(), point.reader.cycle(), record.begin));
    return start;
}
}  // namespace

RunStart start_run(const RunOptions& options)
{
    return options.restart.empty() ? start_anew(options) : start_again(options);
}

RunStart start_loaded(LoadedCase loaded, std::vector<std::string> overrides, const RunOptions& options)
{
    RunStart start;
    start.folder = options.folder;
    start.record.overrides = std::move(overrides);
    if (!options.folder.empty())
        start.lock = std::make_unique<RunLock>(start.folder);
    take_case(std::move(loaded), start);
    return start;
}

RunStart read_moment(const fs::path& checkpoint)
{
    const CheckpointReader reader(checkpoint);
    RunStart start;
    start.restarted = true;
    start.record = reader.record();
    const RunRecord& record = start.record;
    start.loaded = load_case(record.case_text, record.files, record.case_file, parsed(record.overrides));
    start.loaded.setup.state = reader.state(start.loaded.setup.model);
    return start;
}
}  // namespace hdem
