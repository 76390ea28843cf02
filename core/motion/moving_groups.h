#pragma once
/// Groups of blocks that move together. What holds a group from outside decides how local damping acts on it.

#include "core/motion/contact_tie.h"
#include "core/motion/dragged_blocks.h"
#include "core/motion/fast_blocks.h"
#include "core/state/state.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// Are groups searched for among all blocks, in the cycle that follows so many cycles of the stage? If all blocks are fast, a search takes a good part of
/// a cycle's time. So it is made in each of a stage's first cycles, in which most falling blocks come free, and later now and then. In between, only the
/// known groups are checked, in each cycle: a group that hits something is damped from then on.
[[nodiscard]] bool looks_for_groups(std::int64_t cycles_of_stage, bool there_are_some);

/// Groups of fast blocks. Local damping stands for the energy that the surrounding rock takes up, so it holds a block back by no more than the unused
/// friction of its joints. But joints between blocks that fall or slide together hold nothing back. So groups
///
///   that touch nothing outside of the group        are not damped
///   whose joints to the outside all slide          are damped across the most loaded of these joints only
///   the same, if they must turn as they slide      are not damped
///   others                                         as each block by itself
///
/// A group must turn if these joints have several directions (a bar that slides down between two planes), or if its members hold each other in one point (two slabs
/// that lean on each other): then it moves across each of the joints, too. At most eight members count as such a body (core/tried.md). A joint that is hardly open
/// counts as well, since blocks hop on their springs. Outside is what is not fast. A group that slides on fast blocks alone is not damped: across that joint it is
/// accelerated with them. Where rest is sought, slow blocks that are dragged are not damped either (dragged_blocks.h).
///
/// A block without bolts that all others meet in one point, and that tips about this point away from where it stood, is not damped either (core/tried.md). Nor are, but where rest is sought, a group that tips so and a block
/// that rolls on over its faces: fallen blocks would roll and rock on for long.
///
/// A group of the first kind is made of all blocks that touch each other; one of the second kind of those whose joints with each other do not slide.
class MovingGroups
{
  public:
    /// @param fast  ascending
    /// @param bolted  blocks with other forces between them than those of contacts: a group with one of them is left as it is
    /// @param moving  members of groups of the first two kinds, and blocks that tip, ride or are dragged; before the call those of the cycle before
    void find(const Model& model, const GroupRule& rule, const std::vector<Index>& fast, const std::vector<Index>& bolted,
              const ContactTies& ties, std::vector<MovingBlock>& moving);

  private:
    enum class Search : std::uint8_t
    {
        to_come,
        goes_on,
        ended
    };
    struct Member
    {
        Index block;
        bool touched = false;  ///< it, or a member that it touches, touches what is not fast
        bool held = false;     ///< by a joint that does not slide, or together with such a member
        bool touches = false;  ///< anything
        bool bolted = false;
        bool tips = false;
        Search search = Search::to_come;  ///< for groups that tip
        Index group = no_index;           ///< of those that are not held
    };
    struct Group
    {
        double load = 0.0;  ///< of its most loaded joint to the outside, squared [N2]
        Index contact = no_index;
        bool rides = false;    ///< slides on a fast block
        bool is_alone = true;  ///< it has one member
        bool turns = false;    ///< it must, as it slides
    };
    void take_members(const std::vector<Index>& fast, Index blocks);
    void look_outside(const ContactTies& ties);
    void take_outside(Member& member, Index contact, const ContactTies& ties);
    template <bool Member::*reached, typename Passes>
    void flood(const ContactTies& ties, const Passes& passes);
    void find_groups(const ContactTies& ties);
    void find_tipping(const Model& model, const GroupRule& rule, const ContactTies& ties);
    [[nodiscard]] bool gather_together(const ContactTies& ties, std::vector<Index>& group);
    void gather(Index member, const ContactTies& ties);
    void take_joint(Index contact, bool outside, Group& group, const ContactTies& ties);
    void take_direction(Index contact, const ContactTies& ties);
    [[nodiscard]] bool have_directions(const Group& group, const ContactTies& ties) const;
    [[nodiscard]] MovingBlock motion_of(const Member& member, const ContactTies& ties) const;

    std::vector<Index> place_;  ///< of a block in members; no_index: not fast
    std::vector<Member> members_;
    std::vector<Group> groups_;
    std::vector<Vec2> along_;   ///< directions of joints to the outside of the group that is gathered
    std::vector<Index> queue_;  ///< members
    std::vector<Index> left_;   ///< members that are not reached yet
    std::vector<MovingBlock> before_;
    DraggedBlocks dragged_;
};

/// Mark these blocks for damping, once forces are summed. Writes: force of these blocks.
void mark_moving(IndexRange range, const std::vector<MovingBlock>& moving, Blocks& blocks);
}  // namespace hdem
