#include "io/results_writer.h"

#include "core/check.h"
#include "core/version.h"
#include "io/atomic_file.h"
#include "io/hdf5_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds least_interval{10};
constexpr int interval_in_writes = 20;  // writing takes at most 1/20 of the time

void write_table(Hdf5Writer& file, const Table& table)
{
    file.make_group(table.path);
    file.write(table.path + "/cycle", table.cycle);
    file.set_text(table.path + "/cycle", "unit", "1");
    file.write(table.path + "/time", table.time);
    file.set_text(table.path + "/time", "unit", "s");
    for (std::size_t i = 0; i < table.columns.size(); ++i)
    {
        const std::string path = table.path + "/" + table.columns[i].name;
        file.write(path, table.values[i]);
        file.set_text(path, "unit", table.columns[i].unit);
    }
}

void write_frame_links(Hdf5Writer& file, std::span<const Frame> frames, std::span<const std::string> kinds)
{
    std::vector<std::int64_t> cycle;
    std::vector<std::int32_t> number;
    std::vector<double> time;
    std::vector<std::string> stage;
    for (const std::string& kind : kinds)
        file.make_group("/frames/" + kind);
    for (const Frame& frame : frames)
    {
        number.push_back(frame.number);
        cycle.push_back(frame.cycle);
        time.push_back(frame.time);
        stage.push_back(frame.stage);
        const std::string digits = fmt::format("{:06d}", frame.number);
        for (const std::string& kind : kinds)
            file.link("/frames/" + kind + "/" + digits, frame_file(kind, frame.number), "/VTKHDF");
    }
    file.write("/frames/number", number);
    file.write("/frames/cycle", cycle);
    file.write("/frames/time", time);
    file.set_text("/frames/time", "unit", "s");
    file.write_texts("/frames/stage", stage);
}

/// Not known where an older hdem has written the file, and did not have this column.
std::vector<double> read_column(const Hdf5Reader& file, const std::string& path, std::uint64_t rows)
{
    return file.has(path) ? file.read<double>(path, {rows}) : std::vector<double>(rows, std::nan(""));
}
}  // namespace

ResultsWriter::ResultsWriter(std::filesystem::path file, Provenance provenance)
    : file_(std::move(file)),
      provenance_(std::move(provenance)),
      next_write_(Clock::now())
{
}

std::size_t ResultsWriter::add_table(std::string path, std::vector<Column> columns)
{
    const std::size_t n = columns.size();
    tables_.push_back({.path = std::move(path),
                       .columns = std::move(columns),
                       .cycle = {},
                       .time = {},
                       .values = std::vector<std::vector<double>>(n)});
    return tables_.size() - 1;
}

void ResultsWriter::add_row(std::size_t number, std::int64_t cycle, double time, std::span<const double> values)
{
    Table& table = tables_[number];
    HDEM_EXPECT(values.size() == table.columns.size());
    if (!table.cycle.empty() && table.cycle.back() >= cycle)
        return;
    table.cycle.push_back(cycle);
    table.time.push_back(time);
    for (std::size_t i = 0; i < values.size(); ++i)
        table.values[i].push_back(values[i]);
}

void ResultsWriter::take_over_rows(std::int64_t cycle)
{
    if (!std::filesystem::exists(file_))
        return;
    const Hdf5Reader file(file_);
    for (Table& table : tables_)
    {
        if (!file.has(table.path))
            continue;
        table.cycle = file.read<std::int64_t>(table.path + "/cycle", {any_extent});
        const std::uint64_t rows = table.cycle.size();
        const auto keep = std::upper_bound(table.cycle.begin(), table.cycle.end(), cycle) - table.cycle.begin();
        table.time = file.read<double>(table.path + "/time", {rows});
        for (std::size_t i = 0; i < table.columns.size(); ++i)
        {
            table.values[i] = read_column(file, table.path + "/" + table.columns[i].name, rows);
            table.values[i].resize(static_cast<std::size_t>(keep));
        }
        table.cycle.resize(static_cast<std::size_t>(keep));
        table.time.resize(static_cast<std::size_t>(keep));
    }
}

bool ResultsWriter::is_due() const
{
    return Clock::now() >= next_write_;
}

bool ResultsWriter::is_due_after_stage() const
{
    return Clock::now() >= next_write_after_stage_;
}

void ResultsWriter::write(std::span<const Frame> frames, std::span<const std::string> kinds)
{
    const auto begin = Clock::now();
    Hdf5Writer file(file_);
    file.set_text("/", "filetype", "hdem-results");
    file.set_attribute("/", "version", std::vector<std::int64_t>{1, 2});
    file.set_text("/", "hdem_version", version().number);
    file.set_text("/", "git_commit", version().commit);
    file.set_text("/", "date_and_time", timestamp());
    write_provenance(file, provenance_);
    write_frame_links(file, frames, kinds);
    file.make_group("/history");
    for (const Table& table : tables_)
        write_table(file, table);
    flush_folder(file_.parent_path());  // what it links to is on the disk before it
    file.commit();
    const auto end = Clock::now();
    next_write_after_stage_ = end + interval_in_writes * (end - begin);
    next_write_ = std::max(end + least_interval, next_write_after_stage_);
}
}  // namespace hdem
