#include "core/contact/contact_report.h"
#include "core/water/wet_faces.h"
#include "io/contact_slip.h"
#include "io/frame_writer.h"
#include "io/vtkhdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
/// What joint laws with a memory remember, the mean of both points.
void write_memories(Hdf5Writer& file, const Model& model, const State& state, const std::vector<Index>& numbers,
                    const std::vector<ContactReport>& contacts)
{
    const std::size_t n = contacts.size();
    const auto mean = [&](double JointMemory::*field)
    { return [&contacts, field](std::size_t i) { return 0.5 * (contacts[i].memory[0].*field + contacts[i].memory[1].*field); }; };
    const auto mean_of = [&](double (*share)(const JointTable&, Index, const JointMemory&))
    {
        return [&, share](std::size_t i)
        {
            const Index law = state.contacts.law[numbers[i]];
            return 0.5 * (share(model.joints, law, contacts[i].memory[0]) + share(model.joints, law, contacts[i].memory[1]));
        };
    };
    write_cell_data<float>(file, "plastic_slip", n, mean(&JointMemory::slip));
    write_cell_data<float>(file, "opening", n, mean(&JointMemory::opening));
    write_cell_data<float>(file, "broken", n, mean_of(broken_share));
    write_cell_data<float>(file, "damage", n, mean_of(damage_share));
}
}  // namespace

void write_contact_frame(const std::filesystem::path& name, const Model& model, const State& state)
{
    std::vector<ContactReport> contacts;
    std::vector<Index> numbers;
    VtkCells cells{.type = CellType::line, .points = {}};
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        if (!is_closed_contact(state, i))
            continue;
        contacts.push_back(report_contact(state, i));
        numbers.push_back(i);
        cells.add_point(model.origin + contacts.back().point[0]);
        cells.add_point(model.origin + contacts.back().point[1]);
        cells.end_cell();
    }
    const std::size_t n = contacts.size();
    const auto normal_stress = [&](std::size_t i) { return contacts[i].normal_force / contacts[i].bearing_length; };
    const auto shear_stress = [&](std::size_t i) { return contacts[i].shear_force / contacts[i].bearing_length; };

    Hdf5Writer file(name);
    write_vtk_grid(file, cells, state);
    std::vector<std::int32_t> blocks;
    for (const ContactReport& contact : contacts)
        blocks.insert(blocks.end(), {model.user_number[contact.first], model.user_number[contact.second]});
    file.write("/VTKHDF/CellData/blocks", blocks, {n, 2});
    write_cell_vectors(file, "normal", n, [&](std::size_t i) { return contacts[i].normal; });
    write_cell_data<float>(file, "length", n, [&](std::size_t i) { return contacts[i].length; });
    write_cell_data<float>(file, "overlap", n, [&](std::size_t i) { return contacts[i].overlap; });
    write_cell_data<float>(file, "normal_force", n, [&](std::size_t i) { return contacts[i].normal_force; });
    write_cell_data<float>(file, "shear_force", n, [&](std::size_t i) { return contacts[i].shear_force; });
    write_cell_data<float>(file, "tilt_force", n, [&](std::size_t i) { return contacts[i].tilt_force; });
    write_cell_data<float>(file, "normal_stress", n, normal_stress);
    write_cell_data<float>(file, "shear_stress", n, shear_stress);
    write_cell_data<float>(file, "traction", n, [&](std::size_t i) { return std::hypot(normal_stress(i), shear_stress(i)); });
    write_cell_data<float>(file, "slip", n, [&](std::size_t i) { return slip_of(state.blocks, contacts[i]); });
    write_cell_data<std::uint8_t>(file, "regime", n, [&](std::size_t i) { return contacts[i].regime; });
    const auto mobilised = [&](std::size_t i)
    { return std::atan2(std::abs(contacts[i].shear_force), std::max(contacts[i].normal_force, 0.0)) * 180.0 / std::numbers::pi; };
    write_cell_data<float>(file, "mobilised_friction", n, mobilised);
    if (model.water.given)
    {
        const JointPressure water(model, state);
        write_cell_data<float>(file, "pore_pressure", n,
                               [&](std::size_t i) { return water.mean(numbers[i], contacts[i].point[0], contacts[i].point[1]); });
    }
    if (model.joints.has_memory())
        write_memories(file, model, state, numbers, contacts);
    write_frame_header(file, "hdem-contacts", model, state);
    file.commit({}, Flush::later);
}
}  // namespace hdem
