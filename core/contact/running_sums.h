#pragma once
/// The sums of core/contact/block_forces.h, formed while contacts are evaluated.

#include "core/contact/block_forces.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// The contacts of a part, block by block. A number is that of BlockContacts, counted from the part's first contact on.
struct PartEntries
{
    struct OfBlock
    {
        Index block;
        Index count;  ///< of numbers
    };
    std::vector<OfBlock> begun;         ///< blocks whose first contact is one of these
    std::vector<OfBlock> continued;     ///< blocks that have contacts in earlier parts, too
    std::vector<std::uint8_t> numbers;  ///< of these blocks one after another, ascending for each
    std::vector<std::uint8_t> kept;     ///< of all other blocks
};

/// Sums of forces part by part of the contacts, so that loads need not go through memory: they stay in the cache of a core until the part has been evaluated.
/// A sum begins with the block's first contact and ends with its last one: the bits are those of sum_forces. Where threads share the parts, loads on blocks with
/// contacts in several shares are kept for sum_forces.
class RunningSums
{
  public:
    /// @param parts   contacts of each part, in their order: at most most_contacts each
    /// @param shares  parts that one thread takes, in their order
    void prepare(const std::vector<IndexRange>& parts, const std::vector<IndexRange>& shares, const Contacts& contacts,
                 const BlockContacts& list);

    /// Add the loads of a part. Those of its blocks that have their first contact in it begin with weight and `external` forces (none: empty).
    /// Reads: loads, which begin with the part's first contact. Writes: sums, kept loads.
    void add(Index part, const Model& model, const std::vector<std::uint8_t>& present, const std::vector<Triple>& external,
             const ContactLoads& loads, bool find_joint, ContactLoads& kept);

    /// The blocks of `range` that need sum_forces: those with contacts in several shares, and those without contacts.
    [[nodiscard]] std::vector<Index> others(IndexRange range) const;

    static constexpr Index most_contacts = 128;  ///< of a part: their numbers are bytes

    std::vector<BlockForce> sums;  ///< of all other blocks, once all parts are added

  private:
    void find_others(const std::vector<IndexRange>& parts, const std::vector<IndexRange>& shares, const BlockContacts& list);

    std::vector<PartEntries> parts_;
    std::vector<Index> others_;           ///< ascending
    std::vector<std::uint8_t> is_other_;  ///< of each block
};
}  // namespace hdem
