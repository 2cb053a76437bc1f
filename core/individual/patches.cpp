#include "core/individual/patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/elementary.h"
#include "core/math/random.h"

namespace sporeprint {
namespace {

constexpr double quarter_turn = 0.5 * pi;

// No source or measurement is recorded for the values down to `full_share`.

// Largest displacement of a patch from its ring and along it, in distances between neighbours.
constexpr double latitude_deviation = 0.32, longitude_deviation = 0.3;

// Radius of the smallest patches at the apex, in that of the style; how much it varies, evenly and
// towards few large ones; factors at the apex and by which it decreases up to the margin.
constexpr double least_size = 0.62, size_spread = 0.5, large_spread = 0.35;
constexpr double apex_size = 1.15, margin_loss = 0.4;

// The same for pieces that are as unlike as can be: the radius of the smallest granules, how much
// granules differ, how much larger the few large ones are, and the further decrease to the margin.
constexpr double granule_size = 0.32, granule_spread = 0.15, spine_spread = 1.25,
                 uneven_margin_loss = 0.3;

constexpr double least_height = 0.75, most_height = 1.25;  // in that of the style

// The amount of veil from which on a patch is present: least and largest difference from it, and
// how much of the latter is random and how much is its place.
constexpr double first_survival = 0.02, survival_range = 0.86, survival_drawn = 0.8,
                 survival_placed = 0.2;

// Distance of two patches, in the sum of their radii, from which on neither becomes smaller.
constexpr double closeness = 0.8;

// Shares of its radius to which a crowded patch is reduced: it vanishes at the first and has all of
// the free space from the second on.
constexpr double absent_share = 0.2, full_share = 0.5;

// Random streams of rings follow those of patches.
constexpr std::uint32_t first_ring_stream = 0x80000000U;

// The young cap is a hemisphere, so that a share of the meridian is an angle from the pole.
struct Rings {
    std::vector<int> pieces;  // on each ring, pole first
    double first = 0.0;       // angle of the first ring from the pole
    double spacing = 0.0;     // angle between rings
};

// Returns rings spaced by one patch, each with patches in proportion to its circumference; their
// sum is `count`.
Rings rings_between(double from, double to, int count) {
    const double area = 2.0 * pi * (cosine(from) - cosine(to));
    const double piece = std::sqrt(area / count);
    const int rings = std::max(1, static_cast<int>((to - from) / piece + 0.5));
    Rings out;
    out.spacing = (to - from) / rings;
    out.first = from + 0.5 * out.spacing;
    double whole = 0.0;
    for (int ring = 0; ring < rings; ++ring) whole += sine(out.first + ring * out.spacing);
    double sum = 0.0;
    int placed = 0;
    for (int ring = 0; ring < rings; ++ring) {
        sum += sine(out.first + ring * out.spacing);
        const int until = ring + 1 == rings ? count : static_cast<int>(count * (sum / whole) + 0.5);
        out.pieces.push_back(until - placed);
        placed = until;
    }
    return out;
}

// Values for the distance between two patches, computed once for each.
struct Place {
    double sigma, radius;  // radius of its parallel circle; both in shares of the meridian
    SineCosine turn;
};

Place place_of(const Patch& patch) {
    return {patch.sigma, sine(quarter_turn * patch.sigma) / quarter_turn, sine_cosine(patch.theta)};
}

// Returns the distance on the hemisphere in shares of its meridian, with lengths along the meridian
// divided by the elongation.
double distance(const Place& a, const Place& b, double elongation) {
    const double along = (a.sigma - b.sigma) / elongation;
    // The chord on the circle half-way between is never longer than the path over the pole.
    const double radius = 0.5 * (a.radius + b.radius);
    const double x = radius * (a.turn.cosine - b.turn.cosine);
    const double y = radius * (a.turn.sine - b.turn.sine);
    return std::sqrt(along * along + x * x + y * y);
}

/// Latitudes between which patches stand, radians from the apex.
struct Window {
    double from, to;
};

/// Returns patch `i` of a ring, without regard to its neighbours.
///
/// angle  latitude of the ring; phase: angle of its first patch
Patch drawn_patch(const PatchStyle& style, const Window& window, const Rings& rings, double angle,
                  double phase, int i, int pieces, Random& stream) {
    const double along = stream.symmetric();
    const double jitter = stream.symmetric();
    const double small = stream.uniform();
    const double large = stream.uniform();
    const double spin = stream.uniform(0.0, 2.0 * pi);
    const double height = stream.uniform(least_height, most_height);
    const double draw = stream.uniform();
    Patch patch;
    const double tilt =
        std::clamp(angle + latitude_deviation * rings.spacing * along, window.from, window.to);
    patch.sigma = tilt / quarter_turn;
    double theta = phase + 2.0 * pi * ((i + 0.5 + longitude_deviation * jitter) / pieces);
    while (theta >= 2.0 * pi) theta -= 2.0 * pi;
    while (theta < 0.0) theta += 2.0 * pi;
    patch.theta = theta;
    // Patches are smaller towards the margin, where the cap grows most.
    const double reach = (tilt - window.from) / (window.to - window.from);
    const double alike = least_size + size_spread * small + large_spread * large * large;
    const double unlike = granule_size + granule_spread * small + spine_spread * large * large;
    patch.drawn = alike + style.unevenness * (unlike - alike);
    const double loss = margin_loss + uneven_margin_loss * style.unevenness;
    patch.radius = style.size * patch.drawn * (apex_size - loss * reach);
    patch.spin = spin;
    patch.height = style.height * height;
    // Rain removes the patches of the margin first.
    patch.survival =
        first_survival + survival_range * (survival_drawn * draw + survival_placed * reach);
    return patch;
}

/// Returns the radius that a patch may have beside those placed before it, at `places`; less than 0
/// where there is no space.
double free_radius(const Patch& patch, const Place& place, double elongation,
                   const std::vector<Patch>& placed, const std::vector<Place>& places) {
    double free = patch.radius;
    for (std::size_t other = 0; other < placed.size(); ++other) {
        // The distance along the meridian alone rules out an overlap.
        const double along_only = patch.sigma > placed[other].sigma
                                      ? patch.sigma - placed[other].sigma
                                      : placed[other].sigma - patch.sigma;
        if (along_only >= closeness * elongation * (patch.radius + placed[other].radius)) continue;
        free = std::min(
            free, distance(place, places[other], elongation) / closeness - placed[other].radius);
    }
    return free;
}

}  // namespace

std::vector<Patch> patches(const PatchStyle& style, std::uint32_t seed, std::uint32_t purpose) {
    std::vector<Patch> out;
    const Window window{std::min(style.from, style.to) * quarter_turn,
                        std::max(style.from, style.to) * quarter_turn};
    if (style.count <= 0 || window.to - window.from < least_window * quarter_turn) return out;
    const Rings rings = rings_between(window.from, window.to, style.count);
    out.reserve(static_cast<std::size_t>(style.count));
    std::vector<Place> places;
    places.reserve(out.capacity());
    std::uint32_t id = 0;
    for (std::size_t ring = 0; ring < rings.pieces.size(); ++ring) {
        Random phase_stream(seed, purpose, first_ring_stream + static_cast<std::uint32_t>(ring));
        const double phase = phase_stream.uniform(0.0, 2.0 * pi);
        const double angle = rings.first + static_cast<double>(ring) * rings.spacing;
        const int pieces = rings.pieces[ring];
        for (int i = 0; i < pieces; ++i, ++id) {
            Random stream(seed, purpose, id);
            Patch patch = drawn_patch(style, window, rings, angle, phase, i, pieces, stream);
            patch.id = id;
            const Place place = place_of(patch);
            // A crowded patch is smaller; without space its radius is 0 and it keeps its index. The
            // result is continuous in the style's size, so that no patch appears suddenly while the
            // cap grows.
            const double free = free_radius(patch, place, style.elongation, out, places);
            patch.radius =
                std::max(0.0, free) * smooth_step(absent_share, full_share, free / patch.radius);
            out.push_back(patch);
            places.push_back(place);
        }
    }
    return out;
}

double patch_scale(const Patch& patch, double amount) {
    const double span = std::min(0.3, 1.0 - patch.survival);
    return smooth_step(patch.survival, patch.survival + span, amount);
}

}  // namespace sporeprint
