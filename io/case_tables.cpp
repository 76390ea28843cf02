#include "io/case_tables.h"

#include "io/case_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace hdem
{
namespace
{
/// Walks the document section by section and writes what it finds into the case.
class TableReader
{
  public:
    TableReader(CaseDef& def, CaseSource& source, CaseProblems& problems) : def_(def), source_(source), problems_(problems) {}

    void read(const TomlNode& document)
    {
        const SectionSpec& top = case_schema().front();
        for (const TomlMember& member : *document.members())
            if (const SectionSpec* section = find_section(member.key))
                read_section(*section, member);
            else if (top.find(member.key) != nullptr)
                read_key(top, "", "case", &def_, member);
            else
                refuse_section(top, member);
    }

  private:
    void read_section(const SectionSpec& section, const TomlMember& member)
    {
        const std::string& name = section.name;
        source_.add(name, member.value.at);
        const TomlNode::Items* items = member.value.items();
        const bool tables = items != nullptr && std::all_of(items->begin(), items->end(),
                                                            [](const TomlNode& item) { return item.members() != nullptr; });
        const bool right = section.kind == SectionKind::array ? tables : member.value.members() != nullptr;
        if (!right)
            problems_.add(name, section.label, fmt::format("{} = {}", name, tables ? "[[...]]" : brief(member.value)),
                          section.kind == SectionKind::array ? "can occur several times"
                          : items != nullptr && tables       ? "can occur only once"
                                                             : "is a section, not a value",
                          fmt::format("Write {} and the keys below it.", section.heading()));
        else if (section.kind == SectionKind::table)
            read_table(section, name, "[" + name + "]", section.open(def_, ""), member.value);
        else if (section.kind == SectionKind::named)
            for (const TomlMember& entry : *member.value.members())
                read_named(section, entry);
        else
            for (std::size_t i = 0; i < items->size(); ++i)
                read_entry(section, i, (*items)[i]);
    }

    void read_named(const SectionSpec& section, const TomlMember& entry)
    {
        const std::string path = section.name + "." + entry.key;
        source_.add(path, entry.value.at);
        const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
        if (entry.value.members() == nullptr)
        {
            problems_.expect_instead(section.name);
            problems_.add(path, section.label, fmt::format("{} = {}", printable(entry.key), brief(entry.value)),
                          fmt::format("a {} has a name", section.label),
                          fmt::format("Write [{}.{}] above this key.", section.name, section.name == "joint" ? "default" : "rock"));
        }
        else if (entry.key.empty() || !std::all_of(entry.key.begin(), entry.key.end(), plain))
            problems_.add(path, section.label, fmt::format("name = \"{}\"", printable(entry.key)),
                          "has other characters than letters, digits, _ and -", "Choose a plain name.");
        else
            read_table(section, path, fmt::format("{} \"{}\"", section.label, entry.key), section.open(def_, entry.key),
                       entry.value);
    }

    void read_entry(const SectionSpec& section, std::size_t i, const TomlNode& entry)
    {
        const std::string path = fmt::format("{}[{}]", section.name, i);
        source_.add(path, entry.at);
        const std::string standard = default_name(section, i + 1);
        const TomlNode* given = entry.find("name");
        const bool named = section.find("name") != nullptr && !section.find("name")->required;
        std::string object = given != nullptr && given->text() != nullptr
                                 ? fmt::format("{} \"{}\"", section.label, printable(*given->text()))
                             : named ? fmt::format("{} \"{}\"", section.label, standard)
                                     : fmt::format("{} {}", section.label, i + 1);
        read_table(section, path, object, section.open(def_, standard), entry);
    }

    void read_table(const SectionSpec& section, const std::string& path, const std::string& object, void* target,
                    const TomlNode& table)
    {
        for (const TomlMember& member : *table.members())
            read_key(section, path + ".", object, target, member);
        for (const KeySpec& key : section.keys)
            if (key.required && table.find(key.name) == nullptr && !problems_.has(path + "." + key.name))
                problems_.add(path + "." + key.name, object, key.name, "is missing",
                              key.example.empty()
                                  ? fmt::format("Add it: {}.", describe_type(key))
                                  : fmt::format("Add it: {}, e.g. {} = {}.", describe_type(key), key.name, key.example));
    }

    void read_key(const SectionSpec& section, const std::string& prefix, const std::string& object, void* target,
                  const TomlMember& member)
    {
        const std::string path = prefix + member.key;
        const KeySpec* key = section.find(member.key);
        if (key == nullptr)
            return refuse_key(section, prefix, object, member);
        source_.add(path, member.value.at);
        const auto complaints = find_complaint(*key, member.value);
        for (const auto& [item, node, why, remedy] : complaints)
        {
            source_.add(path + item, node->at);
            const std::string unit = key->unit.empty() || !node->is_number() ? "" : " " + key->unit;
            problems_.add(path, object, fmt::format("{}{} = {}{}", key->name, item, brief(*node), unit), why, remedy);
            source_.add(path, node->at);
        }
        if (complaints.empty())
            key->assign(target, member.value, *key);
    }

    void refuse_key(const SectionSpec& section, const std::string& prefix, const std::string& object, const TomlMember& member)
    {
        std::vector<std::string> names;
        for (const KeySpec& key : section.keys)
            names.push_back(key.name);
        const std::string near = did_you_mean(member.key, names);
        source_.add(prefix + member.key, member.key_at);
        problems_.add(prefix + member.key, object, fmt::format("{} = {}", printable(member.key), brief(member.value)),
                      near.empty() ? "unknown key" : fmt::format("unknown key; did you mean '{}'?", near),
                      fmt::format("{} has {}.", section.heading(), fmt::join(names, ", ")));
        if (!near.empty())
            problems_.expect_instead(prefix + near);
    }

    void refuse_section(const SectionSpec& top, const TomlMember& member)
    {
        std::vector<std::string> names;
        for (const KeySpec& key : top.keys)
            names.push_back(key.name);
        for (const SectionSpec& section : case_schema())
            names.push_back(section.name);
        const std::string near = did_you_mean(member.key, names);
        const bool section = member.value.members() != nullptr ||
                             (member.value.items() != nullptr && find_section(near) != nullptr);
        source_.add(member.key, member.key_at);
        std::string remedy = "io/case_format.md lists all keys.";
        if (!section)
        {
            std::vector<std::string> owners;
            for (const SectionSpec& owner : case_schema())
                if (near.empty() && owner.find(member.key) != nullptr)
                    owners.push_back(owner.heading());
            if (!owners.empty())
                remedy = fmt::format("It belongs below {}.", fmt::join(owners, " or "));
        }
        problems_.add(
            member.key, "case",
            section ? "[" + printable(member.key) + "]" : fmt::format("{} = {}", printable(member.key), brief(member.value)),
            fmt::format("unknown {}{}", section ? "section" : "key", near.empty() ? "" : fmt::format("; did you mean '{}'?", near)),
            remedy);
        if (!near.empty())
            problems_.expect_instead(near);
    }

    CaseDef& def_;
    CaseSource& source_;
    CaseProblems& problems_;
};
}  // namespace

void read_tables(const TomlNode& document, CaseDef& def, CaseSource& source, CaseProblems& problems)
{
    TableReader(def, source, problems).read(document);
}
}  // namespace hdem
