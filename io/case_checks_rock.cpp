#include "io/case_check.h"
#include "io/case_checks.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace hdem
{
namespace
{
class RockCheck : public CaseCheck
{
  public:
    using CaseCheck::CaseCheck;

    void check()
    {
        check_rock();
        check_domain();
        for (std::size_t i = 0; i < def_.excavations.size(); ++i)
            check_excavation(def_.excavations[i], fmt::format("excavation[{}]", i));
        check_regions();
        check_voronoi();
        if (def_.insitu.given)
            check_insitu();
    }

  private:
    void check_rock()
    {
        if (given("blocks_file") && def_.blocks_file.empty() && !problems_.has("blocks_file"))
            problems_.add("blocks_file", "case", "blocks_file = \"\"", "names no file", "Give its name, or remove this key.");
        const bool meant = problems_.has("domain") || problems_.has("block") || problems_.has("blocks_file");
        if (!def_.domain.given && def_.blocks.empty() && def_.blocks_file.empty() && !meant)
            problems_.add("domain", "case", "[domain], [[block]] and blocks_file", "none is given: there is no rock",
                          "Give a [domain], or at least one [[block]].");
        for (const char* list : {"fault", "region", "joint_set", "excavation"})
            if (given(list) && !def_.domain.given && !problems_.has("domain"))
                problems_.add(list, "case", fmt::format("[[{}]]", list), "cuts the domain only, and there is no [domain]",
                              "Give a [domain], or cut the blocks yourself.");
    }

    void check_domain()
    {
        const DomainDef& domain = def_.domain;
        if (!domain.given)
            return;
        for (const char* key : {"traces_joint", "traces_snap"})
            if (given(std::string("domain.") + key) && domain.traces_file.empty())
                problems_.add(std::string("domain.") + key, "[domain]", key, "belongs to traces_file, which is not given",
                              "Give traces_file, or remove this key.");
        if (given("domain.bottom") && !given("domain.profile"))
            problems_.add("domain.bottom", "[domain]", "bottom", "belongs to profile, which is not given",
                          "Give profile, or remove this key.");
        if (given("domain.profile"))
        {
            for (const char* key : {"width", "height", "origin", "polygon"})
                exclude("domain", "[domain]", "profile", key);
            if (!given("domain.bottom"))
                problems_.add("domain.bottom", "[domain]", "bottom", "is missing: a profile is the upper side only",
                              "Give the y of the lower side in m.");
            if (std::ranges::find(domain.fixed, "top") != domain.fixed.end())
                problems_.add("domain.fixed", "[domain]", "fixed = \"top\"", "is not one side: the domain ends at a profile",
                              "Use fixed_edges: from 2 on they run along the profile from the right to the left.");
        }
        else if (given("domain.polygon"))
        {
            for (const char* key : {"width", "height", "origin"})
                exclude("domain", "[domain]", "polygon", key);
            if (given("domain.fixed"))
                problems_.add("domain.fixed", "[domain]", "fixed", "names sides of a rectangle, and the domain is a polygon",
                              "Use fixed_edges = [0, ...]: 0 is the edge from the first to the second vertex.");
        }
        else
        {
            for (const char* key : {"width", "height"})
                if (!given(std::string("domain.") + key))
                    problems_.add(std::string("domain.") + key, "[domain]", key, "is missing",
                                  "Give width and height in m, or a polygon.");
            if (given("domain.fixed_edges"))
                problems_.add("domain.fixed_edges", "[domain]", "fixed_edges",
                              "numbers edges of a polygon, and the domain is a rectangle",
                              "Use fixed = [\"left\", \"bottom\", ...].");
        }
    }

    void check_joint_set(const JointSetDef& set, const std::string& path, const Names& faults)
    {
        const std::string object = fmt::format("joint set \"{}\"", printable(set.name));
        const auto has = [&](const char* key) { return given(path + "." + key); };
        const auto refuse = [&](const char* key, const std::string& why, const std::string& remedy)
        {
            if (has(key))
                problems_.add(path + "." + key, object, key, why, remedy);
        };
        const auto require = [&](const char* key, const char* why, const char* remedy)
        {
            if (!has(key))
                problems_.add(path + "." + key, object, key, why, remedy);
        };
        exclude(path, object, "dip_deg", "orientation");
        if (!has("orientation"))
            require("dip_deg", "is missing", "Add it: a number in deg or a distribution, e.g. dip_deg = -30.0.");
        exclude(path, object, "spacing", "p21");
        exclude(path, object, "gap", "p21");
        exclude(path, object, "origin", "p21");
        if (!has("p21"))
            require("spacing", "is missing", "Add it: a number in m or a distribution, e.g. spacing = 2.0.");
        if (set.dip_law.is_random())
            refuse("deviation_deg", "contradicts the distribution of dip_deg", "Remove one of the two.");
        if (!has("trace"))
            for (const char* key : {"gap", "p21"})
                refuse(key, "belongs to trace, which is not given", "Give trace, or remove this key.");
        else if (!has("p21"))
            require("gap", "is missing: joints of finite length have a gap between them, or a p21",
                    "Give the length of the rock bridges in m, or p21 instead of spacing.");
        if (has("trace") || has("stops_at"))
            refuse("persistence", "is for through-going joints", "Give trace and gap instead.");
        for (std::size_t i = 0; i < set.stops_at.size(); ++i)
            if (!problems_.has("fault"))
                check_stop(set.stops_at[i], path, object, faults);
    }

    void check_stop(const std::string& name, const std::string& path, const std::string& object, const Names& faults)
    {
        if (!faults.contains(name))
            check_reference(path + ".stops_at", object, name, "fault", faults);
    }

    void check_voronoi()
    {
        const VoronoiDef& voronoi = def_.voronoi;
        if (!voronoi.given)
            return;
        if (!def_.domain.given && !problems_.has("domain"))
            problems_.add("voronoi", "[voronoi]", "[voronoi]", "fills the domain only, and there is no [domain]",
                          "Give a [domain].");
        Names regions;
        for (const RegionDef& region : def_.regions)
            regions.insert(region.name);
        if (!voronoi.region.empty() && !problems_.has("region"))
            check_reference("voronoi.region", "[voronoi]", voronoi.region, "region", regions);
        if (!voronoi.joint.empty())
            check_reference("voronoi.joint", "[voronoi]", voronoi.joint, "joint", joints_);
    }

    void check_excavation(const ExcavationDef& excavation, const std::string& path)
    {
        const std::string object = fmt::format("excavation \"{}\"", printable(excavation.name));
        if (!given(path + ".shape") || problems_.has(path + ".shape"))
            return;
        static const std::map<OutlineShape, std::pair<std::string, Names>> needs = {
            {OutlineShape::horseshoe, {"horseshoe", {"position", "width", "height"}}},
            {OutlineShape::rectangle, {"rectangle", {"position", "width", "height"}}},
            {OutlineShape::circle, {"circle", {"position", "diameter"}}},
            {OutlineShape::polygon, {"polygon", {"polygon"}}}};
        const auto& [shape, keys] = needs.at(excavation.shape);
        for (const std::string key : {"position", "width", "height", "diameter", "polygon"})
            if (keys.contains(key) && !given(path + "." + key))
                problems_.add(path + "." + key, object, key, fmt::format("is missing: a {} needs it", shape), "Add it.");
            else if (!keys.contains(key) && given(path + "." + key))
                problems_.add(path + "." + key, object, key, fmt::format("a {} has none", shape),
                              "Remove it, or choose another shape.");
        const bool arc = excavation.shape == OutlineShape::horseshoe || excavation.shape == OutlineShape::circle;
        if (!arc && given(path + ".arc_segments"))
            problems_.add(path + ".arc_segments", object, "arc_segments", fmt::format("a {} has no arc", shape), "Remove it.");
    }

    void check_regions()
    {
        Names faults, regions;
        for (const FaultDef& fault : def_.faults)
            faults.insert(fault.name);
        for (const RegionDef& region : def_.regions)
            regions.insert(region.name);
        const auto check =
            [&](const std::string& key, const std::string& object, const std::string& name, const char* what, const Names& known)
        {
            if (!name.empty() && !problems_.has(what))
                check_reference(key, object, name, what, known);
        };
        for (std::size_t i = 0; i < def_.faults.size(); ++i)
            check(fmt::format("fault[{}].joint", i), fmt::format("fault \"{}\"", printable(def_.faults[i].name)),
                  def_.faults[i].joint, "joint", joints_);
        for (std::size_t i = 0; i < def_.regions.size(); ++i)
        {
            const RegionDef& region = def_.regions[i];
            const std::string path = fmt::format("region[{}]", i);
            const std::string object = fmt::format("region \"{}\"", printable(region.name));
            check(path + ".above", object, region.above, "fault", faults);
            check(path + ".below", object, region.below, "fault", faults);
            check(path + ".material", object, region.material, "material", materials_);
            check(path + ".joint", object, region.joint, "joint", joints_);
            if (!region.joint.empty() && !given(path + ".polygon"))
                problems_.add(path + ".joint", object, "joint", "belongs to polygon, which is not given",
                              "Give the fault its joint, or remove this key.");
        }
        for (std::size_t i = 0; i < def_.joint_sets.size(); ++i)
        {
            const JointSetDef& set = def_.joint_sets[i];
            const std::string object = fmt::format("joint set \"{}\"", printable(set.name));
            check(fmt::format("joint_set[{}].region", i), object, set.region, "region", regions);
            check(fmt::format("joint_set[{}].outside", i), object, set.outside, "region", regions);
            check_joint_set(set, fmt::format("joint_set[{}]", i), faults);
            for (std::size_t j = 0; j < i; ++j)
                if (have_same_joints(def_.joint_sets[j], set))
                    problems_.warn(
                        fmt::format("joint_set[{}]", i), object, "dip_deg, spacing and origin",
                        fmt::format("are those of \"{}\": its joints are cut already", printable(def_.joint_sets[j].name)),
                        "Correct one of them, or remove this set.");
        }
    }

    /// Joint for joint, and nothing about them is drawn.
    static bool have_same_joints(const JointSetDef& a, const JointSetDef& b)
    {
        const auto is_fixed = [](const JointSetDef& set)
        {
            return !set.dip_law.is_random() && !set.spacing_law.is_random() && set.deviation_deg == 0.0 && !set.trace &&
                   !set.orientation && set.persistence == 1.0 && set.spacing > 0.0;
        };
        return is_fixed(a) && is_fixed(b) && std::remainder(a.dip_deg - b.dip_deg, 180.0) == 0.0 && a.spacing == b.spacing &&
               a.origin == b.origin && a.region == b.region && a.outside == b.outside;
    }

    void check_insitu()
    {
        const auto belongs = [&](const char* key, const char* to)
        {
            if (given(std::string("insitu.") + key))
                problems_.add(std::string("insitu.") + key, "[insitu]", key, fmt::format("belongs to {}, which is not given", to),
                              fmt::format("Give {}, or remove this key.", to));
        };
        exclude("insitu", "[insitu]", "stress", "surface");
        const bool has_stress = def_.insitu.stress || given("insitu.stress"),
                   has_surface = def_.insitu.surface || given("insitu.surface");
        if (!has_stress && !has_surface && !problems_.has("insitu"))
            problems_.add("insitu", "[insitu]", "stress", "is missing, and there is no surface",
                          "Give stress, or surface and ratio.");
        if (!has_surface)
            for (const char* key : {"ratio", "ratio_offset"})
                belongs(key, "surface");
        else if (!def_.insitu.ratio && !problems_.has("insitu.ratio"))
            problems_.add("insitu.surface", "[insitu]", "ratio", "is missing: surface gives the vertical stress only",
                          "Give ratio.");
        if (!has_stress)
            for (const char* key : {"gradient", "reference"})
                belongs(key, "stress");
        if (def_.insitu.surface && (def_.gravity.x() != 0.0 || def_.gravity.y() >= 0.0 || def_.gravity_tilt_deg != 0.0))
            problems_.add("insitu.surface", "[insitu]", "surface", "needs a gravity that points straight down",
                          "Give stress and gradient instead.");
    }
};
}  // namespace

void check_rock_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    RockCheck(def, source, problems).check();
}
}  // namespace hdem
