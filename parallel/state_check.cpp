#include "parallel/state_check.h"

#include "core/check.h"
#include "core/contact/contact_report.h"
#include "core/detection/contact_tracking.h"
#include "core/detection/edge_touch.h"
#include "core/motion/step_check.h"
#include "core/stage/rules.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hdem
{
namespace
{
std::string moment(const State& state)
{
    return "cycle " + std::to_string(state.cycle) + ", time " + with_digits("%.6g", state.time) + " s: ";
}

std::string two_blocks(const Model& model, const State& state, Index contact)
{
    const ContactReport report = report_contact(state, contact);
    const Vec2 place = model.origin + 0.5 * (report.point[0] + report.point[1]);
    return "blocks \"" + model.name[state.contacts.ref[contact]] + "\" and \"" + model.name[state.contacts.inc[contact]] +
           "\", contact " + std::to_string(contact) + " at (" + with_digits("%.6g", place.x()) + ", " +
           with_digits("%.6g", place.y()) + ") m: ";
}

std::string step_above(const Model& model, double limit)
{
    const bool better = model.default_time_step < 0.5 * limit && model.default_time_step < model.time_step;
    return "time step = " + with_digits("%.4g", model.time_step) +
           " s (above the stable limit 2/omega_max = " + with_digits("%.4g", limit) +
           " s of the springs that act here: they would throw the blocks apart). Give a smaller time.step" +
           (better ? ", or none to use " + with_digits("%.4g", model.default_time_step) + " s."
                   : ", e.g. " + with_digits("%.2g", 0.2 * limit) + " s.");
}
}  // namespace

std::string with_digits(const char* format, double value)
{
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

void check_finite(const Model& model, const State& state)
{
    for (Index i = 0; i < state.blocks.size(); ++i)
    {
        const BlockMotion& m = state.blocks.motion[i];
        if (!std::isfinite(m.x + m.y + m.c + m.s + m.vx + m.vy + m.w))
            throw RunError(moment(state) + "block \"" + model.name[i] +
                           "\": position or velocity is not a finite number (the motion is unstable). "
                           "Give a smaller time.step or remove very small blocks (generator.smallest_block_area).");
    }
}

void refuse_overlap(const Model& model, const State& state)
{
    const Contacts& contacts = state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        if (!is_closed_contact(state, i))  // overlaps of the others mean nothing: their edges may be beside each other
            continue;
        const Index ref = contacts.ref[i], inc = contacts.inc[i];
        const Contact contact = contacts.get(i);
        const double overlap = std::max(contact.point[0].overlap, contact.point[1].overlap);
        const double limit = model.contact.overlap_limit * std::min(model.size(ref), model.size(inc));
        if (overlap > limit)
            throw RunError(
                moment(state) + two_blocks(model, state, i) + "overlap = " + with_digits("%.4g", overlap) +
                " m (above contact.overlap_limit: " + with_digits("%.4g", limit) +
                " m). Give a smaller time.step or a greater joint normal_stiffness, or raise the limit if this overlap is meant.");
    }
    throw RunError(moment(state) + "an overlap is above contact.overlap_limit. Give a smaller time.step.");
}

double greatest_preload(const State& state)
{
    double preload = 0.0;
    for (Index i = 0; i < state.contacts.size(); ++i)
        preload = std::max({preload, state.contacts.preload(0, i), state.contacts.preload(1, i)});
    return preload;
}

void check_preload(const Model& model, const State& state)
{
    if (const double preload = greatest_preload(state); preload > 0.5 * skin_width(model))
        throw RunError(moment(state) + "stage \"" + model.stages[static_cast<std::size_t>(state.stage)].name +
                       "\": set makes joints so soft that they are pressed by " + with_digits("%.4g", preload) +
                       " m (contact.skin = " + with_digits("%.4g", model.contact.skin) +
                       " would lose them while they still bear). Give a greater skin, or stiffer joints.");
}

void check_step(const Model& model, const State& state)
{
    const StageRules rules = resolve_rules(model, state);
    if (rules.contact.law == ContactLaw::impulses || !rules.step.needs_stable_step())
        return;
    const StableLimit limit = exceeded_limit(model.time_step, model, state.blocks, state.contacts);
    if (limit.block != no_index)
        throw RunError(moment(state) + "block \"" + model.name[limit.block] + "\": " + step_above(model, limit.step));
}

void refuse_step(const Model& model, const State& state, Index contact)
{
    throw RunError(moment(state) + two_blocks(model, state, contact) +
                   step_above(model, contact_limit(model, state.blocks, state.contacts, contact)));
}
}  // namespace hdem
