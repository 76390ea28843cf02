#include "io/case_check.h"
#include "io/case_checks.h"

#include <algorithm>

namespace hdem
{
namespace
{
class WaterCheck : public CaseCheck
{
  public:
    using CaseCheck::CaseCheck;

    void check()
    {
        if (!def_.water.given)
            check_absent();
        else
            check_water();
        for (std::size_t i = 0; i < def_.stages.size(); ++i)
            check_stage(i);
    }

  private:
    void check_absent()
    {
        if (problems_.has("water"))
            return;
        for (std::size_t i = 0; i < def_.water_cracks.size(); ++i)
            needs_water(fmt::format("water_crack[{}]", i), fmt::format("water crack {}", i + 1), "[[water_crack]]");
        for (std::size_t i = 0; i < def_.stages.size(); ++i)
            for (const char* key : {"water_level", "water_table"})
                if (given(fmt::format("stage[{}].{}", i, key)))
                    needs_water(fmt::format("stage[{}].{}", i, key), fmt::format("stage \"{}\"", printable(def_.stages[i].name)),
                                key);
    }

    void needs_water(const std::string& key, const std::string& object, const std::string& said)
    {
        problems_.add(key, object, said, "there is no [water]", "Add [water]; it may be empty, with a level given by stages.");
    }

    void check_water()
    {
        exclude("water", "[water]", "level", "table");
        for (const char* key : {"level", "table"})
            exclude("water", "[water]", key, "pressure");
        const bool is_field_alone = !def_.water.pressure.empty() && def_.water_cracks.empty();
        if (def_.gravity.isZero() && !is_field_alone && !problems_.has("gravity"))
            problems_.add("water", "[water]", "gravity", "is 0: water has no weight", "Give gravity, or remove [water].");
        const bool has_water = def_.water.level || !def_.water.table.empty() || !def_.water.pressure.empty() ||
                               !def_.water_cracks.empty() ||
                               std::ranges::any_of(def_.stages, [](const StageDef& stage)
                                                   { return stage.water_level || !stage.water_table.empty(); });
        if (!has_water && !problems_.has("water.level") && !problems_.has("water.table"))
            problems_.warn("water", "[water]", "level",
                           "is missing, and so are table, pressure, [[water_crack]] and levels of stages: there is no water",
                           "Give one of them, or remove [water].");
        if (given("water.joints") && !problems_.has("water.joints") && def_.water.joints.empty())
            problems_.add("water.joints", "[water]", "joints = []", "no joint would have water",
                          "Name a joint, or remove this key.");
        for (const std::string& name : def_.water.joints)
            check_reference("water.joints", "[water]", name, "joint", joints_);
        for (const std::string& name : def_.water.flooded)
            check_reference("water.flooded", "[water]", name, "excavation", excavations_);
        if (!def_.water.flooded.empty() && !def_.water.ponded)
            problems_.warn("water.flooded", "[water]", "flooded",
                           "has no effect with ponded = false: water presses on joints only, and an opening that is flooded is as "
                           "one that is drained",
                           "Remove one of the two.");
        for (std::size_t i = 0; i < def_.water_cracks.size(); ++i)
            check_crack(fmt::format("water_crack[{}]", i), fmt::format("water crack {}", i + 1), def_.water_cracks[i]);
    }

    void check_crack(const std::string& path, const std::string& object, const WaterCrackDef& crack)
    {
        if (crack.crack.empty() || crack.outlet.empty())
            return;  // told already
        if (crack.outlet.front() != crack.crack.back())
            problems_.add(path + ".outlet", object, "outlet",
                          fmt::format("begins at [{}, {}], and the crack ends at [{}, {}]", crack.outlet.front().x(),
                                      crack.outlet.front().y(), crack.crack.back().x(), crack.crack.back().y()),
                          "Begin it with the last point of the crack, its foot.");
        check_line(path, object, "crack", crack.crack);
        check_line(path, object, "outlet", crack.outlet);
    }

    void check_line(const std::string& path, const std::string& object, const char* key, const Polygon& line)
    {
        const auto twice = std::ranges::adjacent_find(line);
        if (twice != line.end())
            problems_.add(path + "." + key, object, key, fmt::format("has the point [{}, {}] twice", twice->x(), twice->y()),
                          "Remove one.");
    }

    void check_stage(std::size_t i)
    {
        const std::string path = fmt::format("stage[{}]", i);
        const std::string object = fmt::format("stage \"{}\"", printable(def_.stages[i].name));
        exclude(path, object, "water_level", "water_table");
        for (const char* key : {"water_level", "water_table"})
            if (given(path + "." + key) && !def_.water.pressure.empty())
                problems_.add(path + "." + key, object, key, "has no effect: water.pressure gives the pressure",
                              "Remove one of the two.");
    }
};
}  // namespace

void check_water_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    WaterCheck(def, source, problems).check();
}
}  // namespace hdem
