#include "io/case_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace hdem
{
CaseSource::CaseSource(std::string file, std::string text) : sources_{std::move(file)}, text_(std::move(text))
{
}

int CaseSource::add_source(std::string name)
{
    sources_.push_back(std::move(name));
    return static_cast<int>(sources_.size()) - 1;
}

void CaseSource::add(std::string key, const Place& at)
{
    places_.insert_or_assign(std::move(key), at);
}

Place CaseSource::place(std::string_view key) const
{
    while (!key.empty())
    {
        if (const auto found = places_.find(std::string(key)); found != places_.end())
            return found->second;
        const auto cut = key.find_last_of(".[");
        key = key.substr(0, cut == std::string_view::npos ? 0 : cut);
    }
    return {};
}

std::string CaseSource::located(const Problem& problem) const
{
    const Place at = place(problem.key);
    std::string line = sources_[static_cast<std::size_t>(at.source)];
    if (at.line > 0)
        line += fmt::format(":{}", at.line);
    if (at.line > 0 && at.column > 0)
        line += fmt::format(":{}", at.column);
    return line + (problem.severity == Problem::Severity::warning ? ": warning: " : ": ") + problem.text;
}

std::vector<Problem> CaseSource::located(std::vector<Problem> problems) const
{
    std::stable_sort(problems.begin(), problems.end(),
                     [this](const Problem& a, const Problem& b)
                     {
                         const Place p = place(a.key);
                         const Place q = place(b.key);
                         return std::tuple(p.source, p.line, p.column) < std::tuple(q.source, q.line, q.column);
                     });
    for (Problem& problem : problems)
        problem.text = located(problem);
    return problems;
}
}  // namespace hdem
