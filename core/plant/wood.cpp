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

/// Makes the mesh of a piece.
class WoodBuilder {
  public:
    WoodBuilder(const WoodPiece& piece, int lod, bool textured)
        : piece_(piece),
          bumps_(piece),
          columns_(sides[static_cast<std::size_t>(lod)]),
          image_(wood_girths * 2.0 * pi * piece.radius),
          step_(image_ / rows_of_image[static_cast<std::size_t>(lod)]),
          textured_(textured) {}

    /// Number of rows of quads along the piece.
    [[nodiscard]] std::uint32_t rows() const {
        return std::max(
            1U, static_cast<std::uint32_t>(std::ceil((piece_.top - piece_.bottom) / step_ - 1e-6)));
    }

    [[nodiscard]] MeshCount count() const {
        // Two strips of bark; an end has two rings, and as many vertices in the middle as sides.
        return {(columns_ + std::uint64_t{2}) * (rows() + 1) +
                    2 * (2 * (columns_ + std::uint64_t{1}) + columns_),
                std::uint64_t{2} * columns_ * rows() + std::uint64_t{6} * columns_};
    }

    Mesh take() && {
        add_bark();
        add_end(piece_.top, 1.0F);
        add_end(piece_.bottom, -1.0F);
        if (textured_) add_tangents(mesh_);
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] double angle_of(std::uint32_t column) const {
        return 2.0 * pi * (static_cast<double>(column % columns_) / columns_ - 0.5);
    }

    void add_vertex(const glm::dvec3& position, const glm::dvec3& normal, double u, double v) {
        mesh_.positions.emplace_back(position);
        mesh_.normals.emplace_back(normal);
        if (textured_) mesh_.texture_coordinates.emplace_back(u, v);
    }

    [[nodiscard]] glm::dvec3 place(double distance, const SineCosine& at, double height) const {
        return {distance * at.sine, height, distance * at.cosine - piece_.radius};
    }

    void add_bark() {
        const std::uint32_t last = rows(), half = columns_ / 2;
        for (std::uint32_t row = 0; row <= last; ++row) {
            const double down =
                row == last ? piece_.top - piece_.bottom : static_cast<double>(row) * step_;
            const double height = piece_.top - down;
            const double v = wood_bark_end * mirrored_place(down / image_);
            for (const bool is_front : {true, false})
                for (std::uint32_t column = 0; column <= half; ++column)
                    add_bark_vertex(is_front, column, height, v);
        }
        const std::uint32_t round = columns_ + 2;
        for (std::uint32_t row = 0; row < last; ++row)
            for (std::uint32_t column = 0; column <= columns_; ++column) {
                if (column == half) continue;  // between the strips
                const std::uint32_t above = row * round + column, below = above + round;
                add_triangle(above, below, below + 1);
                add_triangle(above, below + 1, above + 1);
            }
    }

    /// is_front  of the strip that faces +z, where the image is; behind it is mirrored, so that it
    ///           is continuous on both sides
    void add_bark_vertex(bool is_front, std::uint32_t column, double height, double v) {
        const std::uint32_t half = columns_ / 2;
        const double angle = angle_of(columns_ / 4 + (is_front ? 0 : half) + column);
        const SineCosine at = sine_cosine(angle);
        const Distance from = bumps_.at(angle, height);
        const glm::dvec3 outwards(at.sine, 0.0, at.cosine), aside(at.cosine, 0.0, -at.sine);
        const glm::dvec3 normal =
            outwards - from.by_angle / from.length * aside - glm::dvec3(0.0, from.by_height, 0.0);
        const double along = static_cast<double>(column) / half;
        add_vertex(place(from.length, at, height), glm::normalize(normal),
                   is_front ? along : 1.0 - along, v);
    }

    /// up  1 for the upper end, -1 for the lower one
    void add_end(double height, float up) {
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        const glm::dvec3 normal(0.0, static_cast<double>(up), 0.0);
        const auto v_of = [](double share) {
            return wood_end_middle + share * (wood_end_rim - wood_end_middle);
        };
        const std::uint32_t round = columns_ + 1;
        const auto u_of = [&](double column) { return column / columns_; };
        for (const double share : {1.0, inner_ring})
            for (std::uint32_t column = 0; column < round; ++column) {
                const double angle = angle_of(column);
                add_vertex(
                    place(share * bumps_.at(angle, height).length, sine_cosine(angle), height),
                    normal, u_of(column), v_of(share));
            }
        for (std::uint32_t column = 0; column < columns_; ++column)
            add_vertex({0.0, height, -piece_.radius}, normal, u_of(column + 0.5), v_of(0.0));
        const std::uint32_t inner = first + round, middle = inner + round;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            if (up > 0.0F)
                add_triangle(a, b, c);
            else
                add_triangle(a, c, b);
        };
        for (std::uint32_t column = 0; column < columns_; ++column) {
            const std::uint32_t next = column + 1;
            add(first + column, first + next, inner + next);
            add(first + column, inner + next, inner + column);
            add(inner + column, inner + next, middle + column);
        }
    }

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
    }

    const WoodPiece& piece_;
    Bumps bumps_;
    std::uint32_t columns_;
    double image_, step_;  ///< length of an image and of a row, metres
    bool textured_;
    Mesh mesh_;
};

WoodBuilder builder_of(const WoodPiece& piece, int lod, bool textured) {
    if (!(piece.radius > 0.0))
        throw InvalidInput("/radius", number_text(piece.radius) + " is not positive");
    if (!(piece.top > piece.bottom))
        throw InvalidInput("/top", number_text(piece.top) + " is not above the bottom, " +
                                       number_text(piece.bottom));
    return {piece, lod, textured};
}

}  // namespace

MeshCount wood_count(const WoodPiece& piece, int lod) {
    const WoodBuilder builder = builder_of(piece, lod, false);
    return builder.count();
}

Mesh wood_mesh(const WoodPiece& piece, int lod, bool textured) {
    return builder_of(piece, lod, textured).take();
}

}  // namespace sporeprint
