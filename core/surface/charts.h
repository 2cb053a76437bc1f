// Layout of the image atlas: the rectangle and the texture map of each part of a mushroom.
#pragma once

#include <array>
#include <cstddef>

namespace sporeprint {

/// Texture maps [Desbenoit2004]. disc: planar map with the pole in the middle. strip: cylinder map,
/// u along the part, v once round.
enum class ChartMap { disc, strip };

/// Rectangle in texture coordinates (0..1, v down as in glTF). `inset` is the share of each side
/// that is padding for mipmaps.
struct Chart {
    ChartMap map = ChartMap::disc;
    double u = 0.0, v = 0.0, width = 1.0, height = 1.0;
    double inset = 0.03;
};

enum class Part { cap, hymenium, stem, veil, blade, flesh, ground };
inline constexpr std::size_t part_count = 7;
inline constexpr std::array<Part, part_count> all_parts = {
    Part::cap, Part::hymenium, Part::stem, Part::veil, Part::blade, Part::flesh, Part::ground};

/// Returns the position of a part in tables of all parts.
[[nodiscard]] constexpr std::size_t index_of(Part part) { return static_cast<std::size_t>(part); }

/// Returns true when the chart of a part is a disc; the others are strips.
[[nodiscard]] constexpr bool is_disc(Part part) {
    return part == Part::cap || part == Part::hymenium;
}

/// Returns true when damage is painted on a part.
[[nodiscard]] constexpr bool has_damage(Part part) { return is_disc(part) || part == Part::stem; }

/// Layout for mushrooms of swept outlines. Widths are powers of two, as vectors of texels are.
///
/// cap       disc: pole = apex, rim = margin, radius = share of the meridian arc
/// hymenium  disc: radius = inner + (1 - inner) * arc share with inner = hymenium_inner_share; rim
///           = margin
/// stem      strip: u = share of the arc from the base, v = theta / 2 pi
/// veil      strip: u = theta / 2 pi, v = 0 at the attachment, 1 at the edge or tip
/// blade     strip, the face of a gill, ridge or spine: u runs from the stem to the margin, for each
///           gill in its own window; v = 0 at the base, 1 at the edge
/// flesh     strip, flesh exposed by a tear: u along the tear; v = 0 under the cuticle, 1 at its
///           deepest
/// ground    strip of three bands across, see `ground_bands`: u round a solid, v from its base to
///           its tip
inline constexpr std::array<Chart, part_count> swept_charts = {{
    {ChartMap::disc, 0.0, 0.0, 0.5, 0.5, 0.03},
    {ChartMap::disc, 0.5, 0.0, 0.5, 0.5, 0.03},
    {ChartMap::strip, 0.0, 0.5, 1.0, 0.375, 0.03},
    {ChartMap::strip, 0.0, 0.875, 0.5, 0.125, 0.12},
    {ChartMap::strip, 0.75, 0.875, 0.125, 0.125, 0.12},
    {ChartMap::strip, 0.875, 0.875, 0.125, 0.125, 0.12},
    {ChartMap::strip, 0.5, 0.875, 0.25, 0.125, 0.12},
}};

static_assert([] {
    for (const Part part : all_parts)
        if (is_disc(part) != (swept_charts[index_of(part)].map == ChartMap::disc)) return false;
    return true;
}());

/// Returns the part whose rectangle of the image atlas contains a texture coordinate; the first of
/// two that share a border.
[[nodiscard]] constexpr Part part_at(double u, double v) {
    for (const Part part : all_parts) {
        const Chart& chart = swept_charts[index_of(part)];
        if (u >= chart.u && u <= chart.u + chart.width && v >= chart.v &&
            v <= chart.v + chart.height)
            return part;
    }
    return Part::cap;
}

/// The bands of the ground's strip, across it: soil, litter, and strands of mycelium.
struct GroundBand {
    double from, to;
};
inline constexpr std::array<GroundBand, 3> ground_bands = {
    {{0.01, 0.47}, {0.53, 0.78}, {0.84, 0.99}}};

/// Radius of the stem's edge in the hymenium's disc.
inline constexpr double hymenium_inner_share = 0.15;

/// A texture coordinate.
struct TexturePoint {
    double u, v;
};
/// Returns the texture coordinate on a disc chart; `radius` is 0 at the pole and 1 at the rim.
[[nodiscard]] constexpr TexturePoint disc_point(const Chart& chart, double radius, double cosine,
                                                double sine) {
    const double reach = 0.5 - chart.inset;
    return {chart.u + chart.width * (0.5 + reach * radius * cosine),
            chart.v + chart.height * (0.5 + reach * radius * sine)};
}
/// Returns the texture coordinate on a strip chart; `along` and `across` are 0..1.
[[nodiscard]] constexpr TexturePoint strip_point(const Chart& chart, double along, double across) {
    return {chart.u + chart.width * (chart.inset + (1.0 - 2.0 * chart.inset) * along),
            chart.v + chart.height * (chart.inset + (1.0 - 2.0 * chart.inset) * across)};
}

}  // namespace sporeprint
