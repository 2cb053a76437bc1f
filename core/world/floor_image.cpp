#include "core/world/floor_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/problems.h"
#include "core/world/floor_texels.h"
#include "core/world/grass_season.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/world/floor_kernels.inl"
#include <hwy/foreach_target.h>

#include "core/world/floor_kernels.inl"

namespace sporeprint {

HWY_EXPORT(paint_soil);
HWY_EXPORT(paint_stroke);
HWY_EXPORT(paint_leaf);
HWY_EXPORT(finish_row);

namespace {

/// Rows that are painted by one task.
constexpr int band = 128;

/// Radius of the blur of heights from which occlusion follows, metres.
constexpr double blur = 0.022;

/// Side of the cells in which pieces lie: as a power of two in floor_units, and in metres.
constexpr int cell_bits = 17;
constexpr double cell = 0.25;
static_assert(cell * floor_units == 1 << cell_bits);

/// The finest step of a field of cover, as a power of two in floor_units.
constexpr int finest_step_bits = 18;
static_assert(CoverField::finest_step * floor_units == 1 << finest_step_bits);

/// Returns the step of a field as a power of two in floor_units.
int bits_of_step(const CoverField& field) {
    int bits = finest_step_bits;
    for (double step = CoverField::finest_step; step < field.step; step *= 2.0) ++bits;
    return bits;
}

/// Pieces that may lie in a cell, in the order in which they are painted.
struct Layer {
    enum class Piece : std::uint8_t { leaf, needle, twig, blade, herb } piece;
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
constexpr std::size_t pieces = 5;

constexpr glm::vec3 lower_face(0.94F, 0.86F, 0.76F), needle_dark(0.30F, 0.19F, 0.11F),
    needle_pale(0.60F, 0.42F, 0.25F), twig_dark(0.25F, 0.20F, 0.16F),
    twig_pale(0.47F, 0.43F, 0.38F), blade_dark(0.20F, 0.28F, 0.09F),
    blade_pale(0.46F, 0.53F, 0.21F), blade_dry(0.60F, 0.55F, 0.36F), herb_dark(0.20F, 0.33F, 0.10F),
    herb_pale(0.38F, 0.50F, 0.20F);

/// Returns a coordinate as a whole number of floor_units.
std::int32_t units_of(double metres) {
    return static_cast<std::int32_t>(std::floor(metres * floor_units + 0.5));
}
constexpr double unit_metres = 1.0 / floor_units;

/// Ranges of texels are larger by this than pieces, metres, so that rounding leaves nothing out.
constexpr double rounding = 1e-5;

float unit(float value) { return value < 0.0F ? 0.0F : value > 1.0F ? 1.0F : value; }

std::array<float, 3> shade(const glm::vec3& colour) { return {colour.x, colour.y, colour.z}; }

/// A lattice of noise: the size of its cells in metres, and its rotation as cosine and sine. None is parallel to the
/// rows of texels or to another.
struct Lattice {
    double length, cosine, sine;
};
constexpr std::array<Lattice, floor_noises> lattices{{{0.55, 0.8, 0.6},
                                                      {0.14, 0.28, 0.96},
                                                      {0.045, 0.96, -0.28},
                                                      {0.016, 0.6, -0.8},
                                                      {0.027, 15.0 / 17.0, 8.0 / 17.0}}};
/// Crumbs are not smaller than so many texels; from afar no noise is.
constexpr double least_crumb = 2.4;

/// Directions of pieces are multiples of a turn divided by this.
constexpr std::size_t directions = 1024;

const std::array<glm::dvec2, directions>& direction_table() {
    static const auto table = [] {
        std::array<glm::dvec2, directions> out{};
        for (std::size_t i = 0; i < directions; ++i) {
            const SineCosine turn = sine_cosine(2.0 * pi * static_cast<double>(i) / directions);
            out[i] = {turn.cosine, turn.sine};
        }
        return out;
    }();
    return table;
}

/// A stamp with its colours as bytes.
struct PackedStamp {
    std::size_t kind = 0;
    double length = 0.08;
    float half = 0.5F;
    int columns = 0, rows = 0;
    std::vector<std::uint32_t> upper, lower;
    std::vector<float> rises;
};

PackedStamp packed(const LeafStamp& stamp, std::size_t kind) {
    PackedStamp out{kind, stamp.length, stamp.half, stamp.columns, stamp.rows, {}, {}, {}};
    const auto byte = [](float value) {
        return static_cast<std::uint32_t>(unit(value) * 255.0F + 0.5F);
    };
    for (const LeafStamp::Texel& texel : stamp.texels) {
        const auto bits = [&](const glm::vec3& colour) {
            return byte(colour.x) | byte(colour.y) << 8U | byte(colour.z) << 16U |
                   byte(texel.cover) << 24U;
        };
        out.upper.push_back(bits(texel.upper));
        out.lower.push_back(bits(texel.lower));
        out.rises.push_back(texel.rise);
    }
    return out;
}

/// A piece: its middle, the cover there, and 64 bits that its looks are drawn from.
struct Piece {
    std::int32_t x = 0, y = 0;        ///< in floor_units
    std::size_t node = 0;             ///< of the field, to the south-west of it
    float east = 0.0F, north = 0.0F;  ///< from there to the next nodes, 0..1
    std::uint32_t first = 0, second = 0;
};

class FloorPainter {
  public:
    FloorPainter(const FloorPaint& paint, RawImages& images);
    void paint_band(int from, int to) const;

  private:
    const FloorPaint& paint_;
    RawImages& images_;
    double texel_ = 0.01;
    int margin_ = 0;
    std::size_t stride_ = 0;
    std::vector<std::int32_t> x_, y_;  ///< of columns and rows, from margin_ beyond the image on
    std::vector<float>
        part_;  ///< how far each column is from the node of the field to the west of it
    std::vector<int> columns_;  ///< the first column beyond each node but the first
    std::array<std::vector<std::int32_t>, floor_noises> u_, v_;
    std::array<std::uint32_t, floor_noises> noise_seeds_{};
    std::array<double, floor_noises> per_cell_{};          ///< units of noise coordinates per metre
    std::vector<std::array<float, floor_shares>> shares_;  ///< at the nodes of the field
    std::vector<std::array<float, pieces>> chances_;       ///< of pieces, at the nodes of the field
    std::vector<PackedStamp> stamps_;
    std::vector<float> leaves_;  ///< at the nodes of the field, of each stamp
    FallenLeaves fallen_;
    float wet_ = 0.5F;
    float green_ = 0.86F;  ///< share of the blades of grass that are not withered
    float fresh_ = 1.0F;   ///< their brightness
    int step_bits_ = finest_step_bits;
    glm::vec3 leaf_mean_{0.0F};  ///< colour of leaves as they look from afar

    void set_columns();
    void set_cover(double herbs);
    void set_stamps();
    void add_mean(const LeafStamp& stamp);

    /// Returns the factor of the colour of a leaf on the ground.
    ///
    /// age     which of all leaves, 0 for the last ones that fell to 1
    /// on_top  it lies on most others
    [[nodiscard]] glm::vec3 tint_of(double age, bool on_top) const;

    void paint_row(FloorCanvas& canvas, int row, std::vector<float>& space) const;
    /// Mixes the mean colour of leaves into a row of soil.
    ///
    /// at_nodes  shares of leaves at the nodes of the field along the row
    void mix_leaves(FloorCanvas& canvas, int row, const float* at_nodes) const;
    /// Returns the mean of the values at the four nodes round a piece.
    template <class Value>
    [[nodiscard]] float between(const Piece& at, Value value) const;
    /// Returns an upper bound of how likely a piece is in a cell.
    [[nodiscard]] float most_of(std::size_t piece, std::size_t node) const;
    void paint_layer(FloorCanvas& canvas, std::size_t layer) const;
    void paint_piece(FloorCanvas& canvas, const Layer& layer, const Piece& piece) const;
    void paint_leaf(FloorCanvas& canvas, const Layer& layer, const Piece& piece) const;
    void paint_stroke(FloorCanvas& canvas, const glm::dvec2& from, const glm::dvec2& to,
                      double width, FloorStroke stroke) const;
    /// Returns the texels of a canvas within a rectangle, metres, and one more on each side.
    [[nodiscard]] FloorRange range_of(const FloorCanvas& canvas, const glm::dvec2& least,
                                      const glm::dvec2& most) const;
    void finish(const FloorCanvas& canvas, int from, int to) const;
};

FloorPainter::FloorPainter(const FloorPaint& paint, RawImages& images)
    : paint_(paint), images_(images) {
    texel_ = (paint.box.east - paint.box.west) / (paint.side - 1);
    margin_ = std::max(2, static_cast<int>(blur / texel_ + 0.5)) + 1;
    stride_ = static_cast<std::size_t>(paint.side + 2 * margin_) + floor_padding;
    step_bits_ = bits_of_step(*paint.cover);
    set_columns();
    const GrassSeason grass = grass_on(paint.day);
    green_ = static_cast<float>(1.0 - grass.dry);
    fresh_ = static_cast<float>(grass.fresh);
    fallen_ = fallen_leaves(paint.day);
    set_cover(grass.herbs);
    set_stamps();
    wet_ = static_cast<float>(paint.wetness);
}

void FloorPainter::set_columns() {
    const double last = paint_.side - 1;
    x_.reserve(stride_);
    y_.reserve(stride_);
    for (std::size_t k = 0; k < stride_; ++k) {
        const double t = (static_cast<double>(k) - margin_) / last;
        // Rounded, so that a place has the same coordinates in neighbouring images.
        x_.push_back(units_of((1.0 - t) * paint_.box.west + t * paint_.box.east));
        y_.push_back(units_of((1.0 - t) * paint_.box.north + t * paint_.box.south));
    }
    const CoverField& field = *paint_.cover;
    part_.reserve(stride_);
    columns_.assign(static_cast<std::size_t>(field.columns), paint_.side + 2 * margin_);
    for (std::size_t k = stride_; k-- > 0;) {
        const int node = std::clamp((x_[k] >> step_bits_) - field.west, 0, field.columns - 2);
        for (int i = 0; i < node; ++i) columns_[static_cast<std::size_t>(i)] = static_cast<int>(k);
    }
    for (const std::int32_t x : x_)
        part_.push_back(static_cast<float>(x & ((1 << step_bits_) - 1)) /
                        static_cast<float>(1 << step_bits_));
    Random random(paint_.seed, purposes::floor_noise, 1);
    for (std::uint32_t& seed : noise_seeds_) seed = random.bits();
    for (std::size_t k = 0; k < floor_noises; ++k) {
        const double length = std::max(
            lattices[k].length, k == noise_crumbs || !paint_.pieces ? least_crumb * texel_ : 0.0);
        per_cell_[k] = (1 << noise_bits) / length;
        for (const std::int32_t x : x_) {
            const double along = x * unit_metres * per_cell_[k];
            u_[k].push_back(
                static_cast<std::int32_t>(std::floor(along * lattices[k].cosine + 0.5)));
            v_[k].push_back(static_cast<std::int32_t>(std::floor(along * lattices[k].sine + 0.5)));
        }
    }
}

void FloorPainter::set_cover(double herbs) {
    shares_.reserve(paint_.cover->nodes.size());
    chances_.reserve(paint_.cover->nodes.size());
    const auto single = [](double value) { return static_cast<float>(value); };
    for (const Cover& at : paint_.cover->nodes) {
        const double leaves = at.all_leaves();
        shares_.push_back({single(leaves), single(at.needles), single(at.moss),
                           single(at.grass + 0.5 * at.herb), single(at.rock), single(at.water)});
        chances_.push_back({single(1.05 * leaves / (1.0 - 0.7 * at.moss)), single(at.needles),
                            single(0.12 * (leaves + at.needles + 0.5 * at.moss)),
                            single(0.9 * at.grass), single(herbs * at.herb)});
    }
}

void FloorPainter::set_stamps() {
    for (std::size_t kind = 0; kind < paint_.kinds.size(); ++kind) {
        const LeafLitter& litter = paint_.kinds[kind];
        if (has_needles(litter)) continue;
        const double texels = litter.shape.length / texel_;
        const LeafStamp stamp =
            leaf_stamp(litter, std::clamp(static_cast<int>(1.6 * texels + 0.5), 12, 64));
        if (!paint_.pieces) add_mean(stamp);
        stamps_.push_back(packed(stamp, kind));
    }
    if (!stamps_.empty()) leaf_mean_ /= static_cast<float>(stamps_.size());
    leaves_.reserve(stamps_.size() * paint_.cover->nodes.size());
    for (const Cover& at : paint_.cover->nodes)
        for (const PackedStamp& stamp : stamps_)
            leaves_.push_back(static_cast<float>(at.leaves[stamp.kind]));
}

void FloorPainter::add_mean(const LeafStamp& stamp) {
    // Of what paint_leaf() draws: two in three leaves show the upper face.
    constexpr float of_upper = 0.64F;
    const glm::vec3 faded = 0.5F * (tint_of(0.25, true) + tint_of(0.75, false));
    glm::vec3 sum(0.0F);
    float covered = 0.0F;
    for (const LeafStamp::Texel& texel : stamp.texels) {
        sum +=
            texel.cover * (of_upper * texel.upper + (1.0F - of_upper) * lower_face * texel.lower);
        covered += texel.cover;
    }
    if (covered > 0.0F) leaf_mean_ += sum * faded / covered;
}

glm::vec3 FloorPainter::tint_of(double age, bool on_top) const {
    constexpr glm::vec3 faded(0.50F, 0.58F, 0.70F), fresh(1.30F, 1.25F, 1.0F);
    const double fading = fallen_.faded_at(age);
    // Leaves of earlier years lie below those of the last one.
    const double old =
        0.7 * age * age + fading * (0.95 + 0.35 * age) - (on_top ? 0.15 * (1.0 - fading) : 0.0);
    const glm::vec3 tint = glm::mix(glm::vec3(1.0F), faded, unit(static_cast<float>(old)));
    if (!fallen_.is_new(age) || !on_top) return tint;
    return tint * glm::mix(glm::vec3(1.0F), fresh, static_cast<float>(fallen_.fresh));
}

void FloorPainter::paint_band(int from, int to) const {
    FloorCanvas canvas;
    canvas.columns = paint_.side + 2 * margin_;
    canvas.rows = to - from + 2 * margin_;
    canvas.stride = stride_;
    canvas.x = x_.data();
    canvas.y = y_.data() + from;
    canvas.values = std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(canvas.rows) *
                                                            floor_planes * stride_);
    std::vector<float> space(floor_shares *
                             (stride_ + static_cast<std::size_t>(paint_.cover->columns)));
    for (int row = 0; row < canvas.rows; ++row) paint_row(canvas, row, space);
    for (std::size_t layer = 0; paint_.pieces && layer < layers.size(); ++layer)
        paint_layer(canvas, layer);
    finish(canvas, from, to);
}

void FloorPainter::paint_row(FloorCanvas& canvas, int row, std::vector<float>& space) const {
    const CoverField& field = *paint_.cover;
    const std::int32_t y = canvas.y[row];
    SoilRow soil;
    soil.seeds = noise_seeds_;
    for (std::size_t k = 0; k < floor_noises; ++k) {
        soil.u[k] = u_[k].data();
        soil.v[k] = v_[k].data();
        const double along = y * unit_metres * per_cell_[k];
        soil.u0[k] = static_cast<std::int32_t>(std::floor(along * lattices[k].sine + 0.5));
        soil.v0[k] = static_cast<std::int32_t>(std::floor(along * lattices[k].cosine + 0.5));
    }
    // The field along this row: shares at its nodes, then linear between them.
    const auto nodes = static_cast<std::size_t>(field.columns);
    soil.nodes = nodes;
    soil.columns = columns_.data();
    soil.part = part_.data();
    const int south = std::clamp((y >> step_bits_) - field.south, 0, field.rows - 2);
    const float north =
        static_cast<float>(y & ((1 << step_bits_) - 1)) / static_cast<float>(1 << step_bits_);
    const auto* const below = &shares_[static_cast<std::size_t>(south) * nodes];
    const auto* const above = below + nodes;
    for (std::size_t share = 0; share < floor_shares; ++share) {
        float* const at_nodes = space.data() + share * nodes;
        for (std::size_t i = 0; i < nodes; ++i)
            at_nodes[i] = below[i][share] + north * (above[i][share] - below[i][share]);
        soil.shares[share] = at_nodes;
        soil.between[share] = space.data() + floor_shares * nodes + share * stride_;
    }
    HWY_DYNAMIC_DISPATCH(paint_soil)(canvas, row, soil);
    if (!paint_.pieces && !stamps_.empty()) mix_leaves(canvas, row, soil.shares[share_leaves]);
}

void FloorPainter::mix_leaves(FloorCanvas& canvas, int row, const float* at_nodes) const {
    float* const red = canvas.at(row, floor_red);
    float* const green = canvas.at(row, floor_green);
    float* const blue = canvas.at(row, floor_blue);
    const float* const moss = canvas.at(row, floor_moss);
    const float* const water = canvas.at(row, floor_water);
    const std::size_t last = static_cast<std::size_t>(paint_.cover->columns) - 2;
    std::size_t node = 0;
    for (int i = 0; i < canvas.columns; ++i) {
        while (node < last && i >= columns_[node]) ++node;
        const float part = part_[static_cast<std::size_t>(i)];
        const float leaves = at_nodes[node] + part * (at_nodes[node + 1] - at_nodes[node]);
        // About as many leaves lie over each other as hide the ground where they cover it.
        const float hidden =
            unit(1.6F * leaves) * (1.0F - 0.8F * moss[i]) * (1.0F - 0.9F * water[i]);
        // The noise of the ground makes heaps of leaves brighter and gaps between them darker.
        const float bright = 0.55F + 1.6F * red[i];
        red[i] += hidden * (bright * leaf_mean_.x - red[i]);
        green[i] += hidden * (bright * leaf_mean_.y - green[i]);
        blue[i] += hidden * (bright * leaf_mean_.z - blue[i]);
    }
}

template <class Value>
float FloorPainter::between(const Piece& at, Value value) const {
    const std::size_t above = at.node + static_cast<std::size_t>(paint_.cover->columns);
    const float south = value(at.node) + at.east * (value(at.node + 1) - value(at.node)),
                north = value(above) + at.east * (value(above + 1) - value(above));
    return south + at.north * (north - south);
}

float FloorPainter::most_of(std::size_t piece, std::size_t node) const {
    // A cell is within a square of the nodes of the field, between which chances are linear.
    static_assert(CoverField::finest_step / cell == 2.0);
    const std::size_t above = node + static_cast<std::size_t>(paint_.cover->columns);
    // Slightly more, so that rounding leaves nothing out.
    return 1.00001F * std::max(std::max(chances_[node][piece], chances_[node + 1][piece]),
                               std::max(chances_[above][piece], chances_[above + 1][piece]));
}

void FloorPainter::paint_layer(FloorCanvas& canvas, std::size_t number) const {
    const Layer& layer = layers[number];
    const CoverField& field = *paint_.cover;
    const auto piece_index = static_cast<std::size_t>(layer.piece);
    const std::int32_t reach = units_of(layer.reach);
    const std::int32_t low = canvas.y[canvas.rows - 1] - reach, high = canvas.y[0] + reach;
    const int west = (canvas.x[0] - reach) >> cell_bits,
              east = (canvas.x[canvas.columns - 1] + reach) >> cell_bits, south = low >> cell_bits,
              north = high >> cell_bits;
    // The order of cells and pieces is that of the world, so that the same piece is on top everywhere.
    for (int row = south; row <= north; ++row)
        for (int column = west; column <= east; ++column) {
            Piece piece;
            piece.node =
                static_cast<std::size_t>(std::clamp((row >> 1) - field.south, 0, field.rows - 2)) *
                    static_cast<std::size_t>(field.columns) +
                static_cast<std::size_t>(
                    std::clamp((column >> 1) - field.west, 0, field.columns - 2));
            // The k-th of n pieces is there where its chance is more than a draw between k / n and (k + 1) / n, so
            // that none is drawn beyond the last one that may be there.
            const float most = static_cast<float>(layer.most);
            const float bound = most * most_of(piece_index, piece.node);
            for (int k = 0; k < layer.most && static_cast<float>(k) < bound; ++k) {
                const auto draws =
                    philox({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(number),
                            static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)},
                           {paint_.seed, purposes::floor_pieces});
                const float chance =
                    static_cast<float>(k) + static_cast<float>(draws[1] >> 8U) / 16777216.0F;
                if (chance >= bound) continue;
                piece.x = (column << cell_bits) + static_cast<std::int32_t>(draws[0] >> 16U) * 2;
                piece.y = (row << cell_bits) + static_cast<std::int32_t>(draws[0] & 0xffffU) * 2;
                if (piece.y < low || piece.y > high) continue;
                constexpr std::int32_t within = (1 << finest_step_bits) - 1;
                piece.east = static_cast<float>(piece.x & within) / (1 << finest_step_bits);
                piece.north = static_cast<float>(piece.y & within) / (1 << finest_step_bits);
                if (chance >= most * between(piece, [&](std::size_t node) {
                                  return chances_[node][piece_index];
                              }))
                    continue;
                piece.first = draws[2];
                piece.second = draws[3];
                paint_piece(canvas, layer, piece);
            }
        }
}

FloorRange FloorPainter::range_of(const FloorCanvas& canvas, const glm::dvec2& least,
                                  const glm::dvec2& most) const {
    const double left = canvas.x[0] * unit_metres, top = canvas.y[0] * unit_metres,
                 per_metre = 1.0 / texel_;
    FloorRange range;
    range.west = std::max(0, static_cast<int>((least.x - left) * per_metre));
    range.east = std::min(canvas.columns - 1, static_cast<int>((most.x - left) * per_metre + 1.0));
    range.north = std::max(0, static_cast<int>((top - most.y) * per_metre));
    range.south = std::min(canvas.rows - 1, static_cast<int>((top - least.y) * per_metre + 1.0));
    return range;
}

void FloorPainter::paint_piece(FloorCanvas& canvas, const Layer& layer, const Piece& piece) const {
    if (layer.piece == Layer::Piece::leaf) {
        paint_leaf(canvas, layer, piece);
        return;
    }
    const std::size_t direction = (piece.first >> 16U) % directions;
    const double size = (piece.first & 0xffffU) / 65536.0;
    const float hue = static_cast<float>(piece.second >> 16U) / 65536.0F;
    const glm::dvec2 at(piece.x * unit_metres, piece.y * unit_metres);
    const glm::dvec2 along = direction_table()[direction];
    FloorStroke stroke;
    stroke.height = layer.height;
    stroke.strength = 0.9F;
    stroke.roughness = 0.84F;
    switch (layer.piece) {
        case Layer::Piece::leaf:
            break;
        case Layer::Piece::needle: {
            const glm::dvec2 half = (0.006 + 0.007 * size) * along;
            stroke.colour = shade(glm::mix(needle_dark, needle_pale, hue * hue));
            paint_stroke(canvas, at - half, at + half, 0.0016, stroke);
            break;
        }
        case Layer::Piece::twig: {
            const double bend = (piece.second & 0xffffU) / 65536.0;
            const glm::dvec2 half = (0.02 + 0.65 * layer.reach * size * size) * along;
            const glm::dvec2 knee = at + (0.36 * bend - 0.18) * glm::dvec2(-half.y, half.x);
            const double width = 0.003 + 0.006 * size;
            stroke.colour = shade(glm::mix(twig_dark, twig_pale, hue));
            stroke.strength = 1.0F;
            stroke.roughness = 0.9F;
            paint_stroke(canvas, at - half, knee, width, stroke);
            paint_stroke(canvas, knee, at + half, 0.8 * width, stroke);
            break;
        }
        case Layer::Piece::blade: {
            const glm::dvec2 half = (0.012 + 0.026 * size) * along;
            stroke.colour = shade(
                hue > green_ ? blade_dry : fresh_ * glm::mix(blade_dark, blade_pale, hue / green_));
            paint_stroke(canvas, at - half, at + half, 0.0045, stroke);
            break;
        }
        case Layer::Piece::herb: {
            // Three leaflets round one stalk.
            const double length = 0.018 + 0.018 * size;
            stroke.colour = shade(glm::mix(herb_dark, herb_pale, hue));
            stroke.strength = 1.0F;
            stroke.roughness = 0.8F;
            for (std::size_t leaflet = 0; leaflet < 3; ++leaflet) {
                const glm::dvec2 way =
                    direction_table()[(direction + leaflet * directions / 3) % directions];
                paint_stroke(canvas, at + 0.35 * length * way, at + length * way,
                             0.016 + 0.012 * size, stroke);
            }
            break;
        }
    }
}

void FloorPainter::paint_leaf(FloorCanvas& canvas, const Layer& layer, const Piece& piece) const {
    if (stamps_.empty()) return;
    // Eight draws, of a byte each.
    const auto draw = [&](std::size_t which) {
        const std::uint32_t word = which < 4 ? piece.first : piece.second;
        return static_cast<double>(word >> (8U * (which % 4)) & 255U) / 256.0;
    };
    const double size = draw(1), face = draw(2), age = draw(3), hue = draw(4), tilt_x = draw(5),
                 tilt_y = draw(6);
    const std::size_t kinds = stamps_.size();
    std::size_t kind = 0;
    if (kinds > 1) {
        std::array<float, most_kinds> shares{};
        float all = 0.0F;
        for (std::size_t k = 0; k < kinds; ++k) {
            shares[k] = between(piece, [&](std::size_t node) { return leaves_[node * kinds + k]; });
            all += shares[k];
        }
        float rest = static_cast<float>(draw(0)) * all;
        while (kind + 1 < kinds && rest >= shares[kind]) rest -= shares[kind++];
    }
    const PackedStamp& stamp = stamps_[kind];
    const double length = std::min(stamp.length * (0.72 + 0.5 * size), 2.0 * layer.reach / 1.42);
    const glm::dvec2 along = direction_table()[static_cast<std::size_t>(draw(7) * directions)];
    const bool lower = face < 0.36;
    const float bright = 0.86F + 0.30F * static_cast<float>(hue);
    const float warm = 0.10F * (static_cast<float>(size) - 0.5F);
    const glm::vec3 tint = bright * glm::vec3(1.0F + warm, 1.0F, 1.0F - 1.6F * warm) *
                           tint_of(age, layer.height > 0.013F);
    FloorLeaf leaf;
    leaf.x = piece.x;
    leaf.y = piece.y;
    leaf.cosine = static_cast<float>(along.x / length);
    leaf.sine = static_cast<float>(along.y / length);
    leaf.half = stamp.half;
    leaf.columns = stamp.columns;
    leaf.rows = stamp.rows;
    leaf.colours = lower ? stamp.lower.data() : stamp.upper.data();
    leaf.rises = stamp.rises.data();
    leaf.tint = shade(lower ? tint * lower_face : tint);
    leaf.hidden = layer.height > 0.018F ? 0.55F : 0.93F;
    leaf.height = layer.height;
    leaf.length = static_cast<float>(length);
    leaf.slope_x = static_cast<float>(0.36 * tilt_x - 0.18);
    leaf.slope_y = static_cast<float>(0.36 * tilt_y - 0.18);
    leaf.curl = 0.5F * static_cast<float>(face + tilt_x) - 0.2F;
    const glm::dvec2 at(piece.x * unit_metres, piece.y * unit_metres);
    const double breadth = static_cast<double>(stamp.half) * length;
    const glm::dvec2 box(0.5 * length * std::abs(along.x) + breadth * std::abs(along.y) + rounding,
                         0.5 * length * std::abs(along.y) + breadth * std::abs(along.x) + rounding);
    leaf.range = range_of(canvas, at - box, at + box);
    HWY_DYNAMIC_DISPATCH(paint_leaf)(canvas, leaf);
}

void FloorPainter::paint_stroke(FloorCanvas& canvas, const glm::dvec2& from, const glm::dvec2& to,
                                double width, FloorStroke stroke) const {
    stroke.x = units_of(from.x);
    stroke.y = units_of(from.y);
    const glm::dvec2 way = to - from;
    const double square = way.x * way.x + way.y * way.y;
    if (square <= 0.0) return;
    // Lines narrower than a texel are as much paler.
    const double drawn = std::max(width, 1.1 * texel_);
    stroke.half = static_cast<float>(0.5 * drawn);
    stroke.strength *= static_cast<float>(std::sqrt(width / drawn));
    stroke.per_texel = static_cast<float>(1.0 / texel_);
    stroke.way_x = static_cast<float>(way.x);
    stroke.way_y = static_cast<float>(way.y);
    stroke.along_x = static_cast<float>(way.x / square);
    stroke.along_y = static_cast<float>(way.y / square);
    const double around = 0.5 * (drawn + texel_) + rounding;
    stroke.range = range_of(canvas, glm::min(from, to) - around, glm::max(from, to) + around);
    HWY_DYNAMIC_DISPATCH(paint_stroke)(canvas, stroke);
}

void FloorPainter::finish(const FloorCanvas& canvas, int from, int to) const {
    const auto side = static_cast<std::size_t>(paint_.side);
    std::vector<float> sums(stride_ + floor_padding);
    std::vector<std::uint8_t> channels(9 * (side + channel_padding));
    FloorFinish finish;
    finish.side = paint_.side;
    finish.margin = margin_;
    finish.radius = margin_ - 1;
    finish.per_slope = static_cast<float>(0.5 / texel_);
    // Wet soil reflects about half of what it does when it is dry [Lobell2002].
    finish.bright = 1.22F - 0.5F * wet_;
    finish.smoothness = 0.3F * wet_ * wet_;
    finish.sums = sums.data();
    finish.channels = channels.data();
    for (int row = from; row < to; ++row) {
        const std::size_t start = 3 * static_cast<std::size_t>(row) * side;
        HWY_DYNAMIC_DISPATCH(finish_row)
        (canvas, row - from + margin_, finish,
         {&images_.rgb[0][start], &images_.rgb[1][start], &images_.rgb[2][start]});
    }
}

}  // namespace

RawImages floor_images(const FloorPaint& paint, const Parallel& parallel) {
    if (paint.side < 16 || paint.side > 4096)
        throw InvalidInput("/side", "the side of the images of a floor is 16..4096 texels");
    if (paint.cover == nullptr || paint.cover->columns < 2 || paint.cover->rows < 2)
        throw InvalidInput("/cover", "a floor has no images without its cover");
    if (paint.pieces && paint.cover->step != CoverField::finest_step)
        throw InvalidInput("/cover", "the pieces of a floor need the finest step of its cover");
    const auto side = static_cast<std::size_t>(paint.side);
    RawImages images{paint.side, {}, {}};
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
