#include "core/trace/marked_outline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "core/params/messages.h"
#include "core/problems.h"

namespace sporeprint::trace {

namespace {

/// Fewer points than these are no side, and fewer no axis.
constexpr std::size_t least_side_points = 8, least_axis_points = 2;

constexpr double least_height = 120.0;  ///< pixels

/// How far a mark may be from its side, and the ends of both sides from each other, of the height.
constexpr double near_side = 0.02, near_end = 0.01;

/// A junction is at least so high above the foot, of the height, or its stem is none.
constexpr double least_stem = 0.01;

constexpr std::array<const char*, 2> side_names = {"left", "right"};

glm::dvec2 hundredths(const glm::dvec2& at) {
    return {std::floor(at.x * 100.0 + 0.5) / 100.0, std::floor(at.y * 100.0 + 0.5) / 100.0};
}

/// Returns at most so many points of a line, with both ends and some more of its places.
std::vector<glm::dvec2> thinned(const std::vector<glm::dvec2>& points,
                                const std::vector<std::size_t>& places) {
    constexpr std::size_t most = MarkedOutline::most_points;
    std::vector<std::size_t> chosen;
    const std::size_t last = points.size() - 1;
    if (points.size() <= most) {
        for (std::size_t i = 0; i <= last; ++i) chosen.push_back(i);
    } else {
        const std::size_t count = most - places.size();
        for (std::size_t k = 0; k < count; ++k) chosen.push_back(last * k / (count - 1));
        chosen.insert(chosen.end(), places.begin(), places.end());
        std::sort(chosen.begin(), chosen.end());
        chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    }
    std::vector<glm::dvec2> found;
    found.reserve(chosen.size());
    for (const std::size_t i : chosen) found.push_back(hundredths(points[i]));
    return found;
}

/// A place on a line: between a point and the next one.
struct Place {
    std::size_t index = 0;
    double share = 0.0;  ///< of the way to the next point
    double away = 1e300;
};

Place nearest_on(const std::vector<glm::dvec2>& line, const glm::dvec2& point) {
    Place best;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 along = line[i + 1] - line[i];
        const double square = glm::dot(along, along);
        const double share =
            square > 0.0 ? std::clamp(glm::dot(point - line[i], along) / square, 0.0, 1.0) : 0.0;
        const double away = glm::length(point - line[i] - share * along);
        if (away < best.away) best = {i, share, away};
    }
    return best;
}

/// Returns the index of the point of a line that is nearest to a place on it; one is added where there is none.
std::size_t point_at(std::vector<glm::dvec2>& line, const glm::dvec2& mark) {
    constexpr double same = 1e-3;  // pixels
    const Place place = nearest_on(line, mark);
    const glm::dvec2 from = line[place.index], along = line[place.index + 1] - from;
    if (place.share * glm::length(along) < same) return place.index;
    if ((1.0 - place.share) * glm::length(along) < same) return place.index + 1;
    line.insert(line.begin() + static_cast<std::ptrdiff_t>(place.index) + 1,
                from + place.share * along);
    return place.index + 1;
}

double height_of(const MarkedOutline& outline) {
    double top = 1e300, bottom = -1e300;
    for (const auto* side : {&outline.left, &outline.right})
        for (const glm::dvec2& point : *side) {
            top = std::min(top, point.y);
            bottom = std::max(bottom, point.y);
        }
    return bottom - top;
}

std::string place_text(const glm::dvec2& at) {
    const glm::dvec2 shown = hundredths(at);
    return "[" + number_text(shown.x) + "," + number_text(shown.y) + "]";
}

/// Reports what is wrong with the lines of an outline.
void check_lines(const MarkedOutline& outline, std::vector<Problem>& problems) {
    const std::array<const std::vector<glm::dvec2>*, 2> sides = {&outline.left, &outline.right};
    for (std::size_t k = 0; k < 2; ++k)
        if (sides[k]->size() < least_side_points)
            report(problems, std::string("/outline/") + side_names[k],
                   std::to_string(sides[k]->size()) + " points; at least " +
                       std::to_string(least_side_points) + " are needed");
    if (outline.axis.size() < least_axis_points)
        report(problems, "/outline/axis",
               std::to_string(outline.axis.size()) + " points; at least " +
                   std::to_string(least_axis_points) + " are needed");
    if (!problems.empty()) return;
    const double height = height_of(outline);
    if (height < least_height) {
        report(problems, "/outline",
               "is " + number_text(hundredths({height, 0.0}).x) + " pixels high; at least " +
                   number_text(least_height) + " are needed");
        return;
    }
    const glm::dvec2 foot = outline.left.front(), apex = outline.left.back();
    if (glm::length(outline.right.front() - foot) > near_end * height)
        report(problems, "/outline/right",
               "begins at " + place_text(outline.right.front()) + " and the left side at " +
                   place_text(foot) + "; both begin at the foot");
    if (glm::length(outline.right.back() - apex) > near_end * height)
        report(problems, "/outline/right",
               "ends at " + place_text(outline.right.back()) + " and the left side at " +
                   place_text(apex) + "; both end at the apex");
    if (glm::length(apex - foot) < 0.1 * height)
        report(problems, "/outline/left",
               "ends where it begins; it leads from the foot to the apex");
    const glm::dvec2 from = outline.axis.front(), to = outline.axis.back();
    if (glm::length(from - foot) > glm::length(from - apex) ||
        glm::length(to - apex) > glm::length(to - foot) ||
        arc_lengths(outline.axis).back() < 0.3 * glm::length(apex - foot))
        report(problems, "/outline/axis", "does not lead from the foot to the apex");
    if (!problems.empty()) return;
    const TracedAxis axis(outline.axis);
    std::array<double, 2> mean{};
    for (std::size_t k = 0; k < 2; ++k)
        for (const glm::dvec2& point : *sides[k])
            mean[k] += axis.local(point).x / static_cast<double>(sides[k]->size());
    if (mean[0] >= mean[1])
        report(problems, "/outline/left", "is to the right of the right side; exchange them");
}

/// Reports what is wrong with the marks on one side.
void check_marks(const MarkedOutline& outline, std::size_t k, Form form,
                 std::vector<Problem>& problems) {
    const TracedAxis axis(outline.axis);
    const double height = height_of(outline);
    const std::vector<glm::dvec2>& side = k == 0 ? outline.left : outline.right;
    const double apex = axis.local(side.back()).y;
    const std::string number = "/" + std::to_string(k);
    const auto check_place = [&](const glm::dvec2& mark, const std::string& path) {
        const Place place = nearest_on(side, mark);
        if (place.away > near_side * height)
            report(problems, path,
                   axis.local(mark).y > apex
                       ? std::string("is above the apex")
                       : "is " + number_text(hundredths({place.away, 0.0}).x) +
                             " pixels away from the " + side_names[k] +
                             " side of the outline; at most " +
                             number_text(hundredths({near_side * height, 0.0}).x) + " are allowed");
        else if (place.index + 2 >= side.size() && place.share >= 1.0)
            report(problems, path, "is at the apex; it must be below it");
        return place;
    };
    const std::size_t before = problems.size();
    const Place junction = check_place(outline.junctions[k], "/marks/junctions" + number);
    const Place margin = check_place(outline.margins[k], "/marks/margins" + number);
    if (problems.size() != before) return;
    if (axis.local(outline.junctions[k]).y < least_stem * height)
        report(problems, "/marks/junctions" + number,
               "is less than 1 % of the height above the foot, so that there is no stem");
    if (has_face(form) &&
        std::pair(margin.index, margin.share) <= std::pair(junction.index, junction.share))
        report(problems, "/marks/margins" + number,
               "is not beyond the junction on the way from the foot to the apex");
}

}  // namespace

MarkedOutline reported(const Marks& marks, const TracedAxis& axis) {
    MarkedOutline found;
    for (std::size_t k = 0; k < 2; ++k) {
        const ContourSide& side = marks.sides[k];
        (k == 0 ? found.left : found.right) = thinned(side.points, {side.junction, side.margin});
        found.junctions[k] = hundredths(side.points[side.junction]);
        found.margins[k] = hundredths(side.points[side.margin]);
    }
    found.axis = thinned(axis.points(), {});
    found.cap_turn_deg = marks.cap_turn_deg;
    return found;
}

MarkedOutline scaled(MarkedOutline outline, double factor) {
    const auto scale = [factor](glm::dvec2& point) { point *= factor; };
    for (std::vector<glm::dvec2>* line : {&outline.left, &outline.right, &outline.axis})
        std::for_each(line->begin(), line->end(), scale);
    std::for_each(outline.junctions.begin(), outline.junctions.end(), scale);
    std::for_each(outline.margins.begin(), outline.margins.end(), scale);
    return outline;
}

MarkedOutline rounded(MarkedOutline outline) {
    const auto round = [](glm::dvec2& point) { point = hundredths(point); };
    for (std::vector<glm::dvec2>* line : {&outline.left, &outline.right, &outline.axis})
        std::for_each(line->begin(), line->end(), round);
    std::for_each(outline.junctions.begin(), outline.junctions.end(), round);
    std::for_each(outline.margins.begin(), outline.margins.end(), round);
    return outline;
}

void require_measurable(const MarkedOutline& outline, Form form) {
    std::vector<Problem> problems;
    check_lines(outline, problems);
    if (problems.empty())
        for (std::size_t k = 0; k < 2; ++k) check_marks(outline, k, form, problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

MeasuredOutline measured(const MarkedOutline& outline, Form form) {
    std::array<ContourSide, 2> sides;
    for (std::size_t k = 0; k < 2; ++k) {
        ContourSide& side = sides[k];
        side.points = k == 0 ? outline.left : outline.right;
        side.junction = point_at(side.points, outline.junctions[k]);
        side.margin = side.junction;
        if (!has_face(form)) continue;
        const std::size_t before = side.points.size();
        side.margin = point_at(side.points, outline.margins[k]);
        // A point that was added before the junction moves it on.
        if (side.points.size() > before && side.margin <= side.junction) ++side.junction;
        side.margin = std::max(side.margin, side.junction);
    }
    const double height = height_of(outline);
    TracedAxis axis(outline.axis);
    // The left side goes up, the right one down, and both ends are those of both.
    Contour contour = sides[0].points;
    for (std::size_t i = sides[1].points.size() - 1; i-- > 1;)
        contour.push_back(sides[1].points[i]);
    Marks marks = marks_at(std::move(sides), axis, height, form, outline.cap_turn_deg);
    return {std::move(contour), std::move(axis), std::move(marks), height};
}

}  // namespace sporeprint::trace
