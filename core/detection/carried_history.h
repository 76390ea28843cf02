#pragma once
/// Carries the history of a contact to its new features: forces, memory of the joint, energy.

#include "core/model/model.h"
#include "core/state/blocks.h"
#include "core/state/contacts.h"

#include <vector>

namespace hdem
{
/// Forces of the old points go to the nearest new point. A shear force keeps the component along the new edge if that runs
/// within about 25 degrees of the old one; across a corner it is dropped, since it belonged to another face.
/// @return  whether it is still the same joint
bool carry_history(const std::vector<BlockMotion>& motion, const Contact& old, Contact& contact);

/// Overlaps and length that the new features would have had in the last cycle: overlaps one step back, bearing length as it is.
void start_points(const std::vector<BlockMotion>& motion, double dt, Contact& contact);

/// Springs of new features hold no more energy than the old ones did.
///
/// Example: a corner that turns past the middle between its two sides may pass from a contact length of 0.1 m to one of 0.7 m. With the whole overlap, its new
/// spring would hold seven times the energy, which nobody put in. The excess of the overlap becomes rest overlap, as after impulses (contact/force_law.h).
/// If the new springs hold less, the difference is lost.
/// The same holds where the old ones held nothing: a corner that slides off one face may be millimetres behind the next.
void limit_energy(const JointTable& joints, const Contact& old, Contact& contact);
}  // namespace hdem
