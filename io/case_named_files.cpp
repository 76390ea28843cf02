#include "io/case_named_files.h"

#include "io/factor_table.h"
#include "io/geojson.h"
#include "io/polygons.h"
#include "io/pressure_table.h"
#include "io/profile.h"
#include "io/text_file.h"
#include "io/traces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace hdem
{
namespace
{
/// How a file of blocks or traces that is in a format of maps or drawings becomes one that hdem reads; "" for any other name.
std::string conversion_of(const std::string& key, const std::string& name)
{
    if (key != "blocks_file" && key != "domain.traces_file")
        return "";
    std::string ending = std::filesystem::path(name).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const std::string file = printable(name);
    const std::string stem = printable(name.substr(0, name.size() - ending.size()));
    if (ending == ".dxf")
        return fmt::format("Make a text file of it: tools/import_dxf.py {} --{} {}.wkt.", file,
                           key == "blocks_file" ? "blocks" : "traces", stem);
    if (ending == ".shp" || ending == ".gpkg" || ending == ".kml" || ending == ".gml" || ending == ".fgb")
        return fmt::format("Make GeoJSON of it: ogr2ogr -f GeoJSON {}.geojson {} (Debian package: gdal-bin).", stem, file);
    return "";
}

/// Tables that are saved as "CSV UTF-8" begin with a byte order mark.
TextFile without_mark(TextFile file)
{
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (file.text.starts_with(mark))
        file.text.erase(0, mark.size());
    return file;
}

class NamedFileReader
{
  public:
    NamedFileReader(CaseFile& read, const std::filesystem::path& case_file, const NamedFiles* stored, CaseProblems& problems,
                    std::vector<Problem>& located)
        : read_(read),
          folder_(case_file.parent_path()),
          stored_(stored),
          problems_(problems),
          located_(located)
    {
    }

    void add_blocks()
    {
        CaseDef& def = read_.def;
        const std::string* text = text_of("blocks_file", "case", def.blocks_file);
        if (text == nullptr)
            return;
        const std::string file = path_of(def.blocks_file);
        std::istringstream in(*text);
        auto [blocks, found] = is_geojson(file) ? read_geojson_blocks(*text, file, def.blocks.size())
                                                : read_polygons(in, file, def.blocks.size());
        take(found);
        const int number = read_.source.add_source(file);
        for (auto& [block, line] : blocks)
        {
            read_.source.add(fmt::format("block[{}]", def.blocks.size()), {.line = line, .source = number});
            def.blocks.push_back(std::move(block));
        }
    }

    std::vector<Polygon> traces()
    {
        const std::string& name = read_.def.domain.traces_file;
        const std::string* text = text_of("domain.traces_file", "[domain]", name);
        if (text == nullptr)
            return {};
        std::istringstream in(*text);
        auto [traces, found] = is_geojson(name) ? read_geojson_traces(*text, path_of(name)) : read_traces(in, path_of(name));
        take(found);
        return traces;
    }

    /// Polygon of a domain below a profile.
    void add_profile()
    {
        DomainDef& domain = read_.def.domain;
        if (!domain.polygon.empty())
            return;
        const std::string* text = text_of("domain.profile", "[domain]", domain.profile);
        if (text == nullptr)
            return;
        std::istringstream in(*text);
        const ProfileFile file = read_profile(in, path_of(domain.profile));
        take(file.problems);
        if (!file.problems.empty() || !domain.bottom)
            return;
        const double lowest = std::ranges::min(file.points, {}, [](const Vec2& p) { return p.y(); }).y();
        if (*domain.bottom < lowest)
            domain.polygon = domain_below(file.points, *domain.bottom);
        else
            problems_.add("domain.bottom", "[domain]", fmt::format("bottom = {} m", *domain.bottom),
                          fmt::format("is not below the profile, whose lowest point is at {} m", lowest), "Give a lower one.");
    }

    void add_pressures()
    {
        WaterDef& water = read_.def.water;
        const std::string* text = text_of("water.pressure", "[water]", water.pressure);
        if (text == nullptr)
            return;
        std::istringstream in(*text);
        auto [rows, found] = read_pressures(in, path_of(water.pressure));
        take(found);
        water.pressures = std::move(rows);
    }

    void add_tables()
    {
        CaseDef& def = read_.def;
        for (std::size_t i = 0; i < def.loads.size(); ++i)
            add_table(def.loads[i].factor, fmt::format("load[{}]", i), fmt::format("load \"{}\"", printable(def.loads[i].name)));
        for (std::size_t i = 0; i < def.boundaries.size(); ++i)
            add_table(def.boundaries[i].factor, fmt::format("boundary[{}]", i),
                      fmt::format("boundary \"{}\"", printable(def.boundaries[i].name)));
        for (std::size_t i = 0; i < def.stages.size(); ++i)
        {
            StageDef& stage = def.stages[i];
            add_rows(stage.set_table_file, fmt::format("stage[{}].set_table_file", i),
                     fmt::format("stage \"{}\"", printable(stage.name)), stage.set_table, stage.set_table_by);
        }
    }

  private:
    [[nodiscard]] std::string path_of(const std::string& name) const { return (folder_ / name).string(); }

    void take(const std::vector<Problem>& found) { located_.insert(located_.end(), found.begin(), found.end()); }

    /// From the disk, or from what is stored.
    [[nodiscard]] TextFile read(const std::string& name) const
    {
        if (stored_ == nullptr)
            return without_mark(read_text_file(folder_ / name, largest_named_file));
        const auto found = stored_->find(name);
        if (found == stored_->end())
            return {.text = {}, .obstacle = "is not stored with the case", .remedy = "The checkpoint is damaged."};
        return {.text = found->second, .obstacle = {}, .remedy = {}};
    }

    /// Text of the file that `key` names; it is kept with the case. Nothing where the key is not given; where there is no such file, complains.
    const std::string* text_of(const std::string& key, const std::string& object, const std::string& name)
    {
        if (name.empty())
            return nullptr;
        TextFile file;
        if (const std::string conversion = conversion_of(key, name); !conversion.empty())
            file = {.text = {}, .obstacle = "is of a format that hdem does not read", .remedy = conversion};
        else
        {
            file = read(name);
            file.remedy += " A relative name starts at the folder of the case file.";
        }
        if (file.obstacle.empty())
            return &(read_.files[name] = std::move(file.text));
        problems_.add(key, object, fmt::format("{} = \"{}\"", key.substr(key.find('.') + 1), printable(name)),
                      fmt::format("{} {}", printable(path_of(name), 200), file.obstacle), file.remedy);
        return nullptr;
    }

    /// Of a load or a side.
    void add_table(FactorDef& factor, const std::string& path, const std::string& object)
    {
        add_rows(factor.table_file, path + ".table_file", object, factor.table, factor.table_by);
    }

    /// Rows of the file that `key` names, where the case itself gives none.
    void add_rows(const std::string& name, const std::string& key, const std::string& object, FactorTable& rows, TableColumn& by)
    {
        if (!rows.empty())
            return;
        const std::string* text = text_of(key, object, name);
        if (text == nullptr)
            return;
        std::istringstream in(*text);
        FactorFile file = read_factors(in, path_of(name));
        take(file.problems);
        rows = std::move(file.rows);
        by = file.by;
    }

    CaseFile& read_;
    std::filesystem::path folder_;
    const NamedFiles* stored_;
    CaseProblems& problems_;
    std::vector<Problem>& located_;
};
}  // namespace

std::vector<Polygon> read_named_files(CaseFile& read, const std::filesystem::path& case_file, const NamedFiles* stored,
                                      CaseProblems& problems, std::vector<Problem>& located)
{
    NamedFileReader files(read, case_file, stored, problems, located);
    files.add_blocks();
    files.add_profile();
    files.add_pressures();
    files.add_tables();
    return files.traces();
}
}  // namespace hdem
