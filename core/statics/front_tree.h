#pragma once
/// Which blocks each front eliminates, which it touches, and where it hands on what is left: the symbolic part of the factorisation.

#include "core/statics/dissection.h"
#include "core/statics/front.h"

namespace hdem
{
/// Fronts in the order of elimination: the fronts below one, its subtree, stand right before it.
///
/// J. W. H. Liu, The multifrontal method for sparse matrix solution: theory and practice, SIAM Rev. 34 (1992) 82-109.
/// C. Ashcraft, R. Grimes, The influence of relaxed supernode partitions on the multifrontal method, ACM Trans. Math. Softw. 15 (1989) 291-309: fronts
/// are joined with their parents where the zeros that this stores cost less than a front of its own.
struct FrontTree
{
    std::vector<Index> order;               ///< block at each place of the elimination
    std::vector<Index> place;               ///< its inverse
    std::vector<Index> own_begin = {0};     ///< per front + 1: places that it eliminates
    std::vector<Index> border_begin = {0};  ///< per front + 1
    std::vector<Index> border;              ///< places of later fronts that it touches, ascending
    std::vector<Index> row_in_parent;       ///< per entry of border: block row in the parent's front, own blocks counted first
    std::vector<Index> parent;              ///< per front, or no_index
    std::vector<Index> child_begin = {0};   ///< per front + 1
    std::vector<Index> child;               ///< ascending

    [[nodiscard]] Index fronts() const { return static_cast<Index>(parent.size()); }
    [[nodiscard]] Index own(Index front) const { return own_begin[front + 1] - own_begin[front]; }
    [[nodiscard]] FrontShape shape(Index front) const
    {
        return {3 * own(front), 3 * (border_begin[front + 1] - border_begin[front])};
    }
    [[nodiscard]] std::span<const Index> border_of(Index front) const
    {
        return {border.data() + border_begin[front], border.data() + border_begin[front + 1]};
    }
    [[nodiscard]] std::span<const Index> children(Index front) const
    {
        return {child.data() + child_begin[front], child.data() + child_begin[front + 1]};
    }
};

/// Operations to eliminate the own unknowns of a front.
[[nodiscard]] double operations(const FrontShape& shape);

[[nodiscard]] FrontTree make_front_tree(const BlockGraph& graph, const EliminationOrder& order);
}  // namespace hdem
