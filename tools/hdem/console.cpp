#include "tools/hdem/console.h"

#include "io/printable.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace hdem
{
namespace
{
void put(std::FILE* stream, std::string_view text)
{
    const std::string safe = printable(text);
    std::fwrite(safe.data(), 1, safe.size(), stream);
}
}  // namespace

void say_text(std::string_view text)
{
    put(stdout, text);
}

void finish_output()
{
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw std::runtime_error(fmt::format("standard output: cannot be written{}. Free some space, or write to another file.",
                                             errno != 0 ? fmt::format(" ({})", std::strerror(errno)) : ""));
}

void complain_text(std::string_view text)
{
    put(stderr, text);
}

void outlive_reader()
{
    static_cast<void>(std::signal(SIGPIPE, SIG_IGN));
}

void prepare_console()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) == -1)
            static_cast<void>(::open("/dev/null", O_RDWR));  // takes the lowest free number: this one
    static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
}
}  // namespace hdem
