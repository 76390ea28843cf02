#pragma once
/// Joints that end in the rock: traces of finite length, joints that stop at faults, and what they meet.

#include "core/geometry/polygon.h"
#include "core/model/case_def.h"

#include <vector>

namespace hdem
{
/// Does a joint of the set end in the rock?
[[nodiscard]] bool is_finite(const JointSetDef& set);

/// Are the joints of the set cut as lines, all at once with those of other sets? Finite sets are, and with them through-going sets
/// that cut every block: only together do their lines enclose blocks.
[[nodiscard]] bool is_cut_as_lines(const CaseDef& def, const JointSetDef& set);

/// Length of traces an area of a set, without persistence, regions and stops [m/m2].
[[nodiscard]] double trace_intensity(const JointSetDef& set);

/// Number of traces that would be drawn of a set with `trace`, those around the box included; an estimate.
[[nodiscard]] double count_traces(const JointSetDef& set, const Box& box);

/// The lines of all such sets in the order of the case, and what was drawn.
///
/// Traces of a set lie on lines at its spacing and mean dip, one after another with gaps between them, and each is turned about its
/// middle by its own deviation. With p21 their middles lie anywhere, independent of each other (Baecher et al. 1977): their number is
/// drawn from a Poisson distribution with the mean p21 A / E(length). Traces whose middle is outside the domain are drawn as well.
///
/// A joint that stops at a fault is what of it can be reached from its middle; of a through-going one from its point on the axis of
/// spacings. Ends at faults and at boundaries of regions are made longer by line_slack.
/// @pre find_rock_problems has none
/// @param drawn  gets an entry for each joint set
[[nodiscard]] std::vector<SourceLine> draw_lines(const CaseDef& def, std::vector<DrawnSet>& drawn);
}  // namespace hdem
