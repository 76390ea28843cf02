/// Statistics of generated rock: spacings, Voronoi cells, traces, sections.

#include "core/rock/rock_mass.h"

#include "core/geometry/polygon.h"
#include "core/rock/finite_traces.h"
#include "core/rock/line_stretches.h"
#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr double pi = std::numbers::pi;

CaseDef definition(const std::string& file, const Overrides& overrides)
{
    return load_case(case_folder() / file, overrides).file.def;
}

Polygon rectangle(double width, double height, double turn_deg)
{
    Polygon points = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    const double c = std::cos(radians(turn_deg)), s = std::sin(radians(turn_deg));
    for (Vec2& p : points)
        p = {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
    return points;
}

/// Share of a line in pieces of 10 cm and more, in per cent.
void check_rqd(Report& report)
{
    constexpr double length = 1000.0, piece = 0.1;
    for (const double turn : {0.0, 23.0})
        for (const double rate : {5.0, 10.0, 20.0})
            for (const int seed : {1, 2, 3})
            {
                const CaseDef def = definition("rockmass/strips.toml",
                                               {set("domain.polygon", rectangle(length, 1.0, turn)),
                                                set("joint_set[0].dip_deg", 90.0 + turn),
                                                set("joint_set[0].spacing.mean", 1.0 / rate), set("generator.seed", seed)});
                double sound = 0.0;
                for (const RockBlock& block : generate_rock_mass(def).blocks)
                    sound += area(block) >= piece ? area(block) : 0.0;
                const double x = rate * piece, share = std::exp(-x) * (1.0 + x);
                // Renewal and reward: of each piece its length where it is sound, less the share of its length.
                const double second = 2.0 / (rate * rate),
                             sound_second = std::exp(-x) * (second + 2.0 * piece / rate + piece * piece);
                const double variance = sound_second * (1.0 - 2.0 * share) + share * share * second;
                report.require({fmt::format("turned {:g}°, {:g} joints/m, seed {}: RQD [%]", turn, rate, seed),
                                "100 e^(-0.1 λ) (1 + 0.1 λ)", 100.0 * share, 100.0 * sound / length},
                               absolute(3.0 * 100.0 * std::sqrt(variance * rate / length)));
            }
}

/// Cells whose middle is 5 m or more inside.
void check_cells(Report& report)
{
    for (const double turn : {0.0, 23.0})
        for (const int seed : {1, 2})
        {
            const Polygon square = rectangle(210.0, 210.0, turn);
            const CaseDef def = definition("rockmass/cells.toml", {set("domain.polygon", square), set("generator.seed", seed)});
            double count = 0.0, edges = 0.0, around = 0.0, sum = 0.0, squares = 0.0;
            for (const RockBlock& block : generate_rock_mass(def).blocks)
            {
                const Vec2 middle = moments(block).centroid;
                if (distance_to_boundary(square, middle) < 5.0)
                    continue;
                const Polygon& ring = block.parts.front().vertices;
                for (std::size_t i = 0; i < ring.size(); ++i)
                    around += (ring[next(i, ring.size())] - ring[i]).norm();
                count += 1.0;
                edges += static_cast<double>(ring.size());
                sum += area(block);
                squares += area(block) * area(block);
            }
            const double mean = sum / count;
            const std::string name = fmt::format("turned {:g}°, seed {}: ", turn, seed);
            report.require({name + "cells", "4e4 m² of one cell a m²", 4e4, count}, relative(0.02));
            report.require({name + "edges of a cell", "6", 6.0, edges / count}, relative(0.02));
            report.require({name + "perimeter [m]", "4 / √λ", 4.0, around / count}, relative(0.02));
            report.require({name + "edge [m]", "2 / (3 √λ)", 2.0 / 3.0, around / edges}, relative(0.02));
            report.require({name + "variance of areas, of their mean squared", "simulations: 0.2802", 0.2802,
                            (squares / count - mean * mean) / (mean * mean)},
                           relative(0.02));
        }
    const CaseDef even = definition("rockmass/cells.toml", {set("domain.polygon", rectangle(100.0, 60.0, 10.0)),
                                                            set("voronoi.iterations", 5.0), set("voronoi.edge", 1.5)});
    report.require({"5 iterations: mean edge [m]", "as the case says", 1.5, generate_rock_mass(even).sets.back().trace.mean()},
                   relative(0.03));
}

/// Dip and spacing of planes in a section, from the traces' own equations.
void check_section(Report& report)
{
    const std::vector<std::array<double, 4>> planes = {
        {60.0, 130.0, 90.0, 1.5}, {35.0, 45.0, 90.0, 2.0}, {72.0, 310.0, 17.0, 0.8}, {20.0, 200.0, -40.0, 3.0}};
    for (const auto& [dip, direction, section, spacing] : planes)
    {
        const Overrides overrides{
            {"joint_set[0].orientation", fmt::format("{{dip = {}, dip_direction = {}, section = {}}}", dip, direction, section)},
            set("joint_set[0].spacing", spacing),
            {"joint_set[1].spacing", "1000.0"}};
        const RockMass rock = generate_rock_mass(definition("rockmass/section.toml", overrides));
        const double d = radians(dip), along = radians(direction - section);
        const double nx = std::sin(d) * std::cos(along), ny = std::cos(d);
        const std::string name = fmt::format("{:g}/{:g} in {:g}: ", dip, direction, section);
        report.require({name + "dip in the section [deg]", "tan α = tan δ cos(α_d - ζ)", std::atan2(-nx, ny) * 180.0 / pi,
                        rock.sets[0].dip.mean()},
                       relative(1e-9));
        report.require(
            {name + "spacing in the section [m]", "s / √(n_x² + n_y²)", spacing / std::hypot(nx, ny), rock.sets[0].spacing.mean()},
            relative(1e-9));
        double worst = 0.0;  // and the edges of the blocks do lie so
        for (const RockBlock& block : rock.blocks)
            for (const ConvexPart& part : block.parts)
                for (std::size_t i = 0; i < part.vertices.size(); ++i)
                    if (const Vec2 way = part.vertices[next(i, part.vertices.size())] - part.vertices[i];
                        part.source[i] == 0 && way.norm() > 0.5)
                        worst = std::max(worst, std::abs(way.x() * nx + way.y() * ny) / way.norm() / std::hypot(nx, ny));
        report.require({name + "edges out of the plane", "0", 1e-9, worst}, at_most());
    }
    const RockMass rock = generate_rock_mass(definition("rockmass/section.toml", {}));
    report.require({"60/130 in 090: dip [deg]", "to four digits", -52.9955, rock.sets[0].dip.mean()}, absolute(5e-5));
    report.require({"60/130 in 090: spacing 1.5 m [m]", "to six digits", 1.805633, rock.sets[0].spacing.mean()}, absolute(5e-7));
    report.require({"35/045 in 090: dip [deg]", "to four digits", -26.3410, rock.sets[1].dip.mean()}, absolute(5e-5));
    report.require({"35/045 in 090: spacing 2 m [m]", "to six digits", 2.188041, rock.sets[1].spacing.mean()}, absolute(5e-7));
}

std::vector<SourceLine> lines_of(const Overrides& overrides)
{
    std::vector<DrawnSet> drawn;
    return draw_lines(definition("rockmass/traces.toml", overrides), drawn);
}

void check_directions(Report& report)
{
    for (const auto& [kappa, sd, mean] :
         {std::tuple(50.0, 8.14402, 0.0), std::tuple(50.0, 8.14402, 60.0), std::tuple(8.0, 0.0, -70.0)})
    {
        const double ratio = std::cyl_bessel_i(1.0, kappa) / std::cyl_bessel_i(0.0, kappa);
        const double reference = std::sqrt(-2.0 * std::log(ratio)) * 180.0 / pi;
        if (sd > 0.0)
            report.require({fmt::format("von Mises {:g}: the reference [deg]", kappa), "closed form", sd, reference},
                           absolute(5e-6));
        for (const int seed : {1, 2, 3})
        {
            double c = 0.0, s = 0.0, n = 0.0;
            for (const SourceLine& line : lines_of(
                     {{"joint_set[0].dip_deg", fmt::format("{{mean = {}, distribution = \"von_mises\", kappa = {}}}", mean, kappa)},
                      set("generator.seed", seed)}))
            {
                const Vec2 way = (line.points[1] - line.points[0]).normalized();
                c += way.x();
                s += way.y();
                n += 1.0;
            }
            const double length = std::hypot(c, s) / n;
            // R-bar has the variance (1 - A / kappa - A^2) / n, and sd = sqrt(-2 ln R-bar).
            const double error = std::sqrt((1.0 - ratio / kappa - ratio * ratio) / n) / (ratio * radians(reference)) * 180.0 / pi;
            report.require({fmt::format("von Mises {:g} about {:g}°, seed {}: circular sd [deg]", kappa, mean, seed),
                            "√(-2 ln I₁/I₀)", reference, std::sqrt(-2.0 * std::log(length)) * 180.0 / pi},
                           absolute(3.0 * error));
            report.require({fmt::format("von Mises {:g} about {:g}°, seed {}: direction [deg]", kappa, mean, seed),
                            "as the case says", mean, std::atan2(s, c) * 180.0 / pi},
                           absolute(3.0 * 180.0 / pi / std::sqrt(n * kappa * ratio)));
        }
    }
}

void check_lengths(Report& report)
{
    for (const int seed : {1, 2, 3})
    {
        double n = 0.0, sum = 0.0, squares = 0.0;
        for (const SourceLine& line : lines_of(
                 {{"joint_set[0].trace", "{mean = 4.0, distribution = \"lognormal\", sd = 2.0}"}, set("generator.seed", seed)}))
        {
            const double x = std::log((line.points[1] - line.points[0]).norm());
            n += 1.0;
            sum += x;
            squares += x * x;
        }
        const double mu = sum / n, sigma = std::sqrt(squares / n - mu * mu);
        report.require({fmt::format("lognormal 4 m, sd 2 m, seed {}: mean of ln l", seed), "ln m - σ²/2", 1.274723, mu},
                       absolute(3.0 * 0.472381 / std::sqrt(n)));
        report.require({fmt::format("lognormal 4 m, sd 2 m, seed {}: sd of ln l", seed), "√ln(1 + (s/m)²)", 0.472381, sigma},
                       absolute(3.0 * 0.472381 / std::sqrt(2.0 * n)));
    }
}

/// Crossings with scan lines in two directions, and of traces with each other.
void check_crossings(Report& report)
{
    constexpr double size = 100.0, trace = 4.0;
    for (const double turn : {0.0, 23.0})
        for (const double p21 : {1.2, 0.6})
            for (const int seed : {1, 2, 3})
            {
                const Polygon square = rectangle(size, size, turn);
                const std::vector<SourceLine> lines = lines_of(
                    {set("domain.polygon", square), set("joint_set[0].p21", p21), set("generator.seed", seed)});
                const std::string name = fmt::format("turned {:g}°, P21 {:g}, seed {}: ", turn, p21, seed);
                for (const double scan_deg : {turn, turn + 90.0})
                {
                    const Vec2 along(std::cos(radians(scan_deg)), std::sin(radians(scan_deg)));
                    const Vec2 across = turned_left(along), middle = 0.25 * (square[0] + square[1] + square[2] + square[3]);
                    double met = 0.0, scanned = 0.0;
                    for (double off = -45.0; off <= 45.0; off += 5.0)
                    {
                        const Vec2 from = middle + off * across - 0.5 * size * along;
                        std::vector<double> shares;
                        for (const SourceLine& line : lines)
                            add_crossings(line.points, false, from, from + size * along, shares);
                        met += static_cast<double>(shares.size());
                        scanned += size;
                    }
                    const double reference = 2.0 * p21 / pi;
                    report.require(
                        {name + fmt::format("met by a scan line at {:g}° [1/m]", scan_deg), "2 P21 / π", reference, met / scanned},
                        absolute(3.0 * std::sqrt(reference / scanned)));
                }
                double crossings = 0.0;
                for (std::size_t i = 0; i < lines.size(); ++i)
                    for (std::size_t j = 0; j < i; ++j)
                    {
                        const Polygon& a = lines[i].points;
                        const Polygon& b = lines[j].points;
                        if ((a[0] + a[1] - b[0] - b[1]).squaredNorm() > 4.0 * trace * trace)
                            continue;
                        std::vector<double> shares;
                        add_crossings(b, false, a[0], a[1], shares);
                        if (!shares.empty() && contains(square, a[0] + shares[0] * (a[1] - a[0])))
                            crossings += 1.0;
                    }
                const double reference = p21 * p21 / pi, area = size * size;
                const double of_one = 2.0 * p21 * trace / pi;  // that one trace has
                // A sum over pairs of a Poisson process: its mean, and the number of traces times the square of what one has.
                const double variance = reference * area + p21 / trace * area * of_one * of_one;
                report.require({name + "crossings of traces [1/m²]", "P21² / π", reference, crossings / area},
                               absolute(3.0 * std::sqrt(variance) / area));
            }
}
}  // namespace

std::vector<Check> rock_mass_checks()
{
    return {{"rockmass.R1", "RQD of joints at spacings that are drawn", check_rqd},
            {"rockmass.R2", "Voronoi cells of random points", check_cells},
            {"rockmass.R3", "sets of planes in a section", check_section},
            {"rockmass.R4", "directions, lengths and crossings of traces",
             [](Report& report)
             {
                 check_directions(report);
                 check_lengths(report);
                 check_crossings(report);
             }}};
}
}  // namespace hdem::verification
