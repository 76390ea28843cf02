#pragma once
/// What one check found: rows of a quantity, its reference, the measured value, the bar and the verdict, and figures beside them.

#include "verification/checks/figure.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hdem::verification
{
enum class Verdict
{
    pass,
    miss,
    informs  ///< no bar: shown for comparison only
};

/// What a row compares. A quantity without reference (NaN) is only shown.
struct Quantity
{
    std::string name;    ///< with its unit in brackets
    std::string source;  ///< table, equation or formula the reference comes from
    double reference = 0.0;
    double measured = 0.0;
};

/// How far the measured value may be from the reference.
struct Bar
{
    enum class Kind
    {
        relative,  ///< |measured - reference| <= tolerance |reference|
        absolute,  ///< |measured - reference| <= tolerance
        at_most,   ///< measured <= reference
        at_least   ///< measured >= reference
    };
    Kind kind = Kind::relative;
    double tolerance = 0.0;
};
[[nodiscard]] inline Bar relative(double tolerance)
{
    return {Bar::Kind::relative, tolerance};
}
[[nodiscard]] inline Bar absolute(double tolerance)
{
    return {Bar::Kind::absolute, tolerance};
}
[[nodiscard]] inline Bar at_most()
{
    return {Bar::Kind::at_most, 0.0};
}
[[nodiscard]] inline Bar at_least()
{
    return {Bar::Kind::at_least, 0.0};
}

struct Row
{
    Quantity quantity;
    std::optional<Bar> bar;
    Verdict verdict = Verdict::informs;

    /// Relative to the reference, or the plain difference for an absolute bar and for a reference of 0.
    [[nodiscard]] double deviation() const;
    [[nodiscard]] std::string deviation_text() const;
    [[nodiscard]] std::string bar_text() const;
};

class CaseRun;

class Report
{
  public:
    /// Adds a row with a bar; a measured value that is not a number is a miss.
    void require(Quantity quantity, Bar bar);
    /// Adds a row without a bar.
    void inform(Quantity quantity);
    /// A row without reference.
    void inform(const std::string& name, const std::string& source, double measured);

    /// Curves are thinned.
    void add_figure(Figure figure);

    /// Takes a finished run's energy residual into account and keeps its command line.
    void add_run(const CaseRun& run);
    /// Adds the rows on the energy ledger of all runs.
    void close();

    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
    [[nodiscard]] const std::vector<Figure>& figures() const { return figures_; }
    /// `hdem run` commands that repeat the runs.
    [[nodiscard]] const std::vector<std::string>& commands() const { return commands_; }
    [[nodiscard]] bool has_missed() const;

  private:
    struct Ledger
    {
        int runs = 0;
        double worst = 0.0;
    };
    std::vector<Row> rows_;
    std::vector<Figure> figures_;
    std::vector<std::string> commands_;
    Ledger with_impulses_;
    Ledger without_impulses_;
};
}  // namespace hdem::verification
