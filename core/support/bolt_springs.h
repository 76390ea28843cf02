#pragma once
/// Bolts and liners as rows of a stiffness matrix, for the time step. All bolts and liners of the case count, from the start and whatever their state. So
/// the step of a case does not depend on when they are installed.

#include "core/motion/contact_springs.h"
#include "core/support/bolt_link.h"

namespace hdem
{
/// One direction in which a link resists.
struct LinkSpring
{
    double stiffness = 0.0;  ///< [N/m]
    Vec3 first, second;      ///< derivative of its stretch by the motion of the first block, of the second [-, -, m]
};

/// Call `use(spring)` for the springs of a link.
template <typename Use>
void for_link_springs(const Bolt& bolt, const BoltLink& link, const Blocks& blocks, const Use& use)
{
    const LinkPlace at = place_of(bolt, link, blocks);
    const auto row = [&](const Vec2& n, Index block, const Vec2& place)
    {
        const Vec2 arm = place - Vec2(blocks.motion[block].x, blocks.motion[block].y);
        return Vec3(n.x(), n.y(), cross(arm, n));
    };
    const auto spring = [&](double stiffness, const Vec2& n, const Vec2& first, const Vec2& second)
    {
        if (stiffness > 0.0)
            use(LinkSpring{stiffness, -row(n, link.first, first), row(n, link.second, second)});
    };
    const Vec2 middle = 0.5 * (at.first + at.second);
    spring(link.axial_stiffness, at.line, at.first, at.second);
    spring(link.transverse_stiffness, turned_left(at.axis), middle, middle);
}

/// Call `use(spring, own, other, other block)` for the springs of a block's links, with the rows of the block and of the other one.
template <typename Use>
void for_bolt_springs(const Model& model, const Blocks& blocks, Index block, const Use& use)
{
    if (model.support.ends.empty())
        return;
    const IndexRange ends = ends_of(model.support, block);
    for (Index e = ends.begin; e < ends.end; ++e)
    {
        const BoltEnd& end = model.support.ends[e];
        const Bolt& bolt = model.support.bolts[end.bolt];
        const BoltLink& link = bolt.links[end.link];
        for_link_springs(bolt, link, blocks,
                         [&](const LinkSpring& s)
                         {
                             if (end.is_first)
                                 use(s.stiffness, s.first, s.second, link.second);
                             else
                                 use(s.stiffness, s.second, s.first, link.first);
                         });
    }
}

/// The same for the ties of liners. They hold the block against the liner, which counts as fixed.
template <typename Use>
void for_tie_springs(const Model& model, const Blocks& blocks, Index block, const Use& use)
{
    if (model.support.ties.empty())
        return;
    const BlockMotion& m = blocks.motion[block];
    const IndexRange ties = ties_of(model.support, block);
    for (Index i = ties.begin; i < ties.end; ++i)
    {
        const LinerTie& tie = model.support.ties[i];
        const Liner& liner = model.support.liners[tie.liner];
        const LinerSegment& segment = liner.segments[tie.segment];
        const Vec2 arm = turned_with(m, segment.arm[tie.end]), n = segment.to_rock();
        use(0.5 * segment.length * liner.normal_stiffness, Vec3(n.x(), n.y(), cross(arm, n)));
        use(0.5 * segment.length * liner.shear_stiffness, Vec3(segment.along.x(), segment.along.y(), cross(arm, segment.along)));
    }
}

/// Add the stiffness of a block's links and ties, in coordinates in which its mass matrix is the unit matrix (stable_step, core/motion/time_step.h).
/// @param own       its inverse masses, 0 where it does not move
/// @param of_other  the same of another block
template <typename OfOther>
void add_bolt_rows(const Model& model, const Blocks& blocks, Index block, const Vec3& own, const OfOther& of_other,
                   Eigen::Matrix3d& sum)
{
    const Vec3 root = own.cwiseSqrt();
    for_bolt_springs(model, blocks, block,
                     [&](double stiffness, const Vec3& own_row, const Vec3& other_row, Index other)
                     {
                         const Vec3 row = root.cwiseProduct(own_row);
                         const double mine = row.squaredNorm();
                         const double others = of_other(other).cwiseSqrt().cwiseProduct(other_row).squaredNorm();
                         if (mine > 0.0)
                             sum += stiffness * (1.0 + others / mine) * row * row.transpose();
                     });
    for_tie_springs(model, blocks, block,
                    [&](double stiffness, const Vec3& own_row)
                    {
                        const Vec3 row = root.cwiseProduct(own_row);
                        sum += stiffness * row * row.transpose();
                    });
}

/// Lower bound on the stable step of the bolts alone [s]: by block, as stable_step (core/motion/time_step.h).
[[nodiscard]] double stable_step_of_bolts(const Model& model, const Blocks& blocks);
}  // namespace hdem
