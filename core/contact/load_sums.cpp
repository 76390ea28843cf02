// Compiled for several kinds of processors: core/kernels.h.
#include "core/contact/block_forces.h"
#include "core/kernels_here.h"
#include "core/simd.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <limits>

namespace hdem
{
inline namespace HDEM_LANES
{
namespace
{
using Words = std::int32_t __attribute__((vector_size(16)));
using Pair = double __attribute__((vector_size(16)));

[[nodiscard]] inline Words words_at(const void* from)
{
    Words words;
    std::memcpy(&words, from, sizeof words);
    return words;
}

/// Sum of the loads on a block, while they are added. In vectors throughout: g++ makes branches of anything else, and a processor cannot predict which joint of a
/// block is used most.
template <bool find_joint>
class LoadSum
{
  public:
    explicit LoadSum(const BlockForce& force)
        : sum_(Pack::load(&force.x).v),
          contacts_(words_at(&force.mobilised)),
          joint_(contacts_ & of_joint),
          joint_load_{force.joint_load, force.joint_load},
          least_load_{force.least_load, force.least_load}
    {
    }

    [[gnu::always_inline]] void add(const BlockLoad& load, const JointUse& use)
    {
        const Pack::V of_load = Pack::load(&load.x).v;
        sum_ += of_load;
        const Words of_use = words_at(&use);  // mobilised, t_x, t_y, contacts
        contacts_ |= of_use;
        if constexpr (find_joint)
        {
            const Words joint = of_use & of_joint;
            const Pair force = __builtin_shufflevector(of_load, of_load, 0, 1), squares = force * force;
            const Pair squared = squares + __builtin_shufflevector(squares, squares, 1, 0);
            const FloatLanes now = std::bit_cast<FloatLanes>(joint), before = std::bit_cast<FloatLanes>(joint_);
            // Two joints that slide have both all of their strength in use: the one that bears more counts, whichever stands first.
            const Words more = (Words(now > before) | (Words(now == before) & std::bit_cast<Words>(squared > joint_load_))) &
                               std::bit_cast<Words>(squared > least_load_);
            const Words taken = __builtin_shufflevector(more, more, 0, 0, 0, 0);
            joint_ = (joint & taken) | (joint_ & ~taken);
            joint_load_ = std::bit_cast<Pair>((std::bit_cast<Words>(squared) & taken) |
                                              (std::bit_cast<Words>(joint_load_) & ~taken));
        }
    }

    [[gnu::always_inline]] void store(BlockForce& force) const
    {
        Pack(sum_).store(&force.x);
        const Words found = joint_ | (contacts_ & ~of_joint);
        std::memcpy(&force.mobilised, &found, sizeof found);
        force.joint_load = joint_load_[0];
    }

  private:
    static constexpr Words of_joint{-1, -1, -1, 0};

    Pack::V sum_;
    Words contacts_{};  ///< the last of them
    Words joint_;       ///< mobilised, t_x, t_y: floats
    Pair joint_load_;   ///< twice the same
    Pair least_load_;   ///< twice the same
};
static_assert(offsetof(JointUse, contacts) == 12 && offsetof(BlockForce, contacts) == offsetof(BlockForce, mobilised) + 12);

/// A joint's share in use and where it stands: the greatest of such numbers is the joint in use most, of several alike the first. Below 0: no force point. (Floats
/// that are not below 0 have the order of their bits.)
constexpr std::int64_t no_rank = std::numeric_limits<std::int64_t>::min();
[[nodiscard]] inline std::int64_t rank_of(float mobilised, std::uint32_t entry)
{
    return (std::int64_t{std::bit_cast<std::int32_t>(mobilised)} << 32) | ~entry;
}
[[nodiscard]] inline std::uint32_t entry_of(std::int64_t rank)
{
    return ~static_cast<std::uint32_t>(rank);
}
[[nodiscard]] inline bool are_alike(std::int64_t a, std::int64_t b)
{
    return a >> 32 == b >> 32;
}

[[nodiscard]] inline double load_squared(const ContactLoads& loads, std::uint32_t entry)
{
    const BlockLoad& load = loads.load[entry];
    return load.x * load.x + load.y * load.y;
}

/// Of the joints that bear more than `least`, the one in use most. Two that slide have both all of their strength in use: the one that bears more counts, whichever stands
/// first.
[[gnu::noinline]] std::int64_t rank_of_bearing(IndexRange entries, const BlockContacts& list, const ContactLoads& loads,
                                               double least)
{
    std::int64_t found = no_rank;
    double most = 0.0;
    for (Index e = entries.begin; e < entries.end; ++e)
    {
        const auto entry = static_cast<std::uint32_t>(list.entry[e]);
        const std::int64_t rank = rank_of(loads.use[entry / 2].mobilised, entry);
        const double squared = load_squared(loads, entry);
        if (rank >= 0 && squared > least && (are_alike(rank, found) ? squared > most : rank > found))
        {
            most = squared;
            found = rank;
        }
    }
    return found;
}

template <bool find_joint>
void sum_of_blocks(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                   const std::vector<Triple>& external, Blocks& blocks)
{
    for (Index b = range.begin; b < range.end; ++b)
    {
        const IndexRange entries{list.begin[b], list.begin[b + 1]};
        const Triple weight = weight_of(b, model, blocks.present, external);
        const double least = least_joint_load(weight);
        Pack sum(Pack::V{weight.x, weight.y, weight.w, 0.0});
        BlockForce& force = blocks.force[b];
        std::uint32_t contacts = 0;
        std::int64_t most = no_rank, next = no_rank;
        for (Index e = entries.begin; e < entries.end; ++e)
        {
            const auto entry = static_cast<std::uint32_t>(list.entry[e]);
            const JointUse& use = loads.use[entry / 2];
            sum += Pack::load(&loads.load[entry].x);
            contacts |= use.contacts;
            if constexpr (find_joint)  // without branches: which joint it is nobody can predict
            {
                const std::int64_t rank = rank_of(use.mobilised, entry);
                next = std::max(next, std::min(most, rank));
                most = std::max(most, rank);
            }
        }
        if (most >= 0 && (are_alike(most, next) || !(load_squared(loads, entry_of(most)) > least))) [[unlikely]]
            most = rank_of_bearing(entries, list, loads, least);
        sum.store(&force.x);
        const JointUse use = most >= 0 ? loads.use[entry_of(most) / 2] : JointUse();
        force.mobilised = use.mobilised;
        force.t_x = use.t_x;
        force.t_y = use.t_y;
        force.contacts = contacts;
    }
}

template <bool find_joint>
void add_all(IndexRange range, const ContactLoads& loads, const Index* block_of, BlockForce* sums, ContactLoads& kept)
{
    const auto last = static_cast<std::uint32_t>(2 * (range.end - loads.first));
    for (auto e = static_cast<std::uint32_t>(2 * (range.begin - loads.first)); e < last; ++e)
    {
        const Index block = block_of[e];
        if (block == no_index) [[unlikely]]
        {
            kept.load[2 * loads.first + e] = loads.load[e];
            kept.use[loads.first + e / 2] = loads.use[e / 2];
            continue;
        }
        BlockForce& force = sums[block];
        LoadSum<find_joint> sum(force);
        sum.add(loads.load[e], loads.use[e / 2]);
        sum.store(force);
    }
}
}  // namespace

void sum_loads(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
               const std::vector<Triple>& external, bool find_joint, Blocks& blocks)
{
    const auto sum = find_joint ? sum_of_blocks<true> : sum_of_blocks<false>;
    sum(range, model, list, loads, external, blocks);
}

void add_loads(IndexRange range, const ContactLoads& loads, bool find_joint, const Index* block_of, BlockForce* sums,
               ContactLoads& kept)
{
    const auto add = find_joint ? add_all<true> : add_all<false>;
    add(range, loads, block_of, sums, kept);
}
}  // namespace HDEM_LANES
}  // namespace hdem
