#include "core/support/resolve_support.h"

#include "core/rock/excavation.h"
#include "core/rock/problem_text.h"
#include "core/support/bolt_path.h"
#include "core/support/bolt_pattern.h"
#include "core/support/make_bolt.h"
#include "core/support/resolve_liner.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <unordered_set>

namespace hdem
{
namespace
{
constexpr double gap_share = 1e-3;   // of the mean block size: so much may lie between two blocks, or before a head
constexpr double most_bolts = 1e5;   // of one pattern
constexpr double most_pieces = 1e6;  // of all bolts and liners together: more would fill the memory before anything is said
constexpr double most_bare = 0.5;    // of the length of a liner: so much may have no block behind it without a word

double length_of(const std::vector<Polygon>& lines)
{
    double length = 0.0;
    for (const Polygon& line : lines)
        for (std::size_t i = 1; i < line.size(); ++i)
            length += (line[i] - line[i - 1]).norm();
    return length;
}

class SupportResolver
{
  public:
    SupportResolver(const CaseDef& def, const Blocks& blocks, Model& model) : def_(def), blocks_(blocks), model_(model) {}

    std::vector<Problem> run()
    {
        for (std::size_t i = 0; i < def_.bolts.size(); ++i)
        {
            const BoltDef& bolt = def_.bolts[i];
            key_ = "bolt[" + std::to_string(i) + "]";
            object_ = "bolt \"" + bolt.name + "\": ";
            take_stage(bolt.stage);
            if (bolt.around.empty())
                add(bolt, bolt.name, {*bolt.from, *bolt.to}, &problems_);
            else
                add_pattern(bolt);
        }
        for (std::size_t i = 0; i < def_.liners.size(); ++i)
            add_liner(def_.liners[i], "liner[" + std::to_string(i) + "]");
        list_ends(model_.support);
        return std::move(problems_);
    }

  private:
    void take_stage(const std::string& name)
    {
        const auto stage = std::ranges::find(def_.stages, name, &StageDef::name);
        stage_ = name.empty() || stage == def_.stages.end() ? 0 : static_cast<Index>(stage - def_.stages.begin());
        find_gone();
    }

    void add_liner(const LinerDef& def, const std::string& key)
    {
        take_stage(def.stage);
        LinerPlan plan{.def = &def, .stage = stage_, .stretches = {def.path}, .gone = &gone_};
        if (!def.around.empty())
            plan.stretches = stretches_of(outline_polygon(*std::ranges::find(def_.excavations, def.around, &ExcavationDef::name)),
                                          def.arc);
        if (!may_have(key + (def.segment ? ".segment" : ".thickness"), "liner \"" + def.name + "\": ", longest_segment(def),
                      length_of(plan.stretches)))
            return;
        std::optional<Liner> liner = resolve_liner(plan, blocks_, model_);
        if (!liner)
        {
            const bool is_early = !def.around.empty() && !is_excavated(def.around);
            const std::string early = "\"" + def.around +
                                      "\" is not excavated yet in the stage in which it is installed (that of `stage`, else the "
                                      "first one). Give a later stage.";
            const std::string
                nothing_behind = "there is no block behind it in its stage (it would hang in the air). The rock lies on "
                                 "the right-hand side of a path; turn it round, or move it.";
            problems_.push_back({.key = key + (def.around.empty() ? ".path" : ".around"),
                                 .text = "liner \"" + def.name + "\": " + (is_early ? early : nothing_behind)});
            return;
        }
        warn_of_air_behind(*liner, key);
        liner->history = model_.support.history_size;
        model_.support.history_size += liner->history_size;
        model_.support.liners.push_back(std::move(*liner));
    }

    void warn_of_air_behind(const Liner& liner, const std::string& key)
    {
        double length = 0.0, bare = 0.0;
        for (const LinerSegment& segment : liner.segments)
        {
            length += segment.length;
            bare += segment.block == no_index ? segment.length : 0.0;
        }
        if (bare > most_bare * length)
            problems_.push_back({.severity = Problem::Severity::warning,
                                 .key = key,
                                 .text = "liner \"" + liner.name + "\": " + text(bare) + " of its " + text(length) +
                                         " m have no block behind them (it hangs in the air there). Give points on the "
                                         "outline of the rock to change that."});
    }

    /// Walls, and what is excavated by the time of the stage.
    void find_gone()
    {
        gone_.assign(static_cast<std::size_t>(model_.blocks()), 0);
        for (Index b = 0; b < model_.blocks(); ++b)
        {
            gone_[b] = model_.mass[b] == 0.0 ? 1 : 0;
            const Index excavation = model_.excavation[b];
            for (Index s = 0; s <= stage_ && static_cast<std::size_t>(s) < def_.stages.size(); ++s)
                for (const std::string& name : def_.stages[s].excavate)
                    if (name == model_.name[b] || (excavation != no_index && name == model_.excavation_names[excavation]))
                        gone_[b] = 1;
        }
    }

    /// By the start of the stage that is looked at.
    bool is_excavated(const std::string& excavation) const
    {
        const auto stages = std::span(def_.stages).first(std::min<std::size_t>(stage_ + 1, def_.stages.size()));
        return std::ranges::any_of(stages,
                                   [&](const StageDef& stage) { return std::ranges::count(stage.excavate, excavation) > 0; });
    }

    /// Is there room for the pieces of so long a bolt or liner? Then they are counted, else it is said once.
    bool may_have(const std::string& key, const std::string& object, double segment, double length)
    {
        const bool had_room = pieces_ <= most_pieces;
        pieces_ += std::ceil(length / segment);
        if (pieces_ <= most_pieces)
            return true;
        if (had_room)
            problems_.push_back({.key = key,
                                 .text = object + "segment = " + text(segment) + " m (makes " + text(length / segment) +
                                         " pieces of " + text(length) + " m; all bolts and liners together may have " +
                                         text(most_pieces) + "). Give a greater one."});
        return false;
    }

    void add_pattern(const BoltDef& bolt)
    {
        const auto excavation = std::ranges::find(def_.excavations, bolt.around, &ExcavationDef::name);
        const Polygon outline = outline_polygon(*excavation);
        const double wanted = length_of(stretches_of(outline, bolt.arc)) / bolt.along;
        if (!(wanted <= most_bolts))
        {
            problems_.push_back({.key = key_ + ".along",
                                 .text = object_ + "along = " + text(bolt.along) + " m (makes " + text(wanted) +
                                         " bolts; a pattern may have " + text(most_bolts) + "). Give a greater one."});
            return;
        }
        int number = 0, left_out = 0;
        for (const BoltLine& line : bolts_around(outline, bolt))
        {
            std::vector<Problem> reasons;
            add(bolt, bolt.name + "." + std::to_string(++number), line, &reasons);
            left_out += reasons.empty() ? 0 : 1;
        }
        if (left_out == number)
            problems_.push_back(
                {.key = key_ + ".around",
                 .text = object_ + "around = \"" + bolt.around + "\" (none of its " + std::to_string(number) +
                         " bolts can be installed: each lies in one block, ends outside the rock, or crosses a gap in "
                         "it). Give another length, or another arc."});
        else if (left_out > 0)
            problems_.push_back(
                {.severity = Problem::Severity::warning,
                 .key = key_ + ".around",
                 .text = object_ + "around = \"" + bolt.around + "\" (" + std::to_string(left_out) + " of " +
                         std::to_string(number) +
                         " bolts are left out: each lies in one block, ends outside the rock, or crosses a gap in it). "
                         "Give another length to change that."});
        if (left_out < number && bolt.stage.empty() && !is_excavated(bolt.around))
            problems_.push_back(
                {.severity = Problem::Severity::warning,
                 .key = key_ + ".around",
                 .text = object_ + "around = \"" + bolt.around +
                         "\" (is not excavated yet in the first stage, in which bolts without a stage are installed). "
                         "Give the stage."});
    }

    void add(const BoltDef& from, const std::string& name, const BoltLine& line, std::vector<Problem>* problems)
    {
        const Vec2 head = line.from - model_.origin, end = line.to - model_.origin;
        const double length = (end - head).norm(), least = gap_share * model_.mean_size;
        const std::vector<PathPiece> path = pieces_along(head, end, model_, blocks_, gone_);
        const auto fail = [&](const char* key, const std::string& text)
        { problems->push_back({.key = key_ + key, .text = object_ + text}); };
        const auto place = [&](double at) { return text(Vec2(line.from + at / length * (line.to - line.from))); };
        if (path.empty() || path.front().from > least)
            return fail(".from",
                        "from = " + place(0.0) +
                            " m (lies in no block that is there in its stage). Give a point of the rock or on its outline.");
        if (path.back().to < length - least)
            return fail(".to", "to = " + place(length) +
                                   " m (lies in no block that is there in its stage). Give a point of the rock or on its outline.");
        if (path.size() == 1 || (from.kind == BoltKind::anchored && path.front().block == path.back().block))
            return fail(".to", "both ends lie in block \"" + model_.name[path.front().block] +
                                   "\" (it would do nothing). Give a longer one.");
        for (std::size_t i = 0; from.kind != BoltKind::anchored && i + 1 < path.size(); ++i)
            if (path[i + 1].from - path[i].to > least)
                return fail(".from", "from " + place(path[i].to) + " to " + place(path[i + 1].from) +
                                         " m there is no block (it would have no rock around it). Move it, or end it there.");
        if (!names_.insert(name).second)
            return problems_.push_back({.key = key_ + ".name",
                                        .text = object_ + "name (another bolt is called \"" + name +
                                                "\"; those of a pattern are called NAME.1, NAME.2, ...). Give another name."});
        warn_along_joint(head, end, name);
        Bolt bolt = bolt_per_metre(from, name, length);
        if (from.kind == BoltKind::grouted &&
            !may_have(key_ + (from.segment ? ".segment" : ".bond_stiffness"), object_, longest_segment(from, bolt), length))
            return;
        bolt.stage = stage_;
        tie(from, path, {head, end}, blocks_, bolt);
        bolt.history = model_.support.history_size;
        model_.support.history_size += bolt.history_size;
        model_.support.bolts.push_back(std::move(bolt));
    }

    /// A bolt along a joint is in the block that comes first, and not in the other one.
    void warn_along_joint(const Vec2& head, const Vec2& end, const std::string& name)
    {
        const double length = (end - head).norm();
        const Vec2 aside = 1e-6 * model_.mean_size * turned_left((end - head) / length);
        std::map<Index, double> more_on_left;
        for (const double side : {1.0, -1.0})
            for (const PathPiece& piece : pieces_along(head + side * aside, end + side * aside, model_, blocks_, gone_))
                more_on_left[piece.block] += side * (piece.to - piece.from);
        const auto by_way = [](const auto& a, const auto& b) { return a.second < b.second; };
        if (more_on_left.empty())
            return;
        const auto [right, left] = std::ranges::minmax_element(more_on_left, by_way);
        if (left->second > 0.01 * length && right->second < -0.01 * length)
            problems_.push_back({.severity = Problem::Severity::warning,
                                 .key = key_ + ".from",
                                 .text = "bolt \"" + name + "\": it runs along the joint between blocks \"" +
                                         model_.name[left->first] + "\" and \"" + model_.name[right->first] + "\" over " +
                                         text(std::min(left->second, -right->second)) +
                                         " m (it is in one of them only). Move it aside."});
    }

    const CaseDef& def_;
    const Blocks& blocks_;
    Model& model_;
    std::vector<Problem> problems_;
    std::string key_, object_;
    Index stage_ = 0;
    double pieces_ = 0.0;                    ///< of all bolts and liners so far
    std::unordered_set<std::string> names_;  ///< of bolts
    std::vector<std::uint8_t> gone_;
};
}  // namespace

std::vector<Problem> resolve_support(const CaseDef& def, const Blocks& blocks, Model& model, SupportState& state)
{
    std::vector<Problem> problems = SupportResolver(def, blocks, model).run();
    state.bolts.assign(model.support.bolts.size(), {});
    state.liners.assign(model.support.liners.size(), {});
    state.history.assign(static_cast<std::size_t>(model.support.history_size), 0.0);
    return problems;
}
}  // namespace hdem
