#pragma once
/// Python's lock, taken and given back by threads that run cycles.
///
/// When Python ends, it tears threads that ask for its lock out of their functions, which would end the program with an error. Threads that are still in a run
/// then wait here for the end of the process.

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

namespace hdem
{
class PythonEnd
{
  public:
    /// To be called before the lock is asked for, and after it is there.
    static void enter()
    {
        ++asking();
        if (!has_begun() || std::this_thread::get_id() == ending_thread())
            return;
        --asking();
        for (;;)
            std::this_thread::sleep_for(std::chrono::hours(1));
    }
    static void entered() { --asking(); }

    /// Called by Python's atexit, with the lock held. From now on no other thread asks for the lock, and none is asking any more.
    static void begin()
    {
        ending_thread() = std::this_thread::get_id();
        has_begun() = true;
        const pybind11::gil_scoped_release release;
        for (int tries = 0; tries < 1000 && asking() > 0; ++tries)  // a forked process may never see the last one go
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

  private:
    static std::atomic<bool>& has_begun()
    {
        static std::atomic<bool> value{false};
        return value;
    }
    static std::atomic<int>& asking()
    {
        static std::atomic<int> value{0};
        return value;
    }
    static std::thread::id& ending_thread()
    {
        static std::thread::id value;
        return value;
    }
};

/// Holds the lock while it lives.
class WithPython
{
  public:
    WithPython()
    {
        PythonEnd::enter();
        lock_.emplace();
        PythonEnd::entered();
    }

  private:
    std::optional<pybind11::gil_scoped_acquire> lock_;
};

/// Gives the lock away while it lives.
class WithoutPython
{
  public:
    WithoutPython() { without_.emplace(); }
    ~WithoutPython()
    {
        PythonEnd::enter();
        without_.reset();
        PythonEnd::entered();
    }
    WithoutPython(const WithoutPython&) = delete;
    WithoutPython& operator=(const WithoutPython&) = delete;

  private:
    std::optional<pybind11::gil_scoped_release> without_;
};
}  // namespace hdem
