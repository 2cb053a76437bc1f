#include "core/plant/leaf_colour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

glm::dvec3 linear(const Colour& colour) {
    return {srgb_to_linear(colour.r / 255.0), srgb_to_linear(colour.g / 255.0),
            srgb_to_linear(colour.b / 255.0)};
}

// Share of the colour of veins in that of the finest ones.
constexpr double net_share = 0.3;

glm::dvec3 mixed(const glm::dvec3& a, const glm::dvec3& b, double share) {
    return a + share * (b - a);
}

// Returns 1 on a vein, 0 beside it. Main veins taper to the tip, side veins are half as wide, taper
// and fade slowly towards the border.
double vein_share(const LeafColours& colours, const LaminaPlace& place) {
    const auto line = [](double distance, double width) {
        return width > 0.0 ? 1.0 - smooth_step(0.25 * width, 0.5 * width, distance) : 0.0;
    };
    const double main = line(place.from_main, colours.vein_width * (1.0 - 0.8 * place.homothety));
    const double side = line(place.from_side, 0.5 * colours.vein_width *
                                                  std::max(0.0, 1.0 - 0.6 * place.along_side)) *
                        (1.0 - smooth_step(0.45, 1.1, place.along_side));
    return std::max(main, 0.62 * side);
}

}  // namespace

double gradation(GradationLaw law, double ratio) {
    const double x = std::clamp(ratio, 0.0, 1.0);
    switch (law) {
        case GradationLaw::linear:
            return x;
        case GradationLaw::soft:
            return smooth_step(0.0, 1.0, x);
        case GradationLaw::late:
            return x * x * x;
        case GradationLaw::early:
            return 1.0 - (1.0 - x) * (1.0 - x) * (1.0 - x);
        case GradationLaw::banded:
            return std::floor(std::min(4.0 * x, 3.0)) / 3.0;
    }
    return x;
}

LeafColours unfolding(const LeafColours& summer, double spring) {
    // Towards the colour of young leaves of beeches, which keeps half of the differences within a leaf.
    constexpr glm::dvec3 young(158.0, 190.0, 74.0);
    constexpr double most = 0.75;
    const auto paler = [&](const Colour& colour) {
        const glm::dvec3 own(colour.r, colour.g, colour.b);
        const glm::dvec3 mix = mixed(own, young, most * spring);
        const auto rounded = [](double value) {
            return static_cast<std::uint8_t>(std::floor(value + 0.5));
        };
        return Colour{rounded(mix.r), rounded(mix.g), rounded(mix.b)};
    };
    LeafColours colours = summer;
    for (Colour LeafColours::*part :
         {&LeafColours::vein, &LeafColours::inner, &LeafColours::border, &LeafColours::tip})
        colours.*part = paler(summer.*part);
    return colours;
}

LeafColourMap::Season LeafColourMap::season(const LeafColours& colours) {
    Season made = {colours,
                   linear(colours.vein),
                   linear(colours.inner),
                   linear(colours.border),
                   linear(colours.tip),
                   {}};
    LaminaPlace beyond;
    beyond.affinity = beyond.homothety = 1.0;
    made.beyond = lamina_colour(made, beyond);
    return made;
}

LeafColourMap::LeafColourMap(const LeafPalette& palette)
    : seasons_{season(palette.summer), season(palette.turning), season(palette.fallen)},
      paler_below_(palette.paler_below),
      widest_(std::max(palette.summer.vein_width, palette.fallen.vein_width)) {}

glm::dvec3 LeafColourMap::lamina_colour(const Season& season, const LaminaPlace& place) {
    const LeafColours& colours = season.colours;
    const glm::dvec3 across =
        mixed(season.inner, season.border, gradation(colours.affinity, place.affinity));
    return mixed(across, season.tip,
                 colours.homothety_share * gradation(colours.homothety, place.homothety));
}

double autumn_depth(const LaminaPlace& place) {
    return std::clamp(0.6 * place.affinity + 0.4 * place.homothety, 0.0, 1.0);
}

LeafColourMap::Faces LeafColourMap::at(const LaminaPlace& place, double autumn) const {
    // Places far from veins turn first, by up to a third of a season.
    constexpr double lag = 0.17, whole = 0.5 - lag;
    const auto turned = [&](double begin, double depth) {
        const double t =
            std::clamp((autumn - begin - lag * (1.0 - depth)) * (1.0 / whole), 0.0, 1.0);
        return t * t * (3.0 - 2.0 * t);
    };
    const auto seasonal = [&](const auto& of, double depth) {
        const double fallen = turned(0.5, depth);
        if (fallen >= 1.0) return of(seasons_[2]);
        const double turning = turned(0.0, depth);
        glm::dvec3 colour = of(seasons_[turning >= 1.0 ? 1 : 0]);
        if (turning > 0.0 && turning < 1.0) colour = mixed(colour, of(seasons_[1]), turning);
        return fallen > 0.0 ? mixed(colour, of(seasons_[2]), fallen) : colour;
    };
    const double far = autumn_depth(place);
    const bool beyond = place.affinity >= 1.0 && place.homothety >= 1.0;
    glm::dvec3 colour = seasonal(
        [&](const Season& one) { return beyond ? one.beyond : lamina_colour(one, place); }, far);
    if (place.from_main < 0.5 * widest_ || place.from_side < 0.25 * widest_) {
        const double line = (1.0 - autumn) * vein_share(seasons_[0].colours, place) +
                            autumn * vein_share(seasons_[2].colours, place);
        colour = mixed(colour, seasonal([](const Season& one) { return one.vein; }, 0.0), line);
    }
    colour = mixed(colour, seasonal([](const Season& one) { return one.vein; }, 0.0),
                   net_share * place.net);
    const glm::dvec3 pale(0.6 * ((colour.r + colour.g + colour.b) * (1.0 / 3.0)) + 0.3);
    return {colour, mixed(colour, mixed(colour, pale, 0.6), paler_below_)};
}

glm::dvec3 leaf_colour(const LeafPalette& palette, const LaminaPlace& place, double autumn,
                       bool upper) {
    const LeafColourMap::Faces faces = LeafColourMap(palette).at(place, autumn);
    return upper ? faces.upper : faces.lower;
}

double leaf_autumn(double autumn, double spread, std::uint32_t seed, std::uint32_t leaf) {
    Random random(seed, purposes::leaf_autumn, leaf);
    const double drawn = random.symmetric();
    // A curve through (0, 0) and (1, 1), above the diagonal for early leaves and below it for late
    // ones.
    return std::clamp(autumn + spread * drawn * 2.0 * autumn * (1.0 - autumn), 0.0, 1.0);
}

}  // namespace sporeprint
