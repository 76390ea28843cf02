#pragma once
/// Changes HDF5 files as damage or malice would, for tests of what reads them. HDEM_FUZZ_FILES=100000 makes these as long as one likes.

#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace hdem::test
{
inline int files_to_try(int by_default)
{
    const char* const wanted = std::getenv("HDEM_FUZZ_FILES");
    return wanted != nullptr ? std::atoi(wanted) : by_default;
}

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

class Hdf5Mutator
{
  public:
    /// What change_object() may take hold of.
    struct Targets
    {
        std::vector<std::string> datasets;
        std::vector<std::string> attributes;  ///< "/group@name"
    };

    explicit Hdf5Mutator(std::uint64_t seed) : random_(seed) {}

    std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

    /// Bytes flipped, overwritten by numbers that hurt, or cut off.
    std::string changed_bytes(std::string bytes)
    {
        static const std::string tokens[] = {std::string(8, '\xff'), std::string(8, '\0'), std::string("\xff\xff\xff\x7f", 4),
                                             std::string("\0\0\0\0\0\0\xf8\x7f", 8), std::string(1, '\x80')};
        if (below(10) == 0)
            bytes.resize(below(bytes.size()));
        for (std::size_t edits = 1 + below(4); edits > 0 && !bytes.empty(); --edits)
        {
            const std::size_t at = below(bytes.size());
            const std::string& token = tokens[below(std::size(tokens))];
            if (below(2) == 0)
                bytes[at] = static_cast<char>(random_());
            else
                bytes.replace(at, std::min(token.size(), bytes.size() - at), token, 0, std::min(token.size(), bytes.size() - at));
        }
        return bytes;
    }

    /// One object changed through the library, so that every checksum is right.
    void change_object(const std::filesystem::path& file, const Targets& targets)
    {
        const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        const std::string& path = targets.datasets[below(targets.datasets.size())];
        const std::string& attribute = targets.attributes[below(targets.attributes.size())];
        switch (below(8))
        {
        case 0:
            H5Ldelete(id, path.c_str(), H5P_DEFAULT);
            break;
        case 1:
            H5Ldelete(id, path.c_str(), H5P_DEFAULT);
            H5Lcreate_external("/etc/passwd", "/", id, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
            break;
        case 2:
            replace_by_another_shape(id, path);
            break;
        case 3:
            change_attribute(id, attribute);
            break;
        case 4:
            replace_attribute(id, attribute);
            break;
        case 5:
            store_elsewhere(id, path, "/etc/passwd");
            break;
        default:
            change_element(id, path);
        }
        H5Fclose(id);
    }

    /// The old type and shape, with elements that are bytes of another file.
    static void store_elsewhere(hid_t file, const std::string& path, const std::filesystem::path& other)
    {
        const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_external(properties, other.c_str(), 0, H5F_UNLIMITED);
        const hid_t old = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
        const hid_t space = H5Dget_space(old);
        replace(file, path, space, properties);
        H5Sclose(space);
        H5Dclose(old);
    }

  private:
    /// A dataset of the old type.
    static void replace(hid_t file, const std::string& path, hid_t space, hid_t properties)
    {
        const hid_t old = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
        const hid_t type = H5Dget_type(old);
        H5Dclose(old);
        H5Ldelete(file, path.c_str(), H5P_DEFAULT);
        H5Dclose(H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
        H5Tclose(type);
        H5Pclose(properties);
    }

    double number()
    {
        static const double numbers[] = {0.0,           1.0,          -1.0, 2.0,   3.0, 255.0,   1e9,
                                         -2147483648.0, 2147483647.0, 9e18, 1e308, NAN, INFINITY};
        return numbers[below(std::size(numbers))];
    }

    void change_element(hid_t file, const std::string& path)
    {
        const hid_t dataset = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
        const hid_t type = H5Dget_type(dataset);
        const hid_t space = H5Dget_space(dataset);
        std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
        if (!values.empty() && H5Tget_class(type) != H5T_STRING)  // texts: case files have a test of their own
        {
            H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
            values[below(values.size())] = number();
            H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        }
        H5Sclose(space);
        H5Tclose(type);
        H5Dclose(dataset);
    }

    void change_attribute(hid_t file, const std::string& name)
    {
        const std::vector<double> values(8, number());
        const std::size_t at = name.find('@');
        const hid_t attribute = H5Aopen_by_name(file, name.substr(0, at).c_str(), name.substr(at + 1).c_str(), H5P_DEFAULT,
                                                H5P_DEFAULT);
        H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data());  // fails for a text
        H5Aclose(attribute);
    }

    /// None of that name, or one of another type and shape.
    void replace_attribute(hid_t file, const std::string& name)
    {
        const std::size_t at = name.find('@');
        const std::string object = name.substr(0, at);
        H5Adelete_by_name(file, object.c_str(), name.c_str() + at + 1, H5P_DEFAULT);
        if (below(3) == 0)
            return;
        const hsize_t extents[] = {1 + below(3), 1 + below(50)};
        const hid_t space = H5Screate_simple(static_cast<int>(below(3)), extents, nullptr);
        const hid_t types[] = {H5T_NATIVE_DOUBLE, H5T_NATIVE_INT8, H5T_C_S1, H5T_NATIVE_INT64};
        H5Aclose(H5Acreate_by_name(file, object.c_str(), name.c_str() + at + 1, types[below(std::size(types))], space, H5P_DEFAULT,
                                   H5P_DEFAULT, H5P_DEFAULT));
        H5Sclose(space);
    }

    /// The old type with other extents, nothing stored: a small file that claims much.
    void replace_by_another_shape(hid_t file, const std::string& path)
    {
        const hsize_t extents[] = {1ULL << below(40), 1ULL << below(20), 1};
        const hsize_t chunk[] = {std::min<hsize_t>(extents[0], 1U << 16U), std::min<hsize_t>(extents[1], 1U << 10U), 1};
        const int rank = static_cast<int>(below(4));
        const hid_t space = H5Screate_simple(rank, extents, nullptr);
        const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
        if (rank > 0)
            H5Pset_chunk(properties, rank, chunk);
        replace(file, path, space, properties);
        H5Sclose(space);
    }

    std::mt19937_64 random_;
};
}  // namespace hdem::test
