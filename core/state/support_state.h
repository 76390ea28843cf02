#pragma once
/// What has happened to the bolts; part of the state.

#include <cstdint>
#include <vector>

namespace hdem
{
enum class BoltStatus : std::uint8_t
{
    planned,   ///< its stage has not begun
    elastic,   ///< it acts
    slips,     ///< its bond has slipped somewhere
    yielded,   ///< it has yielded somewhere
    ruptured,  ///< anchored: it acts no more; else somewhere
    lost       ///< a block that it is tied to is not there: it does not act
};
inline constexpr std::uint8_t bolt_states = 6;

/// A bolt as last found, per metre of thickness.
struct BoltRecord
{
    BoltStatus status = BoltStatus::planned;
    double force = 0.0;           ///< greatest tension along it [N]
    double shear_force = 0.0;     ///< greatest at its joints, local [N]
    double greatest_force = 0.0;  ///< of `force` so far [N]
    double elongation = 0.0;      ///< since it was installed [m]
    double stored = 0.0;          ///< elastic energy [J]
    double spent = 0.0;           ///< by yield, slip of the bond and rupture [J]
};

struct SupportState
{
    std::vector<BoltRecord> bolts;
    /// Numbers of each bolt, see the laws in core/support.
    std::vector<double> history;
};
}  // namespace hdem
