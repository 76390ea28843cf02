#pragma once
/// Eight blocks at once on processors with AVX-512 (core/wide_pack.h).

#include "core/motion/block_lanes.h"
#include "core/wide_pack.h"

namespace hdem
{
inline namespace HDEM_LANES
{
/// Of eight rows, as all others here.
template <>
struct Columns<WidePack>
{
    WidePack a, b, c, d;

    Columns(const double* from, std::ptrdiff_t stride, Index)
    {
        load_columns([=](int i) { return from + i * stride; }, a, b, c, d);
    }
    void store(double* to, std::ptrdiff_t stride, Index) const
    {
        store_columns(a, b, c, d, [=](int i) { return to + i * stride; });
    }
};

template <>
struct JointColumns<WidePack>
{
    __m256 mobilised, t_x, t_y;
    __m256i contacts;

    JointColumns(const BlockForce* force, Index)
    {
        const auto rows = [=](int i)
        {
            return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(reinterpret_cast<const float*>(&force[i].contacts))),
                                        _mm_load_ps(reinterpret_cast<const float*>(&force[i + 4].contacts)), 1);
        };
        const __m256 low_01 = _mm256_unpacklo_ps(rows(0), rows(1)), low_23 = _mm256_unpacklo_ps(rows(2), rows(3));
        const __m256 high_01 = _mm256_unpackhi_ps(rows(0), rows(1)), high_23 = _mm256_unpackhi_ps(rows(2), rows(3));
        contacts = _mm256_castps_si256(_mm256_shuffle_ps(low_01, low_23, 0x44));
        mobilised = _mm256_shuffle_ps(low_01, low_23, 0xee);
        t_x = _mm256_shuffle_ps(high_01, high_23, 0x44);
        t_y = _mm256_shuffle_ps(high_01, high_23, 0xee);
    }
    [[nodiscard]] static WidePack to_pack(__m256 floats) { return WidePack(WidePack::V(_mm512_cvtps_pd(floats))); }
    [[nodiscard]] WideMask have(ContactBits bits) const
    {
        return {_mm256_test_epi32_mask(contacts, _mm256_set1_epi32(static_cast<int>(bits)))};
    }
};
}  // namespace HDEM_LANES
}  // namespace hdem
