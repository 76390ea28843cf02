#include "io/stage_end_text.h"

#include "io/case_problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>

namespace hdem
{
namespace
{
constexpr std::size_t longest_text = 1000;

struct Known
{
    const char* name;
    EndQuantity quantity;
    const char* tests;  ///< ">", "<" and "w" for within; "": none
    const char* who;    ///< what may stand behind the colon
    const char* example;
};

constexpr Known all_known[] = {
    {"displacement", EndQuantity::displacement, ">w", "blocks", "displacement:block1 > 0.1"},
    {"speed", EndQuantity::speed, "><w", "blocks", "speed < 1e-4 for 0.1 s"},
    {"unbalanced_force_ratio", EndQuantity::unbalanced_force_ratio, "<", "", "unbalanced_force_ratio < 1e-5"},
    {"history", EndQuantity::history, "><w", "column", "history:NAME.normal_force > 1e6"},
    {"time", EndQuantity::time, ">", "", "time > 2.5"},
    {"cycles", EndQuantity::cycles, ">", "", "cycles > 5000"},
    {"quiet", EndQuantity::quiet, "", "", "quiet for 0.5 s"},
};

const Known* find_known(const std::string& name)
{
    for (const Known& known : all_known)
        if (name == known.name)
            return &known;
    return nullptr;
}

std::string trimmed(const std::string& text)
{
    const auto from = text.find_first_not_of(" \t");
    return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(" \t") - from + 1);
}

/// Parts of an end as they stand in the text.
struct Parts
{
    std::string quantity, who, test, limit, duration, unit;
};

bool split(const std::string& text, Parts& parts)
{
    static const std::string number = R"(([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?))";
    static const std::regex form(R"(\s*([a-z_]+)\s*(?::([^<>]*?))?\s*(?:(>=?|<=?|\bwithin\b)\s*)" + number + R"()?\s*(?:\bfor\s+)" +
                                 number + R"(\s*(s|cycles)\s*)?)");
    std::smatch found;
    if (text.size() > longest_text || !std::regex_match(text, found, form))
        return false;
    parts = {.quantity = found[1],
             .who = trimmed(found[2]),
             .test = found[3],
             .limit = found[4],
             .duration = found[5],
             .unit = found[6]};
    return true;
}

std::vector<std::string> names_in(const std::string& list)
{
    std::vector<std::string> names;
    for (std::size_t from = 0; from <= list.size();)
    {
        const std::size_t comma = std::min(list.find(',', from), list.size());
        names.push_back(trimmed(list.substr(from, comma - from)));
        from = comma + 1;
    }
    return names;
}

/// Behind the colon. @return  what is wrong with it
std::string read_who(const Parts& parts, const Known& known, bool has_colon, StageEndDef& end)
{
    if (!has_colon && known.quantity != EndQuantity::history)
        return "";
    if (std::string(known.who).empty())
        return fmt::format("{} is that of the whole model", known.name);
    if (known.quantity == EndQuantity::history)
    {
        const auto dot = parts.who.rfind('.');
        if (dot == std::string::npos || dot == 0 || dot + 1 == parts.who.size())
            return "does not say which history, and which of its columns";
        end.history = parts.who.substr(0, dot);
        end.column = parts.who.substr(dot + 1);
        return "";
    }
    if (parts.who == "*")
        return "";
    end.blocks = names_in(parts.who);
    for (const std::string& name : end.blocks)
        if (name.empty())
            return "names no block behind the colon or a comma";
    return "";
}

/// > < within. @return  what is wrong with it
std::string read_test(const Parts& parts, const Known& known, StageEndDef& end)
{
    const std::string allowed = known.tests;
    if (allowed.empty())
    {
        end.test = EndTest::nothing;
        return parts.test.empty() ? "" : fmt::format("{} has no limit", known.name);
    }
    if (parts.test.empty())
        return "has no limit";
    const char sign = parts.test[0];
    end.test = sign == '>' ? EndTest::above : (sign == '<' ? EndTest::below : EndTest::within);
    if (allowed.find(sign) == std::string::npos)
    {
        if (known.quantity == EndQuantity::unbalanced_force_ratio)
            return "it is great when the stage begins, and falls as the rock settles";
        return sign == '<' && known.quantity == EndQuantity::displacement ? "it is 0 when the stage begins"
                                                                          : fmt::format("{} only grows", known.name);
    }
    end.limit = std::strtod(parts.limit.c_str(), nullptr);
    if (!std::isfinite(end.limit))
        return "its limit is no finite number";
    if ((known.quantity != EndQuantity::history || end.test == EndTest::within) && end.limit <= 0.0)
        return "its limit is not above 0";
    return "";
}

/// for T s, for N cycles. @return  what is wrong with it
std::string read_duration(const Parts& parts, const Known& known, StageEndDef& end)
{
    const bool needs_time = end.test == EndTest::within || end.test == EndTest::nothing;
    if (parts.duration.empty())
        return needs_time ? "does not say for how long" : "";
    if (end.is_by_clock())
        return fmt::format("{} passes its limit once", known.name);
    const double value = std::strtod(parts.duration.c_str(), nullptr);
    if (!(value > 0.0) || value > 1e12)
        return "it must hold for a time above 0 (and below 1e12)";
    if (parts.unit == "s")
        end.for_time = value;
    else if (value != std::floor(value))
        return "cycles are whole numbers";
    else
        end.for_cycles = static_cast<std::int64_t>(value);
    return "";
}
}  // namespace

ReadStageEnd read_stage_end(const std::string& text)
{
    ReadStageEnd read{.end = {.text = text}, .why = {}, .remedy = {}};
    std::string examples = "\"converged\"";
    for (const Known& known : all_known)
        examples += fmt::format(", \"{}\"", known.example);
    Parts parts;
    const bool fits = split(text, parts);
    const Known* const known = fits ? find_known(parts.quantity) : nullptr;
    if (fits && parts.quantity == "converged")
    {
        read.why = "converged takes no limit and no time: its criteria are those of [convergence]";
        read.remedy = "Write \"converged\", and give convergence.hold_time.";
        return read;
    }
    if (known == nullptr)
    {
        read.why = fits ? fmt::format("no end of a stage is called {}", parts.quantity) : "is no end of a stage";
        std::vector<std::string> names{"converged"};
        for (const Known& one : all_known)
            names.emplace_back(one.name);
        if (const std::string near = did_you_mean(fits ? parts.quantity : text, names); !near.empty())
            read.why += fmt::format("; did you mean '{}'?", near);
        read.remedy = "Write one like " + examples + ".";
        return read;
    }
    read.end.quantity = known->quantity;
    read.why = read_who(parts, *known, text.find(':') != std::string::npos, read.end);
    if (read.why.empty())
        read.why = read_test(parts, *known, read.end);
    if (read.why.empty())
        read.why = read_duration(parts, *known, read.end);
    if (!read.why.empty())
        read.remedy = fmt::format("Write it like \"{}\"{}.", known->example,
                                  read.end.test == EndTest::within ? ", or \"... within 1e-5 for 0.5 s\"" : "");
    return read;
}

std::string_view stage_end_page()
{
    return R"(## Ends of a stage

`until` takes one of these or a list of them. The first that is met ends the stage; the closing lines and `summary.json` name it, with the value it had.

```toml
[[stage]]
until = ["converged", "displacement:slab,b17 > 0.1", "speed > 2.0"]
max_cycles = 200000
```

| End | Met when |
|---|---|
| `converged` | the criteria of [convergence] hold |
| `displacement > D`, `displacement:A,B > D` | a block has moved by D [m] since the stage began: one of those that are named, else any free one |
| `speed > V`, `speed < V`, `speed:A > V` | the fastest of these blocks has reached V [m/s], or none is faster |
| `unbalanced_force_ratio < R` | the ratio of all free blocks, as on the screen, is no more than R |
| `history:NAME.COLUMN > X`, `< X` | this column of the [[history]] NAME has reached X, from below or from above. Any quantity that fits the history may be named; of a vector one component (`displacement_x`) |
| `quiet for T s` | no joint has opened, closed or broken for so long, and none slides faster than convergence.mean_speed |
| `... within W for T s` | all values of displacement, speed or a history in this time lie within a band of width W; a value outside begins a new band |
| `time > T`, `cycles > N` | the stage has lasted so long |

- `for T s` or `for N cycles` may follow each of them but the first and the last: it must then hold for so long at every check. Checks are at multiples of convergence.check_every cycles.
- Rock that settles meets `speed <`, `unbalanced_force_ratio <`, `within` and `quiet`. These wait, as `converged` does, until loads, sides, `set_cycles` and pressures behind liners
  no longer change, the forces of `relax_cycles` are gone, and convergence.least_cycles have passed. The others do not wait; what still changes is named at the end.
- A stage that waits for motion only (`displacement >`, `speed >`, `history`) also ends when [convergence] holds, no load changes and no motion is prescribed: nothing can happen any more.
  That counts as an end.
- Where max_cycles is reached first, the program ends with exit code 4. `cycles > N` in the list makes it a regular end.
- Only `converged` changes damping and time steps. Where times matter, use the others alone, and damping.preset = "dynamic".

)";
}
}  // namespace hdem
