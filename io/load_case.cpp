#include "io/load_case.h"

namespace hdem
{
namespace
{
LoadedCase built(CaseFile file)
{
    LoadedCase loaded{.file = std::move(file), .setup = {}, .warnings = {}};
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
}  // namespace

LoadedCase load_case(const std::filesystem::path& file, std::span<const Override> overrides)
{
    return built(read_case_file(file, overrides));
}

LoadedCase load_case(std::string text, const NamedFiles& files, const std::filesystem::path& file,
                     std::span<const Override> overrides)
{
    return built(read_case_text(std::move(text), file, overrides, &files));
}
}  // namespace hdem
