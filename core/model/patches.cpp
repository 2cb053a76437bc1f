#include "core/model/patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/elementary.h"
#include "core/math/random.h"

namespace sporeprint {
namespace {

constexpr double quarter_turn = 0.5 * pi;

// The young cap is a hemisphere: a share of the meridian is an angle from the pole.
struct Rings {
    std::vector<int> pieces;  // on each ring, pole first
    double first = 0.0;       // angle of the first ring from the pole
    double spacing = 0.0;     // angle between rings
};

// Rings one piece apart, each with pieces in proportion to its circumference; their sum is `count`.
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

// Distance on the hemisphere in shares of its meridian, lengths along the meridian shrunk by the elongation.
double distance(const Patch& a, const Patch& b, double elongation) {
    const double along = (a.sigma - b.sigma) / elongation;
    double turn = a.theta > b.theta ? a.theta - b.theta : b.theta - a.theta;
    if (turn > pi) turn = 2.0 * pi - turn;
    // The chord between the two on the circle half-way: never longer than the way over the pole.
    const double radius = sine(quarter_turn * 0.5 * (a.sigma + b.sigma)) / quarter_turn;
    const double across = 2.0 * radius * sine(0.5 * turn);
    return std::sqrt(along * along + across * across);
}

}  // namespace

std::vector<Patch> patches(const PatchStyle& style, std::uint32_t seed, std::uint32_t purpose) {
    std::vector<Patch> out;
    const double from = std::min(style.from, style.to) * quarter_turn;
    const double to = std::max(style.from, style.to) * quarter_turn;
    if (style.count <= 0 || to - from < 1e-6) return out;
    const Rings rings = rings_between(from, to, style.count);
    out.reserve(static_cast<std::size_t>(style.count));
    std::uint32_t id = 0;
    for (std::size_t ring = 0; ring < rings.pieces.size(); ++ring) {
        Random phase_stream(seed, purpose, 0x80000000U + static_cast<std::uint32_t>(ring));
        const double phase = phase_stream.uniform(0.0, 2.0 * pi);
        const double angle = rings.first + static_cast<double>(ring) * rings.spacing;
        const int pieces = rings.pieces[ring];
        for (int i = 0; i < pieces; ++i, ++id) {
            Random stream(seed, purpose, id);
            const double along = stream.symmetric();
            const double round = stream.symmetric();
            const double small = stream.uniform();
            const double large = stream.uniform();
            const double spin = stream.uniform(0.0, 2.0 * pi);
            const double height = stream.uniform(0.75, 1.25);
            const double luck = stream.uniform();
            Patch patch;
            const double tilt = std::clamp(angle + 0.32 * rings.spacing * along, from, to);
            patch.sigma = tilt / quarter_turn;
            double theta = phase + 2.0 * pi * ((i + 0.5 + 0.3 * round) / pieces);
            while (theta >= 2.0 * pi) theta -= 2.0 * pi;
            while (theta < 0.0) theta += 2.0 * pi;
            patch.theta = theta;
            // The veil tears finer towards the margin, where the cap grows most.
            const double reach = (tilt - from) / (to - from);
            patch.radius = style.size * (0.62 + 0.5 * small + 0.35 * large * large) * (1.15 - 0.4 * reach);
            patch.spin = spin;
            patch.height = style.height * height;
            // Rain takes the margin first.
            patch.survival = 0.02 + 0.86 * (0.8 * luck + 0.2 * reach);
            patch.id = id;
            // A crowded piece is smaller, a badly crowded one never formed.
            double room = patch.radius;
            for (const Patch& other : out) {
                // Too far along the meridian to matter, whatever the rest of the way.
                const double along_only = patch.sigma > other.sigma ? patch.sigma - other.sigma : other.sigma - patch.sigma;
                if (along_only >= 0.8 * style.elongation * (patch.radius + other.radius)) continue;
                room = std::min(room, distance(patch, other, style.elongation) / 0.8 - other.radius);
            }
            // Continuous in the style's size, so that nothing pops while the cap grows.
            patch.radius = room * smooth_step(0.2, 0.5, room / patch.radius);
            if (!(patch.radius > 0.0)) continue;
            out.push_back(patch);
        }
    }
    return out;
}

double patch_scale(const Patch& patch, double amount) {
    const double span = std::min(0.3, 1.0 - patch.survival);
    return smooth_step(patch.survival, patch.survival + span, amount);
}

}  // namespace sporeprint
