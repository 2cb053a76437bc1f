#include "core/plant/wood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/tangents.h"
#include "core/params/messages.h"
#include "core/plant/bark_image.h"
#include "core/plant/wood_image.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Sides of the piece, and rows along one image of its bark, by level of detail.
constexpr std::array<std::uint32_t, 4> sides = {48, 28, 16, 12}, rows_of_image = {12, 7, 4, 3};

/// The middle ring of an end, in radii.
constexpr double inner_ring = 0.45;

/// The distance of the bark from the axis, and its derivatives.
struct Distance {
    double length = 0.0, by_angle = 0.0, by_height = 0.0;
};

/// The radius of bark, which varies round the piece and, slowly, along it.
class Bumps {
  public:
    explicit Bumps(const WoodPiece& piece) : radius_(piece.radius) {
        Random random(piece.seed, purposes::wood);
        for (Wave& wave : waves_) {
            wave.phase = random.uniform(0.0, 2.0 * pi);
            wave.twist = 2.0 * random.symmetric() / radius_;
        }
    }

    [[nodiscard]] Distance at(double angle, double height) const {
        constexpr double middle = 0.5 * (1.0 + uneven_radius), depth = 0.5 * (uneven_radius - 1.0);
        Distance out{middle * radius_};
        for (const Wave& wave : waves_) {
            const SineCosine at =
                sine_cosine(wave.lobes * angle + wave.phase + wave.twist * height);
            const double size = depth * wave.share * radius_;
            out.length += size * at.cosine;
            out.by_angle -= wave.lobes * size * at.sine;
            out.by_height -= wave.twist * size * at.sine;
        }
        return out;
    }

  private:
    struct Wave {
        double lobes, share, phase = 0.0, twist = 0.0;
    };
    double radius_;
    std::array<Wave, 4> waves_ = {{{2.0, 0.4}, {3.0, 0.3}, {5.0, 0.2}, {8.0, 0.1}}};
};

/// What whole and split pieces have in common: rows of vertices along the grain.
class WoodBuilder {
  public:
    WoodBuilder(const WoodPiece& piece, int lod, bool textured)
        : shape(piece),
          bumps(piece),
          whole_sides(sides[static_cast<std::size_t>(lod)]),
          image_length(wood_girths * 2.0 * pi * piece.radius),
          row_length(image_length / rows_of_image[static_cast<std::size_t>(lod)]),
          has_texture(textured) {}

  protected:
    /// Number of rows of quads along the piece.
    [[nodiscard]] std::uint32_t rows() const {
        return std::max(1U, static_cast<std::uint32_t>(
                                std::ceil((shape.top - shape.bottom) / row_length - 1e-6)));
    }

    /// Distance of a row of vertices from the top, metres.
    [[nodiscard]] double down(std::uint32_t row) const {
        return row == rows() ? shape.top - shape.bottom : static_cast<double>(row) * row_length;
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

    [[nodiscard]] glm::dvec3 bark_at(double angle, double height) const {
        return place(bumps.at(angle, height).length, sine_cosine(angle), height);
    }

    /// u  of the image of bark
    void add_bark_vertex(double angle, std::uint32_t row, double u) {
        const double height = shape.top - down(row);
        const SineCosine at = sine_cosine(angle);
        const Distance from = bumps.at(angle, height);
        const glm::dvec3 outwards(at.sine, 0.0, at.cosine), aside(at.cosine, 0.0, -at.sine);
        const glm::dvec3 normal =
            outwards - from.by_angle / from.length * aside - glm::dvec3(0.0, from.by_height, 0.0);
        add_vertex(place(from.length, at, height), glm::normalize(normal), u,
                   wood_bark_end * mirrored_place(down(row) / image_length));
    }

    /// Returns the place across growth rings in the image.
    ///
    /// share  distance from the pith, in radii
    [[nodiscard]] static double rings_at(double share) {
        return wood_end_middle + share * (wood_end_rim - wood_end_middle);
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
    /// first   vertex of the first row
    /// stride  vertices from a row to the next
    void add_quads(std::uint32_t first, std::uint32_t columns, std::uint32_t stride) {
        for (std::uint32_t row = 0; row < rows(); ++row)
            for (std::uint32_t column = 0; column < columns; ++column) {
                const std::uint32_t above = first + row * stride + column, below = above + stride;
                add_triangle(above, below, below + 1);
                add_triangle(above, below + 1, above + 1);
            }
    }

    [[nodiscard]] std::uint32_t next_vertex() const {
        return static_cast<std::uint32_t>(mesh.positions.size());
    }

    const WoodPiece& shape;
    Bumps bumps;
    std::uint32_t whole_sides;        ///< of a whole piece
    double image_length, row_length;  ///< length of an image and of a row, metres
    bool has_texture;
    Mesh mesh;
};

/// Makes the mesh of a whole piece.
class WholePiece : WoodBuilder {
  public:
    using WoodBuilder::WoodBuilder;

    [[nodiscard]] MeshCount count() const {
        // Two strips of bark; an end has two rings, and as many vertices in the middle as sides.
        return {(whole_sides + std::uint64_t{2}) * (rows() + 1) +
                    2 * (2 * (whole_sides + std::uint64_t{1}) + whole_sides),
                std::uint64_t{2} * whole_sides * rows() + std::uint64_t{6} * whole_sides};
    }

    Mesh take() && {
        add_bark();
        for (const bool is_up : {true, false}) add_end(is_up);
        return finished();
    }

  private:
    [[nodiscard]] double angle_of(std::uint32_t column) const {
        return 2.0 * pi * (static_cast<double>(column % whole_sides) / whole_sides - 0.5);
    }

    void add_bark() {
        const std::uint32_t half = whole_sides / 2;
        for (std::uint32_t row = 0; row <= rows(); ++row)
            for (const bool is_front : {true, false})
                for (std::uint32_t column = 0; column <= half; ++column) {
                    // The image is in front; behind it is mirrored, so that it is continuous on both
                    // sides.
                    const double along = static_cast<double>(column) / half;
                    add_bark_vertex(angle_of(whole_sides / 4 + (is_front ? 0 : half) + column), row,
                                    is_front ? along : 1.0 - along);
                }
        for (const std::uint32_t strip : {0U, half + 1}) add_quads(strip, half, whole_sides + 2);
    }

    void add_end(bool is_up) {
        const std::uint32_t first = next_vertex(), round = whole_sides + 1;
        const double height = is_up ? shape.top : shape.bottom;
        const glm::dvec3 normal(0.0, is_up ? 1.0 : -1.0, 0.0);
        for (const double share : {1.0, inner_ring})
            for (std::uint32_t column = 0; column < round; ++column) {
                const double angle = angle_of(column);
                add_vertex(
                    place(share * bumps.at(angle, height).length, sine_cosine(angle), height),
                    normal, static_cast<double>(column) / whole_sides, rings_at(share));
            }
        for (std::uint32_t column = 0; column < whole_sides; ++column)
            add_vertex({0.0, height, -shape.radius}, normal, (column + 0.5) / whole_sides,
                       rings_at(0.0));
        const std::uint32_t inner = first + round, middle = inner + round;
        for (std::uint32_t column = 0; column < whole_sides; ++column) {
            const std::uint32_t next = column + 1;
            add_end_triangle(is_up, first + column, first + next, inner + next);
            add_end_triangle(is_up, first + column, inner + next, inner + column);
            add_end_triangle(is_up, inner + column, inner + next, middle + column);
        }
    }
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
          columns_(whole_sides / 2),
          edge_(angle_of_cosine(1.0 - piece.split / piece.radius)) {}

    [[nodiscard]] MeshCount count() const {
        const std::uint64_t columns = columns_;
        return {2 * (columns + 1) * (rows() + 1) + 2 * (2 * columns),
                4 * columns * rows() + 2 * (2 * columns - 2)};
    }

    Mesh take() && {
        const std::uint32_t round = columns_ + 1;
        for (std::uint32_t row = 0; row <= rows(); ++row)
            for (std::uint32_t column = 0; column < round; ++column)
                add_bark_vertex(angle_of(column), row, 0.5 + angle_of(column) / pi);
        add_quads(0, columns_, round);
        const std::uint32_t face = next_vertex();
        for (std::uint32_t row = 0; row <= rows(); ++row)
            for (std::uint32_t column = 0; column < round; ++column)
                add_face_vertex(
                    columns_ - column, shape.top - down(row), {0.0, 0.0, -1.0},
                    grain_from + grain_width * mirrored_place(down(row) / image_length));
        add_quads(face, columns_, round);
        for (const bool is_up : {true, false}) add_end(is_up);
        return finished();
    }

  private:
    /// What of the image of end grain is stretched along the face, in turns.
    static constexpr double grain_from = 0.3, grain_width = 0.02;

    [[nodiscard]] double angle_of(std::uint32_t column) const {
        return edge_ * (2.0 * static_cast<double>(column) / columns_ - 1.0);
    }

    /// Adds the point where the ray of a column meets the split face.
    void add_face_vertex(std::uint32_t column, double height, const glm::dvec3& normal, double u) {
        const glm::dvec3 pith(0.0, height, -shape.radius), left = bark_at(-edge_, height) - pith,
                                                           right = bark_at(edge_, height) - pith;
        const SineCosine at = sine_cosine(angle_of(column));
        // Of the crossing of the ray with the line from left to right.
        const double distance = (left.z * right.x - left.x * right.z) /
                                ((right.x - left.x) * at.cosine - (right.z - left.z) * at.sine);
        const glm::dvec3 position = column == 0          ? bark_at(-edge_, height)
                                    : column == columns_ ? bark_at(edge_, height)
                                                         : place(distance, at, height);
        add_vertex(position, normal, u, rings_at(std::min(distance / shape.radius, 1.0)));
    }

    void add_end(bool is_up) {
        const std::uint32_t rim = next_vertex(), face = rim + columns_ + 1;
        const double height = is_up ? shape.top : shape.bottom;
        const glm::dvec3 normal(0.0, is_up ? 1.0 : -1.0, 0.0);
        const auto u_of = [&](std::uint32_t column) { return 0.5 + 0.5 * angle_of(column) / pi; };
        for (std::uint32_t column = 0; column <= columns_; ++column)
            add_vertex(bark_at(angle_of(column), height), normal, u_of(column), rings_at(1.0));
        for (std::uint32_t column = 1; column < columns_; ++column)
            add_face_vertex(column, height, normal, u_of(column));
        // The rim and the face meet in the first and the last column.
        const auto on_face = [&](std::uint32_t column) { return face + column - 1; };
        add_end_triangle(is_up, rim, rim + 1, on_face(1));
        for (std::uint32_t column = 1; column + 1 < columns_; ++column) {
            add_end_triangle(is_up, rim + column, rim + column + 1, on_face(column + 1));
            add_end_triangle(is_up, rim + column, on_face(column + 1), on_face(column));
        }
        add_end_triangle(is_up, rim + columns_ - 1, rim + columns_, on_face(columns_ - 1));
    }

    std::uint32_t columns_;  ///< of bark
    double edge_;            ///< angle of the right edge of the bark
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
