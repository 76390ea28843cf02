#include "io/stage_joints.h"

#include "core/rock/joint_laws.h"
#include "core/stage/properties.h"
#include "io/case_override.h"

#include <fmt/format.h>

namespace hdem
{
namespace
{
/// Name of a number that must stay, because contacts bear by it; empty where all may change.
std::string changed_for_good(const JointDef& a, const JointDef& b)
{
    const auto differs = [&](auto JointDef::*field) { return a.*field != b.*field; };
    const auto comes_or_goes = [&](auto JointDef::*field) { return (a.*field).has_value() != (b.*field).has_value(); };
    if (differs(&JointDef::law))
        return "law";
    for (const auto& [name, field] :
         {std::pair{"greatest_closure", &JointDef::greatest_closure}, std::pair{"normal_exponent", &JointDef::normal_exponent},
          std::pair{"rock_strength", &JointDef::rock_strength}})
        if (comes_or_goes(field))
            return name;
    if (differs(&JointDef::initially))
        return "initially";
    if (differs(&JointDef::materials))
        return "materials";
    return "";
}

/// Name of a number that is no strength; empty where only strengths change.
std::string changed_at_once(const JointDef& a, const JointDef& b)
{
    JointDef rest = b;
    for (double JointDef::*const strength : {&JointDef::friction_angle_deg, &JointDef::cohesion})
        rest.*strength = a.*strength;
    for (std::optional<double> JointDef::*const strength :
         {&JointDef::tension, &JointDef::residual_friction_angle_deg, &JointDef::residual_cohesion, &JointDef::residual_tension})
        rest.*strength = a.*strength;
    for (const auto& [name, field] : {std::pair{"normal_stiffness", &JointDef::normal_stiffness},
                                      {"shear_stiffness", &JointDef::shear_stiffness},
                                      {"jrc", &JointDef::jrc},
                                      {"jcs", &JointDef::jcs},
                                      {"damage", &JointDef::damage},
                                      {"asperity_angle_deg", &JointDef::asperity_angle_deg},
                                      {"mobilised_angle_deg", &JointDef::mobilised_angle_deg},
                                      {"wear_length", &JointDef::wear_length},
                                      {"wear", &JointDef::wear},
                                      {"transition_stress", &JointDef::transition_stress},
                                      {"rock_cohesion", &JointDef::rock_cohesion},
                                      {"rock_friction_angle_deg", &JointDef::rock_friction_angle_deg},
                                      {"residual_displacement", &JointDef::residual_displacement},
                                      {"residual_share", &JointDef::residual_share}})
        if (rest.*field != a.*field)
            return name;
    if (rest.dilation_angle_deg != a.dilation_angle_deg)
        return "dilation_angle_deg";
    return rest == a ? "" : "a number that is no strength";
}

class StageJoints
{
  public:
    StageJoints(CaseDef& def, TomlNode& document, CaseSource& source, const ReadAgain& read_again)
        : def_(def),
          document_(document),
          source_(source),
          read_again_(read_again)
    {
    }

    std::vector<Problem> run()
    {
        for (std::size_t i = 0; i < def_.stages.size() && located_.empty(); ++i)
            if (!def_.stages[i].set.empty())
                read(i);
        return std::move(located_);
    }

  private:
    void fail(std::size_t stage, const std::string& said, const std::string& why, const std::string& remedy)
    {
        CaseProblems problems;
        problems.add(fmt::format("stage[{}].set", stage), fmt::format("stage \"{}\"", printable(def_.stages[stage].name)),
                     fmt::format("set = \"{}\"", printable(said)), why, remedy);
        const std::vector<Problem> found = source_.located(problems.errors());
        located_.insert(located_.end(), found.begin(), found.end());
    }

    /// Problems of a changed value name the --set of the command line; here it is the stage's, and stands where that does.
    void take_over(std::size_t stage, std::vector<Problem> found)
    {
        for (Problem& problem : found)
        {
            const std::string prefix = "--set ";
            if (problem.text.starts_with(prefix))
            {
                problem.key = fmt::format("stage[{}].set", stage);
                problem.text = fmt::format("stage \"{}\": set {}", printable(def_.stages[stage].name),
                                           problem.text.substr(prefix.size()));
                problem = source_.located(std::vector<Problem>{problem}).front();
            }
            located_.push_back(std::move(problem));
        }
    }

    /// A value that the stage sets is named; else what it sets is wrong only together with what stands elsewhere, and the stage's key is the place.
    void take_over_case(std::size_t stage, const std::vector<Problem>& found, const std::vector<std::string>& changes)
    {
        for (const Problem& problem : found)
        {
            const std::vector<Problem> located = source_.located(std::vector<Problem>{problem});
            const auto is_of = [&](const std::string& change) { return located[0].text.starts_with("--set " + change + ":"); };
            if (std::ranges::any_of(changes, is_of))
            {
                take_over(stage, located);
                continue;
            }
            Problem of_stage = problem;
            of_stage.key = fmt::format("stage[{}].set", stage);
            of_stage.text = fmt::format("stage \"{}\": set = \"{}\": then {}", printable(def_.stages[stage].name),
                                        fmt::join(changes, "\", \""), problem.text);
            take_over(stage, source_.located(std::vector<Problem>{of_stage}));
        }
    }

    void read(std::size_t stage)
    {
        std::vector<std::string> changes, keys;
        for (const std::string& text : def_.stages[stage].set)
        {
            const bool is_joint = text.starts_with("joint."), is_material = text.starts_with("material.");
            if (!(is_joint || is_material) || text.find('=') == std::string::npos)
                return fail(stage, text, "does not say joint.NAME.KEY = VALUE or material.NAME.density = VALUE",
                            "Write e.g. \"joint.default.friction_angle_deg = 25\".");
            const auto equals = text.find('=');
            const auto trimmed = [](std::string s)
            {
                s.erase(0, s.find_first_not_of(" \t"));
                s.erase(s.find_last_not_of(" \t") + 1);
                return s;
            };
            const Override change{trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1))};
            const std::size_t from = is_joint ? 6 : 9;
            const std::string name = change.key.substr(from, change.key.find('.', from) - from);
            if (is_joint && std::ranges::find(def_.joints, name, &JointDef::name) == def_.joints.end())
                return fail(stage, text, "no joint has this name", "Name one of [joint.NAME].");
            if (is_material && std::ranges::find(def_.materials, name, &MaterialDef::name) == def_.materials.end())
                return fail(stage, text, "no material has this name", "Name one of [material.NAME].");
            if (std::ranges::count(keys, change.key) > 0)
                return fail(stage, text, fmt::format("sets {} again", printable(change.key)), "Give each key once.");
            keys.push_back(change.key);
            changes.push_back(printable(change.key) + "=" + printable(change.value));
            take_over(stage, apply_overrides(document_, {&change, 1}, source_));
        }
        CaseDef again;
        CaseProblems problems;
        read_again_(document_, again, problems);
        if (!keeps_what_bears(stage, again.joints))
            return;
        take_over_case(stage, problems.errors(), changes);
        if (located_.empty())
            take_joints(stage, again.joints);
        if (located_.empty())
            take_materials(stage, again.materials);
    }

    [[nodiscard]] const std::vector<JointDef>& joints_before(std::size_t stage) const
    {
        for (; stage > 0; --stage)
            if (!def_.stages[stage - 1].joints.empty())
                return def_.stages[stage - 1].joints;
        return def_.joints;
    }

    [[nodiscard]] const std::vector<MaterialDef>& materials_before(std::size_t stage) const
    {
        for (; stage > 0; --stage)
            if (!def_.stages[stage - 1].materials.empty())
                return def_.stages[stage - 1].materials;
        return def_.materials;
    }

    /// Told first: what else a new law needs does not matter.
    bool keeps_what_bears(std::size_t stage, const std::vector<JointDef>& joints)
    {
        const std::vector<JointDef>& before = joints_before(stage);
        for (std::size_t j = 0; j < joints.size(); ++j)
            if (const std::string stays = changed_for_good(before[j], joints[j]); !stays.empty())
            {
                fail(stage, fmt::format("joint.{}.{} = ...", joints[j].name, stays), "contacts bear by it already",
                     fmt::format("Give it in [joint.{}]; a stage may change other numbers of the law.", joints[j].name));
                return false;
            }
        return true;
    }

    void take_joints(std::size_t stage, const std::vector<JointDef>& joints)
    {
        const std::vector<JointDef>& before = joints_before(stage);
        for (std::size_t j = 0; j < joints.size(); ++j)
        {
            const JointDef &was = before[j], &is = joints[j];
            if (needs_memory(was) != needs_memory(is))
                return fail(stage, "joint." + is.name, "the joint has no memory of slip and breaking before this stage",
                            "Give residual_cohesion in [joint." + is.name + "] too, so that it has one from the start.");
            const std::string at_once = changed_at_once(was, is);
            if (sets_over_time(def_.stages[stage]) && !at_once.empty())
                return fail(stage, fmt::format("joint.{}: {}", is.name, at_once),
                            "only strengths change over set_cycles or a table: friction, cohesion and tension",
                            "Set it in a stage without set_cycles and set_table.");
        }
        if (joints != before)
            def_.stages[stage].joints = joints;
    }

    void take_materials(std::size_t stage, const std::vector<MaterialDef>& materials)
    {
        if (materials == materials_before(stage))
            return;
        if (sets_over_time(def_.stages[stage]))
            return fail(stage, "material...", "only strengths of joints change over set_cycles or a table",
                        "Set densities in a stage without set_cycles and set_table.");
        def_.stages[stage].materials = materials;
    }

    CaseDef& def_;
    TomlNode& document_;
    CaseSource& source_;
    const ReadAgain& read_again_;
    std::vector<Problem> located_;
};
}  // namespace

std::vector<Problem> read_stage_joints(CaseDef& def, TomlNode& document, CaseSource& source, const ReadAgain& read_again)
{
    return StageJoints(def, document, source, read_again).run();
}
}  // namespace hdem
