/// The compiled part of the Python package hdem.

#include "core/check.h"
#include "core/version.h"
#include "parallel/team.h"
#include "tools/python/bindings.h"
#include "tools/python/python_lock.h"

#include <exception>
#include <string>
#include <vector>

namespace
{
namespace py = pybind11;

/// Exceptions of the package, in Python: they have bases of their own and of Python.
py::object exception_class(const char* name)
{
    return py::module_::import("hdem._errors").attr(name);
}

void raise_case_error(const hdem::InputError& error)
{
    std::vector<std::string> texts;
    for (const hdem::Problem& problem : error.problems())
        texts.push_back(problem.text);
    py::list problems;
    for (const std::string& text : texts)
        problems.append(text);
    const py::object type = exception_class("CaseError");
    PyErr_SetObject(type.ptr(), type(problems).ptr());
}

void translate(std::exception_ptr pointer)
{
    try
    {
        if (pointer)
            std::rethrow_exception(pointer);
    }
    catch (const hdem::InputError& error)
    {
        raise_case_error(error);
    }
    catch (const hdem::RunError& error)
    {
        PyErr_SetString(exception_class("RunError").ptr(), error.what());
    }
}
}  // namespace

PYBIND11_MODULE(_core, module)
{
    module.doc() = "The compiled part of hdem. Use the package hdem.";
    py::register_exception_translator(&translate);
    module.def(
        "version_line", [] { return std::string(hdem::version_line()); }, "Version, commit and build of the library.");
    module.def("default_threads", &hdem::default_threads,
               "Threads that there can be: OMP_NUM_THREADS, else the processors at hand.");
    py::module_::import("atexit").attr("register")(py::cpp_function(&hdem::PythonEnd::begin));
    hdem::bind_case(module);
    hdem::bind_run(module);
    hdem::bind_factor(module);
}
