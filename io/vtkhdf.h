#pragma once
/// The part of VTKHDF 1.0 that ParaView 5.11 and later read by double click: one unstructured grid of polygons or lines.

#include "core/model/model.h"
#include "core/state/state.h"
#include "io/hdf5_writer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hdem
{
enum class CellType : std::uint8_t
{
    line = 3,
    polygon = 7
};

/// Cells of one kind, each with vertices of its own.
struct VtkCells
{
    CellType type = CellType::polygon;
    std::vector<double> points;               ///< x, y, 0 [m]
    std::vector<std::int64_t> offsets = {0};  ///< one more than cells: where each one's vertices begin

    void add_point(const Vec2& p) { points.insert(points.end(), {p.x(), p.y(), 0.0}); }
    void end_cell() { offsets.push_back(static_cast<std::int64_t>(points.size() / 3)); }
    [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
};

/// /VTKHDF without CellData, with cycle and time as field data.
void write_vtk_grid(Hdf5Writer& file, const VtkCells& cells, const State& state);

/// One dataset of /VTKHDF/CellData: `value(i)` for each of n cells.
template <class T, class Value>
void write_cell_data(Hdf5Writer& file, const std::string& name, std::size_t n, const Value& value)
{
    std::vector<T> values(n);
    for (std::size_t i = 0; i < n; ++i)
        values[i] = static_cast<T>(value(i));
    file.write("/VTKHDF/CellData/" + name, values, {n});
}

/// The same with a vector in the plane, written as x, y, 0.
template <class Value>
void write_cell_vectors(Hdf5Writer& file, const std::string& name, std::size_t n, const Value& value)
{
    std::vector<float> values;
    values.reserve(3 * n);
    for (std::size_t i = 0; i < n; ++i)
    {
        const Vec2 v = value(i);
        values.insert(values.end(), {static_cast<float>(v.x()), static_cast<float>(v.y()), 0.0f});
    }
    file.write("/VTKHDF/CellData/" + name, values, {n, 3});
}

/// Group /hdem with what both kinds of frames say about themselves.
void write_frame_header(Hdf5Writer& file, const std::string& filetype, const Model& model, const State& state);
}  // namespace hdem
