#pragma once
/// Fingerprints of input files, for the provenance of results.

#include <string>
#include <string_view>

namespace hdem
{
/// SHA-256 of the bytes as 64 lower-case hexadecimal digits; the same as the program sha256sum prints.
std::string sha256_hex(std::string_view bytes);
}  // namespace hdem
