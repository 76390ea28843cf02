#pragma once
/// What anchored and local bolts remember: their numbers in SupportState::history.

#include "core/model/support.h"
#include "core/state/blocks.h"
#include "core/state/support_state.h"

namespace hdem
{
struct AnchoredMemory
{
    double free = 0.0;     ///< distance of its ends without force [m]
    double plastic = 0.0;  ///< [m]
};

/// Memory of one crossing of a local bolt.
struct LocalMemory
{
    double free = 0.0;      ///< distance of its ends without force [m]
    double straight = 0.0;  ///< offset across the bolt without force [m]
    double plastic = 0.0;   ///< [m]
    double sheared = 0.0;   ///< plastic, across [m]
    double cut = 0.0;       ///< 1: it has ruptured
};

template <typename Memory>
Memory* memory_of(const Bolt& bolt, std::vector<double>& history)
{
    return reinterpret_cast<Memory*>(history.data() + bolt.history);
}

[[nodiscard]] inline bool is_there(const BoltLink& link, const Blocks& blocks)
{
    return blocks.present[link.first] != 0 && blocks.present[link.second] != 0;
}

[[nodiscard]] inline bool acts(const Bolt& bolt, const BoltRecord& record)
{
    return record.status != BoltStatus::planned && record.status != BoltStatus::lost &&
           (record.status != BoltStatus::ruptured || bolt.kind != BoltKind::anchored);
}
}  // namespace hdem
