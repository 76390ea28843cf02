#pragma once
/// Scenes for impulses alone: nothing else changes a velocity.

#include "verification/scenes/scenes.h"

namespace hdem::test
{
inline CaseDef without_gravity(CaseDef scene, double restitution)
{
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::impulse;
    scene.contact.restitution = restitution;
    scene.contact.impulse_sweeps = 50;
    scene.contact.correction_rate = 1e12;
    scene.damping.preset = DampingPreset::dynamic;
    return scene;
}

inline CaseDef two_blocks(double restitution)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "left", scenes::rectangle({-1, 0}, {0, 1})).velocity = {2.0, 0.0};
    scenes::add_block(scene, "right", scenes::rectangle({0, 0}, {1, 1})).velocity = {-1.0, 0.0};
    return without_gravity(scene, restitution);
}
}  // namespace hdem::test
