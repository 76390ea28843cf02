#include "core/stage/rules.h"
#include "io/case_check.h"
#include "io/case_checks.h"

#include <algorithm>
#include <iterator>

namespace hdem
{
namespace
{
class RunCheck : public CaseCheck
{
  public:
    using CaseCheck::CaseCheck;

    void check()
    {
        for (std::size_t i = 0; i < def_.loads.size(); ++i)
            check_load(def_.loads[i], fmt::format("load[{}]", i), fmt::format("load \"{}\"", printable(def_.loads[i].name)));
        check_settings();
        check_factor_of_safety();
    }

  private:
    [[nodiscard]] bool fixed_by_a_stage(const std::string& name) const
    {
        return std::any_of(def_.stages.begin(), def_.stages.end(),
                           [&](const StageDef& stage)
                           { return std::find(stage.fix.begin(), stage.fix.end(), name) != stage.fix.end(); });
    }

    [[nodiscard]] bool freed_by_a_stage(const std::string& name) const
    {
        return std::ranges::any_of(def_.stages, [&](const StageDef& stage) { return std::ranges::count(stage.free, name) > 0; });
    }

    /// A force on a block that never moves, as on the wrong name.
    void check_effect(const LoadDef& load, const std::string& path, const std::string& object)
    {
        if (load.force == Vec2(0.0, 0.0) && load.moment == 0.0 && load.acceleration == Vec2(0.0, 0.0))
            return;
        for (const std::string& name : load.blocks)
        {
            const auto block = std::ranges::find(def_.blocks, name, &BlockDef::name);
            if (block != def_.blocks.end() && block->fix_x && block->fix_y && block->fix_rotation && !freed_by_a_stage(name))
                problems_.warn(path + ".blocks", object, fmt::format("blocks names \"{}\"", printable(name)),
                               "does not move it: it is fixed in all stages", "Name another block, or free it in a stage.");
        }
    }

    void check_load(const LoadDef& load, const std::string& path, const std::string& object)
    {
        check_point(load, path, object);
        check_effect(load, path, object);
        const bool any = std::any_of(std::begin(effects), std::end(effects),
                                     [&](const char* key) { return given(path + "." + key); });
        if (!any)
            problems_.add(path, object, "load", "does nothing", "Give acceleration, force, moment, or a prescribed velocity.");
        check_factor(load.factor, path, object);
        exclude(path, object, "from_cycle", "from_time");
        exclude(path, object, "until_cycle", "until_time");
        const Interval& when = load.interval;
        if (when.from_cycle && when.until_cycle && *when.until_cycle <= *when.from_cycle)
            problems_.add(path + ".until_cycle", object, fmt::format("until_cycle = {}", *when.until_cycle),
                          "the load ends before it begins", "Give more than from_cycle.");
        if (when.from_time && when.until_time && *when.until_time <= *when.from_time)
            problems_.add(path + ".until_time", object, fmt::format("until_time = {} s", *when.until_time),
                          "the load ends before it begins", "Give more than from_time.");
        if (given(path + ".blocks") && load.blocks.empty())
            problems_.add(path + ".blocks", object, "blocks = []", "names no block",
                          "Name at least one, or \"*\" for all free blocks.");

        const std::pair<const char*, bool BlockDef::*> prescribed[] = {
            {"velocity_x", &BlockDef::fix_x}, {"velocity_y", &BlockDef::fix_y}, {"angular_velocity", &BlockDef::fix_rotation}};
        for (const std::string& name : load.blocks)
        {
            if (name != "*")
                check_block_reference(path + ".blocks", object, name);
            for (const auto& [key, component] : prescribed)
            {
                if (!given(path + "." + key))
                    continue;
                const auto block = std::find_if(def_.blocks.begin(), def_.blocks.end(),
                                                [&](const BlockDef& b) { return b.name == name; });
                const bool free = name == "*" || (block != def_.blocks.end() && !((*block).*component) && !fixed_by_a_stage(name));
                if (free)
                    problems_.add(path + "." + key, object, key,
                                  fmt::format("is prescribed, but this component of {} is free",
                                              name == "*" ? "\"*\"" : "block \"" + printable(name) + "\""),
                                  "Fix it with the block's key fixed, or use a force.");
            }
        }
    }

    void check_point(const LoadDef& load, const std::string& path, const std::string& object)
    {
        if (!given(path + ".point"))
            return;
        if (!given(path + ".force") && !problems_.has(path + ".force"))
            problems_.add(path + ".point", object, "point", "belongs to force, which is not given",
                          "Give force, or remove this key.");
        if (load.blocks.size() > 1 || std::ranges::count(load.blocks, "*") > 0)
            problems_.add(path + ".point", object, "point", "is that of one block, and the load names several",
                          "Write a [[load]] for each block.");
    }

    void check_settings()
    {
        exclude("contact", "[contact]", "threshold_scale", "threshold_velocity");
        if (given("convergence.criteria") && def_.convergence.criteria.empty())
            problems_.add("convergence.criteria", "[convergence]", "criteria = []", "nothing would ever converge",
                          "Name at least one.");
        const bool ratio = def_.damping.global_damping_ratio > 0.0;
        if (ratio != (def_.damping.average_frequency > 0.0))
            problems_.add(ratio ? "damping.global_damping_ratio" : "damping.average_frequency", "[damping]",
                          ratio ? "global_damping_ratio" : "average_frequency", "has no effect: Eq. (22) is the product of both",
                          ratio ? "Give average_frequency as well." : "Give global_damping_ratio as well.");
        if (given("time.step") && given("time.fraction"))
            problems_.warn("time.fraction", "[time]", "fraction", "has no effect: step is given", "Remove one of the two.");
        check_stable_fraction();
        const std::vector<StageRules> rules = resolve_rules(def_);
        const auto undamped = [](const StageRules& stage) { return stage.damping.local == 0.0; };
        if (given("damping.local") && def_.damping.local > 0.0 && !rules.empty() && std::ranges::all_of(rules, undamped))
            problems_.warn("damping.local", "[damping]", "local", "has no effect: the preset \"dynamic\" has no local damping",
                           "Remove it, or choose another preset.");
    }

    void check_stable_fraction()
    {
        if (!given("time.stable_fraction"))
            return;
        const auto warn = [&](const char* why, const char* remedy)
        { problems_.warn("time.stable_fraction", "[time]", "stable_fraction", fmt::format("has no effect: {}", why), remedy); };
        const std::vector<StageRules> rules = resolve_rules(def_);
        if (std::ranges::any_of(rules, [](const StageRules& stage) { return stage.step.varies && !stage.step.keeps_given; }))
            return;
        if (given("time.step"))
            warn("step is given", "Remove one of the two.");
        else if (std::ranges::any_of(rules, [](const StageRules& stage) { return stage.contact.rock_keeps_springs; }))
            warn("with prescribed motions every stage keeps the step of Eq. (32)", "Remove it, or give fraction instead.");
        else
            warn("no stage runs until converged under the default damping", "Remove it, or give fraction instead.");
    }

    void check_factor_of_safety()
    {
        const FactorOfSafetyDef& def = def_.factor_of_safety;
        const std::string path = "factor_of_safety", object = "[factor_of_safety]";
        if (given(path + ".reduce") && def.reduce.empty())
            problems_.add(path + ".reduce", object, "reduce = []", "weakens nothing",
                          "Name joints, or write [\"joints\"] for all.");
        Names known = joints_;
        known.insert("joints");
        if (!def_.bolts.empty())
            known.insert("bolts");
        for (const std::string& name : def.reduce)
            check_reference(path + ".reduce", object, name, "joint", known);
        if (def.bracket.y() <= def.bracket.x())
            problems_.add(path + ".bracket", object, fmt::format("bracket = [{}, {}]", def.bracket.x(), def.bracket.y()),
                          "its end is not above its beginning", "Give the lower factor first.");
        else if (given(path + ".tolerance") && def.tolerance >= def.bracket.y() - def.bracket.x())
            problems_.add(path + ".tolerance", object, fmt::format("tolerance = {}", def.tolerance),
                          "is no less than the width of the bracket", "Give a smaller one.");
    }

    static constexpr const char* effects[] = {"acceleration", "force", "moment", "velocity_x", "velocity_y", "angular_velocity"};
};
}  // namespace

void check_run_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    RunCheck(def, source, problems).check();
}
}  // namespace hdem
