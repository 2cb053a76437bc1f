// Problems of parameters and the exceptions that core throws. Uses the standard library only.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sporeprint {

/// One problem of a set of parameters. `path` is a JSON pointer ("/cap/radius"), or the query name
/// ("cap.radius") if a query was read; `message` names the value and what is allowed.
struct Problem {
    std::string path, message;
    bool operator==(const Problem&) const = default;
};

/// The greatest number of problems in one response, so that hostile input cannot make it unbounded.
inline constexpr std::size_t most_problems = 100;

/// Appends a problem, or drops it when `most_problems` are already listed.
inline void report(std::vector<Problem>& problems, std::string path, std::string message) {
    if (problems.size() < most_problems) problems.push_back({std::move(path), std::move(message)});
}

/// Thrown when the caller's data breaks a stated precondition; carries every problem found.
class InvalidInput : public std::invalid_argument {
  public:
    explicit InvalidInput(std::vector<Problem> problems)
        : std::invalid_argument(joined(problems)), problems_(std::move(problems)) {}

    InvalidInput(std::string path, std::string message)
        : InvalidInput(std::vector<Problem>{{std::move(path), std::move(message)}}) {}

    const std::vector<Problem>& problems() const noexcept { return problems_; }

  private:
    static std::string joined(const std::vector<Problem>& problems) {
        std::string text;
        for (const Problem& problem : problems) {
            if (!text.empty()) text += "; ";
            if (!problem.path.empty()) text += problem.path + ": ";
            text += problem.message;
        }
        return text;
    }

    std::vector<Problem> problems_;
};

/// Thrown when each value is allowed but the combination cannot be made: a crossing outline, a stem
/// that folds, pores requested of a species with gills.
class Impossible : public InvalidInput {
  public:
    using InvalidInput::InvalidInput;
};

/// Thrown when a computation fails: no convergence, a result that is not finite.
class GenerationError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Thrown by a long loop whose stop token was triggered.
class Cancelled : public std::exception {
  public:
    const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace sporeprint
