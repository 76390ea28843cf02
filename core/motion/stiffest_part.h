#pragma once
/// The part of a model that decides the stable step.

#include "core/motion/contact_springs.h"
#include "core/motion/time_step.h"

#include <vector>

namespace hdem
{
/// Blocks that move and contacts whose springs act on them.
struct Part
{
    std::vector<Index> blocks;
    std::vector<Index> contacts;
};

/// f(spring) for each spring of a contact that counts.
template <class F>
void for_acting_springs(const Model& model, const Blocks& blocks, const Contacts& contacts, Springs which, Index i, const F& f)
{
    for_springs(model, blocks, contacts, i,
                [&](const EdgeTouch& touch, int k, const ContactSpring& normal, const ContactSpring& shear)
                {
                    const std::uint8_t regime = contacts.regime[k][i];
                    const bool counts = which == Springs::acting
                                            ? is_spring(regime)
                                            : is_closed(touch.length, touch.point[k].overlap + contacts.preload(k, i),
                                                        contacts.length_floor(i));
                    if (counts)
                        f(normal);
                    if (counts && (which == Springs::closed || regime == static_cast<std::uint8_t>(Regime::stick)))
                        f(shear);
                });
}

/// All blocks and contacts; of large models without bolts and liners the 64 stiffest blocks and three rings of neighbours. The mode of omega_max lies where blocks are stiff and light; with all
/// other blocks held, omega_max is at most as great.
[[nodiscard]] Part stiffest_part(const Model& model, const Blocks& blocks, const Contacts& contacts, Springs which);
}  // namespace hdem
