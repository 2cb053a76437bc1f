#include "tests/support/photographs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/nearest_species.h"
#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "tests/support/atlas.h"
#include "tests/support/orders.h"

namespace sporeprint {

namespace {

/// Returns a mushroom without ground, before nothing.
RgbaImage portrait_of(MushroomSpec spec, View view, int side) {
    spec.params.lod = 0;
    spec.params.base = Base::clean;
    PictureParams params;
    params.view = view;
    params.width = params.height = side;
    return cut_out_picture(spec, atlas(), params);
}

RgbaImage portrait(const Sitter& sitter) {
    MushroomSpec spec = painted(order_of(sitter.species), 512);
    spec.params.age = sitter.age;
    spec.params.seed = sitter.seed;
    return portrait_of(spec, sitter.view, sitter.side);
}

/// Octaves of noise, 0..1, as a grid of pixels.
std::vector<float> clouds(int side, double feature, std::uint32_t seed) {
    const auto count = static_cast<std::size_t>(side);
    std::vector<float> sum(count * count, 0.0F), x(count), y(count), out(count);
    double scale = 1.0 / feature;
    float weight = 0.5F;
    for (std::uint32_t octave = 0; octave < 5; ++octave) {
        for (std::size_t i = 0; i < count; ++i)
            x[i] = static_cast<float>(static_cast<double>(i) * scale);
        for (std::size_t row = 0; row < count; ++row) {
            std::fill(y.begin(), y.end(),
                      static_cast<float>(static_cast<double>(row) * scale + 0.5));
            gradient_noise(x, y, seed + octave, out);
            for (std::size_t i = 0; i < count; ++i) sum[row * count + i] += weight * out[i];
        }
        scale *= 2.1;
        weight *= 0.6F;
    }
    for (float& value : sum) value = std::clamp(0.5F + value, 0.0F, 1.0F);
    return sum;
}

using Colour3 = glm::vec3;

class Canvas {
  public:
    explicit Canvas(int side)
        : side_(side), pixels_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}

    Colour3& at(int x, int y) {
        return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                       static_cast<std::size_t>(x)];
    }

    /// Puts a picture with alpha over a part of the canvas, smaller by a factor.
    void paste(const RgbaImage& image, int left, int top, int factor) {
        for (int y = 0; y < image.height; y += factor)
            for (int x = 0; x < image.width; x += factor) {
                const int u = left + x / factor, v = top + y / factor;
                if (u < 0 || v < 0 || u >= side_ || v >= side_) continue;
                const std::uint8_t* from =
                    &image.rgba[4 * (static_cast<std::size_t>(y) *
                                         static_cast<std::size_t>(image.width) +
                                     static_cast<std::size_t>(x))];
                const float alpha = static_cast<float>(from[3]) / 255.0F;
                at(u, v) = at(u, v) * (1.0F - alpha) + Colour3(from[0], from[1], from[2]) * alpha;
            }
    }

    /// Returns the pixels with the noise of a sensor.
    [[nodiscard]] Picture developed(std::uint32_t seed) const {
        Picture picture{side_, side_, {}};
        picture.rgb.reserve(3 * pixels_.size());
        std::uint32_t state = seed * 2654435761U + 1U;
        const auto noise = [&] {
            float sum = -2.0F;
            for (int i = 0; i < 4; ++i) {
                state = state * 1664525U + 1013904223U;
                sum += static_cast<float>(state >> 8U) / 16777216.0F;
            }
            return 5.0F * sum;
        };
        for (const Colour3& pixel : pixels_)
            for (int c = 0; c < 3; ++c)
                picture.rgb.push_back(
                    static_cast<std::uint8_t>(std::clamp(pixel[c] + noise() + 0.5F, 0.0F, 255.0F)));
        return picture;
    }

  private:
    int side_;
    std::vector<Colour3> pixels_;
};

void paint_background(Canvas& canvas, int side, Scenery scenery, std::uint32_t seed) {
    const std::vector<float> coarse = clouds(side, side * 0.3, 11 * seed),
                             fine = clouds(side, side * 0.02, 13 * seed + 5);
    const float horizon = static_cast<float>(side) * 0.72F;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                           static_cast<std::size_t>(x);
            if (scenery == Scenery::plain) {
                canvas.at(x, y) =
                    Colour3(128.0F, 130.0F, 124.0F) + Colour3(40.0F * (coarse[i] - 0.5F));
                continue;
            }
            const bool below = static_cast<float>(y) > horizon + 60.0F * (coarse[i] - 0.5F);
            const Colour3 dark = below ? Colour3(48, 34, 22) : Colour3(28, 44, 24);
            const Colour3 light = below ? Colour3(138, 104, 66) : Colour3(120, 150, 84);
            canvas.at(x, y) = dark + (light - dark) * (0.35F * coarse[i] + 0.65F * fine[i]);
        }
}

/// Draws blades of grass and leaves before the foot, ovals of a hue; what they hide is not the mushroom.
void paint_foreground(Canvas& canvas, trace::Mask& truth, int foot, std::uint32_t seed) {
    std::uint32_t state = seed * 40503U + 7U;
    const auto draw = [&] {
        state = state * 1664525U + 1013904223U;
        return static_cast<double>(state >> 8U) / 16777216.0;
    };
    const int side = truth.width;
    for (int leaf = 0; leaf < 22; ++leaf) {
        const double x0 = side * draw(), y0 = foot + side * (0.10 * draw() - 0.005),
                     turn = 3.2 * draw();
        const double length = side * (0.02 + 0.04 * draw()),
                     breadth = length * (0.25 + 0.3 * draw());
        const Colour3 colour(90.0 + 90.0 * draw(), 60.0 + 60.0 * draw(), 20.0 + 30.0 * draw());
        const auto [sine, cosine] = sine_cosine(turn);
        for (int y = static_cast<int>(y0 - length); y <= y0 + length; ++y)
            for (int x = static_cast<int>(x0 - length); x <= x0 + length; ++x) {
                if (x < 0 || y < 0 || x >= side || y >= side) continue;
                const double u = ((x - x0) * cosine + (y - y0) * sine) / length,
                             v = ((y - y0) * cosine - (x - x0) * sine) / breadth;
                if (u * u + v * v > 1.0) continue;
                canvas.at(x, y) = colour * static_cast<float>(0.8 + 0.4 * std::abs(v));
                truth.inside[truth.index(x, y)] = 0;
            }
    }
}

/// A stretch of a mask in a row: from its first column to before its last.
struct Run {
    int first = 0, last = 0;

    [[nodiscard]] int length() const { return last - first; }
    [[nodiscard]] double middle() const { return 0.5 * (first + last); }
    /// Returns how far a column is from it, 0 within.
    [[nodiscard]] double away(double column) const {
        return std::max({first - column, column - last, 0.0});
    }
};

std::vector<Run> runs_of_row(const trace::Mask& mask, int y) {
    std::vector<Run> runs;
    int from = 0;
    for (int x = 0; x <= mask.width; ++x) {
        if (mask.at(x, y)) continue;
        if (x > from) runs.push_back({from, x});
        from = x + 1;
    }
    return runs;
}

}  // namespace

trace::Gesture drawn_by_hand(const trace::Mask& truth) {
    std::vector<glm::dvec2> middles;
    Run widest;
    int widest_row = 0;
    for (int y = truth.height - 1; y >= 0; --y) {
        const std::vector<Run> runs = runs_of_row(truth, y);
        if (runs.empty()) continue;
        const double before = middles.empty() ? 0.5 * truth.width : middles.back().x;
        const Run& nearest = *std::min_element(
            runs.begin(), runs.end(),
            [&](const Run& a, const Run& b) { return a.away(before) < b.away(before); });
        middles.emplace_back(nearest.middle(), y + 0.5);
        for (const Run& run : runs)
            if (run.length() > widest.length()) {
                widest = run;
                widest_row = y;
            }
    }
    trace::Gesture gesture;
    for (const double share : {0.06, 0.2, 0.35, 0.5, 0.65, 0.8, 0.94})
        gesture.axis.push_back(
            middles[static_cast<std::size_t>(share * static_cast<double>(middles.size() - 1))]);
    for (const double share : {-0.4, 0.0, 0.4})
        gesture.cap.emplace_back(widest.middle() + share * widest.length(), widest_row + 0.5);
    return gesture;
}

Photograph photograph(const Sitter& sitter, Scenery scenery) {
    const RgbaImage image = portrait(sitter);
    const int side = sitter.side;
    Photograph found;
    found.truth = trace::Mask(side, side);
    Canvas canvas(side);
    paint_background(canvas, side, scenery, sitter.seed + 3);
    if (scenery == Scenery::crowded)
        for (const int k : {0, 1}) {
            Sitter other = sitter;
            other.species = k == 0 ? "lepista_nuda" : "boletus_edulis";
            other.seed = sitter.seed + 100;
            other.side = 512;
            const RgbaImage neighbour = portrait(other);
            canvas.paste(neighbour, k == 0 ? -side / 16 : side - side / 5, side * 11 / 16, 2);
        }
    // A margin of a twentieth all round, so that nothing touches the border.
    const int inset = side / 14;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double step = static_cast<double>(side) / (side - 2.0 * inset);
            const int u = static_cast<int>(std::floor((x - inset) * step)),
                      v = static_cast<int>(std::floor((y - inset) * step));
            if (u < 0 || v < 0 || u >= side || v >= side) continue;
            const std::uint8_t* from =
                &image.rgba[4 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(side) +
                                 static_cast<std::size_t>(u))];
            const float alpha = static_cast<float>(from[3]) / 255.0F;
            canvas.at(x, y) =
                canvas.at(x, y) * (1.0F - alpha) + Colour3(from[0], from[1], from[2]) * alpha;
            if (from[3] >= 128) found.truth.inside[found.truth.index(x, y)] = 1;
        }
    if (scenery == Scenery::crowded) {
        int foot = 0;
        for (int y = 0; y < side; ++y)
            if (!runs_of_row(found.truth, y).empty()) foot = y;
        paint_foreground(canvas, found.truth, foot, sitter.seed);
    }
    found.picture = canvas.developed(sitter.seed);
    found.gesture = drawn_by_hand(found.truth);
    return found;
}

trace::Mask silhouette_of(const Model& model, View view, int side) {
    MushroomSpec spec;
    spec.model = model;
    spec.params.variation = 0.0;
    spec.params.textures = Textures::none;
    const RgbaImage image = portrait_of(spec, view, side);
    trace::Mask mask(side, side);
    for (std::size_t i = 0; i < mask.inside.size(); ++i)
        mask.inside[i] = image.rgba[4 * i + 3] >= 128 ? 1 : 0;
    return trace::connected_with(mask, mask);
}

double intersection_over_union(const trace::Mask& a, const trace::Mask& b) {
    std::size_t both = 0, any = 0;
    for (std::size_t i = 0; i < a.inside.size(); ++i) {
        both += a.inside[i] & b.inside[i];
        any += a.inside[i] | b.inside[i];
    }
    return any == 0 ? 1.0 : static_cast<double>(both) / static_cast<double>(any);
}

}  // namespace sporeprint
