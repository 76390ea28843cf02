#include "verification/checks/same_bits.h"

#include "core/state/state_hash.h"
#include "io/checkpoint.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <bit>
#include <filesystem>
#include <vector>

namespace hdem::verification
{
namespace
{
/// For one checkpoint; removed with all that is in it.
class ScratchFolder
{
  public:
    ScratchFolder()
    {
        static std::atomic<int> count = 0;
        path_ = std::filesystem::temp_directory_path() / fmt::format("hdem_verify.{}.{}", getpid(), ++count);
        std::filesystem::create_directory(path_);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Writes a checkpoint at a cycle and leaves the run there.
class BreakOff final : public Keeper
{
  public:
    BreakOff(const std::filesystem::path& folder, std::int64_t cycle) : folder_(folder), cycle_(cycle) {}
    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return now < cycle_ ? cycle_ : never; }
    [[nodiscard]] bool keep(const Simulation& simulation) override
    {
        if (simulation.state().cycle < cycle_)
            return true;
        RunRecord record;
        record.history_axes.resize(simulation.model().histories.size(), Vec2(0.0, 0.0));
        write_checkpoint(folder_, record, simulation.model(), simulation.state());
        return false;
    }

  private:
    const std::filesystem::path& folder_;
    std::int64_t cycle_;
};

/// What two runs must have in common.
struct Ended
{
    std::uint64_t hash = 0;
    std::int64_t cycle = 0;
    std::vector<std::uint64_t> ledger;  ///< bits of its terms

    bool operator==(const Ended&) const = default;
};

class Problem
{
  public:
    Problem(std::filesystem::path file, Overrides overrides) : file_(std::move(file)), overrides_(std::move(overrides)) {}

    [[nodiscard]] Ended run(int threads) const
    {
        LoadedCase loaded = load_case(file_, overrides_);
        return end_of(Simulation(std::move(loaded.setup.model), std::move(loaded.setup.state), threads));
    }
    [[nodiscard]] Ended restart(std::int64_t cycle, int threads) const
    {
        const ScratchFolder folder;
        LoadedCase loaded = load_case(file_, overrides_);
        Simulation begun(std::move(loaded.setup.model), std::move(loaded.setup.state), threads);
        BreakOff keeper(folder.path(), cycle);
        run_stages(begun, {}, &keeper);
        LoadedCase again = load_case(file_, overrides_);
        State state = CheckpointReader(checkpoint_file(folder.path())).state(again.setup.model);
        return end_of(Simulation(std::move(again.setup.model), std::move(state), threads));
    }

  private:
    static Ended end_of(Simulation simulation)
    {
        run_stages(simulation, {});
        const State& state = simulation.state();
        Ended ended{.hash = state_hash(simulation.model(), state), .cycle = state.cycle};
        for (const LedgerTerm& term : ledger_terms)
            ended.ledger.push_back(std::bit_cast<std::uint64_t>(state.ledger.*term.value));
        return ended;
    }

    std::filesystem::path file_;
    Overrides overrides_;
};
}  // namespace

void require_same_bits(Report& report, const std::string& case_file, const Overrides& overrides,
                       std::span<const char* const> methods, const OtherRuns& others)
{
    std::string numbers = "1";
    for (const int threads : others.threads)
        numbers += fmt::format(", {}", threads);
    for (const char* method : methods)
    {
        const Problem problem(case_folder() / case_file, overrides + Overrides{set("contact.method", std::string(method))});
        const Ended one = problem.run(1);
        double differ = 0.0;
        for (const int threads : others.threads)
            differ += problem.run(threads) == one ? 0.0 : 1.0;
        differ += one.cycle > 1 && problem.restart(one.cycle / 2, 2) == one ? 0.0 : 1.0;
        const std::string& name = others.name.empty() ? case_file : others.name;
        report.require({fmt::format("{}, {}: runs that differ", name, method), numbers + " threads, restarted", 0.0, differ},
                       absolute(0.0));
    }
}
}  // namespace hdem::verification
