#pragma once
/// What has happened to bolts and liners; part of the state.

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

/// A liner as last found, per metre of thickness.
struct LinerRecord
{
    std::uint8_t installed = 0;
    std::int64_t since = 0;     ///< cycle at which it was installed
    double thrust = 0.0;        ///< greatest compression along it [N]
    double moment = 0.0;        ///< greatest, whatever its sign [N m]
    double displacement = 0.0;  ///< greatest of its nodes since it was installed [m]
    std::int64_t hinges = 0;    ///< nodes at which it has turned plastically
    double parted = 0.0;        ///< length that has come off the rock [m]
    double stored = 0.0;        ///< elastic energy [J]
    double spent = 0.0;         ///< by hinges, yield and slip [J]
};

struct SupportState
{
    std::vector<BoltRecord> bolts;
    std::vector<LinerRecord> liners;
    /// Numbers of each bolt and liner, see the laws in core/support.
    std::vector<double> history;
};
}  // namespace hdem
