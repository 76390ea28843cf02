#include "verification/rest/rest.h"

#include "core/check.h"
#include "verification/rest/families.h"
#include "verification/rest/judge.h"
#include "verification/rest/run.h"
#include "verification/rest/springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

namespace hdem::verification
{
namespace rest
{
namespace
{
constexpr int most_rows = 20;  // of wrong scenes, a family

/// What was found in all scenes of a family.
class Tally
{
  public:
    Tally(Report& report, std::string family) : report_(report), family_(std::move(family)) {}

    void add(const Scene& scene, const Findings& findings)
    {
        ++scenes_;
        const Finding* worst = nullptr;
        for (const Finding& finding : findings)
        {
            Worst& kind = worst_[static_cast<std::size_t>(finding.what)];
            ++kind.looked_at;
            if (kind.scene < 0 || !(finding.share <= kind.share))
                kind = {finding.share, scene.number, kind.looked_at, kind.wrong};
            kind.wrong += finding.is_wrong() ? 1 : 0;
            if (finding.is_wrong() && (worst == nullptr || !(finding.share <= worst->share)))
                worst = &finding;
        }
        if (worst == nullptr)
            return;
        ++wrong_;
        if (wrong_ <= most_rows)
            rows_.push_back({fmt::format("#{} {}: {}", scene.number, describe(scene), all_wrong(findings)),
                             fmt::format("rest.{} --scene {}", family_, scene.number), 1.0, worst->share});
    }

    void report()
    {
        report_.require({fmt::format("wrong scenes of {}", scenes_), "", 0.0, static_cast<double>(wrong_)}, absolute(0.0));
        for (int i = 0; i < judged_kinds; ++i)
            if (const Worst& worst = worst_[static_cast<std::size_t>(i)]; worst.looked_at > 0)
                report_.require({fmt::format("{}: worst [of its bar] (#{}; {} of {} wrong)", name_of(static_cast<Judged>(i)),
                                             worst.scene, worst.wrong, worst.looked_at),
                                 "verification/rest.md", 1.0, worst.share},
                                at_most());
        for (const Quantity& row : rows_)
            report_.require(row, at_most());
        if (wrong_ > most_rows)
            report_.inform("wrong scenes that are not shown", "", wrong_ - most_rows);
    }

    [[nodiscard]] static std::string describe(const Scene& scene)
    {
        const Method method = scene.def.contact.method;
        return fmt::format(
            "{} ({}, {}, {})", scene.what, method == Method::force ? "force" : (method == Method::impulse ? "impulse" : "hybrid"),
            scene.def.time.step ? fmt::format("step {:.3g} s", *scene.def.time.step) : "own step", scene.placement.name());
    }

  private:
    struct Worst
    {
        double share = 0.0;
        int scene = -1;
        int looked_at = 0;
        int wrong = 0;
    };

    static std::string all_wrong(const Findings& findings)
    {
        std::string text;
        for (const Finding& finding : findings)
            if (finding.is_wrong())
                text += (text.empty() ? "" : "; ") + finding.text;
        return text;
    }

    Report& report_;
    std::string family_;
    std::array<Worst, judged_kinds> worst_{};
    std::vector<Quantity> rows_;
    int scenes_ = 0;
    int wrong_ = 0;
};

void write_file(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream out(file);
    if (!(out << text).flush())
        throw RunError(file.string() + ": cannot be written. Give another folder with --write-case.");
}

void write_case(const Scene& scene)
{
    const std::filesystem::path& folder = rest_options().write_case;
    if (folder.empty())
        return;
    std::filesystem::create_directories(folder);
    const std::string name = fmt::format("{}_{}", scene.family, scene.number);
    write_file(folder / (name + ".toml"), scene_text(scene, scene.placement));
    write_file(folder / (name + "_twin.toml"), scene_text(scene, scene.twin));
    write_file(folder / (name + "_upright.toml"), scene_text(scene, {}));
}

/// What stands by limit analysis is only said to stay where it does in a slow run by springs, at a tenth of the step, without the short cuts of stages that run
/// until they have converged: with friction that does not dilate the static theorem is not enough. What moves there is left open.
void ask_slow_run(Scene& scene)
{
    if (scene.slow_run == 0.0)
        return;
    Scene slow = slow_version(scene, 0.1 * 0.9 * stable_limit(scene), scene.slow_run);
    slow.def.contact.method = Method::force;
    const Outcome outcome = run_scene(slow, {});
    if (outcome.failure.empty() && farthest_way(outcome) < 0.5 * scene.stay)
        return;
    std::ranges::replace(scene.fate, Fate::stays, Fate::open);
    scene.end = End::open;
    scene.same_in_twin = false;
    scene.what += ", moves in the slow run";
}

Findings find_in_runs(const Scene& scene)
{
    const Outcome outcome = run_scene(scene, scene.placement);
    Findings findings = judge(scene, outcome);
    if (!scene.has_twin)
        return findings;
    const Outcome twin = run_scene(scene, scene.twin);
    for (Finding& finding : judge(scene, twin))
    {
        finding.text = scene.twin.name() + ": " + finding.text;
        findings.push_back(std::move(finding));
    }
    for (Finding& finding : judge_twins(scene, outcome, twin))
        findings.push_back(std::move(finding));
    return findings;
}

/// What goes wrong in the judge itself is found too, and costs no other scene.
Findings find(const Scene& scene)
{
    try
    {
        return find_in_runs(scene);
    }
    catch (const std::exception& error)
    {
        return {{Judged::finished, std::numeric_limits<double>::infinity(), error.what()}};
    }
}

void report_one(Report& report, const Scene& scene, const Findings& findings)
{
    report.inform(Tally::describe(scene), "", scene.number);
    for (const Finding& finding : findings)
        report.require({fmt::format("{}: {}", name_of(finding.what), finding.text), "share of its bar", 1.0, finding.share},
                       at_most());
}

/// Rock faces and arches many times beside each other, so that three threads share them.
void check_threads(Report& report)
{
    constexpr int scenes = 6;
    Tally tally(report, "threads");
    for (int i = 0; i < std::min(scenes, rest_options().scenes.value_or(scenes)); ++i)
    {
        const int number = rest_options().scene.value_or(i);
        const Scene scene = threads_scene(number);
        const Findings findings = judge_threads(scene);
        tally.add(scene, findings);
        if (!rest_options().scene)
            continue;
        write_case(scene);
        report_one(report, scene, findings);
        return;
    }
    tally.report();
}

/// @param most  as many as the option may ask for: drawn scenes never end
void check_family(Report& report, const char* name, Scene (*build)(int), int scenes, int most = std::numeric_limits<int>::max())
{
    const RestOptions& options = rest_options();
    if (options.scene)
    {
        Scene scene = build(*options.scene);
        ask_slow_run(scene);
        write_case(scene);
        report_one(report, scene, find(scene));
        return;
    }
    Tally tally(report, name);
    for (int i = 0; i < std::min(most, options.scenes.value_or(scenes)); ++i)
    {
        Scene scene = build(i);
        ask_slow_run(scene);
        tally.add(scene, find(scene));
    }
    tally.report();
}
}  // namespace
}  // namespace rest

RestOptions& rest_options()
{
    static RestOptions options;
    return options;
}

std::vector<Check> rest_checks()
{
    constexpr auto length = Check::Length::is_long;
    using namespace rest;
    // The long ones first: the program starts them in this order.
    return {
        {"rest.heap", "many blocks that fall", [](Report& r) { check_family(r, "heap", heap_scene, 60); }, length},
        {"rest.concave", "blocks with hollow corners that fall", [](Report& r) { check_family(r, "concave", concave_scene, 60); },
         length},
        {"rest.known", "scenes that came to a wrong rest, in 36 orientations",
         [](Report& r) { check_family(r, "known", known_scene, known_scenes, known_scenes); }, length},
        {"rest.rubble", "a jointed rock face", [](Report& r) { check_family(r, "rubble", rubble_scene, 120); }, length},
        {"rest.arch", "arches with one heavy block", [](Report& r) { check_family(r, "arch", arch_scene, 90); }, length},
        {"rest.incline", "a block on a slope", [](Report& r) { check_family(r, "incline", incline_scene, 240); }, length},
        {"rest.tiles", "a block on a slope of many blocks", [](Report& r) { check_family(r, "tiles", tiles_scene, 240); }, length},
        {"rest.stack", "blocks on each other", [](Report& r) { check_family(r, "stack", stack_scene, 180); }, length},
        {"rest.notch", "a block between two planes", [](Report& r) { check_family(r, "notch", notch_scene, 120); }, length},
        {"rest.wedge", "plane failure of a slope", [](Report& r) { check_family(r, "wedge", wedge_scene, 150); }, length},
        {"rest.drop", "a block that falls beside or on another", [](Report& r) { check_family(r, "drop", drop_scene, 240); },
         length},
        {"rest.threads", "the same bits on 1, 2 and 3 threads", check_threads, length}};
}
}  // namespace hdem::verification
