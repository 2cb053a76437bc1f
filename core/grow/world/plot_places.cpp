#include "core/grow/world/plot_places.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/world/tree_growth.h"
#include "core/world/world.h"

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

/// A trunk that lies. It is rigid: it rests on the two places of the ground on either side of its middle that hold it, and
/// breaks where it would span a deep hollow. A rotten one is broken in any case, and its pieces have come apart.
class LyingTrunk {
  public:
    LyingTrunk(const FloorHeights& floor, const DeadWood& wood, WorldTime time)
        : foot_(metres(wood.at.x), metres(wood.at.y)),
          lost_(mass_lost(wood, time)),
          random_(static_cast<std::uint32_t>(wood.id), purposes::plot_pieces, 5) {
        const SineCosine turn = sine_cosine(wood.direction);
        way_ = {turn.cosine, turn.sine};
        const double radius = radius_at(wood, time);
        step_ = wood.length / std::max(1.0, std::ceil(wood.length / most_step));
        // Rotten wood sinks into the ground.
        const double raised = 0.62 - 0.48 * lost_;
        for (double s = 0.0; s < wood.length + 0.5 * step_; s += step_) {
            ground_.push_back(floor.at(foot_.x + s * way_.x, foot_.y + s * way_.y));
            radii_.push_back(radius * taper_at(wood, s));
            axis_.push_back(ground_.back() + raised * radii_.back());
        }
        longest_ = lost_ > 0.6 ? 5.0 : 1e9;
        split(0, ground_.size() - 1);
    }

    /// Returns the axis at a distance from the foot: its place, and its height.
    struct Axis {
        glm::dvec2 at;
        double height;
    };
    [[nodiscard]] Axis at(double s) const {
        auto next = std::find_if(pieces_.begin(), pieces_.end(),
                                 [s](const Piece& one) { return s < one.part.to; });
        if (next == pieces_.end()) --next;
        const TrunkPart& part = next->part;
        // Where wood is gone, what is left of it is nearest.
        const double along = std::clamp(s, part.from, part.to),
                     share = (along - part.from) / (part.to - part.from);
        const glm::dvec2 aside(-way_.y, way_.x);
        return {foot_ + along * way_ + glm::mix(next->aside_from, next->aside_to, share) * aside,
                glm::mix(next->height_from, next->height_to, share)};
    }

    /// Returns the pieces between two distances from the foot that are long enough to be seen.
    [[nodiscard]] std::vector<TrunkPart> parts(double from, double to) const {
        constexpr double shortest_seen = 0.2;
        std::vector<TrunkPart> out;
        for (const Piece& piece : pieces_) {
            const TrunkPart part{std::max(piece.part.from, from), std::min(piece.part.to, to)};
            if (part.to - part.from >= shortest_seen) out.push_back(part);
        }
        return out;
    }

  private:
    /// A piece with the height of its axis, and its distance to the left of the trunk's line, at both ends, metres.
    struct Piece {
        TrunkPart part;
        double height_from, height_to;
        double aside_from = 0.0, aside_to = 0.0;
    };

    /// How a rigid piece lies: the steps that hold it, and the height of its axis at its ends.
    struct Rest {
        std::size_t left, right;
        double from, to;
    };

    /// Returns how a piece between two steps comes to rest.
    [[nodiscard]] Rest rest_of(std::size_t from, std::size_t to) const {
        // Of all lines through two places on either side of the middle, only the highest one is nowhere below its ground.
        const std::size_t middle = from + (to - from) / 2;
        Rest rest{from, to, axis_[from], axis_[to]};
        double highest = -1e300;
        for (std::size_t i = from; i <= middle; ++i)
            for (std::size_t j = middle + 1; j <= to; ++j) {
                const double slope = (axis_[j] - axis_[i]) / static_cast<double>(j - i),
                             height = axis_[i] + slope * static_cast<double>(middle - i);
                if (height <= highest) continue;
                highest = height;
                rest = {i, j, axis_[i] - slope * static_cast<double>(i - from),
                        axis_[j] + slope * static_cast<double>(to - j)};
            }
        return rest;
    }

    /// Adds the pieces of a part.
    void split(std::size_t from, std::size_t to) {
        const Rest rest = rest_of(from, to);
        const double steps = static_cast<double>(to - from), length = steps * step_;
        double gap = 0.0;
        for (std::size_t i = from; i <= to; ++i) {
            const double share = static_cast<double>(i - from) / steps;
            gap = std::max(gap, glm::mix(rest.from, rest.to, share) - radii_[i] - ground_[i]);
        }
        if (!(gap > widest_gap && length > shortest) && length <= longest_) {
            add(from, to, rest);
            return;
        }
        // It breaks over what holds it, unless little would come off.
        std::size_t where =
            from + static_cast<std::size_t>((0.4 + 0.2 * random_.uniform()) * steps + 0.5);
        for (const std::size_t held : {rest.left, rest.right})
            if (length <= longest_ && static_cast<double>(held - from) * step_ > 0.4 * shortest &&
                static_cast<double>(to - held) * step_ > 0.4 * shortest)
                where = held;
        where = std::clamp(where, from + 1, to - 1);
        split(from, where);
        split(where, to);
    }

    void add(std::size_t from, std::size_t to, const Rest& rest) {
        Piece piece{{static_cast<double>(from) * step_, static_cast<double>(to) * step_},
                    rest.from,
                    rest.to};
        // Rot takes the wood at a break, and what is loose has rolled.
        const double loose = smooth_step(0.25, 0.8, lost_),
                     length = piece.part.to - piece.part.from,
                     slope = (rest.to - rest.from) / length;
        const auto shorten = [&](double& end, double& height, double way) {
            const double by = way * loose * std::min(0.04 + 0.2 * random_.uniform(), 0.2 * length);
            end += by;
            height += by * slope;
        };
        if (from > 0) shorten(piece.part.from, piece.height_from, 1.0);
        if (to + 1 < ground_.size()) shorten(piece.part.to, piece.height_to, -1.0);
        piece.aside_from = 1.1 * loose * radii_[from] * random_.symmetric();
        piece.aside_to = 1.1 * loose * radii_[to] * random_.symmetric();
        pieces_.push_back(piece);
    }

    /// The step at which the ground is looked at; what a trunk spans; and the length of pieces that are not divided, metres.
    static constexpr double most_step = 0.6, widest_gap = 0.45, shortest = 4.0;

    glm::dvec2 foot_, way_{1.0, 0.0};
    double lost_, step_ = most_step, longest_ = 0.0;
    Random random_;
    std::vector<double> ground_, radii_,
        axis_;  ///< at each step; the axis where the ground holds it
    std::vector<Piece> pieces_;
};

TrunkLine line_of_snag(const DeadWood& wood, const PlotContent& content, const PlotFrame& frame) {
    const double x = metres(wood.at.x), y = metres(wood.at.y);
    const double radius = radius_at(wood, content.time);
    const double height = length_at(wood, content.time);
    const double ground = frame.floor().at(x, y) - 0.2 * radius;
    return {
        0.0, height, height, {{0.0, height}}, [=, &frame](double up) {
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
    return TrunkLine{from, to, whole, lying.parts(from, to), [=, &frame](double s) {
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

bool stands_within(const StandTree& tree, WorldTime time, const PlotFrame& frame) {
    // Of a trunk's radius.
    constexpr double roots = 1.6;
    const double x = metres(tree.at.x), y = metres(tree.at.y),
                 foot = roots * 0.5 * trunk_diameter(height_at(tree, time));
    const WorldBox& box = frame.box();
    return x - foot >= box.west && x + foot < box.east && y - foot >= box.south &&
           y + foot < box.north;
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

std::vector<Contact> contacts_on(const PlotContent& content, const PlotFrame& frame, bool is_slab) {
    constexpr double foot_radii = 1.2, step = 0.4, most_gap = 0.25;
    const WorldBox wide = grown(frame.box(), 2.0);
    std::vector<Contact> contacts;
    for (const StandTree& tree : content.trees) {
        if (!tree.lives_at(content.time) || !contains(wide, tree.at) ||
            (is_slab && !stands_within(tree, content.time, frame)))
            continue;
        const glm::dvec2 at(metres(tree.at.x), metres(tree.at.y));
        const double diameter = trunk_diameter(height_at(tree, content.time));
        if (diameter > 0.0) contacts.push_back({at, at, 0.5 * foot_radii * diameter});
    }
    for (const DeadWood& wood : content.dead_wood) {
        const std::optional<TrunkLine> line = trunk_line(wood, content, frame);
        if (!line) continue;
        if (!wood.lies_at(content.time)) {
            const TrunkSection foot = line->section(0.0);
            const glm::dvec2 at = frame.below(foot.middle);
            contacts.push_back({at, at, foot.radius});
            continue;
        }
        for (const TrunkPart& part : line->parts) {
            const double steps = std::max(1.0, std::ceil((part.to - part.from) / step));
            const auto section_at = [&](double i) {
                return line->section(
                    std::min(part.from + (part.to - part.from) * i / steps, part.to - 1e-6));
            };
            for (double i = 0.0; i < steps; i += 1.0) {
                const TrunkSection from = section_at(i), to = section_at(i + 1.0);
                const glm::dvec2 start = frame.below(from.middle), end = frame.below(to.middle);
                const glm::dvec2 middle = 0.5 * (start + end);
                const double radius = 0.5 * (from.radius + to.radius),
                             below = 0.5 * (from.middle.y + to.middle.y) + frame.height() - radius;
                if (below - frame.floor().at(middle.x, middle.y) < most_gap * radius)
                    contacts.push_back({start, end, radius});
            }
        }
    }
    return contacts;
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
