// All loops of kernels.h once more, compiled with AVX2 where the rest of the program is not: core/CMakeLists.txt.
#include "core/kernels_avx2.h"

#ifdef HDEM_AVX2_KERNELS
#include "core/contact/contacts_by_four.cpp"
#include "core/contact/joint_points.cpp"
#include "core/contact/load_sums.cpp"
#include "core/contact/spring_energies.cpp"
#include "core/motion/integrator_kernels.cpp"
#include "core/statics/front_kernels.cpp"
#include "core/statics/front_solve.cpp"

namespace hdem
{
bool has_avx2_kernels()
{
    return __builtin_cpu_supports("avx2");
}

const Kernels& avx2_kernels()
{
    return lanes_avx2::kernels_here;
}
}  // namespace hdem

#else
namespace hdem
{
bool has_avx2_kernels()
{
    return false;
}

const Kernels& avx2_kernels()
{
    return plain_kernels();
}
}  // namespace hdem
#endif
