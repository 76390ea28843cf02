#include "tools/hdem/console.h"

#include "io/printable.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
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

void complain_text(std::string_view text)
{
    put(stderr, text);
}

void prepare_console()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) == -1)
            static_cast<void>(::open("/dev/null", O_RDWR));  // takes the lowest free number: this one
    static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
}
}  // namespace hdem
