#include "io/frame_writer.h"
#include "io/summary.h"
#include "io/vtkhdf.h"

namespace hdem
{
void write_liner_frame(const std::filesystem::path& name, const Model& model, const State& state)
{
    struct Shown
    {
        std::size_t liner;
        LinerPiece piece;
    };
    std::vector<Shown> shown;
    VtkCells cells{.type = CellType::line, .points = {}};
    std::vector<std::string> names;
    for (const LinerSummary& liner : summarise_liners(model, state))
    {
        for (const LinerPiece& piece : liner.segments)
        {
            shown.push_back({.liner = names.size(), .piece = piece});
            cells.add_point(piece.from);
            cells.add_point(piece.to);
            cells.end_cell();
        }
        names.push_back(liner.name);
    }
    const std::size_t n = shown.size();

    Hdf5Writer file(name);
    write_vtk_grid(file, cells, state);
    write_cell_data<std::int32_t>(file, "liner", n, [&](std::size_t i) { return shown[i].liner; });
    write_cell_data<float>(file, "thrust", n, [&](std::size_t i) { return shown[i].piece.thrust; });
    write_cell_data<float>(file, "shear", n, [&](std::size_t i) { return shown[i].piece.shear; });
    write_cell_data<float>(file, "moment_from", n, [&](std::size_t i) { return shown[i].piece.moment[0]; });
    write_cell_data<float>(file, "moment_to", n, [&](std::size_t i) { return shown[i].piece.moment[1]; });
    write_frame_header(file, "hdem-liners", model, state);
    file.write_texts("/hdem/liner_names", names);
    file.commit({}, Flush::later);
}
}  // namespace hdem
