#include "core/geometry/branch_deformation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry/axis.h"
#include "core/geometry/free_form.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t none = BranchGraph::none;

/// Limit of curvature of the bent axis times the reach of the graph: at 1 the segments on the inner
/// side would meet.
constexpr double most_fold = 0.75;

/// Share of the largest bend that is suggested when a bend is refused.
constexpr double suggested_bend = 0.97;

/// Dents of a graph for `imperfection` 1: number, least height of their centres, sizes in reaches
/// and least reach in heights of the graph, distance of their centres from the axis in reaches, and
/// depth, reach and vertical part of their displacement in sizes.
constexpr std::uint32_t dent_count = 9;
constexpr double lowest_dent = 0.35, least_dent = 0.7, most_dent = 1.2, least_reach = 0.3,
                 dent_distance = 0.7, dent_depth = 0.08, dent_reach = 1.6, dent_slope = 0.7;

/// Returns the bent and leaning axis of a branch graph.
///
/// throws  Impossible if the graph would be bent through itself
Axis bent_axis(const BranchGraph& graph, const DeformationOf<Plain>& deformation,
               const AxisAngles& angles) {
    Axis axis(AxisCurve(), deformation, angles, 0.0, graph.height);
    const double fold = axis.greatest_curvature() * graph.reach;
    if (fold >= most_fold)
        throw Impossible(
            "/deformation/bend_deg",
            number_text(deformation.bend_deg) + " bends this bush through itself; about " +
                number_text(
                    std::floor(suggested_bend * most_fold * deformation.bend_deg / fold * 10.0) /
                    10.0) +
                " is the most over this zone");
    return axis;
}

std::vector<FreeForm> dents_of(const BranchGraph& graph, double imperfection, std::uint32_t seed) {
    std::vector<FreeForm> dents;
    if (!(imperfection > 0.0)) return dents;
    for (std::uint32_t i = 0; i < dent_count; ++i) {
        Random place(seed, purposes::dents, i);
        const double angle = place.uniform(0.0, 2.0 * pi), high = place.uniform(lowest_dent, 1.0);
        const double strength = place.symmetric(), width = place.uniform(least_dent, most_dent);
        const double down = place.symmetric();
        const auto [s, c] = sine_cosine(angle);
        const double size = width * std::max(graph.reach, least_reach * graph.height);
        const glm::dvec3 out(c, dent_slope * down, s);
        dents.push_back(dent(glm::dvec3(dent_distance * graph.reach * c, high * graph.height,
                                        dent_distance * graph.reach * s),
                             glm::dvec3(dent_reach * size),
                             dent_depth * imperfection * strength * size * out));
    }
    return dents;
}

}  // namespace

BranchGraph deformed_branch_graph(const Individual& individual) {
    BranchGraph graph = individual.branch_graph;
    const DeformationOf<Plain>& deformation = individual.model.deformation;
    const Axis axis = bent_axis(graph, deformation, axis_angles(individual));
    const std::vector<FreeForm> dents =
        dents_of(graph, deformation.imperfection, individual.shape_seed);
    const auto moved = [&](SurfacePoint& point) {
        for (const FreeForm& one : dents) one.apply(point.position, point.meridian, point.azimuth);
        const AxisStation station = axis.at(point.position.y);
        point.meridian = station.direction(point.position, point.meridian);
        point.azimuth = station.direction(point.position, point.azimuth);
        point.position = station.point(point.position);
    };
    for (BranchGraph::Node& node : graph.nodes) {
        // Start and end of the segment of this node.
        SurfacePoint start{node.beside, node.heading, node.across};
        if (node.parent != none) start.position += individual.branch_graph.nodes[node.parent].place;
        SurfacePoint end{node.place, node.heading, node.across};
        moved(start);
        moved(end);
        node.heading = unit_or(end.position - start.position, unit_or(end.meridian, node.heading));
        node.across = square_to(node.heading, end.azimuth);
        node.beside =
            node.parent == none ? glm::dvec3(0.0) : start.position - graph.nodes[node.parent].place;
        node.place = end.position;
    }
    return graph;
}

}  // namespace sporeprint
