#include "core/motion/contact_tie.h"

#include "core/contact/regime.h"

#include <cmath>

namespace hdem
{
EdgeTouch ContactTies::touch(Index contact) const
{
    return touch_edges(contacts.edges(contact), blocks.motion[contacts.ref[contact]], blocks.motion[contacts.inc[contact]]);
}

Tie ContactTies::at(Index contact, int end) const
{
    const std::uint8_t regime = contacts.regime[end][contact];
    if (regime == static_cast<std::uint8_t>(Regime::open))
        return Tie::none;
    if (regime == static_cast<std::uint8_t>(Regime::impulse))
        return std::abs(touch(contact).point[end].v_t) > fast ? Tie::slides : Tie::sticks;
    if (contacts.normal_force(end, contact) == 0.0 && contacts.shear_force(end, contact) == 0.0)
        return Tie::none;
    return regime == static_cast<std::uint8_t>(Regime::slip) ? Tie::slides : Tie::sticks;
}

bool ContactTies::are_together(Index contact) const
{
    for (int end = 0; end < 2; ++end)
    {
        const auto regime = static_cast<Regime>(contacts.regime[end][contact]);
        if (regime == Regime::stick || (regime != Regime::open && at(contact, end) != Tie::slides))
            return true;
    }
    return false;
}
}  // namespace hdem
