#include "io/state_archive.h"

#include "core/check.h"
#include "core/model/block_order.h"
#include "core/stage/properties.h"
#include "core/state/state_tables.h"
#include "io/state_checks.h"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

namespace hdem
{
namespace
{
// What is saved stands once, in core/state/state_tables.h; Saver and Loader are its two directions. A table has a row for each item;
// `members` is the list of a row's numbers.

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

    /// Contacts are taken out of their lanes anew for each table: all of them as values would need more memory than the file.
    template <typename Stored, typename Members>
    void contact_rows(const std::string& path, const Contacts& contacts, const Members& members)
    {
        std::vector<Stored> values;
        values.reserve(static_cast<std::size_t>(contacts.size()) * columns_of<Contact, Members>);
        for (Index i = 0; i < contacts.size(); ++i)
        {
            Contact contact = contacts.get(i);
            std::apply([&](auto&... member) { (values.push_back(static_cast<Stored>(member)), ...); }, members(contact));
        }
        file_.write(path, values, table_shape<Contact, Members>(static_cast<std::uint64_t>(contacts.size())),
                    Hdf5Writer::Packing::plain);
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

    /// The first table says how many contacts there are.
    template <typename Stored, typename Members>
    void contact_rows(const std::string& path, Contacts& contacts, const Members& members)
    {
        const std::uint64_t expected = contacts_counted_ ? static_cast<std::uint64_t>(contacts.size()) : any_extent;
        const std::vector<Stored> values = file_.read<Stored>(path, table_shape<Contact, Members>(expected));
        if (!contacts_counted_)
            contacts.resize(static_cast<Index>(values.size() / columns_of<Contact, Members>));
        contacts_counted_ = true;
        auto at = values.begin();
        const auto take = [&](auto& member) { member = static_cast<std::remove_reference_t<decltype(member)>>(*at++); };
        for (Index i = 0; i < contacts.size(); ++i)
        {
            Contact contact = contacts.get(i);
            std::apply([&](auto&... member) { (take(member), ...); }, members(contact));
            contacts.put(i, contact);
        }
    }

  private:
    const Hdf5Reader& file_;
    bool contacts_counted_ = false;
};

/// What of a checkpoint's state is kept otherwise in the memory.
struct Unpacked
{
    std::vector<Index> user_number;
    std::vector<std::uint8_t> stale;  ///< per contact
};

/// Type of the file for a number of the memory.
template <typename T>
using StoredAs = std::conditional_t<std::is_enum_v<T> || std::is_same_v<T, bool>, std::uint8_t, T>;

template <typename Archive>
void exchange(Archive& archive, Index blocks, State& state, Unpacked& unpacked)
{
    archive.group("/state");
    const auto value = [&](const char* name, auto& number)
    { archive.template value<StoredAs<std::remove_reference_t<decltype(number)>>>("/state", name, number); };
    // Two tables of one array: the first one says how many rows the second one has.
    const auto table = [&]<typename T>(tables::As<T>, const char* path, auto& rows, const auto& list)
    { archive.template rows<T>(path, rows.empty() ? any_extent : rows.size(), rows, list); };
    tables::for_each_of_run(state, value);
    tables::for_each_counter(state, value);
    tables::for_each_told(state, table);
    tables::for_each_of_ends(state, table);
    archive.group("/state/ledger");
    for (const LedgerTerm& term : ledger_terms)
        archive.template value<double>("/state/ledger", term.name, state.ledger.*term.value);

    const auto n = static_cast<std::uint64_t>(blocks);
    archive.template rows<std::int32_t>("/blocks/user_number", n, unpacked.user_number, fields::number);
    const auto of_blocks = [&]<typename T>(tables::As<T>, const char* path, auto& rows, const auto& list)
    { archive.template rows<T>(path, n, rows, list); };
    tables::for_each_of_blocks(state, of_blocks);
    tables::for_each_derived(state, of_blocks);
    tables::for_each_of_groups(state, table);
    tables::for_each_of_excavations(state, table);

    if (!state.support.bolts.empty() || !state.support.liners.empty())
    {
        archive.group("/bolts");
        if (!state.support.liners.empty())
            archive.group("/liners");
        tables::for_each_of_support(state.support, [&]<typename T>(tables::As<T>, const char* path, auto& rows, const auto& list)
                                    { archive.template rows<T>(path, rows.size(), rows, list); });
    }

    tables::for_each_of_contact(state.contacts.has_preload, state.contacts.has_memory,
                                [&]<typename T>(tables::As<T>, const char* path, const auto& list)
                                { archive.template contact_rows<T>(path, state.contacts, list); });
    archive.template rows<std::uint8_t>("/contacts/stale", static_cast<std::uint64_t>(state.contacts.size()), unpacked.stale,
                                        fields::number);
}
}  // namespace

void save_state(const Model& model, const State& state, Hdf5Writer& file)
{
    const Contacts& contacts = state.contacts;
    Unpacked unpacked{.user_number = model.user_number,
                      .stale = {contacts.stale.begin(), contacts.stale.begin() + contacts.size()}};
    Saver saver(file);
    exchange(saver, model.blocks(), const_cast<State&>(state), unpacked);  // a Saver changes nothing
}

State load_state(const Hdf5Reader& file, Model& model)
{
    State state;
    state.contacts.has_memory = model.joints.has_memory();
    state.contacts.has_preload = needs_preload(model);
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

    std::ranges::copy(unpacked.stale, state.contacts.stale.begin());
    if (const auto damage = find_damage(model, state))
        file.fail(damage->object, damage->reason);
    return state;
}
}  // namespace hdem
