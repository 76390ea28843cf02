#pragma once
/// What sees and ends a run that Python drives. For driven_run.cpp only.

#include "tools/python/driven_run.h"
#include "tools/python/python_lock.h"

#include <algorithm>
#include <exception>

namespace hdem
{
/// Calls the callback, hears of signals, and ends the run in time. What Python throws is kept until the state is whole.
class DrivenRun::Watch : public Observer, public Keeper
{
  public:
    Watch(DrivenRun& run, const Piece& piece)
        : run_(run),
          piece_(piece),
          first_(run.simulation_->state().cycle),
          last_(piece.cycles ? first_ + std::min(*piece.cycles, never - first_) : never)
    {
    }

    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override
    {
        std::int64_t next = piece_.callback ? next_multiple(now, piece_.every) : never;
        if (last_ > now)
            next = std::min(next, last_);
        return run_.files_ ? std::min(next, run_.files_->keeper().next_cycle(now)) : next;
    }

    void observe(const Model&, const State& state) override
    {
        if (!piece_.callback || state.cycle == first_ || state.cycle == called_ || state.cycle % piece_.every != 0)
            return;
        called_ = state.cycle;
        const WithPython lock;
        run_.phase_ = Phase::callback;
        hold(
            [&]
            {
                stops_ = !piece_.callback();
                run_.require_no_view();
            });
        run_.phase_ = Phase::cycles;
    }

    [[nodiscard]] bool keep(const Simulation& simulation) override
    {
        const bool goes_on = !run_.files_ || run_.files_->keeper().keep(simulation);
        hear_signals();
        broke_off_ = !goes_on || error_ || stops_ || simulation.state().cycle >= last_;
        return !broke_off_;
    }

    [[nodiscard]] bool is_to_stop() override
    {
        hear_signals();
        return error_ != nullptr;
    }

    /// The present stage has not come to its end.
    [[nodiscard]] bool broke_off() const { return broke_off_; }
    [[nodiscard]] bool has_error() const { return error_ != nullptr; }
    void rethrow() const
    {
        if (error_)
            std::rethrow_exception(error_);
    }

  private:
    template <typename Do>
    void hold(const Do& act)
    {
        try
        {
            act();
        }
        catch (...)
        {
            error_ = std::current_exception();
        }
    }

    void hear_signals()
    {
        if (error_)
            return;
        const WithPython lock;
        if (PyErr_CheckSignals() != 0)
            hold([] { throw pybind11::error_already_set(); });
    }

    DrivenRun& run_;
    const Piece& piece_;
    std::int64_t first_;
    std::int64_t last_;
    std::int64_t called_ = -1;
    bool stops_ = false;
    bool broke_off_ = false;
    std::exception_ptr error_;
};
}  // namespace hdem
