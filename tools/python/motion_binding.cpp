#include "tools/python/motion_binding.h"

#include "core/geometry/unit_direction.h"
#include "tools/python/block_arrays.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
namespace py = pybind11;

constexpr double greatest_place = 1e8;   // [m], as in case files
constexpr double greatest_other = 1e12;  // angles [rad] and velocities, in SI units

/// Rows of an array of the users, checked: `width` numbers a block, all finite.
const double* rows_of(const DoubleArray& array, const Model& model, py::ssize_t width, double greatest, const char* name)
{
    const bool is_right = width == 1 ? array.ndim() == 1 && array.shape(0) == model.blocks()
                                     : array.ndim() == 2 && array.shape(0) == model.blocks() && array.shape(1) == width;
    if (!is_right)
        throw py::value_error(
            fmt::format("{}: an array of shape {} is needed, one row a block", name,
                        width == 1 ? fmt::format("({},)", model.blocks()) : fmt::format("({}, {})", model.blocks(), width)));
    const double* const values = array.data();
    for (py::ssize_t i = 0; i < array.size(); ++i)
        if (!(std::abs(values[i]) <= greatest))
        {
            const std::string& block = model.name[model.slot_of_user[i / width]];
            throw py::value_error(std::isfinite(values[i])
                                      ? fmt::format("{}: the number of block \"{}\" is {:g}, and may be {:g} at most", name, block,
                                                    values[i], greatest)
                                      : fmt::format("{}: the number of block \"{}\" is not finite", name, block));
        }
    return values;
}

/// A block that somebody else moves, or nobody, is not moved by an array.
void require_free(const DrivenRun& run, Index slot, double inverse, const char* name)
{
    const Simulation& now = run.simulation();
    if (now.state().blocks.present[slot] != 0 && inverse > 0.0)
        return;
    throw py::value_error(
        fmt::format("{}: block \"{}\" is {} and keeps its row. Give it the number it has, or let a stage free it.", name,
                    now.model().name[slot], now.state().blocks.present[slot] == 0 ? "removed" : "fixed"));
}

struct Column
{
    double BlockMotion::*value;
    double BlockInertia::*inverse;
    double origin = 0.0;
};

/// Writes what differs from the present numbers: those of other blocks keep their bits.
void write_columns(DrivenRun& run, const DoubleArray& array, const std::vector<Column>& columns, const char* name)
{
    const Simulation& now = run.simulation();
    const double* const values = rows_of(array, now.model(), static_cast<py::ssize_t>(columns.size()),
                                         columns.front().value == &BlockMotion::x ? greatest_place : greatest_other, name);
    struct Change
    {
        Index slot;
        double BlockMotion::*value;
        double number;
    };
    std::vector<Change> changes;
    const double* value = values;
    for (const Index slot : now.model().slot_of_user)
        for (const Column& column : columns)
        {
            const double given = *value++;
            if (given == column.origin + now.state().blocks.motion[slot].*column.value)
                continue;
            require_free(run, slot, now.state().blocks.inertia[slot].*column.inverse, name);
            changes.push_back({slot, column.value, given - column.origin});
        }
    if (changes.empty())
        return;
    run.change_motion(
        [&](std::vector<BlockMotion>& motion)
        {
            for (const Change& change : changes)
            {
                BlockMotion& block = motion[change.slot];
                block.*change.value = change.number;
                if (change.value != &BlockMotion::angle)
                    continue;
                const Vec2 direction = unit_direction(change.number * (180.0 / std::numbers::pi));
                block.c = direction.x();
                block.s = direction.y();
            }
        });
}

}  // namespace

void bind_motion(RunType& type)
{
    PYBIND11_NUMPY_DTYPE(BlockMotion, x, y, c, s, vx, vy, w, angle);
    PYBIND11_NUMPY_DTYPE(BlockForce, x, y, moment, reserve, mobilised, t_x, t_y, contacts);
    const auto look = [](const auto& function) { return [function](const DrivenRun& run) { return function(run.look()); }; };
    type.def_property(
        "positions", look(positions),
        [](DrivenRun& run, const DoubleArray& array)
        {
            const Vec2 o = run.simulation().model().origin;
            write_columns(
                run, array,
                {{&BlockMotion::x, &BlockInertia::inverse_mass_x, o.x()}, {&BlockMotion::y, &BlockInertia::inverse_mass_y, o.y()}},
                "positions");
        },
        "Centroid of each block, (n, 2) [m]. Reading gives a copy. Assigning puts blocks there: contacts are found "
        "anew, the energy is booked as load_work. Rows of fixed and removed blocks must stay as they are.");
    type.def_property(
        "velocities", look(velocities),
        [](DrivenRun& run, const DoubleArray& array)
        {
            write_columns(run, array,
                          {{&BlockMotion::vx, &BlockInertia::inverse_mass_x}, {&BlockMotion::vy, &BlockInertia::inverse_mass_y}},
                          "velocities");
        },
        "Velocity of each block's centroid, half a step before the positions, (n, 2) [m/s]. Copy; assigning as positions.");
    type.def_property(
        "rotations", look(rotations),
        [](DrivenRun& run, const DoubleArray& array) {
            write_columns(run, array, {{&BlockMotion::angle, &BlockInertia::inverse_inertia}}, "rotations");
        },
        "Rotation of each block since the run began, anticlockwise, not wrapped, (n,) [rad]. Copy; assigning as positions.");
    type.def_property(
        "angular_velocities", look(angular_velocities),
        [](DrivenRun& run, const DoubleArray& array) {
            write_columns(run, array, {{&BlockMotion::w, &BlockInertia::inverse_inertia}}, "angular_velocities");
        },
        "Angular velocity of each block, anticlockwise, (n,) [rad/s]. Copy; assigning as positions.");
    type.def_property_readonly("displacements", look(displacements),
                               "Way of each block's centroid since its stage began, (n, 2) [m], copy.");
    type.def_property_readonly("turns", look(turns), "Rotation of each block since its stage began, (n,) [rad], copy.");
    type.def_property_readonly(
        "forces", look(forces),
        "Sum of what acted on each block in the last cycle, its weight too, (n, 2) [N] per metre of thickness, copy. A "
        "result: to push a block assign applied_forces, or give the case a [[load]].");
    type.def_property_readonly("moments", look(moments_on_blocks), "Likewise about the centroid, (n,) [N m], copy.");
    type.def_property_readonly("stresses", look(stresses),
                               "Mean stress of each block from its contacts and the tractions on its sides, compression positive, "
                               "(n, 3) [Pa]: xx, yy, xy; copy.");
    type.def_property_readonly("present", look(present), "Which blocks have not been removed by a stage, (n,) bool, copy.");
    type.def_property_readonly(
        "slots",
        [](const DrivenRun& run)
        {
            const std::vector<Index>& slots = run.simulation().model().slot_of_user;
            return py::array_t<Index>(static_cast<py::ssize_t>(slots.size()), slots.data());
        },
        "Where each block stands in the views, (n,) int32, copy: view[slots] is in the order of the blocks.");
    type.def_property_readonly(
        "motion_view", [](DrivenRun& run) { return run.view(run.simulation().state().blocks.motion); },
        "The run's own memory, read only, (n,) with fields x, y [m] from origin, c, s (cosine and sine of the "
        "rotation), vx, vy [m/s], w [rad/s], angle [rad]; in the order of memory, see slots. No copy. While such a "
        "view lives run() and assignments are refused with BufferError, as cycles may sort blocks into other memory.");
    type.def_property_readonly(
        "force_view", [](DrivenRun& run) { return run.view(run.simulation().state().blocks.force); },
        "Likewise forces of the last cycle: x, y [N], moment [N m], reserve [N] (shear strength not in use at its "
        "contacts), mobilised (greatest share in use, -1: no contact), t_x, t_y (direction of that joint), contacts "
        "(bits: 1 force, 2 impulse).");
    type.def_property_readonly(
        "origin",
        [](const DrivenRun& run)
        {
            const Vec2 o = run.simulation().model().origin;
            return std::pair(o.x(), o.y());
        },
        "Of the coordinates in motion_view [m].");
}
}  // namespace hdem
