#pragma once
/// Blocks during a static solution: which are unknowns, the net forces on them, and which of them nothing holds.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"
#include "core/statics/static_contacts.h"

namespace hdem
{
/// Fewer free blocks come to rest by cycles in less time than a user notices.
inline constexpr Index least_static_blocks = 200;

/// Blocks whose places are sought.
struct Unknowns
{
    std::vector<Index> block;     ///< per unknown
    std::vector<Index> of_block;  ///< per block of the model: its unknown, or no_index
};

/// Why a block is no unknown though it is free.
enum Held : std::uint8_t
{
    not_held = 0,
    come_away = 1,  ///< it has left its place for good
    frozen = 2      ///< it keeps the others from coming to rest, and waits where it is until features are found anew
};

/// All free blocks that are not held.
[[nodiscard]] Unknowns number_unknowns(const State& state, const std::vector<std::uint8_t>& is_held);

/// Both blocks of each contact.
[[nodiscard]] std::vector<CoupledPair> coupled_pairs(const Contacts& contacts, const Unknowns& unknowns);

/// Take out of a contact's stiffness what belongs to motions that are prescribed.
void leave_out_prescribed(const BlockInertia& ref, const BlockInertia& inc, int side, Matrix36& rows);

/// Finish the diagonal of a row: 1 where a motion is prescribed, and all of it times 1 + `shift`.
void finish_diagonal(const BlockInertia& inertia, double shift, Matrix3& diagonal);

/// Sums over a range of unknowns.
struct Imbalance
{
    double sum = 0.0;      ///< |F| + |M| / r over blocks; F, M net force and moment, r radius [N]
    double applied = 0.0;  ///< weights [N]
    double worst = 0.0;    ///< greatest (|F| + |M| / r) / mass [m/s2]
    double work = 0.0;     ///< of the net forces along a step [J]

    Imbalance& operator+=(const Imbalance& other);
    [[nodiscard]] double ratio() const { return applied > 0.0 ? sum / applied : sum; }
};

/// (|F| + |M| / r) / mass of a block [m/s2].  net: its net force and moment.
[[nodiscard]] double unbalanced(const Model& model, Index block, const double* net);

/// Net forces, three per unknown: weight, what is given, and the loads of the contacts in their order, 0 where the motion is prescribed.
/// @param given  force and moment on each block of the model, or empty
/// @param step   three per block of the model, or empty
Imbalance net_forces(IndexRange unknowns, const Model& model, const State& state, const Unknowns& numbers,
                     const BlockContacts& list, std::span<const BlockLoad> loads, const std::vector<Triple>& given,
                     const std::vector<double>& step, std::vector<double>& net);

/// Put blocks where they have moved to from `start`.
/// @param moved  three per block of the model [m], [rad]
void place_blocks(IndexRange blocks, const std::vector<BlockMotion>& start, const std::vector<double>& moved, State& state);

/// Unknown blocks that have come away: no chain of points that have moved less than `far` since the start joins them to a block that stands still.
[[nodiscard]] std::vector<Index> find_loose(const State& state, const Unknowns& numbers, const std::vector<std::uint8_t>& is_held,
                                            const std::vector<ContactTangent>& tangents, const std::vector<double>& moved,
                                            double far);
}  // namespace hdem
