#include "parallel/gmres.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
/// A cycle of iterations that leaves more than this of the residual has come to a stop.
constexpr double least_gain = 0.999;

Index pieces(Index size)
{
    return (size + sum_piece - 1) / sum_piece;
}

/// Visit the member's pieces of a vector: work(piece, range).
template <typename Work>
void for_pieces(const Team& team, Index size, const Work& work)
{
    const IndexRange mine = team.share(pieces(size));
    for (Index p = mine.begin; p < mine.end; ++p)
        work(p, IndexRange{p * sum_piece, std::min(size, (p + 1) * sum_piece)});
}

bool is_finite(const std::vector<double>& values)
{
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}
}  // namespace

void Gmres::prepare(Index size, int restart)
{
    size_ = size;
    restart_ = restart;
    stride_ = (static_cast<std::size_t>(size) + 7) / 8 * 8;
    vectors_.grow(stride_ * (2 * static_cast<std::size_t>(restart) + 1));
    sums_.resize(static_cast<std::size_t>(pieces(size)) * (static_cast<std::size_t>(restart) + 1));
}

/// Of what all members have written to sums_, `count` numbers a piece.
std::vector<double> Gmres::sums(const Team& team, Index count)
{
    team.barrier();
    std::vector<double> all(static_cast<std::size_t>(count), 0.0);
    for (Index p = 0; p < pieces(size_); ++p)
        for (Index i = 0; i < count; ++i)
            all[i] += sums_[static_cast<std::size_t>(p) * count + i];
    team.barrier();
    return all;
}

double Gmres::norm(const Team& team, const double* x)
{
    for_pieces(team, size_, [&](Index p, IndexRange range) { sums_[p] = dot(range, x, x); });
    return std::sqrt(sums(team, 1).front());
}

/// Take from basis(columns) its parts along those before it, and give it length 1. Returns these parts and its length before: a column of H.
std::vector<double> Gmres::make_orthogonal(const Team& team, Index columns)
{
    double* w = basis(columns);
    std::vector<double> column(static_cast<std::size_t>(columns) + 1, 0.0);
    for (int pass = 0; pass < 2; ++pass)
    {
        for_pieces(team, size_,
                   [&](Index p, IndexRange range)
                   {
                       for (Index i = 0; i < columns; ++i)
                           sums_[static_cast<std::size_t>(p) * columns + i] = dot(range, basis(i), w);
                   });
        const std::vector<double> part = sums(team, columns);
        for_pieces(team, size_,
                   [&](Index, IndexRange range)
                   {
                       for (Index i = 0; i < columns; ++i)
                           add_scaled(range, -part[i], basis(i), w);
                   });
        for (Index i = 0; i < columns; ++i)
            column[i] += part[i];
    }
    const double length = norm(team, w);
    double squares = length * length;
    for (const double part : column)
        squares += part * part;
    if (length <= 10.0 * std::numeric_limits<double>::epsilon() * std::sqrt(squares))
        return column;  // nothing new, its length stays 0
    column.back() = length;
    for_pieces(team, size_,
               [&](Index, IndexRange range) { std::for_each(w + range.begin, w + range.end, [&](double& v) { v /= length; }); });
    team.barrier();
    return column;
}

/// basis(0) = b - A x; returns its length.
double Gmres::take_residual(const Team& team, const Map& matrix, const double* b, const double* x)
{
    matrix(team, x, basis(0));
    for_pieces(team, size_,
               [&](Index, IndexRange range)
               {
                   for (Index i = range.begin; i < range.end; ++i)
                       basis(0)[i] = b[i] - basis(0)[i];
               });
    return norm(team, basis(0));
}

GmresResult Gmres::solve(const Team& team, Index size, const Map& matrix, const Map& preconditioner, const double* b, double* x,
                         const GmresSettings& settings)
{
    HDEM_EXPECT(settings.restart > 0 && settings.tolerance >= 0.0);
    team.alone([&] { prepare(size, settings.restart); });
    for_pieces(team, size,
               [&](Index, IndexRange range)
               {
                   std::fill(x + range.begin, x + range.end, 0.0);
                   std::copy(b + range.begin, b + range.end, basis(0) + range.begin);
               });
    const double whole = norm(team, basis(0));
    GmresResult result{whole == 0.0, 0, whole == 0.0 ? 0.0 : 1.0};
    HessenbergProblem problem;
    for (double residual = whole; !result.converged && std::isfinite(residual);)
    {
        for_pieces(team, size,
                   [&](Index, IndexRange range)
                   { std::for_each(basis(0) + range.begin, basis(0) + range.end, [&](double& v) { v /= residual; }); });
        team.barrier();
        problem.begin(residual);
        for (bool done = false; !done && problem.columns() < settings.restart && result.iterations < settings.most_iterations;)
        {
            const Index j = problem.columns();
            preconditioner(team, basis(j), direction(j));
            matrix(team, direction(j), basis(j + 1));
            ++result.iterations;
            const std::vector<double> column = make_orthogonal(team, j + 1);
            if (!is_finite(column))
                break;
            done = problem.add_column(column) <= settings.tolerance * whole || column.back() == 0.0;
        }
        const std::vector<double> y = problem.solve();
        const auto move = [&](double sign)
        {
            for_pieces(team, size,
                       [&](Index, IndexRange range)
                       {
                           for (std::size_t j = 0; j < y.size(); ++j)
                               add_scaled(range, sign * y[j], direction(static_cast<Index>(j)), x);
                       });
            team.barrier();
        };
        move(1.0);
        const double before = residual;
        residual = take_residual(team, matrix, b, x);
        if (!(residual <= before))  // round-off in a system that is all but singular
        {
            move(-1.0);
            residual = before;
        }
        result.residual = residual / whole;
        result.converged = residual <= settings.tolerance * whole;
        if (result.iterations >= settings.most_iterations || !(residual < least_gain * before))
            break;
    }
    return result;
}
}  // namespace hdem
