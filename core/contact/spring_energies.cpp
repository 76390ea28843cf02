// Compiled for several kinds of processors: core/kernels.h.
#include "core/contact/contact_lanes.h"
#include "core/kernels_here.h"

namespace hdem
{
inline namespace HDEM_LANES
{
namespace
{
struct EnergyLanes
{
    Pack held = 0.0, shear = 0.0, pending = 0.0;
};

EnergyLanes energies_of(const ContactLanes& l, const BasicMotion<Pack>& ref, const BasicMotion<Pack>& inc,
                        const BasicCoulombSlip<Pack>& joint, const std::array<Mask, 2>& spring, Pack dt)
{
    const Pack zero = 0.0, half = 0.5, length = load_lane(l.last_length);
    const Pack shear_stiffness = joint.shear_stiffness * length;
    const BasicEdgeTouch<Pack> touch = touch_edges(load_edges<Pack>(l), ref, inc);
    EnergyLanes sums;
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<Pack>& p = touch.point[k];
        const TurningRate<Pack> turning(p, touch.slope, ref.w, inc.w);
        const Pack normal_force = load_lane(l.normal_force[k]), shear_force = load_lane(l.shear_force[k]);
        const Pack last_overlap = load_lane(l.overlap[k]), last_rest = load_lane(l.rest_overlap[k]);
        const Pack stretch = last_overlap - last_rest;
        // Ways with the velocities of now as they were when the forces acted.
        const Pack next = last_overlap + (p.v_m - turning.m * dt) * dt - last_rest;
        const Pack slide = shear_force / shear_stiffness - (p.v_t - half * turning.t * dt) * dt;
        const Pack held_shear = select(shear_force == zero, zero, half * shear_force * shear_force / shear_stiffness);
        const Pack both = max(stretch, zero) * max(next, zero);
        const auto add = [&](Pack& sum, Pack energy) { sum += select(spring[k], energy, zero); };
        add(sums.held, half * normal_force * stretch + held_shear);
        add(sums.shear, half * shear_force * slide);
        add(sums.pending, half * normal_force * next - half * joint.normal_stiffness * length * both);
    }
    return sums;
}
}  // namespace

void add_spring_energies(const Model& model, const Blocks& blocks, const Contacts& contacts, SpringEnergies& sums)
{
    LawLanes<Pack> laws(model.joints.laws);
    const Pack dt = blocks.step.last;
    for (Index i = 0; i < contacts.size(); i += lanes)
    {
        const std::array<Mask, 2> spring = {are_springs(&contacts.regime[0][i]), are_springs(&contacts.regime[1][i])};
        const Mask counts = spring[0] | spring[1];
        if (!any(counts))
            continue;
        const auto motions = [&](const std::vector<Index>& of) { return load_motions<Pack>(blocks.motion, &of[i]); };
        const EnergyLanes four = energies_of(contacts.lane[i / lanes], motions(contacts.ref), motions(contacts.inc),
                                             laws.load(&contacts.law[i]).law, spring, dt);
        for (int lane = 0; lane < lanes; ++lane)
        {
            if (!counts.has(lane))
                continue;
            const bool remembers = model.joints.has_memory(contacts.law[i + lane]);
            sums.held += remembers ? contacts.held_energy(i + lane) : four.held.v[lane];
            sums.shear += four.shear.v[lane];
            sums.pending += remembers ? 0.0 : four.pending.v[lane];
        }
    }
}
}  // namespace HDEM_LANES
}  // namespace hdem
