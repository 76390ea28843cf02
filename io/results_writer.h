#pragma once
/// results.h5: histories, energies, provenance, and links to the frames.

#include "core/history_sampler.h"
#include "io/frame_writer.h"
#include "io/provenance.h"

#include <chrono>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hdem
{
/// Rows of numbers with their cycles and times; a group of one-dimensional datasets in the file.
struct Table
{
    std::string path;  ///< of the group, "/energy", "/history/NAME"
    std::vector<Column> columns;
    std::vector<std::int64_t> cycle;
    std::vector<double> time;                 ///< [s]
    std::vector<std::vector<double>> values;  ///< per column
};

/// Tables are kept in memory, and the whole file is written anew each time: whoever opens it while the run goes on, or after
/// the run was killed, finds a complete file. Appending to an HDF5 file would lose it when killed at the wrong moment.
/// @see verification/unit/io/results_writer_test.cpp
class ResultsWriter
{
  public:
    ResultsWriter(std::filesystem::path file, Provenance provenance);

    /// @return its number for add_row
    std::size_t add_table(std::string path, std::vector<Column> columns);
    /// A cycle that is already there, as at the border of two stages, is left as it is.
    void add_row(std::size_t table, std::int64_t cycle, double time, std::span<const double> values);
    /// Rows up to `cycle` that the file on disk has in tables of the same columns: to go on after a restart.
    void take_over_rows(std::int64_t cycle);

    /// Is it time to write? At most every ten seconds, and more seldom when writing is slow, so that it takes a small part of the run's time.
    [[nodiscard]] bool is_due() const;
    /// At the end of a stage too, unless stages are so short that writing would take more than a twentieth of the time.
    [[nodiscard]] bool is_due_after_stage() const;
    void write(std::span<const Frame> frames, std::span<const std::string> kinds);

    [[nodiscard]] Provenance& provenance() { return provenance_; }
    [[nodiscard]] const std::vector<Table>& tables() const { return tables_; }

  private:
    std::filesystem::path file_;
    Provenance provenance_;
    std::vector<Table> tables_;
    std::chrono::steady_clock::time_point next_write_;
    std::chrono::steady_clock::time_point next_write_after_stage_;
};
}  // namespace hdem
