#include "io/frame_writer.h"
#include "io/summary.h"
#include "io/vtkhdf.h"

namespace hdem
{
void write_bolt_frame(const std::filesystem::path& name, const Model& model, const State& state)
{
    const std::vector<BoltSummary> all = summarise_bolts(model, state);
    std::vector<std::size_t> shown;
    VtkCells cells{.type = CellType::line, .points = {}};
    std::vector<std::string> names;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        names.push_back(all[i].name);
        if (state.support.bolts[i].status == BoltStatus::planned)
            continue;
        shown.push_back(i);
        cells.add_point(all[i].from);
        cells.add_point(all[i].to);
        cells.end_cell();
    }
    const std::size_t n = shown.size();
    const auto value = [&](double BoltSummary::*field) { return [&, field](std::size_t i) { return all[shown[i]].*field; }; };

    Hdf5Writer file(name);
    write_vtk_grid(file, cells, state);
    write_cell_data<std::int32_t>(file, "bolt", n, [&](std::size_t i) { return shown[i]; });
    write_cell_data<float>(file, "axial_force", n, value(&BoltSummary::axial_force));
    write_cell_data<float>(file, "across_force", n, value(&BoltSummary::across_force));
    write_cell_data<float>(file, "greatest_force", n, value(&BoltSummary::greatest_force));
    write_cell_data<float>(file, "elongation", n, value(&BoltSummary::elongation));
    write_cell_data<std::uint8_t>(file, "status", n, [&](std::size_t i) { return state.support.bolts[shown[i]].status; });
    write_frame_header(file, "hdem-bolts", model, state);
    file.write_texts("/hdem/bolt_names", names);
    file.commit({}, Flush::later);
}
}  // namespace hdem
