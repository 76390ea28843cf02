/// libFuzzer target: any bytes as a case file. It is read, or refused with problems that say something; a small legal one is also built.

#include "core/rock/build_model.h"
#include "io/case_reader.h"

#include <cstdint>
#include <cstdlib>

namespace hdem
{
namespace
{
/// Blocks that cutting may give: what is built here must stay small.
bool is_small(const CaseDef& def)
{
    if (def.joint_sets.size() > 4 || def.excavations.size() > 4 || def.blocks.size() > 50)
        return false;
    for (const JointSetDef& set : def.joint_sets)
    {
        const double across = def.domain.width + def.domain.height;
        if (!def.domain.polygon.empty() || !(across / set.spacing < 5.0))
            return false;
    }
    for (const ExcavationDef& excavation : def.excavations)
        if (excavation.arc_segments > 50)
            return false;
    return true;
}
}  // namespace
}  // namespace hdem

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try
    {
        const hdem::CaseFile read = hdem::read_case_text(std::string(reinterpret_cast<const char*>(data), size),
                                                         "/nowhere/fuzz.toml");
        if (hdem::is_small(read.def))
            (void)hdem::build_model(read.def);
    }
    catch (const hdem::InputError& error)
    {
        if (error.problems().empty() || error.problems().front().text.empty())
            std::abort();
    }
    return 0;
}
