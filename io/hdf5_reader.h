#pragma once
/// Reads HDF5 files that somebody else may have made or damaged: every size is checked before memory is asked for.

#include "io/hdf5_types.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hdem
{
/// Throws RunError with file, object and reason whenever something is not as asked for. Follows hard links only, and reads no elements
/// that are stored elsewhere: what is read lies in this file. Checksums are verified. Locks are not taken: hdem's files never change
/// under their name.
class Hdf5Reader
{
  public:
    explicit Hdf5Reader(std::filesystem::path file);
    ~Hdf5Reader();
    Hdf5Reader(Hdf5Reader&&) noexcept;
    Hdf5Reader& operator=(Hdf5Reader&&) = delete;

    /// Throws RunError, for what a caller finds wrong with `object`.
    [[noreturn]] void fail(const std::string& object, const std::string& reason) const;

    /// A group or dataset reached by hard links.
    [[nodiscard]] bool has(const std::string& path) const;
    /// Names in a group, in alphabetical order.
    [[nodiscard]] std::vector<std::string> children(const std::string& group) const;
    [[nodiscard]] Shape shape(const std::string& path) const;

    /// The dataset's elements, slowest extent first. Type, rank and extents must be as given; any_extent matches all.
    template <class T>
    [[nodiscard]] std::vector<T> read(const std::string& path, const Shape& expected) const
    {
        std::vector<T> values(checked_count(path, element_type<T>(), expected));
        read_elements(path, values.data(), element_type<T>());
        return values;
    }
    [[nodiscard]] std::vector<std::string> read_texts(const std::string& path) const;

    template <class T>
    [[nodiscard]] std::vector<T> attribute(const std::string& object, const std::string& name, const Shape& expected) const
    {
        std::vector<T> values(checked_attribute_count(object, name, element_type<T>(), expected));
        read_attribute(object, name, values.data(), element_type<T>());
        return values;
    }
    [[nodiscard]] std::string text(const std::string& object, const std::string& name) const;
    [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;

  private:
    [[nodiscard]] std::uint64_t checked_count(const std::string& path, ElementType type, const Shape& expected) const;
    void read_elements(const std::string& path, void* values, ElementType type) const;
    [[nodiscard]] std::uint64_t checked_attribute_count(const std::string& object, const std::string& name, ElementType type,
                                                        const Shape& expected) const;
    void read_attribute(const std::string& object, const std::string& name, void* values, ElementType type) const;

    struct Handles;
    std::filesystem::path name_;
    std::unique_ptr<Handles> handles_;
};
}  // namespace hdem
