#include "tools/hdem/fos_report.h"
#include "tools/hdem/options.h"
#include "tools/python/bindings.h"
#include "tools/python/case_binding.h"
#include "tools/python/python_lock.h"

#include <pybind11/stl.h>

#include <chrono>
#include <future>
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

/// The search has a thread of its own: this one hears of signals, which Python takes in its main thread only.
std::string find(const BuiltCase& built, const std::optional<int>& threads, const py::object& callback)
{
    std::stop_source stop;
    std::exception_ptr error;  // of the callback; written with the GIL
    const Show show = [&](const FactorTrial& trial, const Model& model)
    {
        const WithPython lock;
        if (callback.is_none() || error)
            return;
        try
        {
            callback(trial_json(trial, model).dump());
        }
        catch (...)
        {
            error = std::current_exception();
            stop.request_stop();
        }
    };
    const std::shared_ptr<const LoadedCase> loaded = built.loaded;
    std::future<std::string> answer;
    {
        const WithoutPython free;
        answer = std::async(std::launch::async,
                            [&] { return factor_text_of(*loaded, thread_rule(threads), stop.get_token(), show); });
        while (answer.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready)
        {
            const WithPython lock;
            if (error || PyErr_CheckSignals() == 0)
                continue;
            try
            {
                throw py::error_already_set();
            }
            catch (...)
            {
                error = std::current_exception();
            }
            stop.request_stop();
        }
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
