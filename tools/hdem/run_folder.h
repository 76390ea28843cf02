#pragma once
/// What a folder holds of earlier runs and searches, when a run begins in it.

#include "tools/hdem/run_start.h"

#include <string>
#include <vector>

namespace hdem
{
/// Throws InputError when something stands in the way: a folder under the name of a file or a file under that of a folder, links to the folders of another run.
void check_folder(const std::filesystem::path& folder);

/// Throws InputError when files lie here under the names of a run's, and nothing says that they are of hdem: they would be removed.
void refuse_files_of_others(const std::filesystem::path& folder);

/// Throws InputError when the summary here has a factor of safety.
void refuse_factor(const std::filesystem::path& folder);

/// Throws InputError, and leaves all as it is, when something here may not go unless --overwrite says so: a run that was cut short, a search for a factor of safety
/// that was, a search of hdem critical, files of somebody else; or as check_folder.
/// Else removes all that an older run left, by its names: it must not be taken for this one's. A run that goes on in its folder finds it as it left it.
/// @return what the user should know: that results of another case, or a factor of safety, are gone
[[nodiscard]] std::vector<std::string> clear_for_run(const RunStart& start, bool overwrite);

/// Removes the files of a run, and the folder if nothing else is in it. Throws InputError when a run goes on there.
void remove_run(const std::filesystem::path& folder);
}  // namespace hdem
