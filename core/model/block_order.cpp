#include "core/model/block_order.h"

namespace hdem
{
namespace
{
Shapes permuted(const std::vector<Index>& from, const Shapes& old)
{
    Shapes shapes;
    shapes.part_begin.push_back(0);
    shapes.vertex_begin.push_back(0);
    for (std::size_t i = 0; i < from.size(); ++i)
    {
        for (Index part = old.part_begin[from[i]]; part < old.part_begin[from[i] + 1]; ++part)
        {
            for (Index v = old.vertex_begin[part]; v < old.vertex_begin[part + 1]; ++v)
            {
                shapes.vertex.push_back(old.vertex[v]);
                shapes.edge_tangent.push_back(old.edge_tangent[v]);
                shapes.edge_length.push_back(old.edge_length[v]);
                shapes.edge_source.push_back(old.edge_source[v]);
                shapes.is_reflex.push_back(old.is_reflex[v]);
                shapes.to_twin.push_back(old.to_twin[v]);
            }
            shapes.vertex_begin.push_back(static_cast<Index>(shapes.vertex.size()));
            shapes.part_block.push_back(static_cast<Index>(i));
            shapes.part_centre.push_back(old.part_centre[part]);
            shapes.part_radius.push_back(old.part_radius[part]);
        }
        shapes.part_begin.push_back(shapes.parts());
    }
    return shapes;
}
void reorder_sides(const std::vector<Index>& to, std::vector<Boundary>& boundaries)
{
    for (Boundary& boundary : boundaries)
    {
        for (BoundaryFace& face : boundary.faces)
            face.block = to[face.block];
        for (BoundaryWall& wall : boundary.walls)
            wall.block = to[wall.block];
        for (BoundaryForce& force : boundary.forces)
            force.block = to[force.block];
        for (Index& block : boundary.holds)
            block = to[block];
    }
}
}  // namespace

void reorder_blocks(const std::vector<Index>& user_number, Model& model)
{
    if (user_number == model.user_number)
        return;
    std::vector<Index> from, to(user_number.size());
    for (const Index user : user_number)
        from.push_back(model.slot_of_user[user]);
    for (std::size_t i = 0; i < from.size(); ++i)
        to[from[i]] = static_cast<Index>(i);

    model.shapes = permuted(from, model.shapes);
    permute(from, model.name);
    permute(from, model.material);
    permute(from, model.excavation);
    permute(from, model.area);
    permute(from, model.mass);
    permute(from, model.inertia);
    permute(from, model.full_inertia);
    permute(from, model.radius);
    permute(from, model.start);
    for (Load& load : model.loads)
        for (Index& block : load.blocks)
            block = to[block];
    reorder_sides(to, model.boundaries);
    for (Bolt& bolt : model.support.bolts)
    {
        for (BoltLink& link : bolt.links)
        {
            link.first = to[link.first];
            link.second = to[link.second];
        }
        for (Index& block : bolt.blocks)
            block = to[block];
    }
    for (Liner& liner : model.support.liners)
        for (LinerSegment& segment : liner.segments)
            if (segment.block != no_index)
                segment.block = to[segment.block];
    list_ends(model.support);
    model.user_number = user_number;
    for (std::size_t i = 0; i < user_number.size(); ++i)
        model.slot_of_user[user_number[i]] = static_cast<Index>(i);
}
}  // namespace hdem
