#pragma once
/// Energies of springs, as many contacts at once as a pack has lanes.

#include "core/contact/contact_lanes.h"
#include "core/energy_ledger.h"

namespace hdem
{
template <typename P>
struct BasicEnergyLanes
{
    P held = 0.0, shear = 0.0, pending = 0.0;
};

template <typename P>
[[nodiscard]] inline BasicEnergyLanes<P> energies_of(const ContactLanes& l, const BasicMotion<P>& ref, const BasicMotion<P>& inc,
                                                     const BasicCoulombSlip<P>& joint, const std::array<MaskOf<P>, 2>& spring, P dt)
{
    const auto load = [&l](const ContactLanes::Lane& lane) { return load_lane<P>(l, lane); };
    const P zero = 0.0, half = 0.5, length = load(l.last_length);
    const P shear_stiffness = joint.shear_stiffness * length;
    const BasicEdgeTouch<P> touch = touch_edges(load_edges<P>(l), ref, inc);
    BasicEnergyLanes<P> sums;
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<P>& p = touch.point[k];
        const TurningRate<P> turning(p, touch.slope, ref.w, inc.w);
        const P normal_force = load(l.normal_force[k]), shear_force = load(l.shear_force[k]);
        const P last_overlap = load(l.overlap[k]), last_rest = load(l.rest_overlap[k]);
        const P stretch = last_overlap - last_rest;
        // Ways with the velocities of now as they were when the forces acted.
        const P next = last_overlap + (p.v_m - turning.m * dt) * dt - last_rest;
        const P slide = shear_force / shear_stiffness - (p.v_t - half * turning.t * dt) * dt;
        const P held_shear = select(shear_force == zero, zero, half * shear_force * shear_force / shear_stiffness);
        const P both = max(stretch, zero) * max(next, zero);
        const auto add = [&](P& sum, P energy) { sum += select(spring[k], energy, zero); };
        add(sums.held, half * normal_force * stretch + held_shear);
        add(sums.shear, half * shear_force * slide);
        add(sums.pending, half * normal_force * next - half * joint.normal_stiffness * length * both);
    }
    return sums;
}

/// Adds contact by contact, in their order: the sums do not depend on the width of P. `range` begins at a multiple of that width.
template <typename P>
inline void add_energies(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts, SpringEnergies& sums)
{
    LawLanes<P> laws(model.joints.laws);
    const P dt = blocks.step.last;
    const bool has_memory = model.joints.has_memory();
    for (Index i = range.begin; i < range.end; i += P::width)
    {
        const auto are_here = [i](const std::vector<std::uint8_t>& regime) { return are_springs(&regime[i], MaskOf<P>{}); };
        const std::array<MaskOf<P>, 2> spring = {are_here(contacts.regime[0]), are_here(contacts.regime[1])};
        const MaskOf<P> counts = spring[0] | spring[1];
        if (!any(counts))
            continue;
        const auto motions = [&](const std::vector<Index>& of) { return load_motions<P>(blocks.motion, &of[i]); };
        const BasicEnergyLanes<P> found = energies_of<P>(contacts.lane[i / lanes], motions(contacts.ref), motions(contacts.inc),
                                                         laws.load(&contacts.law[i]).law, spring, dt);
        for (int lane = 0; lane < P::width; ++lane)  // what is no spring adds 0
        {
            const bool remembers = has_memory && counts.has(lane) && model.joints.has_memory(contacts.law[i + lane]);
            sums.held += remembers ? contacts.held_energy(i + lane) : found.held.v[lane];
            sums.shear += found.shear.v[lane];
            sums.pending += remembers ? 0.0 : found.pending.v[lane];
        }
    }
}
}  // namespace hdem
