// Helpers for problems that core reports.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/problems.h"

namespace sporeprint {

/// Returns the problems with which `work` is refused; empty if it succeeds.
template <class Work>
std::vector<Problem> refusal(const Work& work) {
    try {
        work();
    } catch (const InvalidInput& refused) {
        return refused.problems();
    }
    return {};
}

/// Succeeds if `problems` has one with this path and these words in its message.
inline ::testing::AssertionResult names(const std::vector<Problem>& problems,
                                        const std::string& path, const std::string& words = "") {
    auto result = ::testing::AssertionFailure() << "no problem \"" << path << ": " << words << "\"";
    for (const Problem& problem : problems) {
        if (problem.path == path && problem.message.find(words) != std::string::npos)
            return ::testing::AssertionSuccess();
        result << "\n  " << problem.path << ": " << problem.message;
    }
    return result;
}

}  // namespace sporeprint
