#include "io/case_check.h"
#include "io/case_checks.h"

#include <algorithm>
#include <iterator>

namespace hdem
{
namespace
{
class HistoryCheck : public CaseCheck
{
  public:
    using CaseCheck::CaseCheck;

    void check()
    {
        for (std::size_t i = 0; i < def_.histories.size(); ++i)
            check_history(def_.histories[i], fmt::format("history[{}]", i));
    }

  private:
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
};
}  // namespace

void check_history_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    HistoryCheck(def, source, problems).check();
}
}  // namespace hdem
