#pragma once
/// Numbers of what edges came from, beyond the negative ones of EdgeSource.

#include "core/model/case_def.h"

namespace hdem
{
/// Faults come first, then outlines of regions, joint sets, all traces together, and Voronoi cells. Where the two edges of a contact differ, the lower
/// number says which joint acts: a fault goes before a joint set.
class EdgeSources
{
  public:
    explicit EdgeSources(const CaseDef& def)
        : regions_(static_cast<std::int32_t>(def.faults.size())),
          sets_(regions_ + static_cast<std::int32_t>(def.regions.size())),
          traces_(sets_ + static_cast<std::int32_t>(def.joint_sets.size()))
    {
    }

    [[nodiscard]] static std::int32_t fault(std::size_t number) { return static_cast<std::int32_t>(number); }
    [[nodiscard]] std::int32_t region(std::size_t number) const { return regions_ + static_cast<std::int32_t>(number); }
    [[nodiscard]] std::int32_t set(std::size_t number) const { return sets_ + static_cast<std::int32_t>(number); }
    [[nodiscard]] std::int32_t traces() const { return traces_; }
    [[nodiscard]] std::int32_t voronoi() const { return traces_ + 1; }

  private:
    std::int32_t regions_;
    std::int32_t sets_;
    std::int32_t traces_;
};
}  // namespace hdem
