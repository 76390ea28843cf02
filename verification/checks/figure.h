#pragma once
/// Curves and maps that a check shows beside its rows, for a page or a plot. What is drawn how is left to the reader of the file.

#include "core/types.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hdem::verification
{
/// Where the numbers of a curve come from.
enum class Origin
{
    ours,
    exact,  ///< closed form
    paper   ///< printed in [Lee2025]
};

/// A curve, or a single point.
struct Series
{
    std::string name;
    Origin origin = Origin::ours;
    std::vector<double> x;  ///< ascending, or the order in which a path runs
    std::vector<double> y;
    bool dots = false;  ///< the samples stand for something by themselves: show each of them
};

/// A vertical line.
struct Mark
{
    std::string name;
    Origin origin = Origin::ours;
    double x = 0.0;
};

struct Panel
{
    std::string title;
    std::string x_label;  ///< with the unit in brackets
    std::string y_label;
    bool log_x = false;
    bool log_y = false;
    std::vector<Series> series;
    std::vector<Mark> marks;
};

/// A number for every block of a map.
struct BlockField
{
    std::string title;  ///< with the unit in brackets
    bool has_both_signs = false;
    std::vector<double> values;
};

/// Blocks where they are, to be coloured by each of the fields.
struct BlockMap
{
    std::string title;
    std::vector<std::vector<Polygon>> parts;  ///< convex parts of each block [m]
    std::vector<std::uint8_t> detached;       ///< per block: shall not decide the range of the colours
    std::vector<BlockField> fields;
};

struct Figure
{
    std::string id;  ///< unique, "fig3"
    std::string title;
    std::string source;  ///< figure, table or equation that it stands beside
    std::string note;    ///< what the reader should know about how it was made
    int columns = 1;     ///< panels beside each other
    std::vector<Panel> panels;
    std::vector<BlockMap> maps;
};

/// A curve of samples taken at every step: value i at `first` + i, times `x_factor`.
[[nodiscard]] Series sampled(const std::string& name, const std::vector<double>& samples, std::size_t first, std::size_t last,
                             double x_factor = 1.0);
/// A level from x0 to x1.
[[nodiscard]] Series level(const std::string& name, Origin origin, double y, double x0, double x1);
[[nodiscard]] Series point(const std::string& name, Origin origin, double x, double y);

/// At most `most` points, and all if there are not more: the first, the last, and the lowest and the highest of each stretch between
/// them, so that no peak is lost. All stretches have equally many samples.
/// @pre most >= 4
void thin(Series& series, std::size_t most);
inline constexpr std::size_t most_points = 1000;  ///< of a curve in a report
}  // namespace hdem::verification
