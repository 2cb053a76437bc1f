#include "core/geometry/collar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/individual/proportion.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/tangents.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

/// The size of a collar in widest radii of the outline, for a base that is thick; and the base for
/// which it is half of that.
constexpr double most_size = 0.12, half_base = 0.1;

/// How lateral is what begins to have a collar, and what has a whole one.
constexpr double collar_from = 0.1, collar_to = 0.58;

/// How far it spreads upwards and to each side, in sizes.
constexpr double upwards = 0.4, sidewards = 0.75;

/// The share of its columns that lies beyond the bracket, and how far at most it reaches out to what
/// stands off the wall, in widest radii.
constexpr double end = 0.1, most_off = 0.09;

/// The least width of a bracket with a whole collar, in widest radii.
constexpr double least_width = 0.5;

/// How deep it goes into the wood, in sizes.
constexpr double depth = 0.8;

/// How far in front of the wall it clings to the faces of the bracket, in sizes.
constexpr double reach = 1.7;

/// Within which distance vertices of a face count most, in widest radii.
constexpr double field_width = 0.12;

/// How far the height of a face where it ends may be from that at the wall, in widest radii.
constexpr double steepest = 0.5;

/// From which distance to the wall on, in widest radii, a margin hides the end of its collar, and how
/// far within the margin that is, in further distances from the wall.
constexpr double clear_from = 0.05, behind_margin = 2.0;

/// How thick its rim is, and how deep below a face it ends, in sizes.
constexpr double rim_thickness = 0.16, sunk = 0.14;

/// The greatest radius of its part of an image, and the least on the lower face, where nothing is
/// painted below the stem.
constexpr double most_image = 0.97, least_image = hymenium_inner_share + 0.03;

/// The rows of a half, from the wood to the face of the bracket, as shares of the way from the rim.
/// Before them comes one in the wood, after them one inside of the bracket.
constexpr std::array<double, 6> fine_rows = {0.0, 0.1, 0.28, 0.5, 0.75, 1.0};
constexpr std::array<double, 3> middle_rows = {0.0, 0.45, 1.0};
constexpr int middle_columns = 20, coarse_columns = 10;
constexpr std::array<double, 1> coarse_rows = {0.0};

/// Depends on the species of a mix alone, not on their weights. Clubs have no lower face.
bool has_collar(const Individual& individual) {
    return individual.azimuth.base > 0.0 && individual.azimuth.lateral > 0.0 &&
           !individual.outline.hymenium.empty() && !individual.outline.cap.empty();
}

/// Returns 0 for what stands on the ground, 1 for a bracket.
double bracket_share(const Individual& individual) {
    return smooth_step(collar_from, collar_to, individual.azimuth.lateral);
}

/// Returns the greatest distance of the faces from the axis at rest, metres.
double widest_radius(const Individual& individual) {
    Extent extent{individual.stem_base, individual.stem_base};
    for (const SubCurve* curve : {&individual.outline.hymenium, &individual.outline.cap})
        extent.include(*curve);
    return extent.radius;
}

std::span<const double> rows_of(DetailLevel level) {
    if (level.lod == 0) return fine_rows;
    if (level.lod == 1) return middle_rows;
    return coarse_rows;
}

/// Returns true for levels at which collars are too small to be built.
bool is_far(DetailLevel level) {
    return level.lod > 2 || (level.lod == 2 && 2 * level.eighths >= DetailLevel::steps);
}

int columns_of(DetailLevel level) {
    if (level.lod == 0) return 2 * (detail_of(level).columns / 5);
    return level.lod == 1 ? middle_columns : coarse_columns;
}

/// The line in which the faces of a bracket lie at the wall: the two columns of its mesh that are
/// aside. Unlike the section of the mesh with the wall, it moves as continuously as its vertices.
class ContactLine {
  public:
    /// face  of the body, whose flesh lies deeper than the edges of its solids
    ContactLine(const Mesh& mesh, const SweptBody& body, const LowerFace* face,
                const std::vector<double>& turns) {
        std::size_t opposite = 0;
        for (std::size_t i = 0; i < turns.size(); ++i)
            if (std::abs(turns[i] - 0.5) < std::abs(turns[opposite] - 0.5)) opposite = i;
        const std::size_t stride = turns.size() + 1;
        for (const bool is_right : {false, true}) {
            Side& side = sides_[is_right ? 1 : 0];
            const auto add = [&](const FaceGrid& grid, std::vector<glm::dvec3>& line) {
                for (std::size_t ring = 0; ring < grid.shares.size(); ++ring) {
                    line.emplace_back(
                        mesh.positions[grid.first + ring * stride + (is_right ? 0 : opposite)]);
                    // The end rings are those of stem and cap.
                    if (face == nullptr || grid.part != Part::hymenium || ring == 0 ||
                        ring + 1 == grid.shares.size())
                        continue;
                    const LowerFace::Place place = face->at(grid.shares[ring]);
                    line.back() +=
                        place.recess *
                        glm::dvec3((is_right ? 1.0 : -1.0) * place.normal_r, place.normal_y, 0.0);
                }
            };
            add(body.stem, side.lower);
            add(body.hymenium, side.lower);
            add(body.cap, side.upper);
            std::reverse(side.upper.begin(), side.upper.end());
        }
    }

    /// Places on both faces.
    struct Places {
        glm::dvec3 lower, upper;
    };

    /// way  from the axis, 0, to the margin aside, 1
    [[nodiscard]] Places at(double way, bool is_right) const {
        const Side& side = sides_[is_right ? 1 : 0];
        return {on(side.lower, way), on(side.upper, way)};
    }

  private:
    /// The faces on one side, from the axis to the margin.
    struct Side {
        std::vector<glm::dvec3> lower, upper;
    };

    /// Returns the point of a line at a share of the way out to its end. Where the line does not
    /// run outwards it counts as if it did by a share of its length, so that the point moves
    /// continuously.
    [[nodiscard]] static glm::dvec3 on(const std::vector<glm::dvec3>& line, double way) {
        constexpr double least = 0.25;
        std::vector<double> out{0.0};
        for (std::size_t i = 1; i < line.size(); ++i) {
            const glm::dvec3 step = line[i] - line[i - 1];
            out.push_back(out.back() + std::max(std::abs(line[i].x) - std::abs(line[i - 1].x),
                                                least * std::sqrt(glm::dot(step, step))));
        }
        const double at = way * out.back();
        std::size_t i = 1;
        while (i + 1 < line.size() && out[i] < at) ++i;
        const double from = out[i - 1], to = out[i];
        const double t = to > from ? std::clamp((at - from) / (to - from), 0.0, 1.0) : 0.0;
        return line[i - 1] + t * (line[i] - line[i - 1]);
    }

    std::array<Side, 2> sides_;
};

/// What is known of a face of a bracket above a place of the floor.
struct FaceAt {
    double height = 0.0;
    glm::dvec2 image{0.0};  ///< texture coordinate
    glm::dvec2 image_by_x{0.0}, image_by_z{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};
};

/// A face of a bracket as a smooth field over x and z: planes through the vertices near a place,
/// fitted by moving least squares. So it moves as continuously as the vertices, wherever these are.
///
/// Every vertex has a weight, so that there is a plane far from all of them; it is that of its area,
/// because a mix has more columns than its species.
class FaceField {
  public:
    /// width  within which vertices count most, metres
    explicit FaceField(double width) : width_(std::max(width, 1e-9)) {}

    /// A vertex of the face, with the area of the mesh about it, square metres.
    struct Vertex {
        glm::dvec3 place, normal;
        double area;
        std::optional<glm::dvec2> image;
    };
    void add(const Vertex& vertex) { vertices_.push_back(vertex); }

    /// near  a height of the face thereabouts, which tells it from other parts of a face that folds
    [[nodiscard]] FaceAt at(double x, double z, double near) const {
        Fit of_height, of_image;
        std::array<double, 3> height{};
        std::array<glm::dvec2, 3> image{};
        glm::dvec3 normal(0.0);
        for (const Vertex& vertex : vertices_) {
            const double dx = (vertex.place.x - x) / width_, dz = (vertex.place.z - z) / width_,
                         dy = (vertex.place.y - near) / width_;
            const double far = 1.0 + dx * dx + dz * dz + 0.25 * dy * dy, square = far * far;
            const double weight = (vertex.area + 1e-9 * width_ * width_) / (square * square);
            const std::array<double, 3> terms = {1.0, dx, dz};
            of_height.add(terms, weight);
            for (std::size_t k = 0; k < 3; ++k)
                height[k] += weight * terms[k] * (vertex.place.y - near);
            normal += weight * vertex.normal;
            if (!vertex.image) continue;
            of_image.add(terms, weight);
            for (std::size_t k = 0; k < 3; ++k) image[k] += weight * terms[k] * *vertex.image;
        }
        FaceAt result;
        result.normal = normal;
        const auto heights = of_height.solved();
        const auto images = of_image.solved();
        for (std::size_t k = 0; k < 3; ++k) {
            result.height += heights[0][k] * height[k];
            result.image += images[0][k] * image[k];
            result.image_by_x += images[1][k] / width_ * image[k];
            result.image_by_z += images[2][k] / width_ * image[k];
        }
        result.height += near;
        return result;
    }

  private:
    /// The normal equations of a plane.
    struct Fit {
        std::array<std::array<double, 3>, 3> sums{};

        void add(const std::array<double, 3>& terms, double weight) {
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = i; k < 3; ++k) sums[i][k] += weight * terms[i] * terms[k];
        }

        /// Returns the inverse; zeros without vertices. Slopes across which no vertices lie are 0.
        [[nodiscard]] std::array<std::array<double, 3>, 3> solved() const {
            if (sums[0][0] <= 0.0) return {};
            const double least = 0.02 * sums[0][0];
            const double a = sums[0][0], b = sums[0][1], c = sums[0][2], d = sums[1][1] + least,
                         e = sums[1][2], f = sums[2][2] + least;
            const double of_a = d * f - e * e, of_b = c * e - b * f, of_c = b * e - c * d,
                         of_d = a * f - c * c, of_e = b * c - a * e, of_f = a * d - b * b;
            const double over = 1.0 / (a * of_a + b * of_b + c * of_c);
            return {{{of_a * over, of_b * over, of_c * over},
                     {of_b * over, of_d * over, of_e * over},
                     {of_c * over, of_e * over, of_f * over}}};
        }
    };

    std::vector<Vertex> vertices_;
    double width_;
};

/// Adds the vertices of a grid to a field.
///
/// face  as for ContactLine
void add_face(FaceField& field, const Mesh& mesh, const FaceGrid& grid, const LowerFace* face,
              const std::vector<double>& turns) {
    const std::size_t stride = turns.size() + 1;
    for (std::size_t ring = 0; ring < grid.shares.size(); ++ring) {
        const bool is_sunk = face != nullptr && grid.part == Part::hymenium && ring > 0 &&
                             ring + 1 < grid.shares.size();
        const LowerFace::Place place = is_sunk ? face->at(grid.shares[ring]) : LowerFace::Place{};
        // The last column is the first.
        for (std::size_t column = 0; column + 1 < stride; ++column) {
            const std::size_t i = grid.first + ring * stride + column;
            glm::dvec3 at(mesh.positions[i]);
            if (is_sunk) {
                const glm::dvec3 out = unit_or({at.x, 0.0, at.z}, glm::dvec3(0.0));
                at += place.recess * (place.normal_r * out + glm::dvec3(0.0, place.normal_y, 0.0));
            }
            const std::size_t left = column > 0 ? i - 1 : i + stride - 2;
            const std::size_t below = ring > 0 ? i - stride : i,
                              above = ring + 1 < grid.shares.size() ? i + stride : i;
            const auto half_distance = [&](std::size_t a, std::size_t b) {
                return 0.5 *
                       static_cast<double>(glm::distance(mesh.positions[a], mesh.positions[b]));
            };
            FaceField::Vertex vertex{at,
                                     glm::dvec3(mesh.normals[i]),
                                     half_distance(left, i + 1) * half_distance(below, above),
                                     {}};
            if (grid.part != Part::stem && !mesh.texture_coordinates.empty())
                vertex.image = glm::dvec2(mesh.texture_coordinates[i]);
            field.add(vertex);
        }
    }
}

/// Makes the mesh of a collar: a lower and an upper half of columns across the bracket, and a back.
/// In each column a half is a fillet: a parabola that leaves the wall and ends on a face of the
/// bracket without a crease.
class CollarBuilder {
  public:
    CollarBuilder(const ContactLine& contact, const FaceField& lower, const FaceField& upper,
                  const glm::dvec3& foot, const Individual& individual, DetailLevel level)
        : contact_(contact),
          lower_(lower),
          upper_(upper),
          foot_(foot),
          rows_(rows_of(level)),
          columns_(columns_of(level)),
          size_(collar_size(individual)),
          presence_(bracket_share(individual)) {
        Random random(individual.shape_seed, purposes::bracket_base, 1);
        for (double& phase : phases_) phase = random.uniform(0.0, 2.0 * pi);
        radius_ = widest_radius(individual);
        // A bracket that is twisted until its sides change places has none.
        presence_ *= smooth_step(0.0, least_width * std::max(radius_, 1e-9),
                                 contact.at(1.0, true).lower.x - contact.at(1.0, false).lower.x);
        for (int column = 0; column <= columns_; ++column) spans_.push_back(span(column));
    }

    Mesh take() && {
        for (const bool is_upper : {false, true}) add_half(is_upper);
        add_back();
        resolve_normals();
        return std::move(mesh_);
    }

  private:
    /// A half in the plane of a column.
    struct Half {
        double rim = 0.0, corner = 0.0, end = 0.0;  ///< heights of the parabola
        FaceAt face;                                ///< where it ends
    };
    /// A column.
    struct Span {
        double x = 0.0, end_x = 0.0;    ///< places along the wall: at the wall, at the bracket
        double beyond = 0.0;            ///< distance beyond the bracket, with its sign
        double off = 0.0, front = 0.0;  ///< where it leaves the wall and where it ends, along z
        double round = 1.0;             ///< from 0 at either end to 1
        double middle = 0.0;            ///< height inside of the bracket
        std::array<Half, 2> halves;
    };

    /// Returns uneven amounts about 1 along the wall.
    [[nodiscard]] double uneven(double x, bool is_upper) const {
        const double along = x / std::max(radius_, 1e-9), shift = is_upper ? 2.0 : 0.0;
        return 1.0 + 0.34 * sine(4.7 * along + phases_[0] + shift) +
               0.22 * sine(10.9 * along + phases_[1] + 2.0 * shift) +
               0.16 * sine(23.0 * along + phases_[2] + 3.0 * shift);
    }

    [[nodiscard]] Span span(int column) const {
        const double s = 2.0 * column / columns_ - 1.0, aside = std::abs(s) / (1.0 - end);
        const bool is_right = s > 0.0;
        const ContactLine::Places here = contact_.at(std::min(aside, 1.0), is_right);
        Span result;
        // Where the bracket stands off the wall, the collar reaches out to it, and not beyond it.
        const double off = 0.5 * (here.lower.z + here.upper.z);
        result.off = std::clamp(off, 0.0, most_off * radius_);
        result.beyond = std::max(aside - 1.0, 0.0) * (1.0 - end) / end * sidewards * size_ *
                        (1.0 - smooth_step(clear_from * radius_, most_off * radius_, off)) *
                        (is_right ? 1.0 : -1.0);
        // There it ends behind the margin, which hides its end.
        const double inside =
            0.5 * (here.lower.x + here.upper.x) -
            behind_margin * std::max(result.off - clear_from * radius_, 0.0) * s * std::abs(s);
        result.x = inside + result.beyond;
        // Both halves meet in a point at either end.
        result.round = std::sqrt(std::max(1.0 - s * s * s * s, 0.0));
        const double within = std::min((1.0 - std::abs(s)) / end, 1.0);
        // Towards the margin it reaches less far out, where there is less to cling to.
        const double narrow = std::sqrt(std::max(1.0 - s * s, 0.0));
        result.front = result.off + reach * size_ * narrow;
        result.end_x = inside - 0.5 * reach * size_ * s * std::abs(s);
        const double middle = 0.5 * (here.lower.y + here.upper.y);
        double low = 0.0, high = 0.0;
        for (const bool is_upper : {false, true}) {
            Half& half = result.halves[is_upper ? 1 : 0];
            const FaceField& field = is_upper ? upper_ : lower_;
            const double contact = is_upper ? here.upper.y : here.lower.y;
            half.face = field.at(result.end_x, result.front, contact);
            half.face.height = std::clamp(half.face.height, contact - steepest * radius_,
                                          contact + steepest * radius_);
            (is_upper ? high : low) = half.face.height;
            half.corner = middle + within * (is_upper ? std::max(contact - middle, 0.0)
                                                      : std::min(contact - middle, 0.0));
            half.end = middle + within * (half.face.height - middle);
            half.rim = half.corner + (is_upper ? upwards : -1.0) * size_ * result.round *
                                         uneven(result.x, is_upper);
        }
        result.middle = middle + within * (0.5 * (low + high) - middle);
        // It ends just below the faces.
        const double thick = std::max(high - low, 0.0), deep = sunk * size_;
        const double deeper = within * deep * thick / (4.0 * deep + thick + 1e-12);
        // Where folds of the faces lie the other way round, there is nothing between them.
        Half &under = result.halves[0], &over = result.halves[1];
        under.end = std::min(under.end + deeper, result.middle);
        over.end = std::max(over.end - deeper, result.middle);
        return result;
    }

    /// Returns a place at a share of the way from the rim to the bracket.
    [[nodiscard]] glm::dvec3 place(const Span& span, double way, bool is_upper) const {
        const Half& half = span.halves[is_upper ? 1 : 0];
        const double rest = 1.0 - way;
        const double y =
            rest * rest * half.rim + 2.0 * rest * way * half.corner + way * way * half.end;
        const double bumps =
            1.0 + 0.3 * sine(19.0 * (span.x + y) / std::max(radius_, 1e-9) + phases_[2]);
        const double z = 2.0 * rest * way * span.off + way * way * span.front +
                         rest * rest * size_ * rim_thickness * bumps;
        return {span.x + way * way * (span.end_x - span.x), y, span.round * z};
    }

    /// Returns places of a half from the wood to the inside of the bracket.
    [[nodiscard]] std::vector<glm::dvec3> places(int column, bool is_upper) const {
        const Span& span = spans_[static_cast<std::size_t>(column)];
        const glm::dvec3 in_wood(span.x, span.halves[is_upper ? 1 : 0].rim, -depth * size_);
        std::vector<glm::dvec3> result(rows_.size() + 2, in_wood);
        // Both ends are in the wood.
        if (column > 0 && column < columns_) {
            for (std::size_t row = 0; row < rows_.size(); ++row)
                result[row + 1] = place(span, rows_[row], is_upper);
            result.back() = {span.end_x, span.middle, span.round * span.front};
        }
        // What is no bracket has none: it vanishes at the foot.
        for (glm::dvec3& place : result) place = foot_ + presence_ * (place - foot_);
        return result;
    }

    /// Returns the texture coordinate of a vertex: the image of the face goes on over the collar as
    /// if in a mirror, because what is painted behind the wall is drawn out.
    ///
    /// length  of the way from where the collar leaves the face
    [[nodiscard]] static glm::vec2 image(const Span& span, double length, bool is_upper) {
        const FaceAt& face = span.halves[is_upper ? 1 : 0].face;
        const glm::dvec2 at = face.image - span.beyond * face.image_by_x + length * face.image_by_z;
        const Chart& chart = swept_charts[index_of(is_upper ? Part::cap : Part::hymenium)];
        const TexturePoint middle = disc_point(chart, 0.0, 1.0, 0.0),
                           rim = disc_point(chart, 1.0, 1.0, 1.0);
        const glm::dvec2 radii(rim.u - middle.u, rim.v - middle.v);
        const glm::dvec2 from = (at - glm::dvec2(middle.u, middle.v)) / radii;
        const double share = std::sqrt(glm::dot(from, from));
        const double within = std::clamp(share, is_upper ? 0.0 : least_image, most_image);
        const double factor = share > 0.0 ? within / share : 1.0;
        return glm::vec2(glm::dvec2(middle.u, middle.v) + factor * from * radii);
    }

    void add_half(bool is_upper) {
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size()),
                   stride = static_cast<std::uint32_t>(columns_ + 1);
        const std::size_t rows = rows_.size() + 2;
        mesh_.positions.resize(first + rows * stride);
        mesh_.texture_coordinates.resize(mesh_.positions.size());
        for (int column = 0; column <= columns_; ++column) {
            const std::vector<glm::dvec3> line = places(column, is_upper);
            double length = 0.0;
            for (std::size_t row = rows; row-- > 0;) {
                // What lies inside of the bracket takes no part of the image.
                if (row + 2 < rows) {
                    const glm::dvec3 step = line[row] - line[row + 1];
                    length += std::sqrt(glm::dot(step, step));
                }
                const std::size_t at = first + row * stride + static_cast<std::size_t>(column);
                mesh_.positions[at] = glm::vec3(line[row]);
                mesh_.texture_coordinates[at] =
                    image(spans_[static_cast<std::size_t>(column)], length, is_upper);
            }
        }
        mesh_.normals.resize(mesh_.positions.size());
        for (std::uint32_t row = 0; row + 1 < rows; ++row)
            for (std::uint32_t column = 0; column + 1 < stride; ++column) {
                // Of the lower half the rows go up, of the upper half down.
                const std::uint32_t a = first + row * stride + column, b = a + 1, c = a + stride,
                                    d = c + 1;
                if (column > 0) add(is_upper, a, d, c);
                if (column + 2 < stride) add(is_upper, a, b, d);
            }
        half_begins_[is_upper ? 1 : 0] = first;
    }

    void add(bool turned, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (turned)
            mesh_.indices.insert(mesh_.indices.end(), {a, c, b});
        else
            mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
    }

    void add_back() {
        const std::uint32_t low = half_begins_[0], high = half_begins_[1];
        for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(columns_); ++column) {
            const std::uint32_t a = low + column, b = a + 1, c = high + column, d = c + 1;
            if (column > 0) add(true, a, d, c);
            if (column + 1 < static_cast<std::uint32_t>(columns_)) add(true, a, b, d);
        }
    }

    /// Gives vertices the mean normals of the triangles about them.
    void resolve_normals() {
        std::vector<glm::dvec3> sums(mesh_.positions.size(), glm::dvec3(0.0));
        const std::size_t back = mesh_.indices.size() - back_indices();
        for (std::size_t i = 0; i < back; i += 3) {
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(mesh_.positions[mesh_.indices[i + k]]);
            };
            const glm::dvec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
            for (std::size_t k = 0; k < 3; ++k) sums[mesh_.indices[i + k]] += across;
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            mesh_.normals[i] = glm::vec3(unit_or(sums[i], {0.0, 0.0, 1.0}));
        // Shading turns into that of the face, so that no line shows where the collar ends.
        const auto stride = static_cast<std::size_t>(columns_ + 1);
        for (std::size_t half = 0; half < 2; ++half)
            for (std::size_t row = 0; row <= rows_.size(); ++row)
                for (std::size_t column = 0; column < stride; ++column) {
                    const double way = row < rows_.size() ? rows_[row] : 1.0;
                    glm::vec3& normal =
                        mesh_.normals[half_begins_[half] + (row + 1) * stride + column];
                    const glm::dvec3 own(normal),
                        of_face = unit_or(spans_[column].halves[half].face.normal, own);
                    normal = glm::vec3(unit_or(own + way * way * (of_face - own), own));
                }
    }

    [[nodiscard]] std::size_t back_indices() const {
        return 3 * (2 * static_cast<std::size_t>(columns_) - 2);
    }

    const ContactLine& contact_;
    const FaceField &lower_, &upper_;
    glm::dvec3 foot_;
    std::span<const double> rows_;
    int columns_;
    double size_, presence_, radius_ = 0.0;  ///< of the collar, its share, and of the outline
    std::array<double, 3> phases_{};
    std::vector<Span> spans_;                     ///< of the columns
    std::array<std::uint32_t, 2> half_begins_{};  ///< first vertices of the halves
    Mesh mesh_;
};

}  // namespace

double collar_size(const Individual& individual) {
    if (!has_collar(individual)) return 0.0;
    const Azimuth& azimuth = individual.azimuth;
    return most_size * widest_radius(individual) * bracket_share(individual) * azimuth.base /
           (azimuth.base + half_base);
}

MeshCount collar_count(const Individual& individual, DetailLevel level) {
    if (!has_collar(individual) || is_far(level)) return {};
    const auto columns = static_cast<std::uint64_t>(columns_of(level)),
               rows = static_cast<std::uint64_t>(rows_of(level).size() + 2);
    return {2 * rows * (columns + 1), (2 * (rows - 1) + 1) * (2 * columns - 2)};
}

void add_collar(Mesh& mesh, const SweptBody& body, const LowerFace* face,
                const std::vector<double>& turns, const Individual& individual, DetailLevel level,
                bool textured) {
    if (!has_collar(individual) || is_far(level)) return;
    const double width = field_width * widest_radius(individual);
    FaceField lower(width), upper(width);
    for (const FaceGrid* grid : {&body.stem, &body.hymenium})
        add_face(lower, mesh, *grid, face, turns);
    add_face(upper, mesh, body.cap, nullptr, turns);
    Mesh collar = CollarBuilder({mesh, body, face, turns}, lower, upper,
                                glm::dvec3(mesh.positions[body.stem.first]), individual, level)
                      .take();
    if (textured)
        add_tangents(collar);
    else
        collar.texture_coordinates.clear();
    append(mesh, collar);
}

}  // namespace sporeprint
