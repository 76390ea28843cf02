#include "tools/hdem/trial_file.h"

#include "io/atomic_file.h"
#include "io/digest.h"
#include "io/text_file.h"

#include <algorithm>

namespace hdem
{
namespace
{
using Json = nlohmann::ordered_json;
constexpr std::size_t most = 100'000'000;  // bytes

bool is_text(const Json& read, const char* key, const std::string& text)
{
    return read.is_object() && read.contains(key) && read[key].is_string() && read[key] == text;
}

std::optional<TrialEnd> end_of(const std::string& name)
{
    for (const TrialEnd end : {TrialEnd::stable, TrialEnd::failed, TrialEnd::undecided})
        if (name == name_of(end))
            return end;
    return std::nullopt;
}
}  // namespace

TrialFile::TrialFile(std::filesystem::path file, const std::string& question)
    : file_(std::move(file)),
      question_(sha256_hex(question))
{
    if (!std::filesystem::exists(file_))
        return;
    const Json read = Json::parse(read_text_file(file_, most).text, nullptr, false);
    is_of_another_ = read.is_object() && read.contains("question") && read["question"].is_string() && read["question"] != question_;
    if (is_text(read, "question", question_) && read.contains("trials") && read["trials"].is_array())
        trials_ = read["trials"];
}

std::optional<Json> TrialFile::find(const std::string& search, double at)
{
    const std::lock_guard lock(mutex_);
    for (const Json& trial : trials_)
        if (is_text(trial, "search", search) && trial.contains("at") && trial["at"].is_number() && trial["at"].get<double>() == at)
            return trial;
    return std::nullopt;
}

void TrialFile::add(const std::string& search, double at, Json trial)
{
    const std::lock_guard lock(mutex_);
    Json entry = {{"search", search}, {"at", at}};
    entry.update(trial);
    trials_.push_back(std::move(entry));
    const Json all = {{"question", question_}, {"trials", trials_}};
    write_atomically(file_, all.dump(1) + "\n",
                     Flush::later);  // whole for whoever reads it after a kill; a power failure may cost trials
}

std::optional<Trial> FactorTrialFile::find(FactorSearch search, double factor)
try
{
    const std::optional<Json> read = file_.find(name_of(search), factor);
    const std::optional<TrialEnd> end = read ? end_of(read->value("verdict", "")) : std::nullopt;
    if (!end)
        return std::nullopt;
    const auto has_others = [this](const std::vector<Index>& blocks)
    { return std::ranges::any_of(blocks, [this](Index b) { return b < 0 || b >= blocks_; }); };
    if (has_others(read->at("failing")) || has_others(read->at("let_fall")))
        return std::nullopt;
    return Trial{.factor = factor,
                 .end = *end,
                 .reason = read->at("reason"),
                 .displacement = read->at("displacement"),
                 .failing = read->at("failing"),
                 .let_fall = read->at("let_fall"),
                 .cycles = read->at("cycles"),
                 .time = read->at("time")};
}
catch (const Json::exception&)
{
    return std::nullopt;
}

void FactorTrialFile::add(FactorSearch search, const Trial& trial)
{
    file_.add(name_of(search), trial.factor,
              {{"verdict", name_of(trial.end)},
               {"reason", trial.reason},
               {"displacement", trial.displacement},
               {"failing", trial.failing},
               {"let_fall", trial.let_fall},
               {"cycles", trial.cycles},
               {"time", trial.time}});
}

std::optional<ConditionResult> ConditionTrialFile::find(double at)
try
{
    const std::optional<Json> read = file_.find("critical", at);
    if (!read)
        return std::nullopt;
    return ConditionResult{.fails = read->at("fails"),
                           .greatest = read->at("greatest"),
                           .block = read->at("block"),
                           .cycles = read->at("cycles"),
                           .met_ends = read->at("met_ends"),
                           .still_moves = read->at("still_moves"),
                           .ends_moving = read->at("ends_moving")};
}
catch (const Json::exception&)
{
    return std::nullopt;
}

void ConditionTrialFile::add(double at, const ConditionResult& result)
{
    file_.add("critical", at,
              {{"fails", result.fails},
               {"greatest", result.greatest},
               {"block", result.block},
               {"cycles", result.cycles},
               {"met_ends", result.met_ends},
               {"still_moves", result.still_moves},
               {"ends_moving", result.ends_moving}});
}
}  // namespace hdem
