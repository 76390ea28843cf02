#pragma once
/// Slow blocks that fast ones drag or push along.

#include "core/motion/contact_tie.h"
#include "core/motion/fast_blocks.h"
#include "core/state/state.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// Slow blocks that a fast one touches, with all blocks that stick to them. They are not damped if all of their other joints slide: local damping would take
/// what the fast block gives them. Else they are held, like the rock that fallen blocks slide over. One that was dragged goes on undamped until it stops: blocks that push each
/// other along touch now and then only.
class DraggedBlocks
{
  public:
    /// @param fast    ascending
    /// @param bolted  blocks with other forces between them than those of contacts: their group is left as it is
    /// @param before  of the cycle before
    /// @param moving  what is found is added, in the order of blocks
    void find(const Model& model, const GroupRule& rule, const std::vector<Index>& fast, const std::vector<Index>& bolted,
              const std::vector<MovingBlock>& before, const ContactTies& ties, std::vector<MovingBlock>& moving);

  private:
    enum class Mark : std::uint8_t
    {
        unknown,
        searched,
        held,
        dragged
    };

    void clear(Index blocks);
    /// Nothing, if it is known.
    void search_from(Index seed, const ContactTies& ties);
    [[nodiscard]] bool is_held(Index block, const ContactTies& ties);
    void set(Index block, Mark mark);

    std::vector<Mark> mark_;     ///< of each block; unknown between two calls
    std::vector<Index> marked_;  ///< all others
    std::vector<Index> group_;
};
}  // namespace hdem
