#include "io/hdf5_writer.h"

#include "core/check.h"
#include "io/atomic_file.h"
#include "io/hdf5_handle.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace hdem
{
namespace
{
constexpr std::size_t memory_step = 256U << 10U;      // [bytes] by which the file in memory grows
constexpr std::uint64_t chunk_bytes = 1U << 20U;      // fits the library's chunk cache
constexpr std::uint64_t least_deflated = 1U << 17U;   // bytes; the packer takes longer to begin than a smaller dataset is worth
constexpr std::uint64_t largest_compact = 1U << 15U;  // bytes; a dataset in its header has no index of chunks, which would be
                                                      // half of a small frame. HDF5 takes up to 64 kB of header
constexpr unsigned deflate_level = 1;                 // higher levels cost much time for little

/// The bytes of a file that exists in memory only; they are left here when HDF5 closes it.
///
/// H5Fget_file_image would be simpler, but it clears a flag in the superblock's newer versions without renewing its checksum
/// (seen in HDF5 1.10.8): such an image cannot be opened.
struct MemoryFile
{
    std::unique_ptr<void, decltype(&std::free)> bytes{nullptr, &std::free};
    std::size_t size = 0;
};

void* image_malloc(std::size_t size, H5FD_file_image_op_t, void*)
{
    return std::malloc(size);
}

void* image_copy(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*)
{
    return std::memcpy(to, from, size);
}

/// The library leaves gaps between what it writes: they are zero, and the same content gives the same bytes.
void* image_realloc(void* bytes, std::size_t size, H5FD_file_image_op_t, void* memory)
{
    std::size_t& had = static_cast<MemoryFile*>(memory)->size;
    void* const grown = std::realloc(bytes, size);
    if (grown != nullptr && size > had)
        std::memset(static_cast<char*>(grown) + had, 0, size - had);
    had = grown != nullptr ? size : had;
    return grown;
}

herr_t image_free(void* bytes, H5FD_file_image_op_t operation, void* memory)
{
    if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE)
        static_cast<MemoryFile*>(memory)->bytes.reset(bytes);
    else
        std::free(bytes);
    return 0;
}

void* same_memory(void* memory)
{
    return memory;
}

herr_t keep_memory(void*)
{
    return 0;
}

/// The same content gives the same bytes: the library would keep the second in which each object was made.
void keep_no_times(const Hdf5Handle& creation)
{
    H5Pset_obj_track_times(creation.id(), false);
}

Hdf5Handle open_in_memory(const std::string& name, MemoryFile& memory)
{
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5FD_file_image_callbacks_t callbacks{image_malloc, image_copy, image_realloc, image_free, same_memory, keep_memory, &memory};
    H5Pset_fapl_core(access.id(), memory_step, false);
    H5Pset_file_image_callbacks(access.id(), &callbacks);
    H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18,
                         H5F_LIBVER_LATEST);  // checksums of metadata, compact links; readable since HDF5 1.8
    const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    keep_no_times(creation);  // of the root group
    return {H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose};
}

/// Links and attributes stay in the group's header: the library would begin trees and heaps for more than eight.
void keep_in_header(const Hdf5Handle& creation)
{
    H5Pset_link_phase_change(creation.id(), 64, 48);
    H5Pset_attr_phase_change(creation.id(), 64, 48);
}

Hdf5Handle group_properties()
{
    Hdf5Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    keep_in_header(properties);
    keep_no_times(properties);
    H5Pset_est_link_info(properties.id(), 16, 16);
    return properties;
}

Hdf5Handle space_of(const Shape& shape)
{
    const std::vector<hsize_t> extents(shape.begin(), shape.end());
    return {shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), extents.data(), nullptr),
            H5Sclose};
}

/// In the header, whose checksum then covers the data too; chunks of whole rows where it is larger. None for a dataset without
/// elements, which cannot have any.
Hdf5Handle storage_of(const Shape& shape, std::uint64_t count, std::size_t size, Hdf5Writer::Packing packing)
{
    Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    keep_no_times(properties);
    if (shape.empty() || count == 0)
        return properties;
    if (count * size <= largest_compact)
    {
        H5Pset_layout(properties.id(), H5D_COMPACT);
        return properties;
    }
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    const std::uint64_t row_bytes = count / shape[0] * size;
    chunk[0] = std::clamp<std::uint64_t>(chunk_bytes / row_bytes, 1, shape[0]);
    H5Pset_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data());
    if (packing == Hdf5Writer::Packing::deflated && count * size >= least_deflated)
    {
        H5Pset_shuffle(properties.id());
        H5Pset_deflate(properties.id(), deflate_level);
    }
    H5Pset_fletcher32(properties.id());
    return properties;
}

Hdf5Handle text_type(std::size_t size, Hdf5Writer::TextCode code)
{
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.id(), std::max<std::size_t>(size, 1));
    H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
    H5Tset_cset(type.id(), code == Hdf5Writer::TextCode::utf8 ? H5T_CSET_UTF8 : H5T_CSET_ASCII);
    return type;
}

/// HDF5 measures a chunk in 32 bits.
constexpr std::size_t longest_text = 1U << 30U;
}  // namespace

struct Hdf5Writer::Handles
{
    Hdf5Use use;
    MemoryFile memory;  // outlives the file, which closes into it
    Hdf5Handle file;

    void make_group(const std::filesystem::path& name, const std::string& path) const
    {
        const Hdf5Handle group(H5Gcreate2(file.id(), path.c_str(), H5P_DEFAULT, group_properties().id(), H5P_DEFAULT), H5Gclose);
        if (group.id() < 0)
            fail_hdf5(name, path, "made", hdf5_reason());
    }

    /// Those that `path` lies in and that are not there yet. By hand: the library makes them with the time in them.
    void make_groups_around(const std::filesystem::path& name, const std::string& path) const
    {
        for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1))
            if (const std::string group = path.substr(0, end); H5Lexists(file.id(), group.c_str(), H5P_DEFAULT) <= 0)
                make_group(name, group);
    }

    void write(const std::filesystem::path& name, const std::string& path, const void* values, std::uint64_t count,
               std::size_t size, hid_t in_memory, hid_t in_file, const Shape& shape, Packing packing) const
    {
        make_groups_around(name, path);
        const Hdf5Handle space = space_of(shape);
        const Hdf5Handle storage = storage_of(shape, count, size, packing);
        const Hdf5Handle dataset(H5Dcreate2(file.id(), path.c_str(), in_file, space.id(), H5P_DEFAULT, storage.id(), H5P_DEFAULT),
                                 H5Dclose);
        if (dataset.id() < 0 || (count > 0 && H5Dwrite(dataset.id(), in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0))
            fail_hdf5(name, path, "written", hdf5_reason());
    }

    void set(const std::filesystem::path& name, const std::string& object, const std::string& attribute, const void* values,
             hid_t in_memory, hid_t in_file, const Shape& shape) const
    {
        const Hdf5Handle space = space_of(shape);
        const Hdf5Handle id(H5Acreate_by_name(file.id(), object.c_str(), attribute.c_str(), in_file, space.id(), H5P_DEFAULT,
                                              H5P_DEFAULT, H5P_DEFAULT),
                            H5Aclose);
        if (id.id() < 0 || H5Awrite(id.id(), in_memory, values) < 0)
            fail_hdf5(name, object + "@" + attribute, "written", hdf5_reason());
    }
};

Hdf5Writer::Hdf5Writer(std::filesystem::path file) : name_(std::move(file)), handles_(std::make_unique<Handles>())
{
    prepare_hdf5();
    handles_->file = open_in_memory(name_.string(), handles_->memory);
    if (handles_->file.id() < 0)
        fail_hdf5(name_, "/", "made", hdf5_reason());
}

Hdf5Writer::~Hdf5Writer() = default;
Hdf5Writer::Hdf5Writer(Hdf5Writer&&) noexcept = default;

void Hdf5Writer::make_group(const std::string& path)
{
    handles_->make_groups_around(name_, path);
    handles_->make_group(name_, path);
}

void Hdf5Writer::write_elements(const std::string& path, const void* values, std::uint64_t count, ElementType type,
                                const Shape& shape, Packing packing)
{
    std::uint64_t product = 1;
    for (const std::uint64_t extent : shape)
        product *= extent;
    if (product != count)
        fail_hdf5(name_, path, "written", std::to_string(count) + " elements do not fill its shape of " + std::to_string(product));
    handles_->write(name_, path, values, count, element_size(type), native_type(type), stored_type(type), shape, packing);
}

void Hdf5Writer::write_texts(const std::string& path, const std::vector<std::string>& texts)
{
    std::size_t size = 1;
    for (const std::string& text : texts)
        size = std::max(size, text.size());
    if (size > longest_text)
        fail_hdf5(name_, path, "written", "text of " + std::to_string(size) + " bytes");
    std::vector<char> bytes(size * texts.size(), '\0');
    for (std::size_t i = 0; i < texts.size(); ++i)
        std::copy(texts[i].begin(), texts[i].end(), bytes.begin() + static_cast<std::ptrdiff_t>(i * size));
    const Hdf5Handle type = text_type(size, TextCode::utf8);
    handles_->write(name_, path, bytes.data(), texts.size(), size, type.id(), type.id(), {texts.size()}, Packing::deflated);
}

void Hdf5Writer::set_elements(const std::string& object, const std::string& name, const void* values, ElementType type,
                              const Shape& shape)
{
    handles_->set(name_, object, name, values, native_type(type), stored_type(type), shape);
}

void Hdf5Writer::set_text(const std::string& object, const std::string& name, std::string_view text, TextCode code)
{
    const std::string value(text.empty() ? std::string_view("\0", 1) : text);
    const Hdf5Handle type = text_type(value.size(), code);
    handles_->set(name_, object, name, value.data(), type.id(), type.id(), {});
}

void Hdf5Writer::link(const std::string& path, const std::string& file, const std::string& object)
{
    handles_->make_groups_around(name_, path);
    if (H5Lcreate_external(file.c_str(), object.c_str(), handles_->file.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
        fail_hdf5(name_, path, "made", hdf5_reason());
}

void Hdf5Writer::commit(const std::filesystem::path& previous, Flush flush)
{
    if (H5Fflush(handles_->file.id(), H5F_SCOPE_GLOBAL) < 0)
        fail_hdf5(name_, "/", "finished", hdf5_reason());
    const ssize_t size = H5Fget_file_image(handles_->file.id(), nullptr, 0);  // what is used of the memory
    if (size <= 0)
        fail_hdf5(name_, "/", "finished", hdf5_reason());
    handles_->file = {};
    if (handles_->memory.bytes == nullptr)
        fail_hdf5(name_, "/", "finished", hdf5_reason());
    write_atomically(name_, std::span(static_cast<const std::byte*>(handles_->memory.bytes.get()), static_cast<std::size_t>(size)),
                     previous, flush);
    handles_->memory.bytes.reset();
}
}  // namespace hdem
