#include "core/limit/linear_program.h"

#include <Clp_C_Interface.h>

#include <algorithm>

namespace hdem
{
struct LinearProgram::Clp
{
    Clp_Simplex* model = Clp_newModel();
    Clp() = default;
    Clp(const Clp&) = delete;
    Clp& operator=(const Clp&) = delete;
    ~Clp() { Clp_deleteModel(model); }
};

LinearProgram::LinearProgram(int rows) : row_value_(static_cast<std::size_t>(rows), 0.0)
{
}
LinearProgram::~LinearProgram() = default;

int LinearProgram::add_column(double low, double high, double cost, const std::vector<Entry>& entries)
{
    low_.push_back(low);
    high_.push_back(high);
    cost_of_.push_back(cost);
    for (const Entry& e : entries)
    {
        row_.push_back(e.row);
        value_.push_back(e.value);
    }
    begin_.push_back(static_cast<int>(row_.size()));
    return static_cast<int>(low_.size()) - 1;
}

void LinearProgram::change_column(int column, const std::vector<Entry>& entries)
{
    for (std::size_t i = 0; i < entries.size(); ++i)
        value_[static_cast<std::size_t>(begin_[column]) + i] = entries[i].value;
}

void LinearProgram::change_bounds(int column, double low, double high)
{
    low_[column] = low;
    high_[column] = high;
}

void LinearProgram::set_row(int row, double value)
{
    row_value_[row] = value;
}

LinearProgram::Status LinearProgram::solve(int most_iterations)
{
    const Status status = attempt(most_iterations, Attempt::from_last_basis);
    if (status != Status::gave_up || iterations_ >= most_iterations)
        return status;
    // Clp loses its way in degenerate programs now and then: others find it.
    for (const Attempt other : {Attempt::anew, Attempt::anew_by_dual, Attempt::anew_scaled})
        if (const Status again = attempt(most_iterations, other); again != Status::gave_up)
            return again;
    return Status::gave_up;
}

LinearProgram::Status LinearProgram::attempt(int most_iterations, Attempt how)
{
    const auto columns = static_cast<int>(low_.size()), rows = static_cast<int>(row_value_.size());
    std::vector<unsigned char> basis;
    if (clp_ && how == Attempt::from_last_basis)
    {
        const unsigned char* const last = Clp_statusArray(clp_->model);
        basis.assign(last, last + columns + rows);
    }
    auto clp = std::make_unique<Clp>();
    Clp_setLogLevel(clp->model, 0);
    // Of numbers that are round-off scaling would make great ones, and Clp would stop at a point that is not the best: only where nothing else helps.
    Clp_scaling(clp->model, how == Attempt::anew_scaled ? 3 : 0);
    Clp_loadProblem(clp->model, columns, rows, begin_.data(), row_.data(), value_.data(), low_.data(), high_.data(),
                    cost_of_.data(), row_value_.data(), row_value_.data());
    Clp_setMaximumIterations(clp->model, most_iterations);
    if (!basis.empty())
        Clp_copyinStatus(clp->model, basis.data());
    if (how == Attempt::anew_by_dual)
        Clp_dual(clp->model, 0);
    else
        Clp_primal(clp->model, 0);
    clp_ = std::move(clp);
    iterations_ = Clp_numberIterations(clp_->model);
    cost_ = Clp_objectiveValue(clp_->model);
    switch (Clp_status(clp_->model))
    {
    case 0:
        return Status::optimal;
    case 1:
        return Status::infeasible;
    case 2:
        return Status::unbounded;
    default:
        return Status::gave_up;
    }
}
}  // namespace hdem
