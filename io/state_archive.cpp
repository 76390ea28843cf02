#include "io/state_archive.h"

#include "core/check.h"
#include "core/model/block_order.h"
#include "io/state_checks.h"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

namespace hdem
{
namespace
{
// What is saved stands once, in exchange(); Saver and Loader are its two directions. A table has a row for each item; `members` gives the
// numbers of a row as a tuple of references.

template <typename Item, typename Members>
constexpr std::uint64_t columns_of = std::tuple_size_v<std::invoke_result_t<Members, Item&>>;

template <typename Item, typename Members>
Shape table_shape(std::uint64_t rows)
{
    return columns_of<Item, Members> > 1 ? Shape{rows, columns_of<Item, Members>} : Shape{rows};
}

class Saver
{
  public:
    explicit Saver(Hdf5Writer& file) : file_(file) {}

    void group(const std::string& path) { file_.make_group(path); }

    template <typename Stored, typename T>
    void value(const std::string& object, const std::string& name, T& from)
    {
        file_.set_attribute(object, name, static_cast<Stored>(from));
    }

    template <typename Stored, typename Item, typename Members>
    void rows(const std::string& path, std::uint64_t /*expected*/, std::vector<Item>& items, const Members& members)
    {
        std::vector<Stored> values;
        values.reserve(items.size() * columns_of<Item, Members>);
        for (Item& item : items)
            std::apply([&](auto&... member) { (values.push_back(static_cast<Stored>(member)), ...); }, members(item));
        file_.write(path, values, table_shape<Item, Members>(items.size()), Hdf5Writer::Packing::plain);
    }

  private:
    Hdf5Writer& file_;
};

class Loader
{
  public:
    explicit Loader(const Hdf5Reader& file) : file_(file) {}

    void group(const std::string& /*path*/) {}

    template <typename Stored, typename T>
    void value(const std::string& object, const std::string& name, T& to)
    {
        to = static_cast<T>(file_.attribute<Stored>(object, name, {}).front());
    }

    /// @param expected rows; any_extent: as many as there are
    template <typename Stored, typename Item, typename Members>
    void rows(const std::string& path, std::uint64_t expected, std::vector<Item>& items, const Members& members)
    {
        const std::vector<Stored> values = file_.read<Stored>(path, table_shape<Item, Members>(expected));
        items.resize(values.size() / columns_of<Item, Members>);
        auto at = values.begin();
        const auto take = [&](auto& member) { member = static_cast<std::remove_reference_t<decltype(member)>>(*at++); };
        for (Item& item : items)
            std::apply([&](auto&... member) { (take(member), ...); }, members(item));
    }

  private:
    const Hdf5Reader& file_;
};

constexpr auto itself = [](auto& value) { return std::tie(value); };

/// What of a checkpoint's state is kept otherwise in the memory.
struct Unpacked
{
    std::vector<Index> user_number;
    std::vector<Contact> contacts;
    std::vector<std::uint8_t> stale;  ///< per contact
};

template <typename Archive>
void exchange_run(Archive& archive, State& state)
{
    archive.group("/state");
    archive.template value<std::int64_t>("/state", "cycle", state.cycle);
    archive.template value<double>("/state", "time", state.time);
    archive.template value<double>("/state", "last_step", state.blocks.step.last);
    archive.template value<double>("/state", "next_step", state.blocks.step.next);
    archive.template value<std::int32_t>("/state", "stage", state.stage);
    archive.template value<std::uint8_t>("/state", "stage_begun", state.stage_begun);
    archive.template value<std::int64_t>("/state", "stage_begin_cycle", state.stage_begin_cycle);
    archive.template value<double>("/state", "default_step", state.default_step);
    archive.template value<double>("/state", "worst_residual", state.worst_residual.residual);
    archive.template value<double>("/state", "worst_residual_share", state.worst_residual.share);
    archive.template value<std::int64_t>("/state", "worst_residual_cycle", state.worst_residual.cycle);
    archive.template value<double>("/state", "quiet_since", state.quiet_since);
    archive.template value<std::uint8_t>("/state", "method", state.method);
    archive.template value<std::uint8_t>("/state", "damping", state.damping);
    archive.template value<std::int64_t>("/state", "excavation_cycle", state.excavation_cycle);
    archive.template value<std::int64_t>("/state", "broad_phase_runs", state.broad_phase_runs);
    archive.template value<std::int64_t>("/state", "feature_searches", state.feature_searches);
    archive.template value<std::uint8_t>("/state", "contacts_outdated", state.contacts_outdated);
    archive.template value<std::uint8_t>("/state", "rest_changed", state.rest_changed);
    archive.template value<std::uint8_t>("/state", "flies_ahead", state.flies_ahead);
    archive.template value<std::uint8_t>("/state", "is_calm", state.is_calm);
    archive.template value<std::uint8_t>("/state", "statics_due", state.statics_due);
    archive.template value<std::uint8_t>("/state", "statics_taken", state.statics_taken);
    archive.template rows<std::int64_t>("/state/stages_done", any_extent, state.stages_done,
                                        [](StageOutcome& s) { return std::tie(s.cycles, s.at_rest, s.ended_by); });
    archive.template rows<double>("/state/stages_ended", state.stages_done.size(), state.stages_done,
                                  [](StageOutcome& s) { return std::tie(s.value, s.time); });
    archive.template rows<std::int64_t>("/state/ends", any_extent, state.ends,
                                        [](EndWatch& w) { return std::tie(w.since_cycle, w.joints); });
    archive.template rows<double>("/state/ends_values", state.ends.size(), state.ends,
                                  [](EndWatch& w) { return std::tie(w.since_time, w.low, w.high, w.axis_x, w.axis_y); });
    const auto block_of_stage = [](StageBlock& b) { return std::tie(b.stage, b.block); };
    archive.template rows<std::int32_t>("/state/not_at_rest", any_extent, state.not_at_rest, block_of_stage);
    archive.template rows<std::int32_t>("/state/statics", any_extent, state.statics,
                                        [](StaticSolution& s) { return std::tie(s.stage, s.end, s.iterations); });
    archive.template rows<double>("/state/statics_residual", state.statics.size(), state.statics,
                                  [](StaticSolution& s) { return std::tie(s.residual); });
    archive.template rows<std::int32_t>("/state/came_loose", any_extent, state.came_loose, block_of_stage);
    archive.group("/state/ledger");
    for (const LedgerTerm& term : ledger_terms)
        archive.template value<double>("/state/ledger", term.name, state.ledger.*term.value);
}

template <typename Archive>
void exchange_blocks(Archive& archive, std::uint64_t n, State& state, Unpacked& unpacked)
{
    Blocks& blocks = state.blocks;
    const auto motion = [](BlockMotion& m) { return std::tie(m.x, m.y, m.c, m.s, m.vx, m.vy, m.w, m.angle); };
    archive.template rows<std::int32_t>("/blocks/user_number", n, unpacked.user_number, itself);
    archive.template rows<double>("/blocks/motion", n, blocks.motion, motion);
    archive.template rows<double>("/blocks/rebuilt_at", any_extent, state.rebuilt_at, motion);
    archive.template rows<double>("/blocks/force", n, blocks.force,
                                  [](BlockForce& f) { return std::tie(f.x, f.y, f.moment, f.reserve); });
    archive.template rows<float>("/blocks/joint_use", n, blocks.force,
                                 [](BlockForce& f) { return std::tie(f.mobilised, f.t_x, f.t_y); });
    archive.template rows<std::uint8_t>("/blocks/contact_kinds", n, blocks.force,
                                        [](BlockForce& f) { return std::tie(f.contacts); });
    archive.template rows<double>("/blocks/inverse_inertia", n, blocks.inertia,
                                  [](BlockInertia& i) { return std::tie(i.inverse_mass_x, i.inverse_mass_y, i.inverse_inertia); });
    archive.template rows<double>("/blocks/stable_step", n, blocks.stable_step, itself);
    archive.template rows<double>("/blocks/margin", n, blocks.margin, itself);
    archive.template rows<std::uint8_t>("/blocks/rest", n, blocks.rest, itself);
    archive.template rows<std::uint8_t>("/blocks/present", n, blocks.present, itself);
    archive.template rows<double>("/blocks/reference_position", n, blocks.reference_position,
                                  [](Vec2& v) { return std::tie(v.x(), v.y()); });
    archive.template rows<double>("/blocks/reference_angle", n, blocks.reference_angle, itself);
    archive.template rows<std::int32_t>("/blocks/next_to_excavation", any_extent, state.next_to_excavation, itself);
    archive.template rows<std::int32_t>("/blocks/released", any_extent, state.released,
                                        [](ReleasedForce& f) { return std::tie(f.block); });
    archive.template rows<double>("/blocks/released_force", state.released.size(), state.released,
                                  [](ReleasedForce& f) { return std::tie(f.x, f.y, f.moment); });
    if (!state.water.empty())
        archive.template rows<double>("/blocks/water", n, state.water, [](Triple& f) { return std::tie(f.x, f.y, f.w); });
    if (state.support.bolts.empty() && state.support.liners.empty())
        return;
    archive.group("/bolts");
    const std::uint64_t bolts = state.support.bolts.size();
    archive.template rows<std::uint8_t>("/bolts/status", bolts, state.support.bolts,
                                        [](BoltRecord& b) { return std::tie(b.status); });
    archive.template rows<double>("/bolts/record", bolts, state.support.bolts,
                                  [](BoltRecord& b)
                                  { return std::tie(b.force, b.shear_force, b.greatest_force, b.elongation, b.stored, b.spent); });
    if (const std::uint64_t liners = state.support.liners.size(); liners > 0)
    {
        archive.group("/liners");
        archive.template rows<std::uint8_t>("/liners/installed", liners, state.support.liners,
                                            [](LinerRecord& l) { return std::tie(l.installed); });
        archive.template rows<std::int64_t>("/liners/counts", liners, state.support.liners,
                                            [](LinerRecord& l) { return std::tie(l.since, l.hinges); });
        archive.template rows<double>("/liners/record", liners, state.support.liners,
                                      [](LinerRecord& l)
                                      { return std::tie(l.thrust, l.moment, l.displacement, l.parted, l.stored, l.spent); });
    }
    archive.template rows<double>("/bolts/history", state.support.history.size(), state.support.history, itself);
}

template <typename Archive>
void exchange_contacts(Archive& archive, std::vector<Contact>& contacts, std::vector<std::uint8_t>& stale)
{
    archive.template rows<std::int32_t>("/contacts/features", any_extent, contacts,
                                        [](Contact& c)
                                        { return std::tie(c.part_a, c.part_b, c.ref, c.inc, c.ref_edge, c.inc_edge, c.law); });
    const std::uint64_t n = contacts.size();
    archive.template rows<std::uint8_t>("/contacts/swapped", n, contacts, [](Contact& c) { return std::tie(c.swapped); });
    archive.template rows<std::uint8_t>("/contacts/stale", n, stale, itself);
    archive.template rows<std::uint8_t>("/contacts/regime", n, contacts,
                                        [](Contact& c) { return std::tie(c.point[0].regime, c.point[1].regime); });
    archive.template rows<double>("/contacts/edges", n, contacts,
                                  [](Contact& c)
                                  {
                                      EdgePair& e = c.edges;
                                      return std::tie(e.tx, e.ty, e.start_t, e.start_m, e.length, e.p0x, e.p0y, e.p1x, e.p1y);
                                  });
    archive.template rows<float>("/contacts/seen", n, contacts,
                                 [](Contact& c) { return std::tie(c.moved_limit, c.seen[0], c.seen[1], c.seen[2], c.seen[3]); });
    archive.template rows<double>("/contacts/length", n, contacts,
                                  [](Contact& c) { return std::tie(c.length_floor, c.last_length); });
    for (const int k : {0, 1})
        archive.template rows<double>("/contacts/point_" + std::to_string(k), n, contacts,
                                      [k](Contact& c)
                                      {
                                          PointHistory& p = c.point[k];
                                          return std::tie(p.normal_force, p.shear_force, p.rest_overlap, p.overlap, p.tilt_force);
                                      });
}

template <typename Archive>
void exchange_preloads(Archive& archive, std::vector<Contact>& contacts)
{
    archive.template rows<double>("/contacts/preload", contacts.size(), contacts,
                                  [](Contact& c) { return std::tie(c.point[0].preload, c.point[1].preload); });
}

template <typename Archive>
void exchange_memories(Archive& archive, std::vector<Contact>& contacts)
{
    for (const int k : {0, 1})
        archive.template rows<double>("/contacts/memory_" + std::to_string(k), contacts.size(), contacts,
                                      [k](Contact& c)
                                      {
                                          PointHistory& p = c.point[k];
                                          JointMemory& m = p.memory;
                                          return std::tie(m.slip, m.state, m.turn, m.opening, m.broken, p.energy, p.stiffness);
                                      });
}

template <typename Archive>
void exchange(Archive& archive, Index blocks, State& state, Unpacked& unpacked)
{
    exchange_run(archive, state);
    exchange_blocks(archive, static_cast<std::uint64_t>(blocks), state, unpacked);
    exchange_contacts(archive, unpacked.contacts, unpacked.stale);
    if (state.contacts.has_preload)
        exchange_preloads(archive, unpacked.contacts);
    if (state.contacts.has_memory)
        exchange_memories(archive, unpacked.contacts);
}
}  // namespace

void save_state(const Model& model, const State& state, Hdf5Writer& file)
{
    Unpacked unpacked{.user_number = model.user_number, .contacts = {}, .stale = {}};
    const Contacts& contacts = state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
        unpacked.contacts.push_back(contacts.get(i));
    unpacked.stale.assign(contacts.stale.begin(), contacts.stale.begin() + contacts.size());
    Saver saver(file);
    exchange(saver, model.blocks(), const_cast<State&>(state), unpacked);  // a Saver changes nothing
}

State load_state(const Hdf5Reader& file, Model& model)
{
    State state;
    state.contacts.has_memory = model.joints.has_memory();
    state.contacts.has_preload = model.insitu.given || state.contacts.has_memory;
    state.water.resize(model.water.given ? static_cast<std::size_t>(model.blocks()) : 0);
    state.support.bolts.resize(model.support.bolts.size());
    state.support.liners.resize(model.support.liners.size());
    state.support.history.resize(static_cast<std::size_t>(model.support.history_size));
    Unpacked unpacked;
    Loader loader(file);
    exchange(loader, model.blocks(), state, unpacked);
    if (!is_permutation(unpacked.user_number))
        file.fail("/blocks/user_number", "not an order of the blocks: the file is damaged");
    reorder_blocks(unpacked.user_number, model);

    Contacts& contacts = state.contacts;
    const auto n = static_cast<Index>(unpacked.contacts.size());
    contacts.resize(n);
    for (Index i = 0; i < n; ++i)
    {
        contacts.put(i, unpacked.contacts[i]);
        contacts.stale[i] = unpacked.stale[i];
    }
    if (const auto damage = find_damage(model, state))
        file.fail(damage->object, damage->reason);
    return state;
}
}  // namespace hdem
