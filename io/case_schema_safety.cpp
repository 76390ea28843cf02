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
    "stiffness and in-situ stress stay, and so do the forces of water. Each trial begins from the same state of rest under great "
    "strength, with springs and "
    "quasi-static damping whatever the case's method. It is stable when the rock comes to rest and no block has moved farther than "
    "`displacement`; failed when one has and does not slow down.";

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
    KeySpec displacement = spec({.name = "displacement",
                                 .unit = "m",
                                 .effect = "A block that moves farther than this in a trial, and does not slow down, has failed. "
                                           "`\"auto\"`: 0.02 of the block's size (root of its area), at least ten times what "
                                           "its joints are strained by elastically.",
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
              .effect = "What is weakened: `\"joints\"` are all, else names of [joint.NAME]. `\"bolts\"`: what [[bolt]] bear is "
                        "divided too (yield, shear_strength, bond_strength); else it stays.",
              .example = "[\"joints\", \"bolts\"]"}),
         field<&FactorOfSafetyDef::bracket>(
             {.name = "bracket",
              .effect = "Lowest and highest F to begin with. Where the answer lies outside the search goes on by doubling or "
                        "halving. The bound by limit analysis, where it is found, comes first.",
              .example = "[0.5, 3.0]",
              .range = {.low = 0, .high = 1e3, .low_included = false}}),
         field<&FactorOfSafetyDef::tolerance>(
             {.name = "tolerance", .effect = "Width of the last bracket. F is its middle.", .range = {.low = 1e-4, .high = 1}}),
         with_assign(std::move(displacement), assign_displacement),
         field<&FactorOfSafetyDef::least_size>(
             {.name = "least_size",
              .unit = "m²",
              .effect = "Smaller blocks may fail without counting. They are taken away when they do, and named.",
              .range = non_negative}),
         field<&FactorOfSafetyDef::begin>(
             {.name = "begin",
              .effect = "Where blocks gave way in the last stage by their own strength: `\"last_stage\"` runs the stage anew "
                        "under great strength, and F says where they would have stood; what falls then too fails at any strength. "
                        "`\"last_state\"` takes the rock as it lies, and F is that of what still stands.",
              .choices = {"last_stage", "last_state"}}),
         field<&FactorOfSafetyDef::peak>(
             {.name = "peak",
              .effect = "Where slip or breaking takes strength: find the factor with residual strength = peak strength too."}),
         field<&FactorOfSafetyDef::check_stiffness>(
             {.name = "check_stiffness",
              .effect = "Look whether the factor is the same with joints that are so many times as stiff; 1: do not look.",
              .range = {.low = 1, .high = 10}})},
        part<&CaseDef::factor_of_safety>};
}
}  // namespace hdem
