#pragma once
/// Numbers of all blocks as numpy arrays, copies in the user's order: row i is block i of the case, whatever has been removed or sorted in memory.

#include "core/model/model.h"
#include "core/state/state.h"

#include <pybind11/numpy.h>

#include <string>
#include <vector>

namespace hdem
{
using DoubleArray = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// A model and its state, or the first one of a case.
struct Look
{
    const Model& model;
    const State& state;
};

[[nodiscard]] pybind11::array_t<double> positions(const Look& look);
[[nodiscard]] pybind11::array_t<double> rotations(const Look& look);
[[nodiscard]] pybind11::array_t<double> velocities(const Look& look);
[[nodiscard]] pybind11::array_t<double> angular_velocities(const Look& look);
[[nodiscard]] pybind11::array_t<double> displacements(const Look& look);
[[nodiscard]] pybind11::array_t<double> turns(const Look& look);
[[nodiscard]] pybind11::array_t<double> forces(const Look& look);
[[nodiscard]] pybind11::array_t<double> moments_on_blocks(const Look& look);
[[nodiscard]] pybind11::array_t<double> stresses(const Look& look);
[[nodiscard]] pybind11::array_t<double> areas(const Look& look);
[[nodiscard]] pybind11::array_t<double> masses(const Look& look);
[[nodiscard]] pybind11::array_t<double> inertias(const Look& look);
[[nodiscard]] pybind11::array_t<std::int32_t> materials(const Look& look);
[[nodiscard]] pybind11::array_t<bool> present(const Look& look);
[[nodiscard]] pybind11::array_t<bool> fixed(const Look& look);
[[nodiscard]] pybind11::array_t<bool> walls(const Look& look);
[[nodiscard]] std::vector<std::string> names(const Look& look);
[[nodiscard]] pybind11::list polygons(const Look& look);
[[nodiscard]] pybind11::list parts(const Look& look);

/// Names of what both a case and a run have of blocks.
template <class Class, class Of>
void bind_blocks(Class& type, const Of& of)
{
    const auto property = [&](const char* name, auto function, const char* text)
    {
        type.def_property_readonly(
            name, [of, function](const typename Class::type& self) { return function(of(self)); }, text);
    };
    property("names", names, "Name of each block, list of n texts. Row i of every array is block i: its number never changes.");
    property("areas", areas, "Area of each block, (n,) [m2], copy. 0 < area.");
    property("masses", masses, "Mass of each block per metre of thickness, (n,) [kg], copy. 0 for walls of [[boundary]].");
    property("inertias", inertias, "Moment of inertia about the centroid per metre of thickness, (n,) [kg m2], copy.");
    property("materials", materials, "Material of each block, (n,) int32, position in material_names, copy.");
    property("fixed", fixed, "Which blocks no force can move, (n,) bool, copy; removed ones count as fixed.");
    property("walls", walls, "Which blocks are walls of [[boundary]] and no rock, (n,) bool, copy. They come last.");
    property("polygons", polygons,
             "Outline of each block where it is now, list of n arrays (k, 2) [m], anticlockwise, copies. Of a block with a "
             "hole it is the outer one.");
    property("parts", parts, "Convex parts of each block where it is now, list of n lists of arrays (k, 2) [m], copies.");
    property("positions", positions, "Centroid of each block, (n, 2) [m], copy.");
    type.def_property_readonly(
        "material_names", [of](const typename Class::type& self) { return of(self).model.material_names; },
        "Of [material.NAME], list of texts.");
    type.def_property_readonly(
        "joint_names", [of](const typename Class::type& self) { return of(self).model.joints.names; },
        "Of [joint.NAME], list of texts.");
}
}  // namespace hdem
