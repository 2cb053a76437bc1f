#include "core/plant/leaf_colour.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/model/purposes.h"

namespace sporeprint {

namespace {

glm::dvec3 linear(const Colour& colour) {
    return {srgb_to_linear(colour.r / 255.0), srgb_to_linear(colour.g / 255.0),
            srgb_to_linear(colour.b / 255.0)};
}

glm::dvec3 mixed(const glm::dvec3& a, const glm::dvec3& b, double share) {
    return a + share * (b - a);
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

LeafColourist::Season LeafColourist::season(const LeafColours& colours) {
    return {colours, linear(colours.vein), linear(colours.inner), linear(colours.border),
            linear(colours.tip)};
}

LeafColourist::LeafColourist(const LeafPalette& palette)
    : seasons_{season(palette.summer), season(palette.turning), season(palette.fallen)},
      paler_below_(palette.paler_below) {}

glm::dvec3 LeafColourist::blade(const Season& season, const LimbPlace& place) {
    const LeafColours& colours = season.colours;
    const glm::dvec3 across =
        mixed(season.inner, season.border, gradation(colours.affinity, place.affinity));
    return mixed(across, season.tip,
                 colours.homothety_share * gradation(colours.homothety, place.homothety));
}

glm::dvec3 LeafColourist::at(const LimbPlace& place, double autumn, bool upper) const {
    // What is far from veins turns first: by up to a third of a season.
    const double far = std::clamp(0.6 * place.affinity + 0.4 * place.homothety, 0.0, 1.0);
    const auto turned = [&](double begin, double depth) {
        constexpr double lag = 0.17;
        return smooth_step(begin + lag * (1.0 - depth), begin + 0.5 - lag * depth, autumn);
    };
    const auto seasonal = [&](const auto& of, double depth) {
        return mixed(mixed(of(seasons_[0]), of(seasons_[1]), turned(0.0, depth)), of(seasons_[2]),
                     turned(0.5, depth));
    };
    glm::dvec3 colour = seasonal([&](const Season& one) { return blade(one, place); }, far);
    const glm::dvec3 vein = seasonal([](const Season& one) { return one.vein; }, 0.0);
    const double line = (1.0 - autumn) * vein_share(seasons_[0].colours, place) +
                        autumn * vein_share(seasons_[2].colours, place);
    colour = mixed(colour, vein, line);
    if (upper) return colour;
    const double grey = (colour.r + colour.g + colour.b) / 3.0;
    const glm::dvec3 pale(0.6 * grey + 0.3);
    return mixed(colour, mixed(colour, pale, 0.6), paler_below_);
}

glm::dvec3 leaf_colour(const LeafPalette& palette, const LimbPlace& place, double autumn,
                       bool upper) {
    return LeafColourist(palette).at(place, autumn, upper);
}

double leaf_autumn(double autumn, double spread, std::uint32_t seed, std::uint32_t leaf) {
    Random random(seed, purposes::leaf_autumn, leaf);
    const double drawn = random.symmetric();
    // A bow through (0, 0) and (1, 1), up for early leaves and down for late ones.
    return std::clamp(autumn + spread * drawn * 2.0 * autumn * (1.0 - autumn), 0.0, 1.0);
}

}  // namespace sporeprint
