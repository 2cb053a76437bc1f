#include "core/trace/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <tuple>
#include <utility>
#include <vector>

#include "core/individual/axis_curve.h"
#include "core/math/elementary.h"
#include "core/silhouette/outline.h"
#include "core/trace/contour.h"

namespace sporeprint::trace {

namespace {

using Line = std::vector<glm::dvec2>;

// --- What is changed --------------------------------------------------------------------

/// Places of the axis whose directions are free; places of the stem's radius, the cap's radius and height, and the
/// lower face's height that move.
constexpr std::size_t axis_places = 6, stem_places = 5, cap_places = 6, face_places = 2;

/// Indices of the parameters: lengths in heights of the mushroom, angles in radians.
constexpr std::size_t foot_at = 0, axis_from = 2, length_at = axis_from + axis_places,
                      stem_from = length_at + 1, cap_r_from = stem_from + stem_places,
                      cap_y_from = cap_r_from + cap_places - 1, face_from = cap_y_from + cap_places,
                      pitch_at = face_from + face_places, parameter_count = pitch_at + 1;

using Parameters = std::array<double, parameter_count>;

/// Steps of the drawn lines.
constexpr std::size_t stem_steps = 24, face_steps = 16, cap_steps = 40;

/// Points of each part of a side that are compared.
constexpr std::size_t stem_compared = 40, face_compared = 24, cap_compared = 40;

/// Below this the border of a foot is not the stem's side, of the height.
constexpr double above_foot = 0.045;

/// Distances above this count less, of the height.
constexpr double soft = 0.005;

constexpr int most_steps = 12;

/// Of a parameter.
constexpr double longest_step = 0.3;

/// A stem that is shorter, of the height, has no axis to speak of.
constexpr double least_stem = 0.03;

/// How much each point that is compared counts beside: the marks; how much a bend of the axis, the stem's radius
/// and the cap more than measured; how much any change.
constexpr double of_mark = 1.0, of_axis = 0.03, of_stem = 0.5, of_cap = 2.0, of_change = 0.15;

/// Where a lower face is hidden, the stem ends above the margin by this share of the cap's height.
constexpr double hidden_share = 0.15;

/// A place of a drawn line, and how it moves with each parameter.
struct Vertex {
    glm::dvec2 at{0.0};
    std::array<glm::dvec2, parameter_count> by{};
};

using DrawnLine = std::vector<Vertex>;

/// Returns how much a place counts between places at equal steps: 1 there, 0 at their neighbours, smooth.
double share_of(double t, std::size_t place, std::size_t places) {
    const double last = static_cast<double>(places) - 1.0;
    const double u = std::max(1.0 - std::abs(t * last - static_cast<double>(place)), 0.0);
    return u * u * (3.0 - 2.0 * u);
}

/// Returns the same, but straight between places.
double straight_share_of(double t, std::size_t place, std::size_t places) {
    const double last = static_cast<double>(places) - 1.0;
    return std::max(1.0 - std::abs(t * last - static_cast<double>(place)), 0.0);
}

/// Returns points of a line at equal steps of its length.
Line evenly(const Line& line, std::size_t steps) {
    const std::vector<double> arcs = arc_lengths(line);
    Line found;
    found.reserve(steps + 1);
    std::size_t i = 0;
    for (std::size_t k = 0; k <= steps; ++k) {
        const double target = arcs.back() * static_cast<double>(k) / static_cast<double>(steps);
        while (i + 2 < line.size() && arcs[i + 1] < target) ++i;
        const double step = arcs[i + 1] - arcs[i];
        const double t = step > 0.0 ? std::clamp((target - arcs[i]) / step, 0.0, 1.0) : 0.0;
        found.push_back(line[i] + t * (line[i + 1] - line[i]));
    }
    return found;
}

/// Returns the radius of a stem at a height.
double radius_at(const Line& stem, double y) {
    std::size_t i = 0;
    while (i + 2 < stem.size() && stem[i + 1].y < y) ++i;
    const double step = stem[i + 1].y - stem[i].y;
    const double t = step > 0.0 ? std::clamp((y - stem[i].y) / step, 0.0, 1.0) : 0.0;
    return stem[i].x + t * (stem[i + 1].x - stem[i].x);
}

// --- Drawing ----------------------------------------------------------------------------

/// A mushroom whose profile is that of a photograph, changed by parameters. Lengths in its heights, y up.
class Drawing {
  public:
    /// profile  stem from (r, 0) to (r, stem_top), face and cap above it
    Drawing(const Line& stem, const Line& face, const Line& cap, LowerEdge edge)
        : edge_(edge), cap_(evenly(cap, cap_steps)), face_(evenly(face, face_steps)) {
        top_ = stem.back().y;
        radii_.reserve(stem_steps + 1);
        for (std::size_t k = 0; k <= stem_steps; ++k)
            radii_.push_back(radius_at(stem, top_ * static_cast<double>(k) / stem_steps));
        for (Line* part : {&cap_, &face_})
            for (glm::dvec2& at : *part) at.y -= top_;
    }

    [[nodiscard]] double stem_top() const { return top_; }
    [[nodiscard]] double margin_radius() const { return cap_.front().x; }
    [[nodiscard]] double margin_height() const { return cap_.front().y; }

    /// Returns the radius of the stem at a step.
    [[nodiscard]] double radius(const Parameters& p, std::size_t step) const {
        double r = radii_[step];
        const double t = static_cast<double>(step) / stem_steps;
        for (std::size_t k = 0; k < stem_places; ++k)
            r += p[stem_from + k] * share_of(t, k, stem_places);
        return r;
    }

    /// Returns the changed cap, its heights above the top of the stem.
    [[nodiscard]] Line cap(const Parameters& p) const {
        Line made = cap_;
        for (std::size_t i = 0; i <= cap_steps; ++i) {
            const double t = static_cast<double>(i) / cap_steps;
            for (std::size_t k = 0; k < cap_places; ++k) {
                const double share = share_of(t, k, cap_places);
                if (k + 1 < cap_places) made[i].x += share * p[cap_r_from + k];
                made[i].y += share * p[cap_y_from + k];
            }
        }
        return made;
    }

    /// Returns the changed lower face, its heights above the top of the stem.
    [[nodiscard]] Line face(const Parameters& p) const {
        Line made = face_;
        for (std::size_t i = 0; i <= face_steps; ++i) {
            const double t = static_cast<double>(i) / face_steps;
            made[i].x += (1.0 - t) * p[stem_from + stem_places - 1] + t * p[cap_r_from];
            made[i].y += t * p[cap_y_from];
            for (std::size_t k = 0; k < face_places; ++k)
                made[i].y += p[face_from + k] * share_of(t, k + 1, face_places + 2);
        }
        return made;
    }

    /// The axis at the steps of the stem.
    struct Stem {
        std::vector<Vertex> middles;
        std::vector<double> directions;
    };

    /// Returns the axis from the foot to the top of the stem.
    [[nodiscard]] Stem axis(const Parameters& p) const {
        Stem made;
        Vertex at;
        at.at = {p[foot_at], p[foot_at + 1]};
        at.by[foot_at] = {1.0, 0.0};
        at.by[foot_at + 1] = {0.0, 1.0};
        const double length = top_ + p[length_at], step = length / stem_steps;
        for (std::size_t i = 0; i <= stem_steps; ++i) {
            made.middles.push_back(at);
            made.directions.push_back(direction(p, static_cast<double>(i) / stem_steps));
            if (i == stem_steps) break;
            const double t = (static_cast<double>(i) + 0.5) / stem_steps;
            const auto [sine, cosine] = sine_cosine(direction(p, t));
            at.at += step * glm::dvec2(sine, cosine);
            at.by[length_at] += glm::dvec2(sine, cosine) / static_cast<double>(stem_steps);
            for (std::size_t k = 0; k < axis_places; ++k)
                at.by[axis_from + k] +=
                    step * straight_share_of(t, k, axis_places) * glm::dvec2(cosine, -sine);
        }
        return made;
    }

    /// The three lines of each side, as a camera sees them.
    struct Side {
        DrawnLine stem, lower, cap;
    };

    [[nodiscard]] std::array<Side, 2> drawn(const Parameters& p) const {
        const Stem stem = axis(p);
        const double up_sine = p[pitch_at];
        std::array<Side, 2> sides;
        const Line caps = cap(p), faces = face(p);
        for (std::size_t s = 0; s < 2; ++s) {
            const double sign = s == 0 ? -1.0 : 1.0;
            Side& side = sides[s];
            for (std::size_t i = 0; i <= stem_steps; ++i) {
                const auto [sine, cosine] = sine_cosine(stem.directions[i]);
                const glm::dvec2 right(cosine, -sine), up(sine, cosine);
                const double t = static_cast<double>(i) / stem_steps, r = sign * radius(p, i);
                Vertex at = stem.middles[i];
                at.at += r * right;
                for (std::size_t k = 0; k < axis_places; ++k)
                    at.by[axis_from + k] -= r * straight_share_of(t, k, axis_places) * up;
                for (std::size_t k = 0; k < stem_places; ++k)
                    at.by[stem_from + k] += sign * share_of(t, k, stem_places) * right;
                side.stem.push_back(at);
            }
            const Vertex& top = stem.middles.back();
            const auto [sine, cosine] = sine_cosine(stem.directions.back());
            const glm::dvec2 right(cosine, -sine), up(sine, cosine);
            // A place of a circle about the axis, at an angle towards the camera.
            const auto of_circle = [&](const glm::dvec2& at, double towards) {
                const double across = sign * at.x * std::sqrt(1.0 - towards * towards),
                             high = at.y - at.x * towards * up_sine;
                Vertex made = top;
                made.at += across * right + high * up;
                made.by[axis_from + axis_places - 1] += high * right - across * up;
                made.by[pitch_at] = -at.x * towards * up;
                return made;
            };
            const auto move = [&](Vertex& at, std::size_t r_by, std::size_t y_by, double share,
                                  double towards) {
                if (r_by < parameter_count)
                    at.by[r_by] += share * (sign * std::sqrt(1.0 - towards * towards) * right -
                                            towards * up_sine * up);
                if (y_by < parameter_count) at.by[y_by] += share * up;
            };
            const std::vector<double> towards = towards_camera(caps, up_sine);
            for (std::size_t i = 0; i <= cap_steps; ++i) {
                Vertex at = of_circle(caps[i], towards[i]);
                const double t = static_cast<double>(i) / cap_steps;
                for (std::size_t k = 0; k < cap_places; ++k)
                    move(at, k + 1 < cap_places ? cap_r_from + k : parameter_count, cap_y_from + k,
                         share_of(t, k, cap_places), towards[i]);
                side.cap.push_back(at);
            }
            for (std::size_t i = 0; i <= face_steps; ++i) {
                const double t = static_cast<double>(i) / face_steps;
                if (edge_ == LowerEdge::face) {
                    Vertex at = of_circle(faces[i], 0.0);
                    move(at, stem_from + stem_places - 1, parameter_count, 1.0 - t, 0.0);
                    move(at, cap_r_from, cap_y_from, t, 0.0);
                    for (std::size_t k = 0; k < face_places; ++k)
                        move(at, parameter_count, face_from + k,
                             share_of(t, k + 1, face_places + 2), 0.0);
                    side.lower.push_back(at);
                } else {
                    // From before the stem to the margin.
                    const double near = sine_cosine(0.5 * pi * (1.0 - t)).sine;
                    Vertex at = of_circle(caps.front(), near);
                    move(at, cap_r_from, cap_y_from, 1.0, near);
                    side.lower.push_back(at);
                }
            }
        }
        return sides;
    }

  private:
    LowerEdge edge_;
    double top_ = 0.0;
    std::vector<double> radii_;
    Line cap_, face_;

    [[nodiscard]] static double direction(const Parameters& p, double t) {
        double found = 0.0;
        for (std::size_t k = 0; k < axis_places; ++k)
            found += p[axis_from + k] * straight_share_of(t, k, axis_places);
        return found;
    }

    /// Returns the sine of the angle towards the camera at which each circle of a cap is on its contour.
    static std::vector<double> towards_camera(const Line& line, double up_sine) {
        const double slope = up_sine / std::sqrt(1.0 - up_sine * up_sine);
        std::vector<double> found(line.size());
        for (std::size_t i = 0; i < line.size(); ++i) {
            const glm::dvec2 along =
                line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1];
            // The underside of a rolled margin, and what lies behind it, have no contour.
            const double towards = along.y > 1e-9  ? slope * along.x / along.y
                                   : along.x < 0.0 ? -1.0
                                                   : 0.0;
            found[i] = std::clamp(towards, -1.0, 1.0);
        }
        return found;
    }
};

// --- Comparing --------------------------------------------------------------------------

/// The points of a side that are compared.
struct ComparedSide {
    Line stem, lower, cap;
    glm::dvec2 margin{0.0};
};

/// How far a point is from a line, and how that changes.
struct Residual {
    double away = 0.0;
    std::array<double, parameter_count> by{};
};

Residual residual_of(const glm::dvec2& point, const DrawnLine& line) {
    double least = 1e300, best_t = 0.0;
    std::size_t best = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 along = line[i + 1].at - line[i].at, off = point - line[i].at;
        const double square = glm::dot(along, along);
        const double t = square > 0.0 ? std::clamp(glm::dot(off, along) / square, 0.0, 1.0) : 0.0;
        const glm::dvec2 away = off - t * along;
        if (glm::dot(away, away) >= least) continue;
        least = glm::dot(away, away);
        best = i;
        best_t = t;
    }
    const Vertex &a = line[best], &b = line[best + 1];
    const glm::dvec2 away = point - a.at - best_t * (b.at - a.at);
    Residual found;
    found.away = std::sqrt(least);
    const bool is_end = (best == 0 && best_t <= 0.0) || (best + 2 == line.size() && best_t >= 1.0);
    glm::dvec2 normal(0.0);
    if (found.away > 1e-9) {
        normal = away / found.away;
    } else if (!is_end) {
        const glm::dvec2 along = b.at - a.at;
        const double length = glm::length(along);
        if (length > 0.0) normal = glm::dvec2(-along.y, along.x) / length;
    }
    for (std::size_t k = 0; k < parameter_count; ++k)
        found.by[k] = -glm::dot((1.0 - best_t) * a.by[k] + best_t * b.by[k], normal);
    return found;
}

/// Sums of squares to be made least: their matrix, gradient and value.
class Squares {
  public:
    void add(const Residual& one, double weight) {
        value_ += weight * one.away * one.away;
        for (std::size_t i = 0; i < parameter_count; ++i) {
            if (one.by[i] == 0.0) continue;
            gradient_[i] += weight * one.by[i] * one.away;
            for (std::size_t k = 0; k < parameter_count; ++k)
                matrix_[i][k] += weight * one.by[i] * one.by[k];
        }
    }
    /// Adds a distance that counts the less the greater it is.
    void add_softly(const Residual& one) {
        const double root = std::sqrt(1.0 + one.away * one.away / (soft * soft));
        const double before = value_;
        add(one, 1.0 / root);
        value_ = before + 2.0 * soft * soft * (root - 1.0);
    }
    /// Adds the square of a sum of parameters, less a constant.
    void add_sum(std::initializer_list<std::pair<std::size_t, double>> terms, const Parameters& p,
                 double constant, double weight) {
        Residual one;
        one.away = -constant;
        for (const auto& [index, factor] : terms) {
            one.away += factor * p[index];
            one.by[index] += factor;
        }
        add(one, weight * weight);
    }
    [[nodiscard]] double value() const { return value_; }

    /// Returns the step of Levenberg and Marquardt.
    [[nodiscard]] Parameters step(double damping) const {
        auto rows = matrix_;
        Parameters found{};
        for (std::size_t i = 0; i < parameter_count; ++i) {
            rows[i][i] += damping * rows[i][i] + 1e-12;
            found[i] = -gradient_[i];
        }
        // The matrix is symmetric and positive: no pivots.
        for (std::size_t i = 0; i < parameter_count; ++i)
            for (std::size_t k = i + 1; k < parameter_count; ++k) {
                const double factor = rows[k][i] / rows[i][i];
                if (factor == 0.0) continue;
                for (std::size_t j = i; j < parameter_count; ++j) rows[k][j] -= factor * rows[i][j];
                found[k] -= factor * found[i];
            }
        for (std::size_t i = parameter_count; i-- > 0;) {
            for (std::size_t k = i + 1; k < parameter_count; ++k) found[i] -= rows[i][k] * found[k];
            found[i] /= rows[i][i];
        }
        return found;
    }

  private:
    double value_ = 0.0;
    Parameters gradient_{};
    std::array<Parameters, parameter_count> matrix_{};
};

/// A drawing and what it is compared with.
struct Comparison {
    Drawing drawing;
    std::array<ComparedSide, 2> sides;
    Parameters first{};

    [[nodiscard]] Squares at(const Parameters& p) const {
        Squares sum;
        const std::array<Drawing::Side, 2> drawn = drawing.drawn(p);
        for (std::size_t s = 0; s < 2; ++s) {
            for (const glm::dvec2& point : sides[s].stem)
                sum.add_softly(residual_of(point, drawn[s].stem));
            for (const glm::dvec2& point : sides[s].lower)
                sum.add_softly(residual_of(point, drawn[s].lower));
            for (const glm::dvec2& point : sides[s].cap)
                sum.add_softly(residual_of(point, drawn[s].cap));
            // The margin is where it was marked.
            Residual margin =
                residual_of(sides[s].margin, {drawn[s].cap.front(), drawn[s].cap.front()});
            const glm::dvec2 off = sides[s].margin - drawn[s].cap.front().at;
            if (margin.away > 1e-9)
                for (std::size_t k = 0; k < parameter_count; ++k)
                    margin.by[k] = -glm::dot(drawn[s].cap.front().by[k], off) / margin.away;
            const double root = std::sqrt(1.0 + margin.away * margin.away / (soft * soft));
            sum.add(margin, of_mark * of_mark / root);
        }
        sum.add_sum({{foot_at + 1, 1.0}}, p, 0.0, of_mark);
        sum.add_sum({{length_at, 1.0}}, p, 0.0, of_mark);
        const auto smooth = [&](std::size_t from, std::size_t count, double weight) {
            for (std::size_t k = from; k + 2 < from + count; ++k)
                sum.add_sum({{k, 1.0}, {k + 1, -2.0}, {k + 2, 1.0}}, p, 0.0, weight);
        };
        const auto small = [&](std::size_t from, std::size_t count) {
            for (std::size_t k = from; k < from + count; ++k)
                sum.add_sum({{k, 1.0}}, p, 0.0, of_change);
        };
        smooth(axis_from, axis_places, of_axis);
        smooth(stem_from, stem_places, of_stem);
        smooth(cap_r_from, cap_places - 1, of_cap);
        smooth(cap_y_from, cap_places, of_cap);
        small(stem_from, pitch_at - stem_from);
        return sum;
    }

    /// Returns the parameters at which it is most alike.
    [[nodiscard]] Parameters best() const {
        Parameters p = first;
        Squares sum = at(p);
        double damping = 1e-3;
        for (int step = 0; step < most_steps; ++step) {
            const Parameters move = sum.step(damping);
            Parameters next = p;
            for (std::size_t k = 0; k < parameter_count; ++k)
                next[k] += std::clamp(move[k], -longest_step, longest_step);
            next[pitch_at] =
                std::clamp(next[pitch_at], 0.0, sine_cosine(radians(most_pitch_deg)).sine);
            Squares there = at(next);
            if (there.value() < sum.value()) {
                const bool is_near = there.value() > 0.999 * sum.value();
                p = next;
                sum = there;
                damping = std::max(0.2 * damping, 1e-6);
                if (is_near) break;
            } else {
                damping *= 10.0;
            }
        }
        return p;
    }
};

/// Returns the points of a side between two of its points, evenly spaced, without the ends.
Line between(const Line& points, std::size_t from, std::size_t to, std::size_t count) {
    if (to <= from) return {};
    Line part = evenly({points.begin() + static_cast<std::ptrdiff_t>(from),
                        points.begin() + static_cast<std::ptrdiff_t>(to) + 1},
                       count + 1);
    part.erase(part.begin());
    part.pop_back();
    return part;
}

Line scaled(Line line, double factor) {
    for (glm::dvec2& at : line) at *= factor;
    return line;
}

}  // namespace

std::optional<RefinedProfile> refined_profile(const Profile& profile, const TracedAxis& axis,
                                              const Marks& marks, double height, LowerEdge edge) {
    if (marks.stem_top < least_stem * height || profile.face.size() < 2) return std::nullopt;
    const glm::dvec2 origin = axis.at(0.0);
    const auto local = [&](const glm::dvec2& pixel) {
        return glm::dvec2(pixel.x - origin.x, origin.y - pixel.y) / height;
    };
    Line stem = scaled(profile.stem, 1.0 / height), face = scaled(profile.face, 1.0 / height),
         cap = scaled(profile.cap, 1.0 / height);
    const double seen_top = stem.back().y;
    double sine_of_pitch = 0.0;
    if (edge == LowerEdge::margin) {
        // The stem goes on behind the margin.
        double highest = 0.0;
        for (const glm::dvec2& at : cap) highest = std::max(highest, at.y);
        const glm::dvec2 margin = cap.front();
        const double r = stem.back().x, across = margin.x * margin.x - r * r;
        if (across <= 0.0) return std::nullopt;
        const double drop = (margin.y - seen_top) / std::sqrt(across);
        if (drop < 0.01 || drop > 0.4) return std::nullopt;
        sine_of_pitch = std::min(drop, sine_cosine(radians(most_pitch_deg)).sine);
        const double top =
            std::max(margin.y + hidden_share * (highest - margin.y), seen_top + 1e-3);
        stem.push_back({r, top});
        face = {stem.back(), margin};
    }
    const Drawing drawing(stem, face, cap, edge);
    Comparison comparison{drawing, {}, {}};
    Parameters& first = comparison.first;
    for (std::size_t k = 0; k < axis_places; ++k) {
        const double arc = marks.stem_top * static_cast<double>(k) / (axis_places - 1.0);
        const double reach = 0.5 * marks.stem_top / axis_places;
        const glm::dvec2 along = axis.at(arc + reach) - axis.at(std::max(arc - reach, 0.0));
        first[axis_from + k] = arc_tangent(along.x, -along.y);
    }
    // The foot is often cut askew, and its middle unsure.
    first[axis_from] = first[axis_from + 1];
    first[axis_from + axis_places - 1] += radians(marks.cap_turn_deg);
    first[pitch_at] = sine_of_pitch;
    for (std::size_t s = 0; s < 2; ++s) {
        const ContourSide& side = marks.sides[s];
        ComparedSide& compared = comparison.sides[s];
        std::size_t from = 0;
        while (from < side.junction && side.local[from].y < above_foot * height) ++from;
        for (const auto& [to, first_point, last_point, count] :
             {std::tuple{&compared.stem, from, side.junction, stem_compared},
              {&compared.lower, side.junction, side.margin, face_compared},
              {&compared.cap, side.margin, side.points.size() - 1, cap_compared}})
            for (const glm::dvec2& point : between(side.points, first_point, last_point, count))
                to->push_back(local(point));
        compared.margin = local(side.points[side.margin]);
    }
    const Parameters p = comparison.best();
    if (p[length_at] < -0.5 * drawing.stem_top()) return std::nullopt;

    // Back to pixels. What is seen from above is higher than it looks.
    RefinedProfile found{profile, axis, 0.0, 0.0, comparison.at(p).value()};
    const double cosine_of_pitch = std::sqrt(1.0 - p[pitch_at] * p[pitch_at]);
    found.pitch_deg = arc_tangent(p[pitch_at], cosine_of_pitch) * (180.0 / pi);
    const double stretch = 1.0 / cosine_of_pitch, length = drawing.stem_top() + p[length_at];
    found.stem_top = length * stretch * height;
    const Drawing::Stem middles = drawing.axis(p);
    std::vector<glm::dvec2> points;
    for (const Vertex& at : middles.middles)
        points.emplace_back(origin.x + height * at.at.x, origin.y - height * stretch * at.at.y);
    const auto [sine, cosine] = sine_cosine(middles.directions.back());
    const Line caps = drawing.cap(p), faces = drawing.face(p);
    points.push_back(points.back() +
                     height * std::max(caps.back().y, 1e-3) * glm::dvec2(sine, -cosine));
    found.axis = TracedAxis(points);
    // The measured lines, moved by the change of each of their places.
    const double by_length = length / drawing.stem_top();
    Profile& made = found.profile;
    made.stem = scaled(stem, height);
    for (glm::dvec2& at : made.stem) {
        const double t = at.y / height / drawing.stem_top();
        for (std::size_t k = 0; k < stem_places; ++k)
            at.x += height * p[stem_from + k] * share_of(t, k, stem_places);
        at.y *= by_length * stretch;
    }
    const auto above = [&](const Line& line) {
        Line moved;
        for (const glm::dvec2& at : line)
            moved.emplace_back(height * at.x, height * stretch * (length + at.y));
        return moved;
    };
    made.face = above(faces);
    made.cap = above(caps);
    const double thinnest = 1e-3 * height;
    for (Line* part : {&made.stem, &made.face, &made.cap})
        for (glm::dvec2& at : *part) at.x = std::max(at.x, thinnest);
    if (profile.has_foot) made.stem.front().x = 0.0;
    made.face.front() = made.stem.back();
    made.cap.front() = made.face.back();
    made.cap.back().x = 0.0;
    made.seen = made.cap.size();
    return found;
}

double seen_distance(const Swept& shape, double pitch_deg, const Marks& marks, double height,
                     double height_m) {
    const SineCosine pitch = sine_cosine(radians(pitch_deg));
    const double up_sine = pitch.sine, foreshortened = pitch.cosine;
    const double unit = height_m * foreshortened;  // what looks as long as the mushroom is high
    const Outline outline = Outline::unproven(shape.silhouette, "/silhouette");
    const std::vector<glm::dvec3> tangents = AxisCurve(shape.axis).tangents();
    const double root = shape.silhouette.stem.front().y, top = shape.silhouette.stem.back().y;
    // The axis at equal steps, in heights of the mushroom; vertical lengths as the camera sees them.
    const auto steps = static_cast<std::size_t>(AxisCurve::stations);
    const double step = (top - root) / unit / static_cast<double>(steps);
    Line middles{{0.0, 0.0}};
    for (std::size_t i = 0; i < steps; ++i) {
        const glm::dvec3 along = 0.5 * (tangents[i] + tangents[i + 1]);
        middles.push_back(middles.back() + step * glm::dvec2(along.x, along.y * foreshortened));
    }
    const auto placed = [&](double sign, double r, double y, double towards) {
        const double s =
            std::clamp((y - root) / (top - root), 0.0, 1.0) * static_cast<double>(steps);
        const auto i = std::min(static_cast<std::size_t>(s), steps - 1);
        const double t = s - static_cast<double>(i);
        const glm::dvec3 along = tangents[i] + t * (tangents[i + 1] - tangents[i]);
        const glm::dvec2 up(along.x, along.y), right(along.y, -along.x);
        const double above = std::max(y - top, 0.0) + std::min(y - root, 0.0);
        const glm::dvec2 at = middles[i] + t * (middles[i + 1] - middles[i]);
        return at + sign * r / unit * std::sqrt(1.0 - towards * towards) * right +
               (above * foreshortened - r * towards * up_sine) / unit * up;
    };
    std::vector<Line> lines;
    for (const double sign : {-1.0, 1.0}) {
        constexpr int samples = 60;
        for (const CurveName name : curve_names) {
            const SubCurve& curve = outline.of(name);
            if (curve.empty()) continue;
            Line line;
            for (int k = 0; k <= samples; ++k) {
                const OutlineSample here = curve.at(static_cast<double>(k) / samples),
                                    before =
                                        curve.at(std::max(k - 1, 0) / static_cast<double>(samples)),
                                    after = curve.at(std::min(k + 1, samples) /
                                                     static_cast<double>(samples));
                const double rise = after.y - before.y, out = after.r - before.r;
                double towards = 0.0;
                if (name != CurveName::stem && up_sine > 0.0)
                    towards = rise > 1e-9
                                  ? std::clamp(out / rise * up_sine / foreshortened, -1.0, 1.0)
                              : out < 0.0 ? -1.0
                                          : 1.0;
                line.push_back(placed(sign, here.r, here.y, towards));
            }
            lines.push_back(line);
        }
        if (!outline.cap.empty() && up_sine > 0.0) {
            const OutlineSample margin = outline.cap.at(0.0);
            Line line;
            for (int k = 0; k <= 30; ++k)
                line.push_back(
                    placed(sign, margin.r, margin.y, sine_cosine(0.5 * pi * k / 30.0).sine));
            lines.push_back(line);
        }
    }
    const glm::dvec2 origin = marks.sides[0].points.front();
    Line points;
    for (const ContourSide& side : marks.sides) {
        std::size_t from = 0;
        while (from + 2 < side.points.size() && side.local[from].y < above_foot * height) ++from;
        for (const glm::dvec2& pixel : between(side.points, from, side.points.size() - 1, 120))
            points.push_back(glm::dvec2(pixel.x - origin.x, origin.y - pixel.y) / height);
    }
    // It is moved to where it fits best.
    glm::dvec2 offset(0.0, root / unit);
    double mean = 0.0;
    for (int round = 0; round < 8; ++round) {
        glm::dvec2 move(0.0);
        mean = 0.0;
        for (const glm::dvec2& point : points) {
            glm::dvec2 nearest(1e9);
            for (const Line& line : lines)
                for (std::size_t i = 0; i + 1 < line.size(); ++i) {
                    const glm::dvec2 along = line[i + 1] - line[i], off = point - offset - line[i];
                    const double square = glm::dot(along, along);
                    const double t =
                        square > 0.0 ? std::clamp(glm::dot(off, along) / square, 0.0, 1.0) : 0.0;
                    const glm::dvec2 away = off - t * along;
                    if (glm::dot(away, away) < glm::dot(nearest, nearest)) nearest = away;
                }
            move += nearest / static_cast<double>(points.size());
            mean += glm::length(nearest) / static_cast<double>(points.size());
        }
        offset += 1.5 * move;
    }
    return mean;
}

}  // namespace sporeprint::trace
