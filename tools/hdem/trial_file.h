#pragma once
/// FOLDER/trials.json: trials of a search that have ended, so that one that was cut short goes on.

#include "parallel/critical_search.h"
#include "parallel/safety_factor.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace hdem
{
/// A trial that somebody damaged is none: it is run again.
/// Each trial is on the disk before the next one is asked for. Threads may call at once.
class TrialFile
{
  public:
    /// @param question  what the trials answer: trials of another one are forgotten
    TrialFile(std::filesystem::path file, const std::string& question);

    /// A trial of a search at a number, if there is one.
    [[nodiscard]] std::optional<nlohmann::ordered_json> find(const std::string& search, double at);
    void add(const std::string& search, double at, nlohmann::ordered_json trial);
    [[nodiscard]] std::size_t size() const { return trials_.size(); }
    /// Does the file hold trials of another question?
    [[nodiscard]] bool is_of_another() const { return is_of_another_; }

  private:
    std::filesystem::path file_;
    std::string question_;
    bool is_of_another_ = false;
    std::mutex mutex_;
    nlohmann::ordered_json trials_ = nlohmann::ordered_json::array();
};

/// Trials of `hdem fos`. Blocks stand there by their numbers.
class FactorTrialFile : public TrialStore
{
  public:
    /// @param blocks  of the model: a trial with other ones is none
    FactorTrialFile(std::filesystem::path file, const std::string& question, Index blocks)
        : file_(std::move(file), question),
          blocks_(blocks)
    {
    }
    [[nodiscard]] std::optional<Trial> find(FactorSearch search, double factor) override;
    void add(FactorSearch search, const Trial& trial) override;
    [[nodiscard]] std::size_t size() const { return file_.size(); }

  private:
    TrialFile file_;
    Index blocks_;
};

/// Trials of `hdem critical`.
class ConditionTrialFile
{
  public:
    ConditionTrialFile(std::filesystem::path file, const std::string& question) : file_(std::move(file), question) {}
    [[nodiscard]] std::optional<ConditionResult> find(double at);
    void add(double at, const ConditionResult& result);

  private:
    TrialFile file_;
};
}  // namespace hdem
