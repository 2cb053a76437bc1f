#include "core/build/weathering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/build/detail.h"
#include "core/build/directions.h"
#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/model/marks.h"
#include "core/model/proportion.h"
#include "core/model/purposes.h"

namespace sporeprint {

namespace {

constexpr double whole_turn = 2.0 * pi;

// What a level of detail can carry.
struct Carried {
    int rolls, roll_pieces, drops, drips;
    bool lumps, furrows, pits;
};
constexpr std::array<Carried, 4> carried = {{
    {5, 14, 22, 12, true, true, true},
    {0, 0, 0, 6, true, true, false},
    {0, 0, 0, 0, true, false, false},
    {0, 0, 0, 0, false, false, false},
}};
const Carried& carried_at(int lod) { return carried[static_cast<std::size_t>(lod)]; }

constexpr int roll_sides = 5, drop_sides = 6, drip_sides = 5, drip_rows = 4;
constexpr std::uint64_t roll_vertices(int pieces) {
    return static_cast<std::uint64_t>((pieces + 1) * (roll_sides + 1) + 2);
}
constexpr std::uint64_t roll_triangles(int pieces) {
    return static_cast<std::uint64_t>(2 * pieces * roll_sides + 2 * roll_sides);
}
// Two rings, a tip and the centre of the base.
constexpr std::uint64_t drop_vertices = 2 * (drop_sides + 1) + 2;
constexpr std::uint64_t drop_triangles = 4 * drop_sides;
constexpr std::uint64_t drip_vertices = drip_rows * (drip_sides + 1) + 2;
constexpr std::uint64_t drip_triangles = 2 * (drip_rows - 1) * drip_sides + 2 * drip_sides;

// How deep a full furrow is, in radii of the stem, and how wide to each side.
constexpr double furrow_deep = 0.20, furrow_half_width = 0.045 * whole_turn;

// The upper part of a club swells between few rings: the rest of its furrows is painted.
constexpr double club_carried = 0.35;

// Depth across a furrow, 0..1.
double furrow_valley(double middle, double angle) {
    const double x = turn_between(middle, angle) / furrow_half_width;
    return x <= -1.0 || x >= 1.0 ? 0.0 : (1.0 - x * x) * (1.0 - x * x);
}

double mean_radius(const SubCurve& stem) {
    double sum = 0.0;
    for (int i = 0; i <= 16; ++i) sum += stem.at(i / 16.0).r / 17.0;
    return sum;
}

// How far from its neighbours' edges the skin of the stem may move.
double stem_freedom(double share) {
    return smooth_step(0.0, 0.06, share) * (1.0 - smooth_step(0.93, 0.995, share));
}

/// Works on the vertices of a swept body.
class Weatherer {
  public:
    Weatherer(Mesh& mesh, const SweptBody& body, const Individual& individual, const Cuts& cuts,
              int lod, bool keep_absent)
        : mesh_(mesh),
          body_(body),
          individual_(individual),
          carries_(carried_at(lod)),
          amounts_(individual.wear.amounts),
          cuts_(cuts),
          lod_(lod),
          keep_absent_(keep_absent),
          textured_(!mesh.texture_coordinates.empty()),
          columns_(cuts.turns().size()) {
        for (const double turn : cuts.turns()) turns_.push_back(sine_cosine(whole_turn * turn));
        opened_.assign(columns_ + 1, 1.0);
        even_.assign(columns_ + 1, true);
        for (const Cuts::Between& own : cuts.between()) {
            opened_[own.column] = own.open;
            even_[own.column] = false;
        }
    }

    Curl all() {
        dent();
        lay_closed();
        // What stands on the cap finds its place while the rings still stand where they were swept.
        if (individual_.wear.peels && carries_.rolls > 0) rolls();
        if (individual_.wear.dew && carries_.drops > 0) drops();
        if (!cuts_.none()) {
            for (std::size_t j = 0; j < columns_; ++j) {
                cap_ends_.push_back(cuts_.cap_end(angle(j)));
                lower_ends_.push_back(cuts_.lower_end(angle(j)));
            }
            slide(body_.hymenium);
            slide(body_.cap);
            curl();
            lay_closed();
        }
        if (cuts_.possible()) wall();
        if (individual_.wear.melts && carries_.drips > 0) drips();
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
    // The last column repeats the first.
    void close(const FaceGrid& face) {
        for (std::size_t i = 0; i < face.shares.size(); ++i) {
            const std::size_t first = at(face, i, 0), last = at(face, i, columns_);
            mesh_.positions[last] = mesh_.positions[first];
            mesh_.normals[last] = mesh_.normals[first];
            if (textured_) mesh_.tangents[last] = mesh_.tangents[first];
        }
    }

    /// The neighbour of a vertex along its ring. To an even column a column on the straight way to the next one is none.
    [[nodiscard]] glm::dvec3 beside(const FaceGrid& face, std::size_t ring, std::size_t column,
                                    bool after) const {
        const auto next = [&](std::size_t j) {
            return after ? (j + 1) % columns_ : (j == 0 ? columns_ : j) - 1;
        };
        std::size_t other = next(column);
        if (!even_[column] || even_[other]) return place(at(face, ring, other));
        glm::dvec3 found(0.0);
        double left = 1.0;
        for (; !even_[other] && left > 0.0; other = next(other)) {
            found += left * opened_[other] * place(at(face, ring, other));
            left *= 1.0 - opened_[other];
        }
        return left > 0.0 ? found + left * place(at(face, ring, other)) : found;
    }

    /// Lays columns of closed cuts onto the straight ways between those that count beside them.
    void lay_closed() {
        std::vector<Laid> laid;
        for (const FaceGrid* face : {&body_.stem, &body_.hymenium, &body_.cap})
            for (std::size_t i = 0; i < face->shares.size(); ++i) {
                laid.clear();
                for (const Cuts::Between& own : cuts_.between())
                    if (own.open < 1.0) laid.push_back(laid_on_ways(*face, i, own));
                for (const Laid& one : laid) {
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
    struct Laid {
        std::size_t vertex;
        glm::dvec3 position, normal, tangent;
        glm::dvec2 texture;
    };
    // As double, so that faces which share an edge keep it.
    [[nodiscard]] Laid laid_on_ways(const FaceGrid& face, std::size_t ring,
                                    const Cuts::Between& own) const {
        const std::size_t first = at(face, ring, 0), vertex = first + own.column;
        Laid one{vertex, own.open * place(vertex), own.open * glm::dvec3(mesh_.normals[vertex]),
                 glm::dvec3(0.0), glm::dvec2(0.0)};
        if (textured_) {
            one.tangent = own.open * glm::dvec3(mesh_.tangents[vertex]);
            one.texture = own.open * glm::dvec2(mesh_.texture_coordinates[vertex]);
        }
        for (const Cuts::Way& way : cuts_.ways(own)) {
            const double weight = (1.0 - own.open) * way.weight;
            const double to_right = weight * way.share, to_left = weight - to_right;
            const std::size_t left = first + way.left, right = first + way.right;
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

    /// Gives the vertices of a face the normals of their neighbours' places, as far as `weights` says.
    void turn_normals(const FaceGrid& face, const std::vector<double>& weights) {
        const std::size_t rings = face.shares.size();
        for (std::size_t i = 0; i < rings; ++i)
            for (std::size_t j = 0; j < columns_; ++j) {
                const double weight = weights[i * columns_ + j];
                if (weight <= 0.0) continue;
                const glm::dvec3 meridian = place(at(face, std::min(i + 1, rings - 1), j)) -
                                            place(at(face, i == 0 ? 0 : i - 1, j));
                const glm::dvec3 azimuth = beside(face, i, j, true) - beside(face, i, j, false);
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
        close(face);
    }

    /// Lumps, furrows and pits, along the normals.
    void dent() {
        const bool lumps = carries_.lumps && amounts_.bumps > 0.0;
        const bool furrowed = carries_.furrows && amounts_.creases > 0.0;
        const bool pitted = carries_.pits && amounts_.bites > 0.0;
        if (!lumps && !furrowed && !pitted) return;
        for (const bool stem : {true, false}) {
            const FaceGrid& face = stem ? body_.stem : body_.cap;
            const CurveName part = stem ? CurveName::stem : CurveName::cap;
            heights_.assign(face.shares.size() * columns_, 0.0);
            if (lumps) add_marks(face, part, MarkKind::lump, amounts_.bumps);
            if (pitted) add_marks(face, part, MarkKind::pit, amounts_.bites);
            if (furrowed && (stem || individual_.wear.clubs > 0.0)) add_furrows(face, stem);
            raise(face, stem);
        }
    }

    // How far from its neighbours' edges a face may move.
    [[nodiscard]] static double freedom(bool stem, double share) {
        return stem ? stem_freedom(share) : smooth_step(0.0, 0.08, share);
    }

    void add_marks(const FaceGrid& face, CurveName part, MarkKind kind, double amount) {
        const bool stem = part == CurveName::stem;
        const SubCurve& curve = individual_.outline.of(part);
        const double length = curve.length();
        if (length <= 0.0) return;
        const double girth = whole_turn * mean_radius(individual_.outline.stem);
        for (const Mark& mark : marks(kind, part, individual_.effective.seed)) {
            const double scale = grown(mark.onset, amount);
            if (scale <= 0.0) continue;
            const double unit = stem ? girth : length;
            const bool pit = kind == MarkKind::pit;
            const double size =
                std::max(mark.radius * (pit ? scale : 0.5 + 0.5 * scale), 1e-4) * unit;
            double height = pit ? -0.30 * size : lump_height(mark) * scale * unit;
            if (pit) height *= carried_pit(size, length, mark, curve, stem);
            const double along = size * mark.elongation;
            const double r = std::max(curve.at(stem ? mark.sigma : 1.0 - mark.sigma).r, 1e-4);
            const double x = r * cosine(mark.theta), z = r * sine(mark.theta);
            for (std::size_t i = 0; i < face.shares.size(); ++i) {
                const double sigma = stem ? face.shares[i] : 1.0 - face.shares[i];
                const double a = (sigma - mark.sigma) * length / along;
                if (a < -1.0 || a > 1.0) continue;
                const double ring = curve.at(face.shares[i]).r;
                // On the circle half-way between: right across the pole, too.
                const double mean = ring > 0.0 ? std::sqrt(r * ring) / ring : 0.0;
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

    // A pit narrower than a few rings and columns is painted only: it would be as deep as a vertex happens to stand in it.
    [[nodiscard]] double carried_pit(double size, double length, const Mark& mark,
                                     const SubCurve& curve, bool stem) const {
        const Detail& plain = details[static_cast<std::size_t>(lod_)];
        const double ring = length / ((stem ? plain.stem_rings : plain.cap_rings) - 1);
        const double round =
            whole_turn * curve.at(stem ? mark.sigma : 1.0 - mark.sigma).r / plain.columns;
        return smooth_step(2.0, 6.0, size / std::max({ring, round, 1e-6}));
    }

    void add_furrows(const FaceGrid& face, bool stem) {
        const double radius = mean_radius(individual_.outline.stem);
        for (const Furrow& furrow : furrows(individual_.effective.seed)) {
            const double scale = grown(furrow.onset, amounts_.creases);
            if (scale <= 0.0) continue;
            for (std::size_t i = 0; i < face.shares.size(); ++i) {
                const double share = face.shares[i];
                // On a club they run on over its end.
                const double sigma = stem ? share : 1.0 + share;
                const double fades =
                    stem ? 1.0 : club_carried * individual_.wear.clubs * club_fade(share);
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

    void raise(const FaceGrid& face, bool stem) {
        std::vector<double> weights(heights_.size(), 0.0);
        const double full = 0.004 * greatest_radius(individual_.outline.cap);
        const std::size_t rings = face.shares.size();
        const SubCurve& curve = individual_.outline.of(stem ? CurveName::stem : CurveName::cap);
        bool any = false;
        for (std::size_t i = 0; i < rings; ++i) {
            const double free = freedom(stem, face.shares[i]);
            const bool pole = curve.at(face.shares[i]).r <= 0.0;
            for (std::size_t j = 0; j < columns_; ++j) {
                double& height = heights_[i * columns_ + j];
                height *= free;
                if (height == 0.0) continue;
                any = true;
                const std::size_t vertex = at(face, i, pole ? 0 : j);
                const glm::dvec3 by = height * glm::dvec3(mesh_.normals[vertex]);
                mesh_.positions[at(face, i, j)] = glm::vec3(place(at(face, i, j)) + by);
            }
        }
        if (!any) return;
        close(face);
        // A vertex turns as far as its neighbours have moved.
        for (std::size_t i = 0; i < rings; ++i) {
            if (curve.at(face.shares[i]).r <= 0.0) continue;
            for (std::size_t j = 0; j < columns_; ++j) {
                double most = 0.0;
                for (const std::size_t k : {i == 0 ? i : i - 1, i, std::min(i + 1, rings - 1)})
                    for (const std::size_t l :
                         {j == 0 ? columns_ - 1 : j - 1, j, (j + 1) % columns_})
                        most = std::max(most, std::abs(heights_[k * columns_ + l]));
                weights[i * columns_ + j] = std::min(1.0, most / full);
            }
        }
        turn_normals(face, weights);
    }

    /// The place between rings k and k + 1, on a cubic through them and their neighbours: on the straight way it would depend on
    /// where the rings of a set stand.
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
                const double to =
                    cap ? 1.0 - Cuts::cap_to(1.0 - from, end) : Cuts::lower_to(from, end);
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
        close(face);
    }

    /// A melting margin rolls up and outwards.
    void curl() {
        if (amounts_.deliquescence <= 0.0) return;
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
                    const double to =
                        cap ? Cuts::cap_to(1.0 - share, end) : Cuts::lower_to(share, end);
                    const glm::dvec3 by = curl_.moved(cap, to, cap_ends_[j], lower_ends_[j], j);
                    if (by == glm::dvec3(0.0)) continue;
                    const std::size_t vertex = at(*face, i, j);
                    mesh_.positions[vertex] = glm::vec3(place(vertex) + by);
                    weights[i * columns_ + j] = curl_.turned(by);
                }
            close(*face);
            turn_normals(*face, weights);
        }
    }

    void vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& tangent,
                const glm::vec2& texture, double handedness = 1.0) {
        mesh_.positions.emplace_back(position);
        mesh_.normals.emplace_back(normal);
        if (!textured_) return;
        mesh_.texture_coordinates.push_back(texture);
        mesh_.tangents.emplace_back(glm::vec3(square_to(normal, tangent)),
                                    static_cast<float>(handedness));
    }

    void triangle(std::size_t a, std::size_t b, std::size_t c) {
        mesh_.indices.insert(mesh_.indices.end(),
                             {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                              static_cast<std::uint32_t>(c)});
    }

    /// Flesh between the cut edges of cap and lower face.
    void wall() {
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
            // Less sure of its direction the lower it is.
            const double sure = 1e3 / individual_.outline.cap.length();
            const glm::dvec3 normal =
                unit_or(1e-4 * outward + sure * sure * glm::cross(up, along), outward);
            // The chart is worn eight times round, to and fro.
            const double turns = 8.0 * (j == columns_ ? 1.0 : cuts_.turns()[here]);
            const double to = turns - 2.0 * std::floor(0.5 * turns);
            const double u = to > 1.0 ? 2.0 - to : to;
            for (const std::size_t edge : {bottom, top}) {
                const TexturePoint uv = strip_point(chart, u, edge == top ? 0.02 : 0.9);
                vertex(place(edge), normal, along, {uv.u, uv.v}, -1.0);
            }
        }
        for (std::size_t j = 0; j < columns_; ++j) {
            if (!cuts_.may_cut(j)) continue;
            // By the places themselves: a column that begins to open stands off before it is cut.
            const auto closed = [&](std::size_t k) {
                return mesh_.positions[first + 2 * k] == mesh_.positions[first + 2 * k + 1];
            };
            if (!keep_absent_ && closed(j) && closed(j + 1)) continue;
            const std::size_t bottom = first + 2 * j, top = bottom + 1;
            triangle(bottom, top, bottom + 2);
            triangle(bottom + 2, top, top + 2);
        }
    }

    /// The place of a swept face between its vertices.
    struct Spot {
        glm::dvec3 position, normal, meridian;
        glm::vec2 texture;
    };
    [[nodiscard]] Spot spot(const FaceGrid& face, double share, double turn) const {
        turn -= std::floor(turn);
        const auto column = static_cast<std::size_t>(
            std::upper_bound(cuts_.turns().begin(), cuts_.turns().end(), turn) -
            cuts_.turns().begin() - 1);
        const double next = column + 1 == columns_ ? 1.0 : cuts_.turns()[column + 1];
        const double v = (turn - cuts_.turns()[column]) / (next - cuts_.turns()[column]);
        const auto above = std::upper_bound(face.shares.begin(), face.shares.end(), share);
        const std::size_t ring = std::min(
            static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - face.shares.begin() - 1, 0)),
            face.shares.size() - 2);
        const double gap = face.shares[ring + 1] - face.shares[ring];
        const double u = gap > 0.0 ? std::clamp((share - face.shares[ring]) / gap, 0.0, 1.0) : 0.0;
        const std::size_t a = at(face, ring, column), b = a + columns_ + 1;
        const auto mixed = [&](const auto& of) {
            const auto low = of[a] + static_cast<float>(v) * (of[a + 1] - of[a]);
            const auto high = of[b] + static_cast<float>(v) * (of[b + 1] - of[b]);
            return low + static_cast<float>(u) * (high - low);
        };
        Spot spot;
        spot.position = glm::dvec3(mixed(mesh_.positions));
        spot.normal = unit_or(glm::dvec3(mixed(mesh_.normals)), glm::dvec3(mesh_.normals[a]));
        spot.meridian = square_to(spot.normal, place(b) - place(a));
        if (textured_) spot.texture = mixed(mesh_.texture_coordinates);
        return spot;
    }

    /// A closed solid of rings round a line: [row][column], the first column repeated, a point at each end.
    void solid(const std::vector<glm::dvec3>& corners, const glm::dvec3& start,
               const glm::dvec3& end, std::size_t sides, const std::vector<glm::vec2>& textures,
               const glm::dvec3& fallback, bool drawn) {
        const std::size_t rows = textures.size(), row = sides + 1;
        const auto first = mesh_.positions.size();
        std::vector<glm::dvec3> normals(rows * row + 2, glm::dvec3(0.0));
        const auto corner = [&](std::size_t i) {
            return i < rows * row ? corners[i] : i == rows * row ? start : end;
        };
        std::vector<std::array<std::size_t, 3>> faces;
        const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
            const glm::dvec3 n = glm::cross(corner(b) - corner(a), corner(c) - corner(a));
            for (const std::size_t k : {a, b, c}) normals[k] += n;
            faces.push_back({a, b, c});
        };
        for (std::size_t j = 0; j < sides; ++j) {
            add(rows * row, j + 1, j);
            for (std::size_t i = 0; i + 1 < rows; ++i) {
                const std::size_t a = i * row + j;
                add(a, a + 1, a + row);
                add(a + 1, a + row + 1, a + row);
            }
            const std::size_t a = (rows - 1) * row + j;
            add(a, a + 1, rows * row + 1);
        }
        for (std::size_t i = 0; i < rows; ++i) {
            normals[i * row] += normals[i * row + sides];
            normals[i * row + sides] = normals[i * row];
        }
        for (std::size_t i = 0; i < normals.size(); ++i)
            vertex(corner(i), unit_or(normals[i], fallback), glm::dvec3(1.0, 0.0, 0.0),
                   i < rows * row    ? textures[i / row]
                   : i == rows * row ? textures.front()
                                     : textures.back());
        if (!drawn && !keep_absent_) return;
        for (const auto& [a, b, c] : faces) triangle(first + a, first + b, first + c);
    }

    /// Skin rolled back along the border of what has peeled off.
    void rolls() {
        const double most = individual_.model.surface.scars.peel_reach;
        const double length = individual_.outline.cap.length();
        int left = carries_.rolls;
        for (const Tongue& tongue : tongues(individual_.effective.seed)) {
            if (left-- <= 0) break;
            const double scale = grown(tongue.onset, amounts_.peel) * (most > 0.0 ? 1.0 : 0.0);
            const double deep = std::min(tongue.reach * most * scale, 0.95);
            const double wide = tongue.half_width * (0.6 + 0.4 * scale);
            const auto sides = static_cast<std::size_t>(roll_sides);
            const auto pieces = static_cast<std::size_t>(carries_.roll_pieces);
            std::vector<Spot> line;
            for (std::size_t k = 0; k <= pieces; ++k) {
                const double phase =
                    pi * (0.015 + 0.97 * static_cast<double>(k) / static_cast<double>(pieces));
                const double far = 1.0 - tongue_ragged(tongue, phase / whole_turn);
                const double theta = tongue.theta + wide * far * cosine(phase);
                const double sigma =
                    std::min(1.0 - std::min(0.985, deep * far * sine(phase)), cuts_.cap_end(theta));
                line.push_back(spot(body_.cap, 1.0 - sigma, theta / whole_turn));
            }
            std::vector<glm::dvec3> corners;
            std::vector<glm::vec2> textures;
            for (std::size_t k = 0; k <= pieces; ++k) {
                const Spot& here = line[k];
                const glm::dvec3 ahead =
                    square_to(here.normal, line[std::min(k + 1, pieces)].position -
                                               line[k == 0 ? 0 : k - 1].position);
                const glm::dvec3 aside = glm::cross(here.normal, ahead);
                const double t = static_cast<double>(k) / static_cast<double>(pieces);
                // Thickest where the most skin has come up.
                const double thick = 0.024 * length * std::min(1.0, 2.5 * deep) *
                                     (0.35 + 0.65 * sine(pi * t)) *
                                     (1.0 + 0.25 * sine(17.0 * t + tongue.theta));
                for (std::size_t j = 0; j <= sides; ++j) {
                    const auto turn =
                        sine_cosine(whole_turn * static_cast<double>(j % sides) / roll_sides);
                    corners.push_back(here.position +
                                      thick * (0.45 + 0.9 * turn.sine) * here.normal +
                                      thick * turn.cosine * aside);
                }
                textures.push_back(here.texture);
            }
            solid(corners, line.front().position, line.back().position, sides, textures,
                  line.front().normal, deep > 0.0);
        }
    }

    /// Ink that gathers at the melted margin and falls.
    void drips() {
        const double length = individual_.outline.cap.length();
        for (int i = 0; i < carries_.drips; ++i) {
            Random random(individual_.effective.seed, purposes::drips,
                          static_cast<std::uint32_t>(i));
            const double round = random.symmetric();
            const double size = random.uniform(0.5, 1.0);
            const double hang = random.uniform(1.6, 4.2);
            const double scale =
                smooth_step(0.04 * i, 0.3 + 0.05 * i, amounts_.deliquescence) * size;
            const double turn = (5 * i % carries_.drips + 0.35 * round) / carries_.drips;
            const Spot edge = spot(body_.cap, 0.0, turn);
            const double thick = 0.018 * length * scale;
            const auto sides = static_cast<std::size_t>(drip_sides);
            std::vector<glm::dvec3> corners;
            std::vector<glm::vec2> textures;
            constexpr std::array<double, drip_rows> down = {0.05, 0.45, 0.75, 0.95};
            constexpr std::array<double, drip_rows> wide = {0.62, 0.42, 0.85, 0.6};
            for (std::size_t k = 0; k < drip_rows; ++k) {
                const glm::dvec3 middle =
                    edge.position - glm::dvec3(0.0, thick * hang * down[k], 0.0);
                for (std::size_t j = 0; j <= sides; ++j) {
                    const auto at_turn =
                        sine_cosine(whole_turn * static_cast<double>(j % sides) / drip_sides);
                    corners.push_back(middle + thick * wide[k] *
                                                   glm::dvec3(at_turn.cosine, 0.0, at_turn.sine));
                }
                textures.push_back(edge.texture);
            }
            solid(corners, edge.position + glm::dvec3(0.0, 0.3 * thick, 0.0),
                  edge.position - glm::dvec3(0.0, thick * hang, 0.0), sides, textures, edge.normal,
                  scale > 0.0);
        }
    }

    /// Drops of water on the cap.
    void drops() {
        const double length = individual_.outline.cap.length();
        int left = carries_.drops;
        for (const Mark& mark : marks(MarkKind::dew, CurveName::cap, individual_.effective.seed)) {
            if (left-- <= 0) break;
            const double scale = grown(mark.onset, amounts_.dew);
            const double radius = std::max(mark.radius * 1.15 * scale * length, 0.0);
            const double sigma = std::min(mark.sigma, cuts_.cap_end(mark.theta) - 0.02);
            const Spot here = spot(body_.cap, 1.0 - sigma, mark.theta / whole_turn);
            const glm::dvec3 aside = glm::cross(here.meridian, here.normal);
            const auto sides = static_cast<std::size_t>(drop_sides);
            std::vector<glm::dvec3> corners;
            for (const auto& [up, wide] : {std::array{-0.12, 1.0}, std::array{0.42, 0.78}})
                for (std::size_t j = 0; j <= sides; ++j) {
                    const auto turn =
                        sine_cosine(whole_turn * static_cast<double>(j % sides) / drop_sides);
                    corners.push_back(here.position +
                                      radius * (up * here.normal + wide * turn.cosine * aside +
                                                wide * turn.sine * here.meridian));
                }
            solid(corners, here.position - 0.2 * radius * here.normal,
                  here.position + 0.72 * radius * here.normal, sides, {here.texture, here.texture},
                  here.normal, radius > 0.0);
        }
    }

    Mesh& mesh_;
    const SweptBody& body_;
    const Individual& individual_;
    const Carried& carries_;
    const WeatheringOf<Plain>& amounts_;
    const Cuts& cuts_;
    int lod_;
    bool keep_absent_, textured_;
    std::size_t columns_;
    std::vector<double> opened_;  // by column: how far it stands at its own place
    std::vector<bool> even_;      // by column
    std::vector<double> heights_;
    std::vector<double> cap_ends_, lower_ends_;  // by column, when something is cut
    std::vector<SineCosine> turns_;
    Curl curl_;
};

}  // namespace

Curl::Curl(const Individual& individual, const Cuts& cuts, std::vector<glm::dvec3> away)
    : cuts_(&cuts),
      cap_length_(individual.outline.cap.length()),
      lower_length_(individual.outline.hymenium.length()),
      reach_(0.22 * cap_length_),
      most_(0.075 * cap_length_ * smooth_step(0.0, 0.6, individual.wear.amounts.deliquescence)),
      away_(std::move(away)) {}

double Curl::height(bool cap, double at, double cap_end, double lower_end) const {
    const double off = cap ? cap_length_ * (cap_end - at) : lower_length_ * (lower_end - at);
    // As far on both faces, or they would cross; where a face begins it stays on its neighbour, however little is left of it.
    const double whole =
        std::min(reach_, 0.95 * std::min(cap_length_ * cap_end, lower_length_ * lower_end));
    const double u = whole > 1e-9 ? std::max(0.0, 1.0 - off / whole) : 0.0;
    // The lower face stays behind a little: rings of both faces stand at places of their own, and the flesh between is thin.
    return (cap ? 1.0 : 0.75) * most_ * u * u;
}

glm::dvec3 Curl::moved(bool cap, double at, double cap_end, double lower_end,
                       std::size_t column) const {
    return height(cap, at, cap_end, lower_end) * away_[column];
}

double Curl::turned(const glm::dvec3& by) const {
    return std::min(1.0, 80.0 * std::sqrt(glm::length(by) * most_) / cap_length_);
}

glm::dvec3 Curl::moved(bool cap, double at, double angle) const {
    if (none()) return glm::dvec3(0.0);
    const double high = height(cap, at, cuts_->cap_end(angle), cuts_->lower_end(angle));
    if (high <= 0.0) return glm::dvec3(0.0);
    const std::vector<double>& turns = cuts_->turns();
    double turn = angle / whole_turn;
    turn -= std::floor(turn);
    const auto next = static_cast<std::size_t>(std::upper_bound(turns.begin(), turns.end(), turn) -
                                               turns.begin());
    const std::size_t column = next - 1, after = next == turns.size() ? 0 : next;
    const double to = after == 0 ? 1.0 : turns[after];
    const double t = (turn - turns[column]) / (to - turns[column]);
    return high * (away_[column] + t * (away_[after] - away_[column]));
}

WeatheringCount weathering_count(const Individual& individual, int lod) {
    const Carried& carries = carried_at(lod);
    WeatheringCount count;
    const Cuts cuts(individual, lod);
    count.columns = cuts.turns().size();
    const auto solids = [&](int number, std::uint64_t vertices, std::uint64_t triangles) {
        count.vertices += static_cast<std::uint64_t>(number) * vertices;
        count.triangles += static_cast<std::uint64_t>(number) * triangles;
    };
    if (cuts.possible()) {
        count.vertices += 2 * (count.columns + 1);
        count.triangles += 2 * count.columns;
    }
    if (individual.wear.peels)
        solids(carries.rolls, roll_vertices(carries.roll_pieces),
               roll_triangles(carries.roll_pieces));
    if (individual.wear.melts) solids(carries.drips, drip_vertices, drip_triangles);
    if (individual.wear.dew) solids(carries.drops, drop_vertices, drop_triangles);
    return count;
}

Curl weather(Mesh& mesh, const SweptBody& body, const Individual& individual, const Cuts& cuts,
             int lod, bool keep_absent) {
    const Wear& wear = individual.wear;
    if (!wear.any() && !wear.bites && !wear.splits && !wear.melts && !wear.peels && !wear.dew)
        return {};
    return Weatherer(mesh, body, individual, cuts, lod, keep_absent).all();
}

Dents::Dents(const Individual& individual)
    : outline_(individual.outline),
      bumps_(individual.wear.amounts.bumps),
      creases_(individual.wear.amounts.creases),
      clubs_(individual.wear.clubs) {
    const std::uint32_t seed = individual.effective.seed;
    if (bumps_ > 0.0) {
        cap_lumps_ = marks(MarkKind::lump, CurveName::cap, seed);
        stem_lumps_ = marks(MarkKind::lump, CurveName::stem, seed);
    }
    if (creases_ > 0.0) furrows_ = furrows(seed);
    if (bumps_ > 0.0 || creases_ > 0.0) radius_ = mean_radius(outline_.stem);
}

double Dents::lumps(const SubCurve& curve, const std::vector<Mark>& marks, double unit, bool stem,
                    double sigma, double angle) const {
    const double length = curve.length(), ring = curve.at(stem ? sigma : 1.0 - sigma).r;
    double height = 0.0;
    for (const Mark& mark : marks) {
        const double scale = grown(mark.onset, bumps_);
        const double size = std::max(mark.radius * (0.5 + 0.5 * scale), 1e-4) * unit;
        const double a = (sigma - mark.sigma) * length / (size * mark.elongation);
        if (scale <= 0.0 || a < -1.0 || a > 1.0) continue;
        const double r = std::max(curve.at(stem ? mark.sigma : 1.0 - mark.sigma).r, 1e-4);
        const double chord = 2.0 * sine(0.5 * turn_between(mark.theta, angle));
        const double square = a * a + r * ring * chord * chord / (size * size);
        if (square < 1.0)
            height += lump_height(mark) * scale * unit * (1.0 - square) * (1.0 - square);
    }
    return height;
}

double Dents::furrow(double sigma, double angle, bool on_stem) const {
    double deepest = 0.0;
    for (const Furrow& furrow : furrows_) {
        const double scale = grown(furrow.onset, creases_);
        if (scale <= 0.0) continue;
        deepest = std::max(deepest, (on_stem ? furrow_depth(furrow, sigma) : furrow.depth) * scale *
                                        furrow_valley(furrow_angle(furrow, sigma), angle));
    }
    return furrow_deep * radius_ * deepest;
}

double Dents::cap(double sigma, double angle) const {
    double height = 0.0;
    if (bumps_ > 0.0)
        height = lumps(outline_.cap, cap_lumps_, outline_.cap.length(), false, sigma, angle);
    if (creases_ > 0.0 && clubs_ > 0.0) {
        const double share = 1.0 - sigma;
        height -= club_carried * clubs_ * club_fade(share) * smooth_step(0.0, 0.08, share) *
                  furrow(1.0 + share, angle, false);
    }
    return height;
}

double Dents::stem(double sigma, double angle) const {
    double height = 0.0;
    if (bumps_ > 0.0)
        height = lumps(outline_.stem, stem_lumps_, whole_turn * radius_, true, sigma, angle);
    if (creases_ > 0.0) height = std::min(height, -furrow(sigma, angle, true));
    return height * stem_freedom(sigma);
}

}  // namespace sporeprint
