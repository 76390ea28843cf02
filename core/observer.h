#pragma once
/// Sees a run from outside: rows on the screen, histories, frames.

#include "core/model/model.h"
#include "core/state/state.h"

#include <cstdint>
#include <limits>

namespace hdem
{
inline constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

class Observer
{
  public:
    Observer() = default;
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;
    virtual ~Observer() = default;

    /// First cycle after `now` that the observer wants to see; `never` for none. The end of a stage is always shown.
    [[nodiscard]] virtual std::int64_t next_cycle(std::int64_t now) const = 0;
    /// A stage has begun, or goes on after a restart.
    virtual void begin_stage(const Model& /*model*/, const State& /*state*/) {}
    /// A cycle it asked for, the state before the first one, or the end of a stage.
    virtual void observe(const Model& model, const State& state) = 0;
    /// After a stage's last cycle has been observed.
    virtual void end_stage(const Model& /*model*/, const State& /*state*/) {}
};

/// Next multiple of `every` after `now`; never for every = 0.
[[nodiscard]] inline std::int64_t next_multiple(std::int64_t now, std::int64_t every)
{
    return every > 0 ? (now / every + 1) * every : never;
}
}  // namespace hdem
