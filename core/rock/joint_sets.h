#pragma once
/// Traces of joint sets: which straight lines cross the domain.

#include "core/geometry/convex_split.h"
#include "core/model/case_def.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// The joints of one set across a box, in order along the spacing axis.
///
/// Joint i is a line through  c_i = origin + i · spacing · across  at dip_deg + δ_i, δ_i uniform in ± deviation_deg: it turns about
/// the point where it crosses the spacing axis, so joint 0 always passes through the origin. The axis runs through the origin
/// at right angles to the dip.
struct JointTraces
{
    std::int32_t set = 0;      ///< number of the joint set
    std::int32_t source = 0;   ///< of the edges it cuts
    Vec2 origin = {0.0, 0.0};  ///< [m]
    Vec2 across = {0.0, 1.0};  ///< unit vector of the spacing axis
    double spacing = 1.0;      ///< [m]
    double tilt = 0.0;         ///< tan(deviation_deg)
    std::int64_t first = 0;    ///< i of lines.front()
    std::vector<CutLine> lines;

    /// Positions in `lines` of the joints that may touch the polygon: all that do, and few others.
    [[nodiscard]] IndexRange near(const Polygon& polygon) const;
};

/// What a random stream is for; streams of different uses never share numbers.
enum class RandomUse : std::uint64_t
{
    dip = 1,
    persistence = 2
};

/// Seed of a set's stream: splitmix64 over the generator's seed, the set's number and the use; a set's own seed stands in for the
/// first two.
std::uint64_t stream_seed(const GeneratorDef& generator, const JointSetDef& set, std::int32_t number, RandomUse use);

/// Number of joints the set would have across the box; a double because a bad spacing may ask for more than fit an integer.
double count_joints(const JointSetDef& set, const Box& box);

/// Draw the joints of a set across a box. The same on every platform: directions come from unit_direction(), random numbers from
/// Boost.Random, and the rest is + - * / and square roots.
/// @pre spacing > 0, 0 <= deviation_deg < 90
JointTraces draw_joints(const JointSetDef& set, std::int32_t number, const GeneratorDef& generator, const Box& box);
}  // namespace hdem
