#pragma once
/// Quantities of a [[history]], column by column.

#include "core/history_sampler.h"

#include <vector>

namespace hdem
{
struct KnownOfBlock
{
    const char* quantity;  ///< stands for all columns that name it
    Column column;
    double (*value)(const Model&, const State&, Index);
};

struct KnownOfPair
{
    const char* quantity;
    Column column;
    double (*value)(const Model&, const PairSample&);
};

struct KnownOfPoint
{
    const char* quantity;
    Column column;
    double (*value)(const Model&, const State&, const Vec2&);
};

/// Forces are those of one bolt.
struct KnownOfBolt
{
    const char* quantity;
    Column column;
    double (*value)(const Bolt&, const BoltRecord&);
};

struct KnownOfLiner
{
    const char* quantity;
    Column column;
    double (*value)(const Liner&, const LinerRecord&);
};

[[nodiscard]] const std::vector<KnownOfPoint>& known_of_point();
[[nodiscard]] const std::vector<KnownOfBlock>& known_of_block();
[[nodiscard]] const std::vector<KnownOfPair>& known_of_pair();
[[nodiscard]] const std::vector<KnownOfBolt>& known_of_bolt();
[[nodiscard]] const std::vector<KnownOfLiner>& known_of_liner();
}  // namespace hdem
