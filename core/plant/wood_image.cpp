#include "core/plant/wood_image.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/plant/bark_image.h"
#include "core/plant/image_rows.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

static_assert(2.0 * wood_girths == wood_bark_end * bark_girths,
              "the bark is that of bark_images(), on half of the girth");

/// The look of a kind of wood.
struct WoodStyle {
    BarkStyle bark;
    Colour sapwood, heartwood;
    int rings = 20;  ///< annual rings of a sawn end
};

WoodStyle style_of(Substrate substrate) {
    switch (substrate) {
        case Substrate::none:
            break;
        case Substrate::beech:
            return {{.ridge = {136, 134, 124},
                     .furrow = {92, 92, 84},
                     .furrows = 0.12,
                     .ridges = 8,
                     .stretch = 1.5,
                     .lenticels = 0.1,
                     .lenticel = {104, 102, 92}},
                    {196, 164, 124},
                    {176, 134, 98},
                    26};
        case Substrate::birch:
            return {{.ridge = {222, 218, 208},
                     .furrow = {90, 84, 80},
                     .furrows = 0.15,
                     .ridges = 6,
                     .stretch = 1.5,
                     .lenticels = 0.5,
                     .lenticel = {48, 42, 40}},
                    {206, 180, 142},
                    {190, 158, 118},
                    22};
        case Substrate::oak:
            return {{.ridge = {112, 98, 82},
                     .furrow = {44, 37, 31},
                     .furrows = 0.9,
                     .ridges = 14,
                     .stretch = 5.0},
                    {190, 162, 120},
                    {134, 96, 62},
                    30};
        case Substrate::poplar:
            return {{.ridge = {122, 116, 100},
                     .furrow = {58, 52, 44},
                     .furrows = 0.7,
                     .ridges = 10,
                     .stretch = 6.0},
                    {206, 188, 156},
                    {172, 146, 112},
                    14};
        case Substrate::spruce:
            return {{.ridge = {112, 84, 66},
                     .furrow = {62, 46, 36},
                     .furrows = 0.6,
                     .ridges = 18,
                     .stretch = 1.4},
                    {208, 182, 136},
                    {196, 158, 108},
                    34};
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

glm::dvec3 colour_at(const RawImages& images, std::size_t texel) {
    const std::uint8_t* const from = &images.rgb[0][3 * texel];
    return glm::dvec3(from[0], from[1], from[2]) / 255.0;
}

void set_colour(RawImages& images, std::size_t texel, const glm::dvec3& colour) {
    for (std::size_t k = 0; k < 3; ++k)
        images.rgb[0][3 * texel + k] = share_as_byte(colour[static_cast<int>(k)]);
}

/// Gives bark its fine grain, and the algae and crusts of lichen that grow on it.
class BarkWeather {
  public:
    BarkWeather(std::uint32_t seed, RawImages& images)
        : count_(static_cast<std::size_t>(images.side)), noise_(seed, count_), images_(images) {}

    void paint_row(std::size_t y);

  private:
    /// Returns the fine relief of a row: scales a little longer than wide, and grain.
    [[nodiscard]] std::vector<float> relief(double down) const {
        std::vector<float> sum = noise_.row(48, 24.0 * down, 8U);
        const std::vector<float> grain = noise_.row(160, 110.0 * down, 9U);
        for (std::size_t x = 0; x < count_; ++x) sum[x] = 0.6F * sum[x] + 0.4F * grain[x];
        return sum;
    }

    static constexpr double steepness = 0.35;  ///< slope of the fine relief per unit of its noise
    std::size_t count_;
    RowNoise noise_;
    RawImages& images_;
};

void BarkWeather::paint_row(std::size_t y) {
    const double texel = 1.0 / static_cast<double>(count_);
    const double down = (static_cast<double>(y) + 0.5) * texel;
    const std::vector<float> here = relief(down), below = relief(down + texel);
    const std::vector<float> patches = noise_.row(7, 7.0 * down, 10U);
    const std::vector<float> edges = noise_.row(60, 60.0 * down, 11U);
    const std::vector<float> films = noise_.row(3, 2.0 * down, 12U);
    const glm::dvec3 lichen(0.69, 0.71, 0.65), algae(0.44, 0.49, 0.29);
    for (std::size_t x = 0; x < count_; ++x) {
        const std::size_t at = y * count_ + x;
        const auto rise = static_cast<double>(here[x]);
        glm::dvec3 colour = colour_at(images_, at) * (1.0 + 0.14 * rise);
        const double film = smooth_step(0.0, 0.6, static_cast<double>(films[x]) + 0.2 * rise);
        colour += 0.4 * film * (algae - colour);
        const double crust = smooth_step(
            0.34, 0.42, static_cast<double>(patches[x]) + 0.22 * static_cast<double>(edges[x]));
        colour += 0.75 * crust * ((1.0 + 0.16 * rise) * lichen - colour);
        set_colour(images_, at, colour);
        const auto ahead = static_cast<double>(here[(x + 1) % count_]);
        const double slopes[2] = {steepness * (rise - ahead),
                                  steepness * (static_cast<double>(below[x]) - rise)};
        glm::dvec3 normal(0.0);
        for (int k = 0; k < 3; ++k)
            normal[k] = images_.rgb[1][3 * at + static_cast<std::size_t>(k)] / 127.5 - 1.0;
        normal = glm::normalize(normal + glm::dvec3(slopes[0], slopes[1], 0.0));
        for (std::size_t k = 0; k < 3; ++k)
            images_.rgb[1][3 * at + k] = share_as_byte(0.5 + 0.5 * normal[static_cast<int>(k)]);
        const double roughness = images_.rgb[2][3 * at + 1] / 255.0;
        images_.rgb[2][3 * at + 1] =
            share_as_byte(roughness + crust * (0.95 - roughness) + 0.06 * rise);
    }
}

/// Paints the end grain of weathered wood over the last rows of images of bark.
class EndPainter {
  public:
    EndPainter(const WoodStyle& style, std::uint32_t seed, RawImages& images)
        : rings_(style.rings),
          count_(static_cast<std::size_t>(images.side)),
          noise_(seed, count_),
          images_(images),
          bark_(0.5 * (encoded(style.bark.ridge) + encoded(style.bark.furrow))),
          sapwood_(encoded(style.sapwood)),
          heartwood_(encoded(style.heartwood)) {}

    /// Returns the first row that is end grain.
    [[nodiscard]] int first() const {
        return static_cast<int>(std::ceil(0.5 * (wood_bark_end + wood_end_rim) * images_.side));
    }

    void paint_row(std::size_t y);

  private:
    double rings_;
    std::size_t count_;  ///< texels of a row
    RowNoise noise_;
    RawImages& images_;
    glm::dvec3 bark_, sapwood_, heartwood_;
};

void EndPainter::paint_row(std::size_t y) {
    const double v = (static_cast<double>(y) + 0.5) / static_cast<double>(count_);
    const double radius =
        std::clamp((wood_end_middle - v) / (wood_end_middle - wood_end_rim), 0.0, 1.0);
    const std::vector<float> wobble = noise_.row(3, 2.0 * radius, 0U);
    const std::vector<float> stains = noise_.row(5, 4.0 * radius, 1U);
    const std::vector<float> fine = noise_.row(96, 60.0 * radius, 2U);
    const std::vector<float> rays = noise_.row(160, 5.0 * radius, 3U);
    const std::vector<float> cracks = noise_.row(9, 0.7 * radius, 4U);
    const std::vector<float> whether = noise_.row(5, 0.3, 5U);
    for (std::size_t x = 0; x < count_; ++x) {
        const double grain = static_cast<double>(fine[x]);
        const double rounded = radius + 0.05 * static_cast<double>(wobble[x]);
        // Rings become narrower towards the bark.
        const double ring = rings_ * rounded * (0.7 + 0.3 * rounded);
        const double within = ring - std::floor(ring);
        const double late =
            smooth_step(0.45, 0.92, within) * (1.0 - smooth_step(0.93, 1.0, within));
        const double heart = 1.0 - smooth_step(0.5, 0.62, rounded);
        glm::dvec3 colour = sapwood_ + heart * (heartwood_ - sapwood_);
        colour *= 1.0 - 0.17 * late + 0.055 * grain + 0.045 * static_cast<double>(rays[x]);
        // Sun and rain turn wood grey, unevenly.
        const double grey = 0.3 + 0.35 * static_cast<double>(stains[x]);
        const double mean = (colour.x + colour.y + colour.z) / 3.0;
        colour += std::clamp(grey, 0.0, 0.7) * (0.88 * glm::dvec3(mean) - colour);
        const double open = smooth_step(0.0, 0.2, static_cast<double>(whether[x])) * radius;
        const double crack =
            1.0 - smooth_step(0.0, 0.05 * open + 1e-6, std::abs(static_cast<double>(cracks[x])));
        colour *= 1.0 - 0.55 * crack * std::min(1.0, 3.0 * open);
        const double rind = smooth_step(0.93, 0.94, rounded - 0.02 * grain);
        colour += rind * ((0.75 + 0.15 * grain) * bark_ - colour);
        const double cambium = rind * (1.0 - smooth_step(0.94, 0.955, rounded));
        colour *= 1.0 - 0.28 * cambium;
        set_colour(images_, y * count_ + x, colour);
        const std::size_t at = 3 * (y * count_ + x);
        images_.rgb[1][at] = share_as_byte(0.5 + 0.12 * static_cast<double>(rays[x]));
        images_.rgb[1][at + 1] = share_as_byte(0.5 + 0.12 * grain + 0.06 * (late - 0.3));
        images_.rgb[1][at + 2] = share_as_byte(0.985);
        images_.rgb[2][at] =
            share_as_byte(1.0 - 0.6 * crack * std::min(1.0, 3.0 * open) - 0.3 * cambium);
        images_.rgb[2][at + 1] = share_as_byte(0.88 + 0.08 * grain);
    }
}

}  // namespace

RawImages wood_images(const WoodPaint& paint, const Parallel& parallel) {
    const WoodStyle style = style_of(paint.substrate);
    const auto kind = static_cast<std::uint32_t>(paint.substrate);
    const int side = paint.texture_size;
    RawImages images = bark_images(style.bark, wood_seed + kind, side, parallel);
    EndPainter ends(style, wood_seed + kind, images);
    BarkWeather bark(wood_seed + kind, images);
    const auto first_end = static_cast<std::size_t>(ends.first());
    for_each_row(side, parallel, [&](std::size_t y) {
        if (y < first_end)
            bark.paint_row(y);
        else
            ends.paint_row(y);
    });
    return images;
}

}  // namespace sporeprint
