#pragma once
/// Work shared out over threads. Without OpenMP (HDEM_OPENMP off) everything runs on one.

#include "core/types.h"

#include <algorithm>

namespace hdem
{
/// Run `stage` on consecutive ranges of `chunk` that cover `all`, on up to `threads` threads. The ranges do not depend on the number of
/// threads; a stage whose ranges do not depend on each other gives the same bits on any.
template <typename Stage>
void for_ranges(IndexRange all, Index chunk, int threads, const Stage& stage)
{
    const Index count = (all.size() + chunk - 1) / chunk;
    const auto range = [&](Index i) { return IndexRange{all.begin + i * chunk, std::min(all.end, all.begin + (i + 1) * chunk)}; };
    if (threads <= 1 || count <= 1)
    {
        for (Index i = 0; i < count; ++i)
            stage(range(i));
        return;
    }
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(threads)
#endif
    for (Index i = 0; i < count; ++i)
        stage(range(i));
}
}  // namespace hdem
