// Masks of mushrooms whose outline and axis are known exactly.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "core/surface/codecs.h"
#include "core/trace/form.h"
#include "core/trace/gesture.h"
#include "core/trace/photo.h"

namespace sporeprint {

/// An agaric of unit height: a stem on an arc, a cap that is half an ellipse over a flat lower face.
struct DrawnMushroom {
    double stem_top = 0.7;      ///< length of the stem
    double stem_radius = 0.06;  ///< of the stem
    double cap_radius = 0.35;   ///< of the cap
    double bend_deg = 0.0;      ///< of the axis from the foot to the top of the stem, to the right
    double lean_deg = 0.0;      ///< of the axis at the foot, to the right
    double cap_turn_deg = 0.0;  ///< of the cap against the stem, to the right
    double pixels = 700.0;      ///< of a unit
    int side = 1000;            ///< of the photograph
    double ring_width = 0.0;    ///< how far a ring at 0.45 stands out

    [[nodiscard]] glm::dvec2 foot() const { return {0.5 * side, 0.93 * side}; }

    /// Returns the point of the axis at an arc length, in pixels of the photograph.
    [[nodiscard]] glm::dvec2 axis(double arc) const {
        glm::dvec2 at = foot();
        constexpr int steps = 400;
        for (int k = 0; k < steps; ++k) at += pixels * arc / steps * up((k + 0.5) * arc / steps);
        return at;
    }
    [[nodiscard]] glm::dvec2 up(double arc) const {
        const double turn = radians(lean_deg + bend_deg * std::min(arc, stem_top) / stem_top);
        return {std::sin(turn), -std::cos(turn)};
    }
    [[nodiscard]] double apex() const { return 0.3; }  ///< height of the cap

    /// Returns the outline as a closed polygon.
    [[nodiscard]] std::vector<glm::dvec2> outline() const {
        std::vector<glm::dvec2> half[2];
        for (int k = 0; k < 2; ++k) {
            const double sign = k == 0 ? -1.0 : 1.0;
            for (double arc = 0.0; arc <= stem_top + 1e-9; arc += 0.0025) {
                const glm::dvec2 u = up(arc);
                const double ring = std::abs(arc - 0.45) < 0.015 ? ring_width : 0.0;
                half[k].push_back(axis(arc) +
                                  sign * pixels * (stem_radius + ring) * glm::dvec2(-u.y, u.x));
            }
            const double turn = radians(lean_deg + bend_deg + cap_turn_deg);
            const glm::dvec2 cap_up(std::sin(turn), -std::cos(turn)), right(-cap_up.y, cap_up.x);
            for (int i = 0; i <= 90; ++i) {
                const double angle = radians(i);
                half[k].push_back(axis(stem_top) +
                                  pixels * (sign * cap_radius * std::cos(angle) * right +
                                            apex() * std::sin(angle) * cap_up));
            }
        }
        half[0].insert(half[0].end(), half[1].rbegin(), half[1].rend());
        return half[0];
    }
    [[nodiscard]] trace::Mask mask() const;
    [[nodiscard]] trace::Gesture gesture() const {
        trace::Gesture made;
        for (const double arc : {0.03, 0.25, 0.5, 0.7, 0.92}) made.axis.push_back(axis(arc));
        return made;
    }
};

/// Returns the pixels whose middles are inside a polygon, by the number of its edges to their left.
inline trace::Mask filled(const std::vector<glm::dvec2>& polygon, int width, int height) {
    trace::Mask mask(width, height);
    for (int y = 0; y < height; ++y) {
        std::vector<double> crossings;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            if ((a.y <= y + 0.5) == (b.y <= y + 0.5)) continue;
            crossings.push_back(a.x + (b.x - a.x) * (y + 0.5 - a.y) / (b.y - a.y));
        }
        for (int x = 0; x < width; ++x) {
            int left = 0;
            for (const double at : crossings) left += at < x + 0.5 ? 1 : 0;
            mask.inside[mask.index(x, y)] = left % 2 == 1 ? 1 : 0;
        }
    }
    return mask;
}

inline trace::Mask DrawnMushroom::mask() const { return filled(outline(), side, side); }

/// A mushroom of unit height with a straight axis, of any form.
struct DrawnForm {
    trace::Form form = trace::Form::club;
    /// Distance from the axis and height: from the foot to the apex, or to the edge that hides the rest.
    std::vector<glm::dvec2> half;
    double stem_top = 0.0;  ///< height at which its stem ends; 0 where that is a matter of taste
    double lean_deg = 0.0;  ///< to the right
    double pixels = 600.0;  ///< of a unit
    int side = 1000;        ///< of the photograph

    [[nodiscard]] glm::dvec2 at(const glm::dvec2& local) const {
        const double turn = radians(lean_deg);
        const glm::dvec2 up(std::sin(turn), -std::cos(turn)), right(-up.y, up.x);
        return glm::dvec2(0.5, 0.85) * static_cast<double>(side) +
               pixels * (local.x * right + local.y * up);
    }
    [[nodiscard]] trace::Mask mask() const {
        std::vector<glm::dvec2> polygon;
        for (const glm::dvec2& point : half) polygon.push_back(at({-point.x, point.y}));
        for (std::size_t i = half.size(); i-- > 0;) polygon.push_back(at(half[i]));
        return filled(polygon, side, side);
    }
    [[nodiscard]] trace::Gesture gesture() const {
        trace::Gesture made;
        for (const double height : {0.03, 0.5, 0.95}) made.axis.push_back(at({0.0, height}));
        return made;
    }
};

/// Returns a mushroom of a form.
///
/// form  funnel, morel, club, puffball or cup
inline DrawnForm drawn_form(trace::Form form) {
    DrawnForm drawn;
    drawn.form = form;
    const auto add = [&](double r, double y) { drawn.half.emplace_back(r, y); };
    constexpr int steps = 60;
    // The last part is a quarter of an ellipse up to the apex.
    const auto dome = [&](double r, double from) {
        for (int k = 0; k <= steps; ++k) {
            const double angle = 0.5 * pi * k / steps;
            add(r * std::cos(angle), from + (1.0 - from) * std::sin(angle));
        }
    };
    add(0.0, 0.0);
    for (int k = 0; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps, smooth = t * t * (3.0 - 2.0 * t);
        switch (form) {
            case trace::Form::funnel:
                if (k == 0) add(0.09, 0.0);
                add(0.09 + 0.33 * t * t, 0.5 + 0.5 * t);
                break;
            case trace::Form::cup:
                if (k == 0) add(0.12, 0.0);
                add(0.12 + 0.62 * std::sin(0.5 * pi * t),
                    0.12 + 0.88 * (1.0 - std::cos(0.5 * pi * t)));
                break;
            case trace::Form::puffball:
                if (k == 0) add(0.16, 0.0);
                add(0.16 + 0.18 * smooth, 0.2 + 0.42 * t);
                break;
            case trace::Form::morel:
                add(0.15 - 0.03 * t, 0.4 * t);
                break;
            default:
                add(0.05 + 0.06 * smooth, 0.88 * t);
        }
    }
    if (form == trace::Form::funnel) drawn.stem_top = 0.6;
    if (form == trace::Form::cup) drawn.stem_top = 0.14;
    if (form == trace::Form::puffball) drawn.stem_top = 0.3;
    if (form == trace::Form::morel) {
        drawn.stem_top = 0.4;
        dome(0.24, 0.41);
    }
    if (form == trace::Form::puffball) dome(0.34, 0.62);
    if (form == trace::Form::club) dome(0.11, 0.88);
    return drawn;
}

/// Returns a photograph of it, pale before green.
inline Picture photograph_of(const DrawnMushroom& drawn) {
    const trace::Mask mask = drawn.mask();
    Picture photo{drawn.side, drawn.side, {}};
    photo.rgb.reserve(3 * mask.inside.size());
    for (const std::uint8_t inside : mask.inside)
        for (const int base :
             {inside != 0 ? 190 : 40, inside != 0 ? 150 : 90, inside != 0 ? 110 : 30})
            photo.rgb.push_back(static_cast<std::uint8_t>(base));
    return photo;
}

}  // namespace sporeprint
