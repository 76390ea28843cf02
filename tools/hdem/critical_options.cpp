#include "tools/hdem/critical_options.h"

#include "io/printable.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace hdem
{
namespace
{
/// Not finite where the text is no number.
double number_of(const std::string& text)
{
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    char* end = nullptr;
    const double x = std::strtod(text.c_str(), &end);
    return text.empty() || *end != '\0' ? none : x;
}
}  // namespace

void refuse(const std::string& text)
{
    throw InputError(Problem{.key = {}, .text = text});
}

Vary parse_vary(const std::string& text)
{
    const auto equals = text.find('='), colon = text.rfind(':');
    const bool is_whole = equals != std::string::npos && colon != std::string::npos && colon > equals && equals > 0;
    const double low = is_whole ? number_of(text.substr(equals + 1, colon - equals - 1)) : number_of("");
    const double high = is_whole ? number_of(text.substr(colon + 1)) : number_of("");
    if (!std::isfinite(low) || !std::isfinite(high))
        refuse(fmt::format("--vary {}: (not of the form KEY=LOW:HIGH). Write e.g. --vary gravity.tilt_deg=0:60.", printable(text)));
    if (low >= high)
        refuse(fmt::format("--vary {}: (its end is not above its beginning). Give the lower number first.", printable(text)));
    return {text.substr(0, equals), low, high};
}

FailureCondition parse_condition(const std::string& text)
{
    const auto colon = text.find(':'), greater = text.rfind('>');
    FailureCondition condition;
    const std::string quantity = text.substr(0, colon);
    const double limit = number_of(greater == std::string::npos ? "" : text.substr(greater + 1));
    if (text.substr(0, greater) == "detached" && std::isfinite(limit) && limit >= 0.0)
        return {.quantity = FailureCondition::Quantity::detached, .blocks = {}, .limit = limit};
    const bool is_known = quantity == "displacement" || quantity == "rotation";
    if (colon == std::string::npos || greater == std::string::npos || greater < colon + 2 || !is_known || !std::isfinite(limit) ||
        limit < 0.0)
        refuse(fmt::format("--fails {}: (not of the form displacement:BLOCK>METRES, rotation:BLOCK>DEGREES or detached>NUMBER). "
                           "Write e.g. --fails "
                           "'displacement:wedge>0.1', or * for any block.",
                           printable(text)));
    if (quantity == "rotation")
        condition.quantity = FailureCondition::Quantity::rotation;
    const std::string name = text.substr(colon + 1, greater - colon - 1);
    if (name != "*")
        condition.blocks = {name};
    condition.limit = limit;
    return condition;
}
}  // namespace hdem
