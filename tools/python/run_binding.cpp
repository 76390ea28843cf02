#include "core/energy_ledger.h"
#include "core/state/stage_cycles.h"
#include "core/state/state_hash.h"
#include "io/frame_writer.h"
#include "tools/python/bindings.h"
#include "tools/python/contact_table.h"
#include "tools/python/motion_binding.h"
#include "tools/python/python_lock.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace hdem
{
namespace
{
namespace py = pybind11;

/// A script may go to another folder while the run lives.
std::string from_root(const std::string& path)
{
    std::error_code failed;
    const std::filesystem::path found = std::filesystem::absolute(path, failed);
    return failed ? path : found.string();
}

RunOptions options_of(const std::optional<std::string>& folder, const std::optional<int>& threads, bool overwrite)
{
    check_threads(threads);
    return {.folder = folder.value_or("").empty() ? "" : from_root(*folder),
            .overwrite = overwrite,
            .threads = threads,
            .quiet = true,
            .command_line = {"python3", "import hdem"}};
}

/// A stage as a dictionary.
py::dict stage_dict(const StageResult& stage, bool is_over, const Model& model)
{
    std::vector<std::string> names;
    for (const Index user : stage.not_at_rest)
        names.push_back(model.name[model.slot_of_user[user]]);
    py::dict dict;
    dict["name"] = stage.name;
    dict["first_cycle"] = stage.first_cycle;
    dict["cycles"] = stage.cycles;
    dict["time"] = stage.time;
    dict["is_over"] = is_over;
    dict["converged"] = stage.at_rest;
    dict["met_end"] = is_over && stage.met_end();
    dict["not_at_rest"] = names;
    dict["to_come"] = stage.to_come;
    return dict;
}

py::list stage_list(const DrivenRun& run)
{
    py::list list;
    const Model& model = run.simulation().model();
    const std::vector<StageResult>& stages = run.results();
    for (const StageResult& stage : stages)
        list.append(stage_dict(stage, run.is_over() || &stage != &stages.back(), model));
    return list;
}

py::dict energies(const DrivenRun& run)
{
    const Simulation& now = run.simulation();
    const StoredEnergy stored = stored_energy(now.model(), now.state());
    py::dict dict;
    for (const LedgerTerm& term : ledger_terms)
        if (term.side != LedgerSide::aside)
            dict[term.name] = now.state().ledger.*term.value;
    dict["stored"] = stored.total();
    dict["kinetic"] = stored.kinetic;
    dict["residual"] = residual(now.state().ledger, stored);
    return dict;
}

void bind_progress(RunType& type)
{
    const auto state = [](const DrivenRun& run) -> const State& { return run.simulation().state(); };
    const auto at_hand = [](const DrivenRun& run) -> const DrivenRun&
    {
        static_cast<void>(run.simulation());  // throws where cycles run
        return run;
    };
    type.def_property_readonly(
        "cycle", [=](const DrivenRun& run) { return state(run).cycle; }, "Cycles that have run.");
    type.def_property_readonly(
        "time", [=](const DrivenRun& run) { return state(run).time; }, "Simulated [s].");
    type.def_property_readonly(
        "time_step", [=](const DrivenRun& run) { return state(run).blocks.step.next; }, "Of the next cycle [s].");
    type.def_property_readonly(
        "stage", [=](const DrivenRun& run) { return state(run).stage; },
        "Number of the running stage, or of the next one to begin; from 0.");
    type.def_property_readonly(
        "stage_begun", [=](const DrivenRun& run) { return state(run).stage_begun; },
        "The stage runs, or has come to its end; else it is the next one.");
    type.def_property_readonly(
        "stage_cycles",
        [=](const DrivenRun& run) { return state(run).stage_begun ? state(run).cycle - state(run).stage_begin_cycle : 0; },
        "Cycles that the stage has run.");
    type.def(
        "_cycles_since", [=](const DrivenRun& run, Index stage) { return cycles_since(stage < 0 ? no_index : stage, state(run)); },
        py::arg("stage"));
    type.def_property_readonly(
        "is_over", [=](const DrivenRun& run) { return at_hand(run).is_over(); }, "The present stage has come to its end.");
    type.def_property_readonly(
        "is_done", [=](const DrivenRun& run) { return at_hand(run).is_done(); }, "All stages of the case have run.");
    type.def_property_readonly(
        "threads", [](const DrivenRun& run) { return run.simulation().threads(); }, "At most.");
    type.def_property_readonly(
        "state_hash",
        [](const DrivenRun& run) { return fmt::format("{:016x}", state_hash(run.simulation().model(), run.simulation().state())); },
        "Fingerprint of all that decides how the run goes on: the state_hash of summary.json.");
    type.def_property_readonly(
        "kinetic_energy", [](const DrivenRun& run) { return run.simulation().equilibrium().kinetic_energy; },
        "Of free blocks [J].");
    type.def_property_readonly(
        "unbalanced_force_ratio", [](const DrivenRun& run) { return run.simulation().equilibrium().unbalanced_force_ratio(); },
        "Mean unbalanced force over mean applied force [-].");
    type.def_property_readonly("energies", energies,
                               "Terms of the energy ledger since the start, and what is stored now; dict of numbers [J].");
    type.def_property_readonly("results", stage_list, "What run() has returned last.");
    type.def_property_readonly(
        "case_text", [](const DrivenRun& run) { return run.start().record.case_text; },
        "The case as TOML, with stages that were added.");
    type.def_property_readonly(
        "case_overrides", [](const DrivenRun& run) { return run.start().record.overrides; }, "key.path=value, laid over it.");
    type.def_property_readonly(
        "case_file", [](const DrivenRun& run) { return run.start().record.case_file; }, "Its name.");
    type.def_property_readonly(
        "folder", [](const DrivenRun& run) { return run.start().folder.string(); }, "Of the results; an empty text: none.");
    type.def_property_readonly("_summary", [=](const DrivenRun& run) { return at_hand(run).summary(); });
}

void bind_files(RunType& type)
{
    type.def(
        "write_checkpoint", &DrivenRun::write_checkpoint, py::arg("folder"),
        "Write FOLDER/checkpoint.h5; the one that was there becomes checkpoint.previous.h5. `hdem run --restart` goes on from it.");
    type.def(
        "write_frame",
        [](const DrivenRun& run, const std::string& file, const std::string& kind)
        {
            const Look look = run.look();
            if (kind == "blocks")
                write_block_frame(file, look.model, look.state);
            else if (kind == "contacts")
                write_contact_frame(file, look.model, look.state);
            else if (kind == "bolts")
                write_bolt_frame(file, look.model, look.state);
            else if (kind == "liners")
                write_liner_frame(file, look.model, look.state);
            else
                throw py::value_error(fmt::format("kind = \"{}\" (unknown). Give blocks, contacts, bolts or liners.", kind));
        },
        py::arg("file"), py::arg("kind") = "blocks", "Write one VTKHDF file of the present state, as those in frames/ of a run.");
    type.def("_take_case", [](DrivenRun& run, const std::string& text, const std::vector<std::string>& overrides)
             { run.take_case(build_case(text, run.start().record.case_file, overrides, &run.start().record.files)); });
}

std::shared_ptr<DrivenRun> make_run(const BuiltCase& built, const std::optional<std::string>& folder,
                                    const std::optional<int>& threads, bool overwrite)
{
    const RunOptions options = options_of(folder, threads, overwrite);
    const WithoutPython free;  // here, and not as a call_guard: what pybind11 does with the result needs the lock
    return std::make_shared<DrivenRun>(start_loaded(*built.loaded, built.overrides, options), options);
}

std::shared_ptr<DrivenRun> make_restart(const std::string& checkpoint, bool writes, const std::optional<int>& threads)
{
    RunOptions options = options_of(std::nullopt, threads, false);
    const WithoutPython free;
    if (!writes)
        return std::make_shared<DrivenRun>(read_moment(checkpoint), options);
    options.restart = from_root(checkpoint);
    RunStart start = start_run(options);
    options.folder = start.folder.string();
    return std::make_shared<DrivenRun>(std::move(start), options);
}

/// That of Python or of numpy.
bool is_false(const py::object& answer)
{
    const bool is_truth = py::isinstance<py::bool_>(answer) || py::isinstance(answer, py::module_::import("numpy").attr("bool_"));
    return is_truth && PyObject_IsTrue(answer.ptr()) == 0;
}

py::list run_piece(const py::object& self, const std::optional<std::int64_t>& cycles, const std::optional<int>& stages,
                   const py::object& callback, std::int64_t every)
{
    if (cycles.value_or(0) < 0 || stages.value_or(0) < 0 || every < 1)
        throw py::value_error("run(): cycles and stages must not be negative, every must be at least 1");
    DrivenRun::Piece piece{.cycles = cycles, .stages = stages, .every = every, .callback = {}};
    if (!callback.is_none())
        piece.callback = [&self, &callback] { return !is_false(callback(self)); };
    DrivenRun& run = self.cast<DrivenRun&>();
    run.run(piece);
    return stage_list(run);
}
}  // namespace

void bind_run(py::module_& module)
{
    PYBIND11_NUMPY_DTYPE(ContactRow, blocks, joint, end, regime, point, normal, length, normal_force, shear_force, tilt_force, gap,
                         closure, slip, plastic_slip, broken);
    RunType type(module, "Run");
    type.def(py::init(&make_run), py::arg("case"), py::arg("folder"), py::arg("threads"), py::arg("overwrite"));
    type.def(py::init(&make_restart), py::arg("checkpoint"), py::arg("writes"), py::arg("threads"));
    type.def("_run", &run_piece, py::arg("cycles"), py::arg("stages"), py::arg("callback"), py::arg("every"));
    type.def(
        "contacts", [](const DrivenRun& run, bool also_open) { return contact_table(run.look(), also_open); },
        py::arg("also_open") = false);
    bind_blocks(type, [](const DrivenRun& run) { return run.look(); });
    bind_motion(type);
    bind_progress(type);
    bind_files(type);
}
}  // namespace hdem
