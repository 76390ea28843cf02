#include "io/summary.h"

#include "core/support/bolt_link.h"
#include "core/support/liner_forces.h"
#include "core/support/liner_rest.h"
#include "io/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace hdem
{
namespace
{
using Json = nlohmann::ordered_json;

Json energy_json(const RunSummary& s)
{
    Json json = Json::object();
    for (const LedgerTerm& term : ledger_terms)
        if (term.side != LedgerSide::aside)
            json[term.name] = s.energy.*term.value;
    json["kinetic"] = s.stored.kinetic;
    json["elastic_normal"] = s.stored.elastic_normal;
    json["elastic_shear"] = s.stored.elastic_shear;
    json["residual"] = residual(s.energy, s.stored);
    json["relative_residual"] = relative_residual(s.energy, s.stored);
    return json;
}

Json timing_json(const RunSummary& s)
{
    Json json = Json::object();
    for (const StageTiming& t : s.timing)
        json[t.name] = {{"min", t.least}, {"mean", t.mean}, {"max", t.greatest}, {"share", t.share}};
    return json;
}

Json thread_json(const ThreadSummary& use)
{
    Json share = Json::object();
    for (std::size_t n = 0; n < use.share.size(); ++n)
        if (use.share[n] > 0.0)
            share[std::to_string(n)] = use.share[n];
    Json changes = Json::array();
    for (const ThreadSummary::Change& change : use.changes)
        changes.push_back({{"cycle", change.cycle}, {"threads", change.threads}});
    return {{"rule", use.fixed ? "fixed" : "auto"}, {"share_of_cycles", share}, {"changes", changes}, {"trials", use.trials}};
}

/// null where none was tried.
Json statics_json(const std::optional<StaticResult>& statics)
{
    if (!statics)
        return {};
    return {{"outcome", statics->outcome},
            {"iterations", statics->iterations},
            {"unbalanced_force_ratio", statics->residual},
            {"loose_blocks", statics->loose}};
}
}  // namespace

std::vector<BoltSummary> summarise_bolts(const Model& model, const State& state)
{
    static constexpr const char* kinds[] = {"anchored", "grouted", "local"};
    static constexpr const char* names[bolt_states] = {"planned", "elastic", "slips", "yielded", "ruptured", "lost"};
    std::vector<BoltSummary> bolts;
    for (std::size_t i = 0; i < model.support.bolts.size(); ++i)
    {
        const Bolt& bolt = model.support.bolts[i];
        const BoltRecord& record = state.support.bolts[i];
        const LinkPlace first = place_of(bolt, bolt.links.front(), state.blocks),
                        last = place_of(bolt, bolt.links.back(), state.blocks);
        double before = 0.0, behind = 0.0;
        for (const BoltSegment& segment : bolt.segments)
        {
            before += segment.part == 0 ? segment.length : 0.0;
            behind += segment.part == bolt.segments.back().part ? segment.length : 0.0;
        }
        bolts.push_back({.name = bolt.name,
                         .kind = kinds[static_cast<int>(bolt.kind)],
                         .status = names[static_cast<int>(record.status)],
                         .from = model.origin + first.first - std::max(before - 0.5 * bolt.length, 0.0) * first.axis,
                         .to = model.origin + last.second + std::max(behind - 0.5 * bolt.length, 0.0) * last.axis,
                         .axial_force = bolt.spacing * record.force,
                         .across_force = bolt.spacing * record.shear_force,
                         .greatest_force = bolt.spacing * record.greatest_force,
                         .elongation = record.elongation,
                         .stored = record.stored,
                         .spent = record.spent});
    }
    return bolts;
}

std::vector<LinerSummary> summarise_liners(const Model& model, const State& state)
{
    std::vector<LinerSummary> liners;
    for (std::size_t i = 0; i < model.support.liners.size(); ++i)
    {
        const Liner& liner = model.support.liners[i];
        const LinerRecord& r = state.support.liners[i];
        const LinerRest rest = rest_of_liner(model, state, i);
        LinerSummary& made = liners.emplace_back();
        made = {.name = liner.name,
                .installed = r.installed != 0,
                .thrust = r.thrust,
                .moment = r.moment,
                .displacement = r.displacement,
                .hinges = r.hinges,
                .parted = r.parted,
                .stored = r.stored,
                .spent = r.spent,
                .unbalanced = rest.unbalanced,
                .is_off = rest.motion == LinerMotion::has_come_off,
                .moves = rest.motion == LinerMotion::moves,
                .is_far = r.displacement >
                          std::sqrt(12.0 * liner.bending_stiffness / liner.axial_stiffness),  // of a rectangle: its height
                .segments = {}};
        if (!made.installed)
            continue;
        const std::vector<LinerForce> forces = liner_forces(model, state, i);
        const std::vector<Vec2> nodes = liner_nodes(model, state, i);
        for (std::size_t s = 0; s < liner.segments.size(); ++s)
            made.segments.push_back({.from = model.origin + nodes[liner.segments[s].node[0]],
                                     .to = model.origin + nodes[liner.segments[s].node[1]],
                                     .thrust = forces[s].thrust,
                                     .shear = forces[s].shear,
                                     .moment = {forces[s].moment[0], forces[s].moment[1]}});
    }
    return liners;
}

namespace
{
Json liners_json(const RunSummary& s)
{
    Json liners = Json::array();
    for (const LinerSummary& liner : s.liners)
    {
        Json segments = Json::array();
        for (const LinerPiece& piece : liner.segments)
            segments.push_back({{"from", {piece.from.x(), piece.from.y()}},
                                {"to", {piece.to.x(), piece.to.y()}},
                                {"thrust", piece.thrust},
                                {"shear", piece.shear},
                                {"moment", piece.moment}});
        liners.push_back({{"name", liner.name},
                          {"installed", liner.installed},
                          {"thrust", liner.thrust},
                          {"moment", liner.moment},
                          {"displacement", liner.displacement},
                          {"hinges", liner.hinges},
                          {"parted", liner.parted},
                          {"stored", liner.stored},
                          {"spent", liner.spent},
                          {"segments", segments}});
    }
    return liners;
}
}  // namespace

namespace
{
Json drawn_json(const DrawnNumber& drawn)
{
    return drawn.count == 0 ? Json() : Json{{"count", drawn.count}, {"mean", drawn.mean()}, {"expected", drawn.expected}};
}

Json joint_sets_json(const RunSummary& s)
{
    Json sets = Json::array();
    for (const DrawnSet& set : s.joint_sets)
        sets.push_back({{"name", set.name},
                        {"joints", set.joints},
                        {"dip_deg", drawn_json(set.dip)},
                        {"spacing", drawn_json(set.spacing)},
                        {"trace", drawn_json(set.trace)},
                        {"gap", drawn_json(set.gap)},
                        {"length", set.length},
                        {"skipped_share", set.length > 0.0 ? set.skipped / set.length : 0.0},
                        {"refused_share", set.length > 0.0 ? set.refused / set.length : 0.0},
                        {"dead_ends_share", set.length > 0.0 ? set.dead_ends / set.length : 0.0},
                        {"welded_share", set.length > 0.0 ? set.welded / set.length : 0.0}});
    return sets;
}

/// Room for all keys is made at once: there may be thousands of stages, and nlohmann copies an object that grows.
Json stage_json(const StageSummary& stage)
{
    constexpr std::size_t keys = 10;
    Json json = Json::object();
    auto& object = json.get_ref<Json::object_t&>();
    object.reserve(keys);
    object.emplace_back("name", stage.name);
    object.emplace_back("cycles", stage.cycles);
    object.emplace_back("until_converged", stage.sought_rest);
    object.emplace_back("converged", stage.at_rest);
    object.emplace_back("ended_by", stage.ended_by);
    object.emplace_back("end_value", stage.end_value ? Json(*stage.end_value) : Json());
    object.emplace_back("end_time", stage.end_time);
    object.emplace_back("to_come", stage.to_come);
    object.emplace_back("not_at_rest", stage.not_at_rest);
    object.emplace_back("static_solution", statics_json(stage.statics));
    return json;
}
}  // namespace

std::string summary_text(const RunSummary& s)
{
    Json stages = Json::array();
    for (const StageSummary& stage : s.stages)
        stages.push_back(stage_json(stage));
    Json bolts = Json::array();
    for (const BoltSummary& bolt : s.bolts)
        bolts.push_back({{"name", bolt.name},
                         {"kind", bolt.kind},
                         {"status", bolt.status},
                         {"from", {bolt.from.x(), bolt.from.y()}},
                         {"to", {bolt.to.x(), bolt.to.y()}},
                         {"axial_force", bolt.axial_force},
                         {"across_force", bolt.across_force},
                         {"greatest_force", bolt.greatest_force},
                         {"elongation", bolt.elongation},
                         {"stored", bolt.stored},
                         {"spent", bolt.spent}});
    Json stage_seconds = Json::array();
    for (const StageSummary& stage : s.stages)
        stage_seconds.push_back(stage.wall_seconds);
    const Json json = {
        {"case", s.case_name},
        {"title", s.title},
        {"method", s.method},
        {"threads", s.threads},
        {"thread_use", thread_json(s.thread_use)},
        {"version", s.version},
        {"git_commit", s.git_commit},
        {"blocks", s.blocks},
        {"free_blocks", s.free_blocks},
        {"contact_points", s.contact_points},
        {"time_step", s.time_step},
        {"paper_time_step", s.paper_time_step},
        {"smallest_block_mass", s.smallest_block_mass},
        {"cycles", s.cycles},
        {"time", s.time},
        {"converged", s.converged},
        {"met_ends", s.met_ends},
        {"cycles_after_excavation", s.cycles_after_excavation ? Json(*s.cycles_after_excavation) : Json()},
        {"stages", std::move(stages)},
        {"kinetic_energy", s.kinetic_energy},
        {"kinetic_energy_limit", s.kinetic_energy_limit},
        {"unbalanced_force_ratio", s.unbalanced_force_ratio},
        {"mean_displacement", s.mean_displacement},
        {"max_displacement", s.max_displacement},
        {"mean_displacement_all", s.mean_displacement_all},
        {"max_displacement_all", s.max_displacement_all},
        {"detached_blocks", s.detached_blocks},
        {"detached_before", s.detached_before},
        {"lost_blocks", s.lost_blocks},
        {"joint_sets", joint_sets_json(s)},
        {"bolts", std::move(bolts)},
        {"liners", liners_json(s)},
        {"energy", energy_json(s)},
        {"wall_seconds", s.wall_seconds},
        {"stage_wall_seconds", std::move(stage_seconds)},
        {"contact_point_updates_per_second", s.contact_point_updates_per_second},
        {"timing", timing_json(s)},
        {"state_hash", fmt::format("{:016x}", s.state_hash)},
        {"warnings", s.warnings},
    };
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const std::filesystem::path& file, const RunSummary& summary)
{
    write_atomically(file, summary_text(summary));
}
}  // namespace hdem
