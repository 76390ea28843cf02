#include "tools/hdem/restart_point.h"

#include "io/toml_tree.h"

#include <fmt/format.h>

#include <limits>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

constexpr std::int64_t unreadable = std::numeric_limits<std::int64_t>::max();

[[noreturn]] void refuse(const fs::path& given, const char* why, const char* remedy)
{
    throw InputError(
        Problem{.key = {}, .text = fmt::format("--restart {}: ({}). {}.", printable(given.string(), 300), why, remedy)});
}

/// In which it was written; `unreadable` when it cannot be read.
std::int64_t cycle_of(const fs::path& checkpoint)
try
{
    return CheckpointReader(checkpoint).cycle();
}
catch (const InputError&)
{
    return unreadable;
}

RestartPoint point_of_file(const fs::path& given)
{
    RestartPoint point{given, CheckpointReader(given)};
    const fs::path folder = folder_of(given);
    for (const fs::path& own : {checkpoint_file(folder), previous_checkpoint_file(folder)})
        if (fs::exists(own) && !fs::equivalent(own, given) && cycle_of(own) > point.reader.cycle())
            point.aside.emplace_back(own, own.string() + ".younger");
    return point;
}
}  // namespace

bool can_be_read(const fs::path& checkpoint)
{
    return fs::exists(checkpoint) && cycle_of(checkpoint) != unreadable;
}

fs::path folder_of(const fs::path& given)
{
    if (fs::is_directory(given))
        return given;
    return given.has_parent_path() ? given.parent_path() : fs::path(".");
}

RestartPoint find_checkpoint(const fs::path& given, std::vector<std::string>& notes)
{
    if (!fs::is_directory(given))
        return point_of_file(given);
    const fs::path last = checkpoint_file(given);
    const fs::path previous = previous_checkpoint_file(given);
    if (!fs::exists(last) && !fs::exists(previous))
        refuse(given, "holds no checkpoint", "Give a checkpoint, or the folder of a run that has one");
    std::string damage;
    try
    {
        if (fs::exists(last))
            return {last, CheckpointReader(last)};
    }
    catch (const InputError& error)
    {
        if (!fs::exists(previous))
            throw;
        if (!can_be_read(previous))
            refuse(given, "neither checkpoint.h5 nor checkpoint.previous.h5 can be read", "Begin the run anew with --overwrite");
        damage = error.what();
    }
    RestartPoint point{previous, CheckpointReader(previous)};
    if (!damage.empty())
    {
        notes.push_back("warning: " + damage);
        point.aside.emplace_back(last, last.string() + ".damaged");
    }
    notes.push_back(fmt::format("warning: {} cannot be used: going on from {}", last.string(), previous.string()));
    return point;
}

void put_aside(const RestartPoint& point, std::vector<std::string>& notes)
{
    for (const auto& [file, name] : point.aside)
    {
        fs::rename(file, name);
        notes.push_back(fmt::format("note: {} is now called {}", file.string(), name.string()));
    }
}
}  // namespace hdem
