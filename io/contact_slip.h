#pragma once
/// How far the two sides of a joint have slid.

#include "core/contact/contact_report.h"

namespace hdem
{
/// Slip of the second block against the shear axis, relative to the first, in the middle of the contact, since the stage began [m].
[[nodiscard]] double slip_of(const Blocks& blocks, const ContactReport& contact);
}  // namespace hdem
