#include "core/motion/contact_tie.h"

#include "core/contact/regime.h"

#include <cmath>

namespace hdem
{
EdgeTouch touch_of(Index contact, const Blocks& blocks, const Contacts& contacts)
{
    return touch_edges(contacts.edges(contact), blocks.motion[contacts.ref[contact]], blocks.motion[contacts.inc[contact]]);
}

Tie tie_of(Index contact, int end, double fast, const Blocks& blocks, const Contacts& contacts)
{
    const std::uint8_t regime = contacts.regime[end][contact];
    if (regime == static_cast<std::uint8_t>(Regime::open))
        return Tie::none;
    if (regime == static_cast<std::uint8_t>(Regime::impulse))
        return std::abs(touch_of(contact, blocks, contacts).point[end].v_t) > fast ? Tie::slides : Tie::sticks;
    if (contacts.normal_force(end, contact) == 0.0 && contacts.shear_force(end, contact) == 0.0)
        return Tie::none;
    return regime == static_cast<std::uint8_t>(Regime::slip) ? Tie::slides : Tie::sticks;
}

bool are_together(Index contact, double fast, const Blocks& blocks, const Contacts& contacts)
{
    for (int end = 0; end < 2; ++end)
    {
        const auto regime = static_cast<Regime>(contacts.regime[end][contact]);
        if (regime == Regime::stick || (regime != Regime::open && tie_of(contact, end, fast, blocks, contacts) != Tie::slides))
            return true;
    }
    return false;
}

bool do_touch(Index contact, const Contacts& contacts)
{
    return (contacts.regime[0][contact] | contacts.regime[1][contact]) != 0;
}
}  // namespace hdem
