#include "core/trace/trace.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/math/elementary.h"
#include "core/math/spline.h"
#include "core/problems.h"
#include "core/trace/axis.h"
#include "core/trace/cut.h"
#include "core/trace/fit.h"
#include "core/trace/marks.h"
#include "core/trace/profile.h"

namespace sporeprint::trace {

namespace {

constexpr int least_height = 120;  ///< pixels

/// Smoothing of the contour, of the height.
constexpr double smoothing = 0.0028;

/// The sharpest bend of an axis, as its curvature times the stem's radius; at 1 the stem would fold.
constexpr double sharpest = 0.8;

/// The rows and columns that a mask reaches.
struct Extent {
    int left, top, right, bottom;
};

Extent extent_of(const Mask& mask) {
    Extent extent{mask.width, mask.height, -1, -1};
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y))
                extent = {std::min(extent.left, x), std::min(extent.top, y),
                          std::max(extent.right, x), std::max(extent.bottom, y)};
    return extent;
}

void require_whole(const Mask& mask, const Extent& extent) {
    const int height = extent.bottom - extent.top + 1;
    if (height < least_height)
        throw InvalidInput("/photo", "the mushroom is " + std::to_string(std::max(height, 0)) +
                                         " pixels high; at least " + std::to_string(least_height) +
                                         " are needed");
    const char* border = extent.left == 0                   ? "left"
                         : extent.right == mask.width - 1   ? "right"
                         : extent.top == 0                  ? "upper"
                         : extent.bottom == mask.height - 1 ? "lower"
                                                            : nullptr;
    if (border)
        throw InvalidInput("/photo", std::string("the mushroom is cut off by the ") + border +
                                         " border of the photograph");
}

/// Returns the greatest curvature of an axis of unit length.
double curvature_of(const std::vector<AxisPoint>& axis) {
    std::vector<glm::dvec3> points;
    points.reserve(axis.size());
    for (const AxisPoint& at : axis) points.emplace_back(at.x, at.y, at.z);
    double greatest = 0.0;
    for (const SplineSegment<glm::dvec3>& segment : open_spline(points))
        for (int k = 0; k <= 4; ++k) {
            const SplineSample<glm::dvec3> at = segment.at(0.25 * k);
            const double speed = glm::length(at.derivative);
            if (speed > 1e-9)
                greatest = std::max(greatest,
                                    glm::length(glm::cross(at.derivative, at.second_derivative)) /
                                        (speed * speed * speed));
        }
    return greatest;
}

/// Returns an axis whose deviation from the line between its ends is a share of what it was.
std::vector<AxisPoint> straighter(const std::vector<AxisPoint>& axis, double share) {
    std::vector<AxisPoint> points = axis;
    const AxisPoint &from = axis.front(), &to = axis.back();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(points.size() - 1);
        points[i].x = share * points[i].x + (1.0 - share) * (from.x + t * (to.x - from.x));
        points[i].y = share * points[i].y + (1.0 - share) * (from.y + t * (to.y - from.y));
    }
    return points;
}

/// Bends an axis less until the stem does not fold.
void unfold(Traced& found) {
    double radius = 0.0, low = 0.0, high = 0.0;
    for (const OutlinePoint& point : found.shape.silhouette.stem) {
        radius = std::max(radius, point.r);
        low = std::min(low, point.y);
        high = std::max(high, point.y);
    }
    const double relative = radius / std::max(high - low, 1e-9);
    const std::vector<AxisPoint> measured = found.shape.axis;
    for (double share = 1.0;
         share > 0.01 && curvature_of(found.shape.axis) * relative > sharpest;) {
        share *= 0.75;
        found.shape.axis = straighter(measured, share);
        found.method = TraceMethod::straightened;
    }
}

double angle_of(const AxisPoint& from, const AxisPoint& to) {
    return arc_tangent(to.x - from.x, to.y - from.y) * (180.0 / pi);
}

}  // namespace

Traced traced(const Mask& mask, const Gesture& gesture, double height_m) {
    const Extent extent = extent_of(mask);
    require_whole(mask, extent);
    const double height = extent.bottom - extent.top + 1.0;
    const Contour contour = contour_of(mask, smoothing * height);
    // The first axis tells where the stem ends; middles in the cap then do not count.
    const TracedAxis rough = axis_of(contour, gesture.axis);
    const Marks of_rough = marks_of(contour, rough, height);
    const TracedAxis axis = axis_of(contour, gesture.axis, rough.at(of_rough.stem_top));
    const Marks marks = marks_of(contour, axis, height);
    const Profile profile = profile_of(contour, axis, marks, height);
    const FittedShape fitted = fitted_shape(profile, axis, marks, height, height_m);

    Traced found;
    found.shape.silhouette = fitted.silhouette;
    found.shape.axis = fitted.axis;
    found.error = fitted.error;
    found.asymmetry = profile.asymmetry;
    unfold(found);
    const std::vector<AxisPoint>& points = found.shape.axis;
    found.lean_deg = angle_of(points.front(), points.back());
    found.bend_deg = std::abs(angle_of(points[points.size() - 2], points.back()) -
                              angle_of(points[0], points[1]));
    const double scale = height_m / height;
    if (profile.ring)
        found.ring = RingMeasure{profile.ring->height * scale, profile.ring->width * scale};
    found.left = marks.sides[0].points;
    found.right = marks.sides[1].points;
    found.axis = axis.points();
    for (std::size_t k = 0; k < 2; ++k) {
        const ContourSide& side = marks.sides[k];
        found.junctions[k] = side.points[side.junction];
        found.margins[k] = side.points[side.margin];
    }
    return found;
}

Traced traced(const Picture& photo, const Gesture& gesture, double height_m) {
    const Mask mask = cut_out(photo, gesture);
    const double factor = static_cast<double>(mask.width) / photo.width;
    Traced found = traced(mask, gesture.scaled(factor), height_m);
    const auto back = [factor](glm::dvec2& point) { point /= factor; };
    for (std::vector<glm::dvec2>* line : {&found.left, &found.right, &found.axis})
        std::for_each(line->begin(), line->end(), back);
    std::for_each(found.junctions.begin(), found.junctions.end(), back);
    std::for_each(found.margins.begin(), found.margins.end(), back);
    return found;
}

}  // namespace sporeprint::trace
