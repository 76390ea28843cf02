/// hdem fos: the factor of safety by strength reduction.

#include "io/digest.h"
#include "io/run_recorder.h"
#include "io/text_file.h"
#include "tools/hdem/console.h"
#include "tools/hdem/finished_run.h"
#include "tools/hdem/fos_report.h"
#include "tools/hdem/run_folder.h"
#include "tools/hdem/signal_watch.h"
#include "tools/hdem/trial_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

fs::path before_folder(const fs::path& folder)
{
    return folder / "before_last_stage";
}

fs::path failure_folder(const fs::path& folder)
{
    return folder / "failure";
}

/// Keeps the moment before the last stage on the disk too: a run that goes on within that stage has not seen it.
class SavedBeforeLastStage : public BeforeLastStage
{
  public:
    SavedBeforeLastStage(fs::path folder, RunRecord record) : folder_(std::move(folder)), record_(std::move(record)) {}

    void end_stage(const Model& model, const State& state) override
    {
        BeforeLastStage::end_stage(model, state);
        if (state.stage + 2 == static_cast<Index>(model.stages.size()))
            write_checkpoint(before_folder(folder_), record_, model, state);
    }

  private:
    fs::path folder_;
    RunRecord record_;
};

/// The run's case, as it is now.
struct Question
{
    std::string text;
    NamedFiles files;
    std::vector<std::string> overrides;
    CaseDef def;

    [[nodiscard]] bool is_of(const RunRecord& record) const
    {
        return record.case_text == text && record.overrides == overrides && record.files == files;
    }
    [[nodiscard]] std::string all() const
    {
        std::string sum = text + fmt::format("\n{}\n", fmt::join(overrides, "\n"));
        for (const auto& [name, content] : files)
            sum += name + sha256_hex(content);
        return sum;
    }
};

Question read_question(const RunOptions& run)
{
    std::vector<Override> overrides;
    for (const std::string& text : run.overrides)
        overrides.push_back(parse_override(text));
    const CaseFile file = read_case_file(run.case_file, overrides);
    return {file.source.text(), file.files, run.overrides, file.def};
}

/// Does the folder hold a checkpoint of this case?
bool holds_checkpoint(const fs::path& folder, const Question& question)
try
{
    return fs::exists(checkpoint_file(folder)) && question.is_of(CheckpointReader(checkpoint_file(folder)).record());
}
catch (const InputError&)
{
    return false;
}

/// The moment before the last stage: seen by this run, or saved by an earlier one. Nothing where it is not needed.
std::optional<Moment> moment_before(const BeforeLastStage& seen, const FinishedRun& run, const Question& question)
{
    if (seen.moment())
        return seen.moment();
    std::vector<Override> overrides;
    for (const std::string& text : run.start.record.overrides)
        overrides.push_back(parse_override(text));
    LoadedCase loaded = load_case(run.start.record.case_text, run.start.record.files, run.start.record.case_file, overrides);
    const fs::path before = checkpoint_file(before_folder(run.start.folder));
    const bool has_earlier_stages = loaded.setup.model.stages.size() > 1;
    if (has_earlier_stages && !holds_checkpoint(before_folder(run.start.folder), question))
        throw InputError(Problem{
            .key = {},
            .text = fmt::format(
                "{}: (is not of this run: the run in this folder was made by hdem run, and blocks did not stand in its last "
                "stage, which is to be run anew). Begin anew with --overwrite.",
                before.string())});
    if (has_earlier_stages)
        loaded.setup.state = CheckpointReader(before).state(loaded.setup.model);
    const Simulation simulation(std::move(loaded.setup.model), std::move(loaded.setup.state));
    return Moment{simulation.model(), simulation.state()};
}

/// A frame in which the blocks that fail are detached.
void write_failure(const fs::path& folder, const RunStart& start, const RunOptions& options, Moment& end, const Trial& trial)
{
    double least = std::numeric_limits<double>::infinity();
    for (const Index user : trial.failing)
        least = std::min(least, end.state.blocks.displacement(end.model.slot_of_user[user]).norm());
    if (std::isfinite(least) && least > 0.0)
        end.model.convergence.detached_distance = 0.999 * least;
    end.model.title += fmt::format("{}F = {:.4f}", end.model.title.empty() ? "" : ": ", trial.factor);
    Provenance provenance{.case_file = start.record.case_file,
                          .case_text = start.record.case_text,
                          .overrides = start.record.overrides,
                          .command_line = options.command_line,
                          .seed = start.loaded.file.def.generator.seed,
                          .threads = 1};
    describe_machine(provenance);
    RunRecorder recorder(failure_folder(folder), end.model, std::move(provenance));
    recorder.finish(end.model, end.state);
}

class Fos
{
  public:
    Fos(FinishedRun& run, const BeforeLastStage& before, const Question& question, const RunOptions& options)
        : run_(run),
          options_(options),
          before_(before),
          question_(question),
          log_(*run.log),
          folder_(run.start.folder),
          file_(run.start.folder / "trials.json", question.all(), run.simulation->model().blocks()),
          threads_(run.simulation->thread_choice().rule())
    {
    }

    int find()
    {
        const Moment last{run_.simulation->model(), run_.simulation->state()};
        const SignalWatch signals;
        auto [outcome, reference] = find_factor(last, {.def = run_.start.loaded.file.def.factor_of_safety,
                                                       .found_rest = !run_.stages.back().sought_rest || run_.stages.back().at_rest,
                                                       .before = [&] { return moment_before(before_, run_, question_); },
                                                       .threads = threads_,
                                                       .store = &file_,
                                                       .begin = [&](const FosOutcome& found) { begin(found); },
                                                       .show = [&](const FactorTrial& trial) { log_.line(trial_row(trial)); },
                                                       .stop = signals.token()});
        show_failure(outcome, reference);
        end(outcome, reference.model);
        return outcome.factor.as_given.is_closed() ? exit_done : exit_no_convergence;
    }

  private:
    void begin(const FosOutcome& outcome)
    {
        log_.line("");
        log_.line("factor of safety: strength reduction from the last state");
        log_.line("bound  " + bound_text(outcome.bound));
        if (file_.size() > 0)
            log_.line(fmt::format("{} trials of an earlier search are in {}", file_.size(), (folder_ / "trials.json").string()));
        log_.line(trial_heading());
    }

    void show_failure(FosOutcome& outcome, const Moment& reference)
    {
        const Trial* const first = outcome.factor.first_failure();
        if (first == nullptr)
        {
            remove_run(failure_folder(folder_));  // of an earlier search
            return;
        }
        if (!outcome.factor.failure)  // the trial was run by an earlier program
            static_cast<void>(run_trial(reference, trial_rule(reference.model, outcome.def, FactorSearch::as_given, first->factor),
                                        threads_, {}, &outcome.factor.failure));
        write_failure(folder_, run_.start, options_, *outcome.factor.failure, *first);
    }

    void end(const FosOutcome& outcome, const Model& model)
    {
        add_to_summary(folder_ / "summary.json", fos_json(outcome, model));
        log_.line("");
        for (const std::string& line : closing_lines(outcome, model))
            log_.line(line);
        for (const std::string& warning : outcome.warnings)
            log_.line("warning: " + warning);
        if (outcome.factor.first_failure() != nullptr)
            log_.line(fmt::format("blocks that fail: hdem plot {}", failure_folder(folder_).string()));
    }

    FinishedRun& run_;
    const RunOptions& options_;
    const BeforeLastStage& before_;
    const Question& question_;
    Log& log_;
    fs::path folder_;
    FactorTrialFile file_;
    ThreadRule threads_;
};
}  // namespace

int fos_command(const FosOptions& options)
{
    RunOptions run_options = options.run;
    const Question question = read_question(run_options);
    refuse_driven(question.def);
    const fs::path folder = run_options.folder.empty() ? fs::path(fs::path(run_options.case_file).stem())
                                                       : fs::path(run_options.folder);
    if (!run_options.overwrite && holds_checkpoint(folder, question))
    {  // the run goes on, or has come to its end
        run_options.is_of_search = true;
        run_options.restart = folder.string();
        run_options.folder.clear();
    }
    RunRecord record;
    record.case_file = run_options.case_file;
    record.case_text = question.text;
    record.files = question.files;
    record.overrides = question.overrides;
    SavedBeforeLastStage before(folder, record);
    FinishedRun run = run_case(run_options, &before);
    if (!run.is_complete)
        return run.exit_code;
    try
    {
        return Fos(run, before, question, options.run).find();
    }
    catch (const SearchStopped&)
    {
        run.log->line(fmt::format("{}: the search was stopped. The same command goes on.", interrupt_name()));
        return 128 + interrupt();
    }
}
}  // namespace hdem
