#include "core/kernels_avx2.h"
#include "core/kernels_here.h"

namespace hdem
{
const Kernels& plain_kernels()
{
    return kernels_here;
}

const Kernels& kernels()
{
    static const Kernels& fastest = has_avx2_kernels() ? avx2_kernels() : plain_kernels();
    return fastest;
}
}  // namespace hdem
