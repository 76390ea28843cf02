#pragma once
/// What the tests of the case reader share: a small legal case and ways to read it.

#include "core/check.h"
#include "io/case_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hdem::test
{
/// Legal, one block on a ground. Tests add lines behind it or replace some of it.
inline const std::string two_blocks = R"([material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 30.0
[[block]]
name = "ground"
polygon = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
fixed = true
[[block]]
name = "top"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[stage]]
cycles = 10
)";

inline CaseDef read(const std::string& text, const std::vector<Override>& overrides = {})
{
    return read_case_text(text, "case.toml", overrides).def;
}

/// Texts of all problems, in the order they would be printed; empty for a legal case.
inline std::vector<std::string> problems_of(const std::string& text, const std::vector<Override>& overrides = {})
{
    std::vector<std::string> lines;
    try
    {
        read_case_text(text, "case.toml", overrides);
    }
    catch (const InputError& error)
    {
        for (const Problem& problem : error.problems())
            lines.push_back(problem.text);
    }
    return lines;
}

/// The text with its only occurrence of `old` replaced.
inline std::string with(std::string text, const std::string& old, const std::string& replacement)
{
    const auto at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    EXPECT_EQ(text.find(old, at + 1), std::string::npos) << old << " occurs twice";
    return text.replace(at, old.size(), replacement);
}
}  // namespace hdem::test
