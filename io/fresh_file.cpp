#include "io/fresh_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <random>
#include <regex>
#include <string>

namespace hdem
{
namespace
{
constexpr mode_t rights = 0666;  // less what umask takes away

/// Of a file that a run writes: a user's own may end in the same way.
bool is_temporary(const std::string& name)
{
    static const std::regex of_run(
        R"((summary\.json|trials\.json|(checkpoint|checkpoint\.previous|results)\.h5|(view|report)\.html|[a-z]+\.hdf\.series|[a-z]+_\d+\.hdf))"
        R"(\.[0-9a-f]{12}\.tmp)");
    return std::regex_match(name, of_run);
}

int open_for_appending(const std::filesystem::path& file)
{
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC,
                                  rights);  // a pipe does not block
    struct stat found = {};
    if (descriptor < 0 || (::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode)))
        return descriptor;
    ::close(descriptor);
    errno = EINVAL;
    return -1;
}
}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& file)
{
    std::random_device device;  // the system's random numbers
    const std::uint64_t number = (std::uint64_t{device()} << 32U) | device();
    std::filesystem::path name = file;
    name += fmt::format(".{:012x}.tmp", number & 0xffff'ffff'ffffULL);
    return name;
}

int open_new(const std::filesystem::path& file)
{
    return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, rights);
}

std::FILE* open_log(const std::filesystem::path& file, bool append)
{
    if (!append && ::unlink(file.c_str()) != 0 && errno != ENOENT)
        return nullptr;
    const int descriptor = append ? open_for_appending(file) : open_new(file);
    return descriptor < 0 ? nullptr : ::fdopen(descriptor, append ? "a" : "w");
}

void remove_leftovers(const std::filesystem::path& folder)
{
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
        if (is_temporary(entry.path().filename().string()))
            ::unlink(entry.path().c_str());
}
}  // namespace hdem
