#include "core/plant/leaf_colour.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t autumn_purpose = 64;

glm::dvec3 linear(const Colour& colour) {
    return {srgb_to_linear(colour.r / 255.0), srgb_to_linear(colour.g / 255.0),
            srgb_to_linear(colour.b / 255.0)};
}

glm::dvec3 mixed(const glm::dvec3& a, const glm::dvec3& b, double share) {
    return a + share * (b - a);
}

glm::dvec3 blade_colour(const LeafColours& colours, const LimbPlace& place) {
    const glm::dvec3 across = mixed(linear(colours.inner), linear(colours.border),
                                    gradation(colours.affinity, place.affinity));
    return mixed(across, linear(colours.tip),
                 colours.homothety_share * gradation(colours.homothety, place.homothety));
}

// 1 on a vein, 0 beside it. Main veins grow thinner to the tip, side veins are half as wide and end in the limb.
double vein_share(const LeafColours& colours, const LimbPlace& place) {
    const auto line = [](double distance, double width) {
        return width > 0.0 ? 1.0 - smooth_step(0.25 * width, 0.5 * width, distance) : 0.0;
    };
    const double main = line(place.from_main, colours.vein_width * (1.0 - 0.75 * place.homothety));
    const double side = line(place.from_side, 0.5 * colours.vein_width *
                                                  std::max(0.0, 1.0 - 0.8 * place.along_side)) *
                        (1.0 - smooth_step(0.9, 1.05, place.along_side));
    return std::max(main, 0.8 * side);
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

glm::dvec3 leaf_colour(const LeafPalette& palette, const LimbPlace& place, double autumn,
                       bool upper) {
    // What is far from veins turns first: by up to a third of a season.
    const double far = 0.6 * place.affinity + 0.4 * place.homothety;
    const auto turned = [&](double begin, double lag, double depth) {
        return smooth_step(begin + lag * (1.0 - depth), begin + 0.5 - lag * depth, autumn);
    };
    const auto face = [&](auto colour_of) {
        return mixed(
            mixed(colour_of(palette.summer), colour_of(palette.turning), turned(0.0, 0.17, far)),
            colour_of(palette.fallen), turned(0.5, 0.17, far));
    };
    glm::dvec3 colour =
        face([&](const LeafColours& colours) { return blade_colour(colours, place); });
    const auto share = [&](const LeafColours& colours) { return vein_share(colours, place); };
    // Veins keep the colour of the season before a little longer.
    const glm::dvec3 vein = mixed(
        mixed(linear(palette.summer.vein), linear(palette.turning.vein), turned(0.0, 0.17, 0.0)),
        linear(palette.fallen.vein), turned(0.5, 0.17, 0.0));
    const double season = smooth_step(0.0, 1.0, autumn);
    const double line = (1.0 - season) * share(palette.summer) + season * share(palette.fallen);
    colour = mixed(colour, vein, line);
    if (upper) return colour;
    const double grey = (colour.r + colour.g + colour.b) / 3.0;
    const glm::dvec3 pale(0.6 * grey + 0.3);
    return mixed(colour, mixed(colour, pale, 0.6), palette.paler_below);
}

double leaf_autumn(double autumn, double spread, std::uint32_t seed, std::uint32_t leaf) {
    Random random(seed, autumn_purpose, leaf);
    const double drawn = random.symmetric();
    // A bow through (0, 0) and (1, 1), up for early leaves and down for late ones.
    return std::clamp(autumn + spread * drawn * 2.0 * autumn * (1.0 - autumn), 0.0, 1.0);
}

}  // namespace sporeprint
