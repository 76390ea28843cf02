#include "perf/plain_loop.h"

#include "perf/bare_wall.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hdem::perf
{
namespace
{
/// Velocity and pose of a block, a cache line.
struct alignas(64) Block
{
    double vx = 0.0, vy = 0.0, turn = 0.0, unused = 0.0;  ///< [m/s, rad/s]
    double x = 0.0, y = 0.0, cosine = 1.0, sine = 0.0;
};
}  // namespace

struct PlainLoop::World
{
    explicit World(const BareWall& wall);

    double gravity, step;       ///< [m/s2, s]
    std::vector<Block> blocks;  ///< the last one is fixed
    std::vector<double> weight, inverse_mass, inverse_inertia;

    // Of points.
    std::vector<Index> a, b;                             ///< the block of the point, the block of the edge
    std::vector<double> at_x, at_y;                      ///< the point on a, from its centroid [m]
    std::vector<double> edge_x, edge_y;                  ///< a place on the edge, from the centroid of b [m]
    std::vector<double> normal_x, normal_y;              ///< of the edge, towards a
    std::vector<double> drawn_overlap;                   ///< where blocks are drawn [m]
    std::vector<double> normal_force, shear_force;       ///< [N]
    std::vector<double> arm_ax, arm_ay, arm_bx, arm_by;  ///< to the point, as blocks lie [m]
    std::vector<double> force_x, force_y;                ///< on a [N]

    std::vector<Index> begin, entries;  ///< of a block: twice a point, and one more where the block is b

    void add(const BareWall::Contact& contact, int point);
    void list_entries();
    void evaluate(IndexRange points);
    void move(IndexRange range);
    void run(const Team& team, std::int64_t cycles);
};

PlainLoop::World::World(const BareWall& wall) : gravity(wall.gravity), step(wall.step)
{
    for (const auto& [x, y] : wall.centroids)
        blocks.push_back({.x = x, .y = y});
    weight.assign(blocks.size(), BareWall::mass * gravity);
    inverse_mass.assign(blocks.size(), 1.0 / BareWall::mass);
    inverse_inertia.assign(blocks.size(), 1.0 / BareWall::inertia);
    for (const BareWall::Contact& contact : wall.contacts)
        for (int point = 0; point < 2; ++point)
            add(contact, point);
    for (auto* column : {&normal_force, &shear_force, &arm_ax, &arm_ay, &arm_bx, &arm_by, &force_x, &force_y})
        column->resize(a.size());
    list_entries();
}

void PlainLoop::World::add(const BareWall::Contact& contact, int point)
{
    a.push_back(contact.a);
    b.push_back(contact.b);
    at_x.push_back(contact.x[point]);
    at_y.push_back(contact.y[point]);
    edge_x.push_back(contact.along[0] + contact.x[point] - contact.x[0]);
    edge_y.push_back(contact.along[1] + contact.y[point] - contact.y[0]);
    normal_x.push_back(contact.normal[0]);
    normal_y.push_back(contact.normal[1]);
    const double drawn = edge_x.back() * contact.normal[0] + edge_y.back() * contact.normal[1];
    drawn_overlap.push_back(contact.offset - drawn);
}

void PlainLoop::World::list_entries()
{
    std::vector<std::vector<Index>> of_block(blocks.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        of_block[a[i]].push_back(static_cast<Index>(2 * i));
        of_block[b[i]].push_back(static_cast<Index>(2 * i + 1));
    }
    begin.push_back(0);
    for (const std::vector<Index>& own : of_block)
    {
        entries.insert(entries.end(), own.begin(), own.end());
        begin.push_back(static_cast<Index>(entries.size()));
    }
}

void PlainLoop::World::evaluate(IndexRange points)
{
    const double normal_stiffness = BareWall::normal_stiffness, shear_in_step = BareWall::shear_stiffness * step;
    for (Index i = points.begin; i < points.end; ++i)
    {
        const Block &p = blocks[a[i]], &q = blocks[b[i]];
        const double ax = p.cosine * at_x[i] - p.sine * at_y[i], ay = p.sine * at_x[i] + p.cosine * at_y[i];
        const double ex = q.cosine * edge_x[i] - q.sine * edge_y[i], ey = q.sine * edge_x[i] + q.cosine * edge_y[i];
        const double nx = q.cosine * normal_x[i] - q.sine * normal_y[i], ny = q.sine * normal_x[i] + q.cosine * normal_y[i];
        const double bx = p.x + ax - q.x, by = p.y + ay - q.y;
        const double overlap = drawn_overlap[i] - (bx - ex) * nx - (by - ey) * ny;
        const double vx = p.vx - p.turn * ay - (q.vx - q.turn * by), vy = p.vy + p.turn * ax - (q.vy + q.turn * bx);
        const double normal = std::max(normal_stiffness * overlap, 0.0);
        const double limit = BareWall::friction * normal;
        const double shear = std::min(std::max(shear_force[i] - shear_in_step * (vy * nx - vx * ny), -limit), limit);
        normal_force[i] = normal;
        shear_force[i] = shear;
        arm_ax[i] = ax;
        arm_ay[i] = ay;
        arm_bx[i] = bx;
        arm_by[i] = by;
        force_x[i] = normal * nx - shear * ny;
        force_y[i] = normal * ny + shear * nx;
    }
}

void PlainLoop::World::move(IndexRange range)
{
    const auto damped = [](double force, double velocity)
    { return force - BareWall::damping * std::copysign(std::abs(force), velocity); };
    for (Index i = range.begin; i < range.end; ++i)
    {
        double fx = 0.0, fy = -weight[i], moment = 0.0;
        for (Index e = begin[i]; e < begin[i + 1]; ++e)
        {
            const Index point = entries[e] >> 1;
            const bool is_b = (entries[e] & 1) != 0;
            const double sign = is_b ? -1.0 : 1.0;
            const double x = sign * force_x[point], y = sign * force_y[point];
            fx += x;
            fy += y;
            moment += (is_b ? arm_bx : arm_ax)[point] * y - (is_b ? arm_by : arm_ay)[point] * x;
        }
        Block& block = blocks[i];
        block.vx += step * damped(fx, block.vx) * inverse_mass[i];
        block.vy += step * damped(fy, block.vy) * inverse_mass[i];
        block.turn += step * damped(moment, block.turn) * inverse_inertia[i];
        block.x += step * block.vx;
        block.y += step * block.vy;
        const double angle = step * block.turn;
        const double c = block.cosine - angle * block.sine, s = block.sine + angle * block.cosine;
        const double stretch = 1.5 - 0.5 * (c * c + s * s);  // back to length 1, to the second order
        block.cosine = c * stretch;
        block.sine = s * stretch;
    }
}

void PlainLoop::World::run(const Team& team, std::int64_t cycles)
{
    const IndexRange mine = team.share(static_cast<Index>(a.size()));
    const IndexRange my_blocks = team.share(static_cast<Index>(blocks.size()) - 1);
    for (std::int64_t cycle = 0; cycle < cycles; ++cycle)
    {
        evaluate(mine);
        team.barrier();
        move(my_blocks);
        team.barrier();
    }
}

PlainLoop::PlainLoop(Index side) : world_(std::make_unique<World>(BareWall(side)))
{
}
PlainLoop::~PlainLoop() = default;
PlainLoop::PlainLoop(PlainLoop&&) noexcept = default;

void PlainLoop::advance(std::int64_t cycles, int threads)
{
    with_team(threads, [&](const Team& team) { world_->run(team, cycles); });
}

Index PlainLoop::blocks() const
{
    return static_cast<Index>(world_->blocks.size()) - 1;
}

std::int64_t PlainLoop::contact_points() const
{
    return static_cast<std::int64_t>(world_->a.size());
}

std::int64_t PlainLoop::closed_points() const
{
    return std::ranges::count_if(world_->normal_force, [](double force) { return force > 0.0; });
}

double PlainLoop::supported_share() const
{
    double force = 0.0;
    for (Index e = world_->begin[blocks()]; e < world_->begin[blocks() + 1]; ++e)
        force += world_->force_y[world_->entries[e] >> 1];
    return force / (blocks() * BareWall::mass * world_->gravity);
}

std::uint64_t PlainLoop::hash() const
{
    std::vector<double> values;
    for (const Block& block : world_->blocks)
        values.insert(values.end(), {block.vx, block.vy, block.turn, block.x, block.y, block.cosine, block.sine});
    values.insert(values.end(), world_->shear_force.begin(), world_->shear_force.end());
    return XXH3_64bits(values.data(), values.size() * sizeof(double));
}
}  // namespace hdem::perf
