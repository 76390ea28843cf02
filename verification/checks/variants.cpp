#include "verification/checks/variants.h"

#include "verification/checks/checks.h"

#include <fmt/format.h>

namespace hdem::verification
{
std::string Variant::name() const
{
    return fmt::format("{}, {}{}", method, damping, factor == 1.0 ? "" : fmt::format(", {:g} K", factor));
}

Overrides Variant::overrides() const
{
    return {set("time.step", step()), set("contact.method", method), set("damping.preset", damping),
            set("joint.default.normal_stiffness", factor * normal_stiffness),
            set("joint.default.shear_stiffness", factor * shear_stiffness)};
}

std::vector<Variant> all_variants(const std::string& damping)
{
    std::vector<Variant> all;
    for (const double factor : {1.0, 10.0})
        for (const char* method : all_methods)
            all.push_back({method, damping, factor});
    return all;
}

std::vector<Variant> all_variants()
{
    std::vector<Variant> all = all_variants("dynamic");
    for (const double factor : {1.0, 10.0})
        all.push_back({"hybrid", "default", factor});
    return all;
}
}  // namespace hdem::verification
