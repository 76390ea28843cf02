#pragma once
/// The loops of kernels.h for processors with AVX2, in builds for others.

#include "core/kernels.h"

namespace hdem
{
/// Can this processor run these kernels, and were they built?
[[nodiscard]] bool has_avx2_kernels();

/// @pre  has_avx2_kernels()
[[nodiscard]] const Kernels& avx2_kernels();
}  // namespace hdem
