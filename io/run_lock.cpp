#include "io/run_lock.h"

#include "core/check.h"
#include "io/fresh_file.h"
#include "io/printable.h"
#include "io/provenance.h"
#include "io/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

struct Owner
{
    std::string host;
    pid_t process = 0;
    std::string start;
};

std::string host_name()
{
    std::array<char, 256> name = {};
    ::gethostname(name.data(), name.size() - 1);
    return name.data();
}

/// Nothing when the file is empty, not ours or damaged.
std::optional<Owner> read_owner(const fs::path& file)
{
    constexpr std::size_t most = 4096;
    const nlohmann::json read = nlohmann::json::parse(read_text_file(file, most).text, nullptr, false);
    try
    {
        return Owner{read.at("host").get<std::string>(), read.at("process").get<pid_t>(), read.at("start").get<std::string>()};
    }
    catch (const nlohmann::json::exception&)
    {
        return std::nullopt;
    }
}

/// A process of this machine that has ended.
bool is_dead(const Owner& owner)
{
    return owner.host == host_name() && ::kill(owner.process, 0) != 0 && errno == ESRCH;
}

/// Is the open file the one that now stands under the name? The run before may have removed it while we waited for its lock.
bool is_under(const fs::path& file, int descriptor)
{
    struct stat by_name = {};
    struct stat opened = {};
    return ::lstat(file.c_str(), &by_name) == 0 && ::fstat(descriptor, &opened) == 0 && by_name.st_ino == opened.st_ino &&
           by_name.st_dev == opened.st_dev;
}

/// The uppermost folder on the way to this one that is missing; empty when none is.
fs::path first_missing(const fs::path& folder)
{
    fs::path missing;
    for (fs::path at = folder; !at.empty() && !fs::exists(at); at = at.parent_path())
    {
        missing = at;
        if (at == at.parent_path())
            break;
    }
    return missing;
}

void make_folder(const fs::path& folder)
{
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed)
        throw RunError(
            fmt::format("{}: the folder cannot be made ({}). Give another one with -o.", folder.string(), failed.message()));
}

/// Programs that only ask whether a run is there hold the lock for a moment: a run does not give way to them.
bool try_lock(int descriptor)
{
    constexpr int tries = 10;
    for (int i = 0; i < tries; ++i)
    {
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
            return true;
        if (errno != EWOULDBLOCK)
            return false;
        ::usleep(5000);
    }
    errno = EWOULDBLOCK;
    return false;
}

int open_lock(const fs::path& file)
{
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    struct stat found = {};
    if (descriptor >= 0 && ::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode))
        return descriptor;
    const std::string why = descriptor < 0 && errno != ELOOP ? std::strerror(errno) : "a link, a pipe or a device";
    if (descriptor >= 0)
        ::close(descriptor);
    throw RunError(fmt::format("{}: cannot be written ({}). Give another folder with -o.", file.string(), why));
}
}  // namespace

RunLock::RunLock(fs::path folder) : folder_(std::move(folder)), file_(folder_ / ".lock"), first_made_(first_missing(folder_))
{
    make_folder(folder_);
    take();
    if (struct stat found = {}; ::stat(folder_.c_str(), &found) == 0)
    {
        folder_number_ = found.st_ino;
        folder_device_ = found.st_dev;
    }
    write_owner();
    remove_leftovers(folder_);
    remove_leftovers(folder_ / "frames");
}

RunLock::~RunLock()
{
    if (is_under(file_, descriptor_))
        ::unlink(file_.c_str());  // before the lock goes: who opens it afterwards makes a new one
    ::close(descriptor_);
    if (first_made_.empty())
        return;
    for (fs::path at = folder_; ::rmdir(at.c_str()) == 0 && at != first_made_;)
        at = at.parent_path();
}

bool RunLock::is_held() const
{
    struct stat found = {};
    if (::lstat(file_.c_str(), &found) == 0)
        return is_under(file_, descriptor_);
    if (::stat(folder_.c_str(), &found) == 0)  // the file alone is gone, as where /tmp is tidied up: nobody else is here
        return found.st_ino == folder_number_ && found.st_dev == folder_device_;
    return errno != ENOENT && errno != ENOTDIR;  // a file system that does not answer now has lost nothing
}

void RunLock::check() const
{
    if (!is_held())
        throw RunError(
            fmt::format("{}: (the folder was moved or removed while the run went on, or another run has taken it). The run "
                        "ends here and writes nothing more. Go on with --restart and the folder's new name.",
                        printable(folder_.string())));
}

void RunLock::take()
{
    for (;;)
    {
        const int descriptor = open_lock(file_);
        const bool locked = try_lock(descriptor);
        if (!locked && errno == EWOULDBLOCK)
            refuse(descriptor, true);
        if (!locked)  // no such locks here, as on some file systems of clusters: what the file says has to do
            if (const std::optional<Owner> owner = read_owner(file_); owner && !is_dead(*owner))
                refuse(descriptor, false);
        if (is_under(file_, descriptor))
        {
            descriptor_ = descriptor;
            return;
        }
        ::close(descriptor);
    }
}

void RunLock::refuse(int descriptor, bool trust_system) const
{
    ::close(descriptor);
    const std::optional<Owner> owner = read_owner(file_);
    const bool is_ours = owner && owner->host == host_name() && owner->process == ::getpid();
    const std::string who = owner ? fmt::format("process {} on {} since {}{}", owner->process, owner->host, owner->start,
                                                is_ours ? ", which is this one" : "")
                                  : "it has just begun";
    throw InputError(Problem{
        .key = {},
        .text = fmt::format("{}: (another run is in this folder: {}). {}, or write to another folder with -o.{}", folder_.string(),
                            who, is_ours ? "Delete that simulation first, in Python by del" : "Wait for its end",
                            trust_system ? "" : fmt::format(" If that run is over, remove {}.", file_.string()))});
}

void RunLock::write_owner() const
{
    const nlohmann::ordered_json owner = {{"host", host_name()}, {"process", ::getpid()}, {"start", timestamp()}};
    const std::string text = owner.dump() + "\n";
    if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, text.data(), text.size(), 0) < 0)
        throw RunError(
            fmt::format("{}: cannot be written ({}). Give another folder with -o.", file_.string(), std::strerror(errno)));
}
}  // namespace hdem
