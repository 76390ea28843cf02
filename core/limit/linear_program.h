#pragma once
/// A linear program that is solved again and again with other numbers, by Clp.

#include <memory>
#include <vector>

namespace hdem
{
/// Add the columns first, then call `solve`. The matrix may be changed between two solutions; the next one begins from the last basis.
class LinearProgram
{
  public:
    explicit LinearProgram(int rows);
    LinearProgram(const LinearProgram&) = delete;
    LinearProgram& operator=(const LinearProgram&) = delete;
    ~LinearProgram();

    struct Entry
    {
        int row = 0;
        double value = 0.0;
    };
    /// @return its number
    int add_column(double low, double high, double cost, const std::vector<Entry>& entries);
    /// Change the values of a column. The entries have the same rows as before, in the same order.
    void change_column(int column, const std::vector<Entry>& entries);
    void change_bounds(int column, double low, double high);
    /// Sum of the row's entries times the columns.
    void set_row(int row, double value);

    enum class Status
    {
        optimal,
        infeasible,
        unbounded,
        gave_up  ///< after most_iterations, or for round-off
    };
    /// Least cost.
    [[nodiscard]] Status solve(int most_iterations);
    [[nodiscard]] double cost() const { return cost_; }
    [[nodiscard]] int iterations() const { return iterations_; }

  private:
    enum class Attempt
    {
        from_last_basis,
        anew,
        anew_by_dual,
        anew_scaled
    };
    [[nodiscard]] Status attempt(int most_iterations, Attempt how);

    struct Clp;
    std::unique_ptr<Clp> clp_;
    std::vector<int> begin_{0}, row_;
    std::vector<double> value_, low_, high_, cost_of_, row_value_;
    double cost_ = 0.0;
    int iterations_ = 0;
};
}  // namespace hdem
