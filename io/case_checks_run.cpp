#include "core/stage/rules.h"
#include "io/case_check.h"
#include "io/case_checks.h"
#include "io/stage_end_text.h"

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
            check_load(def_.loads[i], fmt::format("load[{}]", i), fmt::format("load {}", i + 1));
        check_settings();
        check_stages();
        check_factor_of_safety();
        for (std::size_t i = 0; i < def_.histories.size(); ++i)
            check_history(def_.histories[i], fmt::format("history[{}]", i));
    }

  private:
    [[nodiscard]] bool fixed_by_a_stage(const std::string& name) const
    {
        return std::any_of(def_.stages.begin(), def_.stages.end(),
                           [&](const StageDef& stage)
                           { return std::find(stage.fix.begin(), stage.fix.end(), name) != stage.fix.end(); });
    }

    void check_load(const LoadDef& load, const std::string& path, const std::string& object)
    {
        check_point(load, path, object);
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

    /// Does a boundary act in the stage before this one, and no more in this one?
    [[nodiscard]] bool ends_a_boundary(const StageDef& stage) const
    {
        if (&stage == def_.stages.data())
            return false;
        const StageDef& before = *(&stage - 1);
        return std::ranges::any_of(def_.boundaries,
                                   [&](const BoundaryDef& boundary) {
                                       return std::ranges::count(boundary.stages, before.name) > 0 &&
                                              std::ranges::count(boundary.stages, stage.name) == 0;
                                   });
    }

    void check_relaxation(const StageDef& stage, const std::string& path, const std::string& object)
    {
        if (stage.relax_to > 0.0 && stage.relax_cycles == 0 && !problems_.has(path + ".relax_cycles"))
            problems_.add(path + ".relax_to", object, fmt::format("relax_to = {}", stage.relax_to),
                          "belongs to relax_cycles, which is not given", "Give relax_cycles, or remove this key.");
        if (stage.relax_cycles == 0)
            return;
        const bool goes_on = &stage != def_.stages.data() && (&stage - 1)->relax_to > 0.0;
        const auto refuse = [&](const std::string& why, const char* remedy)
        { problems_.add(path + ".relax_cycles", object, fmt::format("relax_cycles = {}", stage.relax_cycles), why, remedy); };
        const bool changes_water = stage.water_level || !stage.water_table.empty();
        if (stage.excavate.empty() && !ends_a_boundary(stage) && !goes_on && !changes_water)
            refuse("nothing is excavated, no boundary ends, and no water changes", "Add excavate, or remove relax_cycles.");
        const std::int64_t most = stage.cycles ? *stage.cycles : stage.max_cycles;
        if (!stage.duration && stage.relax_cycles > most)
            refuse(fmt::format("is more than the stage's {} = {}", stage.cycles ? "cycles" : "max_cycles", most),
                   "Let the stage last longer, or take the forces off faster.");
    }

    void check_set_cycles(const StageDef& stage, const std::string& path, const std::string& object)
    {
        if (stage.set_cycles == 0)
            return;
        const auto refuse = [&](const std::string& why, const char* remedy)
        { problems_.add(path + ".set_cycles", object, fmt::format("set_cycles = {}", stage.set_cycles), why, remedy); };
        if (stage.set.empty() && !problems_.has(path + ".set"))
            refuse("belongs to set, which is not given", "Give set, or remove this key.");
        const std::int64_t most = stage.cycles ? *stage.cycles : stage.max_cycles;
        if (!stage.duration && stage.set_cycles > most)
            refuse(fmt::format("is more than the stage's {} = {}", stage.cycles ? "cycles" : "max_cycles", most),
                   "Let the stage last longer, or give fewer.");
    }

    /// Of one end of a stage, its names.
    void check_end(const StageEndDef& end, const std::string& key, const std::string& object)
    {
        const auto refuse = [&](const std::string& why, const std::string& remedy)
        { problems_.add(key, object, fmt::format("until = \"{}\"", printable(end.text)), why, remedy); };
        if (const ReadStageEnd read = read_stage_end(end.text); !read.why.empty())
            return refuse(read.why, read.remedy);
        for (const std::string& name : end.blocks)
            check_block_reference(key, object, name);
        if (end.quantity != EndQuantity::history)
            return;
        Names names;
        for (const HistoryDef& history : def_.histories)
            names.insert(history.name);
        check_reference(key, object, end.history, "history", names);
        const auto history = std::ranges::find(def_.histories, end.history, &HistoryDef::name);
        if (history == def_.histories.end())
            return;
        const auto& fitting = fitting_quantities(*history);
        if (std::ranges::count(fitting, end.column + "_x") > 0)
            refuse(fmt::format("{} has two columns", end.column), fmt::format("Write {0}_x or {0}_y.", end.column));
        else if (std::ranges::count(fitting, end.column) == 0)
            refuse("this history has no such column", "Choose from " + quoted_list(fitting) + ".");
    }

    void check_until(const StageDef& stage, const std::string& path, const std::string& object)
    {
        if (given(path + ".until") && !ends_at_rest(stage) && stage.ends.empty() && !problems_.has(path + ".until"))
            problems_.add(path + ".until", object, "until = []", "names no end", "Name at least one, e.g. \"converged\".");
        for (const StageEndDef& end : stage.ends)
            check_end(end, path + ".until", object);
        if (ends_at_rest(stage) || stage.ends.empty())
            return;
        if (given(path + ".solver") && asks_for_statics(stage))
            problems_.warn(path + ".solver", object, "solver", "has no effect: the stage does not look for rest",
                           "Add \"converged\" to until, or remove this key.");
    }

    [[nodiscard]] const std::vector<std::string>& fitting_quantities(const HistoryDef& history) const
    {
        if (!history.bolt.empty() || !history.liner.empty())
            return history.bolt.empty() ? liner_quantities() : bolt_quantities();
        return history.point ? point_quantities() : (history.between.empty() ? block_quantities() : contact_quantities());
    }

    void check_stages()
    {
        if (def_.stages.empty() && !problems_.has("stage"))
            problems_.add("stage", "case", "[[stage]]", "is missing: nothing would be run", "Add one, e.g. with cycles = 5000.");
        Names removed;
        for (std::size_t i = 0; i < def_.stages.size(); ++i)
        {
            const StageDef& stage = def_.stages[i];
            const std::string path = fmt::format("stage[{}]", i);
            const std::string object = fmt::format("stage \"{}\"", printable(stage.name));
            exclude(path, object, "cycles", "duration");
            exclude(path, object, "cycles", "until");
            exclude(path, object, "duration", "until");
            const bool ends = given(path + ".cycles") || given(path + ".duration") || given(path + ".until") ||
                              problems_.has(path + ".cycles") || problems_.has(path + ".duration") ||
                              problems_.has(path + ".until");
            if (!ends)
                problems_.add(path, object, "cycles, duration, until", "none is given: the stage has no end",
                              "Give exactly one of them.");
            if (given(path + ".max_cycles") && ends && !given(path + ".until"))
                problems_.add(path + ".max_cycles", object, "max_cycles", "limits a stage with until",
                              "Use cycles, or add until, e.g. until = \"converged\".");
            check_until(stage, path, object);
            check_relaxation(stage, path, object);
            check_set_cycles(stage, path, object);
            for (const std::string& name : stage.excavate)
            {
                check_block_reference(path + ".excavate", object, name, "excavation or block", excavations_);
                if (!removed.insert(name).second)
                    problems_.add(path + ".excavate", object, fmt::format("excavate = \"{}\"", printable(name)),
                                  "is removed already", "Remove it once.");
            }
            for (const std::string& name : stage.fix)
                check_block_reference(path + ".fix", object, name);
            for (const std::string& name : stage.free)
            {
                check_block_reference(path + ".free", object, name);
                if (std::find(stage.fix.begin(), stage.fix.end(), name) != stage.fix.end())
                    problems_.add(path + ".free", object, fmt::format("free = \"{}\"", printable(name)), "the same stage fixes it",
                                  "Choose one.");
            }
        }
        for (std::size_t i = 0; i < def_.excavations.size(); ++i)
            if (const auto& name = def_.excavations[i].name; !removed.contains(name))
                problems_.warn(fmt::format("excavation[{}]", i), fmt::format("excavation \"{}\"", printable(name)), "excavate",
                               "no stage removes it", fmt::format("Add excavate = [\"{}\"] to a stage.", printable(name)));
    }

    static const char* owner_of(const std::string& quantity)
    {
        const auto has = [&](const std::vector<std::string>& all)
        { return std::find(all.begin(), all.end(), quantity) != all.end(); };
        if (has(block_quantities()))
            return "block";
        if (has(point_quantities()))
            return "point, a place";
        return has(bolt_quantities()) ? "bolt" : (has(liner_quantities()) ? "liner" : "between, the contacts of two blocks");
    }

    void check_history(const HistoryDef& history, const std::string& path)
    {
        const std::string object = fmt::format("history \"{}\"", printable(history.name));
        const bool block = given(path + ".block");
        const bool between = given(path + ".between");
        const bool bolt = given(path + ".bolt");
        const bool liner = given(path + ".liner");
        const bool point = given(path + ".point");
        const char* const owners[] = {"block", "between", "bolt", "liner", "point"};
        for (std::size_t k = 0; k < std::size(owners); ++k)
            for (std::size_t j = 0; j < k; ++j)
                exclude(path, object, owners[j], owners[k]);
        if (!block && !between && !bolt && !liner && !point && !problems_.has(path + ".block") &&
            !problems_.has(path + ".between") && !problems_.has(path + ".point"))
            problems_.add(
                path, object, "block, between, point", "none is given",
                "Give block = \"NAME\", between = [\"NAME\", \"NAME\"], bolt = \"NAME\", liner = \"NAME\" or point = [x, y].");
        if (block && !problems_.has(path + ".block"))
            check_block_reference(path + ".block", object, history.block);
        if (between && !problems_.has(path + ".between") &&
            (history.between.size() != 2 || history.between[0] == history.between[1]))
            problems_.add(path + ".between", object, "between", "must name two different blocks", "Write [\"NAME\", \"NAME\"].");
        for (const std::string& name : history.between)
            check_block_reference(path + ".between", object, name);

        if (given(path + ".quantities") && history.quantities.empty())
            problems_.add(path + ".quantities", object, "quantities = []", "names nothing to sample", "Name at least one.");
        const auto& fitting = fitting_quantities(history);
        if (point && !def_.water.given)
            problems_.warn(path + ".point", object, "point", "there is no water: the pressure is 0 everywhere", "Add [water].");
        Names seen;
        for (const std::string& quantity : history.quantities)
            if (block + between + bolt + liner + point == 1 && std::find(fitting.begin(), fitting.end(), quantity) == fitting.end())
                problems_.add(path + ".quantities", object, fmt::format("quantities = \"{}\"", quantity),
                              fmt::format("belongs to {}", owner_of(quantity)), "Choose from " + quoted_list(fitting) + ".");
            else if (!seen.insert(quantity).second)
                problems_.add(path + ".quantities", object, fmt::format("quantities = \"{}\"", quantity), "is listed twice",
                              "List it once.");
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
