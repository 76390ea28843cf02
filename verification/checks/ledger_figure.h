#pragma once
/// The energy ledger of runs as curves.

#include "verification/checks/case_run.h"

namespace hdem::verification
{
struct LedgerRun
{
    std::string name;
    const CaseRun& run;
};

/// A panel a run with the ledger's terms over time, and a last one with what the ledger does not explain: as a share of the
/// greatest term of that run, beside the bar of the report's rows. Terms below a thousandth of the greatest one are left out.
[[nodiscard]] Figure ledger_figure(const std::string& id, const std::string& title, const std::vector<LedgerRun>& runs);
}  // namespace hdem::verification
