#pragma once
/// Compares the outcome of a scene with what certainly becomes of it.

#include "verification/rest/run.h"

#include <string>
#include <vector>

namespace hdem::verification::rest
{
/// What is judged, in the order of the table.
enum class Judged
{
    finished,     ///< without being refused or stopped
    converged,    ///< called converged where it comes to rest, and only there
    stays,        ///< blocks that stand have not moved
    moves,        ///< blocks that cannot stand have
    place,        ///< where blocks lie
    speed,        ///< at any time, against what energy allows
    energy,       ///< does not rise
    ledger,       ///< explains it
    balance,      ///< of each block, by hdem's forces, where it is called converged
    support,      ///< of each block, by forces that its shape allows, where it is called converged
    carried,      ///< forces between blocks
    overlap,      ///< of shapes at the end
    orientation,  ///< the same in the twin's placement
    threads       ///< the same bits on 1, 2 and 3
};
inline constexpr int judged_kinds = 14;
[[nodiscard]] const char* name_of(Judged what);

/// One thing looked at.
struct Finding
{
    Judged what = Judged::finished;
    double share = 0.0;  ///< of its bar; wrong above 1, or if it is not a number; infinite where it is yes or no
    std::string text;    ///< with the values
    [[nodiscard]] bool is_wrong() const { return !(share <= 1.0); }
};
using Findings = std::vector<Finding>;

/// Bars that do not depend on the scene.
struct Bars
{
    double balance = 1e-2;  ///< unbalanced force, and moment over radius, of the weight
    double overlap =
        2e-2;  ///< of the smaller block's size: a corner bears by 1e-3 of it (contact.length_floor) and gives way so much more
    double energy_rise = 1e-2;     ///< of the greatest energy
    double ledger_springs = 1e-6;  ///< of its greatest term
    double ledger_impulses = 1e-4;
    double same_place = 1e-6;  ///< of what stands, in another placement [m]
    double same_way = 5e-3;    ///< of what slides: of its way
};
inline constexpr Bars bars;

[[nodiscard]] Findings judge(const Scene& scene, const Outcome& outcome);
/// The same scene in its two placements.
[[nodiscard]] Findings judge_twins(const Scene& scene, const Outcome& outcome, const Outcome& twin);
/// A large scene on 1, 2 and 3 threads.
[[nodiscard]] Findings judge_threads(const Scene& scene);
}  // namespace hdem::verification::rest
