#include "io/case_schema.h"

#include "core/history_sampler.h"
#include "io/case_sections.h"

#include <fmt/format.h>

#include <algorithm>

namespace hdem
{
const std::vector<std::string>& block_quantities()
{
    return block_history_quantities();
}

const std::vector<std::string>& contact_quantities()
{
    return contact_history_quantities();
}

const std::vector<std::string>& bolt_quantities()
{
    return bolt_history_quantities();
}

const std::vector<std::string>& liner_quantities()
{
    return liner_history_quantities();
}

const std::vector<std::string>& point_quantities()
{
    return point_history_quantities();
}

const std::vector<std::string>& fitting_quantities(const HistoryDef& history)
{
    if (!history.bolt.empty() || !history.liner.empty())
        return history.bolt.empty() ? liner_quantities() : bolt_quantities();
    return history.point ? point_quantities() : (history.between.empty() ? block_quantities() : contact_quantities());
}

const std::vector<SectionSpec>& case_schema()
{
    static const std::vector<SectionSpec> all = {
        top_section(),     domain_section(),    fault_section(),       region_section(),      joint_set_section(),
        voronoi_section(), generator_section(), excavation_section(),  block_section(),       material_section(),
        joint_section(),   insitu_section(),    water_section(),       water_crack_section(), boundary_section(),
        bolt_section(),    liner_section(),     gravity_section(),     load_section(),        contact_section(),
        damping_section(), time_section(),      convergence_section(), stage_section(),       factor_of_safety_section(),
        history_section(), output_section()};
    return all;
}

const SectionSpec* find_section(std::string_view name)
{
    for (const SectionSpec& section : case_schema())
        if (section.name == name && section.kind != SectionKind::top)
            return &section;
    return nullptr;
}

const KeySpec* SectionSpec::find(std::string_view key) const
{
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const KeySpec& k) { return k.name == key; });
    return found == keys.end() ? nullptr : &*found;
}

std::string SectionSpec::heading() const
{
    switch (kind)
    {
    case SectionKind::top:
        return "the top of the file";
    case SectionKind::table:
        return "[" + name + "]";
    case SectionKind::named:
        return "[" + name + ".NAME]";
    case SectionKind::array:
        return "[[" + name + "]]";
    }
    return name;
}

std::string default_name(const SectionSpec& section, std::size_t number)
{
    return (section.name == "joint_set" ? "set" : section.name) + std::to_string(number);
}

std::string Range::describe(double shown) const
{
    const bool below = low >= -shown;
    const bool above = high <= shown;
    if (below && above && low == high)
        return fmt::format("{}", low);
    if (below && above && low_included && high_included)
        return fmt::format("{} to {}", low, high);
    std::string text;
    if (below)
        text += fmt::format("{} {}", low_included ? ">=" : ">", low);
    if (below && above)
        text += " and ";
    if (above)
        text += fmt::format("{} {}", high_included ? "<=" : "<", high);
    return text;
}
}  // namespace hdem
