#pragma once
/// What the tests of [[boundary]] share.

#include "core/stage/rules.h"
#include "core/stress/insitu_stress.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

namespace hdem::test
{
/// Square blocks of 1 m without gravity.
inline CaseDef square_pattern(double width, double height)
{
    CaseDef scene = scenes::empty_scene();
    scene.domain = {.given = true, .width = width, .height = height};
    for (const double dip : {0.0, 90.0})
        scene.joint_sets.push_back({.name = "dip" + std::to_string(dip), .dip_deg = dip, .spacing = 1.0, .origin = Vec2(0.0, 0.0)});
    scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = 1e10;
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    return scene;
}

inline BoundaryDef side(const std::string& name, BoundaryKind kind)
{
    BoundaryDef boundary;
    boundary.name = boundary.side = name;
    boundary.kind = kind;
    return boundary;
}

inline BoundaryDef pressed(const std::string& name, double compression, double shear = 0.0)
{
    BoundaryDef boundary = side(name, BoundaryKind::stress);
    boundary.stress = Vec2(compression, shear);
    return boundary;
}

inline BoundaryDef in_situ(BoundaryDef boundary)
{
    boundary.is_insitu = true;
    return boundary;
}

inline void expect_nothing_moves(CaseDef scene, std::int64_t cycles = 1000)
{
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        EXPECT_LT(summarise_insitu(run.model(), run.state()).unbalance, 1e-12);
        run.advance(cycles);
        for (Index b = 0; b < run.model().blocks(); ++b)
        {
            EXPECT_LT(run.state().blocks.displacement(b).norm(), 1e-12) << run.model().name[b] << ", method " << name_of(method);
            EXPECT_LT(std::abs(run.state().blocks.motion[b].angle), 1e-12);
        }
    }
}

inline double ledger_residual(const CaseRun& run)
{
    return std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state())));
}
}  // namespace hdem::test
