#include "io/case_reader.h"

#include "core/rock/fault_lines.h"
#include "core/rock/finite_traces.h"
#include "core/rock/rock_checks.h"
#include "core/rock/section.h"
#include "core/rock/voronoi_edges.h"
#include "io/case_checks.h"
#include "io/case_named_files.h"
#include "io/case_problems.h"
#include "io/case_tables.h"
#include "io/law_library.h"
#include "io/stage_joints.h"
#include "io/text_file.h"
#include "io/traces.h"

#include <fmt/format.h>

#include <algorithm>

namespace hdem
{
namespace
{
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
    read_tables(document, result.def, source, problems);
    const std::vector<Polygon> traces = read_named_files(result, file, files, problems, located);
    resolve_orientations(result.def, problems);
    load_laws(result, result.def, file, files, problems);
    check_rock_keys(result.def, source, problems);
    check_names(result.def, source, problems);
    check_boundary_keys(result.def, source, problems);
    check_support_keys(result.def, source, problems);
    check_water_keys(result.def, source, problems);
    check_joint_keys(result.def, source, problems);
    check_run_keys(result.def, source, problems);
    check_stage_keys(result.def, source, problems);
    check_history_keys(result.def, source, problems);
    warn_of_units(result.def, source, problems);

    const auto found = source.located(problems.errors());
    located.insert(located.begin(), found.begin(), found.end());
    if (!located.empty())
        throw InputError(std::move(located));
    const auto read_again = [&](TomlNode& changed, CaseDef& def, CaseProblems& found_again)
    {
        read_tables(changed, def, source, found_again);
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
