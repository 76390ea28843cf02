#include "tools/hdem/fos_report.h"
#include "tools/hdem/options.h"
#include "tools/python/bindings.h"
#include "tools/python/case_binding.h"
#include "tools/python/python_lock.h"

#include <pybind11/stl.h>

#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <optional>
#include <stop_token>

namespace hdem
{
namespace
{
namespace py = pybind11;

/// Ends the stages before the search when it is asked to.
class StopKeeper : public Keeper
{
  public:
    explicit StopKeeper(std::stop_token stop) : stop_(std::move(stop)) {}
    [[nodiscard]] std::int64_t next_cycle(std::int64_t) const override { return never; }
    [[nodiscard]] bool keep(const Simulation&) override { return !stop_.stop_requested(); }
    [[nodiscard]] bool is_to_stop() override { return stop_.stop_requested(); }

  private:
    std::stop_token stop_;
};

using Show = std::function<void(const FactorTrial&, const Model&)>;

/// All stages, then the search. @return the key factor_of_safety of summary.json; "" where it was stopped
std::string factor_text_of(const LoadedCase& loaded, const ThreadRule& threads, const std::stop_token& stop, const Show& show)
try
{
    const CaseDef& def = loaded.file.def;
    refuse_driven(def);
    Simulation simulation(loaded.setup.model, loaded.setup.state, threads);
    if (const std::vector<Problem> problems = simulation.find_problems(); !problems.empty())
        throw InputError(loaded.file.source.located(problems));
    BeforeLastStage before;
    Observer* const observers[] = {&before};
    StopKeeper keeper(stop);
    const std::vector<StageResult> stages = run_stages(simulation, observers, &keeper);
    if (stop.stop_requested())
        return "";
    const Moment last{simulation.model(), simulation.state()};
    const FosAnswer answer = find_factor(last, {.def = def.factor_of_safety,
                                                .found_rest = !stages.back().sought_rest || stages.back().at_rest,
                                                .before = [&] { return before.moment(); },
                                                .threads = threads,
                                                .show = [&](const FactorTrial& trial) { show(trial, last.model); },
                                                .stop = stop});
    return fos_json(answer.outcome, answer.reference.model).dump();
}
catch (const SearchStopped&)
{
    return "";
}

/// What the thread of the search has to tell goes to the one that has asked for it, and the search waits until it is told: at Python's end no other thread gets
/// Python's lock.
class Messages
{
  public:
    /// While it lives there may be messages.
    struct Writer
    {
        Messages& to;
        ~Writer() { to.end(); }
    };

    void tell(std::string text)
    {
        std::unique_lock lock(mutex_);
        text_ = std::move(text);
        changed_.notify_all();
        changed_.wait(lock, [&] { return !text_; });
    }
    /// The next message; nothing after a while, or at the end.
    std::optional<std::string> wait_for(std::chrono::milliseconds longest)
    {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, longest, [&] { return text_ || has_ended_; });
        return text_;
    }
    void is_told()
    {
        const std::lock_guard lock(mutex_);
        text_.reset();
        changed_.notify_all();
    }
    [[nodiscard]] bool has_ended()
    {
        const std::lock_guard lock(mutex_);
        return has_ended_;
    }

  private:
    void end()
    {
        const std::lock_guard lock(mutex_);
        has_ended_ = true;
        changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<std::string> text_;
    bool has_ended_ = false;
};

/// The search has a thread of its own: this one hears of signals, which Python takes in its main thread only.
std::string find(const BuiltCase& built, const std::optional<int>& threads, const py::object& callback)
{
    check_threads(threads);
    std::stop_source stop;
    std::exception_ptr error;
    const auto hold = [&](const auto& act)
    {
        if (error)
            return;
        try
        {
            act();
        }
        catch (...)
        {
            error = std::current_exception();
            stop.request_stop();
        }
    };
    Messages messages;
    const Show show = [&](const FactorTrial& trial, const Model& model)
    {
        if (!callback.is_none())
            messages.tell(trial_json(trial, model).dump());
    };
    const std::shared_ptr<const LoadedCase> loaded = built.loaded;
    std::future<std::string> answer;
    {
        const WithoutPython free;
        answer = std::async(std::launch::async,
                            [&]
                            {
                                const Messages::Writer writer{messages};
                                return factor_text_of(*loaded, thread_rule(threads), stop.get_token(), show);
                            });
        while (!messages.has_ended())
        {
            const std::optional<std::string> text = messages.wait_for(std::chrono::milliseconds(50));
            const WithPython lock;
            if (text)
                hold([&] { callback(*text); });
            hold(
                []
                {
                    if (PyErr_CheckSignals() != 0)
                        throw py::error_already_set();
                });
            if (text)
                messages.is_told();
        }
        answer.wait();
    }
    if (error)
        std::rethrow_exception(error);
    return answer.get();
}
}  // namespace

void bind_factor(py::module_& module)
{
    module.def("find_factor", &find, py::arg("case"), py::arg("threads"), py::arg("callback"));
}
}  // namespace hdem
