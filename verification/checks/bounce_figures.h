#pragma once
/// Figs. 7 and 8 of [Lee2025]: the bouncing block's histories beside the exact bounce.

#include "verification/checks/case_run.h"

namespace hdem::verification
{
class BounceFigures
{
  public:
    /// Velocity, height and energies of a run at the smallest step: a column of Fig. 7.
    void add_histories(const CaseRun& run, const std::string& method);
    /// Velocities of one method, a run per step, and the errors of these runs beside those of Table 4: a column of Fig. 8.
    void add_steps(const std::string& method, const std::vector<Series>& velocities, const Series& errors,
                   const Series& paper_errors);
    void add_to(Report& report) const;

  private:
    std::vector<Panel> velocity_, height_, energy_;  ///< one per method
    std::vector<Panel> steps_, errors_;
};

/// The velocity after cycle c is that at (c - 1/2) dt.
[[nodiscard]] Series velocity_series(const std::string& name, const CaseRun& run);
}  // namespace hdem::verification
