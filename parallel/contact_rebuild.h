#pragma once
/// The list of contacts found anew, by all threads of a team.

#include "core/detection/cell_list.h"
#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
class Team;

/// Cell list, pairs, contacts: see core/detection. Parts are cut into chunks whose size does not depend on the number of threads; what the chunks find is put one
/// after another, so that the list is in the order of core/state/contact_order.h, and the same on any number of threads.
class ContactRebuild
{
  public:
    /// Find all contacts; those that stay keep their history. For each member of the team to call; all have finished when it returns.
    void run(const Model& model, State& state, const Team& team);

  private:
    struct Chunk
    {
        IndexRange parts;
        std::vector<std::uint64_t> pairs;    ///< whose first part lies in `parts`, ascending
        std::vector<std::uint64_t> foreign;  ///< found here, though their first part lies elsewhere
        std::vector<Contact> contacts;
        Index first = 0;  ///< place of the first of them in the list
        EnergyLedger ledger;
    };

    void begin(const Model& model);
    /// Pairs of two parts of one block are left out.
    void find_pairs(Chunk& chunk, const Shapes& shapes) const;
    void sort_pairs(Chunk& chunk) const;
    void place(IndexRange chunks);
    void finish(const Model& model, State& state);

    CellList cells_;
    std::vector<Box> boxes_;
    std::vector<Chunk> chunks_;
    std::vector<Index> old_order_;  ///< of the contacts known before, by their parts
    Contacts list_;
};
}  // namespace hdem
