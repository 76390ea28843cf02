/// libFuzzer target: any bytes as a case file. It is read, or refused with problems that say something; a small legal one is also built,
/// and its first cycles are run, so that numbers at the edge of what is allowed meet all that computes with them.

#include "core/rock/build_model.h"
#include "core/rock/excavation.h"
#include "core/rock/finite_traces.h"
#include "core/rock/joint_sets.h"
#include "core/rock/rock_checks.h"
#include "core/rock/voronoi_edges.h"
#include "io/case_reader.h"
#include "parallel/simulation.h"

#include <cstdint>
#include <cstdlib>

namespace hdem
{
namespace
{
/// What a case may name; nothing else is there.
const NamedFiles files = {
    {"ground.csv", "x,y\n0,9\n3,11\n10,10\n"},
    {"blocks.wkt", "POLYGON((0 0, 1 0, 1 1, 0 0)); a; rock; fixed\n"},
    {"traces.csv", "a,0,2\na,8,5.5\nb,3,0\nb,4,9\n"},
    {"factors.csv", "cycle,factor\n0,0\n2,1\n5,-1\n"},
    {"field.csv", "x,y,pressure\n0,0,1e5\n10,0,1e5\n5,10,0\n"},
};

Polygon outline_of_all(const CaseDef& def)
{
    return def.domain.given ? domain_polygon(def.domain) : Polygon{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}};
}

/// Lines and cells that cutting may give: what is built here must stay small.
bool is_cut_small(const CaseDef& def)
{
    double pieces = def.voronoi.given ? count_cells(def) / 10.0 : 0.0;
    for (const JointSetDef& set : def.joint_sets)
        pieces += set.trace ? count_traces(set, bounding_box(outline_of_all(def)))
                            : count_joints(set, bounding_box(outline_of_all(def)));
    return pieces < 20.0;
}

bool is_small(const CaseDef& def)
{
    if (def.joint_sets.size() > 4 || def.excavations.size() > 4 || def.blocks.size() > 50 || def.faults.size() > 4 ||
        def.regions.size() > 4 || def.boundaries.size() > 6 || def.bolts.size() > 6 || def.liners.size() > 3)
        return false;
    for (const ExcavationDef& excavation : def.excavations)
        if (excavation.arc_segments > 50 || !(std::max(excavation.width, excavation.diameter) < 100.0 && excavation.height < 100.0))
            return false;
    for (const BoltDef& bolt : def.bolts)
        if ((!bolt.around.empty() && bolt.along < 0.2) || (bolt.segment && *bolt.segment < 0.01))
            return false;
    for (const LinerDef& liner : def.liners)
        if (liner.segment.value_or(2.0 * liner.thickness) < 0.05 || liner.path.size() > 100)
            return false;
    return !def.domain.given || is_cut_small(def);
}

void run(Setup setup)
{
    if (setup.model.blocks() > 300 || setup.state.support.history.size() > 20'000)
        return;
    Simulation simulation(std::move(setup.model), std::move(setup.state));
    if (!simulation.find_problems().empty())
        return;
    try
    {
        simulation.begin_stage(0);
        for (int i = 0; i < 3; ++i)
            simulation.advance(1);
        simulation.check_state();
    }
    catch (const RunError& error)
    {
        if (*error.what() == '\0')
            std::abort();
    }
}
}  // namespace
}  // namespace hdem

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try
    {
        const hdem::CaseFile read = hdem::read_case_text(std::string(reinterpret_cast<const char*>(data), size), "fuzz.toml", {},
                                                         &hdem::files);
        if (hdem::is_small(read.def))
            hdem::run(hdem::build_model(read.def));
    }
    catch (const hdem::InputError& error)
    {
        if (error.problems().empty() || error.problems().front().text.empty())
            std::abort();
    }
    return 0;
}
