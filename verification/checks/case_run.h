#pragma once
/// Runs a case file as `hdem run` does and keeps its histories in memory.

#include "core/energy_ledger.h"
#include "io/case_override.h"
#include "io/load_case.h"
#include "parallel/stages.h"
#include "verification/checks/report.h"

#include <filesystem>
#include <functional>
#include <map>

namespace hdem::verification
{
using Overrides = std::vector<Override>;

/// Folder of the case files; set once by the program.
std::filesystem::path& case_folder();

/// A value as an override has it.
[[nodiscard]] Override set(const std::string& key, double value);
[[nodiscard]] Override set(const std::string& key, const Vec2& value);
[[nodiscard]] Override set(const std::string& key, const Polygon& value);
[[nodiscard]] Override set(const std::string& key, const std::string& word);
/// Both lists; later ones win.
[[nodiscard]] Overrides operator+(Overrides first, const Overrides& second);

/// The energy ledger at one time of a run.
struct LedgerSample
{
    double time = 0.0;  ///< [s]
    EnergyLedger sums;
    StoredEnergy stored;
};

class CaseRun
{
  public:
    /// Called with the state at the start and after each cycle, or every so many.
    using Watch = std::function<void(const Model&, const State&)>;

    /// `case_file` relative to case_folder(). Throws InputError as `hdem run` would refuse the case.
    CaseRun(const std::string& case_file, const Overrides& overrides);
    /// Runs all stages; adds the run to the report.
    CaseRun(Report& report, const std::string& case_file, const Overrides& overrides, const Watch& watch = {});

    void run(const Watch& watch = {}, std::int64_t watch_every = 1);

    [[nodiscard]] const Model& model() const { return simulation_.model(); }
    [[nodiscard]] const State& state() const { return simulation_.state(); }
    [[nodiscard]] double step() const { return model().time_step; }
    [[nodiscard]] const CaseDef& definition() const { return loaded_.file.def; }
    [[nodiscard]] const std::vector<StageResult>& stages() const { return stages_; }
    /// Number of the block with that name.
    [[nodiscard]] Index block(const std::string& name) const;

    /// Samples of "HISTORY.COLUMN", the first before the first cycle, then one every `every` cycles.
    [[nodiscard]] const std::vector<double>& column(const std::string& name) const;

    /// Greatest share of the energy that the ledger could not explain.
    [[nodiscard]] double worst_residual() const { return worst_residual_; }
    /// The ledger every 100 cycles, or as often as the case's output has rows.
    [[nodiscard]] const std::vector<LedgerSample>& ledger() const { return ledger_; }
    [[nodiscard]] bool had_impulses() const;
    /// The shell command that repeats the run.
    [[nodiscard]] const std::string& command() const { return command_; }

  private:
    LoadedCase loaded_;
    Simulation simulation_;
    std::string command_;
    std::vector<StageResult> stages_;
    std::map<std::string, std::vector<double>> columns_;
    std::vector<LedgerSample> ledger_;
    double worst_residual_ = 0.0;
};
}  // namespace hdem::verification
