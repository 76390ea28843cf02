#pragma once
/// Forces of liners in a cycle: liners follow the rock behind them and press on it. Laws: liner_beam.h, liner_tie.h; where the nodes are: liner_solver.h.
///
/// A liner that is installed has no force in it, whatever the rock has done before: ties and beams count from there.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <memory>
#include <vector>

namespace hdem
{
class LinerSolver;

/// Solvers of a model's liners. All that they hold follows from the state.
class LinerSolvers
{
  public:
    LinerSolvers();
    ~LinerSolvers();
    LinerSolvers(LinerSolvers&&) noexcept;
    LinerSolvers& operator=(LinerSolvers&&) noexcept;

    [[nodiscard]] LinerSolver& of(const Model& model, std::size_t liner);

  private:
    std::vector<std::unique_ptr<LinerSolver>> solvers_;
};

/// Install the liners of the stage that has begun, at the present places of the blocks.
/// @return  whether there are any
bool install_liners(const Model& model, State& state);

/// Append the forces of the liners in this cycle to `pushes`, in their order. Also finds what yields, slips and parts.
void press_liners(const Model& model, State& state, LinerSolvers& solvers, std::vector<BlockPush>& pushes);

/// Forces in a liner as they are now: one a segment.
struct LinerForce
{
    double thrust = 0.0;    ///< compression positive [N]
    double shear = 0.0;     ///< [N]
    double moment[2] = {};  ///< at its ends; positive: its inside is stretched [N m]
};
/// Where the nodes of a liner are now [m].
[[nodiscard]] std::vector<Vec2> liner_nodes(const Model& model, const State& state, std::size_t liner);
[[nodiscard]] std::vector<LinerForce> liner_forces(const Model& model, const State& state, std::size_t liner);
}  // namespace hdem
