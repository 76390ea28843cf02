#include "io/vtkhdf.h"

#include "core/version.h"

#include <numeric>

namespace hdem
{
void write_vtk_grid(Hdf5Writer& file, const VtkCells& cells, const State& state)
{
    const auto points = static_cast<std::int64_t>(cells.points.size() / 3);
    std::vector<std::int64_t> connectivity(static_cast<std::size_t>(points));
    std::iota(connectivity.begin(), connectivity.end(), 0);

    file.make_group("/VTKHDF");
    file.make_group("/VTKHDF/CellData");
    file.set_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
    file.set_text("/VTKHDF", "Type", "UnstructuredGrid", Hdf5Writer::TextCode::ascii);  // ParaView 5.11 reads fixed length only
    file.write("/VTKHDF/NumberOfPoints", std::vector<std::int64_t>{points});
    file.write("/VTKHDF/NumberOfCells", std::vector<std::int64_t>{static_cast<std::int64_t>(cells.size())});
    file.write("/VTKHDF/NumberOfConnectivityIds", std::vector<std::int64_t>{points});
    file.write("/VTKHDF/Points", cells.points, {static_cast<std::uint64_t>(points), 3});
    file.write("/VTKHDF/Connectivity", connectivity);
    file.write("/VTKHDF/Offsets", cells.offsets);
    file.write("/VTKHDF/Types", std::vector<std::uint8_t>(cells.size(), static_cast<std::uint8_t>(cells.type)));
    file.write("/VTKHDF/FieldData/TIME", std::vector<double>{state.time});
    file.write("/VTKHDF/FieldData/CYCLE", std::vector<std::int64_t>{state.cycle});
}

void write_frame_header(Hdf5Writer& file, const std::string& filetype, const Model& model, const State& state)
{
    file.make_group("/hdem");
    file.set_text("/hdem", "filetype", filetype);
    file.set_attribute("/hdem", "version", std::vector<std::int64_t>{1, 3});
    file.set_text("/hdem", "hdem_version", version().number);
    file.set_text("/hdem", "git_commit", version().commit);
    file.set_text("/hdem", "title", model.title);
    const auto stage = static_cast<std::size_t>(state.stage);
    file.set_text("/hdem", "stage", stage < model.stages.size() ? model.stages[stage].name : "");
    file.set_attribute("/hdem", "stage_begin_cycle", state.stage_begin_cycle);
    file.set_attribute("/hdem", "cycle", state.cycle);
    file.set_attribute("/hdem", "time", state.time);
    file.set_attribute("/hdem", "time_step", model.time_step);
}
}  // namespace hdem
