#include "core/render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"

namespace sporeprint::render {

namespace {

/// Half the angle of view of the shorter side: that of a lens of 85 mm, which distorts little.
constexpr double half_angle_deg = 12.0;

/// Part of the picture on each side that stays empty.
constexpr double margin = 0.05;

/// Returns the tangents of half the angles of view of an image, width by height of which is given.
glm::dvec2 tangents_of(double aspect) {
    const auto [sine, cosine] = sine_cosine(radians(half_angle_deg));
    const double shorter = sine / cosine;
    return {shorter * std::max(aspect, 1.0), shorter * std::max(1.0 / aspect, 1.0)};
}

}  // namespace

CameraAxes camera_axes(double azimuth, double elevation) {
    const auto [sine_a, cosine_a] = sine_cosine(radians(azimuth));
    const auto [sine_e, cosine_e] = sine_cosine(radians(elevation));
    return {glm::vec3(cosine_a, 0.0, -sine_a),
            glm::vec3(-sine_a * sine_e, cosine_e, -cosine_a * sine_e),
            glm::vec3(-sine_a * cosine_e, -sine_e, -cosine_a * cosine_e)};
}

glm::vec3 Camera::seen(const glm::vec3& point) const {
    const glm::vec3 p = point - position;
    return {glm::dot(p, axes.right), glm::dot(p, axes.up), glm::dot(p, axes.forward)};
}

Camera camera_with(const CameraAxes& axes, double aspect) {
    const glm::vec2 tangents(tangents_of(aspect));
    return {axes, glm::vec3(0.0F), tangents.x, tangents.y};
}

glm::dvec2 angles_of(const PictureParams& params, int frame) {
    constexpr double three_quarter = 30.0, elevation = 18.0;
    const double turn = params.turn_deg;
    switch (params.view) {
        case View::three_quarter:
        case View::margin:
        case View::underside:
        case View::base:
            break;
        case View::front:
            return {turn, 3.0};
        case View::top:
            return {turn, 90.0};
        case View::below:
            return {turn + three_quarter, -32.0};
        case View::turntable:
            return {turn + 360.0 * frame / (turntable_columns * turntable_rows), elevation};
    }
    return {turn + three_quarter, elevation};
}

std::vector<Camera> fitted_cameras(const DrawList& list, std::span<const CameraAxes> axes,
                                   double aspect, float lowest) {
    const glm::dvec2 tangents = tangents_of(aspect);
    const double inner_x = tangents.x * (1.0 - 2.0 * margin);
    const double inner_y = tangents.y * (1.0 - 2.0 * margin);
    // A point (x, y, z) in the axes of a camera is within its angle of view to the right if
    // x - a <= (z - c) t, that is x - t z <= a - t c, where the camera is at (a, b, c). The largest
    // x - t z of all points, and the largest of the three other sides, decide where it is.
    double right = -1e30, left = -1e30, upper = -1e30, lower = -1e30;
    for (const Draw& draw : list.draws)
        for (const glm::vec3& at : draw.mesh->positions) {
            glm::vec3 point = draw.placement.point(at);
            point.y = std::max(point.y, lowest);
            for (const CameraAxes& own : axes) {
                const auto x = static_cast<double>(glm::dot(point, own.right)),
                           y = static_cast<double>(glm::dot(point, own.up)),
                           z = static_cast<double>(glm::dot(point, own.forward));
                right = std::max(right, x - inner_x * z);
                left = std::max(left, -x - inner_x * z);
                upper = std::max(upper, y - inner_y * z);
                lower = std::max(lower, -y - inner_y * z);
            }
        }
    const auto aside = static_cast<float>(0.5 * (right - left)),
               above = static_cast<float>(0.5 * (upper - lower)),
               ahead = static_cast<float>(
                   std::min(-(right + left) / (2.0 * inner_x), -(upper + lower) / (2.0 * inner_y)));
    std::vector<Camera> cameras;
    for (const CameraAxes& own : axes)
        cameras.push_back({own, own.right * aside + own.up * above + own.forward * ahead,
                           static_cast<float>(tangents.x), static_cast<float>(tangents.y)});
    return cameras;
}

}  // namespace sporeprint::render
