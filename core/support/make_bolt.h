#pragma once
/// From a bolt of a case, and the blocks that it runs through, to a bolt of a model.

#include "core/model/case_def.h"
#include "core/state/state.h"
#include "core/support/bolt_path.h"
#include "core/support/bolt_pattern.h"

#include <string>
#include <vector>

namespace hdem
{
/// The one place where what is said of one bolt becomes what acts on a metre of thickness. The bolt is tied to nothing yet.
/// @param length  from head to end [m]
[[nodiscard]] Bolt bolt_per_metre(const BoltDef& from, const std::string& name, double length);

/// Greatest length of a segment of a grouted bolt: that of the case, else a tenth of the length over which the bond takes over its tension [m].
[[nodiscard]] double longest_segment(const BoltDef& from, const Bolt& bolt);

/// Tie it to the blocks of its path: links, segments of a grouted one, and the size of its history.
/// @param line  in local coordinates
void tie(const BoltDef& from, const std::vector<PathPiece>& path, const BoltLine& line, const Blocks& blocks, Bolt& bolt);
}  // namespace hdem
