#include "perf/force_loop.h"

#include "perf/bare_wall.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hdem::perf
{
namespace
{
constexpr double normal_stiffness = BareWall::normal_stiffness, shear_stiffness = BareWall::shear_stiffness,
                 friction = BareWall::friction, mass = BareWall::mass, inertia = BareWall::inertia, damping = BareWall::damping;

// Four contacts at a time. (Types of this file alone: it is compiled with the processor's fused operations, which hdem does without.)
constexpr int width = 4;
using Lanes = double __attribute__((vector_size(8 * width)));

Lanes all(double value)
{
    return Lanes{} + value;
}
Lanes at_least(Lanes a, Lanes low)
{
    return a > low ? a : low;
}
Lanes at_most(Lanes a, Lanes high)
{
    return a < high ? a : high;
}

/// Rows to columns.
void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d)
{
    const Lanes ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Lanes cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
    c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
    d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

/// Pose and velocity of a block, a cache line.
struct alignas(64) Block
{
    Lanes velocity;  ///< x, y, turn, nothing [m/s, rad/s]
    Lanes pose;      ///< x, y [m], cosine and sine of its turn
};

/// Of four contacts. Points and edge are fixed to their blocks.
struct alignas(64) Contacts
{
    std::array<Index, width> a, b;  ///< the block with the two points, the block with the edge
    Lanes x1, y1, x2, y2;           ///< points, from the centroid of a [m]
    Lanes nx, ny, offset;           ///< normal of the edge, towards a; its distance from the centroid of b [m]
    Lanes shear1, shear2;           ///< forces [N]
};

/// Force on a, moments on a and b: what a contact does in a cycle. The force on b is the opposite.
struct alignas(32) Load
{
    Lanes all;
};

struct Motions
{
    Lanes vx, vy, turn, x, y, cosine, sine;
};

Motions motions_of(const Block* blocks, const std::array<Index, width>& which)
{
    const Block &p = blocks[which[0]], &q = blocks[which[1]], &r = blocks[which[2]], &s = blocks[which[3]];
    Motions m{.vx = p.velocity, .vy = q.velocity, .turn = r.velocity, .x = p.pose, .y = q.pose, .cosine = r.pose, .sine = s.pose};
    Lanes unused = s.velocity;
    transpose(m.vx, m.vy, m.turn, unused);
    transpose(m.x, m.y, m.cosine, m.sine);
    return m;
}

/// What four contacts share between their two points.
struct Meeting
{
    Motions a, b;
    Lanes nx, ny, offset;
    double step;
};

struct PointLoad
{
    Lanes fx, fy, on_a, on_b;
};

/// Edges of four contacts as they lie now.
Meeting meeting_of(const Contacts& c, const Block* blocks, double step)
{
    Meeting m{.a = motions_of(blocks, c.a), .b = motions_of(blocks, c.b), .nx = {}, .ny = {}, .offset = c.offset, .step = step};
    m.nx = m.b.cosine * c.nx - m.b.sine * c.ny;
    m.ny = m.b.sine * c.nx + m.b.cosine * c.ny;
    return m;
}

/// A point, from the centroids of both blocks.
struct Arms
{
    Lanes ax, ay, bx, by;
};

Arms arms_of(const Meeting& m, Lanes x, Lanes y)
{
    const Lanes ax = m.a.cosine * x - m.a.sine * y, ay = m.a.sine * x + m.a.cosine * y;
    return {ax, ay, m.a.x - m.b.x + ax, m.a.y - m.b.y + ay};
}

Lanes overlap_of(const Meeting& m, const Arms& p)
{
    return m.offset - (p.bx * m.nx + p.by * m.ny);
}

/// @param x, y   the point, from the centroid of a
/// @param shear  its shear force, before and after
PointLoad point_load(const Meeting& m, Lanes x, Lanes y, Lanes& shear)
{
    const Arms p = arms_of(m, x, y);
    const Lanes vx = (m.a.vx - m.a.turn * p.ay) - (m.b.vx - m.b.turn * p.by);
    const Lanes vy = (m.a.vy + m.a.turn * p.ax) - (m.b.vy + m.b.turn * p.bx);
    const Lanes normal = at_least(normal_stiffness * overlap_of(m, p), Lanes{});
    const Lanes limit = friction * normal;
    const Lanes trial = shear - (shear_stiffness * m.step) * (vy * m.nx - vx * m.ny);
    shear = at_most(at_least(trial, -limit), limit);
    const Lanes fx = normal * m.nx - shear * m.ny, fy = normal * m.ny + shear * m.nx;
    return {fx, fy, p.ax * fy - p.ay * fx, p.by * fx - p.bx * fy};
}

void evaluate(Contacts& c, const Block* blocks, double step, Load* loads)
{
    const Meeting m = meeting_of(c, blocks, step);
    const PointLoad one = point_load(m, c.x1, c.y1, c.shear1);
    const PointLoad two = point_load(m, c.x2, c.y2, c.shear2);
    Lanes fx = one.fx + two.fx, fy = one.fy + two.fy, on_a = one.on_a + two.on_a, on_b = one.on_b + two.on_b;
    transpose(fx, fy, on_a, on_b);
    loads[0].all = fx;
    loads[1].all = fy;
    loads[2].all = on_a;
    loads[3].all = on_b;
}

/// Of the two points of four contacts [m].
std::array<Lanes, 2> overlaps(const Contacts& c, const Block* blocks)
{
    const Meeting m = meeting_of(c, blocks, 0.0);
    return {overlap_of(m, arms_of(m, c.x1, c.y1)), overlap_of(m, arms_of(m, c.x2, c.y2))};
}

constexpr Lanes signs[2] = {{1.0, 1.0, 1.0, 0.0}, {-1.0, -1.0, 0.0, 1.0}};  ///< of a load on a, on b
}  // namespace

struct ForceLoop::World
{
    explicit World(const BareWall& wall);

    double gravity = 0.0;       ///< [m/s2]
    double step = 0.0;          ///< [s]
    std::vector<Block> blocks;  ///< the last one is fixed
    std::vector<Contacts> groups;
    std::vector<Load> loads;     ///< of contacts, one after the other
    std::vector<Index> begin;    ///< of a block's entries
    std::vector<Index> entries;  ///< twice a contact, and one more where it acts on block b
    std::int64_t contacts = 0;

    [[nodiscard]] Index fixed() const { return static_cast<Index>(blocks.size()) - 1; }
    void add(const BareWall::Contact& from);
    void list_entries();
    void move(Index i);
    void run(const Team& team, std::int64_t cycles);
};

ForceLoop::World::World(const BareWall& wall) : gravity(wall.gravity), step(wall.step)
{
    for (const auto& [x, y] : wall.centroids)
        blocks.push_back({Lanes{}, Lanes{x, y, 1.0, 0.0}});
    for (const BareWall::Contact& contact : wall.contacts)
        add(contact);
    list_entries();
}

void ForceLoop::World::add(const BareWall::Contact& from)
{
    const Index lane = static_cast<Index>(contacts++ % width);
    if (lane == 0)  // the lanes that stay empty: contacts of the fixed block with itself, far from closed
    {
        Contacts empty{};
        empty.a.fill(fixed());
        empty.b.fill(fixed());
        empty.offset = all(-1e3);
        groups.push_back(empty);
    }
    Contacts& c = groups.back();
    c.a[lane] = from.a;
    c.b[lane] = from.b;
    c.x1[lane] = from.x[0];
    c.y1[lane] = from.y[0];
    c.x2[lane] = from.x[1];
    c.y2[lane] = from.y[1];
    c.nx[lane] = from.normal[0];
    c.ny[lane] = from.normal[1];
    c.offset[lane] = from.offset;
}

void ForceLoop::World::list_entries()
{
    loads.resize(width * groups.size());
    std::vector<std::vector<Index>> of_block(blocks.size());
    for (Index i = 0; i < contacts; ++i)
    {
        of_block[groups[i / width].a[i % width]].push_back(2 * i);
        of_block[groups[i / width].b[i % width]].push_back(2 * i + 1);
    }
    begin.push_back(0);
    for (const std::vector<Index>& own : of_block)
    {
        entries.insert(entries.end(), own.begin(), own.end());
        begin.push_back(static_cast<Index>(entries.size()));
    }
}

void ForceLoop::World::move(Index i)
{
    Lanes force{};
    for (Index e = begin[i]; e < begin[i + 1]; ++e)
        force += signs[entries[e] & 1] * loads[entries[e] >> 1].all;
    force[2] += force[3];
    force[1] -= mass * gravity;
    Block& block = blocks[i];
    const Lanes resistance = damping * (force < 0.0 ? -force : force);
    force -= block.velocity < 0.0 ? -resistance : resistance;
    const Lanes inverse = {1.0 / mass, 1.0 / mass, 1.0 / inertia, 0.0};
    block.velocity += step * inverse * force;
    const double angle = step * block.velocity[2];
    const double c = block.pose[2] - angle * block.pose[3], s = block.pose[3] + angle * block.pose[2];
    const double stretch = 1.5 - 0.5 * (c * c + s * s);  // back to length 1, to the second order
    block.pose = Lanes{block.pose[0] + step * block.velocity[0], block.pose[1] + step * block.velocity[1], stretch * c,
                       stretch * s};
}

void ForceLoop::World::run(const Team& team, std::int64_t cycles)
{
    const IndexRange mine = team.share(static_cast<Index>(groups.size()));
    const IndexRange my_blocks = team.share(static_cast<Index>(blocks.size()) - 1);
    for (std::int64_t cycle = 0; cycle < cycles; ++cycle)
    {
        for (Index i = mine.begin; i < mine.end; ++i)
            evaluate(groups[i], blocks.data(), step, &loads[width * i]);
        team.barrier();
        for (Index i = my_blocks.begin; i < my_blocks.end; ++i)
            move(i);
        team.barrier();
    }
}

ForceLoop::ForceLoop(Index side) : world_(std::make_unique<World>(BareWall(side)))
{
}
ForceLoop::~ForceLoop() = default;
ForceLoop::ForceLoop(ForceLoop&&) noexcept = default;

void ForceLoop::advance(std::int64_t cycles, int threads)
{
    with_team(threads, [&](const Team& team) { world_->run(team, cycles); });
}

Index ForceLoop::blocks() const
{
    return world_->fixed();
}

std::int64_t ForceLoop::contact_points() const
{
    return 2 * world_->contacts;
}

std::int64_t ForceLoop::closed_points() const
{
    std::int64_t closed = 0;
    for (const Contacts& c : world_->groups)
        for (const Lanes& overlap : overlaps(c, world_->blocks.data()))
            for (int lane = 0; lane < width; ++lane)
                closed += overlap[lane] > 0.0 ? 1 : 0;
    return closed;
}

double ForceLoop::supported_share() const
{
    double force = 0.0;
    for (Index e = world_->begin[world_->fixed()]; e < world_->begin[world_->fixed() + 1]; ++e)
        force += world_->loads[world_->entries[e] >> 1].all[1];
    return force / (blocks() * mass * world_->gravity);
}

std::uint64_t ForceLoop::hash() const
{
    std::vector<double> values;
    const auto add = [&](const Lanes& lanes) { values.insert(values.end(), {lanes[0], lanes[1], lanes[2], lanes[3]}); };
    for (const Block& block : world_->blocks)
    {
        add(block.velocity);
        add(block.pose);
    }
    for (const Contacts& c : world_->groups)
    {
        add(c.shear1);
        add(c.shear2);
    }
    return XXH3_64bits(values.data(), values.size() * sizeof(double));
}
}  // namespace hdem::perf
