#include "core/individual/axis_curve.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/math/spline.h"

namespace sporeprint {

namespace {

constexpr int samples_per_segment = 32;

glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(glm::dot(v, v)); }

/// Returns the unit tangents at equal shares of the arc length.
std::vector<glm::dvec3> spline_tangents(const std::vector<glm::dvec3>& points) {
    const auto segments = open_spline(points);
    std::vector<double> arc{0.0};
    std::vector<glm::dvec3> directions{unit(segments.front().leaving)};
    glm::dvec3 last = points.front();
    for (const auto& segment : segments)
        for (int i = 1; i <= samples_per_segment; ++i) {
            const auto s = segment.at(static_cast<double>(i) / samples_per_segment);
            arc.push_back(arc.back() + std::sqrt(glm::dot(s.position - last, s.position - last)));
            directions.push_back(glm::dot(s.derivative, s.derivative) > 1e-18 ? unit(s.derivative)
                                                                              : directions.back());
            last = s.position;
        }
    std::vector<glm::dvec3> tangents;
    std::size_t k = 1;
    for (int i = 0; i <= AxisCurve::stations; ++i) {
        const double target = arc.back() * i / AxisCurve::stations;
        while (k + 1 < arc.size() && arc[k] < target) ++k;
        const double t = arc[k] > arc[k - 1]
                             ? std::clamp((target - arc[k - 1]) / (arc[k] - arc[k - 1]), 0.0, 1.0)
                             : 0.0;
        const glm::dvec3 d = (1.0 - t) * directions[k - 1] + t * directions[k];
        tangents.push_back(glm::dot(d, d) > 1e-18 ? unit(d) : directions[k]);
    }
    return tangents;
}

/// A frame under parallel transport: `across` and `third` complete the tangent `along`.
struct Carried {
    glm::dvec3 across{1.0, 0.0, 0.0}, along{0.0, 1.0, 0.0}, third{0.0, 0.0, 1.0};

    void turn(const glm::dvec2& by) {
        const double angle = std::sqrt(glm::dot(by, by));
        if (angle < 1e-300) return;
        const glm::dvec3 about = (by.x * across + by.y * third) / angle;
        along = unit(turned(along, about, angle));
        across = turned(across, about, angle);
        across = unit(across - glm::dot(across, along) * along);
        third = glm::cross(across, along);
    }
    /// Returns the smallest rotation that takes `along` to `direction`.
    [[nodiscard]] glm::dvec2 turn_to(const glm::dvec3& direction) const {
        const glm::dvec3 about = glm::cross(along, direction);
        const double sine = std::sqrt(glm::dot(about, about)), cosine = glm::dot(along, direction);
        // The smallest rotation to the opposite direction is not unique; any will do.
        if (sine < 1e-15) return {cosine < 0.0 ? pi : 0.0, 0.0};
        const double angle = arc_tangent(sine, cosine);
        return angle / sine * glm::dvec2(glm::dot(about, across), glm::dot(about, third));
    }
};

}  // namespace

glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& about, double angle) {
    const auto [s, c] = sine_cosine(angle);
    return c * v + s * glm::cross(about, v) + (1.0 - c) * glm::dot(about, v) * about;
}

AxisCurve::AxisCurve(const std::vector<AxisPoint>& controls) {
    std::vector<glm::dvec3> points;
    for (const AxisPoint& p : controls) {
        const glm::dvec3 point(p.x, p.y, p.z);
        if (points.empty() || points.back() != point) points.push_back(point);
    }
    if (points.size() < 2) return;
    const std::vector<glm::dvec3> tangents = spline_tangents(points);
    Carried frame;
    for (std::size_t i = 0; i < turns_.size(); ++i) {
        turns_[i] = frame.turn_to(tangents[i]);
        frame.turn(turns_[i]);
    }
}

void AxisCurve::add(const AxisCurve& other, double weight) {
    for (std::size_t i = 0; i < turns_.size(); ++i) turns_[i] += weight * other.turns_[i];
}

std::vector<glm::dvec3> AxisCurve::tangents() const {
    std::vector<glm::dvec3> tangents;
    tangents.reserve(turns_.size());
    Carried frame;
    for (const glm::dvec2& by : turns_) {
        frame.turn(by);
        tangents.push_back(frame.along);
    }
    return tangents;
}

double AxisCurve::greatest_turn() const {
    double most = 0.0;
    for (std::size_t i = 1; i < turns_.size(); ++i)
        most = std::max(most, std::sqrt(glm::dot(turns_[i], turns_[i])));
    return most * stations;
}

AxisCurve AxisCurve::scaled(double by) const {
    AxisCurve curve;
    curve.add(*this, by);
    return curve;
}

}  // namespace sporeprint
