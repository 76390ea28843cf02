#include "core/model/near_name.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hdem
{
namespace
{
/// Insertions, deletions, replacements and swaps of neighbours that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    std::iota(above.begin(), above.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, above);
        std::swap(above, row);
    }
    return above[b.size()];
}
}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& names)
{
    std::string best;
    std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& name : names)
    {
        const std::size_t difference = name.size() > word.size() ? name.size() - word.size() : word.size() - name.size();
        if (name.empty() || word.size() > 200 || difference >= least)
            continue;
        if (const std::size_t distance = edit_distance(word, name); distance < least)
        {
            least = distance;
            best = name;
        }
    }
    return best;
}
}  // namespace hdem
