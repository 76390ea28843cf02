#pragma once
/// Standard output and error output. What goes there is printable (io/printable.h): names and titles come from files that others wrote.

#include <fmt/format.h>

#include <string_view>

namespace hdem
{
/// To standard output.
void say_text(std::string_view text);
/// For commands whose outcome is what they print. Throws std::runtime_error where not all of it could be written, as on a full disk.
void finish_output();
/// To error output.
void complain_text(std::string_view text);

template <class... T>
void say(fmt::format_string<T...> format, T&&... values)
{
    say_text(fmt::format(format, std::forward<T>(values)...));
}

template <class... T>
void complain(fmt::format_string<T...> format, T&&... values)
{
    complain_text(fmt::format(format, std::forward<T>(values)...));
}

/// From now on a reader of the screen that goes (hdem run CASE | head) is an error of write(), not the end of the program: a run goes on, its log has all.
void outlive_reader();

/// Before anything is opened: standard input and outputs that are closed become /dev/null, so that no file of the run takes their numbers and
/// receives what is meant for the screen. A file that outgrows `ulimit -f` is from now on an error of write(), not the end of the program.
void prepare_console();
}  // namespace hdem
