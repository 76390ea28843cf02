#pragma once
/// Four doubles handled together. The laws are templates on a number type: `double` for one contact point, `Pack` for four.
///
/// Compiled to one AVX or two SSE2 registers (compiler vector extensions); the width is always four, and no operation is fused or reordered, so every
/// build gives the same bits. The compiler's own vectorisation of a loop over doubles fails at the gathers of block motions (perf/measured.md).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <immintrin.h>
#endif

/// Some files are compiled for several kinds of processors (core/kernels.h). Each kind has its own name for packs. So the linker keeps their functions apart, and no
/// function for a newer processor is called on an older one.
#if defined(__AVX512F__)
#define HDEM_LANES lanes_avx512
#elif defined(__AVX2__)
#define HDEM_LANES lanes_avx2
#else
#define HDEM_LANES lanes_base
#endif

namespace hdem
{
inline constexpr int lanes = 4;

/// A number for each lane, in a form that files compiled for different processors share.
struct alignas(32) LaneSums
{
    double v[lanes] = {};
};

/// In the order of the lanes.
inline double sum(const LaneSums& a)
{
    return ((a.v[0] + a.v[1]) + a.v[2]) + a.v[3];
}

inline namespace HDEM_LANES
{
/// (Aligned in all files alike: a compiler without AVX gives vectors of 32 bytes 16 only, and contact_forces_wide.cpp is compiled with it.)
struct alignas(32) Mask
{
    using V = std::int64_t __attribute__((vector_size(32)));
    V v;  ///< per lane: 0 or -1

    [[nodiscard]] bool has(int lane) const { return v[lane] != 0; }
    void set(int lane) { v[lane] = -1; }
    void clear(int lane) { v[lane] = 0; }
};

struct alignas(32) Pack
{
    static constexpr int width = lanes;
    using V = double __attribute__((vector_size(32)));
    V v;

    Pack() = default;
    explicit Pack(V value) : v(value) {}
    Pack(double value) : v{value, value, value, value} {}
    explicit Pack(const LaneSums& sums) { std::memcpy(&v, sums.v, sizeof v); }

    [[nodiscard]] LaneSums lane_sums() const
    {
        LaneSums sums;
        store(sums.v);
        return sums;
    }
    [[nodiscard]] static Pack load(const double* from)
    {
        Pack p;
        std::memcpy(&p.v, from, sizeof p.v);
        return p;
    }
    void store(double* to) const { std::memcpy(to, &v, sizeof v); }
};

using FloatLanes = float __attribute__((vector_size(16)));

inline Pack operator+(Pack a, Pack b)
{
    return Pack(a.v + b.v);
}
inline Pack operator-(Pack a, Pack b)
{
    return Pack(a.v - b.v);
}
inline Pack operator*(Pack a, Pack b)
{
    return Pack(a.v * b.v);
}
inline Pack operator/(Pack a, Pack b)
{
    return Pack(a.v / b.v);
}
inline Pack operator-(Pack a)
{
    return Pack(-a.v);
}
inline Pack& operator+=(Pack& a, Pack b)
{
    return a = a + b;
}
inline Pack& operator-=(Pack& a, Pack b)
{
    return a = a - b;
}
#if defined(__SSE2__) && !defined(__AVX__)
// g++ compares and chooses one number after the other where vectors are longer than registers.
template <typename To, typename Operation, typename... From>
[[gnu::always_inline]] inline To by_halves(const Operation& operation, const From&... from)
{
    To to;
    auto* const result = reinterpret_cast<__m128d*>(&to.v);
    result[0] = operation(reinterpret_cast<const __m128d*>(&from.v)[0]...);
    result[1] = operation(reinterpret_cast<const __m128d*>(&from.v)[1]...);
    return to;
}
inline Mask operator<(Pack a, Pack b)
{
    return by_halves<Mask>([](__m128d x, __m128d y) { return _mm_cmplt_pd(x, y); }, a, b);
}
inline Mask operator>(Pack a, Pack b)
{
    return b < a;
}
inline Mask operator<=(Pack a, Pack b)
{
    return by_halves<Mask>([](__m128d x, __m128d y) { return _mm_cmple_pd(x, y); }, a, b);
}
inline Mask operator==(Pack a, Pack b)
{
    return by_halves<Mask>([](__m128d x, __m128d y) { return _mm_cmpeq_pd(x, y); }, a, b);
}
inline Pack select(Mask m, Pack yes, Pack no)
{
    return by_halves<Pack>([](__m128d of, __m128d x, __m128d y) { return _mm_or_pd(_mm_and_pd(of, x), _mm_andnot_pd(of, y)); }, m,
                           yes, no);
}
inline Pack max(Pack a, Pack b)
{
    return by_halves<Pack>([](__m128d x, __m128d y) { return _mm_max_pd(x, y); }, a, b);
}
inline Pack min(Pack a, Pack b)
{
    return by_halves<Pack>([](__m128d x, __m128d y) { return _mm_min_pd(x, y); }, a, b);
}
#else
inline Mask operator<(Pack a, Pack b)
{
    return {a.v < b.v};
}
inline Mask operator>(Pack a, Pack b)
{
    return {a.v > b.v};
}
inline Mask operator<=(Pack a, Pack b)
{
    return {a.v <= b.v};
}
inline Mask operator==(Pack a, Pack b)
{
    return {a.v == b.v};
}
inline Pack select(Mask m, Pack yes, Pack no)
{
    return Pack(m.v ? yes.v : no.v);
}
inline Pack max(Pack a, Pack b)
{
    return Pack(a.v > b.v ? a.v : b.v);
}
inline Pack min(Pack a, Pack b)
{
    return Pack(a.v < b.v ? a.v : b.v);
}
#endif
inline Mask operator&(Mask a, Mask b)
{
    return {a.v & b.v};
}
inline Mask operator|(Mask a, Mask b)
{
    return {a.v | b.v};
}
inline Mask operator!(Mask a)
{
    return {~a.v};
}

/// One after the other.
template <typename... Packs>
inline void add_pack(Pack& sum, Pack first, Packs... others)
{
    sum += first;
    ((sum += others), ...);
}
inline void max_pack(Pack& most, Pack a)
{
    most = max(most, a);
}

inline Pack abs(Pack a)
{
    return max(a, -a);
}
inline Pack sqrt(Pack a)
{
    Pack root;
    for (int i = 0; i < lanes; ++i)
        root.v[i] = std::sqrt(a.v[i]);
    return root;
}
inline bool any(Mask m)
{
#ifdef __AVX__
    return _mm256_movemask_pd(reinterpret_cast<__m256d>(m.v)) != 0;
#elif defined(__SSE2__)
    const auto* const halves = reinterpret_cast<const __m128d*>(&m.v);
    return _mm_movemask_pd(_mm_or_pd(halves[0], halves[1])) != 0;
#else
    return ((m.v[0] | m.v[1]) | (m.v[2] | m.v[3])) != 0;
#endif
}
/// A word beside each lane. (g++ makes tens of moves by way of memory of vectors that it is asked to convert.)
using WordLanes = std::uint32_t __attribute__((vector_size(16)));

/// Words whose bits are all set where lanes are.
[[nodiscard, gnu::always_inline]] inline WordLanes words_of(Mask m)
{
#if defined(__AVX__)
    const __m256 all = reinterpret_cast<__m256>(m.v);
    return reinterpret_cast<WordLanes>(_mm_shuffle_ps(_mm256_castps256_ps128(all), _mm256_extractf128_ps(all, 1), 0x88));
#elif defined(__SSE2__)
    const auto* const halves = reinterpret_cast<const __m128*>(&m.v);
    return reinterpret_cast<WordLanes>(_mm_shuffle_ps(halves[0], halves[1], 0x88));
#else
    return __builtin_convertvector(m.v, WordLanes);
#endif
}

/// Lanes that are set where all bits of words are.
[[nodiscard, gnu::always_inline]] inline Mask mask_of(WordLanes words)
{
#if defined(__AVX2__)
    return {reinterpret_cast<Mask::V>(_mm256_cvtepi32_epi64(reinterpret_cast<__m128i>(words)))};
#elif defined(__SSE2__)
    Mask m;
    const auto w = reinterpret_cast<__m128i>(words);
    auto* const halves = reinterpret_cast<__m128i*>(&m.v);
    halves[0] = _mm_unpacklo_epi32(w, w);
    halves[1] = _mm_unpackhi_epi32(w, w);
    return m;
#else
    using SignedWords = std::int32_t __attribute__((vector_size(16)));
    return {__builtin_convertvector(reinterpret_cast<SignedWords>(words), Mask::V)};
#endif
}

/// What comparing two packs gives.
template <typename P>
using MaskOf = decltype(P() < P());

/// How many lanes of masks were set.
class LaneCount
{
  public:
    void add(Mask m) { count_ -= m.v; }
    [[nodiscard]] std::int64_t total() const { return count_[0] + count_[1] + count_[2] + count_[3]; }

  private:
    Mask::V count_{};
};
[[nodiscard]] inline LaneCount count_of(Mask)
{
    return {};
}

/// In the order of the lanes.
inline double sum(Pack a)
{
    return ((a.v[0] + a.v[1]) + a.v[2]) + a.v[3];
}

/// Rows to columns.
inline void transpose(Pack& a, Pack& b, Pack& c, Pack& d)
{
    const Pack::V ab_low = __builtin_shufflevector(a.v, b.v, 0, 4, 2, 6);
    const Pack::V ab_high = __builtin_shufflevector(a.v, b.v, 1, 5, 3, 7);
    const Pack::V cd_low = __builtin_shufflevector(c.v, d.v, 0, 4, 2, 6);
    const Pack::V cd_high = __builtin_shufflevector(c.v, d.v, 1, 5, 3, 7);
    a.v = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b.v = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    c.v = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    d.v = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

// The same words for one double.
inline bool any(bool m)
{
    return m;
}
inline double select(bool m, double yes, double no)
{
    return m ? yes : no;
}
inline double max(double a, double b)
{
    return a > b ? a : b;
}
inline double min(double a, double b)
{
    return a < b ? a : b;
}
inline double abs(double a)
{
    return std::abs(a);
}
}  // namespace HDEM_LANES
}  // namespace hdem
