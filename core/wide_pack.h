#pragma once
/// Eight doubles handled together on processors with AVX-512: each lane computes what it does in a Pack of four, so the bits are the same.
/// Only for files named *_wide.cpp, which alone are compiled for these processors and are asked only where has_wide_packs().

#include "core/simd.h"

#include <immintrin.h>

#include <bit>

namespace hdem
{
inline constexpr int wide_lanes = 2 * lanes;

struct WideMask
{
    __mmask8 v = 0;

    [[nodiscard]] bool has(int lane) const { return ((v >> lane) & 1) != 0; }
    void set(int lane) { v = static_cast<__mmask8>(v | (1 << lane)); }
    void clear(int lane) { v = static_cast<__mmask8>(v & ~(1 << lane)); }
};

struct WidePack
{
    static constexpr int width = wide_lanes;
    using V = double __attribute__((vector_size(64)));
    V v;

    WidePack() = default;
    explicit WidePack(V value) : v(value) {}
    WidePack(double value) : v{value, value, value, value, value, value, value, value} {}
    [[nodiscard]] static WidePack load(const double* from) { return WidePack(_mm512_loadu_pd(from)); }
};

inline WidePack operator+(WidePack a, WidePack b)
{
    return WidePack(a.v + b.v);
}
inline WidePack operator-(WidePack a, WidePack b)
{
    return WidePack(a.v - b.v);
}
inline WidePack operator*(WidePack a, WidePack b)
{
    return WidePack(a.v * b.v);
}
inline WidePack operator/(WidePack a, WidePack b)
{
    return WidePack(a.v / b.v);
}
inline WidePack operator-(WidePack a)
{
    return WidePack(-a.v);
}
inline WidePack& operator+=(WidePack& a, WidePack b)
{
    return a = a + b;
}
inline WidePack& operator-=(WidePack& a, WidePack b)
{
    return a = a - b;
}
inline WideMask operator<(WidePack a, WidePack b)
{
    return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)};
}
inline WideMask operator>(WidePack a, WidePack b)
{
    return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ)};
}
inline WideMask operator<=(WidePack a, WidePack b)
{
    return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ)};
}
inline WideMask operator==(WidePack a, WidePack b)
{
    return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_EQ_OQ)};
}
inline WideMask operator&(WideMask a, WideMask b)
{
    return {static_cast<__mmask8>(a.v & b.v)};
}
inline WideMask operator|(WideMask a, WideMask b)
{
    return {static_cast<__mmask8>(a.v | b.v)};
}
inline WideMask operator!(WideMask a)
{
    return {static_cast<__mmask8>(~a.v)};
}
inline WidePack select(WideMask m, WidePack yes, WidePack no)
{
    return WidePack(_mm512_mask_blend_pd(m.v, no.v, yes.v));
}
inline WidePack max(WidePack a, WidePack b)
{
    return WidePack(_mm512_max_pd(a.v, b.v));  // b where they are equal, as the Pack of four has it
}
inline WidePack min(WidePack a, WidePack b)
{
    return WidePack(_mm512_min_pd(a.v, b.v));
}
inline WidePack abs(WidePack a)
{
    return max(a, -a);
}
inline WidePack sqrt(WidePack a)
{
    return WidePack(_mm512_sqrt_pd(a.v));
}
inline bool any(WideMask m)
{
    return m.v != 0;
}

using WideBits = std::uint64_t __attribute__((vector_size(64)));

inline WideBits bits_of(WidePack x)
{
    return std::bit_cast<WideBits>(x.v);
}

/// How many lanes of masks were set.
class WideCount
{
  public:
    void add(WideMask m) { count_ += __builtin_popcount(m.v); }
    [[nodiscard]] std::int64_t total() const { return count_; }

  private:
    std::int64_t count_ = 0;
};
[[nodiscard]] inline WideCount count_of(WideMask)
{
    return {};
}

[[nodiscard]] inline Pack low_half(WidePack a)
{
    return Pack(Pack::V(_mm512_castpd512_pd256(a.v)));
}
[[nodiscard]] inline Pack high_half(WidePack a)
{
    return Pack(Pack::V(_mm512_extractf64x4_pd(a.v, 1)));
}

/// Lane by lane as two Packs that follow each other.
template <typename... Packs>
inline void add_pack(Pack& sum, WidePack first, Packs... others)
{
    add_pack(sum, low_half(first), low_half(others)...);
    add_pack(sum, high_half(first), high_half(others)...);
}
inline void max_pack(Pack& most, WidePack a)
{
    max_pack(most, low_half(a));
    max_pack(most, high_half(a));
}

/// Columns of eight rows of four doubles.
/// @param row  from 0 to 7: where it begins
template <typename Row>
[[gnu::always_inline]] inline void load_columns(const Row& row, WidePack& a, WidePack& b, WidePack& c, WidePack& d)
{
    const auto two = [&](int i, int j)
    { return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(row(i))), _mm256_loadu_pd(row(j)), 1); };
    const __m512d r02 = two(0, 2), r13 = two(1, 3), r46 = two(4, 6), r57 = two(5, 7);
    const __m512d low_03 = _mm512_unpacklo_pd(r02, r13), high_03 = _mm512_unpackhi_pd(r02, r13);
    const __m512d low_47 = _mm512_unpacklo_pd(r46, r57), high_47 = _mm512_unpackhi_pd(r46, r57);
    a.v = _mm512_shuffle_f64x2(low_03, low_47, 0x88);
    b.v = _mm512_shuffle_f64x2(high_03, high_47, 0x88);
    c.v = _mm512_shuffle_f64x2(low_03, low_47, 0xdd);
    d.v = _mm512_shuffle_f64x2(high_03, high_47, 0xdd);
}

/// The way back.
template <typename Row>
[[gnu::always_inline]] inline void store_columns(WidePack a, WidePack b, WidePack c, WidePack d, const Row& row)
{
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11), second = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    const auto put = [&](__m512d ab, __m512d cd, const __m512i& which, int i)
    {
        const __m512d two = _mm512_permutex2var_pd(ab, which, cd);
        _mm256_storeu_pd(row(i), _mm512_castpd512_pd256(two));
        _mm256_storeu_pd(row(i + 2), _mm512_extractf64x4_pd(two, 1));
    };
    const __m512d ab_even = _mm512_unpacklo_pd(a.v, b.v), cd_even = _mm512_unpacklo_pd(c.v, d.v);
    const __m512d ab_odd = _mm512_unpackhi_pd(a.v, b.v), cd_odd = _mm512_unpackhi_pd(c.v, d.v);
    put(ab_even, cd_even, first, 0);
    put(ab_odd, cd_odd, first, 1);
    put(ab_even, cd_even, second, 4);
    put(ab_odd, cd_odd, second, 5);
}
}  // namespace hdem
