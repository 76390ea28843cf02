#include "verification/checks/figure_json.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>

namespace hdem::verification
{
namespace
{
using nlohmann::json;

const char* word(Origin origin)
{
    return origin == Origin::ours ? "ours" : (origin == Origin::exact ? "exact" : "paper");
}

/// Seven digits are more than a picture shows, and a third of the file.
json number(double value)
{
    if (!std::isfinite(value))
        return {};
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", value);
    return std::strtod(text, nullptr);
}

json numbers(const std::vector<double>& values)
{
    json list = json::array();
    for (const double value : values)
        list.push_back(number(value));
    return list;
}

json polygon(const Polygon& vertices)
{
    json list = json::array();
    for (const Vec2& v : vertices)
        list.push_back({std::round(1e3 * v.x()) / 1e3, std::round(1e3 * v.y()) / 1e3});
    return list;
}

json panel_json(const Panel& panel)
{
    json series = json::array();
    for (const Series& s : panel.series)
        series.push_back(
            {{"name", s.name}, {"origin", word(s.origin)}, {"x", numbers(s.x)}, {"y", numbers(s.y)}, {"dots", s.dots}});
    json marks = json::array();
    for (const Mark& mark : panel.marks)
        marks.push_back({{"name", mark.name}, {"origin", word(mark.origin)}, {"x", number(mark.x)}});
    return {{"title", panel.title}, {"x_label", panel.x_label}, {"y_label", panel.y_label},
            {"log_x", panel.log_x}, {"log_y", panel.log_y},     {"series", series},
            {"marks", marks}};
}

json map_json(const BlockMap& map)
{
    json parts = json::array();
    for (const std::vector<Polygon>& block : map.parts)
    {
        json polygons = json::array();
        for (const Polygon& part : block)
            polygons.push_back(polygon(part));
        parts.push_back(polygons);
    }
    json fields = json::array();
    for (const BlockField& field : map.fields)
        fields.push_back({{"title", field.title}, {"has_both_signs", field.has_both_signs}, {"values", numbers(field.values)}});
    return {{"title", map.title}, {"parts", parts}, {"detached", map.detached}, {"fields", fields}};
}
}  // namespace

json as_json(const Figure& figure)
{
    json panels = json::array();
    for (const Panel& panel : figure.panels)
        panels.push_back(panel_json(panel));
    json maps = json::array();
    for (const BlockMap& map : figure.maps)
        maps.push_back(map_json(map));
    return {{"id", figure.id},     {"title", figure.title},     {"source", figure.source},
            {"note", figure.note}, {"columns", figure.columns}, {"panels", panels},
            {"maps", maps}};
}
}  // namespace hdem::verification
