#pragma once
/// Sums over contacts or blocks that do not depend on the number of threads.

#include "core/types.h"
#include "parallel/team.h"

#include <algorithm>
#include <vector>

namespace hdem
{
/// work(range) for the pieces of [0, size) on all threads, returning a sum.
template <typename Sum, typename Work>
Sum sum_pieces(int threads, Index size, const Work& work)
{
    constexpr Index piece = 1024;  // contacts or blocks whose sums are formed together, on any number of threads
    const Index pieces = (size + piece - 1) / piece;
    std::vector<Sum> sums(static_cast<std::size_t>(pieces));
    with_team(threads,
              [&](const Team& team)
              {
                  const IndexRange mine = team.share(pieces);
                  for (Index p = mine.begin; p < mine.end; ++p)
                      sums[p] = work(IndexRange{p * piece, std::min(size, (p + 1) * piece)});
              });
    Sum all{};
    for (const Sum& sum : sums)
        all += sum;
    return all;
}

/// The greatest of several numbers, as a sum.
struct Greatest
{
    double value = 0.0;
    Greatest& operator+=(const Greatest& other)
    {
        value = std::max(value, other.value);
        return *this;
    }
};

struct Nothing
{
    Nothing& operator+=(const Nothing&) { return *this; }
};
}  // namespace hdem
