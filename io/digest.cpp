#include "io/digest.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace hdem
{
std::string sha256_hex(std::string_view bytes)
{
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
        throw std::runtime_error("SHA-256 is not available in this build of OpenSSL");

    std::string hex;
    for (unsigned int i = 0; i < size; ++i)
    {
        hex += "0123456789abcdef"[digest[i] >> 4U];
        hex += "0123456789abcdef"[digest[i] & 15U];
    }
    return hex;
}
}  // namespace hdem
