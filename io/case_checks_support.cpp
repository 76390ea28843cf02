#include "core/stage/rules.h"
#include "io/case_check.h"
#include "io/case_checks.h"

namespace hdem
{
namespace
{
class SupportCheck : public CaseCheck
{
  public:
    using CaseCheck::CaseCheck;

    void check()
    {
        for (std::size_t i = 0; i < def_.bolts.size(); ++i)
        {
            const BoltDef& bolt = def_.bolts[i];
            const std::string path = fmt::format("bolt[{}]", i);
            const std::string object = fmt::format("bolt \"{}\"", printable(bolt.name));
            check_place(bolt, path, object);
            check_kind(bolt, path, object);
            if (!bolt.stage.empty())
                check_reference(path + ".stage", object, bolt.stage, "stage", stages_);
        }
        for (std::size_t i = 0; i < def_.liners.size(); ++i)
            check_liner(def_.liners[i], fmt::format("liner[{}]", i), fmt::format("liner \"{}\"", printable(def_.liners[i].name)));
        check_statics();
    }

  private:
    void check_liner(const LinerDef& liner, const std::string& path, const std::string& object)
    {
        exclude(path, object, "around", "path");
        if (given(path + ".around"))
            check_reference(path + ".around", object, liner.around, "excavation", excavations_);
        else if (!given(path + ".path") && !problems_.has(path + ".path"))
            problems_.add(path, object, "around, path", "none is given", "Give around = \"NAME\" of an excavation, or path.");
        for (std::size_t k = 1; k < liner.path.size(); ++k)
            if (liner.path[k] == liner.path[k - 1])
                problems_.add(path + ".path", object, "path", fmt::format("points {} and {} are the same", k, k + 1),
                              "Remove one.");
        if (given(path + ".arc") && !given(path + ".around"))
            problems_.add(path + ".arc", object, "arc", "belongs to around", "Remove it, or give around.");
        check_arc(liner.arc, path, object);
        if (!liner.stage.empty())
            check_reference(path + ".stage", object, liner.stage, "stage", stages_);
        for (std::size_t k = 0; k < liner.hardening.size(); ++k)
            if ((k > 0 && !(liner.hardening[k][0] > liner.hardening[k - 1][0])) || !(liner.hardening[k][1] > 0.0))
            {
                problems_.add(path + ".hardening", object,
                              fmt::format("hardening: row {} = [{}, {}]", k + 1, liner.hardening[k][0], liner.hardening[k][1]),
                              "cycles must grow from row to row, and factors be above 0", "Write [[0, 0.1], [5000, 1.0]].");
                break;
            }
    }

    void check_arc(const std::optional<Vec2>& arc, const std::string& path, const std::string& object)
    {
        if (arc && !(arc->y() > arc->x() && arc->y() <= arc->x() + 360.0))
            problems_.add(path + ".arc", object, fmt::format("arc = [{}, {}]", arc->x(), arc->y()),
                          "must go from a direction to a greater one, at most once around", "Write [30, 150], or [-60, 60].");
    }

    void need(const std::string& path, const std::string& object, const char* key, const std::string& why)
    {
        if (!given(path + "." + key) && !problems_.has(path + "." + key))
            problems_.add(path, object, key, "is missing: " + why + " needs it", "Add it.");
    }

    void check_place(const BoltDef& bolt, const std::string& path, const std::string& object)
    {
        if (given(path + ".around"))
        {
            check_reference(path + ".around", object, bolt.around, "excavation", excavations_);
            for (const char* key : {"from", "to"})
                exclude(path, object, "around", key);
            for (const char* key : {"length", "along"})
                need(path, object, key, "around");
            check_arc(bolt.arc, path, object);
            return;
        }
        for (const char* key : {"from", "to"})
            need(path, object, key, "a single bolt (one without around)");
        for (const char* key : {"length", "along", "arc"})
            if (given(path + "." + key))
                problems_.add(path + "." + key, object, key, "belongs to a pattern", "Remove it, or give around.");
        if (bolt.from && bolt.to && *bolt.from == *bolt.to)
            problems_.add(path + ".to", object, "to", "is the same point as from", "Give another one.");
    }

    void check_kind(const BoltDef& bolt, const std::string& path, const std::string& object)
    {
        struct Key
        {
            const char* name;
            bool anchored, grouted, local;
        };
        static constexpr Key keys[] = {{"area", true, true, false},
                                       {"modulus", true, true, false},
                                       {"stiffness", true, false, true},
                                       {"free_length", true, true, false},
                                       {"pretension", true, false, false},
                                       {"bond_stiffness", false, true, false},
                                       {"bond_strength", false, true, false},
                                       {"segment", false, true, false},
                                       {"plate", false, true, false},
                                       {"shear_stiffness", false, false, true},
                                       {"shear_strength", false, false, true},
                                       {"active_length", false, false, true}};
        static constexpr const char* kinds[] = {"anchored", "grouted", "local"};
        if (problems_.has(path + ".kind"))
            return;  // which keys are right is not known
        const char* kind = kinds[static_cast<int>(bolt.kind)];
        for (const Key& key : keys)
        {
            const bool fits = bolt.kind == BoltKind::anchored ? key.anchored
                                                              : (bolt.kind == BoltKind::grouted ? key.grouted : key.local);
            if (!fits && given(path + "." + key.name))
                problems_.add(path + "." + key.name, object, key.name, fmt::format("does not belong to kind {}", kind),
                              "Remove it, or choose another kind.");
        }
        const std::string why = fmt::format("kind {}", kind);
        if (bolt.kind == BoltKind::grouted)
            for (const char* key : {"area", "bond_stiffness", "bond_strength"})
                need(path, object, key, why);
        if (bolt.kind == BoltKind::local)
            for (const char* key : {"stiffness", "shear_stiffness", "active_length"})
                need(path, object, key, why);
        if (bolt.kind == BoltKind::anchored)
            check_anchored(bolt, path, object);
    }

    void check_anchored(const BoltDef& bolt, const std::string& path, const std::string& object)
    {
        exclude(path, object, "area", "stiffness");
        exclude(path, object, "modulus", "stiffness");
        if (!given(path + ".area") && !given(path + ".stiffness") && !problems_.has(path + ".area") &&
            !problems_.has(path + ".stiffness"))
            problems_.add(path, object, "area", "is missing, and stiffness too", "Give area, or stiffness.");
        if (bolt.stiffness && *bolt.stiffness == 0.0)
            problems_.add(path + ".stiffness", object, "stiffness = 0", "the bolt would do nothing", "Give more, in N/m.");
        if (bolt.free_length && *bolt.free_length == 0.0)
            problems_.add(path + ".free_length", object, "free_length = 0", "a bolt that does not stretch has no force",
                          "Give the length that stretches.");
        if (bolt.yield && bolt.pretension > *bolt.yield)
            problems_.add(path + ".pretension", object, fmt::format("pretension = {}", bolt.pretension),
                          fmt::format("is above yield = {}", *bolt.yield), "Give less, or a stronger bolt.");
        const double strain = bolt.area > 0.0 ? bolt.pretension / (bolt.modulus * bolt.area) : 0.0;
        if (bolt.rupture_strain && strain >= *bolt.rupture_strain)
            problems_.add(
                path + ".pretension", object, fmt::format("pretension = {}", bolt.pretension),
                fmt::format("strains the bar by {:.3g}, and it ruptures at rupture_strain = {}", strain, *bolt.rupture_strain),
                "Give less, or a greater rupture_strain.");
    }

    void check_statics()
    {
        for (std::size_t i = 0; i < def_.stages.size() && !(def_.bolts.empty() && def_.liners.empty()); ++i)
            if (asks_for_statics(def_.stages[i]))
                problems_.warn(fmt::format("stage[{}].solver", i), fmt::format("stage \"{}\"", printable(def_.stages[i].name)),
                               "solver = \"static\"", "has no effect: static solutions do not know bolts and liners",
                               "Remove this key.");
    }
};
}  // namespace

void check_support_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    SupportCheck(def, source, problems).check();
}
}  // namespace hdem
