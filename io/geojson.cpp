#include "io/geojson.h"

#include "io/csv_row.h"
#include "io/scanner.h"
#include "io/toml_tree.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
using Json = nlohmann::ordered_json;

constexpr std::size_t most_features = 1'000'000;
constexpr std::size_t most_points = 10'000'000;
constexpr std::size_t most_problems = 50;

/// Walks features and gives lists of points to `use`; all problems are collected.
class Walker
{
  public:
    Walker(std::string key, std::string file, std::string what)
        : key_(std::move(key)),
          file_(std::move(file)),
          what_(std::move(what))
    {
    }

    std::vector<Problem> problems;

    /// Nothing where the text is no JSON.
    Json parse(const std::string& text)
    {
        try
        {
            return Json::parse(text);
        }
        catch (const Json::out_of_range&)
        {
            problems.push_back({Problem::Severity::error, key_,
                                fmt::format("{}: {}: (has a number that is too large). Export it once more.", file_, what_)});
            return {};
        }
        catch (const Json::parse_error& error)
        {
            const auto line = 1 + std::count(text.begin(),
                                             text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size())), '\n');
            problems.push_back({Problem::Severity::error, key_,
                                fmt::format("{}:{}: {}: (not valid JSON). Export it once more as GeoJSON.", file_, line, what_)});
            return {};
        }
    }

    /// Calls use(geometry, properties, number) for each feature.
    template <class Use>
    void for_each_feature(const Json& document, const Use& use)
    {
        const std::string type = text_of(document, "type");
        if (type == "FeatureCollection" && document.contains("features") && document["features"].is_array())
        {
            for (const Json& feature : document["features"])
                visit(feature, use);
        }
        else if (!document.is_null())
            visit(document, use);
        if (count_ == 0 && problems.empty())
            problems.push_back(
                {Problem::Severity::error, key_, fmt::format("{}: {}: (has no feature). Export lines or polygons.", file_, what_)});
    }

    void complain(const std::string& why, const std::string& remedy)
    {
        if (problems.size() < most_problems)
            problems.push_back(
                {Problem::Severity::error, key_, fmt::format("{}: {}: feature {} ({}). {}", file_, what_, count_, why, remedy)});
    }

    /// Points of a ring or a line; nothing when they are wrong, which is said.
    Polygon points(const Json& list)
    {
        Polygon out;
        if (!list.is_array())
        {
            complain("coordinates are not a list", "Export it once more.");
            return {};
        }
        for (const Json& point : list)
        {
            const bool is_point = point.is_array() && point.size() >= 2 && point[0].is_number() && point[1].is_number();
            const Vec2 at = is_point ? Vec2(point[0].get<double>(), point[1].get<double>()) : Vec2(0.0, 0.0);
            if (!is_point || !at.allFinite())
            {
                complain("point " + std::to_string(out.size() + 1) + " is not [x, y]", "Export it once more.");
                return {};
            }
            if (at.cwiseAbs().maxCoeff() > farthest_coordinate)
            {
                complain(fmt::format("point {} is farther than {} m from the origin", out.size() + 1, farthest_coordinate),
                         "Move the model nearer to the origin.");
                return {};
            }
            out.push_back(at);
        }
        points_ += out.size();
        if (points_ > most_points)
            complain(fmt::format("more than {} points", most_points), "Make the model smaller.");
        return out;
    }

    static std::string text_of(const Json& object, const char* name)
    {
        return object.is_object() && object.contains(name) && object[name].is_string() ? object[name].get<std::string>() : "";
    }

    [[nodiscard]] int count() const { return static_cast<int>(count_); }
    [[nodiscard]] bool is_over() const
    {
        return problems.size() >= most_problems || count_ > most_features || points_ > most_points;
    }

  private:
    template <class Use>
    void visit(const Json& feature, const Use& use)
    {
        if (is_over())
            return;
        ++count_;
        const bool is_feature = text_of(feature, "type") == "Feature";
        const Json& geometry = is_feature && feature.contains("geometry") ? feature["geometry"] : feature;
        static const Json none = Json::object();
        const Json& properties = is_feature && feature.contains("properties") && feature["properties"].is_object()
                                     ? feature["properties"]
                                     : none;
        if (text_of(geometry, "type") == "GeometryCollection")
            complain("is a GeometryCollection", "Take it apart: ogr2ogr -explodecollections -f GeoJSON OUT.geojson MAP.");
        else if (!geometry.is_object() || !geometry.contains("coordinates"))
            complain("has no coordinates", "Remove it, or export it once more.");
        else
            use(geometry, properties);
    }

    std::string key_, file_, what_;
    std::size_t count_ = 0;
    std::size_t points_ = 0;
};

/// A property by its name, which shapefiles have in capitals. Null where there is none.
const Json& property_of(const Json& properties, std::string_view name)
{
    static const Json none;
    const auto& members = properties.get_ref<const Json::object_t&>();
    const auto found = std::ranges::find_if(members, [&](const auto& member) { return is_same_word(member.first, name); });
    return found == members.end() ? none : found->second;
}

/// A name, or a code in its place: a whole number. Nothing where it is neither, which is said.
std::string name_in(Walker& walk, const Json& properties, const char* key)
{
    const Json& value = property_of(properties, key);
    const double number = value.is_number() ? value.get<double>() : 0.5;
    if (value.is_string())
        return value.get<std::string>();
    if (std::abs(number) < 1e15 && number == std::floor(number))
        return fmt::format("{:.0f}", number);
    if (!value.is_null())
        walk.complain(fmt::format("{} is neither a text nor a whole number", key), "Write the name.");
    return "";
}

/// fixed = true, or text as in files of WKT: "fixed", "x rotation". Shapefiles know no truth values: they come back as "true" or 1.
bool read_fixed_property(const Json& value, BlockDef& block)
{
    if (value.is_null() || value == Json(false) || value == Json("false") || value == Json(0))
        return true;
    if (value == Json(true) || value == Json("true") || value == Json(1))
        return block.fix_x = block.fix_y = block.fix_rotation = true;
    return value.is_string() && read_fixed(value.get<std::string>(), block);
}

/// A list that has something in it.
bool is_list(const Json& value)
{
    return value.is_array() && !value.empty();
}

/// A closed ring without its last point; empty when something is wrong, which is said.
Polygon ring_of(Walker& walk, const Json& polygon)
{
    if (!is_list(polygon))
    {
        walk.complain("has no ring", "Export it once more.");
        return {};
    }
    if (polygon.size() > 1)
    {
        walk.complain("has a hole", "Blocks have no holes: cut the ring into two polygons.");
        return {};
    }
    const std::size_t said = walk.problems.size();
    Polygon ring = walk.points(polygon[0]);
    if (walk.problems.size() > said)
        return {};
    if (ring.size() < 4 || ring.front() != ring.back())
    {
        walk.complain("its ring is not closed", "Repeat the first point at the end.");
        return {};
    }
    ring.pop_back();
    return ring;
}
}  // namespace

bool is_geojson(const std::string& file_name)
{
    return has_ending(file_name, ".geojson") || has_ending(file_name, ".json");
}

TraceFile read_geojson_traces(const std::string& text, const std::string& file_name)
{
    TraceFile result;
    Walker walk("domain.traces_file", file_name, "traces");
    const auto keep = [&](const Json& coordinates)
    {
        const Polygon line = walk.points(coordinates);
        const auto twice = std::adjacent_find(line.begin(), line.end());
        if (line.size() < 2 && walk.problems.empty())
            walk.complain(fmt::format("has {} point{}, a trace has at least 2", line.size(), line.size() == 1 ? "" : "s"),
                          "Give its two ends.");
        else if (twice != line.end())
            walk.complain(fmt::format("points {} and {} are the same", twice - line.begin() + 1, twice - line.begin() + 2),
                          "Remove one of them.");
        else if (line.size() > 1)
            result.traces.push_back(line);
    };
    walk.for_each_feature(walk.parse(text),
                          [&](const Json& geometry, const Json&)
                          {
                              const std::string type = Walker::text_of(geometry, "type");
                              if (type == "LineString")
                                  keep(geometry["coordinates"]);
                              else if (type == "MultiLineString" && is_list(geometry["coordinates"]))
                                  for (const Json& line : geometry["coordinates"])
                                      keep(line);
                              else
                                  walk.complain("is a " + printable(type) + ", not a LineString or MultiLineString with points",
                                                "Export lines only.");
                          });
    result.problems = std::move(walk.problems);
    return result;
}

PolygonFile read_geojson_blocks(const std::string& text, const std::string& file_name, std::size_t first_number)
{
    PolygonFile result;
    Walker walk("blocks_file", file_name, "blocks");
    const auto keep = [&](const Json& polygon, const Json& properties, std::size_t part)
    {
        BlockDef block;
        block.polygon = ring_of(walk, polygon);
        block.name = name_in(walk, properties, "name");
        if (block.name.empty())
            block.name = "block" + std::to_string(first_number + result.blocks.size() + 1);
        else if (part > 0)
            block.name += "." + std::to_string(part + 1);
        if (const std::string material = name_in(walk, properties, "material"); !material.empty())
            block.material = material;
        if (!read_fixed_property(property_of(properties, "fixed"), block))
            walk.complain("fixed does not say what is fixed",
                          "Write true, \"fixed\", or some of x, y, rotation as \"x rotation\".");
        if (!block.polygon.empty())
            result.blocks.push_back({std::move(block), 0});
    };
    walk.for_each_feature(walk.parse(text),
                          [&](const Json& geometry, const Json& properties)
                          {
                              const std::string type = Walker::text_of(geometry, "type");
                              const Json& coordinates = geometry["coordinates"];
                              if (type == "Polygon")
                                  keep(coordinates, properties, 0);
                              else if (type == "MultiPolygon" && is_list(coordinates))
                                  for (std::size_t i = 0; i < coordinates.size(); ++i)
                                      keep(coordinates[i], properties, i);
                              else
                                  walk.complain("is a " + printable(type) + ", not a Polygon or MultiPolygon with rings",
                                                "Export polygons only.");
                          });
    result.problems = std::move(walk.problems);
    return result;
}
}  // namespace hdem
