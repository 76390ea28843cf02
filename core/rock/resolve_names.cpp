#include "core/rock/resolve_names.h"

#include "core/model/near_name.h"
#include "core/motion/loads.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <unordered_map>
#include <utility>

namespace hdem
{
namespace
{
constexpr double most_cycles = 1e15;  ///< the most that a case may ask for by number

class Resolver
{
  public:
    Resolver(const CaseDef& def, Model& model, const Blocks& blocks, const Blocks& free_at_times)
        : def_(def),
          model_(model),
          blocks_(blocks),
          free_at_times_(free_at_times)
    {
        for (Index i = 0; i < model.blocks(); ++i)
            slots_.emplace(model.name[i], i);
    }

    std::vector<Problem> run()
    {
        for (std::size_t i = 0; i < def_.loads.size(); ++i)
            add_load(def_.loads[i], "load[" + std::to_string(i) + "]", "load \"" + def_.loads[i].name + "\"");
        time_loads(model_);
        for (std::size_t i = 0; i < model_.loads.size(); ++i)
            check_times(model_.loads[i], "load[" + std::to_string(i) + "]");
        for (std::size_t i = 0; i < def_.stages.size(); ++i)
            check_stage(def_.stages[i], "stage[" + std::to_string(i) + "]");
        for (std::size_t i = 0; i < def_.histories.size(); ++i)
            check_history(def_.histories[i], "history[" + std::to_string(i) + "]");
        for (std::size_t i = 0; i < def_.excavations.size(); ++i)
            if (excavated_.count(def_.excavations[i].name) == 0)
                warn("excavation[" + std::to_string(i) + "]",
                     "excavation \"" + def_.excavations[i].name +
                         "\": no stage removes it (its blocks stay as rock). Add excavate = [\"" + def_.excavations[i].name +
                         "\"] to a stage.");
        return std::move(problems_);
    }

  private:
    void fail(const std::string& key, const std::string& text) { problems_.push_back({.key = key, .text = text}); }
    void warn(const std::string& key, const std::string& text)
    {
        problems_.push_back({.severity = Problem::Severity::warning, .key = key, .text = text});
    }

    /// Names of generated blocks are near to each other: only those that the user has chosen are suggested.
    [[nodiscard]] std::string suggestion(const std::string& name, bool or_excavation) const
    {
        std::vector<std::string> chosen;
        for (const BlockDef& block : def_.blocks)
            chosen.push_back(block.name);
        if (or_excavation)
            chosen.insert(chosen.end(), model_.excavation_names.begin(), model_.excavation_names.end());
        const std::string near = nearest_name(name, chosen);
        return near.empty() ? "" : "; did you mean '" + near + "'?";
    }

    /// @param object  what names the block, for messages: stage "roof"
    Index find(const std::string& name, const std::string& key, const std::string& object)
    {
        const auto at = slots_.find(name);
        if (at != slots_.end())
            return at->second;
        const std::string field = key.substr(key.rfind('.') + 1);
        const bool or_excavation = field == "excavate";
        const bool is_excavation = std::ranges::count(model_.excavation_names, name) > 0;
        fail(key, object + ": " + field + " = \"" + name + "\" (" +
                      (is_excavation ? "is an excavation, not a block"
                                     : (or_excavation ? "no excavation or block has this name" : "no block has this name") +
                                           suggestion(name, or_excavation)) +
                      "). The model has " + std::to_string(model_.blocks()) +
                      " blocks, generated ones are called b1, b2, ...: `hdem check --blocks` lists them.");
        return no_index;
    }

    [[nodiscard]] bool is_fixed_by_a_stage(const std::string& name) const
    {
        return std::ranges::any_of(def_.stages, [&](const StageDef& stage) { return std::ranges::count(stage.fix, name) > 0; });
    }

    void add_load(const LoadDef& from, const std::string& key, const std::string& object)
    {
        Load load{.name = from.name,
                  .blocks = {},
                  .acceleration = from.acceleration,
                  .force = from.force,
                  .arm = {},
                  .moment = from.moment,
                  .velocity_x = from.velocity_x,
                  .velocity_y = from.velocity_y,
                  .angular_velocity = from.angular_velocity};
        std::vector<std::uint8_t> is_loaded(static_cast<std::size_t>(model_.blocks()), 0);
        const auto add = [&](Index block)
        {
            if (!std::exchange(is_loaded[static_cast<std::size_t>(block)], std::uint8_t{1}))
                load.blocks.push_back(block);
        };
        for (const std::string& name : from.blocks)
        {
            if (name == "*")  // those that a stage frees too: while they are fixed it moves nothing. No walls: they are never free
            {
                for (Index i = 0; i < model_.blocks(); ++i)
                    if (free_at_times_.is_free(i))
                        add(i);
            }
            else if (const Index i = find(name, key + ".blocks", object); i != no_index)
                add(i);
        }
        for (const Index i : load.blocks)
        {
            const BlockInertia& inertia = blocks_.inertia[i];
            const bool is_fixed_later = is_fixed_by_a_stage(model_.name[i]);
            const auto need_fixed = [&](bool given, double inverse, const char* component, const char* fix)
            {
                if (given && inverse > 0.0 && !is_fixed_later)
                    fail(key, "load on block \"" + model_.name[i] + "\": " + component +
                                  " is prescribed (but the block is free to move in it). Add fixed = [\"" + fix +
                                  "\"] to the block.");
            };
            need_fixed(load.velocity_x.has_value(), inertia.inverse_mass_x, "velocity_x", "x");
            need_fixed(load.velocity_y.has_value(), inertia.inverse_mass_y, "velocity_y", "y");
            need_fixed(load.angular_velocity.has_value(), inertia.inverse_inertia, "angular_velocity", "rotation");
        }
        if (from.point)
            for (const Index i : load.blocks)
            {
                load.arm.push_back(*from.point - model_.origin - Vec2(blocks_.motion[i].x, blocks_.motion[i].y));
                if (!has_point(i, load.arm.back()))
                    fail(key + ".point", "load on block \"" + model_.name[i] +
                                             "\": point (it is not in the block as drawn). Give a point of the block.");
            }
        load.interval = from.interval;
        load.factor = factor_of(from.factor, def_.stages);
        model_.loads.push_back(std::move(load));
    }

    void check_times(const Load& load, const std::string& key)
    {
        if (load.until <= load.from)
            warn(key, "load: acts from cycle " + std::to_string(load.from) + " until cycle " + std::to_string(load.until) +
                          " (never). Check its times.");
    }

    /// In one of its parts, or on the outline up to a millionth of its size?
    [[nodiscard]] bool has_point(Index block, const Vec2& arm) const
    {
        const Shapes& shapes = model_.shapes;
        for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
        {
            bool inside = true;
            for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
                inside = inside && cross(shapes.edge_tangent[v], arm - shapes.vertex[v]) >= -1e-6 * model_.size(block);
            if (inside)
                return true;
        }
        return false;
    }

    void check_stage(const StageDef& stage, const std::string& key)
    {
        const std::string object = "stage \"" + stage.name + "\"";
        if (stage.duration && *stage.duration / model_.time_step > most_cycles)
            fail(key + ".duration", object + ": duration (takes more than 1e15 cycles of the time step). Give a shorter one, or a "
                                             "greater time.step.");
        if (stage.duration && *stage.duration / model_.time_step < static_cast<double>(stage.relax_cycles))
            fail(key + ".relax_cycles", "stage: relax_cycles = " + std::to_string(stage.relax_cycles) + " (its duration has only " +
                                            std::to_string(static_cast<std::int64_t>(*stage.duration / model_.time_step)) +
                                            " cycles). Let it last longer, or take the forces off faster.");
        for (const std::string& name : stage.excavate)
        {
            const bool is_excavation = std::find(model_.excavation_names.begin(), model_.excavation_names.end(), name) !=
                                       model_.excavation_names.end();
            if (is_excavation)
            {
                if (!excavated_.insert(name).second)
                    fail(key + ".excavate", "excavation \"" + name + "\": removed twice. Name it in one stage only.");
            }
            else
                find(name, key + ".excavate", object);
        }
        note_removed(stage.excavate);
        for (const std::string& name : stage.fix)
            find_present(name, key + ".fix", object);
        for (const std::string& name : stage.free)
            find_present(name, key + ".free", object);
        for (const StageEndDef& end : stage.ends)
            for (const std::string& name : end.blocks)
                find_present(name, key + ".until", object);
    }

    void note_removed(const std::vector<std::string>& names)
    {
        for (const std::string& name : names)
        {
            removed_.insert(name);
            const auto excavation = std::ranges::find(model_.excavation_names, name) - model_.excavation_names.begin();
            for (Index b = 0; b < model_.blocks(); ++b)
                if (model_.excavation[b] == static_cast<Index>(excavation))
                    removed_.insert(model_.name[b]);
        }
    }

    /// A stage that names what it or an earlier one has removed is a likely slip.
    void find_present(const std::string& name, const std::string& key, const std::string& object)
    {
        if (find(name, key, object) != no_index && removed_.contains(name))
            warn(key, object + ": " + key.substr(key.rfind('.') + 1) + " = \"" + name +
                          "\" (has no effect: this stage or one before it removes the block). Name another block.");
    }

    void check_history(const HistoryDef& history, const std::string& key)
    {
        const std::string object = "history \"" + history.name + "\"";
        if (!history.block.empty())
            find(history.block, key + ".block", object);
        for (const std::string& name : history.between)
            find(name, key + ".between", object);
        const auto is_single = [&](const BoltDef& bolt) { return bolt.name == history.bolt && bolt.around.empty(); };
        if (std::ranges::none_of(def_.bolts, is_single))  // else what is wrong with the bolt itself has been told
            find_support(model_.support.bolts, &Bolt::name, history.bolt, key + ".bolt", object,
                         "Those of a pattern are called NAME.1, NAME.2, ...");
        if (std::ranges::count(def_.liners, history.liner, &LinerDef::name) == 0)
            find_support(model_.support.liners, &Liner::name, history.liner, key + ".liner", object,
                         "Give the name of a [[liner]].");
    }

    /// Bolts and liners are there already, those of patterns too.
    template <class Entries, class Name>
    void find_support(const Entries& entries, Name name_of, const std::string& name, const std::string& key,
                      const std::string& object, const std::string& remedy)
    {
        if (name.empty() || std::ranges::find(entries, name, name_of) != std::ranges::end(entries))
            return;
        std::vector<std::string> known;
        std::ranges::transform(entries, std::back_inserter(known), name_of);
        const std::string what = key.substr(key.rfind('.') + 1), near = nearest_name(name, known);
        fail(key, object + ": " + what + " = \"" + name + "\" (no " + what + " has this name" +
                      (near.empty() ? "" : "; did you mean '" + near + "'?") + "). " + remedy);
    }

    const CaseDef& def_;
    Model& model_;
    const Blocks& blocks_;
    const Blocks& free_at_times_;
    std::unordered_map<std::string, Index> slots_;
    std::set<std::string> excavated_;
    std::set<std::string> removed_;  ///< blocks, by the stages so far
    std::vector<Problem> problems_;
};
}  // namespace

Index material_number(const CaseDef& def, const std::string& name)
{
    for (std::size_t i = 0; i < def.materials.size(); ++i)
        if (def.materials[i].name == name)
            return static_cast<Index>(i);
    throw InputError(Problem{.key = "material",
                             .text = "material \"" + name + "\": not defined. Add [material." + name + "] with its density."});
}

std::vector<Problem> resolve_names(const CaseDef& def, Model& model, const Blocks& blocks, const Blocks& free_at_times)
{
    return Resolver(def, model, blocks, free_at_times).run();
}
}  // namespace hdem
