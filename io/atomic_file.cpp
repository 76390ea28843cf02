#include "io/atomic_file.h"

#include "core/check.h"
#include "io/fresh_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace hdem
{
namespace
{
const char* advice(int error)
{
    switch (error)
    {
    case ENOSPC:
    case EDQUOT:
        return "The disk or the quota is full: free some space, or write to another folder with -o.";
    case EFBIG:
        return "A limit on file sizes was met: see ulimit -f.";
    case EACCES:
    case EPERM:
    case EROFS:
        return "Give a folder that may be written: with -o, or in the name of the file.";
    default:
        return "Check the disk, or write to another folder with -o.";
    }
}

/// A file descriptor that is closed, and a temporary file that is removed, however the function is left.
class Temporary
{
  public:
    explicit Temporary(const std::filesystem::path& target)
        : target_(target),
          name_(temporary_name(target)),
          descriptor_(open_new(name_))
    {
        if (descriptor_ < 0)
            fail();
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary()
    {
        if (descriptor_ >= 0)
            ::close(descriptor_);
        if (!renamed_)
            ::unlink(name_.c_str());
    }

    void write(std::span<const std::byte> bytes) const
    {
        while (!bytes.empty())
        {
            const ssize_t n = ::write(descriptor_, bytes.data(), std::min<std::size_t>(bytes.size(), 1U << 30U));
            if (n < 0 && errno != EINTR)
                fail();
            bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
        }
    }

    void rename(const std::filesystem::path& previous, Flush flush)
    {
        if (flush == Flush::now && ::fsync(descriptor_) != 0)
            fail();
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0)
            fail();
        if (!previous.empty())
            keep_target_as(previous);
        if (::rename(name_.c_str(), target_.c_str()) != 0)  // NFS reports a full disk at close
            fail();
        renamed_ = true;
    }

  private:
    /// A second name for the target, so that the first one never misses; some file systems have no second names.
    void keep_target_as(const std::filesystem::path& previous) const
    {
        const std::filesystem::path second = temporary_name(previous);
        const bool linked = ::link(target_.c_str(), second.c_str()) == 0;
        if (!linked && errno == ENOENT)
            return;  // there is no target yet
        if (::rename(linked ? second.c_str() : target_.c_str(), previous.c_str()) != 0)
            fail();
        ::unlink(second.c_str());  // still there when both are names of one file
    }

    [[noreturn]] void fail() const
    {
        const int error = errno;
        throw RunError(fmt::format("{}: cannot be written ({}). {}", target_.string(), std::strerror(error), advice(error)));
    }

    std::filesystem::path target_;
    std::filesystem::path name_;
    int descriptor_ = -1;
    bool renamed_ = false;
};

void sync_folder(const std::filesystem::path& folder)
{
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return;
    ::fsync(descriptor);  // some file systems cannot sync a folder; the file itself is safe by then
    ::close(descriptor);
}
}  // namespace

void write_atomically(const std::filesystem::path& file, std::span<const std::byte> bytes, const std::filesystem::path& previous,
                      Flush flush)
{
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw RunError(fmt::format("{}: folder cannot be made ({}). {}", folder.string(), error.message(), advice(error.value())));
    if (const auto status = std::filesystem::symlink_status(file, error); std::filesystem::is_other(status))
        throw RunError(fmt::format("{}: cannot be written (is a device or a pipe, and would be replaced). Give the name of a file.",
                                   file.string()));
    Temporary temporary(file);
    temporary.write(bytes);
    temporary.rename(previous, flush);
    if (flush == Flush::now)
        sync_folder(folder);
}

void write_atomically(const std::filesystem::path& file, std::string_view text, Flush flush)
{
    write_atomically(file, std::as_bytes(std::span(text)), {}, flush);
}

void flush_folder(const std::filesystem::path& folder)
{
    const std::filesystem::path name = folder.empty() ? "." : folder;
    const int descriptor = ::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool flushed = descriptor >= 0 && ::syncfs(descriptor) == 0;
    const int error = errno;
    if (descriptor >= 0)
        ::close(descriptor);
    if (!flushed && error != ENOENT)
        throw RunError(
            fmt::format("{}: cannot be brought to the disk ({}). {}", name.string(), std::strerror(error), advice(error)));
}

void remove_file(const std::filesystem::path& file)
{
    if (::unlink(file.c_str()) == 0 || errno == ENOENT || errno == ENOTDIR)
        return;
    const int error = errno;
    throw RunError(fmt::format("{}: cannot be removed ({}). {}", file.string(), std::strerror(error), advice(error)));
}
}  // namespace hdem
