#include "tools/python/driven_run.h"

#include "core/history_sampler.h"
#include "io/summary.h"
#include "tools/python/changed_case.h"
#include "tools/python/driven_watch.h"
#include "tools/python/python_lock.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

namespace hdem
{
namespace
{
namespace py = pybind11;

[[noreturn]] void refuse(const std::string& text)
{
    throw InputError(Problem{.key = {}, .text = text});
}
}  // namespace

/// While it lives cycles run.
class DrivenRun::Guard
{
  public:
    explicit Guard(Phase& phase) : phase_(phase) { phase_ = Phase::cycles; }
    ~Guard() { phase_ = Phase::idle; }
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

  private:
    Phase& phase_;
};

DrivenRun::DrivenRun(RunStart start, RunOptions options)
    : start_(std::move(start)),
      options_(std::move(options)),
      process_(::getpid())
{
    const RunKeeper::Clock::time_point begin = RunKeeper::Clock::now();
    Setup& setup = start_.loaded.setup;
    simulation_.emplace(std::move(setup.model), std::move(setup.state), thread_rule(options_.threads));
    if (!start_.restarted)
        if (const std::vector<Problem> problems = simulation_->find_problems(); !problems.empty())
            throw InputError(start_.loaded.file.source.located(problems));
    if (options_.folder.empty())
        return;
    log_ = begin_log(start_, options_);
    files_ = std::make_unique<RunFiles>(start_, options_, *simulation_, *log_, begin);
}

/// In a process that was forked off, files and lock of the folder are those of the parent: they are left as they are.
DrivenRun::~DrivenRun()
{
    if (process_ == ::getpid())
        return;
    static_cast<void>(files_.release());
    static_cast<void>(log_.release());
    static_cast<void>(start_.lock.release());
}

void DrivenRun::require_idle(const char* what) const
{
    if (phase_ == Phase::cycles)
        throw std::runtime_error(fmt::format("{}: cycles of this simulation run in another thread now", what));
    if (phase_ == Phase::callback)
        throw std::runtime_error(
            fmt::format("{}: not within the callback of run(). Return False to stop, and call it then.", what));
}

void DrivenRun::require_no_view() const
{
    if (views_ > 0)
        throw py::buffer_error(
            fmt::format("{} views of this simulation are still in use: cycles may move what they show. Delete them "
                        "first (del), or take copies (numpy.array(view)).",
                        views_));
}

void DrivenRun::require_own_folder(const char* what) const
{
    if (files_ && process_ != ::getpid())
        throw std::runtime_error(fmt::format("{}: the folder {} belongs to the process that began the run, and this one was forked "
                                             "from it. Begin runs with a folder after the fork.",
                                             what, start_.folder.string()));
}

const Simulation& DrivenRun::simulation() const
{
    if (phase_ == Phase::cycles)
        throw std::runtime_error("cycles of this simulation run in another thread now. Look at it in the callback of run().");
    return *simulation_;
}

py::capsule DrivenRun::lend()
{
    ++views_;
    return py::capsule(new std::shared_ptr<DrivenRun>(shared_from_this()),
                       [](void* pointer)
                       {
                           const std::unique_ptr<std::shared_ptr<DrivenRun>> run(static_cast<std::shared_ptr<DrivenRun>*>(pointer));
                           --(*run)->views_;
                       });
}

bool DrivenRun::is_done() const
{
    return is_over() && simulation_->state().stage + 1 == static_cast<Index>(simulation_->model().stages.size());
}

const std::vector<StageResult>& DrivenRun::run(const Piece& piece)
{
    require_idle("run()");
    require_no_view();
    require_own_folder("run()");
    if (!failure_.empty())
        throw RunError("the run has failed before: " + failure_);
    const State& state = simulation_->state();
    const Index first = state.stage + (over_ ? 1 : 0);
    const auto stages = static_cast<Index>(simulation_->model().stages.size());
    if (first == stages || (piece.cycles && *piece.cycles == 0) || (piece.stages && *piece.stages == 0))
        return results_;
    const Index end = piece.stages ? static_cast<Index>(std::min<std::int64_t>(stages, std::int64_t{first} + *piece.stages))
                                   : stages;
    Watch watch(*this, piece);
    {
        const Guard guard(phase_);
        const WithoutPython free;
        try
        {
            run_stages_of(watch, {.end = end, .over = over_ ? &*over_ : nullptr});
        }
        catch (const RunError& error)
        {
            failure_ = error.what();
            throw;
        }
        over_.reset();
        if (!watch.broke_off())
            over_ = results_.back();
        if (files_ && watch.has_error() && state.stage_begun)
            files_->keeper().save_now(*simulation_);
        if (files_ && is_done())
            summary_ = summary_text(files_->finish(start_, *simulation_, results_));
    }
    watch.rethrow();
    return results_;
}

void DrivenRun::run_stages_of(Watch& watch, const StagePart& part)
{
    if (!files_)
    {
        Observer* const observers[] = {&watch};
        results_ = run_stages(*simulation_, observers, &watch, part);
        return;
    }
    if (!summary_.empty())  // stages were added to a run that was done
    {
        summary_.clear();
        files_->keeper().go_on();
    }
    results_ = files_->run(*simulation_, {&watch}, &watch, part);
    files_->recorder().await_frame();  // who goes on reads it, or moves the folder
}

void DrivenRun::take_case(const BuiltCase& next)
{
    require_idle("a change of the case");
    require_no_view();
    require_own_folder("a change of the case");
    LoadedCase loaded = *next.loaded;
    Moment moment = with_other_stages(*simulation_, std::move(loaded.setup));
    Simulation changed(std::move(moment.model), std::move(moment.state), thread_rule(options_.threads));
    if (const std::vector<Problem> problems = changed.find_problems(); !problems.empty())
        throw InputError(loaded.file.source.located(problems));
    *simulation_ = std::move(changed);
    start_.record.case_text = loaded.file.source.text();
    start_.record.files = loaded.file.files;
    start_.record.overrides = next.overrides;
    start_.loaded = std::move(loaded);
    if (files_)
        files_->take_case(start_.record);
}

void DrivenRun::write_checkpoint(const std::string& folder)
{
    const Simulation& now = simulation();
    if (!now.state().stage_begun)
        refuse("checkpoint: (no stage has begun: there is nothing to go on from). Run some cycles first.");
    std::error_code different;
    if (files_ && std::filesystem::equivalent(folder, start_.folder, different))
    {
        require_own_folder("write_checkpoint()");
        if (!is_done())
            files_->keeper().go_on();
        files_->keeper().save_now(now);  // with the rows before it
        return;
    }
    RunRecord record = start_.record;
    record.finished = is_done();
    record.history_axes.clear();
    if (files_)
        record.history_axes = files_->recorder().history_axes();
    else
        for (const HistoryDef& history : now.model().histories)
            record.history_axes.push_back(HistorySampler(now.model(), history).axis());
    const RunLock lock(folder);
    hdem::write_checkpoint(folder, record, now.model(), now.state());
}

void DrivenRun::change_motion(const std::function<void(std::vector<BlockMotion>&)>& change)
{
    static_cast<void>(simulation());
    require_no_view();
    simulation_->change_motion(change);
}
}  // namespace hdem
