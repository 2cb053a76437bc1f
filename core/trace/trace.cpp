#include "core/trace/trace.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/math/elementary.h"
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
    const std::vector<AxisPoint> measured = found.shape.axis;
    found.shape.axis = unfolded(measured, found.shape.silhouette);
    if (found.shape.axis != measured) found.method = TraceMethod::straightened;
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
