#include "core/trace/outline_check.h"

#include <charconv>
#include <string_view>

#include "core/problems.h"
#include "core/silhouette/outline.h"
#include "core/trace/fit.h"

namespace sporeprint::trace {

std::optional<OutlineProblem> outline_problem(const OutlineSpec& spec) {
    try {
        const Outline proven(spec.silhouette, "");
    } catch (const Impossible& crossing) {
        // The path of the problem is "/curve/index".
        const Problem& found = crossing.problems().front();
        const std::string_view path = std::string_view(found.path).substr(1);
        const std::size_t slash = path.find('/');
        OutlineProblem problem{std::string(path.substr(0, slash)), 0, found.message};
        const std::string_view index =
            slash == std::string_view::npos ? std::string_view() : path.substr(slash + 1);
        std::from_chars(index.data(), index.data() + index.size(), problem.index);
        return problem;
    }
    if (!spec.axis.empty() && unfolded(spec.axis, spec.silhouette) != spec.axis)
        return OutlineProblem{"axis", 0, "the stem folds on this axis; bend it less"};
    return std::nullopt;
}

}  // namespace sporeprint::trace
