#include "io/hdf5_reader.h"

#include "io/hdf5_handle.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace hdem
{
namespace
{
/// Deflate cannot pack better than about 1 : 1032; what claims more is not honest.
constexpr std::uint64_t greatest_compression = 1100;
constexpr std::uint64_t small_bytes = 1U << 20U;
constexpr std::uint64_t longest_attribute = 1U << 20U;  // [bytes]
constexpr int greatest_rank = 4;

std::string describe(const Shape& shape)
{
    std::vector<std::string> extents;
    for (const std::uint64_t extent : shape)
        extents.push_back(extent == any_extent ? "any" : std::to_string(extent));
    return fmt::format("[{}]", fmt::join(extents, ", "));
}
}  // namespace

struct Hdf5Reader::Handles
{
    Hdf5Use use;
    std::filesystem::path name;
    Hdf5Handle file;

    [[noreturn]] void fail(const std::string& object, const std::string& reason) const { fail_hdf5(name, object, "read", reason); }

    /// True when every link on the way is a hard one.
    [[nodiscard]] bool is_here(const std::string& path) const
    {
        for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1))
        {
            const std::string prefix = path.substr(0, end);
            H5L_info_t info;
            if (prefix != "/" && (H5Lexists(file.id(), prefix.c_str(), H5P_DEFAULT) <= 0 ||
                                  H5Lget_info(file.id(), prefix.c_str(), &info, H5P_DEFAULT) < 0 || info.type != H5L_TYPE_HARD))
                return false;
            if (end == std::string::npos)
                return true;
        }
    }

    [[nodiscard]] Hdf5Handle open(const std::string& path) const
    {
        Hdf5Handle object(is_here(path) ? H5Oopen(file.id(), path.c_str(), H5P_DEFAULT) : -1, H5Oclose);
        if (object.id() < 0)
            fail(path, "not in this file");
        return object;
    }

    [[nodiscard]] Hdf5Handle open_dataset(const std::string& path) const
    {
        Hdf5Handle object = open(path);
        if (H5Iget_type(object.id()) != H5I_DATASET)
            fail(path, "not a dataset");
        return object;
    }

    [[nodiscard]] Hdf5Handle open_attribute(const std::string& object, const std::string& attribute) const
    {
        const Hdf5Handle holder = open(object);
        Hdf5Handle id(H5Aexists(holder.id(), attribute.c_str()) > 0 ? H5Aopen(holder.id(), attribute.c_str(), H5P_DEFAULT) : -1,
                      H5Aclose);
        if (id.id() < 0)
            fail(object + "@" + attribute, "not in this file");
        return id;
    }

    [[nodiscard]] Shape shape_of(const std::string& what, const Hdf5Handle& space) const
    {
        const int rank = H5Sget_simple_extent_ndims(space.id());
        if (rank < 0 || rank > greatest_rank || H5Sget_simple_extent_type(space.id()) == H5S_NULL)
            fail(what, fmt::format("rank {}", rank));
        std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
        H5Sget_simple_extent_dims(space.id(), extents.data(), nullptr);
        return {extents.begin(), extents.end()};
    }

    /// Elements may lie in other files, named by the dataset. The library takes memory for a whole chunk: none may be larger than the data,
    /// which are checked against what is stored.
    void check_storage(const std::string& what, const Hdf5Handle& dataset, const Shape& shape) const
    {
        const Hdf5Handle properties(H5Dget_create_plist(dataset.id()), H5Pclose);
        const H5D_layout_t layout = H5Pget_layout(properties.id());
        if (H5Pget_external_count(properties.id()) != 0 ||
            (layout != H5D_CHUNKED && layout != H5D_CONTIGUOUS && layout != H5D_COMPACT))
            fail(what, "its elements are not in this file");
        if (layout != H5D_CHUNKED)
            return;
        std::vector<hsize_t> chunk(shape.size() + 1);
        const int rank = H5Pget_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data());
        if (rank != static_cast<int>(shape.size()) ||
            !std::equal(shape.begin(), shape.end(), chunk.begin(), std::greater_equal<>()))
            fail(what, "a chunk that is larger than the data: the file is damaged");
    }

    /// What the file holds for a dataset, whatever the dataset says [bytes].
    [[nodiscard]] std::uint64_t stored_bytes(const Hdf5Handle& dataset) const
    {
        std::error_code error;
        const std::uintmax_t size = std::filesystem::file_size(name, error);
        return error ? 0 : std::min<std::uint64_t>(H5Dget_storage_size(dataset.id()), size);
    }

    /// Product of the extents; fails when it is out of proportion to what is stored.
    [[nodiscard]] std::uint64_t count(const std::string& what, const Shape& shape, std::uint64_t size, std::uint64_t stored) const
    {
        const std::uint64_t limit = std::max(small_bytes, stored * greatest_compression) / size;
        std::uint64_t product = 1;
        for (const std::uint64_t extent : shape)
        {
            if (extent != 0 && product > limit / extent)
                fail(what, fmt::format("shape {} is too large for {} stored bytes: the file is damaged", describe(shape), stored));
            product *= extent;
        }
        return product;
    }

    void check(const std::string& what, const Shape& shape, const Shape& expected) const
    {
        const auto matches = [](std::uint64_t have, std::uint64_t want) { return want == any_extent || have == want; };
        if (!std::equal(shape.begin(), shape.end(), expected.begin(), expected.end(), matches))
            fail(what, fmt::format("shape {}, expected {}", describe(shape), describe(expected)));
    }

    void check(const std::string& what, const Hdf5Handle& type, ElementType expected) const
    {
        const hid_t wanted = stored_type(expected);
        if (H5Tget_class(type.id()) != H5Tget_class(wanted) || H5Tget_size(type.id()) != H5Tget_size(wanted) ||
            (H5Tget_class(wanted) == H5T_INTEGER && H5Tget_sign(type.id()) != H5Tget_sign(wanted)))
            fail(what, "another type of element than expected");
    }

    /// Bytes of one fixed-length text.
    [[nodiscard]] std::size_t check_text(const std::string& what, const Hdf5Handle& type) const
    {
        if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) > 0)
            fail(what, "not a text of fixed length");
        return H5Tget_size(type.id());
    }
};

Hdf5Reader::Hdf5Reader(std::filesystem::path file) : name_(std::move(file)), handles_(std::make_unique<Handles>())
{
    prepare_hdf5();
    handles_->name = name_;
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access.id(), false, true);
    std::error_code error;
    if (!std::filesystem::is_regular_file(name_, error))
        fail_hdf5(name_, "/", "read", error ? error.message() : "not a file");
    handles_->file = {H5Fopen(name_.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose};
    if (handles_->file.id() < 0)
        fail_hdf5(name_, "/", "read", hdf5_reason());
}

Hdf5Reader::~Hdf5Reader() = default;
Hdf5Reader::Hdf5Reader(Hdf5Reader&&) noexcept = default;

void Hdf5Reader::fail(const std::string& object, const std::string& reason) const
{
    handles_->fail(object, reason);
}

bool Hdf5Reader::has(const std::string& path) const
{
    return handles_->is_here(path);
}

std::vector<std::string> Hdf5Reader::children(const std::string& group) const
{
    const Hdf5Handle object = handles_->open(group);
    H5G_info_t info;
    if (H5Iget_type(object.id()) != H5I_GROUP || H5Gget_info(object.id(), &info) < 0)
        handles_->fail(group, "not a group");
    std::vector<std::string> names;
    for (hsize_t i = 0; i < info.nlinks; ++i)
    {
        const ssize_t size = H5Lget_name_by_idx(object.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
        if (size < 0)
            handles_->fail(group, hdf5_reason());
        std::string child(static_cast<std::size_t>(size), '\0');
        H5Lget_name_by_idx(object.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, child.data(), child.size() + 1, H5P_DEFAULT);
        names.push_back(std::move(child));
    }
    return names;
}

Shape Hdf5Reader::shape(const std::string& path) const
{
    const Hdf5Handle dataset = handles_->open_dataset(path);
    return handles_->shape_of(path, {H5Dget_space(dataset.id()), H5Sclose});
}

std::uint64_t Hdf5Reader::checked_count(const std::string& path, ElementType type, const Shape& expected) const
{
    const Hdf5Handle dataset = handles_->open_dataset(path);
    const Shape extents = handles_->shape_of(path, {H5Dget_space(dataset.id()), H5Sclose});
    handles_->check(path, {H5Dget_type(dataset.id()), H5Tclose}, type);
    handles_->check(path, extents, expected);
    handles_->check_storage(path, dataset, extents);
    return handles_->count(path, extents, element_size(type), handles_->stored_bytes(dataset));
}

void Hdf5Reader::read_elements(const std::string& path, void* values, ElementType type) const
{
    const Hdf5Handle dataset = handles_->open_dataset(path);
    if (H5Dread(dataset.id(), native_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        handles_->fail(path, hdf5_reason());
}

std::vector<std::string> Hdf5Reader::read_texts(const std::string& path) const
{
    const Hdf5Handle dataset = handles_->open_dataset(path);
    const Hdf5Handle type(H5Dget_type(dataset.id()), H5Tclose);
    const std::size_t size = handles_->check_text(path, type);
    const Shape extents = handles_->shape_of(path, {H5Dget_space(dataset.id()), H5Sclose});
    handles_->check(path, extents, {any_extent});
    handles_->check_storage(path, dataset, extents);
    const std::uint64_t n = handles_->count(path, extents, size, handles_->stored_bytes(dataset));
    std::vector<char> bytes(n * size);
    if (n > 0 && H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
        handles_->fail(path, hdf5_reason());
    std::vector<std::string> texts;
    for (std::uint64_t i = 0; i < n; ++i)
    {
        const char* const begin = bytes.data() + i * size;
        texts.emplace_back(begin, std::find(begin, begin + size, '\0'));
    }
    return texts;
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const
{
    return handles_->is_here(object) && H5Aexists_by_name(handles_->file.id(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::uint64_t Hdf5Reader::checked_attribute_count(const std::string& object, const std::string& name, ElementType type,
                                                  const Shape& expected) const
{
    const std::string what = object + "@" + name;
    const Hdf5Handle id = handles_->open_attribute(object, name);
    const Shape extents = handles_->shape_of(what, {H5Aget_space(id.id()), H5Sclose});
    handles_->check(what, {H5Aget_type(id.id()), H5Tclose}, type);
    handles_->check(what, extents, expected);
    return handles_->count(what, extents, element_size(type), 0);
}

void Hdf5Reader::read_attribute(const std::string& object, const std::string& name, void* values, ElementType type) const
{
    const Hdf5Handle id = handles_->open_attribute(object, name);
    if (H5Aread(id.id(), native_type(type), values) < 0)
        handles_->fail(object + "@" + name, hdf5_reason());
}

std::string Hdf5Reader::text(const std::string& object, const std::string& name) const
{
    const std::string what = object + "@" + name;
    const Hdf5Handle id = handles_->open_attribute(object, name);
    const Hdf5Handle type(H5Aget_type(id.id()), H5Tclose);
    const std::size_t size = handles_->check_text(what, type);
    if (!handles_->shape_of(what, {H5Aget_space(id.id()), H5Sclose}).empty() || size > longest_attribute)
        handles_->fail(what, "not one short text");
    std::string value(size, '\0');
    if (H5Aread(id.id(), type.id(), value.data()) < 0)
        handles_->fail(what, hdf5_reason());
    value.resize(std::min(value.find('\0'), size));
    return value;
}
}  // namespace hdem
