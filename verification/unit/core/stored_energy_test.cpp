/// Energy in springs, by its parts, against forces that are known otherwise.

#include "verification/unit/case_run.h"

#include <cmath>

namespace hdem::test
{
namespace
{
using PointEnergy = double (*)(const CoulombSlip& joint, double length, const Contacts& contacts, int k, Index i);

double sum_of_points(const CaseRun& run, PointEnergy energy)
{
    const Contacts& contacts = run.state().contacts;
    double sum = 0.0;
    for (Index i = 0; i < contacts.size(); ++i)
        for (int k = 0; k < 2; ++k)
            if (is_spring(contacts.regime[k][i]))
                sum += energy(run.model().joints.laws[contacts.law[i]], contacts.get(i).last_length, contacts, k, i);
    return sum;
}

double shear_energy(const CoulombSlip& joint, double length, const Contacts& contacts, int k, Index i)
{
    return 0.5 * std::pow(contacts.shear_force(k, i), 2) / (joint.shear_stiffness * length);
}

double normal_energy(const CoulombSlip& joint, double length, const Contacts& contacts, int k, Index i)
{
    return 0.5 * std::pow(contacts.normal_force(k, i), 2) / (joint.normal_stiffness * length);
}

TEST(StoredEnergy, OfRockAtRestIsThatOfItsForces)
{
    CaseDef scene = scenes::turned(scenes::wall(4, 3), 12.0);
    scene.gravity = {0.0, -9.81};
    scene.joints[0].friction_angle_deg = 60.0;
    CaseRun run(scene);
    run.advance(20000);
    const StoredEnergy stored = stored_energy(run.model(), run.state());
    const double shear = sum_of_points(run, shear_energy), normal = sum_of_points(run, normal_energy);
    EXPECT_GT(shear, 0.01 * normal);
    EXPECT_NEAR(stored.elastic_shear, shear, 1e-6 * shear);
    EXPECT_NEAR(stored.elastic_normal, normal, 1e-6 * normal);
    EXPECT_LT(std::abs(stored.pending), 1e-9 * normal);
    EXPECT_LT(stored.kinetic, 1e-9 * normal);
}

/// A block swings on the floor: 1/2 F_S(t) u_S(t + dt), and of the normal springs 1/2 F_N u(t + dt) less 1/2 K L u(t)+ u(t + dt)+, with what the springs have become
/// a cycle later.
TEST(StoredEnergy, IsTakenHalfAStepOn)
{
    CaseDef scene = scenes::block_on_ground(1.0, 0.2);
    scene.blocks[1].polygon = scenes::rectangle({-0.5, 1e-6}, {0.5, 0.2 + 1e-6});
    scene.blocks[1].velocity = {1e-3, 0.0};
    scene.joints[0].friction_angle_deg = 85.0;
    scene.contact.method = Method::force;
    scene.damping.preset = DampingPreset::dynamic;
    CaseRun run(scene);
    double greatest_shear = 0.0, greatest_pending = 0.0;
    int sticks = 0;
    for (int i = 0; i < 1000; ++i)
    {
        run.advance();
        const StoredEnergy stored = stored_energy(run.model(), run.state());
        const Contacts then = run.state().contacts;
        run.advance();
        const Contacts& now = run.state().contacts;
        double shear = 0.0, pending = 0.0;
        bool is_closed = true;
        for (Index c = 0; c < then.size(); ++c)
            for (int k = 0; k < 2; ++k)
            {
                const Contact contact = then.get(c);
                const CoulombSlip& joint = run.model().joints.laws[contact.law];
                const double length = contact.last_length, next = now.get(c).point[k].overlap;
                const PointHistory& point = contact.point[k];
                is_closed = is_closed && is_spring(then.regime[k][c]) && is_spring(now.regime[k][c]);
                if (!is_spring(then.regime[k][c]))
                    continue;
                shear += 0.5 * point.shear_force * now.shear_force(k, c) / (joint.shear_stiffness * length);
                pending += 0.5 * point.normal_force * next -
                           0.5 * joint.normal_stiffness * length * std::max(point.overlap, 0.0) * std::max(next, 0.0);
            }
        if (is_closed)
        {
            ++sticks;
            EXPECT_NEAR(stored.elastic_shear, shear, 1e-4 * std::max(greatest_shear, shear));
        }
        greatest_shear = std::max(greatest_shear, stored.elastic_shear);
        greatest_pending = std::max(greatest_pending, std::abs(stored.pending));
        EXPECT_NEAR(stored.pending, pending, 1e-4 * std::max(greatest_pending, std::abs(pending)));
    }
    EXPECT_GT(sticks, 300);
    EXPECT_GT(greatest_pending, 1e-3 * greatest_shear);
}
}  // namespace
}  // namespace hdem::test
