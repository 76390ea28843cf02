#pragma once
/// A state in which each table of a checkpoint has rows.

#include "core/rock/build_model.h"
#include "parallel/simulation.h"
#include "verification/scenes/sample_joints.h"
#include "verification/scenes/scenes.h"

#include <gtest/gtest.h>

#include <utility>

namespace hdem::test
{
/// A tunnel in rock under stress and water, with bolts, a lining, joints that remember, and forces of what is excavated still to be taken off.
inline CaseDef with_everything()
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.0, 3.0);
    scene.contact.method = Method::hybrid;
    scene.joints = {scenes::sample_joints()[0]};
    scene.insitu = {.given = true, .surface = 12.0, .ratio = 1.5};
    scene.water = {.given = true, .table = {{0.0, 14.0}, {12.0, 6.0}}};
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {6.0, 6.0}, .diameter = 4.0}};
    BoltDef& bolt = scene.bolts.emplace_back();
    bolt.name = "bolt";
    bolt.kind = BoltKind::grouted;
    bolt.around = "tunnel";
    bolt.length = 3.0;
    bolt.along = 1.5;
    bolt.spacing = 1.5;
    bolt.stage = "dig";
    bolt.area = 2e-4;
    bolt.bond_stiffness = 1e7;
    bolt.bond_strength = 2e3;
    LinerDef& liner = scene.liners.emplace_back();
    liner.name = "shotcrete";
    liner.around = "tunnel";
    liner.stage = "dig";
    liner.thickness = 0.1;
    liner.modulus = 1e10;
    liner.normal_stiffness = 1e9;
    StageDef dig{.name = "dig", .until_converged = true, .max_cycles = 900, .relax_cycles = 600};
    dig.excavate = {"tunnel"};
    dig.ends = {{.text = "cycles > 800", .quantity = EndQuantity::cycles, .limit = 800.0}};
    scene.stages = {{.name = "gravity", .cycles = 50}, dig};
    return scene;
}

/// In its second stage.
inline std::pair<Model, State> run_with_everything()
{
    hdem::Setup setup = build_model(with_everything());
    Simulation simulation(std::move(setup.model), std::move(setup.state));
    simulation.begin_stage(0);
    simulation.advance(50);
    simulation.note_outcome({.cycles = 50}, {2});
    simulation.begin_stage(1);
    simulation.advance(300);
    State state = simulation.state();
    state.came_loose = {{.stage = 1, .block = 3}};  // as static solutions leave them, which there are none of with such joints
    state.moving = {{.block = 2}, {.block = 5, .how = FreeMotion::flies, .t_x = 0.6F, .t_y = 0.8F}};  // nothing falls here
    state.creeping = {{.block = 1, .looks = 3, .x = 0.5}, {.block = 4, .by_turn = -1e-6}};
    state.statics = {{.stage = 1, .end = StaticEnd::balanced, .iterations = 7, .residual = 1e-9}};
    return {simulation.model(), std::move(state)};
}

/// One such state for all tests of a suite.
class FullState : public testing::Test
{
  protected:
    static void SetUpTestSuite()
    {
        auto [model, state] = run_with_everything();
        model_ = new Model(std::move(model));
        state_ = new State(std::move(state));
    }
    static void TearDownTestSuite()
    {
        delete model_;
        delete state_;
    }

    static inline Model* model_ = nullptr;
    static inline State* state_ = nullptr;
};
}  // namespace hdem::test
