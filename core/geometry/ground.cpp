#include "core/geometry/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/grid_solid.h"
#include "core/geometry/litter_piece.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/even_table.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

// No source or measurement is recorded for the values below, unless one is named.

constexpr glm::dvec3 upwards(0.0, 1.0, 0.0);

/// The clod by its rows, from inside the stem over the ground and down to its lowest point. Where the
/// foot is followed: its depth; how far off it, in reaches of the soil; height, in rises of the soil
/// and in reaches; how far its corners stray.
struct ClodRow {
    double depth, off, rise, drop, stray;
};
constexpr std::array<ClodRow, 9> clod_rows = {{{0.0, -0.5, 1.05, 0.0, 0.0},
                                               {0.0, 0.02, 1.0, 0.0, 0.35},
                                               {0.0, 0.45, 0.7, 0.0, 0.45},
                                               {0.0, 0.85, 0.4, 0.0, 0.55},
                                               {0.0, 1.0, 0.0, -0.12, 0.6},
                                               {0.3, 0.8, 0.0, -0.15, 0.5},
                                               {0.6, 0.7, 0.0, -0.1, 0.5},
                                               {0.85, 0.55, 0.0, -0.1, 0.4},
                                               {1.0, 0.0, 0.0, -0.5, 0.0}}};

/// How far single corners of the clod stray, in reaches; above the ground at most by this share of
/// their height, so that the ground shows nowhere through the soil.
constexpr double clod_grain = 0.075, most_stray = 0.6;

/// Place on the clod, 0..1 over its rows, of the stem, of the edge and of the end of what lumps
/// cover; share of the lumps above the edge.
constexpr double at_stem = 1.0 / 8.0, at_edge = 4.0 / 8.0, at_end = 7.7 / 8.0;
constexpr double lumps_above = 0.5;

/// Waves round the clod, and their parts of its unevenness.
constexpr std::array<int, 5> clod_waves = {2, 3, 5, 8, 11};
constexpr std::array<double, 5> clod_parts = {0.34, 0.3, 0.24, 0.2, 0.16};

/// Weight of a species from which its clod has grown out of the foot's lowest point.
constexpr double grown_weight = 0.15;

/// Profile of a lump: height along its normal and radius, in its own radii, from the base, which is
/// sunk, to the tip; how far its corners stray, how flat and how long lumps are.
constexpr std::array<glm::dvec2, 4> lump_profile = {
    {{-0.45, 0.9}, {0.05, 1.05}, {0.4, 0.75}, {0.6, 0.0}}};
constexpr double lump_stray = 0.30, lump_rise = 0.16, least_flatness = 0.6, most_flatness = 1.1,
                 longest_lump = 1.7;

/// Sizes of lumps fall from the first, which all levels build, to this share, by this power of their
/// number.
constexpr double least_lump = 0.25, lump_power = 3.2;

/// Crumbs for each lump; their size, in that of the largest lump; how far beyond the edge of the soil
/// the farthest lie, in its reaches; share of them that lies beyond it; how far their corners stray.
constexpr double crumbs_per_lump = 3.0, least_crumb = 0.08, most_crumb = 0.36, farthest_crumb = 0.5,
                 crumbs_beyond = 0.3, crumb_stray = 0.5;

/// Share of the band of soil, from its one edge to the other, that a lump or a crumb shows, so that
/// its texels are about as long as wide.
constexpr double pebble_across = 0.35;

/// The whole strip of soil, which a clod shows.
constexpr StripPiece whole_soil{soil_band};

/// How high litter lies on the lumps of the soil, in sizes of the largest.
constexpr double on_lumps = 0.4;

/// Half the width of a strand in its lengths, along it; how far it winds.
constexpr std::array<double, 5> strand_widths = {1.0, 0.8, 0.62, 0.45, 0.0};
constexpr double strand_width = 0.022, strand_wind = 0.16;

/// Resolution of whole levels by their columns: the grids of the clod, of a lump and of litter, empty
/// where there is none, or at the finest level those of its kinds, and the shares of the lumps and
/// strands, and of the litter, that are built.
struct Resolution {
    int least_columns;
    SolidGrid clod, lump, litter, strand, crumb;
    double lumps, pieces;
    double crumbs = crumbs_per_lump;  ///< for each lump of the style
    int folds = 1;                    ///< of the clod's image
};
constexpr std::array<Resolution, 4> resolutions = {
    {{72,
      {21, 72, false},
      {4, 5, false},
      {},
      {8, 3, false},
      {3, 5, false},
      1.0,
      1.0,
      crumbs_per_lump,
      3},
     {28, {6, 12, false}, {3, 4, false}, {3, 3, false}, {4, 3, false}, {}, 0.15, 0.5},
     {12, {5, 8, false}, {}, {3, 3, false}, {}, {}, 0.0, 0.15},
     {0, {4, 6, false}, {}, {}, {}, {}, 0.0, 0.0}}};

/// The same for the ground of a colony by ground_rows, round one foot of many and round all of a
/// tuft. Nobody looks below a colony, so strands are the first to be left out.
constexpr std::array<Resolution, ground_rows> rows_apart = {
    {resolutions[0],
     {0, {8, 18, false}, {3, 4, false}, {4, 4, false}, {}, {3, 4, false}, 0.15, 0.7, 0.25},
     {0, {6, 12, false}, {3, 4, false}, {3, 3, false}, {}, {}, 0.06, 0.4},
     {0, {5, 8, false}, {}, {3, 3, false}, {}, {}, 0.0, 0.15},
     {0, {4, 6, false}, {}, {}, {}, {}, 0.0, 0.0},
     {0, {3, 5, false}, {}, {}, {}, {}, 0.0, 0.0}}};
constexpr std::array<Resolution, ground_rows> rows_fused = {
    {{0,
      {15, 60, false},
      {4, 5, false},
      {5, 4, false},
      {8, 3, false},
      {3, 5, false},
      1.0,
      1.0,
      2.0,
      4},
     {0, {9, 36, false}, {3, 4, false}, {4, 4, false}, {}, {3, 4, false}, 0.4, 0.8, 0.5, 4},
     {0, {6, 24, false}, {3, 4, false}, {3, 3, false}, {}, {}, 0.2, 0.5, 0.0, 4},
     {0, {5, 16, false}, {}, {3, 3, false}, {}, {}, 0.0, 0.15, 0.0, 4},
     {0, {4, 14, false}, {}, {}, {}, {}, 0.0, 0.0, 0.0, 2},
     {0, {4, 8, false}, {}, {}, {}, {}, 0.0, 0.0, 0.0, 4}}};

const Resolution& resolution_of(const ColonyGroundDetail& detail) {
    const auto row = static_cast<std::size_t>(detail.row);
    return detail.fused ? rows_fused[row] : rows_apart[row];
}

/// The soil between the stems of a tuft by its rows, from its base to its top: share of the way from
/// the middle to the foot, and height in rises of the soil.
constexpr std::array<glm::dvec2, 5> bed_rows = {
    {{1.02, -0.5}, {0.94, 0.9}, {0.66, 1.3}, {0.3, 1.15}, {0.0, 1.3}}};

/// How far the heights of its corners stray, in themselves.
constexpr double bed_stray = 0.35;

int built(int count, double of_level, double share) {
    return static_cast<int>(std::ceil(share * of_level * count));
}

/// The pieces that a level builds of one style.
struct Built {
    int clods = 0, lumps = 0, pieces = 0, strands = 0, crumbs = 0;
};

Built built_of(const GroundStyle& style, const Resolution& resolution, double share) {
    const bool has_clod = style.soil.lumps > 0 && share > 0.0;
    return {has_clod ? 1 : 0, built(style.soil.lumps, resolution.lumps, share),
            built(style.litter.pieces, resolution.pieces, share),
            resolution.strand.rows > 0 ? built(style.strands.count, resolution.lumps, share) : 0,
            resolution.crumb.rows > 0 ? built(style.soil.lumps, resolution.crumbs, share) : 0};
}

/// Returns the grid of the soil between the stems of a tuft.
SolidGrid bed_of(const Resolution& resolution) {
    return {static_cast<int>(bed_rows.size()), resolution.clod.columns, false};
}

double row_place(int row, const SolidGrid& grid) {
    return static_cast<double>(row) / (grid.rows - 1);
}

/// Returns the row of the clod's grid that is at its edge.
int edge_row(const SolidGrid& grid) { return (grid.rows - 1) / 2; }

/// Returns where a row of the clod's grid is, 0..1 over its rows: one is at the edge, whatever their
/// number, and at least one between the edge and the tip, so that all levels have one outline.
double clod_place(int row, const SolidGrid& grid) {
    const int steps = grid.rows - 1, above = edge_row(grid);
    if (row <= above) return at_edge * row / above;
    return at_edge + (1.0 - at_edge) * (row - above) / (steps - above);
}

/// Returns the horizontal direction away from the axis.
glm::dvec3 level(const glm::dvec3& outwards, double angle) {
    const auto turn = sine_cosine(angle);
    return unit_or({outwards.x, 0.0, outwards.z}, {turn.cosine, 0.0, turn.sine});
}

/// The uneven clod of one species.
class Clod {
  public:
    Clod(const GroundLayer& layer, const Foot& foot, Random random)
        : reach_(layer.style.soil.lumps > 0 ? layer.weight * layer.style.soil.reach : 0.0),
          rise_(layer.weight * layer.style.soil.rise),
          grown_(smooth_step(0.0, grown_weight, layer.weight)),
          foot_(foot),
          lowest_(foot(1.0, 0.0).place) {
        for (auto& row : phases_)
            for (double& phase : row) phase = random.uniform(0.0, 2.0 * pi);
    }

    /// Returns a point of the surface.
    ///
    /// place  0..1 over the rows
    [[nodiscard]] FootPoint at(double place, double angle) const {
        const auto [below, t] = between_entries(place, clod_rows.size());
        const FootPoint from = corner(below, angle), to = corner(below + 1, angle);
        return {(1.0 - t) * from.place + t * to.place,
                unit_or((1.0 - t) * from.outwards + t * to.outwards, from.outwards)};
    }

    /// Returns a point between the middle and the foot.
    ///
    /// out   share of the way to the foot
    /// high  in rises of the soil
    [[nodiscard]] glm::dvec3 between(double out, double high, double angle) const {
        const glm::dvec3 foot = foot_(0.0, angle).place;
        const glm::dvec3 place(lowest_.x + out * (foot.x - lowest_.x), rise_ * high,
                               lowest_.z + out * (foot.z - lowest_.z));
        return lowest_ + grown_ * (place - lowest_);
    }

  private:
    double reach_, rise_, grown_;
    const Foot& foot_;
    glm::dvec3 lowest_;
    /// Of the waves, for what lies above the edge, for the edge, and for what lies below.
    std::array<std::array<double, clod_waves.size()>, 3> phases_{};

    [[nodiscard]] double uneven(std::size_t row, double angle) const {
        const auto& phases = phases_[row < 4 ? 0 : row == 4 ? 1 : 2];
        double sum = 0.0;
        for (std::size_t k = 0; k < clod_waves.size(); ++k)
            sum += clod_parts[k] * sine(clod_waves[k] * angle + phases[k]);
        return sum;
    }

    [[nodiscard]] FootPoint corner(std::size_t number, double angle) const {
        const ClodRow& row = clod_rows[number];
        const FootPoint foot = foot_(row.depth, angle);
        const glm::dvec3 out = level(foot.outwards, angle);
        const double factor = 1.0 + row.stray * uneven(number, angle);
        glm::dvec3 place, normal;
        if (row.depth > 0.0) {
            place = foot.place + reach_ * factor * row.off * foot.outwards;
            normal = foot.outwards;
        } else {
            // Above the edge the soil follows the ground, not the foot.
            place = foot.place + reach_ * row.off * (row.off > 0.5 ? factor : 1.0) * out;
            place.y = rise_ * row.rise * factor;
            normal = unit_or(reach_ * upwards + rise_ * out, upwards);
        }
        place.y += reach_ * row.drop;
        return {lowest_ + grown_ * (place - lowest_), normal};
    }
};

/// Builds the solids of one layer.
class GroundBuilder {
  public:
    /// share  of the pieces of the resolution that is built
    GroundBuilder(Mesh& mesh, const GroundLayer& layer, const Foot& foot,
                  const Resolution& resolution, double share, std::uint32_t seed, bool textured,
                  bool keep_absent)
        : mesh_(mesh),
          style_(layer.style),
          weight_(layer.weight),
          stream_(layer.stream),
          seed_(seed),
          share_(share),
          resolution_(resolution),
          textured_(textured),
          drawn_(layer.weight > 0.0 || keep_absent),
          clod_(layer, foot, random(0, -1)) {}

    /// bed  adds the soil between the stems of a tuft
    void add(bool bed = false) {
        const Built built = built_of(style_, resolution_, share_);
        if (built.clods > 0) add_clod();
        if (built.clods > 0 && bed) add_bed();
        for (int i = 0; i < built.lumps; ++i) add_lump(i);
        for (int i = 0; i < built.pieces; ++i) add_piece(i);
        for (int i = 0; i < built.strands; ++i) add_strand(i);
        for (int i = 0; i < built.crumbs; ++i) add_crumb(i);
    }

  private:
    Mesh& mesh_;
    const GroundStyle& style_;
    double weight_;
    std::uint32_t stream_, seed_;
    double share_;
    const Resolution& resolution_;
    bool textured_, drawn_;
    Clod clod_;

    [[nodiscard]] Random random(std::uint32_t kind, int number) const {
        return {seed_, purposes::ground + kind, stream_ + static_cast<std::uint32_t>(number)};
    }

    /// Appends a solid of this grid.
    ///
    /// paint  which piece of the ground's strip paints it
    /// crest, folds  as those of a GridSolid
    void append_solid(const SolidGrid& grid, const StripPiece& paint,
                      std::vector<glm::dvec3>& corners, const glm::dvec3& normal, int crest = 0,
                      int folds = 1) {
        GridSolid solid{grid, Part::ground, {}, {}};
        solid.crest = crest;
        solid.folds = folds;
        solid.window = paint.window();
        solid.corners = std::move(corners);
        append(mesh_, solid, normal, textured_, drawn_);
    }

    static void close_row(std::vector<glm::dvec3>& corners, const SolidGrid& grid) {
        corners.push_back(corners[corners.size() - static_cast<std::size_t>(grid.columns)]);
    }

    void add_clod() {
        const SolidGrid& grid = resolution_.clod;
        std::vector<glm::dvec3> corners;
        Random random = this->random(0, -2);
        const double grain = clod_grain * weight_ * style_.soil.reach;
        // Angles run counter-clockwise seen from below, where its tip is.
        for (int i = 0; i < grid.rows; ++i) {
            for (int j = 0; j < grid.columns; ++j) {
                const bool is_tip = i + 1 == grid.rows;
                const FootPoint at =
                    clod_.at(clod_place(i, grid), is_tip ? 0.0 : 2.0 * pi * j / grid.columns);
                const double height = at.place.y;
                const double stray = (height > 0.0 ? std::min(grain, most_stray * height) : grain) *
                                     random.symmetric();
                corners.push_back(at.place + (is_tip ? 0.0 : stray) * at.outwards);
            }
            close_row(corners, grid);
        }
        // The strip is too narrow for the whole way down.
        const int crest = (edge_row(grid) + grid.rows - 1) / 2;
        append_solid(grid, whole_soil, corners, upwards, crest, resolution_.folds);
    }

    /// Appends the soil that lies between the stems of a tuft, whose common foot the clod surrounds.
    void add_bed() {
        const SolidGrid grid = bed_of(resolution_);
        std::vector<glm::dvec3> corners;
        Random random = this->random(0, -3);
        for (int i = 0; i < grid.rows; ++i) {
            const glm::dvec2& row = bed_rows[static_cast<std::size_t>(i)];
            const bool is_inside = i > 0 && i + 1 < grid.rows;
            for (int j = 0; j < grid.columns; ++j) {
                // Its tip is above, so it is seen from there.
                const double angle = -2.0 * pi * j / grid.columns;
                const double stray = is_inside ? random.symmetric() : 0.0;
                corners.push_back(clod_.between(row.x, row.y * (1.0 + bed_stray * stray), angle));
            }
            close_row(corners, grid);
        }
        append_solid(grid, whole_soil, corners, upwards, 0, resolution_.folds);
    }

    /// How a pebble lies: a unit direction on the ground, its length across that, in widths, and the
    /// angle of its first corner.
    struct Lie {
        glm::dvec3 along;
        double length, spin;
    };

    /// Appends a lump or a crumb.
    ///
    /// corner  returns height and radius of a corner (row, column, profile of the row), metres; called
    ///         in the order of the grid
    template <class Corner>
    void add_pebble(const SolidGrid& grid, const FootPoint& at, const Lie& lie,
                    const StripPiece& paint, const Corner& corner) {
        const glm::dvec3 across = glm::cross(at.outwards, lie.along);
        std::vector<glm::dvec3> corners;
        for (int i = 0; i < grid.rows; ++i) {
            const glm::dvec2 profile = of_table(lump_profile, row_place(i, grid));
            for (int j = 0; j < grid.columns; ++j) {
                const auto turn = sine_cosine(lie.spin + 2.0 * pi * j / grid.columns);
                const glm::dvec2 size = corner(i, j, profile);
                corners.push_back(at.place + size.x * at.outwards +
                                  size.y * turn.cosine * lie.along +
                                  size.y * turn.sine * lie.length * across);
            }
            close_row(corners, grid);
        }
        append_solid(grid, paint, corners, at.outwards);
    }

    void add_lump(int number) {
        Random random = this->random(0, number);
        const double place = static_cast<double>(number) / std::max(style_.soil.lumps, 1);
        const double angle = spread_angle(number, random);
        const double above = random.uniform(), far = random.uniform(), size = random.uniform();
        const double flat = random.uniform(least_flatness, most_flatness);
        const double length = random.uniform(1.0, longest_lump),
                     spin = random.uniform(0.0, 2.0 * pi);
        const double window = random.uniform();
        const double radius = weight_ * style_.soil.size *
                              (least_lump + (1.0 - least_lump) * power(1.0 - place, lump_power)) *
                              (0.75 + 0.5 * size);
        const FootPoint at =
            clod_.at(above < lumps_above ? at_stem + (at_edge - at_stem) * std::sqrt(far)
                                         : at_edge + (at_end - at_edge) * far,
                     angle);
        const glm::dvec3 along = square_to(at.outwards, {0.0, 1.0, 0.05});
        std::array<std::array<double, 2>, 4 * 5> stray{};
        for (auto& [wide, high] : stray) {
            wide = lump_stray * random.symmetric();
            high = lump_rise * random.symmetric();
        }
        const SolidGrid& grid = resolution_.lump;
        const auto corner = [&](int i, int j, const glm::dvec2& profile) {
            const auto ring = static_cast<std::size_t>(3 * i / (grid.rows - 1));
            const auto& [wide, high] =
                stray[5 * ring + static_cast<std::size_t>(5 * j / grid.columns)];
            const bool is_tip = i + 1 == grid.rows;
            return glm::dvec2(flat * radius * (profile.x + (is_tip ? 0.0 : high)),
                              radius * profile.y * (1.0 + wide));
        };
        add_pebble(grid, at, {along, length, spin}, {soil_band, window, 0.3, pebble_across},
                   corner);
    }

    /// Appends a grain of soil on the clod or on the ground beside it, so that the soil does not end
    /// in a line.
    void add_crumb(int number) {
        Random random(seed_, purposes::ground_crumbs, stream_ + static_cast<std::uint32_t>(number));
        const double angle = spread_angle(number, random);
        const double lot = random.uniform(), far = random.uniform(), size = random.uniform();
        const double spin = random.uniform(0.0, 2.0 * pi), window = random.uniform();
        const double radius =
            weight_ * style_.soil.size * (least_crumb + (most_crumb - least_crumb) * size * size);
        FootPoint at = clod_.at(
            at_stem + (at_edge - at_stem) * (lot < crumbs_beyond ? 1.0 : std::sqrt(far)), angle);
        if (lot < crumbs_beyond) {
            // Most lie near the edge.
            at.place += weight_ * style_.soil.reach * farthest_crumb * far * far * far *
                        level(at.outwards, angle);
            at.place.y *= 1.0 - smooth_step(0.0, grown_weight, weight_);
            at.outwards = upwards;
        }
        const auto corner = [&](int, int, const glm::dvec2& profile) {
            return glm::dvec2(radius * profile.x,
                              radius * profile.y * (1.0 + crumb_stray * random.symmetric()));
        };
        add_pebble(resolution_.crumb, at, {square_to(at.outwards, {1.0, 0.05, 0.1}), 1.0, spin},
                   {soil_band, window, 0.1, pebble_across}, corner);
    }

    /// random  strays its rim
    void add_rod(const Rod& rod, const SolidGrid& grid, const StripPiece& paint, Random& random) {
        std::vector<glm::dvec3> corners = corners_of(rod, grid, random);
        append_solid(grid, paint, corners, rod.up());
    }

    void add_piece(int number) {
        Random random = this->random(1, number);
        const LitterForm form = form_of(style_.litter.kind);
        const double place = static_cast<double>(number) / std::max(style_.litter.pieces, 1);
        const double angle = spread_angle(number, random);
        const double lot = random.uniform(), far = random.uniform(), turned = random.uniform();
        const double stand = radians(random.uniform(form.least_stand, form.most_stand));
        const double roll = 0.5 * random.symmetric(), bent = random.uniform(0.3, 1.0);
        const double window = random.uniform(), size = random.uniform(0.7, 1.0);
        const double curled = random.symmetric();
        Rod rod;
        rod.length = weight_ * style_.litter.length * size * (1.0 - 0.5 * place);
        rod.take_form(form, curled);
        const double lying = 1.0 - smooth_step(0.0, 0.7, stand);
        // What lies reaches over the edge of the soil, what grows stands on it.
        const double gap = lying > 0.5 ? far * far : 0.1 + 0.9 * far;
        const FootPoint at = clod_.at(at_stem + (at_edge - at_stem) * gap, angle);
        const glm::dvec3 stem = clod_.at(at_stem, angle).place;
        const glm::dvec3 out = level(at.outwards, angle);
        const glm::dvec3 tangent = glm::cross(out, upwards);
        rod.from = at.place;
        if (lot < form.leaning) {
            // It leans on the stem with its tip.
            const auto steep = sine_cosine(0.5 + 0.6 * turned);
            rod.from = stem + out * (rod.length * steep.cosine + rod.thickness);
            rod.from.y = at.place.y;
            rod.along = steep.sine * upwards - steep.cosine * out;
            rod.bend = 0.3 * form.bend * bent * out;
        } else {
            const auto heading = sine_cosine(2.0 * pi * turned), steep = sine_cosine(stand);
            // What stands leans away from the stem, what lies keeps clear of it.
            const glm::dvec3 flat = unit_or(
                heading.cosine * out + heading.sine * tangent + 1.2 * (1.0 - lying) * out, out);
            const double slope = lying * style_.soil.rise / style_.soil.reach * glm::dot(flat, out);
            rod.along = unit_or((steep.sine - slope) * upwards + steep.cosine * flat, upwards);
            // Its middle is no farther out than the soil unless the stem leaves no room.
            const double clear = 0.5 * rod.length * std::abs(glm::dot(flat, out)) + rod.width,
                         place_out = glm::dot(at.place - stem, out);
            const double lift =
                lying * (2.0 * rod.thickness + on_lumps * weight_ * style_.soil.size);
            rod.from +=
                lying * (out * std::max(clear - place_out, 0.0) - 0.5 * rod.length * rod.along) +
                upwards * (lift - form.sunk * rod.length);
            rod.bend = form.bend * bent *
                       (lying * upwards * roll + (1.0 - lying) * (flat - 0.3 * rod.along));
        }
        rod.side = turned_square(unit_or(glm::cross(upwards, rod.along), tangent), rod.along,
                                 roll + (1.0 - lying) * turned * pi);
        add_rod(rod, grid_of(form, resolution_.litter), litter_paint(window), random);
    }

    void add_strand(int number) {
        Random random = this->random(2, number);
        const double angle = spread_angle(number, random);
        const double deep = random.uniform(), drop = random.uniform(-0.1, 0.7);
        const double wind_angle = random.uniform(0.0, 2.0 * pi), window = random.uniform();
        const FootPoint at = clod_.at(at_edge + (at_end - at_edge) * (0.2 + 0.8 * deep), angle);
        Rod rod;
        rod.length = weight_ * style_.strands.length * random.uniform(0.35, 1.0);
        rod.along = unit_or(at.outwards - drop * upwards, -upwards);
        rod.from = at.place - 0.1 * rod.length * rod.along;
        rod.side = square_to(rod.along, {1.0, 0.1, 0.3});
        rod.wind = strand_wind * turned_square(rod.side, rod.along, wind_angle);
        rod.bend = -0.3 * upwards + 0.8 * rod.wind;
        rod.width = rod.thickness = strand_width * rod.length;
        rod.widths = strand_widths;
        add_rod(rod, resolution_.strand, {strand_band, window, 0.25}, random);
    }
};

/// Samples of a stem below the ground.
constexpr int foot_samples = 64;

/// Returns the share of the stem at which it leaves the ground; 0 if no point is below.
double share_at_ground(const SubCurve& stem) {
    OutlineSample last = stem.at(0.0);
    if (last.y >= 0.0) return 0.0;
    for (int i = 1; i <= foot_samples; ++i) {
        const OutlineSample here = stem.at(static_cast<double>(i) / foot_samples);
        if (here.y >= 0.0)
            return last.share + (here.share - last.share) * last.y / (last.y - here.y);
        last = here;
    }
    return 1.0;
}

/// Returns how far a sac stands off the stem at the ground.
double clearance_of(const SacStyle& sac, const SubCurve& stem, double share) {
    if (sac.height <= 0.0) return 0.0;
    const double at_ground = stem.at(share).r;
    double widest = at_ground;
    for (int i = 0; i <= foot_samples; ++i) {
        const OutlineSample here = stem.at(static_cast<double>(i) / foot_samples);
        if (here.y <= sac.height) widest = std::max(widest, here.r);
    }
    return sac.hold * (widest - at_ground) +
           2.0 * sac.thickness * smooth_step(0.0, 1.0, sac.height / (10.0 * sac.thickness));
}

/// Returns the exact counts of what is appended for all layers.
MeshCount count_of(const std::vector<GroundLayer>& layers, const Resolution& resolution,
                   double share, bool bed, bool keep_absent) {
    MeshCount sum;
    for (const GroundLayer& layer : layers) {
        const Built built = built_of(layer.style, resolution, share);
        MeshCount one = resolution.clod.count().times(built.clods);
        if (bed) one += bed_of(resolution).count().times(built.clods);
        one += resolution.lump.count().times(built.lumps);
        one += grid_of(form_of(layer.style.litter.kind), resolution.litter)
                   .count()
                   .times(built.pieces);
        one += resolution.strand.count().times(built.strands);
        one += resolution.crumb.count().times(built.crumbs);
        if (layer.weight <= 0.0 && !keep_absent) one.triangles = 0;
        sum += one;
    }
    return sum;
}

}  // namespace

MeshCount ground_count(const std::vector<GroundLayer>& layers, const Detail& detail,
                       bool keep_absent) {
    return count_of(layers, by_columns(resolutions, detail), detail.ground, false, keep_absent);
}

MeshCount ground_count(const std::vector<GroundLayer>& layers, const ColonyGroundDetail& detail) {
    return count_of(layers, resolution_of(detail), detail.share, detail.fused, false);
}

void add_ground(Mesh& mesh, const std::vector<GroundLayer>& layers, const Foot& foot,
                const Detail& detail, std::uint32_t seed, bool textured, bool keep_absent) {
    for (const GroundLayer& layer : layers)
        GroundBuilder(mesh, layer, foot, by_columns(resolutions, detail), detail.ground, seed,
                      textured, keep_absent)
            .add();
}

void add_ground(Mesh& mesh, const std::vector<GroundLayer>& layers, const Foot& foot,
                const ColonyGroundDetail& detail, std::uint32_t seed, bool textured) {
    for (const GroundLayer& layer : layers)
        GroundBuilder(mesh, layer, foot, resolution_of(detail), detail.share, seed, textured, false)
            .add(detail.fused);
}

void add_ground(Mesh& mesh, const Individual& individual, const OrnamentContext& context) {
    if (individual.grounds.empty()) return;
    const SubCurve& stem = context.outline.stem;
    const double share = share_at_ground(stem);
    const double clear = clearance_of(individual.sac, stem, share);
    const Foot foot = [&](double depth, double angle) {
        const OutlineSample sample = stem.at(share * (1.0 - depth));
        SurfacePoint point =
            context.rest_surface.at(Part::stem, sample, context.rest_surface.column(angle));
        context.deformer.apply({&point, 1}, context.deformer.station(Part::stem, sample));
        const glm::dvec3 normal =
            unit_or(glm::cross(point.meridian, point.azimuth), glm::dvec3(0.0, -1.0, 0.0));
        return FootPoint{point.position + clear * normal, normal};
    };
    add_ground(mesh, individual.grounds, foot, context.detail, individual.shape_seed,
               context.textured, context.keep_absent);
}

}  // namespace sporeprint
