#include "core/skeleton/subdivision.h"

#include <utility>

#include "core/problems.h"

namespace sporeprint {

namespace {

using Index = std::uint32_t;

constexpr Index none = 0xffffffffU;

// Half-edge 4 q + k goes from corner k of quad q to the next.
constexpr Index half_edge(Index quad, Index corner) { return 4 * quad + corner % 4; }
constexpr Index quad_of(Index half) { return half / 4; }
constexpr Index corner_of(Index half) { return half % 4; }
constexpr Index before(Index half) { return half_edge(quad_of(half), corner_of(half) + 3); }

// The adjacency of a closed mesh of quads.
struct Adjacency {
    std::vector<Index> twin;   // per half-edge: the opposite one
    std::vector<Index> edge;   // per half-edge
    std::vector<Index> first;  // per edge: one of its half-edges
    std::vector<Index> start;  // per point: a half-edge that leaves it

    Adjacency(std::size_t points, std::size_t quads)
        : twin(4 * quads, none), edge(4 * quads), start(points, none) {
        first.reserve(2 * quads);
    }

    void join(Index one, Index other) {
        twin[one] = other;
        twin[other] = one;
        edge[one] = edge[other] = static_cast<Index>(first.size());
        first.push_back(one);
    }
};

Adjacency adjacency_of(const QuadMesh& mesh) {
    Adjacency adjacency(mesh.points.size(), mesh.quads.size());
    // The half-edges that leave a point form a linked list: `start`, then `later`.
    std::vector<Index> later(4 * mesh.quads.size(), none);
    for (auto half = static_cast<Index>(later.size()); half-- > 0;) {
        Index& head = adjacency.start[mesh.quads[quad_of(half)][corner_of(half)]];
        later[half] = std::exchange(head, half);
    }
    for (Index half = 0; half < later.size(); ++half) {
        if (adjacency.twin[half] != none) continue;
        const std::array<Index, 4>& quad = mesh.quads[quad_of(half)];
        const Index from = quad[corner_of(half)], to = quad[(corner_of(half) + 1) % 4];
        Index back = adjacency.start[to];
        while (back != none && (adjacency.twin[back] != none ||
                                mesh.quads[quad_of(back)][(corner_of(back) + 1) % 4] != from))
            back = later[back];
        if (back == none) throw GenerationError("a mesh to be subdivided is not closed");
        adjacency.join(half, back);
    }
    return adjacency;
}

// Returns the adjacency of the subdivided mesh, whose points are ordered: old points, face points,
// edge points.
Adjacency subdivided_adjacency(const Adjacency& coarse, std::size_t points, std::size_t quads) {
    Adjacency fine(points + quads + coarse.first.size(), 4 * quads);
    Index made = 0;
    for (std::size_t point = 0; point < points; ++point) {
        const Index half = coarse.start[point];
        fine.start[made++] = half_edge(half, corner_of(half));
    }
    for (Index quad = 0; quad < quads; ++quad) {
        fine.start[made++] = half_edge(4 * quad, 2);
        for (Index k = 0; k < 4; ++k)
            fine.join(half_edge(4 * quad + k, k + 1), half_edge(half_edge(quad, k + 1), k + 3));
    }
    for (const Index half : coarse.first) {
        const Index twin = coarse.twin[half];
        const Index k = corner_of(half), j = corner_of(twin);
        const Index onwards = half_edge(half_edge(quad_of(half), k + 1), k);
        fine.start[made++] = onwards;
        fine.join(half_edge(half, k), half_edge(half_edge(quad_of(twin), j + 1), j));
        fine.join(onwards, half_edge(twin, j));
    }
    return fine;
}

// Returns the smoothed old points, the face points and the edge points.
std::vector<glm::dvec3> subdivided_points(const QuadMesh& mesh, const Adjacency& adjacency) {
    const std::size_t points = mesh.points.size(), quads = mesh.quads.size();
    std::vector<glm::dvec3> next(points + quads + adjacency.first.size());
    const glm::dvec3* old = mesh.points.data();
    glm::dvec3* face_points = next.data() + points;
    for (std::size_t q = 0; q < quads; ++q) {
        const std::array<Index, 4>& v = mesh.quads[q];
        face_points[q] = 0.25 * (old[v[0]] + old[v[1]] + old[v[2]] + old[v[3]]);
    }
    glm::dvec3* along = face_points + quads;
    for (const Index half : adjacency.first) {
        const std::array<Index, 4>& v = mesh.quads[quad_of(half)];
        const Index k = corner_of(half);
        *along++ = 0.25 * (old[v[k]] + old[v[(k + 1) % 4]] + face_points[quad_of(half)] +
                           face_points[quad_of(adjacency.twin[half])]);
    }
    for (std::size_t point = 0; point < points; ++point) {
        const Index start = adjacency.start[point];
        if (start == none) throw GenerationError("a point to be subdivided has no quad");
        glm::dvec3 around(0.0);
        double valence = 0.0;
        Index half = start;
        do {
            around += old[mesh.quads[quad_of(half)][(corner_of(half) + 1) % 4]];
            valence += 1.0;
            half = adjacency.twin[before(half)];
        } while (half != start);
        do {
            around += face_points[quad_of(half)];
            half = adjacency.twin[before(half)];
        } while (half != start);
        next[point] = ((valence - 2.0) / valence) * old[point] + around / (valence * valence);
    }
    return next;
}

std::vector<std::array<Index, 4>> children(const QuadMesh& mesh, const Adjacency& adjacency) {
    std::vector<std::array<Index, 4>> quads(4 * mesh.quads.size());
    const auto face_point_base = static_cast<Index>(mesh.points.size());
    const auto edge_point_base = static_cast<Index>(face_point_base + mesh.quads.size());
    for (Index q = 0; q < mesh.quads.size(); ++q)
        for (Index k = 0; k < 4; ++k) {
            std::array<Index, 4>& child = quads[half_edge(q, k)];
            child[k] = mesh.quads[q][k];
            child[(k + 1) % 4] = edge_point_base + adjacency.edge[half_edge(q, k)];
            child[(k + 2) % 4] = face_point_base + q;
            child[(k + 3) % 4] = edge_point_base + adjacency.edge[half_edge(q, k + 3)];
        }
    return quads;
}

}  // namespace

Subdivided subdivided(QuadMesh coarse, int levels) {
    Adjacency adjacency = adjacency_of(coarse);
    for (int level = 1; level < levels; ++level) {
        QuadMesh fine{subdivided_points(coarse, adjacency), children(coarse, adjacency)};
        adjacency = subdivided_adjacency(adjacency, coarse.points.size(), coarse.quads.size());
        coarse = std::move(fine);
    }
    const auto first_face_point = static_cast<Index>(coarse.points.size());
    const auto first_edge_point = static_cast<Index>(first_face_point + coarse.quads.size());
    return {subdivided_points(coarse, adjacency), std::move(coarse.quads),
            std::move(adjacency.edge), first_face_point, first_edge_point};
}

}  // namespace sporeprint
