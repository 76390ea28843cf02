#include "core/joint/barton_bandis.h"
#include "core/model/case_def.h"
#include "core/rock/joint_laws.h"
#include "core/stage/rules.h"
#include "io/case_check.h"
#include "io/case_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
using Keys = std::vector<const char*>;

/// Which keys a law takes besides those of every joint.
struct LawKeys
{
    const char* name;
    Keys needed, possible;
};

const std::array<LawKeys, 8>& law_keys()
{
    static const std::array<LawKeys, 8> table{
        {{"coulomb",
          {"normal_stiffness", "friction_angle_deg"},
          {"cohesion", "tension", "residual_friction_angle_deg", "residual_cohesion", "residual_tension", "dilation_angle_deg",
           "dilation_limit", "initially"}},
         {"barton_bandis", {"jrc", "jcs", "residual_friction_angle_deg"}, {"length", "damage", "rock_strength", "closure_cycle"}},
         {"patton",
          {"normal_stiffness", "friction_angle_deg", "asperity_angle_deg", "residual_friction_angle_deg", "cohesion"},
          {"dilation_limit"}},
         {"continuously_yielding",
          {"normal_stiffness", "friction_angle_deg", "mobilised_angle_deg", "wear_length"},
          {"shear_exponent"}},
         {"plesha", {"normal_stiffness", "friction_angle_deg", "asperity_angle_deg"}, {"wear"}},
         {"saeb_amadei",
          {"normal_stiffness", "friction_angle_deg", "asperity_angle_deg", "transition_stress"},
          {"rock_cohesion", "rock_friction_angle_deg", "residual_displacement", "residual_share"}},
         {"slip_weakening", {"normal_stiffness", "friction_angle_deg", "residual_friction_angle_deg", "wear_length"}, {}},
         {"*.so", {"normal_stiffness", "friction_angle_deg"}, {"parameters"}}}};
    return table;
}

class JointCheck : public CaseCheck
{
  public:
    JointCheck(const CaseDef& def, const CaseSource& source, CaseProblems& problems, const JointDef& joint)
        : CaseCheck(def, source, problems),
          joint_(joint),
          path_("joint." + joint.name + "."),
          object_(fmt::format("joint \"{}\"", printable(joint.name)))
    {
    }

    void check()
    {
        if (problems_.has(path_ + "law") && joint_.law != JointLaw::library)
            return;  // which keys and limits are right is not known
        check_keys();
        check_spring();
        check_strength();
        check_method();
    }

  private:
    void add(const char* key, const std::string& text, const std::string& remedy)
    {
        if (!problems_.has(path_ + key))
            problems_.add(path_ + key, object_, key, text, remedy);
    }

    [[nodiscard]] bool has(const char* key) const { return given(path_ + key); }

    /// Nothing is wrong with this key: what is said about others may rest on it.
    [[nodiscard]] bool is_sound(const char* key) const { return !problems_.has(path_ + key); }

    [[nodiscard]] bool closes_by_bandis() const
    {
        return joint_.law == JointLaw::barton_bandis && joint_.rock_strength.has_value();
    }

    void check_keys()
    {
        const LawKeys& own = law_keys()[static_cast<std::size_t>(joint_.law)];
        for (const char* key : own.needed)
            if (!has(key))
                add(key, "is missing", fmt::format("Add it: law \"{}\" needs it.", own.name));
        const auto takes = [&](const char* key)
        {
            const auto is_key = [&](const char* k) { return std::string_view(k) == key; };
            return std::ranges::any_of(own.needed, is_key) || std::ranges::any_of(own.possible, is_key) ||
                   std::string_view(key) == "normal_stiffness";
        };
        for (const LawKeys& law : law_keys())
            for (const Keys& keys : {law.needed, law.possible})
                for (const char* key : keys)
                    if (has(key) && !takes(key))
                        add(key, fmt::format("does not belong to law \"{}\"", own.name),
                            fmt::format("Remove it, or give law = \"{}\".", law.name));
    }

    void check_spring()
    {
        if (closes_by_bandis())
            for (const char* key : {"normal_stiffness", "greatest_closure", "normal_exponent"})
                if (has(key))
                    add(key, "contradicts rock_strength, which gives the closure by Bandis", "Remove one of the two.");
        if (joint_.law == JointLaw::barton_bandis && !closes_by_bandis() && !has("normal_stiffness"))
            add("normal_stiffness", "is missing, and so is rock_strength", "Add one of the two.");
        exclude("joint." + joint_.name, object_, "greatest_closure", "normal_exponent");
        for (const char* key : {"greatest_closure", "normal_exponent"})
            if (joint_.law == JointLaw::library && has(key))
                add(key, "does not belong to a law of a shared library, which has its own normal spring", "Remove it.");
        if (joint_.law == JointLaw::saeb_amadei && joint_.normal_exponent)
            add("normal_exponent", "is not possible with saeb_amadei", "Give greatest_closure, or a linear spring.");
        if (closes_by_bandis() && !(joint_.rock_strength >= joint_.jcs))
            add("rock_strength", "is less than jcs: the walls of a joint are no stronger than its rock",
                "Give the greater of the two.");
        if (closes_by_bandis() && joint_.jrc > 0.0 && joint_.jcs > 0.0)
        {
            const BandisClosure closure = bandis_closure(joint_.jrc, joint_.jcs, *joint_.rock_strength, joint_.closure_cycle);
            if (!(closure.stiffness > 0.0 && closure.greatest > 0.0))
                add("rock_strength",
                    fmt::format("gives an initial stiffness of {:.4g} Pa/m and a greatest closure of {:.4g} m by Bandis",
                                closure.stiffness, closure.greatest),
                    "The numbers are outside of what was measured: give normal_stiffness and greatest_closure instead.");
        }
        if (has("closure_cycle") && !closes_by_bandis())
            add("closure_cycle", "belongs to rock_strength, which is not given", "Remove it.");
    }

    void check_strength()
    {
        const double friction = joint_.friction_angle_deg, residual = joint_.residual_friction_angle_deg.value_or(friction);
        const auto tangent = [](double degrees) { return std::tan(degrees * std::numbers::pi / 180.0); };
        if ((joint_.law == JointLaw::coulomb || joint_.law == JointLaw::slip_weakening) && residual > friction &&
            is_sound("friction_angle_deg"))
            add("residual_friction_angle_deg", "is greater than friction_angle_deg", "Give no more than that.");
        if (joint_.law == JointLaw::coulomb)
        {
            if (is_sound("cohesion") && joint_.residual_cohesion.value_or(0.0) > joint_.cohesion)
                add("residual_cohesion", "is greater than cohesion", "Give no more than that.");
            if (is_sound("tension") && joint_.residual_tension.value_or(0.0) > joint_.tension.value_or(0.0))
                add("residual_tension", "is greater than tension", "Give no more than that.");
            if (is_sound("friction_angle_deg") && is_sound("residual_friction_angle_deg") &&
                joint_.dilation_angle_deg.value_or(0.0) > residual)
                add("dilation_angle_deg",
                    fmt::format("is greater than the residual friction angle, {}: slip would make energy", residual),
                    "Give no more than that.");
            if (has("dilation_limit") && !has("dilation_angle_deg") && !problems_.has(path_ + "dilation_limit") &&
                !problems_.has(path_ + "dilation_angle_deg"))
                problems_.add(path_ + "dilation_limit", object_, fmt::format("dilation_limit = {}", *joint_.dilation_limit),
                              "belongs to dilation_angle_deg, which is not given", "Give dilation_angle_deg, or remove this key.");
            if (is_sound("cohesion") && is_sound("friction_angle_deg") &&
                joint_.tension.value_or(0.0) * tangent(friction) > joint_.cohesion * (1.0 + 1e-9))
                add("tension",
                    fmt::format("is greater than cohesion / tan(friction) = {:.6g} Pa", joint_.cohesion / tangent(friction)),
                    "Give less, or more cohesion.");
            if (has("tension") && joint_.normal_exponent)
                add("tension", "is not possible with normal_exponent: K_N is 0 at no stress", "Remove one of the two.");
        }
        if (joint_.law == JointLaw::patton && friction + joint_.asperity_angle_deg >= 90.0)
            add("asperity_angle_deg", "and friction_angle_deg are 90 degrees or more together", "Give less.");
        if (joint_.law == JointLaw::patton && friction + joint_.asperity_angle_deg <= residual)
            add("residual_friction_angle_deg", "is no less than friction_angle_deg and asperity_angle_deg together", "Give less.");
        if ((joint_.law == JointLaw::plesha || joint_.law == JointLaw::saeb_amadei) && friction + joint_.asperity_angle_deg >= 90.0)
            add("asperity_angle_deg", "and friction_angle_deg are 90 degrees or more together", "Give less.");
        if (joint_.law == JointLaw::plesha && joint_.asperity_angle_deg > friction)
            problems_.warn(
                path_ + "asperity_angle_deg", object_, fmt::format("asperity_angle_deg = {}", joint_.asperity_angle_deg),
                fmt::format("is above friction_angle_deg = {}: the joint has no strength where it slips back down", friction),
                "Give no more than the friction angle, or a greater friction_angle_deg.");
        if (joint_.law == JointLaw::continuously_yielding && joint_.mobilised_angle_deg < friction)
            add("mobilised_angle_deg", "is less than friction_angle_deg", "Give no less than that.");
        if (joint_.law == JointLaw::barton_bandis && has("residual_friction_angle_deg") && residual <= 0.0)
            add("residual_friction_angle_deg", "must be > 0 for barton_bandis", "Give a greater one.");
        if (joint_.law == JointLaw::barton_bandis && residual >= 70.0)
            add("residual_friction_angle_deg", "is 70 degrees or more: the law ends there", "Give less.");
    }

    void check_method()
    {
        if (!has_impulses_alone(def_))
            return;
        if (joint_.law == JointLaw::library)
            add("law", "of a shared library cannot be computed by impulses", "Use method \"force\" or \"hybrid\" in all stages.");
        for (const char* key : {"greatest_closure", "normal_exponent", "rock_strength"})
            if (has(key))
                add(key, "cannot be computed by impulses, which know no stiffness",
                    "Use method \"force\" or \"hybrid\" in all stages.");
    }

    const JointDef& joint_;
    std::string path_, object_;
};
}  // namespace

namespace
{
/// A key of a joint that breaks for good; "" where it does not.
std::string key_that_breaks(const JointDef& joint)
{
    if (joint.law != JointLaw::coulomb || joint.initially == JointStart::broken)
        return "";
    if (joint.residual_cohesion && *joint.residual_cohesion < joint.cohesion)
        return "residual_cohesion";
    return joint.tension && *joint.tension > 0.0 && joint.residual_tension.value_or(0.0) < *joint.tension ? "tension" : "";
}

/// Without cohesion, strength grows with the stress, and a point that slips under the smallest weight falls to its residual friction for good.
bool breaks_without_stress(const JointDef& joint)
{
    return joint.law == JointLaw::coulomb && joint.initially != JointStart::broken && joint.cohesion == 0.0 &&
           joint.residual_friction_angle_deg && *joint.residual_friction_angle_deg < joint.friction_angle_deg;
}

/// While springs swing for the first time, shear and normal forces are not in the ratio in which rest has them, however slowly the weight grows.
void warn_of_joints_that_break_without_stress(const CaseDef& def, CaseProblems& problems)
{
    if (def.gravity.norm() == 0.0)
        return;
    for (const StageDef* stage : stages_with_empty_springs(def))
        for (const JointDef& joint : def.joints)
            if (breaks_without_stress(joint) && ends_at_rest(*stage) && stage->set.empty())
                problems.warn(
                    fmt::format("joint.{}.residual_friction_angle_deg", joint.name),
                    fmt::format("joint \"{}\"", printable(joint.name)), "residual_friction_angle_deg",
                    fmt::format("holds for good where a point slips, and stage \"{}\" begins without stress: in the first "
                                "swings points may slip that bear at rest, also while relax_cycles lets the weight grow",
                                printable(stage->name)),
                    "Begin with residual_friction_angle_deg = friction_angle_deg, and set the lower one in a later stage; "
                    "or give [insitu].");
}

/// A weight that acts at once is felt up to 1 + sqrt((1 - alpha) / (1 + alpha)) times: 1.33 at alpha = 0.8. What breaks then stays broken.
void warn_of_joints_that_break_at_once(const CaseDef& def, CaseProblems& problems)
{
    if (def.gravity.norm() == 0.0)
        return;
    for (const StageDef* stage : stages_with_empty_springs(def))
        for (const JointDef& joint : def.joints)
        {
            const std::string key = key_that_breaks(joint);
            if (key.empty() || !ends_at_rest(*stage) || !stage->set.empty() || stage->relax_cycles > 0)
                continue;
            const bool is_first = stage == &def.stages.front();
            problems.warn(
                fmt::format("joint.{}.{}", joint.name, key), fmt::format("joint \"{}\"", printable(joint.name)), key,
                fmt::format("breaks for good, and stage \"{}\" begins with {}: the weight that acts at once is felt up to "
                            "1.33 times until the rock is at rest",
                            printable(stage->name), is_first ? "rock without stress" : "springs without force, after impulses"),
                fmt::format("Let the weight grow: relax_cycles = 5000 in that stage{}.", is_first ? "; or give [insitu]" : ""));
        }
}
}  // namespace

void check_joint_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    for (const JointDef& joint : def.joints)
        JointCheck(def, source, problems, joint).check();
    warn_of_joints_that_break_at_once(def, problems);
    warn_of_joints_that_break_without_stress(def, problems);
    const auto remembers = std::ranges::find_if(def.joints, needs_memory);
    for (std::size_t i = 0; i < def.stages.size() && remembers != def.joints.end(); ++i)
        if (asks_for_statics(def.stages[i]))
            problems.warn(
                fmt::format("stage[{}].solver", i), fmt::format("stage \"{}\"", printable(def.stages[i].name)),
                "solver = \"static\"",
                fmt::format("has no effect: joint \"{}\" has a memory, and static solutions know none", printable(remembers->name)),
                "Rest is found by cycles; remove this key.");
}
}  // namespace hdem
