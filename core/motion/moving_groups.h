#pragma once
/// Blocks that move together: what holds them from outside, and so how local damping may act on them.

#include "core/model/model.h"
#include "core/state/blocks.h"
#include "core/state/contacts.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <limits>
#include <vector>

namespace hdem
{
/// Which blocks are looked at.
struct GroupRule
{
    double speed = std::numeric_limits<double>::infinity();  ///< faster ones, or of whose rim [m/s]
};

/// Are groups looked for in the cycle that follows so many of the stage? Looking takes as long as a fifth of a cycle of rock whose blocks are all fast. So it is
/// done in each of a stage's first cycles, in which most of what falls gets free, and then now and then.
[[nodiscard]] constexpr bool looks_for_groups(std::int64_t cycles_of_stage)
{
    constexpr std::int64_t always = 64, every = 8;
    return cycles_of_stage < always || cycles_of_stage % every == 0;
}

/// Blocks of `range` that are so fast and free to move and turn. Appends to `fast`.
void find_fast(IndexRange range, const Model& model, const GroupRule& rule, const Blocks& blocks, std::vector<Index>& fast);

/// Groups of fast blocks. Local damping stands for what the rock around takes up: a block is held back by no more than the friction that its joints have left. But joints
/// between blocks that fall or slide together hold nothing: a stack of two fell with 0.2 g, and slid 0.16 m where one block slides 0.91 m. So
///
///   that touch nothing outside of the group        are not damped
///   whose joints to the outside all slide          are damped across the most loaded of these joints only
///   others                                         as each block by itself
///
/// A group of the first kind is made of all blocks that touch each other; one of the second kind of those whose joints with each other do not slide.
class MovingGroups
{
  public:
    /// @param fast  ascending
    /// @param bolted  blocks with other forces between them than those of contacts: a group with one of them is left as it is
    /// @param moving  members of groups of both kinds
    void find(const GroupRule& rule, const std::vector<Index>& fast, const std::vector<Index>& bolted, const Blocks& blocks,
              const Contacts& contacts, const BlockContacts& list, std::vector<MovingBlock>& moving);

  private:
    struct Joint
    {
        double load = -1.0;           ///< squared, of the most loaded one [N2]
        double t_x = 1.0, t_y = 0.0;  ///< its direction
        [[nodiscard]] bool is_there() const { return load > 0.0; }
    };
    struct Member
    {
        Index block;
        Index touching, together;  ///< parents, in members
        bool touches = false;      ///< something that does not belong to the fast ones
        bool is_held = false;      ///< by a joint that does not slide
        Joint joint;               ///< to the outside that slides
        bool is_alone = true;      ///< nothing moves together with it
    };
    Index root(Index member, Index Member::*parent);
    void join(Index a, Index b, Index Member::*parent);
    void look_at(Index member, Index contact, const GroupRule& rule, const Blocks& blocks, const Contacts& contacts);
    void gather();
    void choose(std::vector<MovingBlock>& moving);

    std::vector<Index> place_;  ///< of a block in members; no_index: not fast
    std::vector<Member> members_;
};

/// Let damping know, once forces are summed. Blocks that have become slow since groups were looked for are left out. Writes: force of these blocks.
void mark_moving(IndexRange range, const Model& model, const GroupRule& rule, const std::vector<MovingBlock>& moving,
                 Blocks& blocks);
}  // namespace hdem
