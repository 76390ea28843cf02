#pragma once
/// Where a result comes from: program, machine, case, command.

#include "io/hdf5_writer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hdem
{
struct Provenance
{
    std::string case_file;               ///< as given on the command line
    std::string case_text;               ///< whole, as read
    std::vector<std::string> overrides;  ///< key.path=value given besides
    std::vector<std::string> command_line;
    std::uint64_t seed = 0;
    int threads = 1;
    // Filled by describe_machine():
    std::string cpu;
    std::string hostname;
    std::vector<std::string> environment;  ///< OMP_... variables, NAME=value
    std::string begin;                     ///< of the run, UTC, "2024-05-06T07:08:09Z"
    std::string end;                       ///< "" while it goes on
    std::vector<std::string> restarts;     ///< "UTC cycle", one for each
};

/// Processor, host, OpenMP variables and the present time.
void describe_machine(Provenance& provenance);

/// Now, UTC, to the second; SOURCE_DATE_EPOCH instead when that is set, so that two runs can give the same bytes.
std::string timestamp();

/// Group /provenance.
void write_provenance(Hdf5Writer& file, const Provenance& provenance);
}  // namespace hdem
