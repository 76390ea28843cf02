#include "io/case_reader.h"

#include "core/rock/fault_lines.h"
#include "core/rock/finite_traces.h"
#include "core/rock/rock_checks.h"
#include "core/rock/section.h"
#include "core/rock/voronoi_edges.h"
#include "io/case_checks.h"
#include "io/case_problems.h"
#include "io/case_schema.h"
#include "io/factor_table.h"
#include "io/geojson.h"
#include "io/law_library.h"
#include "io/polygons.h"
#include "io/pressure_table.h"
#include "io/profile.h"
#include "io/stage_joints.h"
#include "io/text_file.h"
#include "io/traces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace hdem
{
namespace
{
/// Walks the document section by section and writes what it finds into the case.
class Reader
{
  public:
    Reader(CaseDef& def, CaseSource& source, CaseProblems& problems) : def_(def), source_(source), problems_(problems) {}

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

[[noreturn]] void fail(const std::string& text)
{
    throw InputError(std::vector<Problem>{{Problem::Severity::error, "", text}});
}

std::string read_text(const std::filesystem::path& file)
{
    TextFile read = read_text_file(file, largest_case_file);
    if (!read.obstacle.empty())
        fail(fmt::format("{}: case: ({}). {}", file.string(), read.obstacle, read.remedy));
    return std::move(read.text);
}

/// A file that the case names: from the disk, or from `stored`.
TextFile named_file(const std::string& name, const std::filesystem::path& case_file, const NamedFiles* stored)
{
    if (stored == nullptr)
        return read_text_file(case_file.parent_path() / name, largest_named_file);
    const auto found = stored->find(name);
    if (found == stored->end())
        return {.text = {}, .obstacle = "is not stored with the case", .remedy = "The checkpoint is damaged."};
    return {.text = found->second, .obstacle = {}, .remedy = {}};
}

/// Text of the file that `key` names; it is kept with the case. Complains where there is none, and returns nothing.
const std::string* text_named(const std::string& key, const std::string& object, const std::string& name, CaseFile& read,
                              const std::filesystem::path& case_file, const NamedFiles* stored, CaseProblems& problems)
{
    TextFile file = named_file(name, case_file, stored);
    if (file.obstacle.empty())
        return &(read.files[name] = std::move(file.text));
    problems.add(key, object, fmt::format("{} = \"{}\"", key.substr(key.find('.') + 1), printable(name)),
                 fmt::format("{} {}", printable((case_file.parent_path() / name).string(), 200), file.obstacle),
                 file.remedy + " A relative name starts at the folder of the case file.");
    return nullptr;
}

/// Appends the blocks of the blocks_file. Problems inside it are located already.
void add_blocks_file(CaseFile& read, const std::filesystem::path& case_file, const NamedFiles* stored, CaseProblems& problems,
                     std::vector<Problem>& located)
{
    CaseDef& def = read.def;
    const std::string* text = text_named("blocks_file", "case", def.blocks_file, read, case_file, stored, problems);
    if (text == nullptr)
        return;
    const std::string file = (case_file.parent_path() / def.blocks_file).string();
    std::istringstream in(*text);
    auto [blocks, found] = is_geojson(file) ? read_geojson_blocks(*text, file, def.blocks.size())
                                            : read_polygons(in, file, def.blocks.size());
    located.insert(located.end(), found.begin(), found.end());
    const int number = read.source.add_source(file);
    for (auto& [block, line] : blocks)
    {
        read.source.add(fmt::format("block[{}]", def.blocks.size()), {.line = line, .source = number});
        def.blocks.push_back(std::move(block));
    }
}

/// Traces of the traces_file. Problems inside it are located already.
std::vector<Polygon> traces_of(CaseFile& read, const std::filesystem::path& case_file, const NamedFiles* stored,
                               CaseProblems& problems, std::vector<Problem>& located)
{
    const std::string& name = read.def.domain.traces_file;
    if (name.empty())
        return {};
    const std::string* text = text_named("domain.traces_file", "[domain]", name, read, case_file, stored, problems);
    if (text == nullptr)
        return {};
    std::istringstream in(*text);
    const std::string file = (case_file.parent_path() / name).string();
    auto [traces, found] = is_geojson(name) ? read_geojson_traces(*text, file) : read_traces(in, file);
    located.insert(located.end(), found.begin(), found.end());
    return traces;
}

/// Polygon of a domain below a profile. Problems inside the file are located already.
void add_profile(CaseFile& read, const std::filesystem::path& case_file, const NamedFiles* stored, CaseProblems& problems,
                 std::vector<Problem>& located)
{
    DomainDef& domain = read.def.domain;
    if (domain.profile.empty() || !domain.polygon.empty())
        return;
    const std::string* text = text_named("domain.profile", "[domain]", domain.profile, read, case_file, stored, problems);
    if (text == nullptr)
        return;
    std::istringstream in(*text);
    const ProfileFile file = read_profile(in, (case_file.parent_path() / domain.profile).string());
    located.insert(located.end(), file.problems.begin(), file.problems.end());
    if (!file.problems.empty() || !domain.bottom)
        return;
    const double lowest = std::ranges::min(file.points, {}, [](const Vec2& p) { return p.y(); }).y();
    if (*domain.bottom < lowest)
        domain.polygon = domain_below(file.points, *domain.bottom);
    else
        problems.add("domain.bottom", "[domain]", fmt::format("bottom = {} m", *domain.bottom),
                     fmt::format("is not below the profile, whose lowest point is at {} m", lowest), "Give a lower one.");
}

/// Orientations in space become dips and spacings in the section.
void resolve_orientations(CaseDef& def, CaseProblems& problems)
{
    for (std::size_t i = 0; i < def.joint_sets.size(); ++i)
        if (!resolve_orientation(def.joint_sets[i]))
            problems.add(fmt::format("joint_set[{}].orientation", i),
                         fmt::format("joint set \"{}\"", printable(def.joint_sets[i].name)), "orientation",
                         "the planes are parallel to the section and leave no traces in it",
                         "Leave this set out, or choose another section.");
}

/// Rows of the file of water pressures. Problems inside it are located already.
void add_pressures(CaseFile& read, const std::filesystem::path& case_file, const NamedFiles* stored, CaseProblems& problems,
                   std::vector<Problem>& located)
{
    WaterDef& water = read.def.water;
    if (water.pressure.empty())
        return;
    const std::string* text = text_named("water.pressure", "[water]", water.pressure, read, case_file, stored, problems);
    if (text == nullptr)
        return;
    std::istringstream in(*text);
    auto [rows, found] = read_pressures(in, (case_file.parent_path() / water.pressure).string());
    located.insert(located.end(), found.begin(), found.end());
    water.pressures = std::move(rows);
}

/// Rows of the table_file of a load or a side. Problems inside it are located already.
void read_table_file(FactorDef& factor, const std::string& path, const std::string& object, CaseFile& read,
                     const std::filesystem::path& case_file, const NamedFiles* stored, CaseProblems& problems,
                     std::vector<Problem>& located)
{
    if (factor.table_file.empty() || !factor.table.empty())
        return;
    const std::string* text = text_named(path + ".table_file", object, factor.table_file, read, case_file, stored, problems);
    if (text == nullptr)
        return;
    std::istringstream in(*text);
    FactorFile file = read_factors(in, (case_file.parent_path() / factor.table_file).string());
    located.insert(located.end(), file.problems.begin(), file.problems.end());
    factor.table = std::move(file.rows);
    factor.table_by = file.by;
}

void read_table_files(CaseFile& read, const std::filesystem::path& case_file, const NamedFiles* stored, CaseProblems& problems,
                      std::vector<Problem>& located)
{
    CaseDef& def = read.def;
    for (std::size_t i = 0; i < def.loads.size(); ++i)
        read_table_file(def.loads[i].factor, fmt::format("load[{}]", i), fmt::format("load {}", i + 1), read, case_file, stored,
                        problems, located);
    for (std::size_t i = 0; i < def.boundaries.size(); ++i)
        read_table_file(def.boundaries[i].factor, fmt::format("boundary[{}]", i),
                        fmt::format("boundary \"{}\"", printable(def.boundaries[i].name)), read, case_file, stored, problems,
                        located);
}

/// Only a domain without problems can be cut.
void cut_domain(CaseDef& def, const std::vector<Polygon>& traces, const CaseSource& source)
{
    const bool has_lines = def.voronoi.given || std::ranges::any_of(def.joint_sets, is_finite);
    if ((traces.empty() && def.faults.empty() && def.regions.empty() && !has_lines) || !find_rock_problems(def).empty())
        return;
    try
    {
        std::vector<SourceLine> lines = source_lines(def);
        std::vector<DrawnSet> sets;
        if (has_lines)
            std::ranges::move(draw_lines(def, sets), std::back_inserter(lines));
        if (def.voronoi.given)
            std::ranges::move(draw_voronoi(def, sets.emplace_back()), std::back_inserter(lines));
        if (!traces.empty() || !lines.empty())
            def.trace_cells = cut_into_cells(domain_polygon(def.domain), traces, def.domain.traces_snap, lines);
        def.trace_cells.sets = std::move(sets);
    }
    catch (const InputError& error)
    {
        throw InputError(source.located(error.problems()));
    }
}
}  // namespace

CaseFile read_case_text(std::string text, const std::filesystem::path& file, std::span<const Override> overrides,
                        const NamedFiles* files)
{
    CaseFile result;
    result.source = CaseSource(file.string(), std::move(text));
    CaseSource& source = result.source;
    auto parsed = parse_toml(source.text());
    if (const auto* error = std::get_if<TomlError>(&parsed))
    {
        source.add("document", error->at);
        fail(source.located({Problem::Severity::error, "document", fmt::format("case: ({}). {}", error->why, error->remedy)}));
    }
    auto& document = std::get<TomlNode>(parsed);
    std::vector<Problem> located = apply_overrides(document, overrides, source);

    CaseProblems problems;
    Reader(result.def, source, problems).read(document);
    if (!result.def.blocks_file.empty())
        add_blocks_file(result, file, files, problems, located);
    add_profile(result, file, files, problems, located);
    resolve_orientations(result.def, problems);
    add_pressures(result, file, files, problems, located);
    read_table_files(result, file, files, problems, located);
    const std::vector<Polygon> traces = traces_of(result, file, files, problems, located);
    load_laws(result, result.def, file, files, problems);
    check_rock_keys(result.def, source, problems);
    check_boundary_keys(result.def, source, problems);
    check_support_keys(result.def, source, problems);
    check_water_keys(result.def, source, problems);
    check_joint_keys(result.def, source, problems);
    check_run_keys(result.def, source, problems);

    const auto found = source.located(problems.errors());
    located.insert(located.begin(), found.begin(), found.end());
    if (!located.empty())
        throw InputError(std::move(located));
    const auto read_again = [&](TomlNode& changed, CaseDef& def, CaseProblems& found_again)
    {
        Reader(def, source, found_again).read(changed);
        load_laws(result, def, file, files, found_again);
        check_joint_keys(def, source, found_again);
    };
    if (std::vector<Problem> wrong = read_stage_joints(result.def, document, source, read_again); !wrong.empty())
        throw InputError(std::move(wrong));
    cut_domain(result.def, traces, source);
    result.warnings = source.located(problems.warnings());
    return result;
}

CaseFile read_case_file(const std::filesystem::path& file, std::span<const Override> overrides)
{
    return read_case_text(read_text(file), file, overrides);
}

CaseDef read_case(const std::filesystem::path& file, std::span<const Override> overrides)
{
    return read_case_file(file, overrides).def;
}
}  // namespace hdem
