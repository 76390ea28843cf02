#include "tools/python/block_arrays.h"

#include "core/contact/contact_report.h"
#include "tools/python/outlines.h"

namespace hdem
{
namespace
{
namespace py = pybind11;

/// One number a block: value(slot).
template <typename T, typename Value>
py::array_t<T> column(const Look& look, const Value& value)
{
    py::array_t<T> array(look.model.blocks());
    T* to = array.mutable_data();
    for (const Index slot : look.model.slot_of_user)
        *to++ = static_cast<T>(value(slot));
    return array;
}

/// Several numbers a block.
template <std::size_t width, typename Value>
py::array_t<double> table(const Look& look, const Value& value)
{
    py::array_t<double> array({static_cast<py::ssize_t>(look.model.blocks()), static_cast<py::ssize_t>(width)});
    double* to = array.mutable_data();
    for (const Index slot : look.model.slot_of_user)
    {
        const std::array<double, width> row = value(slot);
        to = std::ranges::copy(row, to).out;
    }
    return array;
}

py::array_t<double> array_of(const Polygon& polygon)
{
    py::array_t<double> array({static_cast<py::ssize_t>(polygon.size()), py::ssize_t{2}});
    double* to = array.mutable_data();
    for (const Vec2& v : polygon)
    {
        *to++ = v.x();
        *to++ = v.y();
    }
    return array;
}
}  // namespace

py::array_t<double> positions(const Look& look)
{
    const Vec2& o = look.model.origin;
    return table<2>(look,
                    [&](Index i) {
                        return std::array{o.x() + look.state.blocks.motion[i].x, o.y() + look.state.blocks.motion[i].y};
                    });
}

py::array_t<double> rotations(const Look& look)
{
    return column<double>(look, [&](Index i) { return look.state.blocks.motion[i].angle; });
}

py::array_t<double> velocities(const Look& look)
{
    return table<2>(look, [&](Index i) { return std::array{look.state.blocks.motion[i].vx, look.state.blocks.motion[i].vy}; });
}

py::array_t<double> angular_velocities(const Look& look)
{
    return column<double>(look, [&](Index i) { return look.state.blocks.motion[i].w; });
}

py::array_t<double> displacements(const Look& look)
{
    return table<2>(look,
                    [&](Index i)
                    {
                        const Vec2 d = look.state.blocks.displacement(i);
                        return std::array{d.x(), d.y()};
                    });
}

py::array_t<double> turns(const Look& look)
{
    const Blocks& blocks = look.state.blocks;
    return column<double>(look, [&](Index i) { return blocks.motion[i].angle - blocks.reference_angle[i]; });
}

py::array_t<double> forces(const Look& look)
{
    return table<2>(look, [&](Index i) { return std::array{look.state.blocks.force[i].x, look.state.blocks.force[i].y}; });
}

py::array_t<double> moments_on_blocks(const Look& look)
{
    return column<double>(look, [&](Index i) { return look.state.blocks.force[i].moment; });
}

py::array_t<double> stresses(const Look& look)
{
    const std::vector<MeanStress> stress = mean_stresses(look.model, look.state);
    return table<3>(look,
                    [&](Index i)
                    {
                        const MeanStress& s = stress[static_cast<std::size_t>(i)];
                        return std::array{s.xx, s.yy, s.xy};
                    });
}

py::array_t<double> areas(const Look& look)
{
    return column<double>(look, [&](Index i) { return look.model.area[i]; });
}

py::array_t<double> masses(const Look& look)
{
    return column<double>(look, [&](Index i) { return look.model.mass[i]; });
}

py::array_t<double> inertias(const Look& look)
{
    return column<double>(look, [&](Index i) { return look.model.inertia[i]; });
}

py::array_t<std::int32_t> materials(const Look& look)
{
    return column<std::int32_t>(look, [&](Index i) { return look.model.material[i]; });
}

py::array_t<bool> present(const Look& look)
{
    return column<bool>(look, [&](Index i) { return look.state.blocks.present[i] != 0; });
}

py::array_t<bool> fixed(const Look& look)
{
    return column<bool>(look, [&](Index i) { return !look.state.blocks.is_free(i); });
}

py::array_t<bool> walls(const Look& look)
{
    return column<bool>(look, [&](Index i) { return look.model.is_wall(i); });
}

std::vector<std::string> names(const Look& look)
{
    std::vector<std::string> texts;
    for (const Index slot : look.model.slot_of_user)
        texts.push_back(look.model.name[slot]);
    return texts;
}

py::list polygons(const Look& look)
{
    py::list list;
    for (const Index slot : look.model.slot_of_user)
        list.append(array_of(outline_of(look.model, slot, look.state.blocks.motion[slot])));
    return list;
}

py::list parts(const Look& look)
{
    py::list list;
    for (const Index slot : look.model.slot_of_user)
    {
        py::list of_block;
        for (const Polygon& part : parts_of(look.model, slot, look.state.blocks.motion[slot]))
            of_block.append(array_of(part));
        list.append(std::move(of_block));
    }
    return list;
}
}  // namespace hdem
