#include "tools/python/case_binding.h"

#include "core/rock/rock_mass.h"
#include "tools/python/bindings.h"
#include "tools/python/python_lock.h"

#include <pybind11/stl.h>

namespace hdem
{
namespace
{
namespace py = pybind11;

LoadedCase load(const std::optional<std::string>& text, const std::string& file, const std::vector<Override>& overrides,
                const NamedFiles* files)
{
    if (!text)
        return load_case(file, overrides);
    if (files != nullptr)
        return load_case(*text, *files, file, overrides);
    const CaseFile read = read_case_text(*text, file, overrides);  // finds the other files
    return load_case(*text, read.files, file, overrides);
}

py::array_t<std::int32_t> excavations(const Look& look)
{
    py::array_t<std::int32_t> array(look.model.blocks());
    std::int32_t* to = array.mutable_data();
    for (const Index slot : look.model.slot_of_user)
        *to++ = look.model.excavation[slot];
    return array;
}
}  // namespace

BuiltCase build_case(const std::optional<std::string>& text, const std::string& file, std::vector<std::string> overrides,
                     const NamedFiles* files)
{
    std::vector<Override> parsed;
    for (const std::string& override : overrides)
        parsed.push_back(parse_override(override));
    return {std::make_shared<const LoadedCase>(load(text, file, parsed, files)), std::move(overrides)};
}

void bind_case(py::module_& module)
{
    py::class_<BuiltCase> type(module, "Case");
    type.def(py::init(
                 [](const std::optional<std::string>& text, const std::string& file, const std::vector<std::string>& overrides,
                    const std::optional<NamedFiles>& files)
                 {
                     const WithoutPython free;
                     return build_case(text, file, overrides, files ? &*files : nullptr);
                 }),
             py::arg("text"), py::arg("file"), py::arg("overrides"), py::arg("files") = py::none());
    type.def_property_readonly(
        "text", [](const BuiltCase& c) { return c.loaded->file.source.text(); }, "The case as TOML.");
    type.def_property_readonly(
        "file", [](const BuiltCase& c) { return c.loaded->file.source.file(); }, "Its name in messages.");
    type.def_property_readonly(
        "overrides", [](const BuiltCase& c) { return c.overrides; },
        "key.path=value, laid over the text: as --set of the program.");
    type.def_property_readonly("_files",
                               [](const BuiltCase& c)
                               {
                                   py::dict files;
                                   for (const auto& [name, text] : c.loaded->file.files)
                                       files[py::str(name)] = py::bytes(text);
                                   return files;
                               });
    type.def_property_readonly(
        "warnings",
        [](const BuiltCase& c)
        {
            std::vector<std::string> texts;
            for (const Problem& warning : c.loaded->warnings)
                texts.push_back(warning.text);
            return texts;
        },
        "What the program would warn of, list of texts.");
    type.def_property_readonly(
        "title", [](const BuiltCase& c) { return c.look().model.title; }, "As the case says it.");
    type.def_property_readonly(
        "time_step", [](const BuiltCase& c) { return c.look().model.time_step; },
        "Of the first cycle [s]. A run may find that contacts need a shorter one.");
    type.def_property_readonly(
        "stage_names",
        [](const BuiltCase& c)
        {
            std::vector<std::string> texts;
            for (const StageDef& stage : c.look().model.stages)
                texts.push_back(stage.name);
            return texts;
        },
        "In their order, list of texts.");
    type.def_property_readonly(
        "excavations", [](const BuiltCase& c) { return excavations(c.look()); },
        "Excavation each block lies in, (n,) int32, position in excavation_names, -1: none; copy.");
    type.def_property_readonly(
        "excavation_names", [](const BuiltCase& c) { return c.look().model.excavation_names; },
        "Of [[excavation]], list of texts.");
    bind_blocks(type, [](const BuiltCase& c) { return c.look(); });
}
}  // namespace hdem
