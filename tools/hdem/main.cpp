/// hdem: jointed rock made of rigid polygonal blocks. One subcommand a file.

#include "core/check.h"
#include "core/version.h"
#include "io/case_format.h"
#include "io/describe_file.h"
#include "io/printable.h"
#include "parallel/team.h"
#include "tools/hdem/console.h"
#include "tools/hdem/options.h"
#include "tools/hdem/script.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <charconv>
#include <cmath>

namespace hdem
{
namespace
{
/// Digits alone, and no more than fit; nothing for other texts.
std::optional<int> whole_number(const std::string& text)
{
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

void add_threads(CLI::App& command, std::optional<int>& threads)
{
    command
        .add_option_function<std::string>(
            "--threads", [&threads](const std::string& text) { threads = whole_number(text); },
            "Number of threads, or auto: as many as are fastest, looked for again and again; default: auto")
        ->check(
            [](const std::string& text)
            {
                const std::optional<int> number = whole_number(text);
                return text == "auto" || (number && *number >= 1 && *number <= 4096)
                           ? std::string()
                           : "--threads " + printable(text) + ": give a whole number from 1 to 4096, or auto";
            });
}

/// A shell variable that is not set leaves an empty text, which would mean the same as no option at all.
void refuse_empty(CLI::Option* option)
{
    option->check([](const std::string& text) { return text.empty() ? "(is empty). Give a name, or leave the option away" : ""; });
}

/// [s], once the unit is taken off; empty when the time is above zero.
std::string problem_of_time(const std::string& seconds)
{
    double number = 0.0;
    const auto [end, error] = std::from_chars(seconds.data(), seconds.data() + seconds.size(), number);
    const bool is_time = error == std::errc() && end == seconds.data() + seconds.size() && number > 0.0 && std::isfinite(number);
    return is_time ? "" : "give a time above zero, e.g. 47h";
}

void add_run(CLI::App& app, RunOptions& options)
{
    CLI::App* run = app.add_subcommand("run", "Run a case to its end and write results into a folder");
    CLI::Option* file = run->add_option("case", options.case_file, "Case file (TOML); io/case_format.md describes it");
    refuse_empty(
        run->add_option("-o,--output", options.folder,
                        "Folder of the results; default: the case file's name without its ending, or the checkpoint's folder"));
    refuse_empty(run->add_option("--restart", options.restart,
                                 "Go on from this checkpoint, or from the last one in this folder; the checkpoint holds the case"));
    run->add_flag("--overwrite", options.overwrite, "Begin anew in a folder whose run was cut short");
    run->add_option("--max-wall", options.max_wall,
                    "Stop in time for this long on the wall, with a checkpoint and exit code 5; seconds, or with s, min, h or d")
        ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}}))
        ->check(&problem_of_time);
    run->add_option("--method", options.method, "Contact method instead of the case's: force, impulse or hybrid")
        ->check(CLI::IsMember({"force", "impulse", "hybrid"}));
    add_threads(*run, options.threads);
    run->add_option("--set", options.overrides,
                    "key.path=value instead of the case file's, e.g. joint.default.cohesion=2e3; repeatable");
    run->add_flag("--live", options.live, "Write view.html as the run goes: a page that follows it in a browser (hdem view)");
    run->add_flag("-q,--quiet", options.quiet, "Nothing on the screen but errors; run.log has it all");
    run->callback(
        [&options, file]
        {
            if (options.restart.empty() && file->count() == 0)
                throw CLI::RequiredError("case");
        });
}

void add_fos(CLI::App& app, FosOptions& options)
{
    CLI::App* fos = app.add_subcommand("fos", "Find the factor of safety: run a case, then divide its strength until blocks fail");
    RunOptions& run = options.run;
    fos->add_option("case", run.case_file, "Case file (TOML); its table [factor_of_safety] says how")->required();
    refuse_empty(
        fos->add_option("-o,--output", run.folder, "Folder of the results; default: the case file's name without its ending"));
    fos->add_flag("--overwrite", run.overwrite, "Begin anew in a folder that has trials or a run that was cut short");
    add_threads(*fos, run.threads);
    fos->add_option("--set", run.overrides, "key.path=value instead of the case file's; repeatable");
    fos->add_flag("-q,--quiet", run.quiet, "Nothing on the screen but errors; run.log has it all");
}

void add_critical(CLI::App& app, CriticalOptions& options)
{
    CLI::App* critical = app.add_subcommand("critical", "Find the value of a number of the case at which blocks begin to fail");
    critical->add_option("case", options.case_file, "Case file (TOML)")->required();
    critical
        ->add_option("--vary", options.vary,
                     "KEY=LOW:HIGH; the key as --set has it, e.g. gravity.tilt_deg=0:60 or load[0].force[1]=-1e6:0")
        ->required();
    critical
        ->add_option("--fails", options.fails,
                     "When a run has failed: displacement:BLOCK>METRES or rotation:BLOCK>DEGREES, * for any free block; "
                     "detached>NUMBER of blocks")
        ->required();
    critical->add_option("--tolerance", options.tolerance, "Width of the last bracket; default: a 200th of the range")
        ->check(CLI::PositiveNumber);
    refuse_empty(
        critical->add_option("-o,--output", options.folder, "Folder of the results; default: the case's name with _critical"));
    critical->add_flag("--overwrite", options.overwrite, "Forget the trials that the folder holds");
    add_threads(*critical, options.threads);
    critical->add_option("--set", options.overrides, "key.path=value instead of the case file's; repeatable");
    critical->add_flag("-q,--quiet", options.quiet, "Nothing on the screen but errors; run.log has it all");
}

void add_check(CLI::App& app, CheckOptions& options)
{
    CLI::App* check = app.add_subcommand("check", "Read a case and generate its blocks, without running it");
    check->add_option("case", options.case_file, "Case file (TOML)")->required();
    check->add_option("--set", options.overrides, "key.path=value instead of the case file's; repeatable");
    check
        ->add_option("--write-blocks", options.blocks_file,
                     "Write all blocks to this file: .wkt, which blocks_file reads again, or .geojson")
        ->check(
            [](const std::string& file)
            { return file.ends_with(".wkt") || file.ends_with(".geojson") ? "" : "give a name that ends in .wkt or .geojson"; });
    check->add_flag("--blocks", options.list_blocks, "List all blocks: name, material, area, centroid, fixed or free");
}

/// The first line as everywhere, then what a report of a defect needs.
std::string build_facts()
{
    unsigned major = 0;
    unsigned minor = 0;
    unsigned release = 0;
    H5get_libversion(&major, &minor, &release);
    return fmt::format("{}\ncommit    {}{}\ncompiler  {}\nflags     {}\nHDF5      {}.{}.{}\nthreads   {} at hand", version_line(),
                       version().commit, version().dirty ? ", changed" : "", version().compiler, version().flags, major, minor,
                       release, default_threads());
}

/// A command whose options are read by a script.
CLI::App* add_script(CLI::App& app, const std::string& name, const std::string& what)
{
    CLI::App* script = app.add_subcommand(name, what);
    script->prefix_command();
    script->set_help_flag();
    return script;
}

/// What is wrong with the words of a command, and where help is. The whole help would hide it.
std::string refusal(const CLI::App* app, const CLI::Error& error)
{
    const std::vector<CLI::App*> given = app->get_subcommands();
    const std::string command = given.empty() ? "hdem" : "hdem " + given.front()->get_name();
    if (!given.empty() || error.get_name() != "RequiredError")
        return fmt::format("error: {}: {}. {} --help lists all options.\n", command, error.what(), command);
    std::vector<std::string> known;
    for (const CLI::App* one : app->get_subcommands([](const CLI::App*) { return true; }))
        known.push_back(one->get_name());
    const std::vector<std::string> words = app->remaining();
    const std::string why = words.empty() ? "needs a command" : words.front() + " is no command";
    return fmt::format("error: hdem: {}. There are {}; hdem --help says what they do.\n", why, fmt::join(known, ", "));
}

int dispatch(int argc, char** argv)
{
    CLI::App app("hdem: hybrid discrete element method for jointed rock in two dimensions", "hdem");
    app.set_version_flag("--version", build_facts());
    app.set_help_all_flag("--help-all", "Print the help of all commands and exit");
    app.require_subcommand(1);
    app.failure_message(&refusal);
    RunOptions run;
    run.command_line.assign(argv, argv + argc);
    CheckOptions check;
    bool markdown = false;
    add_run(app, run);
    add_check(app, check);
    FosOptions fos;
    fos.run.command_line = run.command_line;
    add_fos(app, fos);
    CriticalOptions critical;
    add_critical(app, critical);
    CLI::App* info = app.add_subcommand("info", "Say what a file holds: results, a frame, a checkpoint, a case");
    std::string file;
    info->add_option("file", file, "Folder of a run, results.h5, blocks_NNNNNN.hdf, contacts_NNNNNN.hdf, checkpoint.h5 or a case")
        ->required();
    CLI::App* schema = app.add_subcommand("schema", "Print the JSON Schema of case files");
    schema->add_flag("--markdown", markdown, "Print io/case_format.md instead");
    CLI::App* plot = add_script(app, "plot",
                                "Draw a picture of a run: hdem plot RESULT.h5 [-o FILE.png]; --help lists its options");
    CLI::App* report = add_script(app, "report", "Make one HTML page of a run: hdem report FOLDER [-o FILE.html]");
    CLI::App* view = add_script(app, "view",
                                "Make one HTML page that plays the frames of a run, or of two: hdem view RUN [RUN] [-o FILE.html]");
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
        return app.exit(error) == 0 ? exit_done : exit_bad_input;
    }
    if (*schema)
    {
        fmt::print("{}", markdown ? case_format_markdown() : case_json_schema());
        finish_output();
        return exit_done;
    }
    if (*info)
    {
        say("{}", describe_file(file));
        finish_output();
        return exit_done;
    }
    if (app.got_subcommand("fos"))
        return fos_command(fos);
    if (app.got_subcommand("critical"))
        return critical_command(critical);
    if (*plot)
        return run_script("plot", "plot.py", plot->remaining());
    if (*report)
        return run_script("report", "run_report.py", report->remaining());
    if (*view)
        return run_script("view", "run_view.py", view->remaining());
    if (app.got_subcommand("run"))
        return run_command(run);
    const int code = check_command(check);
    finish_output();
    return code;
}
}  // namespace
}  // namespace hdem

int main(int argc, char** argv)
{
    hdem::prepare_console();
    try
    {
        return hdem::dispatch(argc, argv);
    }
    catch (const hdem::InputError& error)
    {
        for (const hdem::Problem& problem : error.problems())
            hdem::complain("error: {}\n", problem.text);
        return hdem::exit_bad_input;
    }
    catch (const std::bad_alloc&)
    {
        hdem::complain(
            "error: the memory is too small for this model. Give fewer blocks: greater spacings of the joint sets, or a smaller "
            "domain.\n");
        return hdem::exit_run_failed;
    }
    catch (const std::exception& error)
    {
        hdem::complain("error: {}\n", error.what());
        return hdem::exit_run_failed;
    }
}
