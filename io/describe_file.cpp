#include "io/describe_file.h"

#include "core/check.h"
#include "core/stage/rules.h"
#include "io/digest.h"
#include "io/hdf5_reader.h"
#include "io/load_case.h"

#include <fmt/format.h>

#include <fstream>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

/// Lines of a name and what there is to say; nothing for an empty text.
struct Page
{
    std::string text;

    void add(std::string_view what, const std::string& value)
    {
        if (!value.empty())
            text += fmt::format("{:<16} {}\n", what, value);
    }
};

template <class T>
T number(const Hdf5Reader& in, const std::string& object, const std::string& name)
{
    return in.attribute<T>(object, name, {}).front();
}

std::int64_t count(const Hdf5Reader& in, const std::string& array)
{
    return in.read<std::int64_t>("/VTKHDF/" + array, {1}).front();
}

std::uint64_t rows(const Hdf5Reader& in, const std::string& dataset)
{
    const Shape shape = in.shape(dataset);
    if (shape.empty())
        in.fail(dataset, "a single number");
    return shape.front();
}

std::string commit_of(const Hdf5Reader& in, const std::string& object)
{
    const bool changed = in.has_attribute(object, "git_dirty") && number<std::uint8_t>(in, object, "git_dirty") != 0;
    return fmt::format("hdem {} ({}{})", in.text(object, "hdem_version"), in.text(object, "git_commit").substr(0, 10),
                       changed ? ", changed" : "");
}

void describe_format(Page& page, const Hdf5Reader& in, const std::string& object, const std::string& what)
{
    const auto version = in.attribute<std::int64_t>(object, "version", {2});
    page.add("file", fmt::format("{}, format {}.{}", what, version[0], version[1]));
}

void describe_frame(Page& page, const Hdf5Reader& in, const std::string& filetype)
{
    const std::string kind = filetype.substr(filetype.find('-') + 1);
    describe_format(page, in, "/hdem", "frame of " + kind);
    page.add("title", in.text("/hdem", "title"));
    page.add("stage", in.text("/hdem", "stage"));
    page.add("cycle", fmt::format("{}", number<std::int64_t>(in, "/hdem", "cycle")));
    page.add("time", fmt::format("{:.6g} s", number<double>(in, "/hdem", "time")));
    if (kind == "blocks")
        page.add("blocks", fmt::format("{} ({} convex parts)", rows(in, "/hdem/block_id"), count(in, "NumberOfCells")));
    else
        page.add(kind, fmt::format("{}", count(in, "NumberOfCells")));
    page.add("fields", fmt::format("{}", fmt::join(in.children("/VTKHDF/CellData"), ", ")));
    page.add("written by", commit_of(in, "/hdem"));
}

void describe_table(Page& page, const Hdf5Reader& in, const std::string& name, const std::string& path)
{
    page.add(name, fmt::format("{} rows: {}", rows(in, path + "/cycle"), fmt::join(in.children(path), ", ")));
}

void describe_results(Page& page, const Hdf5Reader& in)
{
    const std::string from = "/provenance";
    describe_format(page, in, "/", "results of a run");
    page.add("case", fmt::format("{} (SHA-256 {:.12}...)", in.text(from, "case_file"), in.text(from, "case_sha256")));
    page.add("set besides", fmt::format("{}", fmt::join(in.read_texts(from + "/overrides"), " ")));
    page.add("command", fmt::format("{}", fmt::join(in.read_texts(from + "/command_line"), " ")));
    page.add("begin", in.text(from, "begin"));
    const std::string end = in.text(from, "end");
    page.add("end", end.empty() ? "not reached: the run goes on, was stopped or killed" : end);
    page.add("written by", commit_of(in, from));
    page.add("built with",
             fmt::format("{}, {}, {}", in.text(from, "compiler"), in.text(from, "build_type"), in.text(from, "flags")));
    page.add("machine", fmt::format("{}, {}, {} threads", in.text(from, "hostname"), in.text(from, "cpu"),
                                    number<std::int64_t>(in, from, "threads")));
    page.add("seed", fmt::format("{}", number<std::uint64_t>(in, from, "seed")));
    const auto cycles = in.read<std::int64_t>("/frames/cycle", {any_extent});
    const auto times = in.read<double>("/frames/time", {cycles.size()});
    page.add("frames", cycles.empty()
                           ? "none"
                           : fmt::format("{}, the last at cycle {}, {:.6g} s", cycles.size(), cycles.back(), times.back()));
    describe_table(page, in, "energy", "/energy");
    for (const std::string& name : in.children("/history"))
        describe_table(page, in, fmt::format("history {}", printable(name)), "/history/" + name);
}

void describe_checkpoint(Page& page, const Hdf5Reader& in)
{
    describe_format(page, in, "/", "checkpoint");
    page.add("case", in.text("/case", "file"));
    page.add("set besides", fmt::format("{}", fmt::join(in.read_texts("/case/overrides"), " ")));
    page.add("cycle", fmt::format("{}", number<std::int64_t>(in, "/state", "cycle")));
    page.add("time", fmt::format("{:.6g} s", number<double>(in, "/state", "time")));
    page.add("stage", fmt::format("number {}, begun at cycle {}", std::int64_t{number<std::int32_t>(in, "/state", "stage")} + 1,
                                  number<std::int64_t>(in, "/state", "stage_begin_cycle")));
    page.add("run", fmt::format(
                        "begun {}, {:.6g} s of wall time, {}", in.text("/run", "begin"), number<double>(in, "/run", "wall_seconds"),
                        number<std::uint8_t>(in, "/run", "finished") != 0 ? "finished" : "can go on: hdem run --restart FOLDER"));
    page.add("blocks", fmt::format("{}", rows(in, "/blocks/user_number")));
    page.add("written", in.text("/", "date_and_time"));
    page.add("written by", commit_of(in, "/"));
}

[[noreturn]] void refuse(const fs::path& file, std::string_view why)
{
    const std::string text = fmt::format("{}: {}. Give a run's folder, a results.h5, a frame, a checkpoint or a case.",
                                         file.string(), why);
    throw InputError(std::vector<Problem>{{Problem::Severity::error, "", text}});
}

void describe_hdf5(Page& page, const fs::path& file)
{
    const Hdf5Reader in(file);
    for (const std::string object : {"/", "/hdem"})
    {
        if ((object != "/" && !in.has(object)) || !in.has_attribute(object, "filetype"))
            continue;
        const std::string filetype = in.text(object, "filetype");
        if (filetype == "hdem-results")
            return describe_results(page, in);
        if (filetype == "hdem-checkpoint")
            return describe_checkpoint(page, in);
        if (filetype == "hdem-blocks" || filetype == "hdem-contacts" || filetype == "hdem-bolts" || filetype == "hdem-liners")
            return describe_frame(page, in, filetype);
    }
    refuse(file, "an HDF5 file, but none of hdem's");
}

/// When a stage ends.
std::string end_of(const StageDef& stage)
{
    if (stage.cycles)
        return fmt::format("{} cycles", *stage.cycles);
    if (stage.duration)
        return fmt::format("{:.6g} s", *stage.duration);
    std::vector<std::string> ends;
    if (ends_at_rest(stage))
        ends.emplace_back("converged");
    for (const StageEndDef& end : stage.ends)
        ends.push_back(end.text);
    return fmt::format("until {}, at most {} cycles", fmt::join(ends, " or "), stage.max_cycles);
}

void describe_case(Page& page, const fs::path& file)
{
    const CaseFile read = read_case_file(file);
    const CaseDef& def = read.def;
    page.add("file", "case");
    page.add("title", def.title);
    page.add("SHA-256", sha256_hex(read.source.text()));
    if (def.domain.given)
        page.add("domain", fmt::format("{} joint sets, {} excavations, seed {}", def.joint_sets.size(), def.excavations.size(),
                                       def.generator.seed));
    page.add("explicit blocks", fmt::format("{}", def.blocks.size()));
    for (const StageDef& stage : def.stages)
        page.add("stage",
                 fmt::format("{}: {}{}", stage.name, end_of(stage),
                             stage.excavate.empty()
                                 ? ""
                                 : fmt::format(", excavates {}", fmt::join(stage.excavate, ", ")) +
                                       (stage.relax_cycles == 0 ? "" : fmt::format(" over {} cycles", stage.relax_cycles))));
    for (const HistoryDef& history : def.histories)
        page.add("history", fmt::format("{}: {}", history.name, fmt::join(history.quantities, ", ")));
    for (const Problem& warning : read.warnings)
        page.text += warning.text + "\n";
}

bool is_hdf5(const fs::path& file)
{
    std::string signature(8, '\0');
    std::ifstream(file, std::ios::binary).read(signature.data(), 8);
    return signature == "\x89HDF\r\n\x1a\n";
}
}  // namespace

std::string describe_file(const fs::path& path)
{
    const fs::path file = fs::is_directory(path) ? path / "results.h5" : path;
    if (!fs::exists(file))
        refuse(file, "no such file");
    if (!fs::is_regular_file(file))
        refuse(file, "not a file that can be read: a pipe, a socket or a device");
    Page page;
    try
    {
        if (is_hdf5(file))
            describe_hdf5(page, file);
        else
            describe_case(page, file);
    }
    catch (const RunError& error)
    {
        throw InputError(
            Problem{.key = {}, .text = std::string(error.what()) + " The file is damaged, or of another version of hdem."});
    }
    return page.text;
}
}  // namespace hdem
