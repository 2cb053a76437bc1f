#include "core/trace/cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/math/elementary.h"
#include "core/problems.h"
#include "core/trace/colour_mixture.h"
#include "core/trace/geodesic.h"
#include "core/trace/max_flow.h"

namespace sporeprint::trace {

namespace {

/// Weight of the border's contrast, and the bound of what one colour may count, in units of the
/// logarithm of a density.
constexpr double border_weight = 50.0, most_colour = 40.0;

/// Weight of the distance from the strokes, per pixel.
constexpr double distance_weight = 0.02;

/// Integer capacity of a weight of 1.
constexpr double unit = 256.0;

/// Width of strokes, pixels of the small copy, and how often their pixels count as colours of the mushroom.
constexpr double stroke_width = 3.0, stroke_weight = 3.0;

/// Share of the long side that is background all round where no frame was drawn.
constexpr double border_share = 0.02;

constexpr int most_rounds = 4;
constexpr double least_change = 0.0005;  ///< share of the pixels

/// Half the width of the band in which the border is found on the large copy, small pixels.
constexpr int band = 2;

std::int32_t capacity(double weight) { return static_cast<std::int32_t>(weight * unit + 0.5); }

glm::dvec3 colour_at(const Picture& photo, std::size_t pixel) {
    return {static_cast<double>(photo.rgb[3 * pixel]),
            static_cast<double>(photo.rgb[3 * pixel + 1]),
            static_cast<double>(photo.rgb[3 * pixel + 2])};
}

/// What a gesture says of the pixels of a copy.
struct Seeds {
    Mask mushroom, rest;
};

Seeds seeds_of(const Gesture& gesture, const Picture& photo) {
    std::vector<Stroke> strokes = gesture.keep;
    strokes.push_back(gesture.axis);
    if (!gesture.cap.empty()) strokes.push_back(gesture.cap);
    Seeds seeds{drawn(strokes, photo.width, photo.height, stroke_width),
                drawn(gesture.drop, photo.width, photo.height, stroke_width)};
    const double border = border_share * std::max(photo.width, photo.height);
    const PhotoFrame frame = gesture.frame.value_or(
        PhotoFrame{{border, border}, {photo.width - border, photo.height - border}});
    for (int y = 0; y < photo.height; ++y)
        for (int x = 0; x < photo.width; ++x)
            if (x + 0.5 < frame.from.x || x + 0.5 > frame.to.x || y + 0.5 < frame.from.y ||
                y + 0.5 > frame.to.y)
                seeds.rest.inside[seeds.rest.index(x, y)] = 1;
    // A stroke that leaves the frame is the mushroom's all the same, but not where it is dropped.
    for (std::size_t i = 0; i < seeds.rest.inside.size(); ++i)
        if (seeds.mushroom.inside[i] != 0) seeds.rest.inside[i] = 0;
    return seeds;
}

/// The colours of the mushroom and those of the rest.
struct Colours {
    ColourMixture mushroom, rest;

    /// Returns how much worse a colour suits the mushroom than the rest.
    [[nodiscard]] double cost(const glm::dvec3& colour) const {
        return std::clamp(mushroom.cost(colour) - rest.cost(colour), -most_colour, most_colour);
    }
};

/// Returns the colours of both sides of a cut; strokes count more.
Colours colours_of(const Picture& photo, const Mask& inside, const Mask& rest,
                   const Mask& strokes) {
    std::vector<WeightedColour> of_mushroom, of_rest;
    for (std::size_t i = 0; i < inside.inside.size(); ++i) {
        const glm::dvec3 colour = colour_at(photo, i);
        if (inside.inside[i] != 0)
            of_mushroom.push_back({colour, strokes.inside[i] != 0 ? stroke_weight : 1.0});
        else if (rest.inside[i] != 0)
            of_rest.push_back({colour, 1.0});
    }
    if (of_rest.empty()) of_rest.push_back({colour_at(photo, 0), 1.0});
    return {ColourMixture(of_mushroom), ColourMixture(of_rest)};
}

/// A part of a photograph: columns and rows from the first to before the last.
struct Region {
    int left = 0, top = 0, right = 0, bottom = 0;

    [[nodiscard]] int width() const { return right - left; }
    [[nodiscard]] int height() const { return bottom - top; }
};

/// The cost of a border between neighbours, which falls with the contrast of their colours.
class Contrast {
  public:
    /// beta  contrast_scale()
    explicit Contrast(double beta) {
        // Squares of differences are whole numbers; beyond the last of these a border costs nothing.
        constexpr double square_of_range = 3.0 * 255.0 * 255.0;
        for (double difference = 0.0; difference <= square_of_range; difference += 1.0) {
            const double weight = border_weight * exponential(-beta * difference);
            const std::int32_t straight = capacity(weight);
            if (straight == 0) break;
            costs_.push_back({straight, capacity(weight / 1.4142135623730951)});
        }
    }

    /// Adds the edges of a region in which the pixels are open, and of those to their neighbours.
    ///
    /// is_open  of each pixel of the photograph; none for all
    void add_to(GridFlow& flow, const Picture& photo, const Region& region,
                const Mask* is_open) const {
        const Mask shape(photo.width, photo.height);
        for (int y = region.top; y < region.bottom; ++y)
            for (int x = region.left; x < region.right; ++x)
                for (std::size_t step = 4; step < 8; ++step) {
                    const int u = x + grid_steps[step][0], v = y + grid_steps[step][1];
                    if (u < region.left || u >= region.right || v >= region.bottom) continue;
                    if (is_open && !is_open->at(x, y) && !is_open->at(u, v)) continue;
                    const auto difference = static_cast<std::size_t>(
                        colour_difference(photo, shape.index(x, y), shape.index(u, v)));
                    if (difference >= costs_.size()) continue;
                    const bool is_diagonal = grid_steps[step][0] != 0 && grid_steps[step][1] != 0;
                    const std::int32_t both = costs_[difference][is_diagonal ? 1 : 0];
                    flow.add_edge(x - region.left, y - region.top, step, both);
                    flow.add_edge(u - region.left, v - region.top, 7 - step, both);
                }
    }

  private:
    std::vector<std::array<std::int32_t, 2>> costs_;  ///< beside each other, and across a corner
};

/// The cut on the small copy.
class SmallCut {
  public:
    SmallCut(const Picture& photo, const Seeds& seeds)
        : photo_(photo),
          seeds_(seeds),
          beta_(contrast_scale(photo)),
          contrast_(beta_),
          geodesics_(geodesics_from(seeds.mushroom, photo, beta_)) {}

    /// Returns the cut after the last round.
    [[nodiscard]] Mask solved() const {
        Mask inside = seeds_.mushroom, rest = seeds_.rest;
        for (int round = 0; round < most_rounds; ++round) {
            const Mask next = cut_by(colours_of(photo_, inside, rest, seeds_.mushroom));
            std::size_t changed = 0;
            for (std::size_t i = 0; i < next.inside.size(); ++i)
                changed += next.inside[i] != inside.inside[i] ? 1 : 0;
            inside = next;
            rest = inverted(next);
            if (static_cast<double>(changed) <
                least_change * static_cast<double>(next.inside.size()))
                break;
        }
        return inside;
    }

  private:
    const Picture& photo_;
    const Seeds& seeds_;
    double beta_;
    Contrast contrast_;
    Geodesics geodesics_;

    [[nodiscard]] Mask cut_by(const Colours& colours) const {
        GridFlow flow(photo_.width, photo_.height);
        contrast_.add_to(flow, photo_, {0, 0, photo_.width, photo_.height}, nullptr);
        for (int y = 0; y < photo_.height; ++y)
            for (int x = 0; x < photo_.width; ++x) {
                const std::size_t i = seeds_.mushroom.index(x, y);
                if (seeds_.mushroom.inside[i] != 0) {
                    flow.add_terminal(x, y, GridFlow::endless, 0);
                    continue;
                }
                if (seeds_.rest.inside[i] != 0) {
                    flow.add_terminal(x, y, 0, GridFlow::endless);
                    continue;
                }
                const double cost =
                    colours.cost(colour_at(photo_, i)) + distance_weight * geodesics_.distance[i];
                flow.add_terminal(x, y, capacity(std::max(-cost, 0.0)),
                                  capacity(std::max(cost, 0.0)));
                // A pixel is the mushroom's only if the next one on its way to a stroke is.
                flow.add_edge(x, y, geodesics_.towards[i], GridFlow::endless / 2);
            }
        static_cast<void>(flow.solve());
        Mask mask(photo_.width, photo_.height);
        for (int y = 0; y < photo_.height; ++y)
            for (int x = 0; x < photo_.width; ++x)
                mask.inside[mask.index(x, y)] = flow.on_source_side(x, y) ? 1 : 0;
        return mask;
    }
};

/// Returns the pixels within a distance of the border of a mask, measured along rows and columns.
Mask near_border(const Mask& mask, int distance) {
    // Sums over squares: neither all inside nor all outside.
    const int width = mask.width, height = mask.height;
    std::vector<std::int32_t> sums(static_cast<std::size_t>(width + 1) *
                                   static_cast<std::size_t>(height + 1));
    const auto at = [&](int x, int y) -> std::int32_t& {
        return sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(width + 1) +
                    static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            at(x + 1, y + 1) = at(x, y + 1) + at(x + 1, y) - at(x, y) + (mask.at(x, y) ? 1 : 0);
    Mask found(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int left = std::max(x - distance, 0), right = std::min(x + distance + 1, width),
                      top = std::max(y - distance, 0), bottom = std::min(y + distance + 1, height);
            const std::int32_t inside =
                at(right, bottom) - at(left, bottom) - at(right, top) + at(left, top);
            found.inside[found.index(x, y)] =
                inside > 0 && inside < (right - left) * (bottom - top) ? 1 : 0;
        }
    return found;
}

/// Returns the least region that contains a mask and one pixel around it.
Region region_of(const Mask& mask) {
    Region region{mask.width, mask.height, 0, 0};
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            if (!mask.at(x, y)) continue;
            region = {std::min(region.left, x - 1), std::min(region.top, y - 1),
                      std::max(region.right, x + 2), std::max(region.bottom, y + 2)};
        }
    return {std::max(region.left, 0), std::max(region.top, 0), std::min(region.right, mask.width),
            std::min(region.bottom, mask.height)};
}

/// Returns the cut on the large copy, which differs from that of the small one near its border only.
Mask refined(const Picture& large, const Mask& small, const Colours& colours, const Seeds& seeds) {
    Mask mask = resized(small, large.width, large.height);
    const int scale = std::max(large.width, large.height) / std::max(small.width, small.height);
    Mask open = near_border(mask, band * std::max(scale, 1));
    if (open.area() == 0) return mask;
    for (std::size_t i = 0; i < open.inside.size(); ++i) {
        if (open.inside[i] == 0 || seeds.mushroom.inside[i] + seeds.rest.inside[i] == 0) continue;
        open.inside[i] = 0;
        mask.inside[i] = seeds.mushroom.inside[i];
    }
    const Region region = region_of(open);
    GridFlow flow(region.width(), region.height());
    Contrast(contrast_scale(large)).add_to(flow, large, region, &open);
    const auto each = [&](const auto& visit) {
        for (int y = region.top; y < region.bottom; ++y)
            for (int x = region.left; x < region.right; ++x)
                visit(x - region.left, y - region.top, mask.index(x, y), open.at(x, y));
    };
    each([&](int x, int y, std::size_t i, bool is_open) {
        if (!is_open) {
            const bool inside = mask.inside[i] != 0;
            flow.add_terminal(x, y, inside ? GridFlow::endless : 0, inside ? 0 : GridFlow::endless);
            return;
        }
        const double cost = colours.cost(colour_at(large, i));
        flow.add_terminal(x, y, capacity(std::max(-cost, 0.0)), capacity(std::max(cost, 0.0)));
    });
    static_cast<void>(flow.solve());
    each([&](int x, int y, std::size_t i, bool is_open) {
        if (is_open) mask.inside[i] = flow.on_source_side(x, y) ? 1 : 0;
    });
    return mask;
}

/// Returns what is left of a cut without holes, spurs and parts that no stroke touches: its largest part.
Mask cleaned(const Mask& mask, const Mask& strokes) {
    return largest_part(
        connected_with(opened(without_holes(connected_with(mask, strokes))), strokes));
}

}  // namespace

void require_on(const PictureSize& photo, const Gesture& gesture) {
    std::vector<Problem> problems;
    if (gesture.axis.size() < 2) report(problems, "/gesture/axis", "needs at least two points");
    const std::string size = std::to_string(photo.width) + " x " + std::to_string(photo.height);
    const auto require_stroke = [&](const Stroke& stroke, const std::string& path) {
        for (std::size_t i = 0; i < stroke.size(); ++i) {
            const glm::dvec2& at = stroke[i];
            if (!(at.x >= 0.0 && at.y >= 0.0 && at.x <= photo.width && at.y <= photo.height))
                report(problems, path + "/" + std::to_string(i),
                       "is not on the photograph of " + size + " pixels");
        }
    };
    require_stroke(gesture.axis, "/gesture/axis");
    require_stroke(gesture.cap, "/gesture/cap");
    for (std::size_t i = 0; i < gesture.keep.size(); ++i)
        require_stroke(gesture.keep[i], "/gesture/keep/" + std::to_string(i));
    for (std::size_t i = 0; i < gesture.drop.size(); ++i)
        require_stroke(gesture.drop[i], "/gesture/drop/" + std::to_string(i));
    if (const auto& frame = gesture.frame;
        frame && (frame->from.x >= photo.width || frame->from.y >= photo.height))
        report(problems, "/gesture/frame", "is not on the photograph of " + size + " pixels");
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

Mask cut_out_of_copy(const Picture& large, const Gesture& gesture) {
    const Picture small = reduced(large, small_side);
    const double scale = static_cast<double>(small.width) / large.width;
    Gesture on_small = gesture.scaled(scale);
    Seeds of_small = seeds_of(on_small, small);
    Mask first = cleaned(SmallCut(small, of_small).solved(), of_small.mushroom);
    // Few people begin and end a line right on the border; what is beyond is neither mushroom nor its colour.
    bool is_beyond = false;
    for (Stroke* const stroke : {&on_small.axis, &on_small.cap}) {
        Stroke within = without_overshoot(*stroke, first, stroke_width);
        is_beyond = is_beyond || within.size() != stroke->size();
        *stroke = std::move(within);
    }
    if (is_beyond) {
        of_small = seeds_of(on_small, small);
        first = cleaned(SmallCut(small, of_small).solved(), of_small.mushroom);
    }
    const Seeds of_large = seeds_of(is_beyond ? on_small.scaled(1.0 / scale) : gesture, large);
    if (first.area() == 0)
        throw InvalidInput("/gesture/axis",
                           "nothing hangs together on this line; draw it through the middle of the "
                           "mushroom, from end to end");
    const Colours colours = colours_of(small, first, inverted(first), of_small.mushroom);
    return cleaned(refined(large, first, colours, of_large), of_large.mushroom);
}

Mask cut_out(const Picture& photo, const Gesture& gesture) {
    require_on({photo.width, photo.height}, gesture);
    const Picture large = reduced(photo, large_side);
    return cut_out_of_copy(large, gesture.scaled(static_cast<double>(large.width) / photo.width));
}

}  // namespace sporeprint::trace
