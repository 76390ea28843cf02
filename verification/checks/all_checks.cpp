#include "verification/checks/checks.h"
#include "verification/rest/rest.h"

namespace hdem::verification
{
std::vector<Check> all_checks()
{
    std::vector<Check> all;
    for (const auto group :
         {static_block_checks, bounce_checks,    transition_checks,   tunnel_checks, sliding_checks,     column_checks,
          wall_checks,         stability_checks, cyclic_shear_checks, ledger_checks, order_checks,       recycling_checks,
          insitu_checks,       joint_checks,     stage_end_checks,    water_checks,  support_checks,     liner_checks,
          rock_mass_checks,    fos_checks,       large_model_checks,  robust_checks, static_rock_checks, rest_checks})
        for (Check& check : group())
            all.push_back(std::move(check));
    return all;
}
}  // namespace hdem::verification
