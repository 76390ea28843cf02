#pragma once
/// Trials of a search for the factor of safety, kept in memory.

#include "parallel/safety_factor.h"

#include <map>
#include <mutex>
#include <utility>

namespace hdem::runs
{
class RememberedTrials final : public TrialStore
{
  public:
    RememberedTrials() = default;
    /// Asks the search to stop once so many trials have been added.
    RememberedTrials(std::stop_source& stop, int after) : stop_(&stop), stop_after_(after) {}

    [[nodiscard]] std::optional<Trial> find(FactorSearch search, double factor) override
    {
        const std::lock_guard lock(mutex_);
        const auto at = trials_.find({search, factor});
        return at == trials_.end() ? std::nullopt : std::optional(at->second);
    }
    void add(FactorSearch search, const Trial& trial) override
    {
        const std::lock_guard lock(mutex_);
        if (!trials_.insert_or_assign({search, trial.factor}, trial).second)
            ++repeated_;
        if (++added_ == stop_after_)
            stop_->request_stop();
    }
    void forget_one() { trials_.erase(trials_.begin()); }
    [[nodiscard]] int added() const { return added_; }
    /// How many have been added that were there already.
    [[nodiscard]] int repeated() const { return repeated_; }

  private:
    std::mutex mutex_;
    std::map<std::pair<FactorSearch, double>, Trial> trials_;
    std::stop_source* stop_ = nullptr;
    int stop_after_ = 0, added_ = 0, repeated_ = 0;
};
}  // namespace hdem::runs
