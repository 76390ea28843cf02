#pragma once
/// What module.cpp puts together.

#include <pybind11/pybind11.h>

namespace hdem
{
void bind_case(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_factor(pybind11::module_& module);
}  // namespace hdem
