/// hdem critical: the value of a number of the case at which blocks begin to fail.

#include "core/version.h"
#include "io/atomic_file.h"
#include "io/digest.h"
#include "io/load_case.h"
#include "io/run_lock.h"
#include "parallel/critical_search.h"
#include "tools/hdem/console.h"
#include "tools/hdem/critical_options.h"
#include "tools/hdem/run_folder.h"
#include "tools/hdem/screen.h"
#include "tools/hdem/signal_watch.h"
#include "tools/hdem/signals.h"
#include "tools/hdem/trial_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<Override> overrides_of(const CriticalOptions& options)
{
    std::vector<Override> overrides;
    for (const std::string& text : options.overrides)
        overrides.push_back(parse_override(text));
    return overrides;
}

struct Run
{
    double at = 0.0;
    ConditionResult result;

    /// What is not at rest when its time is over may be on its way to the limit: it counts as failed, as in hdem fos.
    [[nodiscard]] bool fails() const { return result.fails || result.still_moves; }
    [[nodiscard]] const char* verdict() const { return result.fails ? "fails" : (result.still_moves ? "undecided" : "stands"); }
};

class Critical
{
  public:
    Critical(const CriticalOptions& options, Vary vary, FailureCondition condition, const fs::path& folder, Log& log,
             const std::string& question)
        : options_(options),
          vary_(std::move(vary)),
          condition_(std::move(condition)),
          log_(log),
          file_(folder / "trials.json", question),
          threads_(thread_rule(options.threads))
    {
    }

    /// Between the ends of the range, one of which stands.
    Bracket find()
    {
        log_.line(fmt::format("{:>14}  {:<9} {:>9}  greatest {}", vary_.key, "", "cycles", quantity()));
        const std::array<bool, 2> stands = look_at_ends();
        show(false);
        if (stands[0] == stands[1])
            refuse(fmt::format("--vary {}={}:{}: (at both ends the case {}, {}). Give a range in which it begins to fail.",
                               vary_.key, vary_.low, vary_.high, stands[0] ? "stands" : "fails", options_.fails));
        const CriticalRange range = stands[0] ? CriticalRange{vary_.low, vary_.high} : CriticalRange{vary_.high, vary_.low};
        return search_between(
            range, options_.tolerance.value_or((vary_.high - vary_.low) / 200.0), threads_.most,
            [this](double x, int threads, const std::stop_token& stop) { return stands_at(x, threads, stop); },
            [this](const Bracket&) { show(true); });
    }

    [[nodiscard]] Json trials() const
    {
        Json all = Json::array();
        for (const Run& run : counted_)
            all.push_back({{"value", run.at},
                           {"fails", run.fails()},
                           {"verdict", run.verdict()},
                           {"greatest", run.result.greatest},
                           {"block", printable(run.result.block)},
                           {"cycles", run.result.cycles},
                           {"met_ends", run.result.met_ends}});
        return all;
    }

    /// Of runs that were too short.
    [[nodiscard]] std::vector<std::string> warnings() const
    {
        std::vector<std::string> moving, ends_moving, others;
        for (const Run& run : counted_)
            if (const ConditionResult& r = run.result; !r.met_ends || r.still_moves || r.ends_moving)
                (r.still_moves ? moving : (r.met_ends ? ends_moving : others)).push_back(fmt::format("{:.6g}", run.at));
        std::vector<std::string> warnings;
        if (!moving.empty())
            warnings.push_back(fmt::format(
                "a stage that seeks rest ended while a block in question was not at rest, and the run counts as "
                "one that fails, at {} = {}. Give more max_cycles; leave out ends that come before the limit of --fails.",
                vary_.key, fmt::join(moving, ", ")));
        if (!ends_moving.empty())
            warnings.push_back(
                fmt::format("the last stage ended while a block in question still moved, and the run counts as one that stands, at "
                            "{} = {}. Give more time, or until = \"converged\", if the block may still pass the limit.",
                            vary_.key, fmt::join(ends_moving, ", ")));
        if (!others.empty())
            warnings.push_back(
                fmt::format("max_cycles ended a stage before it met its end, and the run counts as one that stands, since "
                            "the blocks in question are at rest, at {} = {}. Give more max_cycles.",
                            vary_.key, fmt::join(others, ", ")));
        return warnings;
    }

    [[nodiscard]] std::stop_token stopped() const { return signals_.token(); }

  private:
    [[nodiscard]] std::string quantity() const
    {
        using Quantity = FailureCondition::Quantity;
        return condition_.quantity == Quantity::detached
                   ? "number of detached blocks"
                   : (condition_.quantity == Quantity::rotation ? "rotation [deg]" : "displacement [m]");
    }

    std::array<bool, 2> look_at_ends()
    {
        std::array<bool, 2> stands{};
        if (threads_.most < 2)
            for (const int i : {0, 1})
                stands[i] = stands_at(i == 0 ? vary_.low : vary_.high, 1, {});
        else
        {
            std::exception_ptr error;
            std::jthread other(
                [&]
                {
                    try
                    {
                        stands[1] = stands_at(vary_.high, threads_.most / 2, {});
                    }
                    catch (...)
                    {
                        error = std::current_exception();
                    }
                });
            stands[0] = stands_at(vary_.low, threads_.most - threads_.most / 2, {});
            other.join();
            if (error)
                std::rethrow_exception(error);
        }
        return stands;
    }

    bool stands_at(double x, int threads, const std::stop_token& stop)
    {
        Run run{.at = x, .result = {}};
        if (const std::optional<ConditionResult> known = file_.find(x))
            run.result = *known;
        else
        {
            std::vector<Override> overrides = overrides_of(options_);
            overrides.push_back({vary_.key, fmt::format("{:.17g}", x)});
            LoadedCase loaded = load_case(options_.case_file, overrides);
            Simulation simulation(std::move(loaded.setup.model), std::move(loaded.setup.state), threads_.for_share(threads));
            if (const std::vector<Problem> problems = simulation.find_problems(); !problems.empty())
                throw InputError(loaded.file.source.located(problems));
            for (const std::string& name : condition_.blocks)
                if (simulation.model().find_block(name) == no_index)
                    refuse(fmt::format("--fails {}: (no block is called \"{}\"). hdem check --blocks lists them.", options_.fails,
                                       printable(name)));
            std::stop_source either;
            const std::stop_callback first(stop, [&] { either.request_stop(); });
            const std::stop_callback second(stopped(), [&] { either.request_stop(); });
            run.result = run_to_condition(simulation, condition_, either.get_token());
            if (run.result.was_stopped)
            {
                if (stopped().stop_requested())
                    throw SearchStopped{};
                return false;
            }
            file_.add(x, run.result);
        }
        const std::lock_guard lock(mutex_);
        ended_[x] = run;
        return !run.fails();
    }

    /// Of a pair the one farther from what stands counts only where the nearer one stands.
    void show(bool only_counting)
    {
        std::vector<Run> pair;
        for (const auto& [x, run] : ended_)
            pair.push_back(run);
        const bool is_turned = !counted_.empty() && counted_.front().fails();
        if (only_counting && is_turned)
            std::ranges::reverse(pair);
        for (const Run& run : pair)
        {
            counted_.push_back(run);
            log_.line(fmt::format("{:>14.6g}  {:<9} {:>9}  {:.4g}{}{}", run.at, run.verdict(), run.result.cycles,
                                  run.result.greatest, run.result.block.empty() ? "" : " (" + printable(run.result.block) + ")",
                                  run.result.met_ends ? "" : ", max_cycles reached"));
            if (only_counting && run.fails())
                break;
        }
        ended_.clear();
    }

    const CriticalOptions& options_;
    Vary vary_;
    FailureCondition condition_;
    Log& log_;
    ConditionTrialFile file_;
    ThreadRule threads_;
    SignalWatch signals_;
    std::mutex mutex_;
    std::map<double, Run> ended_;
    std::vector<Run> counted_;
};

/// A key of whole numbers, as a seed, is refused before the ends of the range are run.
void try_value_between(const CriticalOptions& options, const Vary& vary)
{
    std::vector<Override> overrides = overrides_of(options);
    overrides.push_back({vary.key, fmt::format("{:.6g}", vary.low + 0.381966 * (vary.high - vary.low))});
    static_cast<void>(read_case_file(options.case_file, overrides));
}

std::string question_of(const CriticalOptions& options)
{
    const std::vector<Override> overrides = overrides_of(options);
    const CaseFile file = read_case_file(options.case_file, overrides);
    std::string sum = file.source.text() + fmt::format("\n{}\n{}\n{}", fmt::join(options.overrides, "\n"),
                                                       options.vary.substr(0, options.vary.find('=')), options.fails);
    for (const auto& [name, content] : file.files)
        sum += name + sha256_hex(content);
    return sum;
}
}  // namespace

int critical_command(const CriticalOptions& options)
{
    outlive_reader();
    const Vary vary = parse_vary(options.vary);
    if (options.tolerance && *options.tolerance >= vary.high - vary.low)
        refuse(fmt::format("--tolerance {}: (is not below the width of the range, {}: nothing would be looked for). Give less.",
                           *options.tolerance, vary.high - vary.low));
    const FailureCondition condition = parse_condition(options.fails);
    try_value_between(options, vary);
    const std::string question = question_of(options);
    const fs::path folder = options.folder.empty() ? fs::path(fs::path(options.case_file).stem().string() + "_critical")
                                                   : fs::path(options.folder);
    const RunLock lock(folder);
    if (fs::exists(folder / "results.h5") || fs::exists(folder / "checkpoint.h5"))
        refuse(fmt::format("{}: (holds a run). Give another folder with -o.", printable(folder.string())));
    check_folder(folder);
    if (!options.overwrite)
        refuse_files_of_others(folder);
    const bool was_cut_short = !fs::exists(folder / "summary.json");
    if (!options.overwrite && was_cut_short && TrialFile(folder / "trials.json", question).is_of_another())
        refuse(fmt::format(
            "{}: (holds trials of another search, which did not come to its end). Give another folder with -o, or begin "
            "anew with --overwrite.",
            printable(folder.string())));
    remove_file(folder / "summary.json");  // of a search before
    if (options.overwrite)
        remove_file(folder / "trials.json");
    Log log(folder / "run.log", options.quiet, Log::Begin::anew);
    log.to_file(version_line());
    catch_interrupts();
    Critical search(options, vary, condition, folder, log, question);
    try
    {
        const Bracket found = search.find();
        const Json summary = {{"case", fs::path(options.case_file).filename().string()},
                              {"vary", vary.key},
                              {"fails", options.fails},
                              {"critical", found.middle()},
                              {"stands_at", *found.stands},
                              {"fails_at", *found.fails},
                              {"warnings", search.warnings()},
                              {"trials", search.trials()}};
        write_atomically(folder / "summary.json", summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
        log.line(fmt::format("critical {} = {:.6g} ({:.6g} stands, {:.6g} fails)", vary.key, found.middle(), *found.stands,
                             *found.fails));
        for (const std::string& warning : search.warnings())
            log.line("warning: " + warning);
        return exit_done;
    }
    catch (const SearchStopped&)
    {
        log.line(fmt::format("{}: the search was stopped. The same command goes on.", interrupt_name()));
        return 128 + interrupt();
    }
}
}  // namespace hdem
