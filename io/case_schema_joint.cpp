#include "io/case_fields.h"
#include "io/case_sections.h"

namespace hdem
{
using namespace fields;

namespace
{
const Range acute{.low = 0, .high = 90, .high_included = false};
const Range exponent{.low = 0, .high = 1, .high_included = false};

void assign_law(void* object, const TomlNode& value, const KeySpec& key)
{
    JointDef& joint = *static_cast<JointDef*>(object);
    store(joint.law, value, key);
    joint.library = joint.law == JointLaw::library ? *value.text() : "";
}

std::vector<KeySpec> spring_keys()
{
    return {field<&JointDef::normal_stiffness>(
                {.name = "normal_stiffness",
                 .unit = "Pa/m",
                 .effect = "K_N: normal stress per overlap. Stiffer joints need a smaller time step. With `greatest_closure` it is "
                           "the stiffness at zero stress, with `normal_exponent` the factor a of K_N = a σ^e.",
                 .example = "7e9",
                 .range = positive,
                 .default_note = "must be given, unless rock_strength is"}),
            field<&JointDef::shear_stiffness>(
                {.name = "shear_stiffness",
                 .unit = "Pa/m",
                 .effect = "K_S: shear stress per shear displacement before slip. With `shear_exponent` the factor of K_S = a σ^e.",
                 .example = "5e8",
                 .range = positive,
                 .required = true}),
            field<&JointDef::greatest_closure>({.name = "greatest_closure",
                                                .unit = "m",
                                                .effect = "V_m of a hyperbolic normal spring, σ = K_N V / (1 - V/V_m). Beyond 0.95 "
                                                          "V_m it is a straight line. Any law.",
                                                .range = length,
                                                .default_note = "a linear spring"}),
            field<&JointDef::normal_exponent>(
                {.name = "normal_exponent",
                 .effect = "e of K_N = a σ^e, from zero closure on. Any law except saeb_amadei; not with `tension`.",
                 .range = exponent,
                 .default_note = "a linear spring"}),
            field<&JointDef::shear_exponent>({.name = "shear_exponent",
                                              .effect = "e of K_S = a σ^e. continuously_yielding.",
                                              .range = exponent,
                                              .default_note = "0"}),
            field<&JointDef::greatest_stiffness>({.name = "greatest_stiffness",
                                                  .unit = "Pa/m",
                                                  .effect = "Upper bound of stiffnesses with an exponent.",
                                                  .range = positive}),
            field<&JointDef::normal_stress>(
                {.name = "normal_stress",
                 .unit = "Pa",
                 .effect = "Greatest normal stress that is expected. The time step and K_S follow from the stiffness at this "
                           "stress. Beyond it curves are straight lines.",
                 .range = positive,
                 .default_note = "twice the greatest of [insitu] or of the rock's weight, four times that of loads or sides"})};
}

std::vector<KeySpec> coulomb_keys()
{
    return {
        field<&JointDef::friction_angle_deg>(
            {.name = "friction_angle_deg",
             .unit = "deg",
             .effect = "φ: slip begins at the shear force F_n tan φ + c L. The basic friction of "
                       "the other laws (φ_u of saeb_amadei), that before any slip of slip_weakening.",
             .example = "30.0",
             .range = acute,
             .default_note = "must be given, except for barton_bandis"}),
        field<&JointDef::cohesion>(
            {.name = "cohesion",
             .unit = "Pa",
             .effect = "c of the shear limit F_n tan φ + c L; L is the contact length. Only joints that are closed as drawn have "
                       "it; contacts that form later do not. patton: c_x, strength of sheared asperities at zero stress.",
             .range = non_negative,
             .default_note = "0; must be given for patton"}),
        field<&JointDef::tension>({.name = "tension",
                                   .unit = "Pa",
                                   .effect = "T: greatest tension of an intact joint, at most c / tan φ. coulomb.",
                                   .range = non_negative,
                                   .default_note = "0"}),
        field<&JointDef::residual_friction_angle_deg>(
            {.name = "residual_friction_angle_deg",
             .unit = "deg",
             .effect = "φ_r: of a broken joint (coulomb), of a worn one (barton_bandis, patton, slip_weakening).",
             .range = acute,
             .default_note = "friction_angle_deg; must be given for barton_bandis, patton and slip_weakening"}),
        field<&JointDef::residual_cohesion>(
            {.name = "residual_cohesion",
             .unit = "Pa",
             .effect = "c_r: of a broken joint. coulomb.",
             .range = non_negative,
             .default_note = "0; a joint with friction_angle_deg and cohesion alone keeps its cohesion while it slips"}),
        field<&JointDef::residual_tension>(
            {.name = "residual_tension",
             .unit = "Pa",
             .effect = "T_r: tension of a broken joint while it opens, up to an opening of half the skin of [contact]. coulomb.",
             .range = non_negative,
             .default_note = "0"}),
        field<&JointDef::dilation_angle_deg>(
            {.name = "dilation_angle_deg",
             .unit = "deg",
             .effect = "ψ: slip opens the joint by tan ψ times the slip, and closes it on the way back. At most φ_r. coulomb.",
             .range = acute,
             .default_note = "0"}),
        field<&JointDef::dilation_limit>({.name = "dilation_limit",
                                          .unit = "m",
                                          .effect = "Slip at which dilation stops. coulomb, patton.",
                                          .range = length,
                                          .default_note = "never"}),
        field<&JointDef::initially>({.name = "initially",
                                     .effect = "\"broken\": the joint has its residual values from the start. coulomb.",
                                     .choices = {"intact", "broken"}})};
}

std::vector<KeySpec> barton_keys()
{
    return {field<&JointDef::jrc>({.name = "jrc",
                                   .effect = "JRC_0, joint roughness coefficient on 0.1 m. barton_bandis.",
                                   .range = {.low = 0, .high = 20, .low_included = false},
                                   .default_note = "must be given for barton_bandis"}),
            field<&JointDef::jcs>({.name = "jcs",
                                   .unit = "Pa",
                                   .effect = "JCS_0, strength of the joint walls on 0.1 m. barton_bandis.",
                                   .range = positive,
                                   .default_note = "must be given for barton_bandis"}),
            field<&JointDef::length>({.name = "length",
                                      .unit = "m",
                                      .effect = "L to which JRC and JCS are scaled: block size along the joint. barton_bandis.",
                                      .range = length,
                                      .default_note = "mean size of the blocks"}),
            field<&JointDef::damage>(
                {.name = "damage",
                 .effect = "M: dilation angle = mobilised roughness / M; 1 at low, 2 at high stress. barton_bandis.",
                 .range = {.low = 1, .high = 10}}),
            field<&JointDef::rock_strength>({.name = "rock_strength",
                                             .unit = "Pa",
                                             .effect = "σ_c of the rock: K_N and V_m by Bandis from JRC, JCS and σ_c, instead of "
                                                       "`normal_stiffness`. barton_bandis.",
                                             .range = positive,
                                             .default_note = "normal_stiffness"}),
            field<&JointDef::closure_cycle>({.name = "closure_cycle",
                                             .effect = "Loading cycle for the closure by `rock_strength`. barton_bandis.",
                                             .range = {.low = 1, .high = 3}})};
}

std::vector<KeySpec> other_law_keys()
{
    return {
        field<&JointDef::parameters>({.name = "parameters",
                                      .effect = "Numbers that the law of a shared library is given.",
                                      .example = "[0.7, 0.5, 0.002]",
                                      .range = any_size,
                                      .default_note = "none"}),
        field<&JointDef::asperity_angle_deg>({.name = "asperity_angle_deg",
                                              .unit = "deg",
                                              .effect = "i of patton, α_0 of plesha, i_0 of saeb_amadei.",
                                              .range = acute,
                                              .default_note = "must be given for these"}),
        field<&JointDef::mobilised_angle_deg>({.name = "mobilised_angle_deg",
                                               .unit = "deg",
                                               .effect = "φ_m before any slip; falls to φ. continuously_yielding.",
                                               .range = acute,
                                               .default_note = "must be given for it"}),
        field<&JointDef::wear_length>(
            {.name = "wear_length",
             .unit = "m",
             .effect = "R: slip over which φ_m falls (continuously_yielding), D: over which φ falls to φ_r "
                       "(slip_weakening).",
             .range = length,
             .default_note = "must be given for these"}),
        field<&JointDef::wear>({.name = "wear",
                                .unit = "m2/J",
                                .effect = "C: α = α_0 exp(-C W), W the work of slip per area. plesha.",
                                .range = non_negative}),
        field<&JointDef::transition_stress>({.name = "transition_stress",
                                             .unit = "Pa",
                                             .effect = "σ_T at which all asperities are sheared off. saeb_amadei.",
                                             .range = positive,
                                             .default_note = "must be given for it"}),
        field<&JointDef::rock_cohesion>(
            {.name = "rock_cohesion", .unit = "Pa", .effect = "s_0 of the asperities' rock. saeb_amadei.", .range = non_negative}),
        field<&JointDef::rock_friction_angle_deg>({.name = "rock_friction_angle_deg",
                                                   .unit = "deg",
                                                   .effect = "φ_0 of the asperities' rock. saeb_amadei.",
                                                   .range = acute}),
        field<&JointDef::residual_displacement>(
            {.name = "residual_displacement",
             .unit = "m",
             .effect = "u_r: slip at which dilation stops and the residual strength is reached. saeb_amadei.",
             .range = length}),
        field<&JointDef::residual_share>(
            {.name = "residual_share", .effect = "B_0: residual over peak strength at zero stress. saeb_amadei.", .range = share})};
}
}  // namespace

SectionSpec joint_section()
{
    SectionSpec section{
        "joint",
        SectionKind::named,
        "joint",
        "What acts where two blocks touch. [joint.default] must exist; the others replace it for a joint set (its key `joint`) or "
        "for a pair of materials (`materials`). Equations, memory and sources of each `law`: core/joint. Contacts that form after "
        "the start have residual friction and neither cohesion, tension nor roughness. With the impulse method a `coulomb` joint "
        "breaks when an impulse reaches its strength. It bears at least as much as with springs (a bracket glued to a wall up to a "
        "third more: the point that is not pulled takes all of the shear). Other laws have only their basic friction there, "
        "barton_bandis and "
        "slip_weakening their residual one: a slab that its peak strength holds slides. "
        "Impulses have no stiffness, so curved normal springs are refused. With the hybrid method a joint with cohesion or tension "
        "keeps its springs until it breaks.",
        {with_assign(field<&JointDef::law>(
                         {.name = "law",
                          .effect = "Strength and dilation. Keys of other laws are refused. A file: a shared library with a law of "
                                    "your own; a relative path starts at the folder of the case file. core/joint/hdem_joint_law.h "
                                    "says what it must contain. Its code runs inside hdem: use only files that you trust.",
                          .choices = {"coulomb", "barton_bandis", "patton", "continuously_yielding", "plesha", "saeb_amadei",
                                      "slip_weakening"},
                          .ending = ".so"}),
                     assign_law, "\"coulomb\"")},
        append<&CaseDef::joints>};
    for (const std::vector<KeySpec>& keys : {spring_keys(), coulomb_keys(), barton_keys(), other_law_keys()})
        section.keys.insert(section.keys.end(), keys.begin(), keys.end());
    section.keys.push_back(field<&JointDef::restitution>({.name = "restitution",
                                                          .effect = "Of impulse contacts on this joint.",
                                                          .range = share,
                                                          .default_note = "contact.restitution"}));
    section.keys.push_back(
        field<&JointDef::materials>({.name = "materials",
                                     .effect = "Contacts between these two materials have this joint. Both may be the same.",
                                     .example = "[\"rock\", \"concrete\"]",
                                     .default_note = "only used by name"}));
    return section;
}
}  // namespace hdem
