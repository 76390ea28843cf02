#pragma once
/// Traces of joint sets: which straight lines cross the domain.

#include "core/geometry/convex_split.h"
#include "core/model/rock_def.h"
#include "core/rock/distribution.h"

#include <boost/random/uniform_real_distribution.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace hdem
{
/// The joints of one set across a box, in order along the spacing axis.
///
/// Joint i is a line through  c_i = origin + i · spacing · across  at dip_deg + δ_i, δ_i uniform in ± deviation_deg: it turns about
/// the point where it crosses the spacing axis, so joint 0 always passes through the origin. The axis runs through the origin
/// at right angles to the dip.
///
/// A spacing that is drawn is drawn from joint 0 outwards, one stream each way: a greater box adds joints and changes none. A dip that is
/// drawn deviates by less than 45 degrees: beyond, joints of one set would meet, and there would be more of them away from the axis.
struct JointTraces
{
    std::int32_t set = 0;      ///< number of the joint set
    std::int32_t source = 0;   ///< of the edges it cuts
    Vec2 origin = {0.0, 0.0};  ///< [m]
    Vec2 across = {0.0, 1.0};  ///< unit vector of the spacing axis
    double spacing = 1.0;      ///< [m]
    double tilt = 0.0;         ///< tan(deviation_deg), or of the greatest deviation drawn
    std::int64_t first = 0;    ///< i of lines.front()
    std::vector<CutLine> lines;
    std::vector<double> dips;       ///< of the lines [deg]
    std::vector<double> positions;  ///< of the lines on the axis, where spacings are drawn; else empty [m]

    /// Positions in `lines` of the joints that may touch the polygon: all that do, and few others.
    [[nodiscard]] IndexRange near(const Polygon& polygon) const;
};

/// What a random stream is for; streams of different uses never share numbers.
enum class RandomUse : std::uint64_t
{
    dip = 1,
    persistence = 2,
    spacing_up = 3,
    spacing_down = 4,
    trace = 5,
    gap = 6,
    place = 7,
    voronoi = 8
};

/// Seed of a set's stream: splitmix64 over the generator's seed, the set's number and the use; a set's own seed stands in for the
/// first two.
std::uint64_t stream_seed(const GeneratorDef& generator, const JointSetDef& set, std::int32_t number, RandomUse use);

/// Greatest deviation of a through-going joint's dip [deg].
inline constexpr double most_deviation_deg = 45.0;

/// The distribution of a through-going set's dip: that of the case, cut to less than 45 degrees from its mean.
[[nodiscard]] DistributionDef dip_within_reach(const JointSetDef& set);

/// Dip of the next joint: by its distribution, by deviation_deg, or the same for all [deg].
class DipSource
{
  public:
    DipSource(const JointSetDef& set, const DistributionDef& law, std::uint64_t seed);
    [[nodiscard]] double draw();
    [[nodiscard]] double expected() const { return law_ ? law_->mean() : set_.dip_deg; }

  private:
    const JointSetDef& set_;
    std::optional<Distribution> law_;
    boost::random::mt19937_64 engine_;
    boost::random::uniform_real_distribution<double> deviation_{-1.0, 1.0};
};

/// Number of joints the set would have across the box; a double because a bad spacing may ask for more than fit an integer.
double count_joints(const JointSetDef& set, const Box& box);

/// Draw the joints of a set across a box. The same on every platform: directions come from unit_direction(), random numbers from
/// Boost.Random, and the rest is + - * / and square roots; drawn numbers: Distribution.
/// @pre spacing > 0, 0 <= deviation_deg < 90
JointTraces draw_joints(const JointSetDef& set, std::int32_t number, const GeneratorDef& generator, const Box& box);
}  // namespace hdem
