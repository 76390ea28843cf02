/// hdem info: what a file of hdem holds, without reading its arrays.

#include "core/check.h"
#include "io/digest.h"
#include "io/hdf5_reader.h"
#include "io/load_case.h"
#include "tools/hdem/options.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

void row(std::string_view what, const std::string& value)
{
    if (!value.empty())
        fmt::print("{:<16} {}\n", what, value);
}

template <class T>
T number(const Hdf5Reader& in, const std::string& object, const std::string& name)
{
    return in.attribute<T>(object, name, {}).front();
}

std::int64_t count(const Hdf5Reader& in, const std::string& array)
{
    return in.read<std::int64_t>("/VTKHDF/" + array, {1}).front();
}

std::string commit_of(const Hdf5Reader& in, const std::string& object)
{
    const bool changed = in.has_attribute(object, "git_dirty") && number<std::uint8_t>(in, object, "git_dirty") != 0;
    return fmt::format("hdem {} ({}{})", in.text(object, "hdem_version"), in.text(object, "git_commit").substr(0, 10),
                       changed ? ", changed" : "");
}

void show_format(const Hdf5Reader& in, const std::string& object, const std::string& what)
{
    const auto version = in.attribute<std::int64_t>(object, "version", {2});
    row("file", fmt::format("{}, format {}.{}", what, version[0], version[1]));
}

void show_frame(const Hdf5Reader& in, const std::string& filetype)
{
    const bool blocks = filetype == "hdem-blocks";
    show_format(in, "/hdem", blocks ? "frame of blocks" : "frame of contacts");
    row("title", in.text("/hdem", "title"));
    row("stage", in.text("/hdem", "stage"));
    row("cycle", fmt::format("{}", number<std::int64_t>(in, "/hdem", "cycle")));
    row("time", fmt::format("{:.6g} s", number<double>(in, "/hdem", "time")));
    if (blocks)
        row("blocks", fmt::format("{} ({} convex parts)", in.shape("/hdem/block_id").front(), count(in, "NumberOfCells")));
    else
        row("contacts", fmt::format("{}", count(in, "NumberOfCells")));
    row("fields", fmt::format("{}", fmt::join(in.children("/VTKHDF/CellData"), ", ")));
    row("written by", commit_of(in, "/hdem"));
}

void show_table(const Hdf5Reader& in, const std::string& name, const std::string& path)
{
    const std::uint64_t rows = in.shape(path + "/cycle").front();
    row(name, fmt::format("{} rows: {}", rows, fmt::join(in.children(path), ", ")));
}

void show_results(const Hdf5Reader& in)
{
    const std::string from = "/provenance";
    show_format(in, "/", "results of a run");
    row("case", fmt::format("{} (SHA-256 {:.12}...)", in.text(from, "case_file"), in.text(from, "case_sha256")));
    row("set besides", fmt::format("{}", fmt::join(in.read_texts(from + "/overrides"), " ")));
    row("command", fmt::format("{}", fmt::join(in.read_texts(from + "/command_line"), " ")));
    row("begin", in.text(from, "begin"));
    const std::string end = in.text(from, "end");
    row("end", end.empty() ? "not reached: the run goes on, or was killed" : end);
    row("written by", commit_of(in, from));
    row("built with", fmt::format("{}, {}, {}", in.text(from, "compiler"), in.text(from, "build_type"), in.text(from, "flags")));
    row("machine", fmt::format("{}, {}, {} threads", in.text(from, "hostname"), in.text(from, "cpu"),
                               number<std::int64_t>(in, from, "threads")));
    row("seed", fmt::format("{}", number<std::uint64_t>(in, from, "seed")));
    const auto cycles = in.read<std::int64_t>("/frames/cycle", {any_extent});
    const auto times = in.read<double>("/frames/time", {any_extent});
    row("frames",
        cycles.empty() ? "none" : fmt::format("{}, the last at cycle {}, {:.6g} s", cycles.size(), cycles.back(), times.back()));
    show_table(in, "energy", "/energy");
    for (const std::string& name : in.children("/history"))
        show_table(in, "history", "/history/" + name);
}

[[noreturn]] void refuse(const fs::path& file, std::string_view why)
{
    const std::string text = fmt::format("{}: {}. Give a run's folder, a results.h5, a frame or a case.", file.string(), why);
    throw InputError(std::vector<Problem>{{Problem::Severity::error, "", text}});
}

void show_hdf5(const fs::path& file)
{
    const Hdf5Reader in(file);
    for (const std::string object : {"/", "/hdem"})
    {
        if ((object != "/" && !in.has(object)) || !in.has_attribute(object, "filetype"))
            continue;
        const std::string filetype = in.text(object, "filetype");
        if (filetype == "hdem-results")
            return show_results(in);
        if (filetype == "hdem-blocks" || filetype == "hdem-contacts")
            return show_frame(in, filetype);
    }
    refuse(file, "an HDF5 file, but none of hdem's");
}

void show_case(const fs::path& file)
{
    const CaseFile read = read_case_file(file);
    const CaseDef& def = read.def;
    row("file", "case");
    row("title", def.title);
    row("SHA-256", sha256_hex(read.source.text()));
    if (def.domain.given)
        row("domain", fmt::format("{} joint sets, {} excavations, seed {}", def.joint_sets.size(), def.excavations.size(),
                                  def.generator.seed));
    row("explicit blocks", fmt::format("{}", def.blocks.size()));
    for (const StageDef& stage : def.stages)
        row("stage", fmt::format("{}: {}{}", stage.name,
                                 stage.until_converged ? fmt::format("until converged, at most {} cycles", stage.max_cycles)
                                 : stage.cycles        ? fmt::format("{} cycles", *stage.cycles)
                                                       : fmt::format("{:.6g} s", stage.duration.value_or(0.0)),
                                 stage.excavate.empty() ? "" : fmt::format(", excavates {}", fmt::join(stage.excavate, ", "))));
    for (const HistoryDef& history : def.histories)
        row("history", fmt::format("{}: {}", history.name, fmt::join(history.quantities, ", ")));
    for (const Problem& warning : read.warnings)
        fmt::print("{}\n", warning.text);
}

bool is_hdf5(const fs::path& file)
{
    std::string signature(8, '\0');
    std::ifstream(file, std::ios::binary).read(signature.data(), 8);
    return signature == "\x89HDF\r\n\x1a\n";
}
}  // namespace

int info_command(const std::string& path)
{
    const fs::path file = fs::is_directory(path) ? fs::path(path) / "results.h5" : fs::path(path);
    if (!fs::exists(file))
        refuse(file, "no such file");
    if (is_hdf5(file))
        show_hdf5(file);
    else
        show_case(file);
    return exit_done;
}
}  // namespace hdem
