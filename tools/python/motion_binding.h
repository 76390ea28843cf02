#pragma once
/// Motion and forces of blocks in the class Run of Python.

#include "tools/python/driven_run.h"

#include <memory>

namespace hdem
{
using RunType = pybind11::class_<DrivenRun, std::shared_ptr<DrivenRun>>;

void bind_motion(RunType& type);
}  // namespace hdem
