#pragma once
/// Where everything a case says was said: the way from a problem's key to file:line:col.

#include "core/check.h"
#include "io/toml_tree.h"

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace hdem
{
class CaseSource
{
  public:
    CaseSource() = default;
    /// @param file name of the case file as the user gave it; it is source 0 of every Place
    CaseSource(std::string file, std::string text);

    [[nodiscard]] const std::string& file() const { return sources_.front(); }
    /// The case file, byte for byte.
    [[nodiscard]] const std::string& text() const { return text_; }

    /// Another text that keys may come from: "--set joint.default.cohesion=0", "blocks.wkt". Returns the number for Place::source.
    int add_source(std::string name);
    /// @param key like "joint_set[1].spacing" or "joint.default.cohesion"
    void add(std::string key, const Place& at);

    /// Was this key written by the user (file or --set)?
    [[nodiscard]] bool given(const std::string& key) const { return places_.contains(key); }
    /// Where the key stands, else where its nearest parent stands, else the file as a whole.
    [[nodiscard]] Place place(std::string_view key) const;

    /// "file:line:col: text" as printed for the user; a warning has "warning: " before its text.
    [[nodiscard]] std::string located(const Problem& problem) const;
    /// The same problems, each with its place in front of its text, in the order of the file.
    [[nodiscard]] std::vector<Problem> located(std::vector<Problem> problems) const;

  private:
    std::vector<std::string> sources_ = {""};
    std::string text_;
    std::unordered_map<std::string, Place> places_;
};
}  // namespace hdem
