#pragma once
/// The stages of a cycle in their order.

#include "core/detection/cell_list.h"
#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Scratch of the broad phase.
struct BroadPhase
{
    CellList cells;
    std::vector<Box> boxes;
    std::vector<std::uint64_t> pairs;
    std::vector<Contact> tracked;
};

/// Find all contacts anew; those that stay keep their history.
void rebuild_contacts(const Model& model, State& state, BroadPhase& broad);

/// One cycle, in the order of core/README.md. The same bits on any number of threads.
void run_cycle(const Model& model, State& state, Workspace& work, BroadPhase& broad, int threads = 1);
}  // namespace hdem
