#include "io/case_fields.h"
#include "io/case_sections.h"

namespace hdem
{
using namespace fields;

namespace
{
constexpr const char* about =
    "What `hdem fos` does after all stages have run: the strength of joints is divided by a factor F until blocks fail. All of the "
    "strength of every law is divided (cohesion, tan φ, tension, residual values, the whole envelope of curved laws); dilation, "
    "stiffness, in-situ stress and the forces of water do not change. Each trial begins from the same state of rest under great "
    "strength, and uses springs and quasi-static damping whatever the case's method. A trial is stable when the rock comes to rest "
    "and no block has moved farther than `displacement`. It has failed when a block has moved farther and does not slow down, or "
    "has come to rest farther off.";

void assign_displacement(void* object, const TomlNode& value, const KeySpec&)
{
    auto& def = *static_cast<FactorOfSafetyDef*>(object);
    def.displacement.reset();
    if (value.text() == nullptr)
        def.displacement = value.number();
}
}  // namespace

SectionSpec factor_of_safety_section()
{
    KeySpec displacement = spec(
        {.name = "displacement",
         .unit = "m",
         .effect = "A block that moves farther than this in a trial, and does not slow down, has failed; so has one that comes to "
                   "rest farther off: where bolts or steps stop blocks, this limit decides the factor. `\"auto\"`: 0.02 of the "
                   "block's size (root of its area), at least ten times the elastic deformation of its joints and four times the "
                   "stretch that its bolts still need to yield.",
         .example = "0.1",
         .range = length,
         .choices = {"auto"},
         .default_note = "`\"auto\"`"},
        ValueType::number_or_text);
    return {
        "factor_of_safety",
        SectionKind::table,
        "factor_of_safety",
        about,
        {field<&FactorOfSafetyDef::reduce>(
             {.name = "reduce",
              .effect = "What is weakened: `\"joints\"`: all joints; else names of [joint.NAME]. `\"bolts\"`: the strength of "
                        "bolts is divided too (yield, shear_strength, bond_strength).",
              .example = "[\"joints\", \"bolts\"]"}),
         field<&FactorOfSafetyDef::bracket>(
             {.name = "bracket",
              .effect = "Lowest and highest F to begin with. If the answer lies outside, the search goes on by doubling or halving "
                        "F. If limit analysis finds a bound, the search begins with that instead.",
              .example = "[0.5, 3.0]",
              .range = {.low = 0, .high = 1e3, .low_included = false}}),
         field<&FactorOfSafetyDef::tolerance>(
             {.name = "tolerance", .effect = "Width of the last bracket. F is its middle.", .range = {.low = 1e-4, .high = 1}}),
         with_assign(std::move(displacement), assign_displacement),
         field<&FactorOfSafetyDef::least_size>({.name = "least_size",
                                                .unit = "m²",
                                                .effect = "Smaller blocks that fail do not count. They are removed and named.",
                                                .range = non_negative}),
         field<&FactorOfSafetyDef::begin>(
             {.name = "begin",
              .effect = "If blocks failed in the last stage with the strength of the case: `\"last_stage\"` runs the stage anew "
                        "under great strength, so that F is that of the rock before they moved. A block that falls even then fails "
                        "at any strength. `\"last_state\"` takes the rock as it lies; F is that of what still stands.",
              .choices = {"last_stage", "last_state"}}),
         field<&FactorOfSafetyDef::peak>(
             {.name = "peak",
              .effect = "If slip or breaking reduces the strength, also find the factor with residual strength = peak strength."}),
         field<&FactorOfSafetyDef::check_stiffness>(
             {.name = "check_stiffness",
              .effect = "Check whether the factor is the same with joints that are this many times as stiff; 1: no check.",
              .range = {.low = 1, .high = 10}})},
        part<&CaseDef::factor_of_safety>};
}
}  // namespace hdem
