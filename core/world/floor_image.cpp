#include "core/world/floor_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Rows that are painted by one task.
constexpr int band = 128;

/// Radius of the blur of heights from which occlusion follows, metres.
constexpr double blur = 0.022;

/// Side of the cells in which pieces lie, metres.
constexpr double cell = 0.25;

/// Pieces that may lie in a cell, in the order in which they are painted.
struct Layer {
    enum class Piece { leaf, needle, twig, blade, herb } piece;
    int most;      ///< per cell
    double reach;  ///< of a piece from its middle, metres
    float height;  ///< of the layer above the soil, metres
};
constexpr std::array layers = {
    Layer{Layer::Piece::leaf, 9, 0.09, 0.004F},    Layer{Layer::Piece::needle, 40, 0.02, 0.005F},
    Layer{Layer::Piece::twig, 1, 0.17, 0.010F},    Layer{Layer::Piece::leaf, 9, 0.09, 0.009F},
    Layer{Layer::Piece::needle, 40, 0.02, 0.009F}, Layer{Layer::Piece::leaf, 8, 0.09, 0.014F},
    Layer{Layer::Piece::twig, 1, 0.12, 0.019F},    Layer{Layer::Piece::herb, 6, 0.05, 0.030F},
    Layer{Layer::Piece::blade, 90, 0.05, 0.024F},  Layer{Layer::Piece::leaf, 3, 0.09, 0.020F},
};

constexpr glm::vec3 soil_dark(0.20F, 0.155F, 0.12F), soil_pale(0.37F, 0.29F, 0.215F),
    soil_sand(0.50F, 0.43F, 0.34F), mould_dark(0.215F, 0.155F, 0.11F),
    mould_pale(0.40F, 0.285F, 0.19F), duff_dark(0.24F, 0.165F, 0.11F),
    duff_pale(0.44F, 0.30F, 0.19F), moss_dark(0.17F, 0.235F, 0.06F),
    moss_pale(0.47F, 0.545F, 0.17F), sod_dark(0.19F, 0.235F, 0.10F), sod_pale(0.36F, 0.415F, 0.17F),
    rock_dark(0.33F, 0.33F, 0.31F), rock_pale(0.58F, 0.57F, 0.54F),
    water_colour(0.13F, 0.125F, 0.10F), lower_face(0.94F, 0.86F, 0.76F),
    needle_dark(0.30F, 0.19F, 0.11F), needle_pale(0.60F, 0.42F, 0.25F),
    twig_dark(0.25F, 0.20F, 0.16F), twig_pale(0.47F, 0.43F, 0.38F), blade_dark(0.20F, 0.28F, 0.09F),
    blade_pale(0.46F, 0.53F, 0.21F), blade_dry(0.60F, 0.55F, 0.36F), herb_dark(0.20F, 0.33F, 0.10F),
    herb_pale(0.38F, 0.50F, 0.20F);

/// Returns a coordinate as a multiple of 2^-20 m.
double rounded(double metres) { return std::floor(metres * 1048576.0 + 0.5) / 1048576.0; }

float unit(float value) { return value < 0.0F ? 0.0F : value > 1.0F ? 1.0F : value; }

/// Rotations of the lattices of the noises, so that none is parallel to the rows of texels or to another:
/// cosine and sine.
constexpr std::array<std::array<double, 2>, 5> noise_turns{
    {{0.8, 0.6}, {0.28, 0.96}, {0.96, -0.28}, {0.6, -0.8}, {15.0 / 17.0, 8.0 / 17.0}}};

/// A part of the image with the texels round it that it depends on.
struct Canvas {
    /// What is painted so far at a texel.
    struct Point {
        glm::vec3 colour{0.0F};
        float height = 0.0F;  ///< metres
        float roughness = 1.0F;
        float moss = 0.0F, water = 0.0F;  ///< how much of it hides what lies there
    };
    int west = 0, north = 0;  ///< column and row of the first texel in the image
    int columns = 0, rows = 0;
    std::vector<Point> points;

    Canvas(int from_column, int from_row, int width, int length)
        : west(from_column),
          north(from_row),
          columns(width),
          rows(length),
          points(static_cast<std::size_t>(width) * static_cast<std::size_t>(length)) {}
    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
};

/// The draws of one piece.
class Draws {
  public:
    Draws(std::uint32_t seed, std::uint32_t layer, std::uint32_t number, int x, int y)
        : seed_(seed),
          counter_{number, 2 * layer, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)},
          words_(philox(counter_, {seed, purposes::floor_pieces})) {}

    /// Returns the next draw, 0..1.
    double next() {
        if (used_ == 4) {
            counter_[1] += 1;
            words_ = philox(counter_, {seed_, purposes::floor_pieces});
            used_ = 0;
        }
        return static_cast<double>(words_[used_++] >> 8U) / 16777216.0;
    }

  private:
    std::uint32_t seed_;
    std::array<std::uint32_t, 4> counter_, words_;
    std::size_t used_ = 0;
};

class FloorPainter {
  public:
    FloorPainter(const FloorPaint& paint, RawImages& images) : paint_(paint), images_(images) {
        const double last = paint.side - 1;
        texel_ = (paint.box.east - paint.box.west) / last;
        margin_ = std::max(2, static_cast<int>(blur / texel_ + 0.5)) + 1;
        x_.reserve(static_cast<std::size_t>(paint.side + 2 * margin_));
        y_.reserve(x_.capacity());
        for (int i = -margin_; i < paint.side + margin_; ++i) {
            const double t = i / last;
            // Rounded, so that a place has the same coordinates in neighbouring images.
            x_.push_back(rounded((1.0 - t) * paint.box.west + t * paint.box.east));
            y_.push_back(rounded((1.0 - t) * paint.box.north + t * paint.box.south));
        }
        between_.reserve(x_.size());
        for (const double x : x_) {
            const double number = x / CoverField::step, floor = std::floor(number);
            const int node = std::clamp(static_cast<int>(floor) - paint.cover->west, 0,
                                        paint.cover->columns - 2);
            between_.emplace_back(static_cast<std::size_t>(node),
                                  static_cast<float>(number - floor));
        }
        Random random(paint.seed, purposes::floor_noise, 1);
        for (std::uint32_t& seed : noise_seeds_) seed = random.bits();
        for (const LeafLitter& kind : paint.kinds) {
            const bool needles = has_needles(kind);
            is_needle_.push_back(needles);
            if (needles) {
                stamps_.emplace_back();
                continue;
            }
            const double texels = kind.shape.length / texel_;
            stamps_.push_back(
                leaf_stamp(kind, std::clamp(static_cast<int>(1.6 * texels + 0.5), 12, 64)));
        }
        const double since = (paint.day + 365.0 - 305.0) / 365.0;
        fading_ = static_cast<float>(std::min(1.0, since - std::floor(since)));
        wet_ = static_cast<float>(paint.wetness);
    }

    void paint_band(int from, int to) const {
        Canvas canvas(-margin_, from - margin_, paint_.side + 2 * margin_, to - from + 2 * margin_);
        for (int row = 0; row < canvas.rows; ++row) paint_soil(canvas, row);
        for (std::size_t layer = 0; layer < layers.size(); ++layer) paint_layer(canvas, layer);
        resolve(canvas, from, to);
    }

  private:
    const FloorPaint& paint_;
    RawImages& images_;
    double texel_ = 0.01;
    int margin_ = 0;
    std::vector<double> x_, y_;  ///< of columns and rows, from margin_ beyond the image on
    /// The node of the field to the west of each column, and how far the column is from there to the next.
    std::vector<std::pair<std::size_t, float>> between_;
    std::array<std::uint32_t, 5> noise_seeds_{};
    std::vector<LeafStamp> stamps_;
    std::vector<bool> is_needle_;
    float fading_ = 0.0F, wet_ = 0.5F;

    [[nodiscard]] double x_of(const Canvas& canvas, int column) const {
        return x_[static_cast<std::size_t>(canvas.west + column + margin_)];
    }
    [[nodiscard]] double y_of(const Canvas& canvas, int row) const {
        return y_[static_cast<std::size_t>(canvas.north + row + margin_)];
    }

    [[nodiscard]] std::vector<float> noise(const Canvas& canvas, int row, double length,
                                           std::size_t which) const {
        const auto count = static_cast<std::size_t>(canvas.columns);
        std::vector<float> u(count), v(count), out(count);
        const auto [cosine, sine] = noise_turns[which];
        const double y = y_of(canvas, row);
        const double per_x = cosine / length, per_y = sine / length, from_u = y * sine / length,
                     from_v = y * cosine / length;
        for (std::size_t i = 0; i < count; ++i) {
            const double x = x_of(canvas, static_cast<int>(i));
            u[i] = static_cast<float>(x * per_x + from_u);
            v[i] = static_cast<float>(from_v - x * per_y);
        }
        gradient_noise(u, v, noise_seeds_[which], out);
        return out;
    }

    void paint_soil(Canvas& canvas, int row) const;
    /// Returns how likely a piece is where the ground has these shares.
    [[nodiscard]] static double share_of(Layer::Piece piece, double leaves, double needles,
                                         double moss, double grass, double herb);
    /// Returns an upper bound of that in a cell.
    [[nodiscard]] double most_of(Layer::Piece piece, int column, int row) const;
    void paint_layer(Canvas& canvas, std::size_t layer) const;
    void paint_piece(Canvas& canvas, const Layer& layer, const glm::dvec2& at, const Cover& cover,
                     Draws& draws) const;
    void paint_leaf(Canvas& canvas, const Layer& layer, const glm::dvec2& at, const Cover& cover,
                    Draws& draws) const;
    void paint_stroke(Canvas& canvas, const glm::dvec2& from, const glm::dvec2& to, double width,
                      float height, const glm::vec3& colour, float strength, float roughness) const;
    void resolve(const Canvas& canvas, int from, int to) const;
};

void FloorPainter::paint_soil(Canvas& canvas, int row) const {
    const std::vector<float> broad = noise(canvas, row, 0.55, 0),
                             middle = noise(canvas, row, 0.14, 1),
                             clods = noise(canvas, row, 0.045, 2),
                             crumbs = noise(canvas, row, std::max(0.016, 2.4 * texel_), 3),
                             tufts = noise(canvas, row, 0.027, 4);
    // The field along this row: shares at its nodes, then linear between them.
    const CoverField& field = *paint_.cover;
    const double y = y_of(canvas, row);
    struct Shares {
        float soil, leaves, needles, moss, grass, rock, water;
    };
    std::vector<Shares> nodes;
    nodes.reserve(static_cast<std::size_t>(field.columns));
    for (int i = 0; i < field.columns; ++i) {
        const Cover at = field.at((field.west + i) * CoverField::step, y);
        nodes.push_back({static_cast<float>(at.soil), static_cast<float>(at.all_leaves()),
                         static_cast<float>(at.needles), static_cast<float>(at.moss),
                         static_cast<float>(at.grass + 0.5 * at.herb), static_cast<float>(at.rock),
                         static_cast<float>(at.water)});
    }
    for (int column = 0; column < canvas.columns; ++column) {
        const auto i = static_cast<std::size_t>(column);
        const std::size_t node = between_[i].first;
        const float part = between_[i].second;
        const auto share = [&](float Shares::*of) {
            return nodes[node].*of + part * (nodes[node + 1].*of - nodes[node].*of);
        };
        const float b = broad[i], m = middle[i], c = clods[i], f = crumbs[i], t = tufts[i];
        // Patches whose shares of the ground are about those of the cover.
        const auto patch = [&](float of, float waves, float edge) {
            if (of <= 0.005F) return 0.0F;
            return unit(0.5F + (1.25F * of - 0.62F + waves) / edge);
        };
        const float tone = unit(0.5F + 0.55F * c + 0.5F * f + 0.35F * m);
        glm::vec3 colour = glm::mix(soil_dark, soil_pale, tone);
        colour = glm::mix(colour, soil_sand, unit(3.0F * (f + 0.4F * c - 0.42F)) * 0.7F);
        float height = 0.004F * c + 0.0022F * f + 0.006F * m;
        float roughness = 0.93F;
        const float leaves = share(&Shares::leaves);
        const float mould = unit(1.4F * leaves + 0.25F * b);
        colour = glm::mix(
            colour, glm::mix(mould_dark, mould_pale, unit(0.42F + 0.7F * t + 0.5F * c)), mould);
        if (const float needles = share(&Shares::needles); needles > 0.0F) {
            const float duff = unit(1.3F * needles + 0.15F * b);
            colour = glm::mix(
                colour, glm::mix(duff_dark, duff_pale, unit(0.45F + 0.8F * f + 0.5F * t)), duff);
            height += duff * (0.003F * f + 0.003F * t);
        }
        if (const float sod = patch(share(&Shares::grass), 0.5F * b + 0.5F * m, 0.5F); sod > 0.0F) {
            colour =
                glm::mix(colour, glm::mix(sod_dark, sod_pale, unit(0.45F + 0.6F * f + 0.6F * c)),
                         0.85F * sod);
            height += sod * (0.006F + 0.006F * t);
        }
        if (const float rock = patch(share(&Shares::rock), 0.5F * b + 0.4F * m, 0.12F);
            rock > 0.0F) {
            colour = glm::mix(
                colour, glm::mix(rock_dark, rock_pale, unit(0.5F + 0.5F * m + 0.4F * c + 0.3F * f)),
                rock);
            height += rock * (0.02F + 0.015F * m);
        }
        // Moss grows as cushions: domes, with the tips of its shoots as fine grain.
        const float inside =
            1.25F * share(&Shares::moss) - 0.62F + 0.75F * m + 0.45F * b + 0.12F * c;
        const float moss = share(&Shares::moss) <= 0.005F ? 0.0F : unit(0.5F + inside / 0.09F);
        if (moss > 0.0F) {
            const float dome = moss * std::sqrt(unit(1.4F * inside + 0.12F));
            const float shoots = unit(0.42F + 0.85F * f + 0.55F * t);
            glm::vec3 green = glm::mix(moss_dark, moss_pale, shoots * (0.45F + 0.55F * dome));
            green += glm::vec3(0.05F, 0.02F, -0.01F) * b;
            colour = glm::mix(colour, green, moss);
            height += moss * (0.012F + 0.028F * dome + 0.0035F * f + 0.003F * t);
            roughness = glm::mix(roughness, 0.97F, moss);
        }
        const float water = patch(share(&Shares::water), 0.3F * b, 0.15F);
        if (water > 0.0F) {
            colour = glm::mix(colour, water_colour, 0.92F * water);
            height = glm::mix(height, -0.012F, water);
            roughness = glm::mix(roughness, 0.06F, water);
        }
        canvas.points[canvas.index(column, row)] = {colour * (1.0F + 0.12F * b), height, roughness,
                                                    moss, water};
    }
}

double FloorPainter::share_of(Layer::Piece piece, double leaves, double needles, double moss,
                              double grass, double herb) {
    switch (piece) {
        case Layer::Piece::leaf:
            return 1.05 * leaves / (1.0 - 0.7 * moss);
        case Layer::Piece::needle:
            return needles;
        case Layer::Piece::twig:
            return 0.12 * (leaves + needles + 0.5 * moss);
        case Layer::Piece::blade:
            return 0.9 * grass;
        case Layer::Piece::herb:
            break;
    }
    return herb;
}

double FloorPainter::most_of(Layer::Piece piece, int column, int row) const {
    // A cell is within a square of the nodes of the field, between which the cover is linear.
    static_assert(CoverField::step / cell == 2.0);
    const CoverField& field = *paint_.cover;
    const int west = std::clamp((column >> 1) - field.west, 0, field.columns - 2),
              south = std::clamp((row >> 1) - field.south, 0, field.rows - 2);
    double leaves = 0.0, needles = 0.0, moss = 0.0, grass = 0.0, herb = 0.0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            const Cover& node = field.node(west + i, south + j);
            leaves = std::max(leaves, node.all_leaves());
            needles = std::max(needles, node.needles);
            moss = std::max(moss, node.moss);
            grass = std::max(grass, node.grass);
            herb = std::max(herb, node.herb);
        }
    // Slightly more, so that rounding leaves nothing out.
    return 1.000001 * share_of(piece, leaves, needles, moss, grass, herb);
}

void FloorPainter::paint_layer(Canvas& canvas, std::size_t number) const {
    const Layer& layer = layers[number];
    const auto cell_of = [](double metres) { return static_cast<int>(std::floor(metres / cell)); };
    const int west = cell_of(x_of(canvas, 0) - layer.reach),
              east = cell_of(x_of(canvas, canvas.columns - 1) + layer.reach),
              south = cell_of(y_of(canvas, canvas.rows - 1) - layer.reach),
              north = cell_of(y_of(canvas, 0) + layer.reach);
    const double low = y_of(canvas, canvas.rows - 1) - layer.reach,
                 high = y_of(canvas, 0) + layer.reach;
    // The order of cells and pieces is that of the world, so that the same piece is on top everywhere.
    for (int row = south; row <= north; ++row)
        for (int column = west; column <= east; ++column) {
            const double bound = most_of(layer.piece, column, row);
            for (int k = 0; bound > 0.0 && k < layer.most; ++k) {
                Draws draws(paint_.seed, static_cast<std::uint32_t>(number),
                            static_cast<std::uint32_t>(k), column, row);
                const double across = draws.next(), up = draws.next(), chance = draws.next();
                const glm::dvec2 at((column + across) * cell, (row + up) * cell);
                if (chance >= bound || at.y < low || at.y > high) continue;
                const Cover cover = paint_.cover->at(at.x, at.y);
                if (chance >= share_of(layer.piece, cover.all_leaves(), cover.needles, cover.moss,
                                       cover.grass, cover.herb))
                    continue;
                paint_piece(canvas, layer, at, cover, draws);
            }
        }
}

void FloorPainter::paint_piece(Canvas& canvas, const Layer& layer, const glm::dvec2& at,
                               const Cover& cover, Draws& draws) const {
    if (layer.piece == Layer::Piece::leaf) {
        paint_leaf(canvas, layer, at, cover, draws);
        return;
    }
    const double angle = draws.next(), size = draws.next();
    const auto hue = static_cast<float>(draws.next());
    const SineCosine turn = sine_cosine(2.0 * pi * angle);
    const glm::dvec2 along(turn.cosine, turn.sine);
    switch (layer.piece) {
        case Layer::Piece::leaf:
            break;
        case Layer::Piece::needle: {
            const glm::dvec2 half = (0.006 + 0.007 * size) * along;
            paint_stroke(canvas, at - half, at + half, 0.0016, layer.height,
                         glm::mix(needle_dark, needle_pale, hue * hue), 0.9F, 0.84F);
            break;
        }
        case Layer::Piece::twig: {
            const double bend = draws.next();
            const glm::dvec2 half = (0.02 + 0.65 * layer.reach * size * size) * along;
            const glm::dvec2 knee = at + (0.36 * bend - 0.18) * glm::dvec2(-half.y, half.x);
            const double width = 0.003 + 0.006 * size;
            const glm::vec3 colour = glm::mix(twig_dark, twig_pale, hue);
            paint_stroke(canvas, at - half, knee, width, layer.height, colour, 1.0F, 0.9F);
            paint_stroke(canvas, knee, at + half, 0.8 * width, layer.height, colour, 1.0F, 0.9F);
            break;
        }
        case Layer::Piece::blade: {
            const glm::dvec2 half = (0.012 + 0.026 * size) * along;
            const glm::vec3 colour =
                hue > 0.86F ? blade_dry : glm::mix(blade_dark, blade_pale, hue);
            paint_stroke(canvas, at - half, at + half, 0.0045, layer.height, colour, 0.9F, 0.84F);
            break;
        }
        case Layer::Piece::herb: {
            // Three leaflets round one stalk.
            const double length = 0.018 + 0.018 * size;
            for (int leaflet = 0; leaflet < 3; ++leaflet) {
                const SineCosine own = sine_cosine(2.0 * pi * (angle + leaflet / 3.0));
                const glm::dvec2 way(own.cosine, own.sine);
                paint_stroke(canvas, at + 0.35 * length * way, at + length * way,
                             0.016 + 0.012 * size, layer.height,
                             glm::mix(herb_dark, herb_pale, hue), 1.0F, 0.8F);
            }
            break;
        }
    }
}

void FloorPainter::paint_leaf(Canvas& canvas, const Layer& layer, const glm::dvec2& at,
                              const Cover& cover, Draws& draws) const {
    const double which = draws.next(), angle = draws.next(), size = draws.next(),
                 face = draws.next(), age = draws.next(), hue = draws.next(), tilt_x = draws.next(),
                 tilt_y = draws.next();
    double rest = which * cover.all_leaves();
    std::size_t kind = 0;
    while (kind + 1 < stamps_.size() && (is_needle_[kind] || rest >= cover.leaves[kind])) {
        if (!is_needle_[kind]) rest -= cover.leaves[kind];
        ++kind;
    }
    if (kind >= stamps_.size() || is_needle_[kind]) return;
    const LeafStamp& stamp = stamps_[kind];
    const double length = std::min(stamp.length * (0.72 + 0.5 * size), 2.0 * layer.reach / 1.42);
    const double radius = 0.71 * length;
    const SineCosine turn = sine_cosine(2.0 * pi * angle);
    const float cosine = static_cast<float>(turn.cosine / length),
                sine = static_cast<float>(turn.sine / length);
    const auto metres_of = static_cast<float>(length);
    const bool lower = face < 0.36;
    // Leaves of earlier years are darker and greyer, and those of this autumn fade until the next one.
    const float old =
        unit(static_cast<float>(age * age) * 0.75F + 0.5F * fading_ * static_cast<float>(age) -
             (layer.height > 0.013F ? 0.15F : 0.0F));
    const float bright = 0.86F + 0.30F * static_cast<float>(hue);
    const float warm = 0.10F * (static_cast<float>(size) - 0.5F);
    const glm::vec3 tint = bright * glm::vec3(1.0F + warm, 1.0F, 1.0F - 1.6F * warm) *
                           glm::mix(glm::vec3(1.0F), glm::vec3(0.58F, 0.55F, 0.56F), old);
    const glm::vec3 shown = lower ? tint * lower_face : tint;
    const auto slope_x = static_cast<float>(0.36 * tilt_x - 0.18),
               slope_y = static_cast<float>(0.36 * tilt_y - 0.18);
    const float curl = 0.5F * static_cast<float>(face + tilt_x) - 0.2F;
    const double left = x_of(canvas, 0), top = y_of(canvas, 0);
    const int from_row = std::max(0, static_cast<int>(std::floor((top - at.y - radius) / texel_))),
              to_row = std::min(canvas.rows - 1,
                                static_cast<int>(std::ceil((top - at.y + radius) / texel_)));
    const float hidden = layer.height > 0.018F ? 0.55F : 0.93F;
    for (int row = from_row; row <= to_row; ++row) {
        const auto dy = static_cast<float>(y_of(canvas, row) - at.y);
        // The columns whose middles are within the picture: |along| <= 1/2, |across| <= half.
        double first = -radius, last = radius;
        const auto within = [&first, &last](double slope, double offset, double bound) {
            if (std::abs(slope) < 1e-9) return;
            const double one = (-bound - offset) / slope, other = (bound - offset) / slope;
            first = std::max(first, std::min(one, other));
            last = std::min(last, std::max(one, other));
        };
        within(static_cast<double>(cosine), static_cast<double>(dy * sine), 0.5);
        within(static_cast<double>(-sine), static_cast<double>(dy * cosine),
               static_cast<double>(stamp.half));
        const int from_column =
                      std::max(0, static_cast<int>(std::floor((at.x + first - left) / texel_))),
                  to_column = std::min(canvas.columns - 1,
                                       static_cast<int>(std::ceil((at.x + last - left) / texel_)));
        for (int column = from_column; column <= to_column; ++column) {
            const auto dx = static_cast<float>(x_of(canvas, column) - at.x);
            const float along = dx * cosine + dy * sine, across = dy * cosine - dx * sine;
            if (along < -0.5F || along > 0.5F || across < -stamp.half || across > stamp.half)
                continue;
            const LeafStamp::Texel& texel = stamp.at(along, across);
            if (texel.cover <= 0.0F) continue;
            Canvas::Point& point = canvas.points[canvas.index(column, row)];
            const float alpha =
                texel.cover * (1.0F - hidden * point.moss) * (1.0F - 0.9F * point.water);
            point.colour =
                glm::mix(point.colour, (lower ? texel.lower : texel.upper) * shown, alpha);
            const float height = layer.height + slope_x * dx + slope_y * dy +
                                 metres_of * (texel.rise + curl * across * across);
            point.height = glm::mix(point.height, std::max(height, point.height + 0.0008F), alpha);
            point.roughness = glm::mix(point.roughness, 0.86F, alpha);
        }
    }
}

void FloorPainter::paint_stroke(Canvas& canvas, const glm::dvec2& from, const glm::dvec2& to,
                                double width, float height, const glm::vec3& colour, float strength,
                                float roughness) const {
    const glm::dvec2 way = to - from;
    const double square = way.x * way.x + way.y * way.y;
    if (square <= 0.0) return;
    // Lines narrower than a texel are as much paler.
    const double drawn = std::max(width, 1.1 * texel_);
    const auto half = static_cast<float>(0.5 * drawn);
    const float faint = strength * static_cast<float>(std::sqrt(width / drawn));
    const double left = x_of(canvas, 0), top = y_of(canvas, 0), around = 0.5 * drawn + texel_;
    const int from_column = std::max(
                  0,
                  static_cast<int>(std::floor((std::min(from.x, to.x) - around - left) / texel_))),
              to_column = std::min(
                  canvas.columns - 1,
                  static_cast<int>(std::ceil((std::max(from.x, to.x) + around - left) / texel_))),
              from_row = std::max(
                  0,
                  static_cast<int>(std::floor((top - std::max(from.y, to.y) - around) / texel_))),
              to_row = std::min(
                  canvas.rows - 1,
                  static_cast<int>(std::ceil((top - std::min(from.y, to.y) + around) / texel_)));
    const glm::vec2 along(way / square);
    const glm::vec2 whole(way);
    const auto soft = static_cast<float>(1.0 / texel_);
    for (int row = from_row; row <= to_row; ++row) {
        const auto dy = static_cast<float>(y_of(canvas, row) - from.y);
        for (int column = from_column; column <= to_column; ++column) {
            const auto dx = static_cast<float>(x_of(canvas, column) - from.x);
            const float t = unit(dx * along.x + dy * along.y);
            const float px = dx - t * whole.x, py = dy - t * whole.y;
            const float distance = std::sqrt(px * px + py * py);
            const float cover = unit((half - distance) * soft + 0.5F);
            if (cover <= 0.0F) continue;
            Canvas::Point& point = canvas.points[canvas.index(column, row)];
            const float alpha = faint * cover * (1.0F - 0.85F * point.water);
            const float round = distance / half;
            point.colour = glm::mix(point.colour, colour * (1.05F - 0.3F * round * round), alpha);
            const float high = std::max(point.height, height) +
                               half * (0.6F - 0.6F * std::min(1.0F, round * round));
            point.height = glm::mix(point.height, high, alpha);
            point.roughness = glm::mix(point.roughness, roughness, alpha);
        }
    }
}

void FloorPainter::resolve(const Canvas& canvas, int from, int to) const {
    const auto radius = static_cast<std::size_t>(margin_ - 1),
               margin = static_cast<std::size_t>(margin_);
    const auto side = static_cast<std::size_t>(paint_.side);
    const auto columns = static_cast<std::size_t>(canvas.columns);
    std::vector<float> heights(canvas.points.size());
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = canvas.points[i].height;
    // The sum of heights in a square, from sums along columns: each in one order at every place.
    const float per_place = 1.0F / static_cast<float>((2 * radius + 1) * (2 * radius + 1));
    const auto per_slope = static_cast<float>(0.5 / texel_);
    const float wet = 1.12F - 0.24F * wet_, smoothness = 0.12F * wet_ * wet_;
    std::vector<float> sums(columns), mean(side), dark(side);
    std::array<std::vector<float>, 8> channels;
    for (std::vector<float>& channel : channels) channel.resize(side);
    for (int y = from; y < to; ++y) {
        const std::size_t first = canvas.index(0, y - canvas.north);
        const float* const height = &heights[first];
        std::fill(sums.begin(), sums.end(), 0.0F);
        for (std::size_t k = 0; k <= 2 * radius; ++k) {
            const float* const row = height + k * columns - radius * columns;
            for (std::size_t i = 0; i < columns; ++i) sums[i] += row[i];
        }
        std::fill(mean.begin(), mean.end(), 0.0F);
        for (std::size_t k = 0; k <= 2 * radius; ++k) {
            const float* const at = &sums[margin - radius + k];
            for (std::size_t i = 0; i < side; ++i) mean[i] += at[i];
        }
        const float* const here = height + margin;
        const float* const above = here - columns;
        const float* const under = here + columns;
        const Canvas::Point* const points = &canvas.points[first + margin];
        for (std::size_t i = 0; i < side; ++i) {
            const float below = mean[i] * per_place - here[i];
            const float deep = std::max(below, 0.0F), proud = std::max(-below, 0.0F);
            const float open = std::max(1.0F - 55.0F * deep, 0.25F);
            dark[i] = wet * (0.62F + 0.38F * open) * std::min(1.0F + 6.0F * proud, 1.1F);
            const float right = here[i + 1], left = *(here + i - 1);
            float nx = (left - right) * per_slope, ny = (under[i] - above[i]) * per_slope;
            // Steeper slopes than these are the sides of pieces, which no texel resolves.
            const float gentle = 0.8F / std::sqrt(1.0F + 0.45F * (nx * nx + ny * ny));
            nx *= gentle;
            ny *= gentle;
            const float length = 0.5F / std::sqrt(1.0F + nx * nx + ny * ny);
            channels[3][i] = 0.5F + nx * length;
            channels[4][i] = 0.5F + ny * length;
            channels[5][i] = 0.5F + length;
            channels[6][i] = open;
            channels[7][i] = points[i].roughness - smoothness;
        }
        for (std::size_t i = 0; i < side; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                channels[k][i] = points[i].colour[static_cast<glm::vec3::length_type>(k)] * dark[i];
        const std::size_t start = 3 * static_cast<std::size_t>(y) * side;
        for (std::size_t k = 0; k < channels.size(); ++k) {
            std::uint8_t* const bytes = &images_.rgb[k / 3][start + k % 3];
            const float* const values = channels[k].data();
            for (std::size_t i = 0; i < side; ++i)
                bytes[3 * i] =
                    static_cast<std::uint8_t>(static_cast<int>(unit(values[i]) * 255.0F + 0.5F));
        }
    }
}

}  // namespace

RawImages floor_images(const FloorPaint& paint, const Parallel& parallel) {
    if (paint.side < 16 || paint.side > 4096)
        throw InvalidInput("/side", "the side of the images of a floor is 16..4096 texels");
    if (paint.cover == nullptr || paint.cover->columns < 2 || paint.cover->rows < 2)
        throw InvalidInput("/cover", "a floor has no images without its cover");
    const auto side = static_cast<std::size_t>(paint.side);
    RawImages images{paint.side, {}};
    for (Bytes& image : images.rgb) image.resize(3 * side * side);
    const FloorPainter painter(paint, images);
    std::vector<std::function<void()>> tasks;
    for (int from = 0; from < paint.side; from += band)
        tasks.emplace_back([&painter, from, to = std::min(from + band, paint.side)] {
            painter.paint_band(from, to);
        });
    parallel(tasks);
    return images;
}

}  // namespace sporeprint
