/// hdem_verify: each published number and each textbook answer beside hdem's own.

#include "core/check.h"
#include "core/version.h"
#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"
#include "verification/checks/figure_json.h"
#include "verification/rest/rest.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <thread>
#include <utility>

namespace hdem::verification
{
namespace
{
enum ExitCode : int
{
    exit_done = 0,
    exit_run_failed = 1,
    exit_bad_usage = 2,
    exit_missed = 3
};

struct Options
{
    std::vector<std::string> names;
    std::string json_file;
    std::string curves_file;
    std::string cases = HDEM_CASE_FOLDER;
    unsigned jobs = 0;
    bool list = false;
    bool commands = false;
    bool misses = false;
};

struct Outcome
{
    Report report;
    std::string failure;
    double seconds = 0.0;
};

bool is_asked(const Check& check, const std::vector<std::string>& names)
{
    return names.empty() || std::ranges::any_of(names,
                                                [&](const std::string& name)
                                                {
                                                    return check.name == name || check.name.starts_with(name + '.') ||
                                                           (name == "short" && check.length == Check::Length::is_short);
                                                });
}

Outcome run_check(const Check& check)
{
    Outcome outcome;
    const auto start = std::chrono::steady_clock::now();
    try
    {
        check.run(outcome.report);
        outcome.report.close();
    }
    catch (const InputError& error)
    {
        for (const Problem& problem : error.problems())
            outcome.failure += problem.text + '\n';
    }
    catch (const std::exception& error)
    {
        outcome.failure = error.what();
    }
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
}

/// Checks share nothing, so each thread takes the next one. `tell` is called for each in their order, as soon as it is done and those before it are told: a long run that is
/// broken off has shown what it had found.
template <typename Tell>
std::vector<Outcome> run_checks(const std::vector<Check>& checks, unsigned jobs, const Tell& tell)
{
    std::vector<Outcome> outcomes(checks.size());
    std::vector<std::uint8_t> is_done(checks.size());
    std::size_t told = 0;
    std::mutex telling;
    std::atomic<std::size_t> next{0};
    const auto work = [&]
    {
        for (std::size_t i = next++; i < checks.size(); i = next++)
        {
            Outcome outcome = run_check(checks[i]);
            const std::scoped_lock lock(telling);
            outcomes[i] = std::move(outcome);
            is_done[i] = 1;
            for (; told < checks.size() && is_done[told] != 0; ++told)
                tell(checks[told], outcomes[told]);
        }
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < jobs; ++i)
        threads.emplace_back(work);
    work();
    threads.clear();
    return outcomes;
}

const char* word(Verdict verdict)
{
    return verdict == Verdict::pass ? "pass" : (verdict == Verdict::miss ? "MISS" : "");
}

std::string number(double value)
{
    return std::isnan(value) ? "-" : fmt::format("{:.6g}", value);
}

void print_table(const Check& check, const Outcome& outcome, const Options& options)
{
    fmt::print("\n{}: {} ({:.1f} s)\n", check.name, check.what, outcome.seconds);
    fmt::print("  {:<66} {:<30} {:>12} {:>12} {:>11} {:>10} {}\n", "quantity", "source", "reference", "ours", "deviation", "bar",
               "verdict");
    for (const Row& row : outcome.report.rows())
        if (!options.misses || row.verdict == Verdict::miss)
            fmt::print("  {:<66} {:<30} {:>12} {:>12} {:>11} {:>10} {}\n", row.quantity.name, row.quantity.source,
                       number(row.quantity.reference), number(row.quantity.measured), row.deviation_text(), row.bar_text(),
                       word(row.verdict));
    if (!outcome.failure.empty())
        fmt::print("  MISS: did not run to its end: {}\n", outcome.failure);
    if (options.commands)
        for (const std::string& command : outcome.report.commands())
            fmt::print("  {}\n", command);
    std::fflush(stdout);
}

nlohmann::json json_number(double value)
{
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json as_json(const std::vector<Check>& checks, const std::vector<Outcome>& outcomes)
{
    nlohmann::json rows = nlohmann::json::array();
    for (std::size_t i = 0; i < checks.size(); ++i)
    {
        for (const Row& row : outcomes[i].report.rows())
            rows.push_back({{"case", checks[i].name},
                            {"quantity", row.quantity.name},
                            {"source", row.quantity.source},
                            {"reference", json_number(row.quantity.reference)},
                            {"measured", json_number(row.quantity.measured)},
                            {"deviation", json_number(row.deviation())},
                            {"tolerance", row.bar ? nlohmann::json(row.bar->tolerance) : nlohmann::json()},
                            {"bar", row.bar_text()},
                            {"pass", row.bar ? nlohmann::json(row.verdict == Verdict::pass) : nlohmann::json()}});
        if (!outcomes[i].failure.empty())
            rows.push_back(
                {{"case", checks[i].name}, {"quantity", "runs to its end"}, {"source", outcomes[i].failure}, {"pass", false}});
    }
    return rows;
}

/// {hdem, checks: [{name, what, seconds}], figures}: what the rows say nothing about.
nlohmann::json curves_json(const std::vector<Check>& checks, const std::vector<Outcome>& outcomes)
{
    nlohmann::json done = nlohmann::json::array();
    nlohmann::json figures = nlohmann::json::array();
    for (std::size_t i = 0; i < checks.size(); ++i)
    {
        done.push_back({{"name", checks[i].name}, {"what", checks[i].what}, {"seconds", outcomes[i].seconds}});
        for (const Figure& figure : outcomes[i].report.figures())
        {
            figures.push_back(as_json(figure));
            figures.back()["check"] = checks[i].name;
        }
    }
    const Version& build = version();
    return {{"hdem", {{"line", version_line()}, {"flags", build.flags}}}, {"checks", done}, {"figures", figures}};
}

/// False, with a message, when the file cannot be written.
bool write(const std::string& name, const char* option, const nlohmann::json& content, int indent)
{
    std::ofstream file(name);
    file << content.dump(indent) << '\n';
    if (file.flush())
        return true;
    fmt::print(stderr, "error: {}: cannot be written. Give another file with {}.\n", name, option);
    return false;
}

int report_all(const std::vector<Check>& checks, const std::vector<Outcome>& outcomes, const Options& options)
{
    int met = 0;
    int missed = 0;
    for (std::size_t i = 0; i < checks.size(); ++i)
    {
        for (const Row& row : outcomes[i].report.rows())
        {
            met += row.verdict == Verdict::pass ? 1 : 0;
            missed += row.verdict == Verdict::miss ? 1 : 0;
        }
        missed += outcomes[i].failure.empty() ? 0 : 1;
    }
    fmt::print("\n{} checks: {} bars met, {} missed\n", checks.size(), met, missed);
    if (!options.json_file.empty() && !write(options.json_file, "--json", as_json(checks, outcomes), 1))
        return exit_run_failed;
    if (!options.curves_file.empty() && !write(options.curves_file, "--curves", curves_json(checks, outcomes), -1))
        return exit_run_failed;
    return missed == 0 ? exit_done : exit_missed;
}

int verify(int argc, char** argv)
{
    CLI::App app("hdem_verify: published numbers and textbook answers beside hdem's own", "hdem_verify");
    Options options;
    app.add_option("CASE", options.names,
                   "Checks to run: a name of --list, a group, which is what stands before the point of a name, or short: those "
                   "that take less than twenty seconds; all by default");
    app.add_option("--json", options.json_file, "Write all rows to this file");
    app.add_option("--curves", options.curves_file, "Write the figures' curves to this file");
    app.add_option("--jobs", options.jobs, "Checks at a time; default: one a core")->check(CLI::Range(1, 1024));
    app.add_option("--cases", options.cases, "Folder of the case files")->check(CLI::ExistingDirectory);
    RestOptions& rest = rest_options();
    CLI::Option* const scene = app.add_option("--scene", rest.scene, "Of rest.NAME: only this scene, and all that was found")
                                   ->check(CLI::NonNegativeNumber);
    app.add_option("--scenes", rest.scenes, "Of rest.*: so many scenes of each, fewer or more than by default")
        ->check(CLI::PositiveNumber);
    app.add_option("--write-case", rest.write_case, "Write the case files of --scene into this folder")->needs(scene);
    app.add_flag("--list", options.list, "Only list the checks");
    app.add_flag("--commands", options.commands, "Show the hdem commands that repeat the runs");
    app.add_flag("--misses", options.misses, "Show only rows that miss their bar");
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
        return app.exit(error) == 0 ? exit_done : exit_bad_usage;
    }
    case_folder() = options.cases;
    std::vector<Check> checks = all_checks();
    for (const std::string& name : options.names)
        if (std::ranges::none_of(checks, [&](const Check& check) { return is_asked(check, {name}); }))
        {
            fmt::print(stderr, "error: check \"{}\" (no such check). hdem_verify --list shows their names.\n", name);
            return exit_bad_usage;
        }
    std::erase_if(checks, [&](const Check& check) { return !is_asked(check, options.names); });
    if (options.list)
    {
        for (const Check& check : checks)
            fmt::print("{:<18} {:<6} {}\n", check.name, check.length == Check::Length::is_short ? "short" : "long", check.what);
        return exit_done;
    }
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    const std::vector<Outcome> outcomes = run_checks(checks, options.jobs > 0 ? options.jobs : cores,
                                                     [&](const Check& check, const Outcome& outcome)
                                                     { print_table(check, outcome, options); });
    return report_all(checks, outcomes, options);
}
}  // namespace
}  // namespace hdem::verification

int main(int argc, char** argv)
{
    try
    {
        return hdem::verification::verify(argc, argv);
    }
    catch (const std::exception& error)
    {
        fmt::print(stderr, "error: {}\n", error.what());
        return hdem::verification::exit_run_failed;
    }
}
