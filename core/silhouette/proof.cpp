#include "core/silhouette/proof.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>

namespace sporeprint {

namespace {

constexpr double end_tolerance = 1e-9;  // as a share of the whole morph
constexpr double collinearity_tolerance =
    1e-6;  // sine of the angle that rounding may give to three collinear points

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool touch(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x))
        return false;
    if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
        return false;
    const double abc = cross(a, b, c), abd = cross(a, b, d), cda = cross(c, d, a),
                 cdb = cross(c, d, b);
    return ((abc <= 0.0 && abd >= 0.0) || (abc >= 0.0 && abd <= 0.0)) &&
           ((cda <= 0.0 && cdb >= 0.0) || (cda >= 0.0 && cdb <= 0.0));
}

/// The vertices left when edges of zero length are removed, with their original indices.
struct Distinct {
    Polyline points;
    std::vector<std::size_t> owner;

    explicit Distinct(std::span<const glm::dvec2> polyline) {
        for (std::size_t i = 0; i < polyline.size(); ++i)
            if (points.empty() || polyline[i] != points.back()) {
                points.push_back(polyline[i]);
                owner.push_back(i);
            }
    }
};

/// A point that moves at constant velocity.
struct Moving {
    glm::dvec2 at_0, by;

    [[nodiscard]] glm::dvec2 at(double t) const { return at_0 + t * by; }
    Moving operator-(const Moving& other) const { return {at_0 - other.at_0, by - other.by}; }
};

/// The quadratic c0 + c1 t + c2 t^2.
struct Quadratic {
    double c0, c1, c2;

    [[nodiscard]] bool is_zero() const { return c0 == 0.0 && c1 == 0.0 && c2 == 0.0; }

    /// Returns true if its Bernstein coefficients have one sign, so that it has no root in [0, 1].
    [[nodiscard]] bool keeps_sign() const {
        const double middle = c0 + 0.5 * c1, end = c0 + c1 + c2;
        return (c0 > 0.0 && middle > 0.0 && end > 0.0) || (c0 < 0.0 && middle < 0.0 && end < 0.0);
    }

    template <class Visit>
    void roots(const Visit& visit) const {
        const double discriminant = c1 * c1 - 4.0 * c2 * c0;
        if (discriminant < 0.0) return;
        const double q = -0.5 * (c1 + (c1 < 0.0 ? -1.0 : 1.0) * std::sqrt(discriminant));
        if (c2 != 0.0) visit(q / c2);
        if (q != 0.0) visit(c0 / q);
    }
};

Quadratic cross(const Moving& a, const Moving& b) {
    return {cross(a.at_0, b.at_0), cross(a.at_0, b.by) + cross(a.by, b.at_0), cross(a.by, b.by)};
}

Quadratic dot(const Moving& a, const Moving& b) {
    return {glm::dot(a.at_0, b.at_0), glm::dot(a.at_0, b.by) + glm::dot(a.by, b.at_0),
            glm::dot(a.by, b.by)};
}

bool inside(double t) { return t > end_tolerance && t < 1.0 - end_tolerance; }

/// Returns the earliest t strictly inside (0, 1) at which X is on the segment YZ, or 2 if never.
double first_touch(const Moving& x, const Moving& y, const Moving& z) {
    const Moving a = y - x, b = z - x;
    const Quadratic side = cross(a, b);
    double first = 2.0;
    if (side.keeps_sign()) return first;
    const Quadratic between = dot(a, b);  // not positive where X is between Y and Z on their line
    const auto consider = [&](double t) {
        if (!inside(t) || t >= first) return;
        const glm::dvec2 to_y = a.at(t), to_z = b.at(t);
        const double scale = glm::dot(to_y, to_y) + glm::dot(to_z, to_z);
        // Where a sub-curve shrinks to a point at t = 0 or 1 there is a double root, and rounding
        // moves it inwards.
        const bool on_line = std::abs(cross(to_y, to_z)) <= collinearity_tolerance * scale;
        if (on_line && glm::dot(to_y, to_z) <= 1e-12 * scale) first = t;
    };
    if (side.is_zero())
        between.roots(consider);  // always collinear
    else
        side.roots(consider);
    return first;
}

struct Box {
    static constexpr double none = std::numeric_limits<double>::infinity();
    glm::dvec2 low{none, none}, high{-none, -none};

    void add(const glm::dvec2& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
};

/// The pairs of segments of some shapes that are near each other: all except those that an
/// axis-aligned direction separates in every shape, and so in all their means. Distant rows of
/// segments are skipped as a whole.
class Neighbours {
  public:
    explicit Neighbours(std::span<const std::span<const glm::dvec2>> shapes)
        : shapes_(shapes.size()),
          segments_(std::max<std::size_t>(shapes.front().size(), 1) - 1),
          rows_(segments_ / row + 1),
          of_segments_(segments_ * shapes_),
          of_rows_(rows_ * shapes_),
          far_(rows_ * rows_) {
        for (std::size_t i = 0; i < segments_; ++i)
            for (std::size_t s = 0; s < shapes_; ++s) {
                Box& box = of_segments_[i * shapes_ + s];
                box.add(shapes[s][i]);
                box.add(shapes[s][i + 1]);
                of_rows_[i / row * shapes_ + s].add(box);
            }
        for (std::size_t i = 0; i < rows_; ++i)
            for (std::size_t j = i + 1; j < rows_; ++j)
                far_[i * rows_ + j] = apart(&of_rows_[i * shapes_], &of_rows_[j * shapes_]);
    }

    /// Returns the first segment from `j` on that is near segment `i`, or the number of segments if
    /// there is none.
    [[nodiscard]] std::size_t next(std::size_t i, std::size_t j) const {
        const Box* own = &of_segments_[i * shapes_];
        const auto far_row = [&](std::size_t other) {
            return far_[i / row * rows_ + other] || apart(own, &of_rows_[other * shapes_]);
        };
        while (j < segments_) {
            if (j % row == 0 && far_row(j / row))
                j += row;
            else if (apart(own, &of_segments_[j * shapes_]))
                ++j;
            else
                return j;
        }
        return segments_;
    }

  private:
    static constexpr std::size_t row = 8;

    [[nodiscard]] bool apart(const Box* a, const Box* b) const {
        for (const int axis : {0, 1}) {
            bool before = true, after = true;
            for (std::size_t s = 0; s < shapes_ && (before || after); ++s) {
                before = before && a[s].high[axis] < b[s].low[axis];
                after = after && b[s].high[axis] < a[s].low[axis];
            }
            if (before || after) return true;
        }
        return false;
    }

    std::size_t shapes_, segments_, rows_;
    std::vector<Box> of_segments_, of_rows_;  // of shape s at [segment or row * shapes + s]
    std::vector<std::uint8_t> far_;           // of row i and a later row j at [i * rows + j]
};

/// The open half plane that holds all added vectors, stored as the two that are furthest apart;
/// exact up to rounding.
class HalfPlane {
  public:
    /// Returns false once the vectors do not fit in an open half plane. Zero vectors always fit.
    bool add(const glm::dvec2& v) {
        if (v.x == 0.0 && v.y == 0.0) return true;
        if (empty_) {
            right_ = left_ = v;
            empty_ = false;
            return true;
        }
        const double past_right = cross(right_, v), past_left = cross(left_, v);
        if (past_right >= 0.0 && past_left <= 0.0) {
            // The vector is inside the wedge or opposite to it; it can be opposite only if the
            // wedge is a single ray.
            return glm::dot(v, right_) > 0.0 || glm::dot(v, left_) > 0.0 ||
                   (past_right > 0.0 && past_left < 0.0);
        }
        if (past_right < 0.0 && past_left < 0.0) {
            right_ = v;
            return true;
        }
        if (past_right > 0.0 && past_left > 0.0) {
            left_ = v;
            return true;
        }
        return false;
    }

    /// Returns a direction at an acute angle to all added vectors, unless they are all collinear.
    [[nodiscard]] glm::dvec2 direction() const { return {left_.y - right_.y, right_.x - left_.x}; }

  private:
    glm::dvec2 right_{0.0}, left_{0.0};
    bool empty_ = true;
};

/// Separation tests that hold for all weighted means of some polylines.
class WeightedMeans {
  public:
    explicit WeightedMeans(std::span<const Polyline> shapes)
        : shapes_(shapes.begin(), shapes.end()), vertices_(shapes.front().size()) {
        // The first and the last shape (the ends of a path) differ most, so they are tested first:
        // what fails mostly fails with them.
        std::swap(shapes_[shapes_.size() > 1 ? 1 : 0], shapes_.back());
    }

    [[nodiscard]] std::size_t vertices() const { return vertices_; }

    /// Returns the segments that no axis-aligned direction separates; the others are certified.
    [[nodiscard]] Neighbours neighbours() const { return Neighbours(shapes_); }

    [[nodiscard]] bool certified(const UnprovenPair& pair) const {
        if (pair.i == pair.j) return beside_axis(pair.i);
        return pair.j == pair.i + 1 ? forwards(pair.i) : apart(pair.i, pair.j);
    }

  private:
    [[nodiscard]] bool beside_axis(std::size_t i) const {
        const bool end = i == 0 || i + 1 == vertices_;
        return std::all_of(shapes_.begin(), shapes_.end(), [&](std::span<const glm::dvec2> p) {
            return end ? p[i].x >= 0.0 : p[i].x > 0.0;
        });
    }

    /// Returns true if segment i + 1 never folds back on segment i.
    [[nodiscard]] bool forwards(std::size_t i) const {
        return fit_in_a_half_plane([&](std::size_t s, const auto& fits) {
                   const auto p = shapes_[s];
                   return fits(p[i + 1] - p[i]) && fits(p[i + 2] - p[i + 1]);
               }) ||
               side(i, i + 1, i + 2) != 0;
    }

    [[nodiscard]] bool apart(std::size_t i, std::size_t j) const {
        return fit_in_a_half_plane([&](std::size_t s, const auto& fits) {
                   const auto p = shapes_[s];
                   const auto differs = [&](std::size_t x, std::size_t y) {
                       const glm::dvec2 v = p[y] - p[x];
                       return (v != glm::dvec2(0.0) || coincide(p, x, y)) && fits(v);
                   };
                   return differs(i, j) && differs(i + 1, j) && differs(i, j + 1) &&
                          differs(i + 1, j + 1);
               }) ||
               line_between(i, j);
    }

    /// Returns true if an open half plane holds some vectors of every shape. The direction found
    /// for the first two shapes mostly fits all and is cheap to test.
    ///
    /// all_fit  returns true if a test holds for all vectors of a shape
    template <class AllFit>
    [[nodiscard]] bool fit_in_a_half_plane(const AllFit& all_fit) const {
        HalfPlane plane;
        const auto added = [&](const glm::dvec2& v) { return plane.add(v); };
        std::size_t s = 0;
        for (; s < std::min<std::size_t>(shapes_.size(), 2); ++s)
            if (!all_fit(s, added)) return false;
        const glm::dvec2 direction = plane.direction();
        const auto along = [&](const glm::dvec2& v) { return glm::dot(direction, v) > 0.0; };
        while (s < shapes_.size() && all_fit(s, along)) ++s;
        if (s == shapes_.size()) return true;
        for (s = 2; s < shapes_.size(); ++s)
            if (!all_fit(s, added)) return false;
        return true;
    }

    [[nodiscard]] bool line_between(std::size_t i, std::size_t j) const {
        const int p = side(i, j, j + 1);
        if (p != 0 && p == side(i + 1, j, j + 1)) return true;
        const int r = side(j, i, i + 1);
        return r != 0 && r == side(j + 1, i, i + 1);
    }

    /// Returns the sign of twice the area of X, Y, Z (bilinear in two shapes) over all pairs of
    /// shapes, or 0 if signs differ.
    [[nodiscard]] int side(std::size_t x, std::size_t y, std::size_t z) const {
        int sign = 0;
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            const auto p = shapes_[s];
            const auto meets = [&](std::size_t v) { return p[v] == p[x] && !coincide(p, x, v); };
            if (meets(y) || meets(z)) return 0;
            const glm::dvec2 a = p[y] - p[x], b = p[z] - p[x];
            for (std::size_t t = s; t < shapes_.size(); ++t) {
                const auto q = shapes_[t];
                const glm::dvec2 c = q[y] - q[x], d = q[z] - q[x];
                const double area = cross(a, d) + cross(c, b);
                if (area == 0.0) {
                    // The pair says nothing where the same two points coincide in both shapes: a
                    // sub-curve that both lack.
                    constexpr glm::dvec2 none(0.0);
                    if ((a == b && c == d) || (a == none && (b == none || c == none)) ||
                        (d == none && (c == none || b == none)))
                        continue;
                    return 0;
                }
                const int own = area > 0.0 ? 1 : -1;
                if (sign == 0) sign = own;
                if (sign != own) return 0;
            }
        }
        return sign;
    }

    /// Returns true if two vertices coincide because all edges between them have zero length (a
    /// sub-curve that is a point). Other vertices must not coincide.
    [[nodiscard]] static bool coincide(std::span<const glm::dvec2> p, std::size_t x,
                                       std::size_t y) {
        const auto [from, to] = std::minmax(x, y);
        return std::all_of(p.begin() + static_cast<std::ptrdiff_t>(from),
                           p.begin() + static_cast<std::ptrdiff_t>(to) + 1,
                           [&](const glm::dvec2& q) { return q == p[x]; });
    }

    std::vector<std::span<const glm::dvec2>> shapes_;
    std::size_t vertices_;
};

/// Visits what is not certified, in order: the axis, then each segment with those after it; stops
/// when `visit` returns false.
template <class Visit>
void visit_unproven_pairs(const WeightedMeans& means, const Visit& visit) {
    const std::size_t n = means.vertices();
    const auto proceed = [&](const UnprovenPair& pair) {
        return means.certified(pair) || visit(pair);
    };
    for (std::size_t i = 0; i < n; ++i)
        if (!proceed({i, i})) return;
    const Neighbours neighbours = means.neighbours();
    for (std::size_t i = 0; i + 1 < n; ++i) {
        if (i + 2 < n && !proceed({i, i + 1})) return;
        for (std::size_t j = neighbours.next(i, i + 2); j + 1 < n; j = neighbours.next(i, j + 1))
            if (!proceed({i, j})) return;
    }
}

}  // namespace

std::optional<std::array<std::size_t, 2>> first_crossing(std::span<const glm::dvec2> polyline) {
    const std::size_t n = polyline.size();
    const Neighbours neighbours({&polyline, 1});
    for (std::size_t i = 0; i + 1 < n; ++i)
        for (std::size_t j = neighbours.next(i, i + 2); j + 1 < n; j = neighbours.next(i, j + 1))
            if (touch(polyline[i], polyline[i + 1], polyline[j], polyline[j + 1])) return {{i, j}};
    return std::nullopt;
}

std::optional<Intersection> static_intersection(std::span<const glm::dvec2> polyline) {
    const Distinct distinct(polyline);
    const auto& p = distinct.points;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const bool end = i == 0 || i + 1 == p.size();
        if (end ? p[i].x < 0.0 : p[i].x <= 0.0)
            return Intersection{0.0, distinct.owner[i], distinct.owner[i]};
    }
    for (std::size_t i = 0; i + 2 < p.size(); ++i) {
        const glm::dvec2 in = p[i + 1] - p[i], out = p[i + 2] - p[i + 1];
        if (cross(in, out) == 0.0 && glm::dot(in, out) < 0.0)
            return Intersection{0.0, distinct.owner[i + 1] - 1, distinct.owner[i + 1]};
    }
    if (const auto pair = first_crossing(p))
        return Intersection{0.0, distinct.owner[(*pair)[0]], distinct.owner[(*pair)[1]]};
    return std::nullopt;
}

std::optional<Intersection> first_intersection(std::span<const glm::dvec2> a,
                                               std::span<const glm::dvec2> b) {
    assert(a.size() == b.size() && a.size() >= 2);
    if (auto at_0 = static_intersection(a)) return at_0;
    if (auto moving = intersection_between(a, b)) return moving;
    if (auto at_1 = static_intersection(b)) {
        at_1->t = 1.0;
        return at_1;
    }
    return std::nullopt;
}

std::optional<Intersection> intersection_between(std::span<const glm::dvec2> a,
                                                 std::span<const glm::dvec2> b) {
    const std::size_t n = a.size();
    std::vector<Moving> points(n);
    for (std::size_t i = 0; i < n; ++i) points[i] = {a[i], b[i] - a[i]};
    const std::array<std::span<const glm::dvec2>, 2> ends = {a, b};
    const Neighbours neighbours(ends);
    // For t strictly between 0 and 1 r is positive if it is positive at one end and not negative at
    // the other.
    std::optional<Intersection> first;
    const auto consider = [&](double t, std::size_t i, std::size_t j) {
        if (t <= 1.0 && (!first || t < first->t)) first = Intersection{t, i, j};
    };
    for (std::size_t i = 0; i + 2 < n; ++i) {
        const Moving in = points[i + 1] - points[i], out = points[i + 2] - points[i + 1];
        const Quadratic turn = cross(in, out);
        const auto folds = [&](double t) {
            if (!inside(t)) return;
            const glm::dvec2 u = in.at(t), v = out.at(t);
            if (std::abs(cross(u, v)) <= -collinearity_tolerance * glm::dot(u, v))
                consider(t, i, i + 1);
        };
        if (turn.is_zero())
            dot(in, out).roots(folds);
        else if (!turn.keeps_sign())
            turn.roots(folds);
    }
    for (std::size_t i = 0; i + 1 < n; ++i)
        for (std::size_t j = neighbours.next(i, i + 2); j + 1 < n; j = neighbours.next(i, j + 1)) {
            HalfPlane
                differences;  // a direction that separates them at both ends does so for all t
            bool apart = true;
            for (const auto& line : {a, b})
                apart = apart && differences.add(line[j] - line[i]) &&
                        differences.add(line[j] - line[i + 1]) &&
                        differences.add(line[j + 1] - line[i]) &&
                        differences.add(line[j + 1] - line[i + 1]);
            if (apart) continue;
            const Moving &p = points[i], &q = points[i + 1], &r = points[j], &s = points[j + 1];
            consider(first_touch(p, r, s), i, j);
            consider(first_touch(q, r, s), i, j);
            consider(first_touch(r, p, q), i, j);
            consider(first_touch(s, p, q), i, j);
        }
    return first;
}

std::optional<UnprovenPair> first_unproven_pair(std::span<const Polyline> shapes) {
    assert(!shapes.empty());
    std::optional<UnprovenPair> first;
    visit_unproven_pairs(WeightedMeans(shapes), [&](const UnprovenPair& pair) {
        first = pair;
        return false;
    });
    return first;
}

std::vector<UnprovenPair> unproven_pairs(std::span<const Polyline> shapes) {
    assert(!shapes.empty());
    std::vector<UnprovenPair> all;
    visit_unproven_pairs(WeightedMeans(shapes), [&](const UnprovenPair& pair) {
        all.push_back(pair);
        return true;
    });
    return all;
}

std::vector<UnprovenPair> unproven_pairs(std::span<const Polyline> shapes,
                                         std::span<const UnprovenPair> among) {
    const WeightedMeans means(shapes);
    std::vector<UnprovenPair> left;
    std::copy_if(among.begin(), among.end(), std::back_inserter(left),
                 [&](const UnprovenPair& pair) { return !means.certified(pair); });
    return left;
}

}  // namespace sporeprint
