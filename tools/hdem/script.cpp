#include "tools/hdem/script.h"

#include "tools/hdem/console.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace hdem
{
std::filesystem::path shared_folder()
{
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    return program.parent_path().parent_path() / "share" / "hdem";
}

namespace
{
/// Until the script can end in one line (needed_modules.py): Python takes a while to begin, and would print where it was.
void hold_back_interrupts()
{
    sigset_t interrupts;
    ::sigemptyset(&interrupts);
    ::sigaddset(&interrupts, SIGINT);
    ::sigprocmask(SIG_BLOCK, &interrupts, nullptr);
}
}  // namespace

int run_script(const std::string& command, const std::string& script, const std::vector<std::string>& arguments)
{
    const std::string file = (shared_folder() / script).string();
    if (::access(file.c_str(), R_OK) != 0)
    {
        complain("error: hdem {}: {} is missing (it belongs to hdem's installation). Install or build hdem again.\n", command,
                 file);
        return 1;
    }
    std::vector<std::string> words = {python, file};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    std::fflush(nullptr);
    hold_back_interrupts();
    ::execv(python, argv.data());
    complain("error: hdem {}: {} cannot be run ({}). Install python3, python3-h5py and python3-matplotlib.\n", command, python,
             std::strerror(errno));
    return 1;
}
}  // namespace hdem
