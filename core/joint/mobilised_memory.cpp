#include "core/joint/mobilised_memory.h"

#include "core/joint/all_laws.h"

namespace hdem
{
JointMemory mobilised_memory(const JointRow& row, double normal_stress, double shear_stress, JointMemory memory)
{
    if (row.has_memory())
        with_law(row.kind,
                 [&](auto law)
                 {
                     if constexpr (requires { decltype(law)::mobilise(row.numbers, 0.0, 0.0, memory); })
                         decltype(law)::mobilise(row.numbers, normal_stress, shear_stress, memory);
                 });
    return memory;
}
}  // namespace hdem
