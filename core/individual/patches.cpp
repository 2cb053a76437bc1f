#include "core/individual/patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/elementary.h"
#include "core/math/random.h"

namespace sporeprint {
namespace {

constexpr double quarter_turn = 0.5 * pi;

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

}  // namespace

std::vector<Patch> patches(const PatchStyle& style, std::uint32_t seed, std::uint32_t purpose) {
    std::vector<Patch> out;
    const double from = std::min(style.from, style.to) * quarter_turn;
    const double to = std::max(style.from, style.to) * quarter_turn;
    if (style.count <= 0 || to - from < least_window * quarter_turn) return out;
    const Rings rings = rings_between(from, to, style.count);
    out.reserve(static_cast<std::size_t>(style.count));
    std::vector<Place> places;
    places.reserve(out.capacity());
    std::uint32_t id = 0;
    for (std::size_t ring = 0; ring < rings.pieces.size(); ++ring) {
        Random phase_stream(seed, purpose, 0x80000000U + static_cast<std::uint32_t>(ring));
        const double phase = phase_stream.uniform(0.0, 2.0 * pi);
        const double angle = rings.first + static_cast<double>(ring) * rings.spacing;
        const int pieces = rings.pieces[ring];
        for (int i = 0; i < pieces; ++i, ++id) {
            Random stream(seed, purpose, id);
            const double along = stream.symmetric();
            const double jitter = stream.symmetric();
            const double small = stream.uniform();
            const double large = stream.uniform();
            const double spin = stream.uniform(0.0, 2.0 * pi);
            const double height = stream.uniform(0.75, 1.25);
            const double draw = stream.uniform();
            Patch patch;
            const double tilt = std::clamp(angle + 0.32 * rings.spacing * along, from, to);
            patch.sigma = tilt / quarter_turn;
            double theta = phase + 2.0 * pi * ((i + 0.5 + 0.3 * jitter) / pieces);
            while (theta >= 2.0 * pi) theta -= 2.0 * pi;
            while (theta < 0.0) theta += 2.0 * pi;
            patch.theta = theta;
            // Patches are smaller towards the margin, where the cap grows most.
            const double reach = (tilt - from) / (to - from);
            patch.drawn = 0.62 + 0.5 * small + 0.35 * large * large;
            patch.radius = style.size * patch.drawn * (1.15 - 0.4 * reach);
            patch.spin = spin;
            patch.height = style.height * height;
            // Rain removes the patches of the margin first.
            patch.survival = 0.02 + 0.86 * (0.8 * draw + 0.2 * reach);
            patch.id = id;
            // A crowded patch is smaller; without space its radius is 0 and it keeps its index.
            double free_radius = patch.radius;
            const Place place = place_of(patch);
            for (std::size_t other = 0; other < out.size(); ++other) {
                // The distance along the meridian alone rules out an overlap.
                const double along_only = patch.sigma > out[other].sigma
                                              ? patch.sigma - out[other].sigma
                                              : out[other].sigma - patch.sigma;
                if (along_only >= 0.8 * style.elongation * (patch.radius + out[other].radius))
                    continue;
                free_radius =
                    std::min(free_radius, distance(place, places[other], style.elongation) / 0.8 -
                                              out[other].radius);
            }
            // The result is continuous in the style's size, so that no patch appears suddenly while
            // the cap grows.
            patch.radius =
                std::max(0.0, free_radius) * smooth_step(0.2, 0.5, free_radius / patch.radius);
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
