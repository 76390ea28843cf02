#pragma once
/// A case definition running, and what the conservation laws say about its state.

#include "core/contact/contact_report.h"
#include "core/energy_ledger.h"
#include "core/motion/equilibrium.h"
#include "core/rock/build_model.h"
#include "core/state/state_hash.h"
#include "parallel/simulation.h"
#include "verification/scenes/scenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

namespace hdem::test
{
/// About the origin of the local coordinates, of present blocks.
struct Momentum
{
    Vec2 linear = {0.0, 0.0};  ///< [N s]
    double angular = 0.0;      ///< [N m s]
};

inline Momentum momentum(const Model& model, const Blocks& blocks)
{
    Momentum sum;
    for (Index i = 0; i < blocks.size(); ++i)
    {
        const BlockMotion& m = blocks.motion[i];
        const Vec2 v(m.vx, m.vy);
        sum.linear += model.mass[i] * v;
        sum.angular += model.inertia[i] * m.w + model.mass[i] * cross({m.x, m.y}, v);
    }
    return sum;
}

/// Energy in the springs of force-based contact points [J].
inline double elastic_energy(const Model& model, const State& state)
{
    double energy = 0.0;
    const Contacts& contacts = state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
        for (int k = 0; k < 2; ++k)
        {
            const auto regime = static_cast<Regime>(contacts.regime[k][i]);
            if (regime != Regime::stick && regime != Regime::slip)
                continue;
            const CoulombSlip& joint = model.joints.laws[contacts.law[i]];
            const double length = 0.5 * report_contact(state, i).bearing_length;
            const double normal = contacts.normal_force(k, i);
            const double shear = contacts.shear_force(k, i);
            energy += 0.5 * normal * normal / (joint.normal_stiffness * length) +
                      0.5 * shear * shear / (joint.shear_stiffness * length);
        }
    return energy;
}

/// Kinetic, potential and elastic [J]; the potential energy is counted from the local origin.
inline double mechanical_energy(const Model& model, const State& state)
{
    double energy = elastic_energy(model, state);
    for (Index i = 0; i < model.blocks(); ++i)
    {
        if (!state.blocks.is_free(i))
            continue;
        const BlockMotion& m = state.blocks.motion[i];
        energy += kinetic_energy(model, state.blocks, i) - model.mass[i] * model.gravity.dot(Vec2(m.x, m.y));
    }
    return energy;
}

class CaseRun
{
  public:
    explicit CaseRun(const CaseDef& def, const ThreadRule& threads = 1) : CaseRun(build_model(def), threads) {}
    /// For starts that no case file can say.
    CaseRun(const CaseDef& def, const std::function<void(const Model&, State&)>& change)
        : CaseRun(changed(build_model(def), change))
    {
    }
    explicit CaseRun(Setup setup, const ThreadRule& threads = 1)
        : simulation(std::move(setup.model), std::move(setup.state), threads)
    {
        simulation.begin_stage(0);
    }

    Simulation simulation;

    [[nodiscard]] const Model& model() const { return simulation.model(); }
    [[nodiscard]] const State& state() const { return simulation.state(); }
    void advance(std::int64_t cycles = 1) { simulation.advance(cycles); }
    [[nodiscard]] Index slot(const std::string& name) const
    {
        const Index block = model().find_block(name);
        EXPECT_NE(block, no_index) << name;
        return block;
    }
    [[nodiscard]] const BlockMotion& motion(const std::string& name) const { return state().blocks.motion[slot(name)]; }
    [[nodiscard]] Vec2 velocity(const std::string& name) const { return {motion(name).vx, motion(name).vy}; }
    [[nodiscard]] Vec2 position(const std::string& name) const { return {motion(name).x, motion(name).y}; }
    [[nodiscard]] Vec2 displacement(const std::string& name) const { return state().blocks.displacement(slot(name)); }
    [[nodiscard]] Momentum momentum() const { return test::momentum(model(), state().blocks); }
    [[nodiscard]] double energy() const { return mechanical_energy(model(), state()); }
    [[nodiscard]] std::uint64_t hash() const { return state_hash(model(), state()); }

    /// Sum over the closed contacts between two blocks: {normal force, shear force}.
    [[nodiscard]] Vec2 forces_between(const std::string& first, const std::string& second) const
    {
        const std::set<Index> pair{slot(first), slot(second)};
        Vec2 sum(0.0, 0.0);
        for (Index i = 0; i < state().contacts.size(); ++i)
        {
            const ContactReport report = report_contact(state(), i);
            if (std::set<Index>{report.first, report.second} == pair)
                sum += Vec2(report.normal_force, report.shear_force);
        }
        return sum;
    }

  private:
    static Setup changed(Setup setup, const std::function<void(const Model&, State&)>& change)
    {
        change(setup.model, setup.state);
        return setup;
    }
};

/// What every contact must keep to, whatever its law.
class ContactInvariants : public testing::Test
{
  protected:
    /// Momentum of free blocks without gravity after `cycles` is what it was.
    /// `share` of the largest summand: 1e-13 is the round-off of some hundred additions.
    static void expect_momentum_kept(CaseRun& run, std::int64_t cycles, double share = 1e-13)
    {
        const Momentum before = run.momentum();
        run.advance(cycles);
        const Momentum after = run.momentum();
        double size = 0.0;
        for (Index i = 0; i < run.model().blocks(); ++i)
        {
            const BlockMotion& m = run.state().blocks.motion[i];
            size += run.model().mass[i] * std::hypot(m.vx, m.vy) + run.model().inertia[i] * std::abs(m.w);
        }
        EXPECT_LE((after.linear - before.linear).norm(), share * size) << "linear momentum, share " << share;
        EXPECT_LE(std::abs(after.angular - before.angular), 10.0 * share * size)
            << "angular momentum, arms below 10 m, share " << share;
    }

    /// One more cycle, in which the contact forces on all blocks, fixed ones too, sum to nothing: force and moment about the origin.
    static void expect_action_is_reaction(CaseRun& run)
    {
        const std::vector<BlockMotion> at = run.state().blocks.motion;
        run.advance(1);
        const Model& model = run.model();
        Vec2 force(0.0, 0.0);
        double moment = 0.0, size = 0.0;
        for (Index i = 0; i < model.blocks(); ++i)
        {
            const BlockForce& f = run.state().blocks.force[i];
            const Vec2 contact = Vec2(f.x, f.y) - model.mass[i] * model.gravity;
            force += contact;
            moment += f.moment + cross({at[i].x, at[i].y}, contact);
            size += model.mass[i] * model.gravity.norm() + contact.norm();
        }
        // Round-off of the sums: at most a thousand terms, arms below 100 m.
        EXPECT_LE(force.norm(), 1e-12 * size);
        EXPECT_LE(std::abs(moment), 1e-10 * size);
    }

    /// Every joule is accounted for.
    static void expect_ledger_closed(const CaseRun& run)
    {
        const double share = relative_residual(run.state().ledger, stored_energy(run.model(), run.state()));
        EXPECT_LE(std::abs(share), 1e-5) << "of the energy that went through: arms turn by w dt within a step";
    }

    /// Kinetic, potential and elastic energy together never exceed their start by more than `tolerance` over so many cycles.
    static void expect_no_energy_without_work(CaseRun& run, std::int64_t cycles, double tolerance)
    {
        const double start = run.energy();
        double most = start;
        for (std::int64_t i = 0; i < cycles; ++i)
        {
            run.advance(1);
            most = std::max(most, run.energy());
        }
        EXPECT_LE(most - start, tolerance) << "J, within " << cycles << " cycles; tolerance " << tolerance << " J";
    }
};
}  // namespace hdem::test
