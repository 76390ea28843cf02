#include "verification/rest/case_text.h"

#include <fmt/format.h>

namespace hdem::verification::rest
{
namespace
{
std::string text(double value)
{
    return fmt::format("{:.17g}", value);
}

std::string text(const Vec2& v)
{
    return fmt::format("[{:.17g}, {:.17g}]", v.x(), v.y());
}

std::string text(const Polygon& polygon)
{
    std::string all;
    for (const Vec2& v : polygon)
        all += (all.empty() ? "" : ", ") + text(v);
    return '[' + all + ']';
}

std::string text(const std::vector<std::string>& words)
{
    std::string all;
    for (const std::string& word : words)
        all += (all.empty() ? "\"" : ", \"") + word + '"';
    return '[' + all + ']';
}

const char* text(Method method)
{
    return method == Method::force ? "force" : (method == Method::impulse ? "impulse" : "hybrid");
}

const char* text(DampingPreset preset)
{
    return preset == DampingPreset::automatic ? "default" : (preset == DampingPreset::paper ? "paper" : "dynamic");
}

class Writer
{
  public:
    void header(const std::string& name) { text_ += fmt::format("\n{}\n", name); }
    void row(const char* key, const std::string& value) { text_ += fmt::format("{} = {}\n", key, value); }
    void word(const char* key, const std::string& value) { row(key, '"' + value + '"'); }
    template <typename Value>
    void given(const char* key, const std::optional<Value>& value)
    {
        if (value)
            text_ += fmt::format("{} = {:.17g}\n", key, static_cast<double>(*value));
    }
    void given(const char* key, const std::optional<std::int64_t>& value)
    {
        if (value)
            text_ += fmt::format("{} = {}\n", key, *value);
    }
    void given(const char* key, const std::vector<std::string>& words)
    {
        if (!words.empty())
            row(key, text(words));
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

  private:
    std::string text_ = "schema = 1\n";
};

void write_rock(const CaseDef& def, Writer& out)
{
    for (const MaterialDef& material : def.materials)
    {
        out.header("[material." + material.name + ']');
        out.row("density", text(material.density));
    }
    for (const JointDef& joint : def.joints)
    {
        out.header("[joint." + joint.name + ']');
        out.row("normal_stiffness", text(joint.normal_stiffness));
        out.row("shear_stiffness", text(joint.shear_stiffness));
        out.row("friction_angle_deg", text(joint.friction_angle_deg));
        out.row("cohesion", text(joint.cohesion));
        out.given("restitution", joint.restitution);
        out.given("materials", joint.materials);
    }
    for (const BlockDef& block : def.blocks)
    {
        out.header("[[block]]");
        out.word("name", block.name);
        out.row("polygon", text(block.polygon));
        out.word("material", block.material);
        if (block.fix_x && block.fix_y && block.fix_rotation)
            out.row("fixed", "true");
        if (block.velocity != Vec2(0.0, 0.0))
            out.row("velocity", text(block.velocity));
        if (block.angular_velocity != 0.0)
            out.row("angular_velocity", text(block.angular_velocity));
    }
}

void write_loads(const CaseDef& def, Writer& out)
{
    for (const LoadDef& load : def.loads)
    {
        out.header("[[load]]");
        out.given("blocks", load.blocks);
        out.row("acceleration", text(load.acceleration));
        out.row("force", text(load.force));
        out.row("moment", text(load.moment));
        out.given("from_cycle", load.interval.from_cycle);
        out.given("until_cycle", load.interval.until_cycle);
        out.given("from_time", load.interval.from_time);
        out.given("until_time", load.interval.until_time);
    }
}

void write_stages(const CaseDef& def, Writer& out)
{
    for (const StageDef& stage : def.stages)
    {
        out.header("[[stage]]");
        out.word("name", stage.name);
        out.given("cycles", stage.cycles);
        out.given("duration", stage.duration);
        if (stage.until_converged)
        {
            out.word("until", "converged");
            out.row("max_cycles", fmt::format("{}", stage.max_cycles));
        }
        out.given("fix", stage.fix);
        out.given("free", stage.free);
    }
}
}  // namespace

std::string case_text(const CaseDef& def)
{
    Writer out;
    out.word("title", def.title);
    write_rock(def, out);
    out.header("[gravity]");
    out.row("vector", text(def.gravity));
    write_loads(def, out);
    out.header("[contact]");
    out.word("method", text(def.contact.method));
    out.header("[damping]");
    out.word("preset", text(def.damping.preset));
    if (def.time.step)
    {
        out.header("[time]");
        out.given("step", def.time.step);
    }
    write_stages(def, out);
    return out.take();
}
}  // namespace hdem::verification::rest
