#pragma once
/// Random numbers of the rest.* scenes: scene N of a family is the same for ever and on every machine.

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>

namespace hdem::verification::rest
{
/// The standard fixes what std::mt19937_64 gives, but not what its distributions make of it: those are written out here.
class Draw
{
  public:
    Draw(std::string_view family, int scene) : bits_(seed(family, static_cast<std::uint64_t>(scene))) {}

    /// Uniform between two bounds.
    [[nodiscard]] double between(double low, double high)
    {
        return low + (high - low) * static_cast<double>(bits_() >> 11U) * 0x1p-53;
    }
    /// The logarithm is uniform: as often between 0.1 and 1 as between 1 and 10.
    [[nodiscard]] double scale(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }
    [[nodiscard]] bool chance(double share) { return between(0.0, 1.0) < share; }
    /// Whole number from `low` to `high`, both included.
    [[nodiscard]] int count(int low, int high) { return low + static_cast<int>(between(0.0, static_cast<double>(high - low + 1))); }
    template <typename T, std::size_t n>
    [[nodiscard]] T one_of(const std::array<T, n>& choices)
    {
        return choices[static_cast<std::size_t>(count(0, static_cast<int>(n) - 1))];
    }

  private:
    /// FNV-1a of the name and the number.
    [[nodiscard]] static std::uint64_t seed(std::string_view family, std::uint64_t scene)
    {
        std::uint64_t hash = 0xcbf29ce484222325U;
        const auto add = [&](std::uint64_t byte) { hash = (hash ^ byte) * 0x100000001b3U; };
        for (const char c : family)
            add(static_cast<unsigned char>(c));
        for (int shift = 0; shift < 64; shift += 8)
            add((scene >> static_cast<unsigned>(shift)) & 0xffU);
        return hash;
    }
    std::mt19937_64 bits_;
};
}  // namespace hdem::verification::rest
