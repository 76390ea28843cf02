#include "core/rock/joint_table.h"

#include "core/boundary/resolve_boundaries.h"
#include "core/rock/resolve_names.h"

#include <algorithm>

namespace hdem
{
namespace
{
void add_law_of_walls(Index standard, JointTable& table)
{
    table.of_walls = static_cast<Index>(table.laws.size());
    table.laws.push_back(law_of_walls(table.laws[standard]));
    table.unbonded.push_back(table.of_walls);
    if (table.has_memory())
        table.rows.emplace_back();
}
}  // namespace

void assign_joints(const CaseDef& def, Model& model)
{
    JointTable& table = model.joints;
    const auto n = static_cast<Index>(def.materials.size());
    table.materials = n;
    Index fallback = 0;
    for (std::size_t j = 0; j < def.joints.size(); ++j)
        if (def.joints[j].name == "default")
            fallback = static_cast<Index>(j);
    if (!def.boundaries.empty())
        add_law_of_walls(fallback, table);
    table.of_materials.assign(static_cast<std::size_t>(n * n), fallback);
    const auto joint_named = [&](const std::string& name)
    {
        const auto at = std::find(table.names.begin(), table.names.end(), name);
        return at == table.names.end() ? no_index : static_cast<Index>(at - table.names.begin());
    };
    for (std::size_t j = 0; j < def.joints.size(); ++j)
    {
        if (def.joints[j].materials.size() != 2)
            continue;
        const Index a = material_number(def, def.joints[j].materials[0]);
        const Index b = material_number(def, def.joints[j].materials[1]);
        table.of_materials[a * n + b] = table.of_materials[b * n + a] = static_cast<Index>(j);
    }
    for (const FaultDef& fault : def.faults)  // in the order of EdgeSources
        table.of_joint_set.push_back(fault.joint.empty() ? no_index : joint_named(fault.joint));
    for (const RegionDef& region : def.regions)
        table.of_joint_set.push_back(region.joint.empty() ? no_index : joint_named(region.joint));
    for (const JointSetDef& set : def.joint_sets)
        table.of_joint_set.push_back(set.joint.empty() ? no_index : joint_named(set.joint));
    table.of_joint_set.push_back(def.domain.traces_joint.empty() ? no_index
                                                                 : joint_named(def.domain.traces_joint));  // of all traces
    if (def.voronoi.given)
        table.of_joint_set.push_back(def.voronoi.joint.empty() ? no_index : joint_named(def.voronoi.joint));
}
}  // namespace hdem
