#pragma once
/// The table of keys, one function a section; io/case_schema.cpp puts them together.

#include "io/case_schema.h"

namespace hdem
{
// case_schema_rock.cpp: blocks and how they are cut
SectionSpec top_section();
SectionSpec domain_section();
SectionSpec joint_set_section();
SectionSpec voronoi_section();
SectionSpec generator_section();
SectionSpec excavation_section();
SectionSpec block_section();

// case_schema_regions.cpp
SectionSpec fault_section();
SectionSpec region_section();

// case_schema_laws.cpp: materials, joints, loads, method, time step
SectionSpec material_section();
SectionSpec gravity_section();
SectionSpec load_section();
SectionSpec contact_section();
SectionSpec damping_section();
SectionSpec time_section();

// case_schema_joint.cpp
SectionSpec joint_section();

// case_schema_stress.cpp
SectionSpec insitu_section();

// case_schema_water.cpp
SectionSpec water_section();
SectionSpec water_crack_section();

// case_schema_support.cpp
SectionSpec bolt_section();
// case_schema_liner.cpp
SectionSpec liner_section();

// case_schema_boundary.cpp
SectionSpec boundary_section();

// case_schema_safety.cpp
SectionSpec factor_of_safety_section();

// case_schema_run.cpp: stages and results
SectionSpec convergence_section();
SectionSpec stage_section();
SectionSpec history_section();
SectionSpec output_section();
}  // namespace hdem
