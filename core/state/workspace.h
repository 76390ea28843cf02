#pragma once
/// Scratch of a cycle, reused: nothing here outlives one, and nothing here is allocated after the first cycles.

#include "core/types.h"

#include <vector>

namespace hdem
{
/// What one contact gives its two blocks in this cycle, one entry per contact.
struct ContactLoads
{
    std::vector<double> x;  ///< force on inc [N]; ref receives the opposite
    std::vector<double> y;
    std::vector<double> moment_ref;  ///< about the centroid of ref [N m]
    std::vector<double> moment_inc;
    std::vector<float> mobilised;  ///< greatest share of the shear strength in use at its force points [-]
    std::vector<float> reserve;    ///< shear strength not in use at its force points [N]
    std::vector<float> t_x, t_y;   ///< direction along the edge [-]
    std::vector<double> friction;  ///< energy spent by slip in this cycle [J]
    std::vector<double> changes;   ///< EnergyLedger::contact_changes of this cycle [J]
    void resize(std::size_t n)
    {
        x.resize(n);
        y.resize(n);
        moment_ref.resize(n);
        moment_inc.resize(n);
        friction.resize(n);
        changes.resize(n);
        mobilised.resize(n);
        reserve.resize(n);
        t_x.resize(n);
        t_y.resize(n);
    }
};

/// One contact point in the impulse regime during one cycle.
struct ImpulsePoint
{
    Index contact = no_index;
    Index ref = no_index;
    Index inc = no_index;
    int end = 0;                      ///< which of the contact's two points
    double t_x = 1.0, t_y = 0.0;      ///< axis along the reference edge [-]; m is it turned left
    double ref_t = 0.0, ref_m = 0.0;  ///< point seen from the centroid of ref, in these axes [m]
    double inc_t = 0.0, inc_m = 0.0;
    double mass_normal = 0.0;  ///< collision masses, Eq. (16) [kg]
    double mass_shear = 0.0;
    double coupling = 0.0;          ///< with the other point of its contact, kept by the first of the two [1/kg]
    double target = 0.0;            ///< approach velocity that the impulse must leave [m/s]
    double friction = 0.0;          ///< tan phi [-]
    double cohesive_impulse = 0.0;  ///< c L dt [N s]
    double excess_overlap = 0.0;    ///< to be corrected, if positive [m]
    double impulse_normal = 0.0;    ///< J >= 0 [N s]
    double impulse_shear = 0.0;     ///< [N s]
    double correction = 0.0;        ///< pseudo impulse of the position correction [N s]
};

/// Three components of a block's motion.
struct Triple
{
    double x = 0.0, y = 0.0, w = 0.0;
};

struct Workspace
{
    ContactLoads loads;
    std::vector<ImpulsePoint> impulses;
    std::vector<Triple> pseudo;  ///< pseudo velocities of the position correction, per block, zero between cycles
    std::vector<Triple> loaded;  ///< velocities of loaded blocks before the step
};
}  // namespace hdem
