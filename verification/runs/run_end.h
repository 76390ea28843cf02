#pragma once
/// A case run to its end, or broken off and gone on with, and what two such runs must have in common.

#include "core/rock/build_model.h"
#include "parallel/stages.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hdem::runs
{
/// Writes a checkpoint at one cycle, or at the first look after it, and leaves the run there.
class BreakOff final : public Keeper
{
  public:
    BreakOff(std::filesystem::path folder, std::int64_t cycle) : folder_(std::move(folder)), cycle_(cycle) {}
    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return now < cycle_ ? cycle_ : never; }
    [[nodiscard]] bool keep(const Simulation& simulation) override;

  private:
    std::filesystem::path folder_;
    std::int64_t cycle_;
};

/// What does not depend on threads, nor on where the run was broken off; equal to the last bit.
struct RunEnd
{
    std::uint64_t hash = 0;
    std::int64_t cycle = 0;
    std::vector<std::int64_t> stage_cycles;  ///< three a stage: its first cycle, how many, is it at rest
    std::vector<std::string> told;           ///< of the stages, for people
    std::vector<std::uint64_t> ledger;       ///< bits of its terms
    std::int64_t counters = 0, contacts = 0;

    bool operator==(const RunEnd&) const = default;
};

/// From where the simulation stands.
[[nodiscard]] RunEnd run_to_end(Simulation& simulation, Keeper* keeper = nullptr);

/// Makes a case anew for each run.
class Build
{
  public:
    Build(const CaseDef& def) : make_([def] { return build_model(def); }) {}
    explicit Build(std::function<Setup()> make) : make_(std::move(make)) {}
    [[nodiscard]] Setup operator()() const { return make_(); }

  private:
    std::function<Setup()> make_;
};

[[nodiscard]] RunEnd run_unbroken(const Build& build, const ThreadRule& threads = 1);
/// Leaves a checkpoint in `folder`.
void run_until(const Build& build, std::int64_t cycle, const std::filesystem::path& folder, const ThreadRule& threads = 1);
[[nodiscard]] RunEnd restart(const Build& build, const std::filesystem::path& folder, const ThreadRule& threads);
}  // namespace hdem::runs
