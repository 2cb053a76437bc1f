// Whether an outline that a person has drawn can be grown.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/model/swept.h"

namespace sporeprint::trace {

/// An outline and the axis that it is swept along.
struct OutlineSpec {
    Silhouette silhouette;
    std::vector<AxisPoint> axis;

    static constexpr void fields(auto visit) {
        visit(&OutlineSpec::silhouette,
              Info{.name = "silhouette", .doc = "Outline in the half-plane of the axis."});
        visit(&OutlineSpec::axis,
              Info{.name = "axis",
                   .min = -2.0,
                   .max = 2.0,
                   .most = 32,
                   .doc = "Control points of the axis from the root to the top of the stem, in "
                          "stem heights; none for a straight one."});
    }
    /// Reports a missing outline.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (silhouette == Silhouette{}) report(problems, path + "/silhouette", "is missing");
    }
    bool operator==(const OutlineSpec&) const = default;
};

/// What is wrong with an outline, and where.
struct OutlineProblem {
    std::string curve;      ///< stem, hymenium, cap, or axis
    std::size_t index = 0;  ///< of the control point; 0 for the axis
    std::string detail;     ///< a sentence
};

/// Returns where an outline crosses itself, reaches the axis between its ends, or folds on its axis; none if it
/// can be grown.
///
/// pre  silhouette.check() found nothing
[[nodiscard]] std::optional<OutlineProblem> outline_problem(const OutlineSpec& spec);

}  // namespace sporeprint::trace
