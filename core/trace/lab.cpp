#include "core/trace/lab.h"

#include <algorithm>

#include "core/math/elementary.h"

namespace sporeprint::trace {

namespace {

constexpr double knee = 216.0 / 24389.0, slope = 24389.0 / 27.0;

/// The white point of daylight; its luminance is 1.
constexpr double white_x = 0.9505, white_z = 1.0890;

}  // namespace

glm::dvec3 lab_of(const glm::dvec3& rgb) {
    const double r = srgb_to_linear(rgb.x / 255.0), g = srgb_to_linear(rgb.y / 255.0),
                 b = srgb_to_linear(rgb.z / 255.0);
    const auto scaled = [](double share) {
        return share > knee ? power(share, 1.0 / 3.0) : (slope * share + 16.0) / 116.0;
    };
    const double x = scaled((0.4124 * r + 0.3576 * g + 0.1805 * b) / white_x),
                 y = scaled(0.2126 * r + 0.7152 * g + 0.0722 * b),
                 z = scaled((0.0193 * r + 0.1192 * g + 0.9505 * b) / white_z);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

glm::dvec3 rgb_of(const glm::dvec3& lab) {
    const auto share = [](double scaled) {
        const double cube = scaled * scaled * scaled;
        return cube > knee ? cube : (116.0 * scaled - 16.0) / slope;
    };
    const double middle = (lab.x + 16.0) / 116.0;
    const double x = white_x * share(middle + lab.y / 500.0), y = share(middle),
                 z = white_z * share(middle - lab.z / 200.0);
    const auto encoded = [](double linear) {
        return 255.0 * linear_to_srgb(std::clamp(linear, 0.0, 1.0));
    };
    return {encoded(3.2406 * x - 1.5372 * y - 0.4986 * z),
            encoded(-0.9689 * x + 1.8758 * y + 0.0415 * z),
            encoded(0.0557 * x - 0.2040 * y + 1.0570 * z)};
}

}  // namespace sporeprint::trace
