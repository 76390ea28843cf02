#include "tools/python/contact_table.h"

#include "core/contact/contact_report.h"
#include "core/detection/edge_touch.h"
#include "io/contact_slip.h"

#include <algorithm>

namespace hdem
{
namespace
{
namespace py = pybind11;

/// Number of [joint.NAME] for each law; -1 for walls.
std::vector<std::int32_t> named_joints(const JointTable& table)
{
    std::vector<std::int32_t> named(table.laws.size(), -1);
    for (std::size_t law = 0; law < table.names.size(); ++law)
    {
        named[law] = static_cast<std::int32_t>(law);
        named[static_cast<std::size_t>(table.unbonded_of(static_cast<Index>(law)))] = static_cast<std::int32_t>(law);
    }
    if (table.of_walls != no_index)
        named[static_cast<std::size_t>(table.of_walls)] = -1;
    return named;
}

/// Both blocks are there, and what touches may be asked.
bool is_near(const State& state, Index contact)
{
    return state.contacts.ref_edge[contact] != no_index && state.blocks.present[state.contacts.ref[contact]] != 0 &&
           state.blocks.present[state.contacts.inc[contact]] != 0;
}

class Table
{
  public:
    Table(const Look& look, bool also_open) : look_(look), also_open_(also_open), joint_(named_joints(look.model.joints)) {}

    std::vector<ContactRow> rows()
    {
        for (Index i = 0; i < look_.state.contacts.size(); ++i)
            if (is_near(look_.state, i))
                add(i);
        const auto key = [](const ContactRow& row) { return std::array{row.blocks[0], row.blocks[1]}; };
        std::ranges::stable_sort(rows_, {}, key);
        return std::move(rows_);
    }

  private:
    void add(Index i)
    {
        const Contacts& contacts = look_.state.contacts;
        if (!also_open_ && contacts.regime[0][i] == 0 && contacts.regime[1][i] == 0)
            return;
        const auto& motion = look_.state.blocks.motion;
        const EdgeTouch touch = touch_edges(contacts.edges(i), motion[contacts.ref[i]], motion[contacts.inc[i]]);
        if (touch.length <= 0.0 && contacts.regime[0][i] == 0 && contacts.regime[1][i] == 0)
            return;  // the faces lie beside each other
        const ContactReport report = report_contact(look_.state, i);
        const Contact contact = contacts.get(i);
        for (int k = 0; k < 2; ++k)
            if (also_open_ || contacts.regime[k][i] != 0)
                add_point(i, k, report, contact.point[static_cast<std::size_t>(k)], touch.point[k].overlap);
    }

    void add_point(Index i, int k, const ContactReport& report, const PointHistory& history, double overlap)
    {
        const Model& model = look_.model;
        const Contacts& contacts = look_.state.contacts;
        const Index law = contacts.law[i];
        const Vec2 at = model.origin + report.point[static_cast<std::size_t>(k)];
        const JointMemory& memory = history.memory;
        rows_.push_back({.blocks = {model.user_number[report.first], model.user_number[report.second]},
                         .joint = joint_[static_cast<std::size_t>(law)],
                         .end = static_cast<std::uint8_t>(k),
                         .regime = static_cast<std::uint8_t>(history.regime),
                         .point = {at.x(), at.y()},
                         .normal = {report.normal.x(), report.normal.y()},
                         .length = 0.5 * report.bearing_length,
                         .normal_force = history.normal_force,
                         .shear_force = history.shear_force,
                         .tilt_force = contacts.tilt_force(k, i),
                         .gap = -overlap,
                         .closure = history.overlap - history.rest_overlap,
                         .slip = slip_of(look_.state.blocks, report),
                         .plastic_slip = memory.slip,
                         .broken = broken_share(model.joints, law, memory)});
    }

    const Look& look_;
    bool also_open_;
    std::vector<std::int32_t> joint_;
    std::vector<ContactRow> rows_;
};
}  // namespace

py::array_t<ContactRow> contact_table(const Look& look, bool also_open)
{
    const std::vector<ContactRow> rows = Table(look, also_open).rows();
    py::array_t<ContactRow> array(static_cast<py::ssize_t>(rows.size()));
    std::ranges::copy(rows, array.mutable_data());
    return array;
}
}  // namespace hdem
