#include "core/geometry/weathering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/geometry/append.h"
#include "core/geometry/damage_dents.h"
#include "core/geometry/damage_solids.h"
#include "core/individual/damage.h"
#include "core/individual/proportion.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/mesh/detail.h"

namespace sporeprint {

namespace {

constexpr double whole_turn = 2.0 * pi;

// Kinds of dents at a level of detail.
struct LodLimits {
    bool lumps, furrows, pits;
};
constexpr std::array<LodLimits, 4> limits_by_lod = {
    {{true, true, true}, {true, true, false}, {true, false, false}, {false, false, false}}};
const LodLimits& limits_at(DetailLevel level) { return at_level(limits_by_lod, level); }

/// Applies weathering to the vertices of a swept body.
class Weatherer {
  public:
    Weatherer(Mesh& mesh, const SweptBody& body, const Individual& individual,
              const MarginCuts& cuts, DetailLevel level, bool keep_absent)
        : mesh_(mesh),
          body_(body),
          individual_(individual),
          limits_(limits_at(level)),
          amounts_(individual.damage.amounts),
          cuts_(cuts),
          level_(level),
          keep_absent_(keep_absent),
          textured_(!mesh.texture_coordinates.empty()),
          columns_(cuts.turns().size()),
          solids_(mesh, body.cap, individual, cuts, level, keep_absent) {
        for (const double turn : cuts.turns()) turns_.push_back(sine_cosine(whole_turn * turn));
        openness_.assign(columns_ + 1, 1.0);
        even_.assign(columns_ + 1, true);
        for (const MarginCuts::InsertedColumn& column : cuts.inserted_columns()) {
            openness_[column.column] = column.open;
            even_[column.column] = false;
        }
    }

    Curl run() {
        dent();
        collapse_closed_columns();
        // Solids on the cap are placed while the rings are still where they were swept.
        solids_.add_rolls();
        solids_.add_drops();
        if (!cuts_.none()) {
            for (std::size_t j = 0; j < columns_; ++j) {
                cap_ends_.push_back(cuts_.cap_end(angle(j)));
                lower_ends_.push_back(cuts_.lower_end(angle(j)));
            }
            slide(body_.hymenium);
            slide(body_.cap);
            curl();
            collapse_closed_columns();
        }
        if (cuts_.possible()) add_walls();
        solids_.add_drips();
        return std::move(curl_);
    }

  private:
    [[nodiscard]] std::size_t at(const FaceGrid& face, std::size_t ring, std::size_t column) const {
        return face.first + ring * (columns_ + 1) + column;
    }
    [[nodiscard]] double angle(std::size_t column) const {
        return column == columns_ ? 0.0 : whole_turn * cuts_.turns()[column];
    }
    [[nodiscard]] glm::dvec3 place(std::size_t vertex) const {
        return glm::dvec3(mesh_.positions[vertex]);
    }
    // Copies the first column to the last, which repeats it.
    void copy_seam(const FaceGrid& face) {
        for (std::size_t i = 0; i < face.shares.size(); ++i) {
            const std::size_t first = at(face, i, 0), last = at(face, i, columns_);
            mesh_.positions[last] = mesh_.positions[first];
            mesh_.normals[last] = mesh_.normals[first];
            if (textured_) mesh_.tangents[last] = mesh_.tangents[first];
        }
    }

    /// Returns the neighbour of a vertex along its ring. Columns collapsed onto a chord do not
    /// count as neighbours of an even column.
    [[nodiscard]] glm::dvec3 ring_neighbour(const FaceGrid& face, std::size_t ring,
                                            std::size_t column, bool after) const {
        const auto next = [&](std::size_t j) {
            return after ? (j + 1) % columns_ : (j == 0 ? columns_ : j) - 1;
        };
        std::size_t other = next(column);
        if (!even_[column] || even_[other]) return place(at(face, ring, other));
        glm::dvec3 found(0.0);
        double left = 1.0;
        for (; !even_[other] && left > 0.0; other = next(other)) {
            found += left * openness_[other] * place(at(face, ring, other));
            left *= 1.0 - openness_[other];
        }
        return left > 0.0 ? found + left * place(at(face, ring, other)) : found;
    }

    /// Collapses the columns of closed cuts onto the chords between their active neighbours, next
    /// to the left ends.
    void collapse_closed_columns() {
        std::vector<CollapsedVertex> collapsed_vertices;
        for (const FaceGrid* face : {&body_.stem, &body_.hymenium, &body_.cap})
            for (std::size_t i = 0; i < face->shares.size(); ++i) {
                collapsed_vertices.clear();
                for (const MarginCuts::InsertedColumn& column : cuts_.inserted_columns())
                    if (column.open < 1.0)
                        collapsed_vertices.push_back(collapsed(*face, i, column));
                for (const CollapsedVertex& one : collapsed_vertices) {
                    mesh_.positions[one.vertex] = glm::vec3(one.position);
                    mesh_.normals[one.vertex] = glm::vec3(one.normal);
                    if (!textured_) continue;
                    mesh_.texture_coordinates[one.vertex] = glm::vec2(one.texture);
                    mesh_.tangents[one.vertex] =
                        glm::vec4(glm::vec3(square_to(one.normal, one.tangent)),
                                  mesh_.tangents[one.vertex].w);
                }
            }
    }
    struct CollapsedVertex {
        std::size_t vertex;
        glm::dvec3 position, normal, tangent;
        glm::dvec2 texture;
    };
    // Computed in double precision, so that faces which share an edge get identical positions
    // there.
    [[nodiscard]] CollapsedVertex collapsed(const FaceGrid& face, std::size_t ring,
                                            const MarginCuts::InsertedColumn& column) const {
        const std::size_t first = at(face, ring, 0), vertex = first + column.column;
        CollapsedVertex one{vertex, column.open * place(vertex),
                            column.open * glm::dvec3(mesh_.normals[vertex]), glm::dvec3(0.0),
                            glm::dvec2(0.0)};
        if (textured_) {
            one.tangent = column.open * glm::dvec3(mesh_.tangents[vertex]);
            one.texture = column.open * glm::dvec2(mesh_.texture_coordinates[vertex]);
        }
        for (const MarginCuts::Chord& chord : cuts_.chords(column)) {
            const double weight = (1.0 - column.open) * chord.weight;
            const double to_right = weight * MarginCuts::collapsed_width * chord.share,
                         to_left = weight - to_right;
            const std::size_t left = first + chord.left, right = first + chord.right;
            one.position += to_left * place(left) + to_right * place(right);
            one.normal += to_left * glm::dvec3(mesh_.normals[left]) +
                          to_right * glm::dvec3(mesh_.normals[right]);
            if (!textured_) continue;
            one.tangent += to_left * glm::dvec3(mesh_.tangents[left]) +
                           to_right * glm::dvec3(mesh_.tangents[right]);
            one.texture += to_left * glm::dvec2(mesh_.texture_coordinates[left]) +
                           to_right * glm::dvec2(mesh_.texture_coordinates[right]);
        }
        one.normal = unit_or(one.normal, glm::dvec3(mesh_.normals[vertex]));
        return one;
    }

    /// Blends the normals of a face with those recomputed from neighbouring vertices, by `weights`.
    void update_normals(const FaceGrid& face, const std::vector<double>& weights) {
        const std::size_t rings = face.shares.size();
        for (std::size_t i = 0; i < rings; ++i)
            for (std::size_t j = 0; j < columns_; ++j) {
                const double weight = weights[i * columns_ + j];
                if (weight <= 0.0) continue;
                const glm::dvec3 meridian = place(at(face, std::min(i + 1, rings - 1), j)) -
                                            place(at(face, i == 0 ? 0 : i - 1, j));
                const glm::dvec3 azimuth =
                    ring_neighbour(face, i, j, true) - ring_neighbour(face, i, j, false);
                const std::size_t vertex = at(face, i, j);
                const glm::dvec3 old(mesh_.normals[vertex]);
                glm::dvec3 found = unit_or(glm::cross(meridian, azimuth), old);
                if (glm::dot(found, old) <= 0.0) continue;
                const glm::dvec3 normal = unit_or(old + weight * (found - old), old);
                mesh_.normals[vertex] = glm::vec3(normal);
                if (textured_) {
                    const glm::vec4 tangent = mesh_.tangents[vertex];
                    mesh_.tangents[vertex] =
                        glm::vec4(glm::vec3(square_to(normal, glm::dvec3(tangent))), tangent.w);
                }
            }
        copy_seam(face);
    }

    /// Displaces the body along its normals by lumps, furrows and pits.
    void dent() {
        const bool lumps = limits_.lumps && amounts_.bumps > 0.0;
        const bool furrowed = limits_.furrows && amounts_.creases > 0.0;
        const bool pitted = limits_.pits && amounts_.bites > 0.0;
        if (!lumps && !furrowed && !pitted) return;
        SeedShares shares = damage_shares(individual_);
        std::erase_if(shares, [](const SeedShare& share) { return share.weight <= 0.0; });
        for (const bool stem : {true, false}) {
            const FaceGrid& face = stem ? body_.stem : body_.cap;
            const CurveName part = stem ? CurveName::stem : CurveName::cap;
            heights_.assign(face.shares.size() * columns_, 0.0);
            for (const SeedShare& share : shares) {
                if (lumps) add_spots(face, part, DamageSpotKind::lump, amounts_.bumps, share);
                if (pitted) add_spots(face, part, DamageSpotKind::pit, amounts_.bites, share);
            }
            for (const SeedShare& share : shares)
                if (furrowed && (stem || individual_.damage.clubs > 0.0))
                    add_furrows(face, stem, share);
            raise(face, stem);
        }
    }

    // Returns true for the radius of a ring that is a point, however it was rounded.
    [[nodiscard]] static bool is_pole(double radius) { return radius < 1e-12; }

    // Returns how far a face may be displaced at a share: 0 at edges shared with other faces.
    [[nodiscard]] static double freedom(bool stem, double share) {
        return stem ? stem_freedom(share) : smooth_step(0.0, 0.08, share);
    }

    void add_spots(const FaceGrid& face, CurveName part, DamageSpotKind kind, double amount,
                   const SeedShare& share) {
        const bool stem = part == CurveName::stem;
        const SubCurve& curve = individual_.outline.of(part);
        const double length = curve.length();
        if (length <= 0.0) return;
        const double girth = whole_turn * mean_radius(individual_.outline.stem);
        for (const DamageSpot& spot : damage_spots(kind, part, share.seed)) {
            const double scale = grown(spot.onset, amount);
            if (scale <= 0.0) continue;
            const double unit = stem ? girth : length;
            const bool pit = kind == DamageSpotKind::pit;
            const double size = std::max(spot.radius * faded_in_size(scale), 1e-4) * unit;
            double height = share.weight * (pit ? -0.30 * size * pit_depth(scale)
                                                : lump_height(spot) * scale * unit);
            if (pit) height *= carried_pit(size, length, spot, curve, stem);
            const double along = size * spot.elongation;
            const double r = std::max(curve.at(stem ? spot.sigma : 1.0 - spot.sigma).r, 1e-4);
            const double x = r * cosine(spot.theta), z = r * sine(spot.theta);
            for (std::size_t i = 0; i < face.shares.size(); ++i) {
                const double sigma = stem ? face.shares[i] : 1.0 - face.shares[i];
                const double a = (sigma - spot.sigma) * length / along;
                if (a < -1.0 || a > 1.0) continue;
                const double ring = curve.at(face.shares[i]).r;
                // Distance on the circle of the mean radius, so that it also holds across the pole.
                const double mean = is_pole(ring) ? 0.0 : std::sqrt(r * ring) / ring;
                for (std::size_t j = 0; j < columns_; ++j) {
                    const double dx = mean * ring * turns_[j].cosine - x,
                                 dz = mean * ring * turns_[j].sine - z;
                    const double square = a * a + (dx * dx + dz * dz) / (size * size);
                    if (square >= 1.0) continue;
                    const double inside = 1.0 - square;
                    heights_[i * columns_ + j] +=
                        pit ? height * (1.0 - smooth_step(0.45, 1.0, std::sqrt(square)))
                            : height * inside * inside;
                }
            }
        }
    }

    // A pit narrower than a few rings and columns is only painted: its depth would depend on which
    // vertex happens to lie in it.
    [[nodiscard]] double carried_pit(double size, double length, const DamageSpot& spot,
                                     const SubCurve& curve, bool stem) const {
        const Detail& detail = detail_of(level_);
        const double ring = length / ((stem ? detail.stem_rings : detail.cap_rings) - 1);
        const double round =
            whole_turn * curve.at(stem ? spot.sigma : 1.0 - spot.sigma).r / detail.columns;
        return smooth_step(2.0, 6.0, size / std::max({ring, round, 1e-6}));
    }

    void add_furrows(const FaceGrid& face, bool stem, const SeedShare& species) {
        const double radius = mean_radius(individual_.outline.stem);
        for (const Furrow& furrow : furrows(species.seed)) {
            const double scale = species.weight * grown(furrow.onset, amounts_.creases);
            if (scale <= 0.0) continue;
            for (std::size_t i = 0; i < face.shares.size(); ++i) {
                const double share = face.shares[i];
                // On a club, furrows continue over its end.
                const double sigma = stem ? share : 1.0 + share;
                const double fades =
                    stem ? 1.0 : club_carried * individual_.damage.clubs * club_fade(share);
                const double deep = furrow_deep * radius * scale * fades *
                                    (stem ? furrow_depth(furrow, sigma) : furrow.depth);
                if (deep <= 0.0) continue;
                const double middle = furrow_angle(furrow, sigma);
                for (std::size_t j = 0; j < columns_; ++j) {
                    const double valley = furrow_valley(middle, angle(j));
                    if (valley <= 0.0) continue;
                    double& height = heights_[i * columns_ + j];
                    height = std::min(height, -deep * valley);
                }
            }
        }
    }

    /// Returns the direction in which a vertex is displaced: that of the normals of its ring and the
    /// rings beside it. A normal alone turns at once where a ridge of relief passes its vertex.
    [[nodiscard]] glm::dvec3 direction(const FaceGrid& face, std::size_t ring,
                                       std::size_t column) const {
        const auto normal = [&](std::size_t i) {
            return glm::dvec3(mesh_.normals[at(face, i, column)]);
        };
        const glm::dvec3 own = normal(ring);
        if (ring == 0 || ring + 1 == face.shares.size()) return own;
        return unit_or(normal(ring - 1) + own + normal(ring + 1), own);
    }

    void raise(const FaceGrid& face, bool stem) {
        std::vector<double> weights(heights_.size(), 0.0);
        const double full = 0.004 * greatest_radius(individual_.outline.cap);
        const std::size_t rings = face.shares.size();
        const SubCurve& curve = individual_.outline.of(stem ? CurveName::stem : CurveName::cap);
        bool any = false;
        for (std::size_t i = 0; i < rings; ++i) {
            const double free = freedom(stem, face.shares[i]);
            const bool pole = is_pole(curve.at(face.shares[i]).r);
            for (std::size_t j = 0; j < columns_; ++j) {
                double& height = heights_[i * columns_ + j];
                // All columns of a pole are one point.
                height = pole && j > 0 ? heights_[i * columns_] : height * free;
                if (height == 0.0) continue;
                any = true;
                const glm::dvec3 by = height * direction(face, i, pole ? 0 : j);
                mesh_.positions[at(face, i, j)] = glm::vec3(place(at(face, i, j)) + by);
            }
        }
        if (!any) return;
        copy_seam(face);
        // The weight of a new normal follows the largest displacement among the neighbours.
        for (std::size_t i = 0; i < rings; ++i) {
            if (is_pole(curve.at(face.shares[i]).r)) continue;
            for (std::size_t j = 0; j < columns_; ++j) {
                double most = 0.0;
                for (const std::size_t k : {i == 0 ? i : i - 1, i, std::min(i + 1, rings - 1)})
                    for (const std::size_t l :
                         {j == 0 ? columns_ - 1 : j - 1, j, (j + 1) % columns_})
                        most = std::max(most, std::abs(heights_[k * columns_ + l]));
                weights[i * columns_ + j] = std::min(1.0, most / full);
            }
        }
        update_normals(face, weights);
    }

    /// Returns the point between rings k and k + 1 on a cubic through them and their neighbours.
    /// With linear interpolation it would depend on where the rings of a set are.
    static glm::vec3 along_meridian(const std::vector<glm::vec3>& places,
                                    const std::vector<double>& shares, std::size_t k, double t) {
        const auto slope = [&](std::size_t i) {
            return (glm::dvec3(places[i + 1]) - glm::dvec3(places[i])) /
                   std::max(shares[i + 1] - shares[i], 1e-9);
        };
        const auto velocity = [&](std::size_t i) {
            if (i == 0) return slope(0);
            if (i + 1 == places.size()) return slope(i - 1);
            const double before = shares[i] - shares[i - 1], after = shares[i + 1] - shares[i];
            return (after * slope(i - 1) + before * slope(i)) / std::max(before + after, 1e-9);
        };
        const double gap = shares[k + 1] - shares[k], s = 1.0 - t;
        const glm::dvec3 a(places[k]), b(places[k + 1]);
        return glm::vec3(s * s * (1.0 + 2.0 * t) * a + t * t * (1.0 + 2.0 * s) * b +
                         gap * s * t * (s * velocity(k) - t * velocity(k + 1)));
    }

    /// Moves the vertices of a face along their columns to where the cuts leave it.
    void slide(const FaceGrid& face) {
        const bool cap = face.part == Part::cap;
        const std::size_t rings = face.shares.size();
        std::vector<glm::vec3> positions(rings), normals(rings);
        std::vector<glm::vec4> tangents(rings);
        std::vector<glm::vec2> textures(rings);
        for (std::size_t j = 0; j <= columns_; ++j) {
            const double end = (cap ? cap_ends_ : lower_ends_)[j % columns_];
            if (end >= 1.0) continue;
            for (std::size_t i = 0; i < rings; ++i) {
                const std::size_t vertex = at(face, i, j);
                positions[i] = mesh_.positions[vertex];
                normals[i] = mesh_.normals[vertex];
                if (textured_) {
                    tangents[i] = mesh_.tangents[vertex];
                    textures[i] = mesh_.texture_coordinates[vertex];
                }
            }
            std::size_t k = 0;
            for (std::size_t i = 0; i < rings; ++i) {
                const double from = face.shares[i];
                const double to = cap ? 1.0 - MarginCuts::cap_to(1.0 - from, end)
                                      : MarginCuts::lower_to(from, end);
                if (to == from) continue;
                while (k > 0 && face.shares[k] > to) --k;
                while (k + 2 < rings && face.shares[k + 1] < to) ++k;
                const double gap = face.shares[k + 1] - face.shares[k];
                const double t =
                    gap > 0.0 ? std::clamp((to - face.shares[k]) / gap, 0.0, 1.0) : 0.0;
                const auto between = [t](const auto& a, const auto& b) {
                    return a + static_cast<float>(t) * (b - a);
                };
                const std::size_t vertex = at(face, i, j);
                mesh_.positions[vertex] = along_meridian(positions, face.shares, k, t);
                const glm::dvec3 normal = unit_or(glm::dvec3(between(normals[k], normals[k + 1])),
                                                  glm::dvec3(normals[k]));
                mesh_.normals[vertex] = glm::vec3(normal);
                if (!textured_) continue;
                mesh_.texture_coordinates[vertex] = between(textures[k], textures[k + 1]);
                mesh_.tangents[vertex] = glm::vec4(
                    glm::vec3(square_to(normal, glm::dvec3(between(tangents[k], tangents[k + 1])))),
                    tangents[k].w);
            }
        }
        copy_seam(face);
    }

    /// Displaces a deliquescing margin, which rolls up and outwards, and the lips of splits.
    void curl() {
        if (amounts_.deliquescence <= 0.0 && amounts_.splits <= 0.0) return;
        std::vector<glm::dvec3> away(columns_);
        for (std::size_t j = 0; j < columns_; ++j)
            away[j] = glm::dvec3(mesh_.normals[at(body_.cap, 0, j)]);
        curl_ = Curl(individual_, cuts_, std::move(away));
        for (const FaceGrid* face : {&body_.hymenium, &body_.cap}) {
            const bool cap = face->part == Part::cap;
            std::vector<double> weights(face->shares.size() * columns_, 0.0);
            for (std::size_t i = 0; i < face->shares.size(); ++i)
                for (std::size_t j = 0; j < columns_; ++j) {
                    const double share = face->shares[i];
                    const double end = (cap ? cap_ends_ : lower_ends_)[j];
                    const double to = cap ? MarginCuts::cap_to(1.0 - share, end)
                                          : MarginCuts::lower_to(share, end);
                    const glm::dvec3 by = curl_.moved(cap, to, cap_ends_[j], lower_ends_[j], j);
                    if (by == glm::dvec3(0.0)) continue;
                    const std::size_t vertex = at(*face, i, j);
                    mesh_.positions[vertex] = glm::vec3(place(vertex) + by);
                    weights[i * columns_ + j] = curl_.turned(by);
                }
            copy_seam(*face);
            update_normals(*face, weights);
        }
    }

    /// Appends walls of flesh between the cut edges of cap and lower face.
    void add_walls() {
        const std::size_t last = body_.hymenium.shares.size() - 1;
        const auto first = mesh_.positions.size();
        constexpr const Chart& chart = swept_charts[static_cast<std::size_t>(Part::flesh)];
        for (std::size_t j = 0; j <= columns_; ++j) {
            const std::size_t here = j % columns_, before = (here + columns_ - 1) % columns_,
                              after = (here + 1) % columns_;
            const std::size_t top = at(body_.cap, 0, here), bottom = at(body_.hymenium, last, here);
            const glm::dvec3 along =
                place(at(body_.cap, 0, after)) + place(at(body_.hymenium, last, after)) -
                place(at(body_.cap, 0, before)) - place(at(body_.hymenium, last, before));
            const glm::dvec3 up = place(top) - place(bottom);
            const glm::dvec3 outward =
                unit_or(glm::dvec3(mesh_.normals[top]) + glm::dvec3(mesh_.normals[bottom]),
                        glm::dvec3(mesh_.normals[top]));
            // The lower the wall, the less reliable its cross product; the outward normal takes
            // over.
            const double sure = 1e3 / individual_.outline.cap.length();
            const glm::dvec3 normal =
                unit_or(1e-4 * outward + sure * sure * glm::cross(up, along), outward);
            // The chart is repeated eight times round the margin, mirrored every other time.
            const double turns = 8.0 * (j == columns_ ? 1.0 : cuts_.turns()[here]);
            const double to = turns - 2.0 * std::floor(0.5 * turns);
            const double u = to > 1.0 ? 2.0 - to : to;
            for (const std::size_t edge : {bottom, top}) {
                const TexturePoint uv = strip_point(chart, u, edge == top ? 0.02 : 0.9);
                append_vertex(mesh_, textured_, place(edge), normal, along, {uv.u, uv.v}, -1.0);
            }
        }
        for (std::size_t j = 0; j < columns_; ++j) {
            if (!cuts_.may_cut(j)) continue;
            // Compared by position: a column that begins to open leaves its chord before it is cut.
            const auto closed = [&](std::size_t k) {
                return mesh_.positions[first + 2 * k] == mesh_.positions[first + 2 * k + 1];
            };
            if (!keep_absent_ && closed(j) && closed(j + 1)) continue;
            const std::size_t bottom = first + 2 * j, top = bottom + 1;
            append_triangle(mesh_, bottom, top, bottom + 2);
            append_triangle(mesh_, bottom + 2, top, top + 2);
        }
    }

    Mesh& mesh_;
    const SweptBody& body_;
    const Individual& individual_;
    const LodLimits& limits_;
    const WeatheringOf<Plain>& amounts_;
    const MarginCuts& cuts_;
    DetailLevel level_;
    bool keep_absent_, textured_;
    std::size_t columns_;
    DamageSolids solids_;
    std::vector<double> openness_;  // per column: 1 at its own place, 0 collapsed onto its chords
    std::vector<bool> even_;        // per column
    std::vector<double> heights_;
    std::vector<double> cap_ends_, lower_ends_;  // per column, when something is cut
    std::vector<SineCosine> turns_;
    Curl curl_;
};

}  // namespace

WeatheringCount weathering_count(const Individual& individual, DetailLevel level) {
    WeatheringCount count;
    const MarginCuts cuts(individual, level);
    count.columns = cuts.turns().size();
    if (cuts.possible()) {
        count.vertices += 2 * (count.columns + 1);
        count.triangles += 2 * count.columns;
    }
    const MeshCount solids = damage_solid_count(individual, level);
    count.vertices += solids.vertices;
    count.triangles += solids.triangles;
    return count;
}

Curl weather(Mesh& mesh, const SweptBody& body, const Individual& individual,
             const MarginCuts& cuts, DetailLevel level, bool keep_absent) {
    const DamageAmounts& damage = individual.damage;
    if (!damage.any() && !damage.bites && !damage.splits && !damage.melts && !damage.peels &&
        !damage.dew)
        return {};
    return Weatherer(mesh, body, individual, cuts, level, keep_absent).run();
}

}  // namespace sporeprint
