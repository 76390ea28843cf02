#include "io/load_case.h"

namespace hdem
{
LoadedCase load_case(const std::filesystem::path& file, std::span<const Override> overrides)
{
    LoadedCase loaded;
    loaded.file = read_case_file(file, overrides);
    try
    {
        loaded.setup = build_model(loaded.file.def);
    }
    catch (const InputError& error)
    {
        throw InputError(loaded.file.source.located(error.problems()));
    }
    loaded.warnings = loaded.file.warnings;
    for (Problem& problem : loaded.file.source.located(std::move(loaded.setup.warnings)))
        loaded.warnings.push_back(std::move(problem));
    return loaded;
}
}  // namespace hdem
