#include "core/contact/block_forces.h"

#include "core/kernels.h"

namespace hdem
{
void list_block_contacts(const Contacts& contacts, Index blocks, BlockContacts& list)
{
    list.begin.assign(static_cast<std::size_t>(blocks) + 1, 0);
    list.entry.resize(2 * static_cast<std::size_t>(contacts.size()));
    for (Index i = 0; i < contacts.size(); ++i)
    {
        ++list.begin[contacts.ref[i] + 1];
        ++list.begin[contacts.inc[i] + 1];
    }
    for (Index b = 0; b < blocks; ++b)
        list.begin[b + 1] += list.begin[b];
    std::vector<Index> at(list.begin.begin(), list.begin.end() - 1);
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Index swapped = contacts.swapped[i];
        list.entry[at[contacts.ref[i]]++] = 2 * i + swapped;
        list.entry[at[contacts.inc[i]]++] = 2 * i + 1 - swapped;
    }
}

void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, bool find_joint, Blocks& blocks)
{
    kernels().sum_loads(range, model, list, loads, external, find_joint, blocks);
}
}  // namespace hdem
