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

/// How far a log bends with the ground: over half of this length its height is the mean of the ground's, metres.
constexpr double stiffness = 2.4;

/// Heights of the ground along a lying trunk, as the trunk smooths them: a sound one is straight between the places where
/// it is broken, a rotten one follows the ground.
class LogProfile {
  public:
    /// rotten  0..1
    LogProfile(const FloorHeights& floor, const glm::dvec2& from, const glm::dvec2& way,
               double length, double rotten) {
        const auto count = static_cast<std::size_t>(std::ceil(length / step)) + 1;
        std::vector<double> own;
        own.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double s = std::min(static_cast<double>(i) * step, length);
            own.push_back(floor.at(from.x + s * way.x, from.y + s * way.y));
        }
        const auto reach = static_cast<std::size_t>(stiffness / step);
        heights_.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t side = std::min({reach, i, count - 1 - i});
            double sum = 0.0;
            for (std::size_t k = i - side; k <= i + side; ++k) sum += own[k];
            heights_.push_back(sum / static_cast<double>(2 * side + 1));
        }
        straighten(rotten);
    }
    [[nodiscard]] double at(double s) const {
        const double number = std::clamp(s / step, 0.0, static_cast<double>(heights_.size() - 1));
        const auto i = std::min(static_cast<std::size_t>(number), heights_.size() - 1);
        const std::size_t next = std::min(i + 1, heights_.size() - 1);
        return heights_[i] + (number - static_cast<double>(i)) * (heights_[next] - heights_[i]);
    }

  private:
    /// Makes a sound trunk straight between the places where it is broken, since longer ones would span the hollows of
    /// the ground.
    void straighten(double rotten) {
        const std::size_t last = heights_.size() - 1;
        const auto pieces = std::max<std::size_t>(1, last / between_breaks);
        const std::vector<double> ground = heights_;
        for (std::size_t piece = 0; piece < pieces; ++piece) {
            const std::size_t from = last * piece / pieces, to = last * (piece + 1) / pieces;
            if (to <= from) continue;
            for (std::size_t i = from; i <= to; ++i) {
                const double along = static_cast<double>(i - from) / static_cast<double>(to - from);
                const double line = ground[from] + along * (ground[to] - ground[from]);
                heights_[i] = ground[i] + (1.0 - rotten) * (line - ground[i]);
            }
        }
    }

    /// Length of a piece, in steps.
    static constexpr std::size_t between_breaks = 35;

    static constexpr double step = 0.2;  // metres
    std::vector<double> heights_;
};

TrunkLine line_of_snag(const DeadWood& wood, const PlotContent& content, const PlotFrame& frame) {
    const double x = metres(wood.at.x), y = metres(wood.at.y);
    const double radius = radius_at(wood, content.time), lost = mass_lost(wood, content.time);
    // Tops break off first, piece by piece.
    Random random(static_cast<std::uint32_t>(wood.id), purposes::plot_pieces, 1);
    const double share_left = 1.0 - (0.15 + 0.55 * random.uniform()) * std::min(1.0, 2.5 * lost);
    const double height = std::max(1.0, wood.length * share_left);
    const double ground = frame.floor().at(x, y) - 0.2 * radius;
    const double whole = std::max(wood.length, height);
    return {0.0, height, [=, &frame](double up) {
                const double flare = 0.55 * exponential(-std::max(up, 0.0) / (1.6 * radius));
                const double taper = 1.0 - 0.8 * std::clamp(up / whole, 0.0, 1.0);
                return TrunkSection{frame.at(x, y, ground + up), radius * (taper + flare)};
            }};
}

std::optional<TrunkLine> line_of_log(const DeadWood& wood, const PlotContent& content,
                                     const PlotFrame& frame) {
    constexpr double least_length = 0.25;
    const SineCosine turn = sine_cosine(wood.direction);
    const glm::dvec2 foot(metres(wood.at.x), metres(wood.at.y)), way(turn.cosine, turn.sine);
    const double radius = radius_at(wood, content.time), lost = mass_lost(wood, content.time);
    const auto part = part_within(frame.box(), foot, foot + wood.length * way);
    if (!part) return std::nullopt;
    // A cut end stays within the slab, unless the trunk hardly crosses its border.
    constexpr double most_radii = 2.0;
    const double across = std::max(std::abs(way.x), std::abs(way.y));
    const double inset =
        radius * std::min(most_radii, std::sqrt(1.0 - std::min(across * across, 1.0)) / across);
    const double from = part->first > 0.0 ? part->first * wood.length + inset : 0.0,
                 to = part->second < 1.0 ? part->second * wood.length - inset : wood.length;
    if (to - from < least_length) return std::nullopt;
    // The whole trunk, so that a part of it lies as the others do.
    const LogProfile profile(frame.floor(), foot, way, wood.length, smooth_step(0.2, 0.95, lost));
    // Rotten wood sinks into the ground.
    const double raised = 0.72 - 0.55 * lost, whole = wood.length;
    return TrunkLine{
        from, to, [=, &frame](double s) {
            const double here = radius * (1.0 - 0.8 * std::clamp(s / whole, 0.0, 1.0));
            const glm::dvec2 at = foot + s * way;
            return TrunkSection{frame.at(at.x, at.y, profile.at(s) + raised * here), here};
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
    const TrunkSection section = found->second->section(std::clamp(along, 0.0, wood->length));
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
