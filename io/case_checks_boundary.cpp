#include "core/model/boundary.h"
#include "core/stage/rules.h"
#include "io/case_check.h"
#include "io/case_checks.h"

#include <algorithm>
#include <map>

namespace hdem
{
namespace
{
class BoundaryCheck : public CaseCheck
{
  public:
    using CaseCheck::CaseCheck;

    void check()
    {
        for (std::size_t i = 0; i < def_.boundaries.size(); ++i)
        {
            const BoundaryDef& boundary = def_.boundaries[i];
            const std::string path = fmt::format("boundary[{}]", i);
            const std::string object = fmt::format("boundary \"{}\"", printable(boundary.name));
            check_side(boundary, path, object);
            check_kind(boundary, path, object);
            check_method(boundary, path, object);
            check_stages(boundary, path, object);
            check_changes(boundary, path, object);
            check_twice(i, path, object);
        }
    }

  private:
    void check_side(const BoundaryDef& boundary, const std::string& path, const std::string& object)
    {
        if (!def_.domain.given && !problems_.has("domain"))
        {
            problems_.add(path, object, "boundary", "is a side of the domain, and there is no [domain]",
                          "Give a [domain], or fix and load blocks by name.");
            return;
        }
        exclude(path, object, "side", "edges");
        const bool is_polygon = given("domain.polygon"), has_edges = is_polygon || given("domain.profile");
        if (given(path + ".side") && is_polygon)
            problems_.add(path + ".side", object, "side", "is one of a rectangle, and the domain is a polygon",
                          "Use edges = [0, ...]: 0 is the edge from the first to the second vertex.");
        else if (boundary.side == "top" && given("domain.profile"))
            problems_.add(path + ".side", object, "side = \"top\"", "is not one side: the domain ends at a profile",
                          "Use edges: 0 is the lower side, 1 the right one, from 2 on the profile from the right to the left.");
        else if (given(path + ".edges") && !has_edges)
            problems_.add(path + ".edges", object, "edges", "are those of a polygon, and the domain is a rectangle",
                          "Use side = \"left\", \"right\", \"bottom\" or \"top\".");
        else if (given(path + ".edges") && !problems_.has(path + ".edges") && boundary.edges.empty())
            problems_.add(path + ".edges", object, "edges = []", "names no edge", "Name at least one.");
        for (const int edge : boundary.edges)
            if (has_edges && !def_.domain.polygon.empty() && static_cast<std::size_t>(edge) >= def_.domain.polygon.size() &&
                !problems_.has("domain.polygon"))
                problems_.add(path + ".edges", object, fmt::format("edges = {}", edge),
                              fmt::format("the polygon has edges 0 to {}", def_.domain.polygon.size() - 1),
                              "Give the number of an edge.");
        if (!given(path + ".side") && !given(path + ".edges") && !problems_.has(path + ".side") && !problems_.has(path + ".edges"))
            problems_.add(path, object, is_polygon ? "edges" : "side", "is missing",
                          is_polygon ? "Give edges = [0, ...]." : "Give side = \"left\", \"right\", \"bottom\" or \"top\".");
    }

    void check_kind(const BoundaryDef& boundary, const std::string& path, const std::string& object)
    {
        if (!given(path + ".kind") || problems_.has(path + ".kind"))
            return;
        static const std::map<std::string, BoundaryKind> needs = {
            {"stress", BoundaryKind::stress}, {"velocity", BoundaryKind::velocity}, {"target", BoundaryKind::servo}};
        for (const auto& [key, kind] : needs)
            if (boundary.kind == kind && !given(path + "." + key))
                problems_.add(path + "." + key, object, key, "is missing: this kind needs it", "Add it.");
            else if (boundary.kind != kind && given(path + "." + key))
                problems_.add(path + "." + key, object, key, "belongs to another kind", "Remove it, or choose that kind.");
        if (boundary.kind != BoundaryKind::servo && given(path + ".max_velocity"))
            problems_.add(path + ".max_velocity", object, "max_velocity", "belongs to kind servo", "Remove it.");
        const bool has_numbers = boundary.kind == BoundaryKind::stress && boundary.stress;
        if (given(path + ".stress_gradient") && !has_numbers && !problems_.has(path + ".stress"))
            problems_.add(path + ".stress_gradient", object, "stress_gradient", "belongs to a stress of two numbers",
                          "Give stress = [compression, shear], or remove this key.");
        if (given(path + ".stress_height") && !given(path + ".stress_gradient"))
            problems_.add(path + ".stress_height", object, "stress_height", "belongs to stress_gradient, which is not given",
                          "Give stress_gradient, or remove this key.");
        if (boundary.is_insitu && !def_.insitu.given && !problems_.has("insitu"))
            problems_.add(path + ".stress", object, "stress = \"insitu\"", "there is no [insitu]",
                          "Give [insitu], or stress = [compression, shear].");
    }

    /// A servo is steered by the stiffness of its contacts, and impulses have none.
    void check_method(const BoundaryDef& boundary, const std::string& path, const std::string& object)
    {
        if (boundary.kind != BoundaryKind::servo || problems_.has(path + ".kind"))
            return;
        Method method = def_.contact.method;
        for (const StageDef& stage : def_.stages)
        {
            method = stage.method.value_or(method);
            const bool acts = boundary.stages.empty() || std::ranges::count(boundary.stages, stage.name) > 0;
            if (acts && is_by_impulses(method))
                return problems_.add(
                    path + ".kind", object, "kind = \"servo\"",
                    fmt::format("stage \"{}\" has method = \"impulse\", and impulses have no stiffness to steer a wall by",
                                printable(stage.name)),
                    "Use method \"hybrid\" or \"force\" there, or kind = \"stress\".");
        }
    }

    /// Only what is given by a number can grow.
    void check_changes(const BoundaryDef& boundary, const std::string& path, const std::string& object)
    {
        check_factor(boundary.factor, path, object);
        const bool may = boundary.kind == BoundaryKind::stress || moves_walls(boundary.kind) || problems_.has(path + ".kind");
        for (const char* key : {"ramp_cycles", "ramp_time", "table", "table_file"})
            if (!may && given(path + "." + key))
                problems_.add(path + "." + key, object, key, "belongs to the kinds stress, velocity and servo",
                              "Remove it, or choose one of these kinds.");
    }

    void check_stages(const BoundaryDef& boundary, const std::string& path, const std::string& object)
    {
        if (given(path + ".stages") && !problems_.has(path + ".stages") && boundary.stages.empty())
            problems_.add(path + ".stages", object, "stages = []", "it would never act", "Name a stage, or remove this key.");
        for (const std::string& name : boundary.stages)
            check_reference(path + ".stages", object, name, "stage", stages_);
    }

    [[nodiscard]] static bool share_a_stage(const BoundaryDef& a, const BoundaryDef& b)
    {
        return a.stages.empty() || b.stages.empty() || std::ranges::find_first_of(a.stages, b.stages) != a.stages.end();
    }

    /// A side by its name; of a domain below a profile the edge that has this name: its polygon begins with the lower side.
    [[nodiscard]] std::string side_named(const std::string& name) const
    {
        static const std::map<std::string, std::size_t> numbers = {{"bottom", 0}, {"right", 1}};
        if (!given("domain.profile"))
            return name;
        const auto number = numbers.find(name);
        return std::to_string(number != numbers.end() ? number->second : def_.domain.polygon.size() - 1);
    }

    [[nodiscard]] Names sides_of(const std::vector<std::string>& names, const std::vector<int>& edges) const
    {
        Names sides;
        for (const std::string& name : names)
            sides.insert(side_named(name));
        for (const int edge : edges)
            sides.insert(std::to_string(edge));
        return sides;
    }

    [[nodiscard]] Names sides_of(const BoundaryDef& boundary) const
    {
        return sides_of(std::vector<std::string>(boundary.side.empty() ? 0 : 1, boundary.side), boundary.edges);
    }

    [[nodiscard]] static bool share_a_side(const Names& a, const Names& b)
    {
        return std::ranges::any_of(a, [&](const std::string& side) { return b.contains(side); });
    }

    /// Two that act on one side at the same time.
    void check_twice(std::size_t number, const std::string& path, const std::string& object)
    {
        const BoundaryDef& boundary = def_.boundaries[number];
        const std::string key = path + (boundary.side.empty() ? ".edges" : ".side");
        const std::string said = boundary.side.empty() ? "edges" : fmt::format("side = \"{}\"", printable(boundary.side));
        const Names sides = sides_of(boundary);
        if (share_a_side(sides, sides_of(def_.domain.fixed, def_.domain.fixed_edges)))
            problems_.add(key, object, said, "is fixed by [domain]", "Remove it there, or remove this boundary.");
        for (std::size_t i = 0; i < number; ++i)
            if (const BoundaryDef& other = def_.boundaries[i];
                share_a_side(sides, sides_of(other)) && share_a_stage(boundary, other))
                problems_.add(key, object, said, fmt::format("boundary \"{}\" acts there in the same stage", printable(other.name)),
                              "Keep one of them, or give stages.");
    }
};
}  // namespace

void check_boundary_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    BoundaryCheck(def, source, problems).check();
}
}  // namespace hdem
