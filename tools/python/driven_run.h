#pragma once
/// A run that Python drives: so many cycles, so many stages, with a look at it in between.

#include "tools/hdem/run_files.h"
#include "tools/python/case_binding.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// Python may hold views of the run's memory. They must be gone before cycles go on, because blocks may then be sorted anew in other memory.
class DrivenRun : public std::enable_shared_from_this<DrivenRun>
{
  public:
    struct Piece
    {
        std::optional<std::int64_t> cycles;  ///< at most
        std::optional<int> stages;           ///< at most
        std::int64_t every = 1000;           ///< cycles between calls of
        std::function<bool()> callback;      ///< called with the GIL; false: stop here
    };

    /// @param options  threads; folder of the results, "" for none
    DrivenRun(RunStart start, RunOptions options);
    ~DrivenRun();
    DrivenRun(const DrivenRun&) = delete;
    DrivenRun& operator=(const DrivenRun&) = delete;

    /// Run until the piece is done, the callback stops it, or Python throws an exception. The GIL is free while cycles run.
    const std::vector<StageResult>& run(const Piece& piece);

    /// Stages to come are those of another text of the same case.
    void take_case(const BuiltCase& next);
    /// Writes FOLDER/checkpoint.h5.
    void write_checkpoint(const std::string& folder);
    /// See Simulation::change_motion.
    void change_motion(const std::function<void(std::vector<BlockMotion>&)>& change);

    /// Throws where cycles run in another thread now.
    [[nodiscard]] const Simulation& simulation() const;
    [[nodiscard]] Look look() const { return {simulation().model(), simulation().state()}; }
    [[nodiscard]] const std::vector<StageResult>& results() const { return results_; }
    /// The present stage has come to its end.
    [[nodiscard]] bool is_over() const { return over_ || was_finished(); }
    /// The last stage has come to its end.
    [[nodiscard]] bool is_done() const;
    [[nodiscard]] const RunStart& start() const { return start_; }
    [[nodiscard]] const std::string& summary() const { return summary_; }

    /// An array of numpy that shares memory with the run; nobody can write to it.
    template <typename T>
    [[nodiscard]] pybind11::array view(const std::vector<T>& values);

  private:
    enum class Phase
    {
        idle,
        cycles,
        callback
    };
    class Watch;
    class Guard;

    /// The run comes from a checkpoint of a finished run, and no cycle has run since.
    [[nodiscard]] bool was_finished() const { return start_.restarted && start_.record.finished && results_.empty(); }
    void require_idle(const char* what) const;
    void require_no_view() const;
    void require_own_folder(const char* what) const;  ///< two processes would write the same files
    [[nodiscard]] pybind11::capsule lend();
    void run_stages_of(Watch& watch, const StagePart& part);

    RunStart start_;
    RunOptions options_;
    std::optional<Simulation> simulation_;
    std::unique_ptr<Log> log_;
    std::unique_ptr<RunFiles> files_;
    std::vector<StageResult> results_;
    std::optional<StageResult> over_;
    std::string failure_;  ///< why the run cannot go on; empty: it can
    std::string summary_;  ///< JSON, once the last stage is over and there is a folder
    Phase phase_ = Phase::idle;
    int views_ = 0;
    int process_ = 0;  ///< that it was made in
};

template <typename T>
pybind11::array DrivenRun::view(const std::vector<T>& values)
{
    namespace py = pybind11;
    static_cast<void>(simulation());
    py::array_t<T> array({static_cast<py::ssize_t>(values.size())}, {static_cast<py::ssize_t>(sizeof(T))}, values.data(), lend());
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}
}  // namespace hdem

template <>
class pybind11::detail::type_caster<hdem::DrivenRun> : public hdem::CasterOfMade<hdem::DrivenRun>
{
};
