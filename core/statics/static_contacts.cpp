#include "core/statics/static_contacts.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double first_trust = 0.03;
constexpr double least_trust = 1e-6;
constexpr double more_trust = 0.25;
constexpr double less_trust = 16.0;
constexpr std::uint8_t parts_after = 3;  // iterations

/// A contact at the present poses.
struct View
{
    EdgeTouch touch;
    double turned_c = 1.0, turned_s = 0.0;  ///< rotation of inc as seen from the edge
    double d_t = 0.0;                       ///< from the centroid of ref to that of inc, along the edge [m]
    double length = 0.0;                    ///< a point's share [m]
    double floor = 0.0;
    std::array<double, 2> preload{};  ///< of the points [m]
    const CoulombSlip* joint = nullptr;

    /// Overlap of a point with its preload [m].
    [[nodiscard]] double pressed(int k) const { return touch.point[k].overlap + preload[k]; }
    /// Along the edge, of a body point of inc [m].
    [[nodiscard]] double t_of(double q_x, double q_y) const { return d_t + (turned_c * q_x - turned_s * q_y); }
};

View view(const Model& model, const State& state, Index i)
{
    const Contacts& contacts = state.contacts;
    BlockMotion ref = state.blocks.motion[contacts.ref[i]];
    BlockMotion inc = state.blocks.motion[contacts.inc[i]];
    ref.vx = ref.vy = ref.w = inc.vx = inc.vy = inc.w = 0.0;
    const EdgePair edges = contacts.edges(i);
    const EdgeView seen = view_edges(edges, ref, inc);
    View v;
    v.touch = touch_edges(edges, seen, ref, inc);
    v.turned_c = seen.ex * inc.c + seen.ey * inc.s;
    v.turned_s = seen.ex * inc.s - seen.ey * inc.c;
    v.d_t = seen.d_t;
    v.floor = contacts.length_floor(i);
    v.preload = {contacts.preload(0, i), contacts.preload(1, i)};
    v.length = point_length(v.touch.length, v.floor);
    v.joint = &model.joints.laws[contacts.law[i]];
    return v;
}

PointPlace place(const View& v, int k, const StaticPoint& point, double rest)
{
    const double overlap = v.pressed(k);
    const bool closed = is_closed(v.touch.length, overlap, v.floor);
    return {.length = v.length,
            .stretch = overlap - rest_overlap(overlap, rest, 0.0),
            .way = v.t_of(point.q_x, point.q_y) - point.start_t,
            .is_closed = closed,
            .bears = v.touch.length > 0.0 && (closed || !point.is_parted)};
}

/// What has parted has no cohesion until it heals (see heal): its shear force then vanishes steadily as it opens.
CoulombSlip joint_of(const View& v, const StaticPoint& point)
{
    CoulombSlip joint = *v.joint;
    if (point.is_parted)
        joint.cohesion = 0.0;
    return joint;
}

/// Ways of a point are counted from the present poses on, and it bears no shear force now.
void count_ways_anew(const View& v, int k, StaticPoint& point)
{
    const TouchPoint& p = v.touch.point[k];
    point.q_x = v.turned_c * p.inc_t + v.turned_s * p.inc_m;
    point.q_y = v.turned_c * p.inc_m - v.turned_s * p.inc_t;
    point.start_t = v.t_of(point.q_x, point.q_y);
}

/// A point that closes again after it has parted has its cohesion back: it was thrown open on the way of the search, not on that of the blocks. It bears as if it had never
/// parted, if it was closed when the search began. Once a search: a point at rest just where it closes would go on changing.
bool heals(const PointReaction& r, StaticPoint& point)
{
    if (!point.is_parted || r.status == PointStatus::open || point.has_healed)
        return false;
    point.is_parted = false;
    point.has_healed = true;
    if (point.began_closed)
    {
        point.q_x = point.first_q_x;
        point.q_y = point.first_q_y;
        point.start_t = point.first_t;
        point.start_shear = point.first_shear;
    }
    return true;
}

BlockLoad load_on(double e_x, double e_y, double f_t, double f_m, double moment)
{
    return {e_x * f_t - e_y * f_m, e_y * f_t + e_x * f_m, moment, 0.0};
}
}  // namespace

RowPair ContactTangent::stiffness(int side) const
{
    RowPair rows{Matrix36::Zero(), Matrix36::Zero()};
    const bool is_coupled = point[0].coupling != 0.0 || point[1].coupling != 0.0;
    for (int k = 0; k < 2; ++k)
    {
        const PointTangent& p = point[k];
        Eigen::Matrix<double, 6, 1> across, along;  // of overlap and way by the unknowns
        across << e_y, -e_x, -ref_t[k], -e_y, e_x, inc_t[k];
        along << -e_x, -e_y, ref_m[k], e_x, e_y, -inc_m[k];
        const Eigen::Vector3d own_across = across.segment<3>(3 * side), own_along = along.segment<3>(3 * side);
        const Matrix36 elastic = p.normal * own_across * across.transpose() + p.shear * own_along * along.transpose();
        rows.symmetric += elastic;
        if (is_coupled)
            rows.coupled += elastic;
        if (p.coupling != 0.0)
            rows.coupled -= p.coupling * own_along * across.transpose();
    }
    if (!is_coupled)
        rows.coupled = rows.symmetric;
    return rows;
}

std::array<double, 2> ContactTangent::ways(int k, const double* ref, const double* inc) const
{
    const double x = inc[0] - ref[0], y = inc[1] - ref[1];
    return {e_x * y - e_y * x + inc[2] * inc_t[k] - ref[2] * ref_t[k], e_x * x + e_y * y - inc[2] * inc_m[k] + ref[2] * ref_m[k]};
}

double ContactTangent::way(int k, const double* ref, const double* inc) const
{
    const auto [across, along] = ways(k, ref, inc);
    return std::sqrt(across * across + along * along);
}

PointTally& PointTally::operator+=(const PointTally& other)
{
    stick += other.stick;
    slip += other.slip;
    open += other.open;
    newly_parted += other.newly_parted;
    friction += other.friction;
    return *this;
}

void begin_points(IndexRange range, const Model& model, const State& state, std::vector<StaticPoint>& points)
{
    for (Index i = range.begin; i < range.end; ++i)
    {
        const View v = view(model, state, i);
        for (int k = 0; k < 2; ++k)
        {
            StaticPoint& point = points[2 * i + k];
            point = {};
            point.trust = first_trust;
            count_ways_anew(v, k, point);
            const bool closed = is_closed(v.touch.length, v.pressed(k), v.floor);
            point.is_parted = !closed;
            point.start_shear = closed ? state.contacts.shear_force(k, i) : 0.0;
            point.began_closed = closed;
            point.first_q_x = point.q_x;
            point.first_q_y = point.q_y;
            point.first_t = point.start_t;
            point.first_shear = point.start_shear;
        }
    }
}

void put_loads(IndexRange range, const Model& model, const State& state, const std::vector<StaticPoint>& points, bool frozen,
               std::vector<BlockLoad>& loads)
{
    const Contacts& contacts = state.contacts;
    for (Index i = range.begin; i < range.end; ++i)
    {
        const View v = view(model, state, i);
        std::array<PointReaction, 2> r;
        double work = 0.0;
        for (int k = 0; k < 2; ++k)
        {
            const StaticPoint& point = points[2 * i + k];
            const PointPlace at = place(v, k, point, contacts.rest_overlap(k, i));
            r[k] = react(joint_of(v, point), at, point.start_shear, frozen ? point.strength : -1.0);
            work += r[k].normal * (at.stretch - v.preload[k]);
        }
        double f_t = 0.0, f_m = 0.0, moment_ref = 0.0, moment_inc = 0.0;
        const double pull = length_pull(work, 1.0 / v.length) * length_growth(v.touch.length, v.floor);
        for (int k = 0; k < 2; ++k)
        {
            const TouchPoint& p = v.touch.point[k];
            const double tilt = preloaded_tilt_force(r[k].normal, v.touch.slope, k == 0 ? pull : -pull, p.inside, p.overlap,
                                                     v.preload[k]);
            const double beyond = 0.5 * p.overlap;
            f_t += r[k].shear + tilt;
            f_m -= r[k].normal;
            moment_inc -= p.inc_t * r[k].normal + p.inc_m * r[k].shear + (p.inc_m + beyond) * tilt;
            moment_ref += p.ref_t * r[k].normal + p.ref_m * r[k].shear + (p.ref_m + beyond) * tilt;
        }
        const Index swapped = contacts.swapped[i];
        loads[2 * i + swapped] = load_on(v.touch.ex, v.touch.ey, -f_t, -f_m, moment_ref);
        loads[2 * i + 1 - swapped] = load_on(v.touch.ex, v.touch.ey, f_t, f_m, moment_inc);
    }
}

PointTally renew_points(IndexRange range, const Model& model, const State& state, const PointRule& rule,
                        std::vector<StaticPoint>& points, std::vector<ContactTangent>& tangents)
{
    PointTally tally;
    for (Index i = range.begin; i < range.end; ++i)
    {
        const View v = view(model, state, i);
        ContactTangent& all = tangents[i];
        all.e_x = v.touch.ex;
        all.e_y = v.touch.ey;
        for (int k = 0; k < 2; ++k)
        {
            StaticPoint& point = points[2 * i + k];
            const TouchPoint& p = v.touch.point[k];
            PointPlace at = place(v, k, point, state.contacts.rest_overlap(k, i));
            const PointReaction r = react(joint_of(v, point), at, point.start_shear);
            const PointStatus last = point.status;
            point.status = r.status;
            point.strength = r.strength;
            point.iterations_open = r.status != PointStatus::open
                                        ? 0
                                        : static_cast<std::uint8_t>(std::min(point.iterations_open + 1, 100));
            if (!rule.is_first && r.status != last)
                point.trust = std::min(less_trust * point.trust, 1.0);
            else if (!rule.is_first && r.status != PointStatus::stick)
                point.trust = std::max(more_trust * point.trust, least_trust);
            if (r.status == PointStatus::open && !point.is_parted && (rule.part_all_open || point.iterations_open >= parts_after))
            {
                point.is_parted = true;
                tally.newly_parted += std::abs(r.shear) > 0.0 ? 1 : 0;
            }
            if (heals(r, point))
                ++tally.newly_parted;
            if (r.status == PointStatus::open && point.is_parted)
            {
                point.start_shear = 0.0;
                count_ways_anew(v, k, point);
                at.bears = false;
            }
            tally.stick += r.status == PointStatus::stick ? 1 : 0;
            tally.slip += r.status == PointStatus::slip ? 1 : 0;
            tally.open += r.status == PointStatus::open && !point.is_parted ? 1 : 0;
            if (r.status == PointStatus::slip)  // slipped way is excess over K_S L, against the force
                tally.friction += std::abs(r.shear * r.excess) / (v.joint->shear_stiffness * v.length);
            all.ref_t[k] = p.ref_t;
            all.ref_m[k] = p.ref_m;
            all.inc_t[k] = p.inc_t;
            all.inc_m[k] = p.inc_m;
            point.holds_shear = r.status == PointStatus::stick || (r.status == PointStatus::open && at.bears && r.excess == 0.0);
            all.point[k] = tangent(*v.joint, v.length, r, at.bears, point.trust);
        }
    }
    return tally;
}

double greatest_way(IndexRange range, const State& state, const std::vector<ContactTangent>& tangents,
                    const std::vector<double>& step)
{
    double greatest = 0.0;
    for (Index i = range.begin; i < range.end; ++i)
        for (int k = 0; k < 2; ++k)
            greatest = std::max(greatest, tangents[i].way(k, &step[3 * state.contacts.ref[i]], &step[3 * state.contacts.inc[i]]));
    return greatest;
}

void restrain_points(IndexRange range, const State& state, const std::vector<double>& step, double far,
                     std::vector<StaticPoint>& points, std::vector<ContactTangent>& tangents)
{
    for (Index i = range.begin; i < range.end; ++i)
        for (int k = 0; k < 2; ++k)
        {
            StaticPoint& point = points[2 * i + k];
            if (point.trust >= 1.0 ||
                !(tangents[i].way(k, &step[3 * state.contacts.ref[i]], &step[3 * state.contacts.inc[i]]) > far))
                continue;
            const double last = point.trust;
            point.trust = std::min(less_trust * last, 1.0);
            if (point.status == PointStatus::open)
                tangents[i].point[k].normal *= point.trust / last;
            if (!point.holds_shear)
                tangents[i].point[k].shear *= point.trust / last;
        }
}

void commit_points(IndexRange range, const Model& model, const std::vector<StaticPoint>& points, State& state)
{
    Contacts& contacts = state.contacts;
    for (Index i = range.begin; i < range.end; ++i)
    {
        const View v = view(model, state, i);
        ContactLanes& l = contacts.lane[i / lanes];
        const Index lane = i % lanes;
        double work = 0.0;
        for (int k = 0; k < 2; ++k)
        {
            const StaticPoint& point = points[2 * i + k];
            const PointPlace at = place(v, k, point, l.rest_overlap[k][lane]);
            const PointReaction r = at.is_closed ? react(joint_of(v, point), at, point.start_shear) : PointReaction{};
            const double overlap = v.pressed(k);
            l.normal_force[k][lane] = r.normal;
            l.shear_force[k][lane] = r.shear;
            l.overlap[k][lane] = overlap;
            l.rest_overlap[k][lane] = at.is_closed ? rest_overlap(overlap, l.rest_overlap[k][lane], 0.0) : 0.0;
            contacts.regime[k][i] = static_cast<std::uint8_t>(r.status == PointStatus::open   ? Regime::open
                                                              : r.status == PointStatus::slip ? Regime::slip
                                                                                              : Regime::stick);
            work += r.normal * (at.stretch - v.preload[k]);
        }
        const double pull = length_pull(work, 1.0 / v.length) * length_growth(v.touch.length, v.floor);
        for (int k = 0; k < 2; ++k)
        {
            const TouchPoint& p = v.touch.point[k];
            l.tilt_force[k][lane] = preloaded_tilt_force(l.normal_force[k][lane], v.touch.slope, k == 0 ? pull : -pull, p.inside,
                                                         p.overlap, v.preload[k]);
        }
        l.last_length[lane] = v.length;
    }
}
}  // namespace hdem
