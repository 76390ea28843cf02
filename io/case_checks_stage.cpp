#include "core/stage/rules.h"
#include "io/case_check.h"
#include "io/case_checks.h"
#include "io/factor_table.h"
#include "io/stage_end_text.h"

#include <algorithm>

namespace hdem
{
namespace
{
class StageCheck : public CaseCheck
{
  public:
    using CaseCheck::CaseCheck;

    void check()
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
            check_set_table(stage, path, object);
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
    }

  private:
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
        const bool has_empty_springs = std::ranges::count(stages_with_empty_springs(def_), &stage) > 0;
        if (stage.excavate.empty() && !ends_a_boundary(stage) && !goes_on && !changes_water && !has_empty_springs)
        {
            const bool is_first = &stage == def_.stages.data();
            refuse(fmt::format("nothing is excavated, no boundary ends, no water changes, and no impulses went before{}",
                               is_first ? "; with [insitu], all weight acts from the start" : ""),
                   is_first ? "Give insitu.gradient the weight of the rock, and remove relax_cycles."
                            : "Add excavate, or remove relax_cycles.");
        }
        const std::int64_t most = stage.cycles ? *stage.cycles : stage.max_cycles;
        if (!stage.duration && stage.relax_cycles > most)
            refuse(fmt::format("is more than the stage's {} = {}", stage.cycles ? "cycles" : "max_cycles", most),
                   "Let the stage last longer, or take the forces off faster.");
    }

    /// Of the rows by which a stage sets strengths, from the case or from a file.
    void check_set_table(const StageDef& stage, const std::string& path, const std::string& object)
    {
        exclude(path, object, "set_cycles", "set_table");
        exclude(path, object, "set_cycles", "set_table_file");
        exclude(path, object, "set_table", "set_table_file");
        const std::string key = given(path + ".set_table_file") ? "set_table_file" : "set_table";
        if (given(path + ".set_table_by") && !given(path + ".set_table"))
            problems_.add(path + ".set_table_by", object, "set_table_by", "belongs to set_table, which is not given",
                          "Give set_table, or remove this key.");
        const FactorTable& rows = stage.set_table;
        if (rows.empty() || problems_.has(path + "." + key))
            return;
        const auto refuse = [&](const std::string& said, const std::string& why, const char* remedy)
        { problems_.add(path + "." + key, object, said, why, remedy); };
        const auto row_text = [&](std::size_t row)
        { return fmt::format("{}[{}] = [{}, {}]", key, row, rows[row][0], rows[row][1]); };
        if (stage.set.empty() && !problems_.has(path + ".set"))
            refuse(key, "belongs to set, which is not given", "Give set, or remove this key.");
        if (const std::size_t row = first_unsorted(rows); row > 0)
            refuse(row_text(row), fmt::format("it comes after {}", rows[row - 1][0]),
                   "Sort the rows, and keep one for each cycle or time.");
        for (std::size_t row = 0; row < rows.size(); ++row)
            if (!(rows[row][0] >= 0.0) || !(rows[row][1] >= 0.0 && rows[row][1] <= 1.0))
                return refuse(row_text(row), "times begin with the stage at 0, and shares are from 0 to 1",
                              "Give shares of the change.");
        if (rows.back()[1] != 1.0)
            refuse(row_text(rows.size() - 1), "the change is not whole at the end",
                   "End with the share 1; set other numbers if they are to be others.");
        if (const double end = rows.back()[0];
            stage.set_table_by == TableColumn::cycle && stage.cycles && end > static_cast<double>(*stage.cycles))
            refuse(row_text(rows.size() - 1), fmt::format("is more than the stage's cycles = {}", *stage.cycles),
                   "Let the stage last longer, or set the strengths faster.");
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
        if (!ends_at_rest(stage) && given(path + ".solver") && asks_for_statics(stage))
            problems_.warn(path + ".solver", object, "solver", "has no effect: the stage does not look for rest",
                           "Add \"converged\" to until, or remove this key.");
        else if (asks_for_statics(stage) && !rules_[number_of(stage)].tries_statics && def_.bolts.empty() && def_.liners.empty())
            problems_.warn(
                path + ".solver", object, "solver = \"static\"",
                "has no effect: a static solution needs gravity and the default damping, and no loads, prescribed motions, "
                "relax_to or impulse method",
                "Remove this key.");
    }

    [[nodiscard]] std::size_t number_of(const StageDef& stage) const
    {
        return static_cast<std::size_t>(&stage - def_.stages.data());
    }

    const std::vector<StageRules> rules_ = resolve_rules(def_);
};
}  // namespace

void check_stage_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    StageCheck(def, source, problems).check();
}
}  // namespace hdem
