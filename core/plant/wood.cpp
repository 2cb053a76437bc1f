#include "core/plant/wood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/tangents.h"
#include "core/params/messages.h"
#include "core/plant/bark_image.h"
#include "core/plant/bark_relief.h"
#include "core/plant/wood_image.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Of a level of detail: columns of the bark of a whole piece, and of a split one, and rows of both
/// along one image of bark.
struct WoodDetail {
    std::uint32_t sides, split_columns, rows, split_rows;
};
constexpr std::array<WoodDetail, 4> details = {
    {{88, 84, 36, 56}, {28, 18, 8, 10}, {16, 8, 3, 4}, {12, 6, 2, 2}}};

/// Rings of an end by level of detail, as shares of the way from the rim to its middle or to the
/// split face: close together on both sides of the inner side of the bark.
constexpr std::array<double, 11> fine_rings = {0.0,  0.035, 0.055, 0.12, 0.2, 0.3,
                                               0.42, 0.55,  0.7,   0.85, 1.0};
constexpr std::array<double, 4> rings_of_1 = {0.0, 0.055, 0.35, 1.0};
constexpr std::array<double, 3> coarse_rings = {0.0, 0.55, 1.0};
constexpr std::array<double, 2> no_rings = {0.0, 1.0};

/// Columns of a split face.
constexpr std::uint32_t face_columns = 7;

/// The most rows of a piece; one that is longer has longer rows.
constexpr std::uint32_t most_rows = 120;

/// The share of what varies about the bark that is waves round the piece, and knots.
constexpr double of_waves = 0.4, of_knots = 0.22;

/// Where bark ends and wood begins on an end, in radii.
constexpr double inner_bark = 0.955;

/// The height over which bark follows the unevenness of an end, in units of that.
constexpr double follows_end = 0.7;

/// How much less uneven bark is where something grows out, and within how many radii it becomes so.
constexpr double contact_evenness = 0.8, contact_fade = 0.3;

/// How far the edges of a split face wander, radians.
constexpr double edge_wander = 0.1;

double noise_of(double x, double y, std::uint32_t seed) {
    const std::array<float, 1> u{static_cast<float>(x)}, v{static_cast<float>(y)};
    std::array<float, 1> out{};
    gradient_noise(u, v, seed, out);
    return static_cast<double>(out[0]);
}

/// The distance of the bark from the axis, and its derivatives.
struct Distance {
    double length = 0.0, by_angle = 0.0, by_height = 0.0;
};

/// The radius of bark without its relief, which varies round the piece and, slowly, along it.
class Bumps {
  public:
    explicit Bumps(const WoodPiece& piece) : radius_(piece.radius) {
        Random random(piece.seed, purposes::wood);
        for (Wave& wave : waves_) {
            wave.phase = random.uniform(0.0, 2.0 * pi);
            wave.twist = 2.0 * random.symmetric() / radius_;
        }
        for (Knot& knot : knots_) {
            // Beside what grows in front.
            knot.angle = random.uniform(0.7, 1.5) * (random.symmetric() < 0.0 ? -1.0 : 1.0);
            knot.height = random.uniform(piece.bottom, piece.top);
            knot.width = random.uniform(0.2, 0.34);
        }
    }

    [[nodiscard]] Distance at(double angle, double height) const {
        const double depth = (uneven_radius - 1.0) * radius_;
        Distance out{radius_ + 0.5 * of_waves * depth};
        for (const Wave& wave : waves_) {
            const SineCosine at =
                sine_cosine(wave.lobes * angle + wave.phase + wave.twist * height);
            const double size = 0.5 * of_waves * depth * wave.share;
            out.length += size * at.cosine;
            out.by_angle -= wave.lobes * size * at.sine;
            out.by_height -= wave.twist * size * at.sine;
        }
        for (const Knot& knot : knots_) {
            const double along = (height - knot.height) / (radius_ * knot.width);
            const double round = (angle - knot.angle) / knot.width;
            const double rest = 1.0 - along * along - round * round;
            if (rest <= 0.0) continue;
            const double size = 0.5 * of_knots * depth;
            out.length += size * rest * rest;
            out.by_angle -= 4.0 * size * rest * round / knot.width;
            out.by_height -= 4.0 * size * rest * along / (radius_ * knot.width);
        }
        return out;
    }

  private:
    struct Wave {
        double lobes, share, phase = 0.0, twist = 0.0;
    };
    struct Knot {
        double angle = 0.0, height = 0.0, width = 1.0;  ///< width in radians
    };
    double radius_;
    std::array<Wave, 4> waves_ = {{{2.0, 0.4}, {3.0, 0.3}, {5.0, 0.2}, {8.0, 0.1}}};
    std::array<Knot, 2> knots_;
};

/// How far below its highest point a broken end lies: it slants, has splinters along the growth
/// rings, and bark that has come off in pieces.
class BrokenEnd {
  public:
    /// is_fine  with what only a fine mesh can show
    BrokenEnd(const WoodPiece& piece, bool is_up, bool is_fine)
        : unit_(std::min(piece.radius, piece.top - piece.bottom)), is_fine_(is_fine) {
        Random random(piece.seed, purposes::wood, is_up ? 1 : 2);
        slant_ = random.uniform(0.0, 2.0 * pi);
        seed_ = random.bits();
    }

    /// share  distance from the pith, in radii
    [[nodiscard]] double at(double angle, double share) const {
        const SineCosine to = sine_cosine(angle);
        const double x = share * to.sine, z = share * to.cosine;
        const double slant = 0.5 + 0.5 * (x * sine(slant_) + z * cosine(slant_));
        double depth = 0.07 * slant + 0.05 * (0.5 + noise_of(1.3 * x, 1.3 * z, seed_));
        if (is_fine_) {
            // Wood breaks along its growth rings, in steps.
            const double level = 2.5 * noise_of(2.3 * x, 2.3 * z, seed_ + 1U) +
                                 0.8 * noise_of(9.0 * x, 9.0 * z, seed_ + 2U) + 3.0 * share;
            const double step = std::floor(level);
            depth += 0.024 * (step + smooth_step(0.3, 0.7, level - step) - 1.0) +
                     0.02 * noise_of(21.0 * x, 21.0 * z, seed_ + 3U);
        }
        const double off = noise_of(2.4 * to.sine, 2.4 * to.cosine, seed_ + 4U) +
                           0.3 * noise_of(6.5 * to.sine, 6.5 * to.cosine, seed_ + 5U);
        depth += 0.075 * smooth_step(-0.25, 0.3, off) *
                 smooth_step(inner_bark - 0.012, inner_bark + 0.004, share);
        return unit_ * std::clamp(depth, 0.0, deepest_end);
    }

    /// Returns the share of that by which bark follows at a distance below the end.
    [[nodiscard]] double follows(double distance) const {
        return std::max(1.0 - distance / (follows_end * unit_), 0.0);
    }

  private:
    double unit_;
    bool is_fine_;
    double slant_ = 0.0;
    std::uint32_t seed_ = 0;
};

/// What whole and split pieces have in common: rows of vertices along the grain.
class WoodBuilder {
  public:
    WoodBuilder(const WoodPiece& piece, int lod, bool textured)
        : shape(piece),
          level(lod),
          detail(details[static_cast<std::size_t>(lod)]),
          bumps(piece),
          upper(piece, true, lod == 0),
          lower(piece, false, lod == 0),
          image_width(pi * piece.radius),
          image_length(wood_girths * 2.0 * image_width),
          row_length(image_length / rows_of_image()),
          has_texture(textured) {
        // An image ends at a row, whatever their length.
        for (std::uint32_t of_image = rows_of_image(); of_image > 1 && rows() > most_rows;)
            row_length = image_length / --of_image;
        while (rows() > most_rows) row_length *= 2.0;
        Random random(piece.seed, purposes::wood, 3);
        const std::uint32_t bits = random.bits();
        mirrors_across = (bits & 1U) != 0;
        first_image = (bits & 2U) != 0 ? 1.0 : 0.0;
    }

  protected:
    [[nodiscard]] std::uint32_t rows_of_image() const {
        return shape.split > 0.0 ? detail.split_rows : detail.rows;
    }

    /// Number of rows of quads along the piece.
    [[nodiscard]] std::uint32_t rows() const {
        return std::max(1U, static_cast<std::uint32_t>(
                                std::ceil((shape.top - shape.bottom) / row_length - 1e-6)));
    }

    /// Distance of a row of vertices from the top, metres.
    [[nodiscard]] double down(std::uint32_t row) const {
        return row == rows() ? shape.top - shape.bottom : static_cast<double>(row) * row_length;
    }

    /// Height of a vertex of a row.
    ///
    /// above, below  how far the ends are cut there
    [[nodiscard]] double height_of(std::uint32_t row, double above, double below) const {
        const double from_top = down(row), from_bottom = shape.top - shape.bottom - from_top;
        return shape.top - from_top - above * upper.follows(from_top) +
               below * lower.follows(from_bottom);
    }

    /// Returns the place along the image of bark, 0..1 from one of its ends to the other.
    [[nodiscard]] double along_image(double height) const {
        return mirrored_place(first_image + (shape.top - height) / image_length);
    }

    [[nodiscard]] Mesh finished() {
        if (has_texture) add_tangents(mesh);
        return std::move(mesh);
    }

    void add_vertex(const glm::dvec3& position, const glm::dvec3& normal, double u, double v) {
        mesh.positions.emplace_back(position);
        mesh.normals.emplace_back(normal);
        if (has_texture) mesh.texture_coordinates.emplace_back(u, v);
    }

    [[nodiscard]] glm::dvec3 place(double distance, const SineCosine& at, double height) const {
        return {distance * at.sine, height, distance * at.cosine - shape.radius};
    }

    /// A vertex of the bark.
    struct BarkPoint {
        double angle, height;
        double u;         ///< of the image of bark, unless that is mirrored
        double distance;  ///< from the axis
    };

    /// Returns a vertex without its relief.
    [[nodiscard]] BarkPoint bark_point(double angle, double height, double u) const {
        return {angle, height, mirrors_across ? 1.0 - u : u, bumps.at(angle, height).length};
    }

    /// Returns the share of its unevenness that bark has at a place.
    [[nodiscard]] double unevenness_at(double angle, double height) const {
        if (shape.contact_half <= 0.0) return 1.0;
        const double fade = contact_fade * shape.radius;
        const double aside = std::abs(angle) * shape.radius - shape.contact_half;
        const double over = std::max(height - shape.contact_top, shape.contact_bottom - height);
        return 1.0 - contact_evenness * (1.0 - smooth_step(0.0, fade, aside)) *
                         (1.0 - smooth_step(0.0, fade, over));
    }

    /// Lets the relief of the bark stand out of it. Coarse meshes have its mean.
    void add_relief(std::vector<BarkPoint>& points) const {
        const double height = image_width * bark_depth(shape.kind);
        std::vector<float> across(points.size()), along(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            across[i] = static_cast<float>(points[i].u);
            along[i] = static_cast<float>(wood_bark_end * along_image(points[i].height));
        }
        if (level > 1) {
            for (BarkPoint& point : points) point.distance += 0.6 * height;
            return even_contact(points);
        }
        const double share = level == 0 ? 1.0 : 0.5;
        const std::vector<float> rise = bark_rise(shape.kind, BarkNoise(shape.kind, across, along));
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i].distance += height * (0.6 + share * (static_cast<double>(rise[i]) - 0.6));
        even_contact(points);
    }

    void even_contact(std::vector<BarkPoint>& points) const {
        for (BarkPoint& point : points)
            point.distance = shape.radius + unevenness_at(point.angle, point.height) *
                                                (point.distance - shape.radius);
    }

    [[nodiscard]] glm::dvec3 place(const BarkPoint& point) const {
        return place(point.distance, sine_cosine(point.angle), point.height);
    }

    /// Adds a vertex with the normal of the bark without relief: images have the normals of that.
    void add_bark_vertex(const BarkPoint& point) {
        const SineCosine at = sine_cosine(point.angle);
        const Distance from = bumps.at(point.angle, point.height);
        const glm::dvec3 outwards(at.sine, 0.0, at.cosine), aside(at.cosine, 0.0, -at.sine);
        const glm::dvec3 normal =
            outwards - from.by_angle / from.length * aside - glm::dvec3(0.0, from.by_height, 0.0);
        add_vertex(place(point), glm::normalize(normal), point.u,
                   wood_bark_end * along_image(point.height));
    }

    /// Returns the place across growth rings in the image.
    ///
    /// share  distance from the pith, in radii
    [[nodiscard]] static double rings_at(double share) {
        return wood_end_middle + share * (wood_end_rim - wood_end_middle);
    }

    /// Returns the rings of an end.
    ///
    /// at_least  those of coarse levels of detail
    [[nodiscard]] std::span<const double> rings(std::span<const double> at_least) const {
        return level == 0   ? std::span<const double>(fine_rings)
               : level == 1 ? std::span<const double>(rings_of_1)
                            : at_least;
    }

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }

    /// is_up  of a face that is seen from above: a, b, c are counter-clockwise from there
    void add_end_triangle(bool is_up, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (is_up)
            add_triangle(a, b, c);
        else
            add_triangle(a, c, b);
    }

    /// Adds the quads between consecutive rows of `columns` + 1 vertices.
    ///
    /// first     vertex of the first row
    /// stride    vertices from a row to the next
    /// from, to  the rows of vertices
    void add_quads(std::uint32_t first, std::uint32_t columns, std::uint32_t stride,
                   std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t row = from; row < to; ++row)
            for (std::uint32_t column = 0; column < columns; ++column) {
                const std::uint32_t above = first + row * stride + column, below = above + stride;
                add_triangle(above, below, below + 1);
                add_triangle(above, below + 1, above + 1);
            }
    }

    /// Gives the vertices of an end the mean normals of the triangles about them; where an end is
    /// too narrow to have one, it looks up or down.
    ///
    /// vertex, index  the first of the end
    void resolve_end_normals(bool is_up, std::uint32_t vertex, std::size_t index) {
        std::vector<glm::dvec3> sums(mesh.positions.size() - vertex, glm::dvec3(0.0));
        for (std::size_t i = index; i < mesh.indices.size(); i += 3) {
            const glm::dvec3 a(mesh.positions[mesh.indices[i]]),
                b(mesh.positions[mesh.indices[i + 1]]), c(mesh.positions[mesh.indices[i + 2]]);
            const glm::dvec3 across = glm::cross(b - a, c - a);
            for (std::size_t k = 0; k < 3; ++k) sums[mesh.indices[i + k] - vertex] += across;
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            mesh.normals[vertex + i] = glm::vec3(unit_or(sums[i], {0.0, is_up ? 1.0 : -1.0, 0.0}));
    }

    [[nodiscard]] std::uint32_t next_vertex() const {
        return static_cast<std::uint32_t>(mesh.positions.size());
    }

    const WoodPiece& shape;
    int level;
    WoodDetail detail;
    Bumps bumps;
    BrokenEnd upper, lower;
    double image_width, image_length, row_length;  ///< of an image and of a row, metres
    bool has_texture;
    bool mirrors_across = false;  ///< the image of bark
    double first_image = 0.0;     ///< 1: the image begins at its other end
    Mesh mesh;
};

/// Makes the mesh of a whole piece.
class WholePiece : WoodBuilder {
  public:
    WholePiece(const WoodPiece& piece, int lod, bool textured)
        : WoodBuilder(piece, lod, textured), sides_(detail.sides), rings_(rings(coarse_rings)) {
        for (std::uint32_t column = 0; column < sides_; ++column) {
            above_.push_back(upper.at(angle_of(column), 1.0));
            below_.push_back(lower.at(angle_of(column), 1.0));
        }
    }

    [[nodiscard]] MeshCount count() const {
        // Two strips of bark; an end has as many vertices in the middle as sides.
        const std::uint64_t round = sides_, between = rings_.size() - 1;
        return {(round + 2) * (rows() + 1) + 2 * (between * (round + 1) + round),
                2 * round * rows() + 2 * (2 * (between - 1) * round + round)};
    }

    Mesh take() && {
        add_bark();
        for (const bool is_up : {true, false}) add_end(is_up);
        return finished();
    }

  private:
    [[nodiscard]] double angle_of(std::uint32_t column) const {
        return 2.0 * pi * (static_cast<double>(column % sides_) / sides_ - 0.5);
    }

    [[nodiscard]] double height_at(std::uint32_t row, std::uint32_t column) const {
        return height_of(row, above_[column % sides_], below_[column % sides_]);
    }

    /// Returns the vertices of the rows from one to before another, each row as two strips.
    [[nodiscard]] std::vector<BarkPoint> bark_rows(std::uint32_t from, std::uint32_t to) const {
        const std::uint32_t half = sides_ / 2;
        std::vector<BarkPoint> points;
        for (std::uint32_t row = from; row < to; ++row)
            for (const bool is_front : {true, false})
                for (std::uint32_t i = 0; i <= half; ++i) {
                    // The image is in front; behind it is mirrored, so that it is continuous on both
                    // sides.
                    const double along = static_cast<double>(i) / half;
                    const std::uint32_t column = sides_ / 4 + (is_front ? 0 : half) + i;
                    points.push_back(bark_point(angle_of(column), height_at(row, column),
                                                is_front ? along : 1.0 - along));
                }
        add_relief(points);
        return points;
    }

    void add_bark() {
        const std::uint32_t half = sides_ / 2;
        for (const BarkPoint& point : bark_rows(0, rows() + 1)) add_bark_vertex(point);
        for (const std::uint32_t strip : {0U, half + 1})
            add_quads(strip, half, sides_ + 2, 0, rows());
    }

    void add_end(bool is_up) {
        const std::uint32_t first = next_vertex(), round = sides_ + 1, half = sides_ / 2;
        const std::size_t index = mesh.indices.size();
        const BrokenEnd& end = is_up ? upper : lower;
        const std::uint32_t row = is_up ? 0 : rows();
        const std::vector<BarkPoint> bark = bark_rows(row, row + 1);
        const glm::dvec3 normal(0.0, is_up ? 1.0 : -1.0, 0.0);
        for (const double share : rings_.first(rings_.size() - 1))
            for (std::uint32_t column = 0; column < round; ++column) {
                // Of the two strips of the bark, that with this column.
                const std::uint32_t i = (column % sides_ + sides_ - sides_ / 4) % sides_;
                const BarkPoint& rim = bark[i <= half ? i : i + 1];
                glm::dvec3 at = place(rim);
                if (share > 0.0) {
                    const double cut = end.at(rim.angle, 1.0 - share);
                    at = place((1.0 - share) * rim.distance, sine_cosine(rim.angle),
                               is_up ? shape.top - cut : shape.bottom + cut);
                }
                add_vertex(at, normal, static_cast<double>(column) / sides_, rings_at(1.0 - share));
            }
        const double middle_cut = end.at(0.0, 0.0);
        const double height = is_up ? shape.top - middle_cut : shape.bottom + middle_cut;
        for (std::uint32_t column = 0; column < sides_; ++column)
            add_vertex({0.0, height, -shape.radius}, normal, (column + 0.5) / sides_,
                       rings_at(0.0));
        const auto inner_rings = static_cast<std::uint32_t>(rings_.size() - 1);
        for (std::uint32_t ring = 0; ring < inner_rings; ++ring)
            for (std::uint32_t column = 0; column < sides_; ++column) {
                const std::uint32_t outer = first + ring * round + column, inner = outer + round;
                if (ring + 1 == inner_rings) {
                    add_end_triangle(is_up, outer, outer + 1, inner);
                    continue;
                }
                add_end_triangle(is_up, outer, outer + 1, inner + 1);
                add_end_triangle(is_up, outer, inner + 1, inner);
            }
        resolve_end_normals(is_up, first, index);
    }

    std::uint32_t sides_;
    std::span<const double> rings_;
    std::vector<double> above_, below_;  ///< how far the ends are cut at the rim, by column
};

double angle_of_cosine(double cosine) {
    return arc_tangent(std::sqrt(1.0 - cosine * cosine), cosine);
}

/// Makes the mesh of a split piece. The split face lies between the two edges of the bark; its
/// columns are on the same rays from the pith as those of the bark.
class SplitPiece : WoodBuilder {
  public:
    SplitPiece(const WoodPiece& piece, int lod, bool textured)
        : WoodBuilder(piece, lod, textured),
          columns_(detail.split_columns),
          face_(std::min(columns_, face_columns)),
          rings_(rings(no_rings)),
          edge_(angle_of_cosine(1.0 - piece.split / piece.radius)),
          wander_(std::min(edge_wander, 0.5 * (0.5 * pi - edge_))) {
        Random random(piece.seed, purposes::wood, 4);
        seed_ = random.bits();
        for (std::uint32_t column = 0; column <= columns_; ++column) {
            above_.push_back(upper.at(angle_of(0, column), 1.0));
            below_.push_back(lower.at(angle_of(rows(), column), 1.0));
        }
    }

    [[nodiscard]] MeshCount count() const {
        const std::uint64_t columns = columns_, face = face_, between = rings_.size() - 1;
        // The face has all columns in its first and in its last row.
        const std::uint64_t of_face = (face + 1) * (rows() - 1) + 2 * (columns + 1);
        const std::uint64_t of_end = columns + 1 + between * (columns - 1);
        const std::uint64_t face_triangles =
            rows() == 1 ? 2 * columns : 2 * face * (rows() - 2) + 2 * (columns + face);
        return {(columns + 1) * (rows() + 1) + of_face + 2 * of_end,
                2 * columns * rows() + face_triangles + 2 * between * (2 * columns - 2)};
    }

    Mesh take() && {
        const std::uint32_t round = columns_ + 1;
        for (std::uint32_t row = 0; row <= rows(); ++row)
            for (std::uint32_t column = 0; column < round; ++column)
                bark_.push_back(bark_point(angle_of(row, column),
                                           height_of(row, above_[column], below_[column]),
                                           0.5 + angle_of(row, column) / pi));
        add_relief(bark_);
        for (const BarkPoint& point : bark_) add_bark_vertex(point);
        add_quads(0, columns_, round, 0, rows());
        add_face();
        for (const bool is_up : {true, false}) add_end(is_up);
        return finished();
    }

  private:
    /// What of the image of end grain is stretched along the face, in turns.
    static constexpr double grain_from = 0.3, grain_width = 0.06;

    /// Returns the angle of an edge of the bark.
    [[nodiscard]] double edge_at(std::uint32_t row, bool is_right) const {
        if (level > 1) return edge_ + 0.5 * wander_;
        const double along = down(row) / shape.radius, x = is_right ? 0.3 : 40.7;
        const double wave = noise_of(2.2 * along, x, seed_) + 0.6 * noise_of(7.0 * along, x, seed_);
        return edge_ + wander_ * std::clamp(0.5 + wave, 0.0, 1.0);
    }

    [[nodiscard]] double angle_of(std::uint32_t row, std::uint32_t column) const {
        const double left = -edge_at(row, false), right = edge_at(row, true);
        return left + (right - left) * static_cast<double>(column) / columns_;
    }

    [[nodiscard]] const BarkPoint& bark_at(std::uint32_t row, std::uint32_t column) const {
        return bark_[row * (columns_ + 1) + column];
    }

    /// Returns the distance from the pith at which the ray of a column meets the split face.
    [[nodiscard]] double face_distance(std::uint32_t row, std::uint32_t column) const {
        const glm::dvec3 pith(0.0, 0.0, -shape.radius),
            left = place(bark_at(row, 0)) - pith, right = place(bark_at(row, columns_)) - pith;
        const SineCosine at = sine_cosine(angle_of(row, column));
        // Of the crossing of the ray with the line from left to right.
        return (left.z * right.x - left.x * right.z) /
               ((right.x - left.x) * at.cosine - (right.z - left.z) * at.sine);
    }

    /// Returns the point of an end on the ray of a column, so far from its rim to the split face.
    ///
    /// distance  receives that from the pith
    [[nodiscard]] glm::dvec3 end_point(bool is_up, std::uint32_t column, double way,
                                       double& distance) const {
        const std::uint32_t row = is_up ? 0 : rows();
        const BarkPoint& rim = bark_at(row, column);
        distance = rim.distance;
        if (way == 0.0 || column == 0 || column == columns_) return place(rim);
        distance += way * (face_distance(row, column) - rim.distance);
        const double cut = (is_up ? upper : lower).at(rim.angle, distance / rim.distance);
        return place(distance, sine_cosine(rim.angle),
                     is_up ? shape.top - cut : shape.bottom + cut);
    }

    void add_face_vertex(const glm::dvec3& position, double distance) {
        add_vertex(
            position, {0.0, 0.0, -1.0},
            grain_from + grain_width * mirrored_place((shape.top - position.y) / image_length),
            rings_at(std::min(distance / shape.radius, 1.0)));
    }

    /// Adds the row of the face that is the rim of an end too.
    void add_face_rim(bool is_up) {
        for (std::uint32_t i = 0; i <= columns_; ++i) {
            double distance = 0.0;
            const glm::dvec3 at = end_point(is_up, columns_ - i, 1.0, distance);
            add_face_vertex(at, distance);
        }
    }

    /// Adds the triangles between a row with all columns and one with those of the face.
    ///
    /// is_up  the row with all columns is above
    void add_fans(std::uint32_t all, std::uint32_t few, bool is_up) {
        for (std::uint32_t i = 0; i < face_; ++i) {
            const std::uint32_t from = i * columns_ / face_, to = (i + 1) * columns_ / face_,
                                middle = (from + to) / 2;
            for (std::uint32_t k = from; k < to; ++k)
                add_end_triangle(is_up, few + i + (k < middle ? 0 : 1), all + k + 1, all + k);
            add_end_triangle(is_up, few + i, few + i + 1, all + middle);
        }
    }

    void add_face() {
        const std::uint32_t first = next_vertex();
        add_face_rim(true);
        const std::uint32_t inner = next_vertex();
        for (std::uint32_t row = 1; row < rows(); ++row)
            for (std::uint32_t i = 0; i <= face_; ++i) {
                const std::uint32_t column = columns_ - i * columns_ / face_;
                const bool is_edge = i == 0 || i == face_;
                const BarkPoint& bark = bark_at(row, column);
                const double distance = is_edge ? bark.distance : face_distance(row, column);
                // Of the heights of the edges, so that the face stays in order.
                const double height = bark_at(row, 0).height +
                                      (bark_at(row, columns_).height - bark_at(row, 0).height) *
                                          static_cast<double>(column) / columns_;
                add_face_vertex(
                    is_edge ? place(bark) : place(distance, sine_cosine(bark.angle), height),
                    distance);
            }
        const std::uint32_t last = next_vertex();
        add_face_rim(false);
        if (rows() == 1) {
            add_quads(first, columns_, columns_ + 1, 0, 1);
            return;
        }
        add_fans(first, inner, true);
        add_quads(inner, face_, face_ + 1, 0, rows() - 2);
        add_fans(last, last - face_ - 1, false);
    }

    void add_end(bool is_up) {
        const std::uint32_t rim = next_vertex(), row = is_up ? 0 : rows();
        const std::size_t index = mesh.indices.size();
        const glm::dvec3 normal(0.0, is_up ? 1.0 : -1.0, 0.0);
        const auto u_of = [&](std::uint32_t column) {
            return 0.5 + 0.5 * angle_of(row, column) / pi;
        };
        for (const double way : rings_)
            for (std::uint32_t column = way == 0.0 ? 0 : 1;
                 column <= columns_ - (way == 0.0 ? 0 : 1); ++column) {
                double distance = 0.0;
                const glm::dvec3 at = end_point(is_up, column, way, distance);
                add_vertex(at, normal, u_of(column),
                           rings_at(std::min(distance / bark_at(row, column).distance, 1.0)));
            }
        // All rings meet in the first and the last column.
        const auto vertex = [&](std::uint32_t ring, std::uint32_t column) {
            return column == 0 || column == columns_ || ring == 0
                       ? rim + column
                       : rim + columns_ + 1 + (ring - 1) * (columns_ - 1) + column - 1;
        };
        for (std::uint32_t ring = 0; ring + 1 < rings_.size(); ++ring)
            for (std::uint32_t column = 0; column < columns_; ++column) {
                const std::uint32_t a = vertex(ring, column), b = vertex(ring, column + 1),
                                    c = vertex(ring + 1, column + 1), d = vertex(ring + 1, column);
                if (b != c) add_end_triangle(is_up, a, b, c);
                if (a != d) add_end_triangle(is_up, a, c, d);
            }
        resolve_end_normals(is_up, rim, index);
    }

    std::uint32_t columns_, face_;       ///< of bark and of the split face
    std::span<const double> rings_;      ///< of an end
    double edge_, wander_;               ///< least angle of the edges of the bark, and its range
    std::uint32_t seed_ = 0;             ///< of the edges
    std::vector<double> above_, below_;  ///< how far the ends are cut at the rim, by column
    std::vector<BarkPoint> bark_;
};

/// Calls use(builder) with that of a piece.
template <class Use>
auto with_builder(const WoodPiece& piece, int lod, bool textured, const Use& use) {
    if (!(piece.radius > 0.0))
        throw InvalidInput("/radius", number_text(piece.radius) + " is not positive");
    if (!(piece.top > piece.bottom))
        throw InvalidInput("/top", number_text(piece.top) + " is not above the bottom, " +
                                       number_text(piece.bottom));
    if (!(piece.split >= 0.0 && piece.split < piece.radius))
        throw InvalidInput("/split", number_text(piece.split) +
                                         " is not between 0 and the radius, " +
                                         number_text(piece.radius));
    return piece.split > 0.0 ? use(SplitPiece(piece, lod, textured))
                             : use(WholePiece(piece, lod, textured));
}

}  // namespace

MeshCount wood_count(const WoodPiece& piece, int lod) {
    return with_builder(piece, lod, false, [](const auto& builder) { return builder.count(); });
}

Mesh wood_mesh(const WoodPiece& piece, int lod, bool textured) {
    return with_builder(piece, lod, textured, [](auto&& builder) {
        return std::forward<decltype(builder)>(builder).take();
    });
}

}  // namespace sporeprint
