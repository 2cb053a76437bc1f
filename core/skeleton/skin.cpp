#include "core/skeleton/skin.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/skeleton/subdivision.h"

namespace sporeprint {

namespace {

// The points and quads of one patch: the quads that descend from one coarse quad, undivided or
// divided.
struct UndividedPatch {
    static constexpr std::array<std::array<std::size_t, 4>, 1> quads = {{{0, 1, 2, 3}}};
    using Points = std::array<std::uint32_t, 4>;
    static Points points_of(const Subdivided& fine, std::size_t patch) {
        return fine.parents[patch];
    }
};
struct DividedPatch {
    static constexpr std::array<std::array<std::size_t, 4>, 4> quads = {
        {{0, 1, 2, 3}, {1, 4, 5, 2}, {2, 5, 6, 7}, {3, 2, 7, 8}}};
    using Points = std::array<std::uint32_t, 9>;
    static Points points_of(const Subdivided& fine, std::size_t patch) { return fine.patch(patch); }
};

// Returns the positions of the points of all patches of a coarse quad, whose corners are (0, 0),
// (1, 0), (1, 1), (0, 1).
using Corners = std::array<glm::dvec2, 4>;
std::vector<std::array<glm::dvec2, 9>> places_of_patches(int levels) {
    std::vector<Corners> parents = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
    std::vector<std::array<glm::dvec2, 9>> places = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
    for (int level = 0; level < levels; ++level) {
        places.clear();
        std::vector<Corners> children;
        for (const auto& [a, b, c, d] : parents) {
            places.push_back({a, 0.5 * (a + b), 0.25 * (a + b + c + d), 0.5 * (a + d), b,
                              0.5 * (b + c), c, 0.5 * (c + d), d});
            for (const auto& quad : DividedPatch::quads)
                children.push_back({places.back()[quad[0]], places.back()[quad[1]],
                                    places.back()[quad[2]], places.back()[quad[3]]});
        }
        parents = std::move(children);
    }
    return places;
}

Scaffold::Place placed(const std::array<Scaffold::Place, 4>& quad, const glm::dvec2& at) {
    const Scaffold::Place low = quad[0] + at.x * (quad[1] - quad[0]);
    const Scaffold::Place high = quad[3] + at.x * (quad[2] - quad[3]);
    return low + at.y * (high - low);
}

// The copies of points in the current strip: a point may lie on both sides of the seam along it
// and, if the strip is a closed ring, at its beginning and end.
class Copies {
  public:
    explicit Copies(std::size_t points) : last_(points, 0) {}

    void begin_strip(std::uint32_t vertices) {
        others_ = vertices;
        before_.clear();
    }

    /// Returns the vertex of a point on a side (0..3) or, if there is none yet, `vertices`, which
    /// is the next one.
    std::uint32_t find_or_add(std::uint32_t point, std::uint32_t side, std::uint32_t vertices) {
        std::uint32_t& last = last_[point];
        for (std::uint32_t copy = last; copy > 4 * others_ + 3;
             copy = before_[copy / 4 - 1 - others_])
            if (copy % 4 == side) return copy / 4 - 1;
        before_.push_back(last);
        last = 4 * (vertices + 1) + side;
        return vertices;
    }

  private:
    // A copy is encoded as four times its vertex, counted from one, plus its side.
    std::vector<std::uint32_t> last_;    // per point
    std::vector<std::uint32_t> before_;  // per vertex of the strip: the previous copy of its point
    std::uint32_t others_ = 0;           // vertices of earlier strips
};

// Returns the normal of each point, weighted by area.
template <class Patch>
std::vector<glm::dvec3> normals_of(const Subdivided& fine) {
    std::vector<glm::dvec3> normals(fine.points.size(), glm::dvec3(0.0));
    for (std::size_t patch = 0; patch < fine.parents.size(); ++patch) {
        const typename Patch::Points points = Patch::points_of(fine, patch);
        for (const auto& [a, b, c, d] : Patch::quads) {
            const glm::dvec3 across = glm::cross(fine.points[points[c]] - fine.points[points[a]],
                                                 fine.points[points[d]] - fine.points[points[b]]);
            for (const std::size_t corner : {a, b, c, d}) normals[points[corner]] += across;
        }
    }
    for (glm::dvec3& normal : normals) {
        const double size = glm::length(normal);
        if (!(size > 0.0)) throw GenerationError("a vertex of a skin has no normal");
        normal /= size;
    }
    return normals;
}

template <class Patch>
SkinnedSkeleton cut_open(const Scaffold& coarse, const Subdivided& fine, int levels,
                         SkinPlaces places) {
    const std::vector<glm::dvec3> normals = normals_of<Patch>(fine);
    const std::vector<std::array<glm::dvec2, 9>> inner = places_of_patches(levels);
    const std::size_t patches_per_quad = inner.size();
    SkinnedSkeleton made;
    made.strips = coarse.strips;
    Mesh& mesh = made.mesh;
    Copies copies(fine.points.size());
    mesh.indices.resize(6 * Patch::quads.size() * fine.parents.size());
    std::uint32_t* index = mesh.indices.data();
    // The seam adds a vertex to every ring.
    const std::size_t vertex_estimate = fine.points.size() + fine.points.size() / 8;
    mesh.positions.reserve(vertex_estimate);
    mesh.normals.reserve(vertex_estimate);
    if (places == SkinPlaces::included) made.places.reserve(vertex_estimate);
    made.labels.reserve(vertex_estimate);
    made.begins.push_back(0);
    for (const Scaffold::Strip& strip : coarse.strips) {
        copies.begin_strip(made.begins.back());
        for (std::size_t p = strip.first * patches_per_quad;
             p < (strip.first + strip.quads) * patches_per_quad; ++p) {
            typename Patch::Points vertices = Patch::points_of(fine, p);
            for (std::size_t i = 0; i < vertices.size(); ++i) {
                const std::uint32_t point = vertices[i];
                const Scaffold::Place place =
                    placed(coarse.places[p / patches_per_quad], inner[p % patches_per_quad][i]);
                const std::uint32_t side =
                    (place.x > 0.5 ? 1U : 0U) + (place.y > 0.5 * strip.length ? 2U : 0U);
                const auto next = static_cast<std::uint32_t>(mesh.positions.size());
                vertices[i] = copies.find_or_add(point, side, next);
                if (vertices[i] != next) continue;
                mesh.positions.emplace_back(fine.points[point]);
                mesh.normals.emplace_back(normals[point]);
                if (places == SkinPlaces::included) made.places.push_back(place);
                made.labels.push_back(coarse.labels[p / patches_per_quad]);
            }
            for (const auto& [a, b, c, d] : Patch::quads)
                for (const std::size_t corner : {a, b, c, a, c, d}) *index++ = vertices[corner];
        }
        made.begins.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    }
    return made;
}

}  // namespace

SkinnedSkeleton skinned(const Skeleton& clean, int levels, SkinPlaces places) {
    Scaffold coarse = scaffold(clean, levels);
    QuadMesh quads = {std::move(coarse.points), std::move(coarse.quads)};
    if (levels == 0) {
        const Subdivided same = {std::move(quads.points), std::move(quads.quads), {}, 0, 0};
        return cut_open<UndividedPatch>(coarse, same, levels, places);
    }
    return cut_open<DividedPatch>(coarse, subdivided(std::move(quads), levels), levels, places);
}

}  // namespace sporeprint
