#pragma once
/// Figures as JSON.

#include "verification/checks/figure.h"

#include <nlohmann/json_fwd.hpp>

namespace hdem::verification
{
/// {id, title, source, note, columns, panels: [{title, x_label, y_label, log_x, log_y, series, marks}],
///  maps: [{title, parts, detached, fields}]}, with the names and shapes of the structs. A number that is not finite becomes null.
/// Curves keep seven digits, the maps' coordinates millimetres.
[[nodiscard]] nlohmann::json as_json(const Figure& figure);
}  // namespace hdem::verification
