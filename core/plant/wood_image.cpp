#include "core/plant/wood_image.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/plant/bark_relief.h"
#include "core/plant/image_rows.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// The look of a kind of wood.
struct WoodStyle {
    Colour ridge, furrow;  ///< of what stands out and of what lies deep
    Colour tint;           ///< of patches of the bark
    Colour lenticel{48, 42, 40};
    double lenticels = 0.0;        ///< how many level dashes there are
    double lenticel_length = 5.0;  ///< in their heights
    double paper = 0.0;            ///< how much of the bark comes off in level sheets
    double wrinkles = 0.0;         ///< strength of level wrinkles
    double lichen = 0.5, algae = 0.5, moss = 0.3;
    Colour sapwood, heartwood;
    int rings = 20;  ///< annual rings of an end
};

WoodStyle style_of(Substrate substrate) {
    switch (substrate) {
        case Substrate::none:
            break;
        case Substrate::beech:
            return {.ridge = {150, 147, 138},
                    .furrow = {88, 88, 80},
                    .tint = {118, 120, 108},
                    .lenticel = {84, 78, 68},
                    .lenticels = 0.35,
                    .lenticel_length = 3.0,
                    .wrinkles = 0.8,
                    .lichen = 0.4,
                    .algae = 0.6,
                    .moss = 0.35,
                    .sapwood = {178, 152, 118},
                    .heartwood = {146, 114, 84},
                    .rings = 26};
        case Substrate::birch:
            return {.ridge = {226, 222, 212},
                    .furrow = {150, 140, 128},
                    .tint = {206, 184, 162},
                    .lenticel = {58, 48, 44},
                    .lenticels = 1.0,
                    .lenticel_length = 9.0,
                    .paper = 1.0,
                    .wrinkles = 0.35,
                    .lichen = 0.25,
                    .algae = 0.4,
                    .moss = 0.15,
                    .sapwood = {190, 168, 132},
                    .heartwood = {160, 132, 98},
                    .rings = 22};
        case Substrate::oak:
            return {.ridge = {124, 112, 97},
                    .furrow = {42, 35, 29},
                    .tint = {98, 92, 78},
                    .lichen = 0.6,
                    .algae = 0.6,
                    .moss = 0.7,
                    .sapwood = {170, 146, 112},
                    .heartwood = {112, 82, 56},
                    .rings = 30};
        case Substrate::poplar:
            return {.ridge = {136, 130, 114},
                    .furrow = {56, 50, 43},
                    .tint = {112, 110, 92},
                    .lenticel = {70, 62, 52},
                    .lenticels = 0.25,
                    .lenticel_length = 2.0,
                    .lichen = 0.7,
                    .algae = 0.5,
                    .moss = 0.5,
                    .sapwood = {186, 170, 140},
                    .heartwood = {152, 128, 100},
                    .rings = 14};
        case Substrate::spruce:
            return {.ridge = {126, 100, 82},
                    .furrow = {58, 43, 34},
                    .tint = {104, 92, 82},
                    .lichen = 0.4,
                    .algae = 0.35,
                    .moss = 0.3,
                    .sapwood = {186, 162, 122},
                    .heartwood = {168, 134, 94},
                    .rings = 34};
    }
    throw InvalidInput("/substrate", "no wood has no images");
}

constexpr std::uint32_t wood_seed = 7;

/// Colours are mixed as they are encoded, because a power for each of them would take longer than
/// everything else.
glm::dvec3 encoded(const Colour& colour) {
    return glm::dvec3(colour.r, colour.g, colour.b) / 255.0;
}

/// Noise along the rows of images that wrap.
class RowNoise {
  public:
    RowNoise(std::uint32_t seed, std::size_t count) : seed_(seed), count_(count) {}

    /// Returns noise with `round` features in a row, at a distance of `along` features from the
    /// first row.
    [[nodiscard]] std::vector<float> row(int round, double along, std::uint32_t purpose) const {
        std::vector<float> u(count_), v(count_, static_cast<float>(along)), out(count_);
        for (std::size_t x = 0; x < count_; ++x)
            u[x] = static_cast<float>((static_cast<double>(x) + 0.5) * round /
                                      static_cast<double>(count_));
        periodic_noise(u, v, round, seed_ * 16U + purpose, out);
        return out;
    }

  private:
    std::uint32_t seed_;
    std::size_t count_;  ///< texels of a row
};

void set_colour(RawImages& images, std::size_t texel, const glm::dvec3& colour) {
    for (std::size_t k = 0; k < 3; ++k)
        images.rgb[0][3 * texel + k] = share_as_byte(colour[static_cast<int>(k)]);
}

/// Paints bark, and the algae, lichens and moss that grow on it: first colour, roughness and
/// occlusion with heights, then the normals that follow from the heights.
class BarkPainter {
  public:
    BarkPainter(Substrate kind, const WoodStyle& style, RawImages& images)
        : kind_(kind),
          style_(style),
          count_(static_cast<std::size_t>(images.side)),
          images_(images),
          depth_(bark_depth(kind)),
          heights_(count_ * count_, 0.0F),
          ridge_(encoded(style.ridge)),
          furrow_(encoded(style.furrow)),
          tint_(encoded(style.tint)),
          dash_(encoded(style.lenticel)) {
        for (std::size_t x = 0; x < count_; ++x)
            across_.push_back((static_cast<float>(x) + 0.5F) / static_cast<float>(count_));
    }

    void paint_row(std::size_t y);

    /// rows  of bark
    void resolve_normals(std::size_t y, std::size_t rows);

  private:
    Substrate kind_;
    const WoodStyle& style_;
    std::size_t count_;  ///< texels of a row
    RawImages& images_;
    double depth_;
    std::vector<float> heights_, across_;  ///< in widths of the image
    glm::dvec3 ridge_, furrow_, tint_, dash_;
};

/// Returns how far inside a patch a place is, -1 to 1, by the value of a noise and the share of
/// places that are in patches.
double inside(float noise, double share) { return static_cast<double>(noise) + share - 0.62; }

void BarkPainter::paint_row(std::size_t y) {
    const std::vector<float> along(count_,
                                   (static_cast<float>(y) + 0.5F) / static_cast<float>(count_));
    const BarkNoise noise(kind_, across_, along);
    const std::vector<float> rise = bark_rise(kind_, noise);
    const auto patches = noise.at(6, 1.0, 4U, 1.0), ragged = noise.at(31, 1.0, 5U, 1.5),
               grain = noise.at(90, 1.6, 6U), fine = noise.at(240, 1.2, 7U, 0.0),
               streaks = noise.at(9, 3.0, 8U), wrinkles = noise.at(11, 0.22, 9U, 1.2),
               dashes = noise.at(60 / static_cast<int>(style_.lenticel_length),
                                 1.0 / style_.lenticel_length, 10U, 1.4),
               marks = noise.at(150 / static_cast<int>(style_.lenticel_length),
                                1.0 / style_.lenticel_length, 11U, 1.4),
               sheets = noise.at(4, 0.17, 12U, 1.6), stripes = noise.at(13, 0.05, 13U, 1.0),
               crusts = noise.at(9, 1.0, 14U, 0.9), rosettes = noise.at(17, 1.0, 15U, 0.9),
               cells = noise.at(120, 1.0, 16U, 2.0), tufts = noise.at(150, 0.8, 17U, 2.0);
    // Lichens grow as nearly round crusts; a second noise tells one from another.
    for (std::size_t x = 0; x < count_; ++x) {
        const auto of = [x](const std::vector<float>& values) {
            return static_cast<double>(values[x]);
        };
        const double high = of(rise), g = of(grain), f = of(fine);
        glm::dvec3 colour = furrow_ + smooth_step(0.0, 0.85, high) * (ridge_ - furrow_);
        colour += smooth_step(-0.15, 0.45, of(patches) + 0.3 * of(ragged)) * 0.55 * high *
                  (tint_ - colour);
        double height = depth_ * high, occlusion = 1.0 - 0.6 * (1.0 - high) * (1.0 - high);
        double roughness = 0.86 + 0.08 * f;
        // Fine scales and grain, more of them where bark is furrowed.
        const double coarse = style_.paper > 0.0 ? 0.3 : style_.wrinkles > 0.0 ? 1.0 : 1.5;
        colour *= 1.0 + coarse * (0.13 * g + 0.1 * f) + 0.1 * of(ragged);
        height += coarse * (0.0016 * g + 0.0006 * f);
        if (style_.wrinkles > 0.0) {
            const double line = std::abs(of(wrinkles) + 0.1 * g);
            const double crease = style_.wrinkles * (1.0 - smooth_step(0.0, 0.07, line)) *
                                  smooth_step(-0.2, 0.3, of(patches) + of(streaks));
            colour *= 1.0 - 0.3 * crease;
            height -= 0.0011 * crease;
            occlusion -= 0.25 * crease;
        }
        if (style_.paper > 0.0) {
            // Sheets of paper end in a torn edge, which stands off; below it is younger bark.
            const double sheet = of(sheets) + 0.12 * of(ragged) + 0.04 * g;
            const double under = smooth_step(0.3, 0.325, sheet);
            const double edge = (1.0 - smooth_step(0.0, 0.03, std::abs(sheet - 0.3))) *
                                smooth_step(-0.1, 0.2, of(patches) + of(streaks));
            colour *= 1.0 + 0.07 * of(stripes);
            colour += 0.5 * under * (glm::dvec3(0.83, 0.68, 0.55) - colour);
            colour *= 1.0 - 0.42 * edge * under;
            height += style_.paper * (0.0007 * (1.0 - under) + 0.0003 * of(stripes));
            occlusion -= 0.4 * edge * under;
        }
        if (style_.lenticels > 0.0) {
            const double large = smooth_step(
                0.66, 0.76, of(dashes) + 0.22 * style_.lenticels + 0.05 * g + 0.12 * of(ragged));
            const double small =
                smooth_step(0.62, 0.7, of(marks) + 0.16 * style_.lenticels + 0.05 * f);
            const double lenticel = std::max(large, 0.8 * small);
            colour += lenticel * ((1.0 + 0.35 * f) * dash_ - colour);
            height += 0.0009 * (lenticel * (1.0 - lenticel) * 4.0) - 0.0007 * lenticel;
            occlusion -= 0.3 * lenticel;
        }
        // Algae as a film of dust, most in the lee of rain.
        const double film =
            style_.algae * smooth_step(-0.1, 0.7, of(streaks) + 0.5 * of(patches) + 0.25 * g);
        colour +=
            0.4 * film * ((0.8 + 0.4 * high + 0.3 * f) * glm::dvec3(0.4, 0.44, 0.27) - colour);
        // Crusts of lichen have a sharp rim, a pale thallus that is cracked into areoles, and dark
        // fruits.
        const double crust_at = inside(crusts[x], 0.32 * style_.lichen) + 0.13 * of(ragged) +
                                0.07 * g + 0.03 * f + 0.25 * of(patches);
        const double crust = smooth_step(0.0, 0.018, crust_at);
        if (crust > 0.0) {
            const double rim = 1.0 - smooth_step(0.01, 0.05, crust_at);
            const double crack = 1.0 - smooth_step(0.0, 0.09, std::abs(of(cells)));
            const double fruit = smooth_step(0.5, 0.56, of(tufts)) * (1.0 - rim);
            glm::dvec3 thallus = glm::dvec3(0.64, 0.67, 0.6) + 0.12 * rim;
            thallus *= 1.0 + 0.1 * g + 0.06 * f - 0.22 * crack * (1.0 - rim);
            thallus += fruit * (glm::dvec3(0.2, 0.19, 0.17) - thallus);
            colour += 0.92 * crust * (thallus - colour);
            height += crust * (0.0007 - 0.0006 * crack + 0.0006 * fruit);
            roughness += crust * (0.95 - roughness);
        }
        const double rosette_at =
            inside(rosettes[x], 0.14 * style_.lichen) + 0.3 * of(ragged) + 0.14 * g + 0.06 * f;
        const double rosette = smooth_step(0.0, 0.05, rosette_at) * (1.0 - crust);
        if (rosette > 0.0) {
            const double lobes = smooth_step(-0.15, 0.2, of(cells) + 0.3 * f);
            const glm::dvec3 leaf = (0.72 + 0.3 * lobes) * glm::dvec3(0.62, 0.66, 0.52);
            colour += 0.9 * rosette * (leaf - colour);
            height += rosette * (0.0005 + 0.0009 * lobes);
            occlusion -= 0.25 * rosette * (1.0 - lobes);
        }
        // Moss begins in furrows and where rain runs down.
        const double moss_at = inside(patches[x], 0.34 * style_.moss) + 0.22 * of(streaks) +
                               0.3 * of(ragged) + 0.2 * g + 0.1 * f + 0.14 * (0.7 - high);
        const double moss = smooth_step(0.0, 0.16, moss_at);
        if (moss > 0.0) {
            const double tuft = smooth_step(-0.4, 0.45, of(tufts) + 0.5 * f);
            const glm::dvec3 green =
                glm::dvec3(0.19, 0.22, 0.09) +
                tuft * (glm::dvec3(0.38, 0.42, 0.18) - glm::dvec3(0.19, 0.22, 0.09));
            colour += moss * ((1.0 + 0.3 * of(ragged)) * green - colour);
            height += moss * (0.0015 + 0.0016 * tuft + 0.0006 * f);
            occlusion -= 0.35 * moss * (1.0 - tuft);
            roughness += moss * (1.0 - roughness);
        }
        const std::size_t at = y * count_ + x;
        set_colour(images_, at, colour);
        heights_[at] = static_cast<float>(height);
        images_.rgb[2][3 * at] = share_as_byte(occlusion);
        images_.rgb[2][3 * at + 1] = share_as_byte(roughness);
    }
}

void BarkPainter::resolve_normals(std::size_t y, std::size_t rows) {
    const std::size_t above = y == 0 ? y : y - 1, below = std::min(y + 1, rows - 1);
    const double steep = 0.5 * static_cast<double>(count_);
    for (std::size_t x = 0; x < count_; ++x) {
        const std::size_t left = (x + count_ - 1) % count_, right = (x + 1) % count_;
        const auto height = [&](std::size_t i, std::size_t k) {
            return static_cast<double>(heights_[k * count_ + i]);
        };
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(steep * (height(left, y) - height(right, y)),
                                      steep * (height(x, below) - height(x, above)), 1.0));
        for (std::size_t k = 0; k < 3; ++k)
            images_.rgb[1][3 * (y * count_ + x) + k] =
                share_as_byte(0.5 + 0.5 * normal[static_cast<int>(k)]);
    }
}

/// Paints the end grain of weathered wood over the last rows of images of bark.
class EndPainter {
  public:
    EndPainter(const WoodStyle& style, std::uint32_t seed, RawImages& images)
        : rings_(style.rings),
          count_(static_cast<std::size_t>(images.side)),
          seed_(seed),
          noise_(seed, count_),
          images_(images),
          bark_(0.5 * (encoded(style.ridge) + encoded(style.furrow))),
          sapwood_(encoded(style.sapwood)),
          heartwood_(encoded(style.heartwood)) {
        for (std::size_t x = 0; x < count_; ++x)
            directions_.push_back(sine_cosine(2.0 * pi * (static_cast<double>(x) + 0.5) /
                                              static_cast<double>(count_)));
    }

    /// Returns the first row that is end grain.
    [[nodiscard]] int first() const {
        return static_cast<int>(std::ceil(0.5 * (wood_bark_end + wood_end_rim) * images_.side));
    }

    void paint_row(std::size_t y);

  private:
    /// Returns noise at the points of a row, so many features in a radius of the wood.
    [[nodiscard]] std::vector<float> plane(double radius, double features,
                                           std::uint32_t purpose) const {
        std::vector<float> u(count_), v(count_), out(count_);
        for (std::size_t x = 0; x < count_; ++x) {
            u[x] = static_cast<float>(features * radius * directions_[x].sine);
            v[x] = static_cast<float>(features * radius * directions_[x].cosine);
        }
        gradient_noise(u, v, seed_ * 16U + purpose, out);
        return out;
    }

    double rings_;
    std::size_t count_;  ///< texels of a row
    std::uint32_t seed_;
    RowNoise noise_;
    RawImages& images_;
    glm::dvec3 bark_, sapwood_, heartwood_;
    std::vector<SineCosine> directions_;  ///< of the texels of a row from the pith
};

void EndPainter::paint_row(std::size_t y) {
    const double v = (static_cast<double>(y) + 0.5) / static_cast<double>(count_);
    const double radius =
        std::clamp((wood_end_middle - v) / (wood_end_middle - wood_end_rim), 0.0, 1.0);
    const std::vector<float> wobble = noise_.row(3, 2.0 * radius, 0U);
    const std::vector<float> ripple = noise_.row(11, 5.0 * radius, 11U);
    // Years differ in width, and some are hardly visible.
    const std::vector<float> years = noise_.row(2, 9.0 * radius, 12U);
    const std::vector<float> faint = noise_.row(7, 4.0 * radius, 13U);
    const std::vector<float> rays = noise_.row(160, 5.0 * radius, 3U);
    const std::vector<float> cracks = noise_.row(9, 0.7 * radius, 4U);
    const std::vector<float> whether = noise_.row(5, 0.3, 5U);
    // Of the plane of the end, so that nothing converges in the pith.
    const std::vector<float> stains = plane(radius, 2.6, 6U), fine = plane(radius, 70.0, 7U),
                             pores = plane(radius, 150.0, 8U), rot = plane(radius, 3.4, 9U),
                             chips = plane(radius, 17.0, 10U);
    for (std::size_t x = 0; x < count_; ++x) {
        const auto of = [x](const std::vector<float>& values) {
            return static_cast<double>(values[x]);
        };
        const double grain = of(fine), pore = of(pores);
        const double rounded = radius + radius * (0.07 * of(wobble) + 0.018 * of(ripple)) +
                               0.03 * of(years) + 0.006 * of(chips);
        // Rings become narrower towards the bark.
        const double ring = rings_ * rounded * (0.7 + 0.3 * rounded);
        const double within = ring - std::floor(ring);
        const double late = std::clamp(0.6 + 1.3 * of(faint), 0.0, 1.0) *
                            smooth_step(0.3, 0.9, within) * (1.0 - smooth_step(0.9, 1.0, within));
        const double heart = 1.0 - smooth_step(0.45, 0.62, rounded + 0.1 * of(stains));
        glm::dvec3 colour = sapwood_ + heart * (heartwood_ - sapwood_);
        colour *=
            1.0 - 0.15 * late + 0.16 * grain + 0.12 * pore + 0.07 * of(rays) + 0.09 * of(chips);
        // Sun and rain turn wood grey; fungi bleach it, and draw dark lines round what is theirs.
        const double grey = 0.45 + 0.5 * of(stains) + 0.15 * of(chips);
        const double mean = (colour.x + colour.y + colour.z) / 3.0;
        colour += std::clamp(grey, 0.0, 0.8) * (0.74 * glm::dvec3(mean) - colour);
        const double decayed = of(rot) + 0.12 * of(chips) + 0.04 * grain;
        colour += 0.3 * smooth_step(0.1, 0.16, decayed) * (glm::dvec3(0.72, 0.66, 0.54) - colour);
        // The lines come and go.
        const double line = (1.0 - smooth_step(0.004, 0.02, std::abs(decayed - 0.1))) *
                            smooth_step(-0.1, 0.35, of(faint) + 0.4 * of(stains));
        colour *= 1.0 - 0.45 * line;
        const double algae = smooth_step(0.55, 1.0, radius + 0.5 * of(stains));
        colour += 0.35 * algae * (glm::dvec3(0.3, 0.33, 0.2) - colour);
        const double open = smooth_step(0.0, 0.2, of(whether)) * radius;
        const double crack =
            1.0 - smooth_step(0.0, 0.05 * open + 1e-6, std::abs(of(cracks) + 0.03 * of(chips)));
        const double gap = crack * std::min(1.0, 3.0 * open);
        colour *= 1.0 - 0.75 * gap;
        const double rind = smooth_step(0.945, 0.952, radius + 0.012 * of(chips));
        colour += rind * ((0.6 + 0.3 * grain + 0.2 * pore) * bark_ - colour);
        const double cambium = rind * (1.0 - smooth_step(0.955, 0.966, radius));
        colour *= 1.0 - 0.5 * cambium;
        set_colour(images_, y * count_ + x, colour);
        const std::size_t at = 3 * (y * count_ + x);
        images_.rgb[1][at] = share_as_byte(0.5 + 0.16 * grain + 0.05 * of(rays));
        images_.rgb[1][at + 1] = share_as_byte(0.5 + 0.16 * pore + 0.04 * (late - 0.2));
        images_.rgb[1][at + 2] = share_as_byte(0.985);
        images_.rgb[2][at] = share_as_byte(1.0 - 0.7 * gap - 0.5 * cambium + 0.2 * pore);
        images_.rgb[2][at + 1] = share_as_byte(0.9 + 0.08 * grain);
    }
}

}  // namespace

RawImages wood_images(const WoodPaint& paint, const Parallel& parallel) {
    const WoodStyle style = style_of(paint.substrate);
    const auto kind = static_cast<std::uint32_t>(paint.substrate);
    const int side = paint.texture_size;
    if (side < 16 || side > 2048 || (side & (side - 1)) != 0)
        throw InvalidInput("/side", std::to_string(side) + " is no power of two in 16..2048");
    RawImages images;
    images.side = side;
    for (Bytes& image : images.rgb)
        image.assign(3 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
    EndPainter ends(style, wood_seed + kind, images);
    BarkPainter bark(paint.substrate, style, images);
    const auto first_end = static_cast<std::size_t>(ends.first());
    for_each_row(side, parallel, [&](std::size_t y) {
        if (y < first_end)
            bark.paint_row(y);
        else
            ends.paint_row(y);
    });
    for_each_row(static_cast<int>(first_end), parallel,
                 [&](std::size_t y) { bark.resolve_normals(y, first_end); });
    return images;
}

}  // namespace sporeprint
