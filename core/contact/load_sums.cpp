// Compiled for several kinds of processors: core/kernels.h.
#include "core/contact/running_sums.h"
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
          contacts_(words_at(&force.contacts)),
          joint_(contacts_ & of_joint),
          joint_load_{force.joint_load, force.joint_load},
          least_load_{force.least_load, force.least_load}
    {
    }

    explicit LoadSum(const Triple& weight)
        : sum_{weight.x, weight.y, weight.w, 0.0},
          joint_{std::bit_cast<Words>(FloatLanes{0.0F, -1.0F, 1.0F, 0.0F})},
          joint_load_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
          least_load_{least_joint_load(weight), least_joint_load(weight)}
    {
    }

    [[gnu::always_inline]] void add(const BlockLoad& load, const JointUse& use)
    {
        const Pack::V of_load = Pack::load(&load.x).v;
        sum_ += of_load;
        const Words of_use = words_at(&use);  // contacts, mobilised, t_x, t_y
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
            const Words taken = __builtin_shufflevector(more, more, 1, 1, 1, 1);
            joint_ = (joint & taken) | (joint_ & ~taken);
            joint_load_ = std::bit_cast<Pair>((std::bit_cast<Words>(squared) & taken) |
                                              (std::bit_cast<Words>(joint_load_) & ~taken));
        }
    }

    [[gnu::always_inline]] void store(BlockForce& force) const
    {
        Pack(sum_).store(&force.x);
        const Words found = joint_ | (contacts_ & ~of_joint);
        std::memcpy(&force.contacts, &found, sizeof found);
        force.joint_load = joint_load_[0];
        force.least_load = least_load_[0];
    }

  private:
    static constexpr Words of_joint{0, -1, -1, -1};

    Pack::V sum_;
    Words contacts_{};  ///< the first of them
    Words joint_;       ///< 0, then mobilised, t_x, t_y: floats
    Pair joint_load_;   ///< twice the same
    Pair least_load_;   ///< twice the same
};
static_assert(offsetof(JointUse, t_y) == 12 && offsetof(BlockForce, t_y) == offsetof(BlockForce, contacts) + 12);

/// A joint's share in use and where it stands: the greatest of such numbers is the joint in use most, of several alike the first. Below 0: no force point. (Floats
/// that are not below 0 have the order of their bits.)
constexpr std::int64_t no_rank = std::numeric_limits<std::int64_t>::min();
[[nodiscard]] inline std::int64_t rank_of(std::uint64_t word, std::uint32_t entry)
{
    return static_cast<std::int64_t>((word | std::numeric_limits<std::uint32_t>::max()) - entry);
}
/// The first two members of JointUse: what ranks need takes one load.
[[nodiscard]] inline std::uint64_t first_word(const JointUse& use)
{
    std::uint64_t word;
    std::memcpy(&word, &use, sizeof word);
    return word;
}
static_assert(offsetof(JointUse, contacts) == 0 && offsetof(JointUse, mobilised) == 4);
static_assert(std::endian::native == std::endian::little);

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
        const std::int64_t rank = rank_of(first_word(loads.use[entry / 2]), entry);
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
        std::uint64_t words = 0;
        std::int64_t most = no_rank, next = no_rank;
        for (Index e = entries.begin; e < entries.end; ++e)
        {
            const auto entry = static_cast<std::uint32_t>(list.entry[e]);
            const std::uint64_t word = first_word(loads.use[entry / 2]);
            sum += Pack::load(&loads.load[entry].x);
            words |= word;
            if constexpr (find_joint)  // without branches: which joint it is nobody can predict
            {
                const std::int64_t rank = rank_of(word, entry);
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
        force.contacts = static_cast<std::uint32_t>(words);
    }
}

template <bool find_joint>
void add_all(const PartEntries& part, const Model& model, const std::vector<std::uint8_t>& present,
             const std::vector<Triple>& external, const ContactLoads& loads, BlockForce* sums, ContactLoads& kept)
{
    const std::uint8_t* number = part.numbers.data();
    const auto add = [&](LoadSum<find_joint> sum, const PartEntries::OfBlock& of)
    {
        for (const std::uint8_t* const end = number + of.count; number < end; ++number)
            sum.add(loads.load[*number], loads.use[*number / 2]);
        sum.store(sums[of.block]);
    };
    for (const PartEntries::OfBlock& of : part.begun)
        add(LoadSum<find_joint>(weight_of(of.block, model, present, external)), of);
    for (const PartEntries::OfBlock& of : part.continued)
        add(LoadSum<find_joint>(sums[of.block]), of);
    for (const std::uint8_t n : part.kept)
    {
        kept.load[2 * loads.first + n] = loads.load[n];
        kept.use[loads.first + n / 2] = loads.use[n / 2];
    }
}
}  // namespace

void sum_loads(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
               const std::vector<Triple>& external, bool find_joint, Blocks& blocks)
{
    const auto sum = find_joint ? sum_of_blocks<true> : sum_of_blocks<false>;
    sum(range, model, list, loads, external, blocks);
}

void add_loads(const PartEntries& part, const Model& model, const std::vector<std::uint8_t>& present,
               const std::vector<Triple>& external, const ContactLoads& loads, bool find_joint, BlockForce* sums,
               ContactLoads& kept)
{
    const auto add = find_joint ? add_all<true> : add_all<false>;
    add(part, model, present, external, loads, sums, kept);
}
}  // namespace HDEM_LANES
}  // namespace hdem
