#include "core/skeleton/skin.h"

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

struct Fine {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 4>>
        quads;  ///< 4^levels to each of the scaffold, in order
};

// Where the corners of its descendants lie in a quad whose corners are (0, 0), (1, 0), (1, 1), (0, 1): of its four children each
// keeps a corner, then goes on round the middle.
std::vector<std::array<glm::dvec2, 4>> descendants(int levels) {
    std::vector<std::array<glm::dvec2, 4>> places = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
    for (int level = 0; level < levels; ++level) {
        std::vector<std::array<glm::dvec2, 4>> children;
        for (const std::array<glm::dvec2, 4>& parent : places) {
            const glm::dvec2 middle = 0.25 * (parent[0] + parent[1] + parent[2] + parent[3]);
            for (std::size_t i = 0; i < 4; ++i) {
                std::array<glm::dvec2, 4> child;
                child[i] = parent[i];
                child[(i + 1) % 4] = 0.5 * (parent[i] + parent[(i + 1) % 4]);
                child[(i + 2) % 4] = middle;
                child[(i + 3) % 4] = 0.5 * (parent[i] + parent[(i + 3) % 4]);
                children.push_back(child);
            }
        }
        places = std::move(children);
    }
    return places;
}

Scaffold::Place placed(const std::array<Scaffold::Place, 4>& quad, const glm::dvec2& at) {
    const Scaffold::Place low = quad[0] + at.x * (quad[1] - quad[0]);
    const Scaffold::Place high = quad[3] + at.x * (quad[2] - quad[3]);
    return low + at.y * (high - low);
}

// Points of the next level of a closed mesh: middles of faces, of edges with their faces, and vertices drawn in by their
// neighbours. OpenSubdiv's own masks would be the same, but their headers call libm for tangents that nobody asks for.
// source [CatmullClark1978]
std::vector<glm::dvec3> refined(const Far::TopologyLevel& level,
                                const std::vector<glm::dvec3>& points) {
    const auto at = [](int index) { return static_cast<std::size_t>(index); };
    std::vector<glm::dvec3> next(
        at(level.GetNumVertices() + level.GetNumEdges() + level.GetNumFaces()));
    for (int face = 0; face < level.GetNumFaces(); ++face) {
        const Far::ConstIndexArray v = level.GetFaceVertices(face);
        next[at(level.GetFaceChildVertex(face))] =
            0.25 * (points[at(v[0])] + points[at(v[1])] + points[at(v[2])] + points[at(v[3])]);
    }
    for (int edge = 0; edge < level.GetNumEdges(); ++edge) {
        const Far::ConstIndexArray v = level.GetEdgeVertices(edge);
        const Far::ConstIndexArray f = level.GetEdgeFaces(edge);
        next[at(level.GetEdgeChildVertex(edge))] =
            0.25 * (points[at(v[0])] + points[at(v[1])] + next[at(level.GetFaceChildVertex(f[0]))] +
                    next[at(level.GetFaceChildVertex(f[1]))]);
    }
    for (int vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
        const Far::ConstIndexArray edges = level.GetVertexEdges(vertex);
        glm::dvec3 around(0.0);
        for (int i = 0; i < edges.size(); ++i) {
            const Far::ConstIndexArray v = level.GetEdgeVertices(edges[i]);
            around += points[at(v[0] == vertex ? v[1] : v[0])];
        }
        const Far::ConstIndexArray faces = level.GetVertexFaces(vertex);
        for (int i = 0; i < faces.size(); ++i)
            around += next[at(level.GetFaceChildVertex(faces[i]))];
        const double valence = edges.size();
        next[at(level.GetVertexChildVertex(vertex))] =
            ((valence - 2.0) / valence) * points[at(vertex)] + around / (valence * valence);
    }
    return next;
}

Fine subdivided(const Scaffold& coarse, int levels) {
    Fine fine;
    if (levels == 0 || coarse.quads.empty()) {
        fine.points = coarse.points;
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
    fine.points = coarse.points;
    for (int level = 1; level <= levels; ++level) {
        fine.points = refined(refiner->GetLevel(level - 1), fine.points);
    }
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
        const glm::dvec3 across = glm::cross(fine.points[quad[2]] - fine.points[quad[0]],
                                             fine.points[quad[3]] - fine.points[quad[1]]);
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
    const std::vector<std::array<glm::dvec2, 4>> inner = descendants(levels);
    const std::size_t share = inner.size();
    mesh.indices.reserve(6 * fine.quads.size());
    // The seam adds a vertex to every ring.
    const std::size_t about = fine.points.size() + fine.points.size() / 8;
    mesh.positions.reserve(about);
    mesh.normals.reserve(about);
    made.places.reserve(about);
    made.strip_of.reserve(about);
    for (std::uint32_t s = 0; s < coarse.strips.size(); ++s) {
        const Scaffold::Strip& strip = coarse.strips[s];
        for (std::size_t q = strip.first * share; q < (strip.first + strip.quads) * share; ++q) {
            std::array<std::uint32_t, 4> out{};
            for (std::size_t k = 0; k < 4; ++k) {
                const std::uint32_t point = fine.quads[q][k];
                const Scaffold::Place place = placed(coarse.places[q / share], inner[q % share][k]);
                const std::size_t side =
                    (place.x > 0.5 ? 1U : 0U) + (place.y > 0.5 * strip.length ? 2U : 0U);
                std::uint32_t& vertex = copy[side][point];
                if (vertex == unused) {
                    vertex = static_cast<std::uint32_t>(mesh.positions.size());
                    touched.emplace_back(side, point);
                    mesh.positions.emplace_back(fine.points[point]);
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
