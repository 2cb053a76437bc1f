#include "core/geometry/collar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
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
constexpr double collar_from = 0.3, collar_to = 0.75;

/// How far it spreads upwards and to each side, in sizes.
constexpr double upwards = 0.4, sidewards = 0.75;

/// The share of its columns that lies beyond the bracket, and how far at most it reaches out to what
/// stands off the wall, in widest radii.
constexpr double end = 0.1, most_off = 0.12;

/// The least width of a bracket with a whole collar, in widest radii.
constexpr double least_width = 0.5;

/// How deep it goes into the wood, in sizes.
constexpr double depth = 0.8;

/// Where the image of a collar begins inside the bracket, as a share of the widest radius.
/// Below it begins farther out, where gills diverge less.
constexpr double within_bracket = 0.04, below_bracket = 0.4, most_inside = 0.1, most_aside = 0.95,
                 most_aside_below = 0.76;

/// The rows of a half, from its rim to the bracket: the share of the way, and the height over the
/// wall in sizes. The first lies in the wood, the last inside the bracket.
struct Row {
    double way, height;
};
constexpr std::array<Row, 7> fine_rows = {
    {{0.0, -depth}, {0.0, 0.2}, {0.07, 0.34}, {0.4, 0.42}, {0.75, 0.6}, {1.0, 1.0}, {2.0, 1.3}}};
constexpr std::array<Row, 5> middle_rows = {
    {{0.0, -depth}, {0.02, 0.3}, {0.5, 0.45}, {1.0, 1.0}, {2.0, 1.3}}};
constexpr std::array<Row, 3> coarse_rows = {{{0.0, -depth}, {0.04, 0.33}, {2.0, 1.1}}};

/// Depends on the species of a mix alone, not on their weights.
bool has_collar(const Individual& individual) {
    return individual.azimuth.base > 0.0 && individual.azimuth.lateral > 0.0;
}

/// Returns 0 for what stands on the ground, 1 for a bracket.
double bracket_share(const Individual& individual) {
    return smooth_step(collar_from, collar_to, individual.azimuth.lateral);
}

std::span<const Row> rows_of(DetailLevel level) {
    if (level.lod == 0) return fine_rows;
    if (level.lod == 1) return middle_rows;
    return coarse_rows;
}

/// Returns true for levels at which collars are too small to be built.
bool is_far(DetailLevel level) {
    return level.lod > 2 || (level.lod == 2 && 2 * level.eighths >= DetailLevel::steps);
}

int columns_of(DetailLevel level) { return std::max(6, 2 * (detail_of(level).columns / 5)); }

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

/// Makes the mesh of a collar: a lower and an upper half of columns across the bracket, and a back.
class CollarBuilder {
  public:
    CollarBuilder(const ContactLine& contact, const Individual& individual, DetailLevel level)
        : contact_(contact),
          individual_(individual),
          rows_(rows_of(level)),
          columns_(columns_of(level)),
          size_(collar_size(individual)),
          presence_(bracket_share(individual)) {
        Random random(individual.effective.seed, purposes::bracket_base, 1);
        for (double& phase : phases_) phase = random.uniform(0.0, 2.0 * pi);
        Extent extent{individual.stem_base, individual.stem_base};
        for (const SubCurve* curve : {&individual.outline.hymenium, &individual.outline.cap})
            extent.include(*curve);
        radius_ = extent.radius;
        // A bracket that is twisted until its sides change places has none.
        presence_ *= smooth_step(0.0, least_width * std::max(radius_, 1e-9),
                                 contact.at(1.0, true).lower.x - contact.at(1.0, false).lower.x);
    }

    Mesh take() && {
        for (const bool is_upper : {false, true}) add_half(is_upper);
        add_back();
        resolve_normals();
        return std::move(mesh_);
    }

  private:
    /// Returns uneven amounts about 1 along the wall.
    [[nodiscard]] double uneven(double x, bool is_upper) const {
        const double along = x / std::max(radius_, 1e-9), shift = is_upper ? 2.0 : 0.0;
        return 1.0 + 0.3 * sine(5.3 * along + phases_[0] + shift) +
               0.22 * sine(11.9 * along + phases_[1] + 2.0 * shift) +
               0.12 * sine(27.0 * along + phases_[2] + 3.0 * shift);
    }

    [[nodiscard]] glm::dvec3 place(int column, const Row& row, bool is_upper) const {
        const double s = 2.0 * column / columns_ - 1.0, aside = std::abs(s) / (1.0 - end);
        const ContactLine::Places here = contact_.at(std::min(aside, 1.0), s > 0.0);
        const double beyond = std::max(aside - 1.0, 0.0) * (1.0 - end) / end;
        const double x = 0.5 * (here.lower.x + here.upper.x) +
                         sidewards * size_ * beyond * (s > 0.0 ? 1.0 : -1.0);
        const double middle = 0.5 * (here.lower.y + here.upper.y);
        // Where the bracket stands off the wall, the collar reaches out to it.
        const double off = std::clamp(0.5 * (here.lower.z + here.upper.z), 0.0, most_off * radius_);
        // Both halves meet in a point at either end.
        const double round = std::sqrt(std::max(1.0 - s * s * s * s, 0.0));
        const double within = std::min((1.0 - std::abs(s)) / end, 1.0);
        const double contact =
            middle + within * ((is_upper ? here.upper.y : here.lower.y) - middle);
        const double rim =
            contact + (is_upper ? upwards : -1.0) * size_ * round * uneven(x, is_upper);
        const double y = row.way <= 1.0 ? rim + row.way * (contact - rim) : middle;
        const double bumps =
            1.0 + 0.12 * sine(19.0 * (x + y) / std::max(radius_, 1e-9) + phases_[2]);
        const double z = row.height > 0.0
                             ? size_ * row.height * round * bumps + std::min(row.way, 1.0) * off
                             : size_ * row.height;
        // What is no bracket has none: it vanishes at the foot.
        const glm::dvec3 foot(0.0, individual_.stem_base, 0.0);
        return foot + presence_ * (glm::dvec3(x, y, z) - foot);
    }

    void add_half(bool is_upper) {
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size()),
                   stride = static_cast<std::uint32_t>(columns_ + 1);
        const Part part = is_upper ? Part::cap : Part::hymenium;
        const Chart& chart = swept_charts[index_of(part)];
        std::vector<double> back(static_cast<std::size_t>(columns_ + 1),
                                 is_upper ? within_bracket : below_bracket);
        mesh_.positions.resize(first + rows_.size() * stride);
        mesh_.texture_coordinates.resize(mesh_.positions.size());
        for (std::size_t row = rows_.size(); row-- > 0;)
            for (int column = 0; column <= columns_; ++column) {
                const bool is_end = column == 0 || column == columns_;
                const auto i = static_cast<std::size_t>(column), at = first + row * stride + i;
                const glm::dvec3 here = place(column, is_end ? rows_[0] : rows_[row], is_upper);
                mesh_.positions[at] = glm::vec3(here);
                // The skin goes on behind the wall as it is in front of it.
                if (row + 1 < rows_.size()) {
                    const glm::dvec3 step = here - glm::dvec3(mesh_.positions[at + stride]);
                    const double length = std::sqrt(glm::dot(step, step)) / std::max(radius_, 1e-9);
                    // What lies inside of a thick bracket takes no part of the image.
                    back[i] += row + 2 < rows_.size() ? length : std::min(length, most_inside);
                }
                const double aside =
                    (is_upper ? most_aside : most_aside_below) * (2.0 * column / columns_ - 1.0);
                const double share = std::sqrt(aside * aside + back[i] * back[i]);
                const double radius =
                    is_upper ? share : hymenium_inner_share + (1.0 - hymenium_inner_share) * share;
                const TexturePoint image =
                    disc_point(chart, std::min(radius, 0.98), aside / share, -back[i] / share);
                mesh_.texture_coordinates[at] = glm::vec2(image.u, image.v);
            }
        mesh_.normals.resize(mesh_.positions.size());
        for (std::uint32_t row = 0; row + 1 < rows_.size(); ++row)
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
    }

    [[nodiscard]] std::size_t back_indices() const {
        return 3 * (2 * static_cast<std::size_t>(columns_) - 2);
    }

    const ContactLine& contact_;
    const Individual& individual_;
    std::span<const Row> rows_;
    int columns_;
    double size_, presence_, radius_ = 0.0;  ///< of the collar, its share, and of the outline
    std::array<double, 3> phases_{};
    std::array<std::uint32_t, 2> half_begins_{};  ///< first vertices of the halves
    Mesh mesh_;
};

}  // namespace

double collar_size(const Individual& individual) {
    if (!has_collar(individual)) return 0.0;
    const Azimuth& azimuth = individual.azimuth;
    Extent extent{individual.stem_base, individual.stem_base};
    for (const SubCurve* curve : {&individual.outline.hymenium, &individual.outline.cap})
        extent.include(*curve);
    return most_size * extent.radius * bracket_share(individual) * azimuth.base /
           (azimuth.base + half_base);
}

MeshCount collar_count(const Individual& individual, DetailLevel level) {
    if (!has_collar(individual) || is_far(level)) return {};
    const auto columns = static_cast<std::uint64_t>(columns_of(level)),
               rows = static_cast<std::uint64_t>(rows_of(level).size());
    return {2 * rows * (columns + 1), (2 * (rows - 1) + 1) * (2 * columns - 2)};
}

void add_collar(Mesh& mesh, const SweptBody& body, const LowerFace* face,
                const std::vector<double>& turns, const Individual& individual, DetailLevel level,
                bool textured) {
    if (!has_collar(individual) || is_far(level)) return;
    Mesh collar = CollarBuilder({mesh, body, face, turns}, individual, level).take();
    if (textured)
        add_tangents(collar);
    else
        collar.texture_coordinates.clear();
    append(mesh, collar);
}

}  // namespace sporeprint
