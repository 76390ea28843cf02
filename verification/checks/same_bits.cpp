#include "verification/checks/same_bits.h"

#include "verification/checks/turned_case.h"
#include "verification/runs/run_end.h"
#include "verification/runs/scratch_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numbers>

namespace hdem::verification
{
namespace
{
/// Checks may run at once.
runs::ScratchFolder scratch_folder()
{
    static std::atomic<int> count = 0;
    return runs::ScratchFolder(fmt::format("verify{}", ++count));
}

bool goes_on_the_same(const runs::Build& build, const runs::RunEnd& unbroken)
{
    if (unbroken.cycle < 2)
        return false;
    const runs::ScratchFolder folder = scratch_folder();
    runs::run_until(build, unbroken.cycle / 2, folder.path(), 2);
    return runs::restart(build, folder.path(), 2) == unbroken;
}
}  // namespace

std::int64_t require_same_bits(Report& report, const std::string& case_file, const Overrides& overrides,
                               std::span<const char* const> methods, const OtherRuns& others)
{
    constexpr std::array turns{0.0, 23.0};
    const std::string& name = others.name.empty() ? case_file : others.name;
    const std::string compared = fmt::format("1, {} threads, restarted", fmt::join(others.threads, ", "));
    std::int64_t contacts = std::numeric_limits<std::int64_t>::max();
    for (const char* method : methods)
        for (const double degrees : std::span(turns).first(others.turned ? 2 : 1))
        {
            const Overrides drawn = overrides + Overrides{set("contact.method", std::string(method))};
            const Overrides given = degrees == 0.0 ? drawn : turned_case(case_file, drawn, degrees * std::numbers::pi / 180.0);
            const runs::Build build([&] { return load_case(case_folder() / case_file, given).setup; });
            const runs::RunEnd one = runs::run_unbroken(build, 1);
            double differ = 0.0;
            for (const int threads : others.threads)
                differ += runs::run_unbroken(build, threads) == one ? 0.0 : 1.0;
            differ += goes_on_the_same(build, one) ? 0.0 : 1.0;
            const std::string turn = degrees == 0.0 ? "" : fmt::format(", turned by {:g}°", degrees);
            report.require({fmt::format("{}, {}{}: runs that differ", name, method, turn), compared, 0.0, differ}, absolute(0.0));
            contacts = std::min(contacts, one.contacts);
        }
    return contacts;
}
}  // namespace hdem::verification
