#pragma once
/// Where the nodes of a liner are in a cycle.
///
///   m (u - u_0 - dt v_0) / dt^2 = forces of beams + forces of ties + weight + pressure           implicit Euler, for x, y and rotation of each node
///
/// Nodes have the mass of their length, so that a liner that has come off falls. The scheme is implicit, because explicit nodes would bound the time step: 8e-5 s for
/// 0.15 m of shotcrete with nodes 0.25 m apart. It damps the liner's own swinging; the liner follows the rock within some cycles.
///
/// Springs that flow make the forces those of a convex energy of u. Its least value is found by Newton's method with a line search. The matrix is factored anew
/// only where what flows, the step or the stiffness has changed: most cycles solve once.
///
/// Small displacements and rotations: beams keep the directions that they were drawn in.

#include "core/support/liner_beam.h"
#include "core/support/liner_memory.h"
#include "core/support/liner_tie.h"

#include <Eigen/SparseCholesky>

#include <cstdint>
#include <vector>

namespace hdem
{
/// What acts on a liner in one cycle.
struct LinerLoad
{
    double step = 0.0;               ///< since the last cycle [s]
    double factor = 1.0;             ///< of modulus and strengths
    double pressure = 0.0;           ///< [Pa]
    Vec2 gravity = {0.0, 0.0};       ///< [m/s2]
    std::vector<Vec2> rock;          ///< two a segment: how far its points of the rock have moved since it was installed [m]
    std::vector<std::uint8_t> gone;  ///< a segment each: is there no block behind it?
};

/// How near to balance a liner is, its inertia left aside.
struct LinerBalance
{
    double unbalanced = 0.0;  ///< greatest net force of a node over the mean load of the nodes: their weight, pressure and ties [-]
    double whole = 0.0;       ///< net force of all nodes together over the sum of weight and pressure [-]
    bool is_at_strength = false;  ///< in compression, tension or bending, somewhere
};

class LinerSolver
{
  public:
    explicit LinerSolver(Liner liner);

    /// Move `memory.moved` and `memory.velocity` on by a cycle. What flows is not booked yet: see beam and tie.
    void solve(const LinerLoad& load, const LinerMemory& memory);

    /// Balance of the present nodes. Without gravity their weight is that on earth, as in the criteria of blocks.
    [[nodiscard]] LinerBalance balance(const LinerLoad& load, const LinerMemory& memory);

    /// Answers of segment s for the present nodes.
    [[nodiscard]] BeamAnswer beam(std::size_t s, const LinerLoad& load, const LinerMemory& memory) const;
    [[nodiscard]] TieAnswer tie(std::size_t s, int end, const LinerLoad& load, const LinerMemory& memory) const;

  private:
    void assemble(const LinerLoad& load, const LinerMemory& memory);
    void add_beam(std::size_t s, const BeamAnswer& answer);
    void add_tie(std::size_t s, int end, const TieAnswer& answer);
    void add(Index row, Index column, double value);
    void factorise(const LinerLoad& load);

    Liner liner_;
    std::vector<double> mass_;  ///< of each of the three numbers of each node
    std::vector<double> aim_;   ///< where each would be without forces
    Eigen::VectorXd net_, step_;
    std::vector<double> from_;
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors_;
    std::vector<std::uint8_t> flows_, factored_flows_;  ///< what flows in each segment
    double energy_ = 0.0, size_ = 0.0, scale_ = 0.0, factored_step_ = -1.0, factored_factor_ = -1.0;
    bool has_pattern_ = false, needs_matrix_ = true;
};
}  // namespace hdem
