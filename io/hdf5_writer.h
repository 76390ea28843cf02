#pragma once
/// Writes one HDF5 file, which appears under its name complete or not at all.

#include "io/atomic_file.h"
#include "io/hdf5_types.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hdem
{
/// The file grows in memory and goes to disk in commit(): HDF5 itself never sees the disk, so that a full one is an ordinary
/// error with the system's reason (HDF5 cannot close a file that does not fit), and locks of network file systems do not matter.
///
/// Groups on the way to an object are made as needed. Datasets with elements are in chunks with Fletcher-32 checksums: a flipped
/// bit is an error for the reader, not another number. From 128 kB on texts and whole numbers are shuffled and deflated at level 1
/// unless said otherwise.
/// @see verification/unit/io/hdf5_file_test.cpp
class Hdf5Writer
{
  public:
    explicit Hdf5Writer(std::filesystem::path file);
    ~Hdf5Writer();  ///< without commit() nothing is written
    Hdf5Writer(Hdf5Writer&&) noexcept;
    Hdf5Writer& operator=(Hdf5Writer&&) = delete;

    void make_group(const std::string& path);

    enum class Packing
    {
        deflated,
        plain
    };
    /// Computed reals are nearly random in most of their bits: deflating them makes a frame a third smaller and takes two thirds of its time.
    template <class T>
    static constexpr Packing usual_packing = std::is_floating_point_v<T> ? Packing::plain : Packing::deflated;

    /// @pre values.size() is the product of the shape
    template <class T>
    void write(const std::string& path, const std::vector<T>& values, const Shape& shape, Packing packing = usual_packing<T>)
    {
        write_elements(path, values.data(), values.size(), element_type<T>(), shape, packing);
    }
    template <class T>
    void write(const std::string& path, const std::vector<T>& values)
    {
        write(path, values, {values.size()});
    }
    /// One-dimensional, fixed length, UTF-8.
    void write_texts(const std::string& path, const std::vector<std::string>& texts);

    template <class T>
    void set_attribute(const std::string& object, const std::string& name, T value)
    {
        set_elements(object, name, &value, element_type<T>(), {});
    }
    template <class T>
    void set_attribute(const std::string& object, const std::string& name, const std::vector<T>& values)
    {
        set_elements(object, name, values.data(), element_type<T>(), {values.size()});
    }
    enum class TextCode
    {
        utf8,
        ascii
    };
    void set_text(const std::string& object, const std::string& name, std::string_view text, TextCode code = TextCode::utf8);

    /// `path` stands for `object` of another file; a relative file name starts at this file's folder.
    void link(const std::string& path, const std::string& file, const std::string& object);

    /// @param previous name that an older file is kept under; "": it is replaced
    void commit(const std::filesystem::path& previous = {}, Flush flush = Flush::now);

  private:
    void write_elements(const std::string& path, const void* values, std::uint64_t count, ElementType type, const Shape& shape,
                        Packing packing);
    void set_elements(const std::string& object, const std::string& name, const void* values, ElementType type, const Shape& shape);

    struct Handles;
    std::filesystem::path name_;
    std::unique_ptr<Handles> handles_;
};
}  // namespace hdem
