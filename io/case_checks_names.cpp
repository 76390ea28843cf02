#include "io/case_check.h"
#include "io/case_checks.h"

#include <algorithm>
#include <map>

namespace hdem
{
namespace
{
class NameCheck : public CaseCheck
{
  public:
    using CaseCheck::CaseCheck;

    void check()
    {
        check_numbers();
        check_names();
        check_joints();
        check_use();
    }

  private:
    /// There is a number for each pair of materials: the joint between them.
    void check_numbers()
    {
        constexpr std::size_t most = 4096;
        if (def_.materials.size() > most)
            problems_.add("material", "case", fmt::format("{} materials", def_.materials.size()),
                          fmt::format("at most {}: each pair of them has its joint", most), "Give equal blocks one material.");
    }

    /// A joint has no effect by its name: something has to give it.
    void check_use()
    {
        Names joints{"default", def_.domain.traces_joint, def_.voronoi.joint};
        for (const RegionDef& region : def_.regions)
            joints.insert(region.joint);
        for (const FaultDef& fault : def_.faults)
            joints.insert(fault.joint);
        for (const JointSetDef& set : def_.joint_sets)
            joints.insert(set.joint);
        for (const JointDef& joint : def_.joints)
            if (joint.materials.empty() && !joints.contains(joint.name) && !problems_.has("joint." + joint.name))
                problems_.warn(
                    "joint." + joint.name, fmt::format("joint \"{}\"", joint.name), fmt::format("[joint.{}]", joint.name),
                    "no contact has it: nothing names it",
                    fmt::format("Give joint = \"{}\" to a joint set, a fault or the like, or materials here.", joint.name));
    }

    /// Rules for names, and no name twice among those that the same key may refer to.
    void check_names()
    {
        std::map<std::string, std::string> rock;
        check_name_list("excavation", "excavation", def_.excavations, rock);
        check_name_list("block", "block", def_.blocks, rock);
        check_name_list("boundary", "boundary", def_.boundaries, rock);
        std::map<std::string, std::string> faults, regions, sets, stages, histories, bolts, liners, loads;
        check_name_list("fault", "fault", def_.faults, faults);
        check_name_list("region", "region", def_.regions, regions);
        check_name_list("joint_set", "joint set", def_.joint_sets, sets);
        check_name_list("stage", "stage", def_.stages, stages);
        check_name_list("history", "history", def_.histories, histories);
        check_name_list("bolt", "bolt", def_.bolts, bolts);
        check_name_list("liner", "liner", def_.liners, liners);
        check_name_list("load", "load", def_.loads, loads);
    }

    template <class Entries>
    void check_name_list(const std::string& section, const std::string& label, const Entries& entries,
                         std::map<std::string, std::string>& taken)
    {
        for (std::size_t i = 0; i < entries.size(); ++i)
        {
            const std::string& name = entries[i].name;
            const std::string key = fmt::format("{}[{}].name", section, i);
            const std::string object = fmt::format("{} {}", label, i + 1);
            const std::string said = fmt::format("name = \"{}\"", printable(name));
            const bool plain = std::none_of(name.begin(), name.end(),
                                            [](unsigned char c) { return c < 0x20 || c == 0x7f || c == ';' || c == '/'; });
            if (name.empty() || name == "*" || name == "." || name == ".." || name.size() > 200 || name.front() == ' ' ||
                name.back() == ' ' || !plain)
                problems_.add(key, object, said, "cannot be a name",
                              "Choose 1 to 200 characters without ;, / and line ends, that do not start or end with a blank; not "
                              "*, . or .. alone.");
            else if (const auto [other, added] = taken.emplace(name, object); !added)
                problems_.add(key, object, said, fmt::format("{} has this name already", other->second), "Choose another.");
        }
    }

    void check_joints()
    {
        if (!joints_.contains("default") && !problems_.has("joint"))
            problems_.add("joint.default", "joint \"default\"", "[joint.default]",
                          "is missing: contacts that no other joint claims take it",
                          "Add it with normal_stiffness, shear_stiffness and friction_angle_deg.");
        if (!problems_.has("material"))
        {
            if (def_.domain.given)
                check_reference("domain.material", "[domain]", def_.domain.material, "material", materials_);
            for (std::size_t i = 0; i < def_.blocks.size(); ++i)
                check_reference(fmt::format("block[{}].material", i), fmt::format("block \"{}\"", printable(def_.blocks[i].name)),
                                def_.blocks[i].material, "material", materials_);
        }
        if (!def_.domain.traces_joint.empty())
            check_reference("domain.traces_joint", "[domain]", def_.domain.traces_joint, "joint", joints_);
        for (std::size_t i = 0; i < def_.joint_sets.size(); ++i)
            if (!def_.joint_sets[i].joint.empty())
                check_reference(fmt::format("joint_set[{}].joint", i),
                                fmt::format("joint set \"{}\"", printable(def_.joint_sets[i].name)), def_.joint_sets[i].joint,
                                "joint", joints_);

        std::map<std::pair<std::string, std::string>, std::string> pairs;
        for (const JointDef& joint : def_.joints)
        {
            const std::string key = "joint." + joint.name + ".materials";
            const std::string object = fmt::format("joint \"{}\"", joint.name);
            if (!given(key) || problems_.has(key))
                continue;
            if (joint.name == "default")
                problems_.add(key, object, "materials", "the default is for all that remains",
                              "Remove it, or use another name for this joint.");
            else if (joint.materials.size() != 2)
                problems_.add(key, object, "materials",
                              fmt::format("names {} materials, a contact has two", joint.materials.size()),
                              "Write e.g. [\"rock\", \"rock\"].");
            else
            {
                for (const std::string& material : joint.materials)
                    check_reference(key, object, material, "material", materials_);
                const auto [low, high] = std::minmax(joint.materials[0], joint.materials[1]);
                if (const auto [other, added] = pairs.emplace(std::pair(low, high), joint.name); !added)
                    problems_.add(key, object, "materials", fmt::format("joint \"{}\" has the same two", other->second),
                                  "Keep one of them.");
            }
        }
    }
};
}  // namespace

void check_names(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    NameCheck(def, source, problems).check();
}
}  // namespace hdem
