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

/// Are groups looked for among all blocks in the cycle that follows so many of the stage, where many are fast? If all are, looking takes as long as a good part of a cycle. So it is done in
/// each of a stage's first cycles, in which most of what falls gets free, and then now and then. In between only those that are known are looked at again, in each cycle: a group that hits
/// something is damped from then on.
[[nodiscard]] bool looks_for_groups(std::int64_t cycles_of_stage, bool there_are_some);

/// Blocks of `range` that are so fast and free to move and turn. Appends to `fast`.
void find_fast(IndexRange range, const Model& model, const GroupRule& rule, const Blocks& blocks, std::vector<Index>& fast);

/// Groups of fast blocks. Local damping stands for what the rock around takes up: a block is held back by no more than the friction that its joints have left. But joints
/// between blocks that fall or slide together hold nothing: a stack of two fell with 0.2 g, and slid 0.16 m where one block slides 0.91 m. So
///
///   that touch nothing outside of the group        are not damped
///   whose joints to the outside all slide          are damped across the most loaded of these joints only
///   others                                         as each block by itself
///
/// A block without bolts that all others meet in one point, and that tips about it away from where it stood, is not damped either. Damped it tipped at half of its speed, and crept where it
/// slid, too: 1 m x 2.5 m on 45 degrees, friction 30, went 0.2 m/s after half a second, not 1.8.
///
/// A group of the first kind is made of all blocks that touch each other; one of the second kind of those whose joints with each other do not slide.
class MovingGroups
{
  public:
    /// @param fast  ascending
    /// @param bolted  blocks with other forces between them than those of contacts: a group with one of them is left as it is
    /// @param moving  members of groups of both kinds
    void find(const Model& model, const GroupRule& rule, const std::vector<Index>& fast, const std::vector<Index>& bolted,
              const Blocks& blocks, const Contacts& contacts, const BlockContacts& list, std::vector<MovingBlock>& moving);

  private:
    struct Member
    {
        Index block;
        bool touched = false;    ///< it, or a member that it touches, touches what is not fast
        bool held = false;       ///< by a joint that does not slide, or together with such a member
        bool touches = false;    ///< anything
        Index group = no_index;  ///< of those that are not held
    };
    struct Group
    {
        double load = 0.0;  ///< of its most loaded joint that slides, squared [N2]
        Index contact = no_index;
        bool is_alone = true;  ///< it has one member
    };
    struct View
    {
        const GroupRule& rule;
        const Blocks& blocks;
        const Contacts& contacts;
        const BlockContacts& list;
    };

    void take_members(const std::vector<Index>& fast, Index blocks);
    void look_outside(const View& view);
    void take_outside(Member& member, Index contact, const View& view);
    template <bool Member::*reached, typename Passes>
    void flood(const View& view, const Passes& passes);
    void find_groups(const View& view);
    void gather(Index member, const View& view);

    std::vector<Index> place_;  ///< of a block in members; no_index: not fast
    std::vector<Member> members_;
    std::vector<Group> groups_;
    std::vector<Index> queue_;  ///< members
};

/// Let damping know, once forces are summed. Writes: force of these blocks.
void mark_moving(IndexRange range, const std::vector<MovingBlock>& moving, Blocks& blocks);
}  // namespace hdem
