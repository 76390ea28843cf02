/// Recycled features: facing edges stored while a pair has hardly moved, against a full search in every cycle.

#include "core/motion/equilibrium.h"
#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification
{
namespace
{
const Override search_always = set("contact.recycling_distance", 0.0);

/// Greatest difference of two histories, as a share of the greatest value.
double difference(const std::vector<double>& a, const std::vector<double>& b)
{
    double off = 0.0;
    double greatest = 0.0;
    for (std::size_t c = 0; c < a.size() && c < b.size(); ++c)
    {
        off = std::max(off, std::abs(a[c] - b[c]));
        greatest = std::max(greatest, std::abs(b[c]));
    }
    return a.size() == b.size() ? off / greatest : 1.0;
}

/// Searches a contact and cycle, of the contacts there are at the end.
double searches_a_contact(const CaseRun& run)
{
    return static_cast<double>(run.state().feature_searches) / static_cast<double>(run.state().cycle) /
           static_cast<double>(run.state().contacts.size());
}

void check_one_block(Report& report)
{
    struct Watched
    {
        const char* case_file;
        std::vector<const char*> columns;
    };
    for (const Watched& watched : {Watched{"paper_static/static.toml", {"contact.normal_force", "contact.shear_force"}},
                                   Watched{"paper_dynamic/dynamic.toml", {"block.position_y", "block.velocity_y"}}})
        for (const char* method : all_methods)
        {
            const Overrides overrides{set("contact.method", std::string(method))};
            const CaseRun recycled(report, watched.case_file, overrides);
            const CaseRun searched(report, watched.case_file, overrides + Overrides{search_always});
            for (const char* column : watched.columns)
                report.require({fmt::format("{}, {}: {} against a full search in every cycle [of the greatest]", method,
                                            watched.case_file, column),
                                "Tables 2, 4", 0.0, difference(recycled.column(column), searched.column(column))},
                               absolute(1e-12));
            report.inform({fmt::format("{}, {}: searches a contact and cycle", method, watched.case_file), "1 without recycling",
                           searches_a_contact(searched), searches_a_contact(recycled)});
        }
}

void check_tunnel(Report& report)
{
    for (const char* method : {"force", "hybrid"})
    {
        const Overrides overrides{set("contact.method", std::string(method))};
        const CaseRun recycled(report, "paper_tunnel/tunnel.toml", overrides);
        const CaseRun searched(report, "paper_tunnel/tunnel.toml", overrides + Overrides{search_always});
        const DisplacementReport ours = report_displacements(recycled.model(), recycled.state());
        const DisplacementReport full = report_displacements(searched.model(), searched.state());
        const std::string name = std::string(method) + ": ";
        report.require(
            {name + "mean displacement next to the tunnel [mm]", "full search in every cycle", 1e3 * full.mean, 1e3 * ours.mean},
            relative(0.01));
        report.require({name + "cycles after the excavation", "full search in every cycle",
                        static_cast<double>(searched.stages().back().cycles), static_cast<double>(recycled.stages().back().cycles)},
                       relative(0.01));
        report.require({name + "detached blocks", "full search in every cycle", static_cast<double>(full.detached.size()),
                        static_cast<double>(ours.detached.size())},
                       absolute(0.0));
        report.inform({name + "searches a contact and cycle", "1 without recycling", searches_a_contact(searched),
                       searches_a_contact(recycled)});
    }
}
}  // namespace

std::vector<Check> recycling_checks()
{
    return {{"recycling.one_block", "stored features against a full search in every cycle, Tables 2 and 4", check_one_block},
            {"recycling.tunnel", "the same, Table 6 (about two minutes)", check_tunnel, Check::Length::is_long}};
}
}  // namespace hdem::verification
