#pragma once
/// Eight contacts at once on processors with AVX-512 (core/wide_pack.h).

#include "core/contact/contact_lanes.h"
#include "core/wide_pack.h"

#include <immintrin.h>

namespace hdem
{
/// Four lanes of this owner, four of the next.
template <typename P, typename Owner>
requires std::is_same_v<P, WidePack>
[[nodiscard, gnu::always_inline]] inline P load_lane(const Owner&, const ContactLanes::Lane& lane)
{
    const char* const at = reinterpret_cast<const char*>(lane.data());
    const __m256d low = _mm256_load_pd(reinterpret_cast<const double*>(at));
    return P(
        _mm512_insertf64x4(_mm512_castpd256_pd512(low), _mm256_load_pd(reinterpret_cast<const double*>(at + sizeof(Owner))), 1));
}

template <typename Owner>
[[gnu::always_inline]] inline void store_lane(Owner&, ContactLanes::Lane& lane, WidePack value)
{
    char* const at = reinterpret_cast<char*>(lane.data());
    _mm256_store_pd(reinterpret_cast<double*>(at), _mm512_castpd512_pd256(value.v));
    _mm256_store_pd(reinterpret_cast<double*>(at + sizeof(Owner)), _mm512_extractf64x4_pd(value.v, 1));
}

/// Load four doubles of each of eight blocks as columns.
template <typename Row>
[[gnu::always_inline]] inline void load_rows(const Row* rows, const Index* at, std::ptrdiff_t offset, WidePack& a, WidePack& b,
                                             WidePack& c, WidePack& d)
{
    load_columns([=](int i) { return reinterpret_cast<const double*>(rows + at[i]) + offset; }, a, b, c, d);
}

[[nodiscard]] inline __m128i load_eight_bytes(const std::uint8_t* from)
{
    return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
}

[[nodiscard]] inline WideMask were_impulses(const std::uint8_t* regime, WideMask)
{
    return {
        static_cast<__mmask8>(_mm_cmpeq_epi8_mask(load_eight_bytes(regime), _mm_set1_epi8(static_cast<char>(Regime::impulse))))};
}

[[nodiscard]] inline WideMask are_springs(const std::uint8_t* regime, WideMask)
{
    const __m128i now = load_eight_bytes(regime);
    const auto are = [&](Regime one) { return _mm_cmpeq_epi8_mask(now, _mm_set1_epi8(static_cast<char>(one))); };
    return {static_cast<__mmask8>(are(Regime::stick) | are(Regime::slip))};
}

[[nodiscard]] inline WideMask did_slip(const std::uint8_t* regime, WideMask)
{
    return {static_cast<__mmask8>(_mm_cmpeq_epi8_mask(load_eight_bytes(regime), _mm_set1_epi8(static_cast<char>(Regime::slip))))};
}

inline void store_eight_bytes(__m128i bytes, std::uint8_t* to)
{
    _mm_storel_epi64(reinterpret_cast<__m128i*>(to), bytes);
}

inline void store_regimes(WideMask spring, WideMask slips, WideMask held, std::uint8_t* regime)
{
    const __m128i one = _mm_set1_epi8(1);
    const __m128i springs = _mm_add_epi8(_mm_maskz_mov_epi8(spring.v, one), _mm_maskz_mov_epi8(slips.v, one));
    store_eight_bytes(_mm_add_epi8(springs, _mm_maskz_mov_epi8(held.v, _mm_set1_epi8(3))), regime);
}

inline void store_flags(WideMask m, std::uint8_t* to)
{
    store_eight_bytes(_mm_maskz_mov_epi8(m.v, _mm_set1_epi8(1)), to);
}

template <>
struct Floats<WidePack>
{
    using Type = __m256;
};

[[nodiscard]] inline WideMask have_moved(const ContactLanes& l, const BasicEdgeView<WidePack>& v, __m256& slack)
{
    const auto seen = [](const std::array<float, lanes>& of)
    {
        const char* const at = reinterpret_cast<const char*>(of.data());
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(reinterpret_cast<const float*>(at))),
                                    _mm_load_ps(reinterpret_cast<const float*>(at + sizeof(ContactLanes))), 1);
    };
    const auto off = [&](WidePack now, const std::array<float, lanes>& then)
    { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), _mm256_sub_ps(_mm512_cvtpd_ps(now.v), seen(then))); };
    const __m256 limit = seen(l.moved_limit);
    const __m256 a = _mm256_max_ps(off(v.t0, l.seen[0]), off(v.m0, l.seen[1]));
    const __m256 b = _mm256_max_ps(off(v.t1, l.seen[2]), off(v.m1, l.seen[3]));
    slack = _mm256_min_ps(_mm256_sub_ps(limit, _mm256_max_ps(a, b)), slack);
    const __mmask8 near = static_cast<__mmask8>(_mm256_cmp_ps_mask(a, limit, _CMP_LE_OQ) &
                                                _mm256_cmp_ps_mask(b, limit, _CMP_LE_OQ));
    return {static_cast<__mmask8>(~near)};
}

/// Change the sign in lanes of `m`.
[[nodiscard]] inline __m512d turned(WideMask m, __m512d value)
{
    return _mm512_mask_xor_pd(value, m.v, value, _mm512_set1_pd(-0.0));
}

/// Store the loads of eight contacts on both of their blocks, a cache line of 64 bytes for each contact.
[[gnu::always_inline]] inline void store_loads(WidePack x, WidePack y, WidePack moment_ref, WidePack moment_inc, WidePack reserve,
                                               const std::uint8_t* swapped, BlockLoad* to)
{
    const WideMask inc_first{static_cast<__mmask8>(_mm_cmpneq_epi8_mask(load_eight_bytes(swapped), _mm_setzero_si128()))};
    const __m512d x0 = turned(!inc_first, x.v), y0 = turned(!inc_first, y.v);
    const __m512d x1 = turned(inc_first, x.v), y1 = turned(inc_first, y.v);
    const __m512d moment0 = select(inc_first, moment_inc, moment_ref).v, moment1 = select(inc_first, moment_ref, moment_inc).v;
    // Pairs of columns, of contacts 0, 2, 4, 6 and of 1, 3, 5, 7.
    const auto put = [to](__m512d force0, __m512d rest0, __m512d force1, __m512d rest1, int first)
    {
        const __m512d low0 = _mm512_shuffle_f64x2(force0, rest0, 0x44), high0 = _mm512_shuffle_f64x2(force0, rest0, 0xee);
        const __m512d low1 = _mm512_shuffle_f64x2(force1, rest1, 0x44), high1 = _mm512_shuffle_f64x2(force1, rest1, 0xee);
        const auto row = [&](__m512d rows, int i) { _mm512_store_pd(&to[2 * i].x, rows); };
        row(_mm512_shuffle_f64x2(low0, low1, 0x88), first);
        row(_mm512_shuffle_f64x2(low0, low1, 0xdd), first + 2);
        row(_mm512_shuffle_f64x2(high0, high1, 0x88), first + 4);
        row(_mm512_shuffle_f64x2(high0, high1, 0xdd), first + 6);
    };
    put(_mm512_unpacklo_pd(x0, y0), _mm512_unpacklo_pd(moment0, reserve.v), _mm512_unpacklo_pd(x1, y1),
        _mm512_unpacklo_pd(moment1, reserve.v), 0);
    put(_mm512_unpackhi_pd(x0, y0), _mm512_unpackhi_pd(moment0, reserve.v), _mm512_unpackhi_pd(x1, y1),
        _mm512_unpackhi_pd(moment1, reserve.v), 1);
}

[[gnu::always_inline]] inline void store_use(WidePack mobilised, WidePack t_x, WidePack t_y, WideMask touching, WideMask springs,
                                             JointUse* to)
{
    const __m256i bits = _mm256_mask_mov_epi32(_mm256_maskz_set1_epi32(touching.v, contact_impulse), springs.v,
                                               _mm256_set1_epi32(contact_force));
    const __m256 m = _mm512_cvtpd_ps(mobilised.v), x = _mm512_cvtpd_ps(t_x.v), y = _mm512_cvtpd_ps(t_y.v);
    const __m256 b = _mm256_castsi256_ps(bits);
    const __m256 bm_01 = _mm256_unpacklo_ps(b, m), bm_23 = _mm256_unpackhi_ps(b, m);  // of contacts 0, 1, 4, 5 and 2, 3, 6, 7
    const __m256 xy_01 = _mm256_unpacklo_ps(x, y), xy_23 = _mm256_unpackhi_ps(x, y);
    const auto put = [to](__m256 rows, int i)
    {
        _mm_store_ps(reinterpret_cast<float*>(&to[i]), _mm256_castps256_ps128(rows));
        _mm_store_ps(reinterpret_cast<float*>(&to[i + 4]), _mm256_extractf128_ps(rows, 1));
    };
    put(_mm256_shuffle_ps(bm_01, xy_01, 0x44), 0);
    put(_mm256_shuffle_ps(bm_01, xy_01, 0xee), 1);
    put(_mm256_shuffle_ps(bm_23, xy_23, 0x44), 2);
    put(_mm256_shuffle_ps(bm_23, xy_23, 0xee), 3);
}
}  // namespace hdem
