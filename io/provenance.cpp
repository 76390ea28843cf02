#include "io/provenance.h"

#include "core/version.h"
#include "io/digest.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string_view>

namespace hdem
{
namespace
{
std::string cpu_model()
{
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (const auto colon = line.find(": "); line.starts_with("model name") && colon != std::string::npos)
            return line.substr(colon + 2);
    return "unknown";
}

std::vector<std::string> openmp_variables()
{
    std::vector<std::string> found;
    for (char** variable = environ; *variable != nullptr; ++variable)
        if (std::string_view(*variable).starts_with("OMP_") || std::string_view(*variable).starts_with("GOMP_"))
            found.emplace_back(*variable);
    std::sort(found.begin(), found.end());
    return found;
}
}  // namespace

std::string timestamp()
{
    const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
    const std::time_t now = epoch != nullptr ? static_cast<std::time_t>(std::atoll(epoch)) : std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

void describe_machine(Provenance& provenance)
{
    char host[256] = "";
    gethostname(host, sizeof host - 1);
    provenance.hostname = host;
    provenance.cpu = cpu_model();
    provenance.environment = openmp_variables();
    provenance.begin = timestamp();
}

void write_provenance(Hdf5Writer& file, const Provenance& provenance)
{
    const std::string group = "/provenance";
    const Version& v = version();
    file.make_group(group);
    file.set_text(group, "hdem_version", v.number);
    file.set_text(group, "git_commit", v.commit);
    file.set_attribute(group, "git_dirty", static_cast<std::uint8_t>(v.dirty));
    file.set_text(group, "compiler", v.compiler);
    file.set_text(group, "flags", v.flags);
    file.set_text(group, "build_type", v.build_type);
    file.set_text(group, "cpu", provenance.cpu);
    file.set_text(group, "hostname", provenance.hostname);
    file.set_attribute(group, "threads", static_cast<std::int64_t>(provenance.threads));
    file.set_attribute(group, "seed", provenance.seed);
    file.set_text(group, "begin", provenance.begin);
    file.set_text(group, "end", provenance.end);
    file.set_text(group, "case_file", provenance.case_file);
    file.set_text(group, "case_sha256", sha256_hex(provenance.case_text));
    // Datasets, because an attribute holds 64 kB only.
    file.write_texts(group + "/case_text", {provenance.case_text});
    file.write_texts(group + "/overrides", provenance.overrides);
    file.write_texts(group + "/command_line", provenance.command_line);
    file.write_texts(group + "/environment", provenance.environment);
    file.write_texts(group + "/restarts", provenance.restarts);
}
}  // namespace hdem
