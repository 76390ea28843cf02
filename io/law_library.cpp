#include "io/law_library.h"

#include "io/digest.h"
#include "io/toml_tree.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <fstream>
#include <sstream>

namespace hdem
{
namespace
{
/// What stops a library from being used, and what to do; both empty if nothing does.
struct Obstacle
{
    std::string why, remedy;
};

/// Path and digest, as kept with the case.
struct KeptLibrary
{
    std::string path, digest;
};

std::string text_of(const KeptLibrary& library)
{
    return library.path + "\n" + library.digest + "\n";
}

KeptLibrary kept_library(const std::string& text)
{
    const auto end = text.find('\n');
    return {text.substr(0, end), end == std::string::npos ? "" : text.substr(end + 1, 64)};
}

/// "" where it cannot be read. (A pipe would be waited for.)
std::string digest_of(const std::string& path)
{
    if (std::error_code ignored; !std::filesystem::is_regular_file(path, ignored))
        return "";
    std::ifstream in(path, std::ios::binary);
    std::ostringstream bytes;
    return in && bytes << in.rdbuf() ? sha256_hex(bytes.view()) : "";
}

Obstacle load(const std::string& path, JointFunction& function)
{
    void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // open until the program ends
    if (library == nullptr)
        return {fmt::format("cannot be loaded: {}", printable(dlerror(), 300)), "Build it as a shared library for this machine."};
    const auto version = reinterpret_cast<int (*)()>(dlsym(library, "hdem_joint_law_version"));
    function = reinterpret_cast<JointFunction>(dlsym(library, "hdem_joint_law"));
    if (version == nullptr || function == nullptr)
        return {fmt::format("has no function {}", version == nullptr ? "hdem_joint_law_version" : "hdem_joint_law"),
                "core/joint/hdem_joint_law.h says what it needs."};
    if (version() != HDEM_JOINT_LAW_VERSION)
        return {fmt::format("is for version {} of hdem_joint_law.h, this is version {}", version(), HDEM_JOINT_LAW_VERSION),
                "Build it anew with the header of this version."};
    return {};
}

Obstacle take(JointDef& joint, const std::filesystem::path& folder, const NamedFiles* stored, NamedFiles& kept)
{
    KeptLibrary library;
    if (stored == nullptr)
        library.path = std::filesystem::absolute(folder / joint.library).string();
    else if (const auto found = stored->find(joint.library); found != stored->end())
        library = kept_library(found->second);
    const std::string digest = digest_of(library.path);
    if (digest.empty())
        return {fmt::format("{} cannot be read", printable(library.path, 300)),
                "Give its name, from the folder of the case file on."};
    if (stored != nullptr && digest != library.digest)
        return {fmt::format("{} is not the one that the run began with", printable(library.path, 300)),
                "Put that one back, or begin the run anew."};
    library.digest = digest;
    kept[joint.library] = text_of(library);
    return load(library.path, joint.function);
}
}  // namespace

void load_laws(CaseFile& read, CaseDef& def, const std::filesystem::path& case_file, const NamedFiles* stored,
               CaseProblems& problems)
{
    for (JointDef& joint : def.joints)
    {
        if (joint.law != JointLaw::library)
            continue;
        const std::string key = "joint." + joint.name + ".law";
        const Obstacle obstacle = take(joint, case_file.parent_path(), stored, read.files);
        if (!obstacle.why.empty())
            problems.add(key, fmt::format("joint \"{}\"", printable(joint.name)),
                         fmt::format("law = \"{}\"", printable(joint.library)), obstacle.why, obstacle.remedy);
    }
}
}  // namespace hdem
