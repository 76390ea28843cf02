#include "core/model/model.h"

#include "core/geometry/convex_part.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
Index JointTable::find(std::int32_t source_a, std::int32_t source_b, Index material_a, Index material_b) const
{
    if (std::min(source_a, source_b) == edge_wall)
        return of_walls;
    // Two edges of two sets: the set listed first, whichever block's edge is the reference.
    for (const std::int32_t source : {std::min(source_a, source_b), std::max(source_a, source_b)})
        if (source >= 0 && of_joint_set[source] != no_index)
            return of_joint_set[source];
    return of_materials[material_a * materials + material_b];
}

double Model::size(Index block) const
{
    return std::sqrt(area[block]);
}

Index Model::find_block(const std::string& block_name) const
{
    const auto at = std::find(name.begin(), name.end(), block_name);
    return at == name.end() ? no_index : static_cast<Index>(at - name.begin());
}
}  // namespace hdem
