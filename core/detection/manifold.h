#pragma once
/// Which two edges of a pair of parts face each other: a separating-axis search, and how history follows its result.

#include "core/model/model.h"
#include "core/state/blocks.h"
#include "core/state/contacts.h"

namespace hdem
{
/// Law of the joint between the two edges of a contact, as it was drawn.
/// @pre its features were searched
[[nodiscard]] Index joint_of(const Model& model, const Contact& contact);

/// Search the features of the pair (contact.part_a, contact.part_b) at the blocks' present poses and store them.
///
/// Axes are the outward normals of all edges of both parts. A pair apart along any of them (also an internal edge's) is
/// apart. Otherwise the reference edge is the external edge of least overlap, and the incident edge is the other part's
/// external edge that faces it most squarely. An edge behind whose line only a reflex corner of the other block lies is no axis: the block goes on
/// in the part beside it. A pair that overlaps less across an internal edge than across any external one may bear nothing (detection/bearing_part.h). The
/// pair whose edges lie over each other by no more than a corner bears nothing either. The
/// previous reference edge is kept unless another one's overlap is less by a margin (a tenth of the length floor), since shear history lives on the
/// contact and must not jump between edges.
/// On a change of features each point's forces go to the nearest new point, if the new edge runs in nearly the same direction. Then it is the same joint; any other has no
/// cohesion, since the blocks have met after the start (stress/drawn_joints.h).
///
/// @return distance of the two parts along the best axis, negative when they overlap [m]; with no external edge: infinite
/// @see verification/unit/core/detection/manifold_test.cpp
double find_features(const Model& model, const Blocks& blocks, Contact& contact);
}  // namespace hdem
