#pragma once
/// One run at a time in a folder.

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace hdem
{
/// Holds FOLDER/.lock from construction to destruction. The system's lock (flock) ends with the process, however it dies: a file that a killed
/// run left behind locks nobody out. The file names its owner for those who come second: {"host", "process", "start"}.
class RunLock
{
  public:
    /// Makes the folder if it is missing.
    /// Throws InputError when another run is in it, with its owner; RunError when the folder or the file cannot be made.
    explicit RunLock(std::filesystem::path folder);
    RunLock(const RunLock&) = delete;
    RunLock& operator=(const RunLock&) = delete;
    /// Removes the file, if it is still this one, and folders that were made for it if nothing else came into them.
    ~RunLock();

    /// False once the folder was moved or removed, or the file is another one: another run may be under this name by now.
    [[nodiscard]] bool is_held() const;
    /// Throws RunError where it is not. To be asked before anything is written under a name in the folder.
    void check() const;

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  private:
    void take();
    [[noreturn]] void refuse(int descriptor, bool trust_system) const;
    void write_owner() const;

    std::filesystem::path folder_;
    std::filesystem::path file_;
    std::filesystem::path first_made_;  ///< the uppermost folder that was missing; empty when none was
    ino_t folder_number_ = 0;
    dev_t folder_device_ = 0;
    int descriptor_ = -1;
};
}  // namespace hdem
