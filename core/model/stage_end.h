#pragma once
/// Ends of a stage that its case asks for besides "converged", such as "displacement:slab > 0.1". io/stage_end_text reads them,
/// core/stage/stage_ends looks at them.

#include <cstdint>
#include <string>
#include <vector>

namespace hdem
{
enum class EndQuantity
{
    displacement,            ///< greatest of the blocks, since the stage began [m]
    speed,                   ///< greatest of the blocks [m/s]
    unbalanced_force_ratio,  ///< of all free blocks [-]
    history,                 ///< a column of a [[history]]
    time,                    ///< since the stage began [s]
    cycles,                  ///< since the stage began
    quiet                    ///< joints that open, close, slide or break
};

enum class EndTest
{
    above,   ///< the limit is reached from below
    below,   ///< or from above
    within,  ///< all values of a time lie in a band of this width
    nothing  ///< of `quiet`
};

struct StageEndDef
{
    std::string text;  ///< as the case says it
    EndQuantity quantity = EndQuantity::displacement;
    std::vector<std::string> blocks;  ///< names; empty: all free blocks
    std::string history;              ///< name of the [[history]]
    std::string column;               ///< its column
    EndTest test = EndTest::above;
    double limit = 0.0;           ///< in the quantity's unit
    double for_time = 0.0;        ///< it must hold for so long [s]
    std::int64_t for_cycles = 0;  ///< or for so many cycles

    /// Is it an end that rock comes to when it settles? Then it is not looked at while loads change, nor in the first cycles of a stage.
    [[nodiscard]] bool is_settling() const
    {
        return test == EndTest::within || test == EndTest::nothing || (test == EndTest::below && quantity != EndQuantity::history);
    }
    /// Does it come by itself, whatever the rock does?
    [[nodiscard]] bool is_by_clock() const { return quantity == EndQuantity::time || quantity == EndQuantity::cycles; }
};
}  // namespace hdem
