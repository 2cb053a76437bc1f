// Proofs that a morphing polyline never touches itself: exactly between two shapes for every moment, and for all weighted means of many shapes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/params/describe.h"

namespace sporeprint {

/// The polyline of an outline, base to apex, (r, y).
using Polyline = std::vector<glm::dvec2>;

/// How it is known that an outline is simple.
enum class ProofMethod : std::uint8_t { exact, certificate, checked };

constexpr const char* name(ProofMethod method) {
    switch (method) {
        case ProofMethod::exact:
            return "exact";
        case ProofMethod::certificate:
            return "certificate";
        case ProofMethod::checked:
            return "checked";
    }
    return nullptr;
}

/// A moment at which segments i and j (from vertex i to i + 1) of a moving polyline touch, t in [0, 1];
/// j = i + 1 where the polyline folds back on itself, j = i where vertex i is on the wrong side of the axis.
struct Contact {
    double t = 0.0;
    std::size_t i = 0, j = 0;
    bool operator==(const Contact&) const = default;
};

/// Where a polyline at rest touches itself, folds back, or leaves r >= 0 (r > 0 between its ends); its t is 0. Edges of no length are
/// skipped: a sub-curve may be a point.
[[nodiscard]] std::optional<Contact> contact_at_rest(std::span<const glm::dvec2> polyline);

/// The first moment at which the polyline (1 - t) a + t b touches itself, folds back, or leaves r >= 0 (r > 0 between its ends).
/// Edges of no length are skipped at the moments when they have none: a sub-curve may shrink to a point there, at t = 0 or 1.
///
/// a, b     equally many vertices, at least 2
/// returns  none: simple for every t in [0, 1]. Roots nearer than 1e-9 to t = 0 or 1 belong to a and b themselves, which are checked apart
/// cost     O(n^2), boxes first; 0.01 ms for 70 vertices
/// source   orientation of three linearly moving points is a quadratic in t; the first touch of two segments is one of four roots
[[nodiscard]] std::optional<Contact> first_contact(std::span<const glm::dvec2> a,
                                                   std::span<const glm::dvec2> b);

/// The same where a and b are known to be simple: what happens strictly between them.
[[nodiscard]] std::optional<Contact> contact_on_the_way(std::span<const glm::dvec2> a,
                                                        std::span<const glm::dvec2> b);

/// Why a set of polylines is not certified: segments i and j have no common line between them; j = i + 1 where they may fold back
/// on each other, j = i where vertex i may leave the right side of the axis.
struct Doubt {
    std::size_t i = 0, j = 0;
    bool operator==(const Doubt&) const = default;
};

/// Whether every weighted mean of the polylines is known to be simple with r >= 0. What is proven holds; what is not may still be true.
/// A pair of segments is kept apart by a direction d with d.(p - q) > 0 for all their points in all shapes (then also in all means),
/// or by the line through one of them: its sides, bilinear in the weights, have one sign for every pair of shapes.
///
/// shapes   at least one, equally many vertices
/// returns  none if certified
/// cost     O(n^2 shapes), where lines are needed O(shapes^2) more for the pair
/// source   both are linear certificates: convex combinations keep what holds for all corners
[[nodiscard]] std::optional<Doubt> first_doubt(std::span<const Polyline> shapes);

/// All that first_doubt() might tell, in its order: the axis first.
[[nodiscard]] std::vector<Doubt> doubts(std::span<const Polyline> shapes);

/// Those of some doubts that these polylines do not dispel either: all that are left where each polyline is a weighted mean of others
/// whose doubts they were, for what holds for all means of those holds for these.
[[nodiscard]] std::vector<Doubt> doubts(std::span<const Polyline> shapes,
                                        std::span<const Doubt> among);

/// First pair of segments of a polyline that touch without being neighbours; none if it is simple.
/// Exact for the given coordinates up to rounding of one orientation test. cost O(n^2), boxes first
[[nodiscard]] std::optional<std::array<std::size_t, 2>> first_crossing(
    std::span<const glm::dvec2> polyline);

}  // namespace sporeprint
