#pragma once
/// What writing and reading HDF5 share: element types, handles that close themselves, errors. For io/hdf5_*.cpp only.

#include "io/hdf5_types.h"

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <utility>

namespace hdem
{
/// An HDF5 identifier and the function that closes it.
class Hdf5Handle
{
  public:
    using Close = herr_t (*)(hid_t);

    Hdf5Handle() = default;
    Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
    Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Hdf5Handle& operator=(Hdf5Handle&& other) noexcept
    {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    Hdf5Handle(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(const Hdf5Handle&) = delete;
    ~Hdf5Handle()
    {
        if (id_ >= 0)
            close_(id_);
    }

    [[nodiscard]] hid_t id() const { return id_; }

  private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

/// The library is in use while this lives. A process is forked off only when no other thread uses it: its own lock would stay closed there for ever.
class Hdf5Use
{
  public:
    Hdf5Use();
    ~Hdf5Use();
    Hdf5Use(const Hdf5Use&) = delete;
    Hdf5Use& operator=(const Hdf5Use&) = delete;
};

/// Errors become exceptions here: the library itself prints nothing and loads no filter plugins.
void prepare_hdf5();

/// The library's own words for what failed last, deepest first; never empty.
std::string hdf5_reason();

/// Throws RunError: "FILE: OBJECT: cannot be ACTION (reason). advice"
[[noreturn]] void fail_hdf5(const std::filesystem::path& file, const std::string& object, const char* action,
                            const std::string& reason);

/// Type in memory.
hid_t native_type(ElementType type);
/// Type in the file: little-endian on every machine.
hid_t stored_type(ElementType type);
/// Bytes.
std::size_t element_size(ElementType type);
}  // namespace hdem
