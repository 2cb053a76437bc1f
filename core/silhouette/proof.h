// Proofs that a morphing polyline never self-intersects: exact for all moments between two shapes,
// and by certificates for all weighted means of many shapes.
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

/// The method by which the outlines of a morph are known to be simple. exact: all moments between
/// two shapes, by first_intersection(); certificate: all weighted means, by first_unproven_pair();
/// checked: not known in advance, each outline is tested when it is requested.
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

/// A moment t in [0, 1] at which segments i and j (from vertex i to i + 1) of a moving polyline
/// touch; j = i + 1 where the polyline folds back on itself, j = i where vertex i is on the wrong
/// side of the axis.
struct Intersection {
    double t = 0.0;
    std::size_t i = 0, j = 0;
    bool operator==(const Intersection&) const = default;
};

/// Returns the first intersection of a static polyline, with t = 0: where it touches itself, folds
/// back, or leaves r >= 0 (r > 0 between its ends); none if it is simple. Edges of zero length are
/// skipped, because a sub-curve may be a point.
[[nodiscard]] std::optional<Intersection> static_intersection(std::span<const glm::dvec2> polyline);

/// Returns the first moment at which the polyline (1 - t) a + t b touches itself, folds back, or
/// leaves r >= 0 (r > 0 between its ends). Edges are skipped at the moments when their length is
/// zero: a sub-curve may shrink to a point at t = 0 or 1.
///
/// a, b     equally many vertices, at least 2
/// returns  none if simple for every t in [0, 1]. Roots nearer than 1e-9 to t = 0 or 1 belong to a
///          and b themselves, which are checked separately
/// cost     O(n^2), boxes first; 0.01 ms for 70 vertices
/// source   orientation of three linearly moving points is a quadratic in t; the first touch of two
///          segments is one of four roots
[[nodiscard]] std::optional<Intersection> first_intersection(std::span<const glm::dvec2> a,
                                                             std::span<const glm::dvec2> b);

/// Returns the first intersection with 0 < t < 1, like first_intersection(); none if there is none.
///
/// pre  a and b are simple by static_intersection()
[[nodiscard]] std::optional<Intersection> intersection_between(std::span<const glm::dvec2> a,
                                                               std::span<const glm::dvec2> b);

/// A pair of segments for which a set of polylines is not certified: i and j have no common
/// separating line; j = i + 1 where they may fold back on each other, j = i where vertex i may
/// leave the right side of the axis.
struct UnprovenPair {
    std::size_t i = 0, j = 0;
    bool operator==(const UnprovenPair&) const = default;
};

/// Tries to prove that every weighted mean of the polylines is simple with r >= 0. The test is
/// sufficient, not necessary. A pair of segments is separated by a direction d with d.(p - q) > 0
/// for all their points in all shapes (hence also in all means), or by the line through one of
/// them: its sides, bilinear in the weights, have one sign for every pair of shapes.
///
/// shapes   at least one, equally many vertices
/// returns  the first pair that is not proven, none if certified
/// cost     O(n^2 shapes), where lines are needed O(shapes^2) more for the pair
/// source   both are linear certificates: convex combinations preserve what holds for all corners
[[nodiscard]] std::optional<UnprovenPair> first_unproven_pair(std::span<const Polyline> shapes);

/// Returns all unproven pairs in the order of first_unproven_pair(): the axis first.
[[nodiscard]] std::vector<UnprovenPair> unproven_pairs(std::span<const Polyline> shapes);

/// Returns those of the pairs `among` that stay unproven for these polylines. They are all that are
/// unproven if each polyline is a weighted mean of others whose unproven pairs are `among`, because
/// what holds for all means of those holds for these.
[[nodiscard]] std::vector<UnprovenPair> unproven_pairs(std::span<const Polyline> shapes,
                                                       std::span<const UnprovenPair> among);

/// Returns the first pair of non-adjacent segments of a polyline that touch, or none if it is
/// simple. The result is exact for the given coordinates up to rounding of one orientation test.
///
/// cost  O(n^2), boxes first
[[nodiscard]] std::optional<std::array<std::size_t, 2>> first_crossing(
    std::span<const glm::dvec2> polyline);

}  // namespace sporeprint
