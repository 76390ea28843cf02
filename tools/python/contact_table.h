#pragma once
/// Contact points as one structured numpy array.

#include "tools/python/block_arrays.h"

namespace hdem
{
/// A point of a contact. The names are those of the array's fields; the text for users stands in run_binding.cpp.
struct ContactRow
{
    std::int32_t blocks[2];
    std::int32_t joint;
    std::uint8_t end;
    std::uint8_t regime;
    double point[2];
    double normal[2];
    double length;
    double normal_force;
    double shear_force;
    double tilt_force;
    double gap;
    double closure;
    double slip;
    double plastic_slip;
    double broken;
};

/// @param also_open  points of faces near each other that do not touch count too
[[nodiscard]] pybind11::array_t<ContactRow> contact_table(const Look& look, bool also_open);
}  // namespace hdem
