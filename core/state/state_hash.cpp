#include "core/state/state_hash.h"

#include "core/joint/user_law.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <initializer_list>

namespace hdem
{
namespace
{
/// Number of each part when blocks are counted in the user's order.
std::vector<Index> user_part_numbers(const Model& model)
{
    const Shapes& shapes = model.shapes;
    std::vector<Index> number(shapes.part_block.size());
    Index count = 0;
    for (const Index block : model.slot_of_user)
        for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
            number[part] = count++;
    return number;
}

struct HashedContact
{
    std::int64_t low, high, sense;  ///< parts by user number; sense: the reference edge is on `low`
    std::array<double, 6> history;  ///< forces, rest overlaps
    std::array<std::int64_t, 2> regime;
};

struct HashedPreload
{
    std::int64_t low, high;
    std::array<double, 2> preload;
};

struct HashedMemory
{
    std::int64_t low, high;
    std::array<double, 10> memory;
};

std::array<double, 10> memory_of(const Contacts& contacts, Index i)
{
    const JointMemory a = contacts.memory(0, i), b = contacts.memory(1, i);
    return {a.slip + 0.0, a.state + 0.0, a.turn + 0.0, a.opening + 0.0, a.broken + 0.0,
            b.slip + 0.0, b.state + 0.0, b.turn + 0.0, b.opening + 0.0, b.broken + 0.0};
}

template <typename Rows>
void add_sorted(Rows& rows, XXH3_state_t* hash)
{
    std::sort(rows.begin(), rows.end(),
              [](const auto& p, const auto& q) { return p.low != q.low ? p.low < q.low : p.high < q.high; });
    XXH3_64bits_update(hash, rows.data(), rows.size() * sizeof(rows.front()));
}
}  // namespace

std::uint64_t state_hash(const Model& model, const State& state)
{
    XXH3_state_t* const hash = XXH3_createState();
    XXH3_64bits_reset(hash);
    for (const Index i : model.slot_of_user)
    {
        const BlockMotion& m = state.blocks.motion[i];
        const std::array<double, 8> values{m.x + 0.0,  m.y + 0.0,  m.c + 0.0, m.s + 0.0,
                                           m.vx + 0.0, m.vy + 0.0, m.w + 0.0, m.angle + 0.0};
        XXH3_64bits_update(hash, values.data(), sizeof values);
    }
    for (const Index i : state.water.empty() ? std::vector<Index>{} : model.slot_of_user)
    {
        const std::array<double, 3> values{state.water[i].x + 0.0, state.water[i].y + 0.0, state.water[i].w + 0.0};
        XXH3_64bits_update(hash, values.data(), sizeof values);
    }
    for (const BoltRecord& b : state.support.bolts)
    {
        const std::array<double, 4> values{static_cast<double>(b.status), b.force + 0.0, b.shear_force + 0.0,
                                           b.greatest_force + 0.0};
        XXH3_64bits_update(hash, values.data(), sizeof values);
    }
    for (const LinerRecord& l : state.support.liners)
    {
        const std::array<double, 3> values{static_cast<double>(l.installed), static_cast<double>(l.since), l.spent + 0.0};
        XXH3_64bits_update(hash, values.data(), sizeof values);
    }
    for (const double value : state.support.history)
    {
        const double positive_zero = value + 0.0;
        XXH3_64bits_update(hash, &positive_zero, sizeof positive_zero);
    }
    const std::vector<Index> number = user_part_numbers(model);
    const Contacts& contacts = state.contacts;
    std::vector<HashedContact> hashed;
    std::vector<HashedPreload> preloads;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        if (contacts.regime[0][i] == 0 && contacts.regime[1][i] == 0)
            continue;
        const Index a = number[contacts.part_a[i]];
        const Index b = number[contacts.part_b[i]];
        const bool ref_is_a = model.shapes.part_block[contacts.part_a[i]] == contacts.ref[i];
        hashed.push_back({std::min(a, b),
                          std::max(a, b),
                          (ref_is_a ? a : b) == std::min(a, b),
                          {contacts.normal_force(0, i) + 0.0, contacts.normal_force(1, i) + 0.0, contacts.shear_force(0, i) + 0.0,
                           contacts.shear_force(1, i) + 0.0, contacts.rest_overlap(0, i) + 0.0, contacts.rest_overlap(1, i) + 0.0},
                          {contacts.regime[0][i], contacts.regime[1][i]}});
    }
    add_sorted(hashed, hash);
    for (Index i = 0; i < (contacts.has_preload ? contacts.size() : 0); ++i)
        preloads.push_back({std::min(number[contacts.part_a[i]], number[contacts.part_b[i]]),
                            std::max(number[contacts.part_a[i]], number[contacts.part_b[i]]),
                            {contacts.preload(0, i) + 0.0, contacts.preload(1, i) + 0.0}});
    add_sorted(preloads, hash);
    std::vector<HashedMemory> memories;
    for (Index i = 0; i < (contacts.has_memory ? contacts.size() : 0); ++i)
        memories.push_back({std::min(number[contacts.part_a[i]], number[contacts.part_b[i]]),
                            std::max(number[contacts.part_a[i]], number[contacts.part_b[i]]), memory_of(contacts, i)});
    add_sorted(memories, hash);
    const std::uint64_t digest = XXH3_64bits_digest(hash);
    XXH3_freeState(hash);
    return digest;
}

std::uint64_t model_hash(const Model& model)
{
    if (model.drawn_hash)
        return *model.drawn_hash;
    XXH3_state_t* const hash = XXH3_createState();
    XXH3_64bits_reset(hash);
    const auto add = [&](std::initializer_list<double> values)
    {
        for (const double value : values)
        {
            const double positive_zero = value + 0.0;
            XXH3_64bits_update(hash, &positive_zero, sizeof positive_zero);
        }
    };
    const Shapes& shapes = model.shapes;
    for (const Index i : model.slot_of_user)
    {
        add({model.mass[i], model.inertia[i], static_cast<double>(shapes.part_begin[i + 1] - shapes.part_begin[i])});
        for (Index v = shapes.vertex_begin[shapes.part_begin[i]]; v < shapes.vertex_begin[shapes.part_begin[i + 1]]; ++v)
            add({shapes.vertex[v].x(), shapes.vertex[v].y(), static_cast<double>(shapes.edge_source[v])});
    }
    for (const CoulombSlip& law : model.joints.laws)
        add({law.normal_stiffness, law.shear_stiffness, law.friction_coefficient, law.cohesion, law.restitution});
    for (const JointRow& row : model.joints.rows)
    {
        add({static_cast<double>(row.kind), static_cast<double>(row.curve), row.reach, row.torn_reach, row.tension,
             row.residual_friction, row.residual_cohesion});
        for (int i = 0; i < UserLaw::number; ++i)  // that one counts the joints of all models of the process
            add({row.numbers[i]});
    }
    // A step that the case does not give may have been lowered for its contacts since the model was made.
    add({model.has_step ? model.time_step : model.paper_time_step, model.threshold_scale, model.gravity.x(), model.gravity.y()});
    for (const Boundary& boundary : model.boundaries)
    {
        add({static_cast<double>(boundary.kind), boundary.velocity.x(), boundary.velocity.y(), boundary.target,
             boundary.max_velocity});
        for (const auto& row : boundary.factor.rows)
            add({row[0], row[1], boundary.factor.is_by_time ? 1.0 : 0.0, static_cast<double>(boundary.factor.since)});
        for (const std::uint8_t acts : boundary.in_stage)
            add({static_cast<double>(acts)});
        for (const BoundaryForce& force : boundary.forces)
            add({static_cast<double>(model.user_number[force.block]), force.x, force.y, force.moment});
    }
    if (model.holds_mean)
        add({1.0});
    for (const Bolt& bolt : model.support.bolts)
    {
        add({static_cast<double>(bolt.kind), static_cast<double>(bolt.stage), bolt.spacing, bolt.stiffness, bolt.shear_stiffness,
             bolt.pretension, bolt.yield, bolt.shear_strength, bolt.rupture, bolt.length, bolt.section_stiffness,
             bolt.bond_stiffness, bolt.bond_strength, bolt.plate ? 1.0 : 0.0});
        for (const BoltLink& link : bolt.links)
            add({static_cast<double>(model.user_number[link.first]), static_cast<double>(model.user_number[link.second]),
                 link.first_arm.x(), link.first_arm.y(), link.second_arm.x(), link.second_arm.y()});
        for (const BoltSegment& segment : bolt.segments)
            add({static_cast<double>(segment.part), segment.length, segment.is_bonded ? 1.0 : 0.0});
    }
    for (const Liner& liner : model.support.liners)
    {
        add({static_cast<double>(liner.stage), liner.mass, liner.axial_stiffness, liner.bending_stiffness,
             liner.compressive_strength, liner.tensile_strength, liner.moment_strength, liner.normal_stiffness,
             liner.shear_stiffness, liner.friction, liner.cohesion, liner.bond_strength, liner.pressure,
             static_cast<double>(liner.pressure_cycles)});
        for (const auto& row : liner.hardening)
            add({row[0], row[1]});
        for (const LinerSegment& s : liner.segments)
            add({s.block == no_index ? -1.0 : static_cast<double>(model.user_number[s.block]), static_cast<double>(s.node[0]),
                 static_cast<double>(s.node[1]), s.arm[0].x(), s.arm[0].y(), s.length, s.along.x(), s.along.y()});
    }
    const std::uint64_t digest = XXH3_64bits_digest(hash);
    XXH3_freeState(hash);
    return digest;
}
}  // namespace hdem
