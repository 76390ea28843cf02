#pragma once
/// What the checks in io/case_checks_*.cpp share.

#include "io/case_problems.h"
#include "io/case_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace hdem
{
class CaseCheck
{
  public:
    using Names = std::set<std::string>;

    CaseCheck(const CaseDef& def, const CaseSource& source, CaseProblems& problems)
        : def_(def),
          source_(source),
          problems_(problems)
    {
        for (const auto& material : def.materials)
            materials_.insert(material.name);
        for (const auto& joint : def.joints)
            joints_.insert(joint.name);
        for (const auto& block : def.blocks)
            blocks_.insert(block.name);
        for (const auto& excavation : def.excavations)
            excavations_.insert(excavation.name);
        for (const auto& stage : def.stages)
            stages_.insert(stage.name);
    }

  protected:
    [[nodiscard]] bool given(const std::string& key) const { return source_.given(key); }

    /// An entry of this kind has no name, or a wrong one: it may be the one that is meant.
    [[nodiscard]] bool has_wrong_names(const std::string& what) const
    {
        static constexpr const char* kinds[] = {"excavation", "block", "stage", "fault", "history", "bolt", "liner"};
        return std::ranges::any_of(kinds, [&](const char* kind)
                                   { return what.find(kind) != std::string::npos && problems_.has_in_entries(kind, "name"); });
    }

    /// Two keys of one table of which only one may be given; complains at the second.
    void exclude(const std::string& path, const std::string& object, const char* first, const char* second)
    {
        if (given(path + "." + first) && given(path + "." + second))
            problems_.add(path + "." + second, object, second, fmt::format("contradicts {}", first), "Remove one of the two.");
    }

    /// @param what "material", "joint", "block"
    void check_reference(const std::string& key, const std::string& object, const std::string& name, const std::string& what,
                         const Names& known)
    {
        if (known.contains(name) || has_wrong_names(what))
            return;
        const std::string near = did_you_mean(name, {known.begin(), known.end()});
        const std::string field = key.substr(key.rfind('.') + 1);
        problems_.add(key, object, fmt::format("{} = \"{}\"", field, printable(name)),
                      fmt::format("no {} has this name{}", what, near.empty() ? "" : fmt::format("; did you mean '{}'?", near)),
                      known.empty() || known.size() > 20 ? fmt::format("Define the {}, or correct the name.", what)
                                                         : fmt::format("There is {}.", quoted_list({known.begin(), known.end()})));
    }

    /// Names that generated blocks may have are left alone.
    void check_block_reference(const std::string& key, const std::string& object, const std::string& name,
                               const std::string& what = "block", const Names& also = {})
    {
        if (blocks_.contains(name) || also.contains(name))
            return;
        Names known = blocks_;
        known.insert(also.begin(), also.end());
        if (!def_.domain.given && !problems_.has("domain") && !problems_.has("block") && !problems_.has("blocks_file"))
            check_reference(key, object, name, what, known);
    }

    /// Keys of io/case_schema_factor.h, of a load or a side.
    void check_factor(const FactorDef& factor, const std::string& path, const std::string& object);

    const CaseDef& def_;
    const CaseSource& source_;
    CaseProblems& problems_;
    Names materials_, joints_, blocks_, excavations_, stages_;
};
}  // namespace hdem
