#include "core/trace/face_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "core/math/elementary.h"
#include "core/surface/charts.h"
#include "core/trace/colour_sample.h"
#include "core/trace/contour.h"
#include "core/trace/hue.h"
#include "core/trace/skin_patch.h"

namespace sporeprint::trace {

namespace {

/// A hue is quite another one by more steps: a brown cap may have a cream margin. A lower face has one hue.
constexpr int other_hue = 4, other_hue_below = 2;

/// The stem is nearer to the camera than the face, so it seems wider.
constexpr double stem_nearer = 1.25;

/// A place on the meridian of a face.
struct MeridianPlace {
    double radius = 0.0;     ///< of the widest place of the cap
    double lift = 0.0;       ///< height over the margin, of that of the middle
    double steepness = 0.0;  ///< horizontal part of the normal, outwards where positive
    bool is_seen = true;     ///< nothing of the face is before it
};

/// The meridian of a face from the middle to the margin, as it is seen along the axis.
class Meridian {
  public:
    Meridian(const Outline& outline, Face face) {
        const SubCurve& curve = face == Face::upper ? outline.cap : outline.hymenium;
        std::vector<OutlineSample> samples;
        samples.reserve(count);
        double widest = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            const double share = static_cast<double>(i) / (count - 1);
            samples.push_back(curve.at(face == Face::upper ? 1.0 - share : share));
            widest = std::max(
                {widest, samples.back().r, outline.cap.at(static_cast<double>(i) / (count - 1)).r});
        }
        const OutlineSample &middle = samples.front(), &margin = samples.back();
        const double height = middle.y - margin.y, width = widest - middle.r;
        const bool is_flat = std::abs(height) < 0.05 * widest;
        double reached = 0.0;
        places_.reserve(count);
        for (const OutlineSample& sample : samples) {
            // The outline runs from base to apex, with the skin to its right.
            places_.push_back({widest > 0.0 ? sample.r / widest : 0.0,
                               is_flat ? (width > 0.0 ? 1.0 - (sample.r - middle.r) / width : 0.0)
                                       : (sample.y - margin.y) / height,
                               sample.tangent_y, sample.r >= reached});
            reached = std::max(reached, sample.r);
        }
    }

    /// Returns the place at a share of the arc from the middle to the margin.
    [[nodiscard]] MeridianPlace at(double share) const {
        const double place = std::clamp(share, 0.0, 1.0) * (count - 1);
        const auto i = std::min(static_cast<std::size_t>(place), count - 2);
        const double part = place - static_cast<double>(i);
        const MeridianPlace &a = places_[i], &b = places_[i + 1];
        return {(1.0 - part) * a.radius + part * b.radius, (1.0 - part) * a.lift + part * b.lift,
                (1.0 - part) * a.steepness + part * b.steepness, a.is_seen && b.is_seen};
    }

  private:
    static constexpr std::size_t count = 257;
    std::vector<MeridianPlace> places_;
};

/// The margin of a cap on a photograph.
class Rim {
  public:
    explicit Rim(const Mask& mask) {
        glm::dvec2 sum(0.0);
        double xx = 0.0, xy = 0.0, yy = 0.0;
        const auto count = static_cast<double>(std::max<std::size_t>(mask.area(), 1));
        each_pixel(mask, [&](int, int, const glm::dvec2& at) { sum += at; });
        middle_ = sum / count;
        each_pixel(mask, [&](int, int, const glm::dvec2& at) {
            const glm::dvec2 away = at - middle_;
            xx += away.x * away.x / count;
            xy += away.x * away.y / count;
            yy += away.y * away.y / count;
        });
        // The second moments of an ellipse are a quarter of the squares of its half axes.
        const double root = std::sqrt(std::max(xx * yy - xy * xy, 0.0));
        const double scale = 2.0 / std::sqrt(std::max(xx + yy + 2.0 * root, 1e-9));
        to_ellipse_ = {scale * (xx + root), scale * xy, scale * xy, scale * (yy + root)};
        size_ = 2.0 * std::sqrt(root);
        reach_to(mask);
        compare_with(mask);
    }

    [[nodiscard]] const glm::dvec2& middle() const { return middle_; }

    /// Returns the share of the mask and the ellipse together that both have.
    [[nodiscard]] double likeness() const { return likeness_; }

    /// Returns the radius of a circle of the area of the ellipse, pixels.
    [[nodiscard]] double size() const { return size_; }

    /// Returns the way from the middle to the margin in a direction round the cap.
    [[nodiscard]] glm::dvec2 way(double angle) const {
        const double turns = angle / (2.0 * pi) + 1.0;
        const double place = (turns - std::floor(turns)) * directions;
        const auto i = static_cast<std::size_t>(place) % directions;
        const double part = place - std::floor(place);
        const SineCosine way = sine_cosine(angle);
        return ((1.0 - part) * reach_[i] + part * reach_[(i + 1) % directions]) *
               (to_ellipse_ * glm::dvec2(way.cosine, way.sine));
    }

  private:
    static constexpr std::size_t directions = 360;
    glm::dvec2 middle_{0.0};
    glm::dmat2 to_ellipse_{1.0};
    double size_ = 0.0, likeness_ = 0.0;
    std::array<double, directions> reach_{};

    void compare_with(const Mask& mask) {
        const glm::dmat2 to_circle = glm::inverse(to_ellipse_);
        std::size_t both = 0, either = 0;
        for (int y = 0; y < mask.height; ++y)
            for (int x = 0; x < mask.width; ++x) {
                const glm::dvec2 away = to_circle * (glm::dvec2(x + 0.5, y + 0.5) - middle_);
                const bool in_ellipse = glm::dot(away, away) < 1.0, in_mask = mask.at(x, y);
                both += in_ellipse && in_mask ? 1U : 0U;
                either += in_ellipse || in_mask ? 1U : 0U;
            }
        likeness_ =
            static_cast<double>(both) / static_cast<double>(std::max<std::size_t>(either, 1));
    }

    void reach_to(const Mask& mask) {
        constexpr double farthest = 1.6;  // ellipses; what is farther is none of the cap
        std::array<double, directions> seen{};
        for (std::size_t i = 0; i < directions; ++i) {
            const SineCosine turn = sine_cosine(2.0 * pi * static_cast<double>(i) / directions);
            const glm::dvec2 way = to_ellipse_ * glm::dvec2(turn.cosine, turn.sine);
            const double step = 1.0 / std::max(glm::length(way), 1.0);
            double reach = farthest;
            while (reach > step && !mask.at(middle_ + reach * way)) reach -= step;
            seen[i] = reach;
        }
        // A notch or a blade of grass moves no skin; a wave of the margin does.
        constexpr std::size_t window = 15;
        for (std::size_t i = 0; i < directions; ++i) {
            std::array<double, window> around{};
            for (std::size_t k = 0; k < window; ++k)
                around[k] = seen[(i + directions + k - window / 2) % directions];
            std::nth_element(around.begin(), around.begin() + window / 2, around.end());
            reach_[i] = around[window / 2];
        }
    }
};

double widest_of(const SubCurve& curve) {
    double widest = 0.0;
    for (int i = 0; i <= 64; ++i) widest = std::max(widest, curve.at(i / 64.0).r);
    return widest;
}

/// Returns the convex hull of a mask's pixels, whose notches are so bridged.
Mask hull_of(const Mask& mask) {
    // Andrew's monotone chains over the ends of the rows.
    std::vector<glm::ivec2> ends;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y) && !(mask.at(x - 1, y) && mask.at(x + 1, y))) ends.emplace_back(x, y);
    std::array<std::vector<glm::ivec2>, 2> chains;
    const auto turn = [](const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    for (int side = 0; side < 2; ++side) {
        const int sign = side == 0 ? 1 : -1;
        std::vector<glm::ivec2>& chain = chains[static_cast<std::size_t>(side)];
        for (const glm::ivec2& end : ends) {
            while (chain.size() > 1 && sign * turn(chain[chain.size() - 2], chain.back(), end) <= 0)
                chain.pop_back();
            chain.push_back(end);
        }
    }
    Contour contour;
    contour.reserve(chains[0].size() + chains[1].size());
    for (const glm::ivec2& end : chains[0]) contour.emplace_back(end.x + 0.5, end.y + 0.5);
    for (std::size_t i = chains[1].size(); i-- > 0;)
        contour.emplace_back(chains[1][i].x + 0.5, chains[1][i].y + 0.5);
    return inside_of(contour, {mask.width, mask.height});
}

/// The stem on a photograph from below.
struct HiddenStem {
    glm::dvec2 from{0.0}, to{0.0};
    double radius = 0.0;  ///< pixels

    [[nodiscard]] bool hides(const glm::dvec2& at) const {
        return distance_from_segment(at, from, to) < radius;
    }
};

/// The lower face on a photograph: the margin, and the stem before it.
struct LowerFace {
    Rim rim;
    HiddenStem stem;
};

/// Returns half the width of a stem where it is narrow on a photograph; that of the mask where all of the stem is
/// before the face.
double stem_radius(const Mask& mask, const glm::dvec2& from, const glm::dvec2& to) {
    constexpr int places = 32;
    const glm::dvec2 way = to - from;
    const double length = std::max(glm::length(way), 1.0);
    const glm::dvec2 across = glm::dvec2(-way.y, way.x) / length;
    std::array<double, places> radii{};
    for (int i = 0; i < places; ++i) {
        const glm::dvec2 middle = from + (i + 0.5) / places * way;
        double width = 0.0;
        for (const double side : {-1.0, 1.0}) {
            double reach = 0.0;
            while (mask.at(middle + side * reach * across)) reach += 1.0;
            width += reach;
        }
        radii[static_cast<std::size_t>(i)] = 0.5 * width;
    }
    const auto narrow = radii.begin() + places / 4;
    std::nth_element(radii.begin(), narrow, radii.end());
    return *narrow;
}

/// Finds the margin of a lower face: that of what hangs together without the stem and what is at its end.
///
/// stem_share  radius of the stem, of that of the cap
LowerFace lower_face(const FaceView& view, double stem_share) {
    LowerFace found{Rim(view.mask), {}};
    const glm::dvec2 centre = view.centre.value_or(found.rim.middle());
    const auto stem_of = [&](double most) {
        return HiddenStem{centre, view.stem_end.value_or(centre),
                          stem_nearer * std::min(stem_share * found.rim.size(), most)};
    };
    found.stem = stem_of(1e300);
    if (!view.stem_end) return found;
    const double seen = stem_radius(view.mask, centre, *view.stem_end);
    found.stem = stem_of(seen);
    Mask beside = view.mask;
    each_pixel(view.mask, [&](int x, int y, const glm::dvec2& at) {
        if (found.stem.hides(at)) beside.inside[beside.index(x, y)] = 0;
    });
    beside = largest_part(beside);
    if (beside.area() == 0) return found;
    found.rim = Rim(hull_of(beside));
    found.stem = stem_of(seen);
    return found;
}

/// The mask of a cap and an ellipse have more of both in common.
constexpr double least_likeness = 0.85;

/// Rings of a face, each of which has a commonest hue.
constexpr std::size_t bands = 8;

std::size_t band_of(double share) {
    return std::min(static_cast<std::size_t>(share * bands), bands - 1);
}

/// The square of a disc with what the photograph shows of it.
struct Disc {
    SkinPatch patch;
    std::vector<ShadePlace> places;
    std::vector<Pixel> pixels;
    std::vector<double> shares;  ///< of the meridian; less than 0 where there is no face
    std::size_t texels = 0;      ///< of the face
    bool is_round = false;       ///< the mask has the outline of a cap
};

/// Hides the texels that are near to those of another hue: an edge has some of both colours.
void hide_near(Disc& disc, const std::vector<std::size_t>& others) {
    constexpr int reach = 4;
    for (const std::size_t other : others) {
        const int column = static_cast<int>(other % image_side),
                  row = static_cast<int>(other / image_side);
        for (int y = std::max(row - reach, 0); y <= std::min(row + reach, image_side - 1); ++y)
            for (int x = std::max(column - reach, 0); x <= std::min(column + reach, image_side - 1);
                 ++x)
                disc.patch.is_seen[static_cast<std::size_t>(y * image_side + x)] = false;
    }
}

/// Hides what is none of the skin. Caps change their hue from the middle to the margin; round a lower face the skin of
/// the cap is seen, whose hue may be common there.
void hide_other_hues(Disc& disc, Face face) {
    std::array<std::vector<Pixel>, bands> seen;
    std::vector<Pixel> all;
    for (std::size_t i = 0; i < disc.pixels.size(); ++i) {
        if (!disc.patch.is_seen[i]) continue;
        seen[band_of(disc.shares[i])].push_back(disc.pixels[i]);
        all.push_back(disc.pixels[i]);
    }
    std::array<Hue, bands> hues{};
    hues.fill(commonest_hue(std::move(all)));
    if (face == Face::upper)
        for (std::size_t k = 0; k < bands; ++k) hues[k] = commonest_hue(std::move(seen[k]));
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < disc.pixels.size(); ++i)
        if (disc.patch.is_seen[i] &&
            !are_near(hue_of(disc.pixels[i]), hues[band_of(disc.shares[i])],
                      face == Face::upper ? other_hue : other_hue_below))
            others.push_back(i);
    hide_near(disc, others);
}

Disc disc_of(const FaceView& view, const Outline& outline, Face face) {
    const Meridian meridian(outline, face);
    const double widest = std::max(widest_of(outline.cap), widest_of(outline.hymenium));
    const double stem_share = widest > 0.0 ? widest_of(outline.stem) / widest : 0.0;
    const auto [rim, stem] = face == Face::lower ? lower_face(view, stem_share)
                                                 : LowerFace{Rim(view.mask), HiddenStem{}};
    const glm::dvec2 centre = view.centre.value_or(rim.middle());
    const PhotoLight light(view.picture);
    const double inner = face == Face::upper ? 0.0 : hymenium_inner_share;
    constexpr double side = image_side;
    Disc disc;
    disc.is_round = rim.likeness() >= least_likeness;
    if (!disc.is_round) return disc;
    disc.patch.rows = disc.patch.columns = image_side;
    constexpr std::size_t texels = std::size_t{image_side} * image_side;
    disc.patch.light.assign(texels, glm::dvec3(0.0));
    disc.patch.is_seen.assign(texels, false);
    disc.places.assign(texels, {});
    disc.pixels.assign(texels, {});
    disc.shares.assign(texels, -1.0);
    for (std::size_t i = 0; i < texels; ++i) {
        const std::size_t column = i % image_side, row = i / image_side;
        const double x = 2.0 * (static_cast<double>(column) + 0.5) / side - 1.0,
                     y = 2.0 * (static_cast<double>(row) + 0.5) / side - 1.0;
        const double radius = std::sqrt(x * x + y * y);
        if (radius > 1.0 || radius < inner) continue;
        ++disc.texels;
        const double share = (radius - inner) / (1.0 - inner);
        const MeridianPlace place = meridian.at(share);
        // Seen from below, what is before the mushroom is above on the photograph.
        const double angle = arc_tangent(face == Face::upper ? y : -y, x);
        const glm::dvec2 at =
            rim.middle() + place.lift * (centre - rim.middle()) + place.radius * rim.way(angle);
        disc.shares[i] = share;
        disc.patch.light[i] = light.at(at);
        const SineCosine turn = sine_cosine(angle);
        disc.places[i].normal = {place.steepness * turn.cosine, place.steepness * turn.sine};
        if (!place.is_seen || stem.hides(at) || !is_well_inside(view.mask, at)) continue;
        disc.patch.is_seen[i] = true;
        disc.pixels[i] = light.pixel(at);
    }
    hide_other_hues(disc, face);
    constexpr std::size_t rows = 64;
    for (std::size_t i = 0; i < texels; ++i)
        if (disc.patch.is_seen[i])
            disc.places[i].row =
                std::min(static_cast<std::size_t>(disc.shares[i] * rows), rows - 1);
    unshade(disc.patch, disc.places, rows);
    return disc;
}

}  // namespace

FaceShown face_shown(const FaceView& view, const Outline& outline, Face face) {
    Disc disc = disc_of(view, outline, face);
    FaceShown shown;
    shown.is_round = disc.is_round;
    if (!shown.is_round || !shows_enough(disc.patch, disc.texels)) return shown;
    std::array<ColourSample, FaceShown::places> quarters;
    ColourSample whole;
    for (std::size_t i = 0; i < disc.pixels.size(); ++i) {
        if (!disc.patch.is_seen[i]) continue;
        const auto quarter = static_cast<std::size_t>(disc.shares[i] * FaceShown::places);
        quarters[std::min(quarter, FaceShown::places - 1)].add(disc.pixels[i]);
        whole.add(disc.pixels[i]);
    }
    const Hue hue = whole.commonest_hue();
    for (std::size_t k = 0; k < FaceShown::places; ++k) shown.quarters[k] = quarters[k].colour(hue);
    fill(disc.patch);
    shown.image = picture_of(image_side, image_side, [&](double u, double v) {
        const auto column = static_cast<std::size_t>(u * image_side),
                   row = static_cast<std::size_t>(v * image_side);
        return disc.patch.light[row * image_side + column];
    });
    return shown;
}

}  // namespace sporeprint::trace
