#include "core/contact/contact_forces_wide.h"

#ifdef __AVX512F__
#include "core/contact/wide_lanes.h"
//
#include "core/contact/contact_pass.h"
#include "core/contact/joint_reaction.h"
#include "core/contact/spring_energies.h"

namespace hdem
{
/// Laws of users, the last of the list, are evaluated four points at a time.
void evaluate_joint_points(const BasicContactGroup<WidePack>& g, WideMask impulsive, const std::array<WidePack, 2>& share,
                           WidePack dt, const BasicJointPlace<WidePack>& place, BasicSums<WidePack>& sums)
{
    static_assert(kind_of<UserLaw>() == JointKind{law_count - 1});
    evaluate_by_one_law<WidePack, law_count - 1>(g, impulsive, share, dt, place, sums);
}

bool has_wide_packs()
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw");
}

ContactTally evaluate_by_eight(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                               Contacts& contacts, ContactLoads& loads, const ContactTally& sums, const PassNeeds& needs)
{
    return evaluate_by<WidePack>(range, model, rule, blocks, contacts, loads, sums, needs);
}

void add_spring_energies_by_eight(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                                  SpringEnergies& sums)
{
    add_energies<WidePack>(range, model, blocks, contacts, sums);
}
}  // namespace hdem

#else
#include "core/kernels.h"

namespace hdem
{
bool has_wide_packs()
{
    return false;
}

ContactTally evaluate_by_eight(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                               Contacts& contacts, ContactLoads& loads, const ContactTally& sums, const PassNeeds& needs)
{
    return kernels().evaluate_contacts(range, model, rule, blocks, contacts, loads, sums, needs);
}

void add_spring_energies_by_eight(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                                  SpringEnergies& sums)
{
    kernels().add_spring_energies(range, model, blocks, contacts, sums);
}
}  // namespace hdem
#endif
