/// A joint is the same joint however the blocks beside it are cut: one law on 1, 2 and 16 contacts.

#include "verification/unit/case_run.h"
#include "verification/unit/sample_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hdem
{
namespace
{
using test::CaseRun;

constexpr double width = 2.0, pressure = 1e6;  // [m], [Pa]

enum class Cut
{
    base,
    top
};

/// A move of the box at constant speed, and a rest.
struct Move
{
    double way = 0.0;  ///< [m]
    std::int64_t cycles = 0, rest = 0;
};

std::string top_name(int i)
{
    return "top" + std::to_string(i);
}

/// A box of 2 m under 1 MPa on a base that is longer than it, one of them in pieces.
CaseDef shear_box(const JointDef& joint, Cut cut, int pieces, double step, const std::vector<Move>& moves)
{
    CaseDef scene = scenes::empty_scene();
    const int below = cut == Cut::base ? pieces : 1, above = cut == Cut::top ? pieces : 1;
    for (int i = 0; i < below; ++i)
    {
        const double from = i == 0 ? -1.0 : width * i / below, to = i == below - 1 ? width + 1.0 : width * (i + 1) / below;
        scenes::add_fixed_block(scene, "base" + std::to_string(i), scenes::rectangle({from, -1.0}, {to, 0.0}));
    }
    std::vector<std::string> tops;
    for (int i = 0; i < above; ++i)
    {
        tops.push_back(top_name(i));
        scenes::add_block(scene, tops.back(), scenes::rectangle({width * i / above, 0.0}, {width * (i + 1) / above, 0.5}));
        scene.blocks.back().fix_x = scene.blocks.back().fix_rotation = true;
    }
    scene.loads.push_back({.blocks = tops, .force = {0.0, -pressure * width / above}});
    std::int64_t from = 0;
    for (const Move& move : moves)
    {
        const std::int64_t until = from + move.cycles;
        if (move.cycles > 0)
            scene.loads.push_back({.blocks = tops,
                                   .velocity_x = move.way / (step * static_cast<double>(move.cycles)),
                                   .interval = {.from_cycle = from, .until_cycle = until}});
        from = until + move.rest;
    }
    scene.joints = {joint};
    scene.gravity = {0.0, 0.0};
    scene.time.step = step;
    scene.contact.method = Method::force;
    scene.stages = {{.name = "shear", .cycles = 1}};
    return scene;
}

/// Mean stresses of the joint [Pa] and how far the box has risen [m].
struct Look
{
    double normal = 0.0, shear = 0.0, height = 0.0;
    int contacts = 0;
};

Look look(const CaseRun& run, int tops)
{
    Look look;
    for (Index c = 0; c < run.state().contacts.size(); ++c)
    {
        const ContactReport report = report_contact(run.state(), c);
        if (std::abs(report.normal.y()) < 0.5 || !is_closed_contact(run.state(), c))
            continue;  // between pieces
        ++look.contacts;
        look.normal += report.normal_force / width;
        look.shear += report.shear_force / width;
    }
    for (int k = 0; k < tops; ++k)
        look.height += run.displacement(top_name(k)).y() / tops;
    return look;
}

double residual(const CaseRun& run)
{
    return std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state())));
}

class JointPieces : public testing::TestWithParam<int>
{
  protected:
    [[nodiscard]] JointDef joint() const { return test::sample_joints()[static_cast<std::size_t>(GetParam())]; }
};

/// To 2, 5, 0 and -5 mm; the last micrometres slowly, so that what trembles has died down.
std::vector<Look> slow_looks(const JointDef& joint, Cut cut, int pieces)
{
    const double slow = 20e-6, slower = 0.1e-6;
    std::vector<Move> moves{{0.0, 0, 2000}};
    double last = 0.0;
    for (const double to : {2e-3, 5e-3, 0.0, -5e-3})
    {
        const double sign = to > last ? 1.0 : -1.0, way = std::abs(to - last) - slow - slower;
        moves.push_back({sign * way, static_cast<std::int64_t>(way / 5e-7), 1000});
        moves.push_back({sign * slow, 5000, 1000});
        moves.push_back({sign * slower, 2000, 0});
        last = to;
    }
    CaseRun run(shear_box(joint, cut, pieces, 1e-4, moves));
    std::vector<Look> looks;
    for (std::size_t k = 0; k < moves.size(); ++k)
    {
        run.advance(moves[k].cycles + moves[k].rest);
        if (k > 0 && k % 3 == 0)
            looks.push_back(look(run, cut == Cut::top ? pieces : 1));
    }
    EXPECT_LT(residual(run), 1e-6);
    return looks;
}

/// What still differs is where blocks tremble by the way: laws that remember their path remember that too.
TEST_P(JointPieces, GiveTheSameAnswer)
{
    const std::vector<Look> whole = slow_looks(joint(), Cut::base, 1);
    EXPECT_GT(std::abs(whole.back().shear), 0.4 * pressure);
    for (const Cut cut : {Cut::base, Cut::top})
        for (const int pieces : {2, 16})
        {
            const std::vector<Look> parts = slow_looks(joint(), cut, pieces);
            for (std::size_t i = 0; i < whole.size(); ++i)
            {
                EXPECT_EQ(parts[i].contacts, pieces);
                EXPECT_NEAR(parts[i].normal, whole[i].normal, 1e-3 * pressure) << pieces << ", look " << i;
                EXPECT_NEAR(parts[i].shear, whole[i].shear, 1e-3 * pressure) << pieces << ", look " << i;
                EXPECT_NEAR(parts[i].height, whole[i].height, 1e-6) << pieces << ", look " << i;
            }
        }
}

/// Ten times 5 mm to the right, to the left and back, fast.
TEST_P(JointPieces, KeepTheLedgerOverTenReversals)
{
    std::vector<Move> moves{{5e-3, 2500, 0}};
    for (int i = 0; i < 20; ++i)
        moves.push_back({i % 2 == 0 ? -1e-2 : 1e-2, 5000, 0});
    for (const Cut cut : {Cut::base, Cut::top})
        for (const int pieces : {1, 2, 16})
        {
            CaseRun run(shear_box(joint(), cut, pieces, 2e-5, moves));
            for (const Move& move : moves)
            {
                run.advance(move.cycles);
                EXPECT_LT(residual(run), 1e-6) << pieces;
            }
            EXPECT_GT(run.state().ledger.friction, 1e3) << pieces;
        }
}

INSTANTIATE_TEST_SUITE_P(Laws, JointPieces, testing::Range(0, 6));
}  // namespace
}  // namespace hdem
