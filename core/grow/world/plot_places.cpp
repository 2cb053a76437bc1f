#include "core/grow/world/plot_places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Returns a rotation about the vertical axis.
glm::dvec4 turned(double angle) {
    const SineCosine half = sine_cosine(0.5 * angle);
    return {0.0, half.sine, 0.0, half.cosine};
}

/// Returns the parts of a line, from 0 to 1, between which it is in a rectangle; nothing if it misses it.
std::optional<std::pair<double, double>> part_within(const WorldBox& box, const glm::dvec2& from,
                                                     const glm::dvec2& to) {
    double first = 0.0, last = 1.0;
    const auto clip = [&](double start, double way, double low, double high) {
        if (std::abs(way) < 1e-9) {
            if (start < low || start > high) last = -1.0;
            return;
        }
        const double a = (low - start) / way, b = (high - start) / way;
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    };
    clip(from.x, to.x - from.x, box.west, box.east);
    clip(from.y, to.y - from.y, box.south, box.north);
    if (first >= last) return std::nullopt;
    return std::pair{first, last};
}

/// A trunk that lies: straight, or in as few straight pieces as the ground makes of it; a rotten one is broken in any
/// case. It rests on the ground in a few places and spans small hollows.
class LyingTrunk {
  public:
    LyingTrunk(const FloorHeights& floor, const DeadWood& wood, WorldTime time)
        : foot_(metres(wood.at.x), metres(wood.at.y)) {
        const SineCosine turn = sine_cosine(wood.direction);
        way_ = {turn.cosine, turn.sine};
        const double lost = mass_lost(wood, time), radius = radius_at(wood, time);
        // Rotten wood sinks into the ground.
        raised_ = 0.72 - 0.55 * lost;
        step_ = wood.length / std::max(1.0, std::ceil(wood.length / most_step));
        for (double s = 0.0; s < wood.length + 0.5 * step_; s += step_) {
            ground_.push_back(floor.at(foot_.x + s * way_.x, foot_.y + s * way_.y));
            radii_.push_back(radius * taper_at(wood, s));
        }
        longest_ = lost > 0.6 ? 5.0 : 1e9;
        ends_.push_back({0, 0.0});
        split(0, ground_.size() - 1);
        for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
            const double lift = lift_of(ends_[i].at, ends_[i + 1].at);
            for (std::size_t k = i; k < i + 2; ++k) ends_[k].lift = std::max(ends_[k].lift, lift);
        }
        for (End& end : ends_) end.height = level(end.at) + end.lift;
    }

    /// Returns the axis at a distance from the foot: its place, and its height.
    struct Axis {
        glm::dvec2 at;
        double height;
    };
    [[nodiscard]] Axis at(double s) const {
        const double number = std::clamp(s / step_, 0.0, static_cast<double>(ends_.back().at));
        std::size_t next = 1;
        while (next + 1 < ends_.size() && static_cast<double>(ends_[next].at) < number) ++next;
        const End &from = ends_[next - 1], &to = ends_[next];
        const double part =
            (number - static_cast<double>(from.at)) / static_cast<double>(to.at - from.at);
        return {foot_ + s * way_, from.height + part * (to.height - from.height)};
    }

    /// Returns the places where the trunk is broken between two distances from its foot.
    [[nodiscard]] std::vector<double> breaks(double from, double to) const {
        std::vector<double> out;
        for (const End& end : ends_)
            if (const double s = static_cast<double>(end.at) * step_; s > from && s < to)
                out.push_back(s);
        return out;
    }

  private:
    /// An end of a piece: the number of its step, how far it is raised, so that no hump buries a piece, and the height of
    /// the axis.
    struct End {
        std::size_t at;
        double lift, height = 0.0;
    };

    /// Returns the height of the axis over the mean ground round a step.
    [[nodiscard]] double level(std::size_t i) const {
        const std::size_t first = i > 0 ? i - 1 : 0, last = std::min(i + 1, ground_.size() - 1);
        double sum = 0.0;
        for (std::size_t k = first; k <= last; ++k) sum += ground_[k];
        return sum / static_cast<double>(last - first + 1) + raised_ * radii_[i];
    }
    /// Calls a function with the height of the axis of a piece, without lift, and that of the ground at each step.
    template <class Use>
    void for_each_step(std::size_t from, std::size_t to, const Use& use) const {
        const double low = level(from), high = level(to);
        for (std::size_t i = from; i <= to; ++i) {
            const double part = static_cast<double>(i - from) / static_cast<double>(to - from);
            use(low + part * (high - low), ground_[i], radii_[i]);
        }
    }
    /// Returns by how much a piece has to be raised, so that its axis is nowhere in the ground.
    [[nodiscard]] double lift_of(std::size_t from, std::size_t to) const {
        double lift = 0.0;
        for_each_step(from, to, [&](double axis, double ground, double own) {
            lift = std::max(lift, ground + shown * own - axis);
        });
        return lift;
    }
    /// Adds the ends of the pieces of a part.
    void split(std::size_t from, std::size_t to) {
        const double lift = lift_of(from, to);
        double gap = 0.0;
        for_each_step(from, to, [&](double axis, double ground, double own) {
            gap = std::max(gap, axis + lift - own - ground);
        });
        const double length = static_cast<double>(to - from) * step_;
        if ((gap > widest_gap && length > shortest) || length > longest_) {
            const std::size_t middle = from + (to - from) / 2;
            split(from, middle);
            split(middle, to);
        } else {
            ends_.push_back({to, 0.0});
        }
    }

    /// The step at which the ground is looked at; what a trunk spans; the length of pieces that are not divided, metres;
    /// and how far above the ground its axis is at least, in radii.
    static constexpr double most_step = 0.6, widest_gap = 0.3, shortest = 3.0, shown = 0.1;

    glm::dvec2 foot_, way_{1.0, 0.0};
    double raised_ = 0.0, step_ = most_step, longest_ = 0.0;
    std::vector<double> ground_, radii_;  ///< at each step
    std::vector<End> ends_;
};

TrunkLine line_of_snag(const DeadWood& wood, const PlotContent& content, const PlotFrame& frame) {
    const double x = metres(wood.at.x), y = metres(wood.at.y);
    const double radius = radius_at(wood, content.time);
    const double height = length_at(wood, content.time);
    const double ground = frame.floor().at(x, y) - 0.2 * radius;
    return {
        0.0, height, height, {}, [=, &frame](double up) {
            const double flare = 0.55 * exponential(-std::max(up, 0.0) / (1.6 * radius));
            return TrunkSection{frame.at(x, y, ground + up), radius * (taper_at(wood, up) + flare)};
        }};
}

std::optional<TrunkLine> line_of_log(const DeadWood& wood, const PlotContent& content,
                                     const PlotFrame& frame) {
    constexpr double least_length = 0.25;
    const SineCosine turn = sine_cosine(wood.direction);
    const glm::dvec2 foot(metres(wood.at.x), metres(wood.at.y)), way(turn.cosine, turn.sine);
    const double radius = radius_at(wood, content.time);
    const double whole = length_at(wood, content.time);
    const auto part = part_within(frame.box(), foot, foot + whole * way);
    if (!part) return std::nullopt;
    // A cut end stays within the slab, unless the trunk hardly crosses its border.
    constexpr double most_radii = 2.0;
    const double across = std::max(std::abs(way.x), std::abs(way.y));
    const double inset =
        radius * std::min(most_radii, std::sqrt(1.0 - std::min(across * across, 1.0)) / across);
    const double from = part->first > 0.0 ? part->first * whole + inset : 0.0,
                 to = part->second < 1.0 ? part->second * whole - inset : whole;
    if (to - from < least_length) return std::nullopt;
    // The whole trunk, so that a part of it lies as the others do.
    const LyingTrunk lying(frame.floor(), wood, content.time);
    return TrunkLine{from, to, whole, lying.breaks(from, to), [=, &frame](double s) {
                         const LyingTrunk::Axis axis = lying.at(s);
                         return TrunkSection{frame.at(axis.at.x, axis.at.y, axis.height),
                                             radius * taper_at(wood, s)};
                     }};
}

}  // namespace

PlotFrame::PlotFrame(const PlotContent& content, const FloorHeights& floor, double step)
    : floor_(&floor),
      box_(box_of(content)),
      x_(metres(content.centre.x)),
      y_(metres(content.centre.y)),
      height_(step * std::floor(place_at(*content.ground, coordinate_at(content.ground->grid, x_),
                                         coordinate_at(content.ground->grid, y_))
                                        .height /
                                    step +
                                0.5)) {}

bool PlotFrame::has(const WorldPoint& at) const {
    const double x = metres(at.x), y = metres(at.y);
    return x >= box_.west && x < box_.east && y >= box_.south && y < box_.north;
}

std::string id_text(std::uint64_t id) {
    constexpr const char* digits = "0123456789abcdef";
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i) text[i] = digits[id >> (60U - 4U * i) & 15U];
    return text;
}

GlbTransform place_of(const StandTree& tree, WorldTime time, const TreeSize& model,
                      const PlotFrame& frame) {
    const double x = metres(tree.at.x), y = metres(tree.at.y);
    const double height = height_at(tree, time);
    const double scale = std::max(height / model.height, 1e-3);
    // Trees of a wood are slenderer than those that stand alone, as the presets do.
    const double breadth =
        std::clamp(crown_radius(height) / model.radius, 0.5 * scale, 1.2 * scale);
    Random random(static_cast<std::uint32_t>(tree.id), purposes::plot_pieces);
    const double angle = 2.0 * pi * random.uniform();
    // The foot of the mesh reaches into the ground that is raised round it.
    const double sunk = 0.2 * trunk_diameter(height);
    return {frame.at(x, y, frame.floor().at(x, y) - sunk), turned(angle),
            glm::dvec3(breadth, scale, breadth)};
}

std::optional<TrunkLine> trunk_line(const DeadWood& wood, const PlotContent& content,
                                    const PlotFrame& frame) {
    if (!(wood.length > 0.0) || !(wood.radius > 0.0)) return std::nullopt;
    if (wood.lies_at(content.time)) return line_of_log(wood, content, frame);
    if (wood.stands_at(content.time) && frame.has(wood.at))
        return line_of_snag(wood, content, frame);
    return std::nullopt;
}

std::optional<glm::dvec3> BearingTrunks::place(const FruitBody& body, const glm::dvec3& out) {
    const auto wood = std::find_if(content_.dead_wood.begin(), content_.dead_wood.end(),
                                   [&](const DeadWood& one) { return one.id == body.trunk; });
    if (wood == content_.dead_wood.end()) return std::nullopt;
    const auto [found, is_new] = lines_.try_emplace(body.trunk);
    if (is_new) found->second = trunk_line(*wood, content_, frame_);
    if (!found->second) return std::nullopt;
    const SineCosine turn = sine_cosine(wood->direction);
    const double along = wood->lies_at(content_.time)
                             ? metres(body.at.x - wood->at.x) * turn.cosine +
                                   metres(body.at.y - wood->at.y) * turn.sine
                             : body.height;
    // Slightly below the bark, which is uneven.
    constexpr double depth = 0.96;
    const TrunkSection section =
        found->second->section(std::clamp(along, 0.0, found->second->whole));
    return section.middle + depth * section.radius * out;
}

GlbTransform place_of(const FruitBody& body, const PlotFrame& frame, bool is_lateral,
                      BearingTrunks& trunks) {
    const double x = metres(body.at.x), y = metres(body.at.y);
    glm::dvec3 foot = frame.at(x, y, frame.floor().at(x, y) + body.height);
    if (body.trunk != 0) {
        const SineCosine facing = sine_cosine(body.facing), pitch = sine_cosine(body.pitch);
        const glm::dvec3 out(facing.cosine * pitch.cosine, pitch.sine, -facing.sine * pitch.cosine);
        foot = trunks.place(body, out).value_or(foot);
        if (is_lateral) {
            const glm::dvec3 up = square_to(out, {0.0, 1.0, 0.0});
            return {foot, quaternion_of({glm::cross(up, out), up, out})};
        }
    }
    Random random(body.seed(), purposes::plot_pieces, 2);
    const SineCosine half = sine_cosine(pi * random.uniform());
    return {foot, {0.0, half.sine, 0.0, half.cosine}};
}

}  // namespace sporeprint
