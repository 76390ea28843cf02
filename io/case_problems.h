#pragma once
/// Collects everything that is wrong with a case, in one grammar: object: key = value unit (why). What to do.

#include "core/check.h"
#include "io/case_schema.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hdem
{
/// The name closest to `word`, when it is close enough to be what the user meant; else "".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

class CaseProblems
{
  public:
    /// The first problem of a key counts; what follows from it is not reported. @param key like "stage[0].cycles"
    void add(const std::string& key, const std::string& object, const std::string& said, const std::string& why,
             const std::string& remedy);
    void warn(const std::string& key, const std::string& object, const std::string& said, const std::string& why,
              const std::string& remedy);
    /// A key the user meant when writing another, unknown one: do not also report it as missing.
    void expect_instead(const std::string& key) { keys_.insert(key); }

    [[nodiscard]] bool has(const std::string& key) const { return keys_.contains(key); }
    /// Of any entry of a list of tables: has_in_entries("stage", "name") asks for stage[0].name, stage[1].name and so on.
    [[nodiscard]] bool has_in_entries(const std::string& section, const std::string& key) const;
    [[nodiscard]] std::vector<Problem> errors() const;
    [[nodiscard]] std::vector<Problem> warnings() const;

  private:
    std::vector<Problem> problems_;
    std::set<std::string> keys_;
    std::size_t errors_ = 0;
};

/// What is wrong with one value.
struct Complaint
{
    std::string item;      ///< "[3]" when an item of a list is to blame
    const TomlNode* node;  ///< what to point at and to show
    std::string why;
    std::string remedy;
};

/// Does the value suit the key: type, range, choices? Returns none or one complaint.
std::vector<Complaint> find_complaint(const KeySpec& key, const TomlNode& value);

/// "a number in m", "one of \"x\", \"y\"", for messages and the documentation.
std::string describe_type(const KeySpec& key);
/// `"a", "b", "c"`
std::string quoted_list(const std::vector<std::string>& names);
}  // namespace hdem
