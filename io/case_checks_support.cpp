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
        Names names;
        for (std::size_t i = 0; i < def_.bolts.size(); ++i)
        {
            const BoltDef& bolt = def_.bolts[i];
            const std::string path = fmt::format("bolt[{}]", i);
            const std::string object = fmt::format("bolt \"{}\"", printable(bolt.name));
            if (!names.insert(bolt.name).second)
                problems_.add(path + ".name", object, "name", "two bolts have it", "Give another name.");
            check_place(bolt, path, object);
            check_kind(bolt, path, object);
            if (!bolt.stage.empty())
                check_reference(path + ".stage", object, bolt.stage, "stage", stages_);
        }
        check_statics();
    }

  private:
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
            if (bolt.arc && !(bolt.arc->y() > bolt.arc->x() && bolt.arc->y() <= bolt.arc->x() + 360.0))
                problems_.add(path + ".arc", object, fmt::format("arc = [{}, {}]", bolt.arc->x(), bolt.arc->y()),
                              "must go from a direction to a greater one, at most once around", "Write [30, 150], or [-60, 60].");
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
    }

    void check_statics()
    {
        for (std::size_t i = 0; i < def_.stages.size() && !def_.bolts.empty(); ++i)
            if (def_.stages[i].solver == RestSolver::statics)
                problems_.warn(fmt::format("stage[{}].solver", i), fmt::format("stage \"{}\"", printable(def_.stages[i].name)),
                               "solver = \"static\"", "has no effect: static solutions do not know bolts", "Remove this key.");
    }
};
}  // namespace

void check_support_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
{
    SupportCheck(def, source, problems).check();
}
}  // namespace hdem
