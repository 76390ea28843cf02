#include "core/rock/rock_mass.h"
#include "core/version.h"
#include "io/digest.h"
#include "parallel/simulation.h"

#include <cmath>
#include <cstdio>

/// One symbol of each library, and Eigen's types across the border between programs compiled with different flags.
int main()
{
    hdem::CaseDef def;
    def.domain.given = true;
    def.domain.width = 10.0;
    def.domain.height = 8.0;
    def.joint_sets.push_back({.dip_deg = 30.0, .spacing = 2.0});
    def.joint_sets.push_back({.dip_deg = 100.0, .spacing = 2.0});

    const hdem::RockMass rock = hdem::generate_rock_mass(def);
    double area = 0.0;
    for (const hdem::RockBlock& block : rock.blocks)
    {
        for (const hdem::ConvexPart& part : block.parts)
        {
            const auto& v = part.vertices;
            for (std::size_t i = 0; i < v.size(); ++i)
            {
                area += 0.5 * hdem::cross(v[i], v[(i + 1) % v.size()]);
            }
        }
    }
    const hdem::Simulation simulation{hdem::Model{}, hdem::State{}};

    std::printf("%s\n%zu blocks, area %.12g m2, digest %s\n", hdem::version_line().c_str(), rock.blocks.size(), area,
                hdem::sha256_hex("").c_str());
    const bool right = rock.blocks.size() > 10 && std::abs(area - 80.0) < 1e-10 && simulation.state().cycle == 0;
    return right ? 0 : 1;
}
