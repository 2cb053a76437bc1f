#include "core/grow/world/plot_places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
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

/// A trunk that lies: straight pieces between the places where it is broken, the shorter the further it has decayed. A
/// piece is computed when somebody wants it; not thread-safe.
class LyingTrunk {
  public:
    LyingTrunk(const FloorHeights& floor, const DeadWood& wood, WorldTime time)
        : floor_(&floor),
          foot_(metres(wood.at.x), metres(wood.at.y)),
          length_(wood.length),
          radius_(radius_at(wood, time)) {
        const SineCosine turn = sine_cosine(wood.direction);
        way_ = {turn.cosine, turn.sine};
        const double lost = mass_lost(wood, time);
        double piece = sound_piece;
        for (const double further : {0.3, 0.5, 0.7})
            if (lost > further) piece *= 0.6;
        const auto pieces = static_cast<std::size_t>(std::max(1.0, std::floor(length_ / piece)));
        Random random(static_cast<std::uint32_t>(wood.id), purposes::plot_pieces, 3);
        // Pieces of rotten trunks lie beside each other's line.
        const double aside = radius_ * std::min(0.5, 0.8 * lost);
        pieces_.resize(pieces);
        ends_.resize(pieces + 1);
        for (std::size_t i = 0; i < pieces; ++i) {
            Piece& own = pieces_[i];
            own.from = length_ * static_cast<double>(i) / static_cast<double>(pieces);
            own.to = length_ * static_cast<double>(i + 1) / static_cast<double>(pieces);
            own.aside_from = aside * random.symmetric();
            own.aside_to = aside * random.symmetric();
            own.most_buried = 0.6 * radius_ * taper_at(wood, own.to);
        }
    }

    /// A place of the axis if the trunk had no thickness, and its height.
    struct Lying {
        glm::dvec2 at;
        double height;
    };
    [[nodiscard]] Lying at(double s) {
        const double number = static_cast<double>(pieces_.size()) * s / length_;
        const Piece& piece = laid(static_cast<std::size_t>(
            std::clamp(number, 0.0, static_cast<double>(pieces_.size()) - 1.0)));
        return {foot_ + s * way_ + piece.aside_at(s) * glm::dvec2(-way_.y, way_.x), piece.up_at(s)};
    }

    /// Returns the places where the trunk is broken between two distances from its foot.
    [[nodiscard]] std::vector<double> breaks(double from, double to) const {
        std::vector<double> out;
        for (const Piece& piece : pieces_)
            if (piece.from > from && piece.from < to) out.push_back(piece.from);
        return out;
    }

  private:
    struct Piece {
        double from = 0.0, to = 0.0;        ///< distances from the foot, metres
        double up_from = 0.0, up_to = 0.0;  ///< heights of its ends
        double aside_from = 0.0, aside_to = 0.0;
        double most_buried = 0.0;  ///< how far the ground may rise above the lower side
        bool is_laid = false;      ///< its heights are known
        [[nodiscard]] double along(double s) const { return (s - from) / (to - from); }
        [[nodiscard]] double up_at(double s) const {
            return up_from + along(s) * (up_to - up_from);
        }
        [[nodiscard]] double aside_at(double s) const {
            return aside_from + along(s) * (aside_to - aside_from);
        }
    };

    const Piece& laid(std::size_t i) {
        Piece& own = pieces_[i];
        if (own.is_laid) return own;
        own.is_laid = true;
        own.up_from = end(i);
        own.up_to = end(i + 1);
        // None is buried where the ground rises below it.
        double buried = 0.0;
        for (double s = own.from + step; s < own.to; s += step)
            buried = std::max(buried, ground(s) - own.up_at(s));
        const double raised = std::max(0.0, buried - own.most_buried);
        own.up_from += raised;
        own.up_to += raised;
        return own;
    }

    /// Returns the mean height of the ground round an end of a piece.
    double end(std::size_t i) {
        if (ends_[i]) return *ends_[i];
        const double s = i < pieces_.size() ? pieces_[i].from : length_;
        const double side = std::min({reach, s, length_ - s});
        double sum = ground(s);
        if (side > 0.0)
            sum = (sum + ground(s - side) + ground(s - 0.5 * side) + ground(s + 0.5 * side) +
                   ground(s + side)) /
                  5.0;
        return ends_[i].emplace(sum);
    }

    [[nodiscard]] double ground(double s) const {
        const glm::dvec2 place = foot_ + s * way_;
        return floor_->at(place.x, place.y);
    }

    /// Length of the pieces of a sound trunk, what of the ground round the end of a piece decides on its height, and the
    /// step at which the ground is looked at, metres.
    static constexpr double sound_piece = 8.0, reach = 0.8, step = 0.4;

    const FloorHeights* floor_;
    glm::dvec2 foot_, way_{1.0, 0.0};
    double length_, radius_;
    std::vector<Piece> pieces_;
    std::vector<std::optional<double>> ends_;
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
    const double radius = radius_at(wood, content.time), lost = mass_lost(wood, content.time);
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
    const auto lying = std::make_shared<LyingTrunk>(frame.floor(), wood, content.time);
    // Rotten wood sinks into the ground.
    const double raised = 0.72 - 0.55 * lost;
    return TrunkLine{from, to, whole, lying->breaks(from, to), [=, &frame](double s) {
                         const double here = radius * taper_at(wood, s);
                         const LyingTrunk::Lying place = lying->at(s);
                         return TrunkSection{
                             frame.at(place.at.x, place.at.y, place.height + raised * here), here};
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
