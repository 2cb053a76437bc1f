#include "core/skeleton/skin.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

namespace sporeprint {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// What OpenSubdiv adds up. In double, so that the float of a vertex is rounded once.
struct Point {
    glm::dvec3 place{0.0};
    void Clear() { place = glm::dvec3(0.0); }
    void AddWithWeight(const Point& other, double weight) { place += weight * other.place; }
};

struct Fine {
    std::vector<Point> points;
    std::vector<std::array<std::uint32_t, 4>>
        quads;  ///< 4^levels to each of the scaffold, in order
    std::vector<std::array<Scaffold::Place, 4>> places;
};

// Corner places of the four children of a quad: each keeps its own corner, then goes on round the middle.
void add_children(const std::array<Scaffold::Place, 4>& parent,
                  std::vector<std::array<Scaffold::Place, 4>>& out) {
    const Scaffold::Place middle = 0.25 * (parent[0] + parent[1] + parent[2] + parent[3]);
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<Scaffold::Place, 4> child;
        child[i] = parent[i];
        child[(i + 1) % 4] = 0.5 * (parent[i] + parent[(i + 1) % 4]);
        child[(i + 2) % 4] = middle;
        child[(i + 3) % 4] = 0.5 * (parent[i] + parent[(i + 3) % 4]);
        out.push_back(child);
    }
}

Fine subdivided(const Scaffold& coarse, int levels) {
    Fine fine;
    fine.places = coarse.places;
    if (levels == 0 || coarse.quads.empty()) {
        for (const glm::dvec3& point : coarse.points) fine.points.push_back({point});
        fine.quads = coarse.quads;
        return fine;
    }
    std::vector<int> counts(coarse.quads.size(), 4), corners;
    corners.reserve(4 * coarse.quads.size());
    for (const auto& quad : coarse.quads)
        for (const std::uint32_t corner : quad) corners.push_back(static_cast<int>(corner));
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(coarse.points.size());
    descriptor.numFaces = static_cast<int>(coarse.quads.size());
    descriptor.numVertsPerFace = counts.data();
    descriptor.vertIndicesPerFace = corners.data();
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    const std::unique_ptr<Far::TopologyRefiner> refiner(
        Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK)));
    if (!refiner) throw GenerationError("the scaffold of a skeleton is no mesh");
    refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
    const Far::PrimvarRefiner interpolate(*refiner);
    std::vector<Point> points;
    points.reserve(coarse.points.size());
    for (const glm::dvec3& point : coarse.points) points.push_back({point});
    for (int level = 1; level <= levels; ++level) {
        std::vector<Point> next(
            static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
        interpolate.Interpolate(level, points, next);
        points = std::move(next);
        std::vector<std::array<Scaffold::Place, 4>> children;
        children.reserve(4 * fine.places.size());
        for (const auto& parent : fine.places) add_children(parent, children);
        fine.places = std::move(children);
    }
    fine.points = std::move(points);
    const Far::TopologyLevel& last = refiner->GetLevel(levels);
    fine.quads.reserve(static_cast<std::size_t>(last.GetNumFaces()));
    for (int face = 0; face < last.GetNumFaces(); ++face) {
        const Far::ConstIndexArray vertices = last.GetFaceVertices(face);
        fine.quads.push_back(
            {static_cast<std::uint32_t>(vertices[0]), static_cast<std::uint32_t>(vertices[1]),
             static_cast<std::uint32_t>(vertices[2]), static_cast<std::uint32_t>(vertices[3])});
    }
    return fine;
}

}  // namespace

SkinnedSkeleton skinned(const Skeleton& clean, int levels) {
    const Scaffold coarse = scaffold(clean, levels);
    const Fine fine = subdivided(coarse, levels);
    std::vector<glm::dvec3> normals(fine.points.size(), glm::dvec3(0.0));
    for (const auto& quad : fine.quads) {
        const glm::dvec3 across =
            glm::cross(fine.points[quad[2]].place - fine.points[quad[0]].place,
                       fine.points[quad[3]].place - fine.points[quad[1]].place);
        for (const std::uint32_t corner : quad) normals[corner] += across;
    }
    for (glm::dvec3& normal : normals) {
        const double size = glm::length(normal);
        if (!(size > 0.0)) throw GenerationError("a vertex of a skin has no normal");
        normal /= size;
    }

    SkinnedSkeleton made;
    made.strips = coarse.strips;
    Mesh& mesh = made.mesh;
    // In a strip a vertex may lie on both sides of the seam along it, and, where it is closed to a ring, at its beginning and end.
    constexpr std::uint32_t unused = 0xffffffffU;
    std::array<std::vector<std::uint32_t>, 4> copy;
    for (auto& one : copy) one.assign(fine.points.size(), unused);
    std::vector<std::pair<std::size_t, std::uint32_t>> touched;
    const std::size_t share = std::size_t{1} << static_cast<std::size_t>(2 * levels);
    mesh.indices.reserve(6 * fine.quads.size());
    for (std::uint32_t s = 0; s < coarse.strips.size(); ++s) {
        const Scaffold::Strip& strip = coarse.strips[s];
        for (std::size_t q = strip.first * share; q < (strip.first + strip.quads) * share; ++q) {
            std::array<std::uint32_t, 4> out{};
            for (std::size_t k = 0; k < 4; ++k) {
                const std::uint32_t point = fine.quads[q][k];
                const Scaffold::Place& place = fine.places[q][k];
                const std::size_t side =
                    (place.x > 0.5 ? 1U : 0U) + (place.y > 0.5 * strip.length ? 2U : 0U);
                std::uint32_t& vertex = copy[side][point];
                if (vertex == unused) {
                    vertex = static_cast<std::uint32_t>(mesh.positions.size());
                    touched.emplace_back(side, point);
                    mesh.positions.emplace_back(fine.points[point].place);
                    mesh.normals.emplace_back(normals[point]);
                    made.places.push_back(place);
                    made.strip_of.push_back(s);
                }
                out[k] = vertex;
            }
            for (const std::size_t k : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(out[k]);
        }
        for (const auto& [side, point] : touched) copy[side][point] = unused;
        touched.clear();
    }
    return made;
}

}  // namespace sporeprint
