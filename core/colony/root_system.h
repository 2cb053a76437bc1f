// The root system of a colony and the stems that rise from it, as a skeleton.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/params/describe.h"
#include "core/skeleton/skeleton.h"

namespace sporeprint {

/// The vector field that roots follow. noise: two smooth random components; branches converge and
/// diverge. curl: divergence-free noise; branches keep their distance. radial: away from the base,
/// so that 0 deg gives rays and 90 deg nearly circles.
enum class RootField { noise, curl, radial };

constexpr const char* name(RootField field) {
    switch (field) {
        case RootField::noise:
            return "noise";
        case RootField::curl:
            return "curl";
        case RootField::radial:
            return "radial";
    }
    return nullptr;
}

/// Every control of the source. `Maybe` is Plain where roots are grown and std::optional in a
/// request.
/// source [Torres] "Root and Stems Generation"
template <template <class> class M>
struct ColonyRootsOf {
    M<RootField> field = preset<M>(RootField::noise);
    M<double> field_scale = preset<M>(0.35);
    M<double> heading_deg = preset<M>(0.0);
    M<int> arms = preset<M>(3);
    M<double> segment_length = preset<M>(0.03);
    M<double> decay = preset<M>(0.03);
    M<int> depth = preset<M>(14);
    M<double> branch_distance = preset<M>(0.12);
    M<double> branch_jitter_deg = preset<M>(20.0);
    M<double> root_radius = preset<M>(0.006);
    M<double> area_decay = preset<M>(1.0);
    M<double> stem_height = preset<M>(0.07);
    M<double> stem_decay = preset<M>(0.03);
    M<double> stem_probability = preset<M>(0.25);
    M<double> stem_displacement = preset<M>(0.015);
    M<int> stem_segments = preset<M>(5);

    static constexpr void fields(auto visit) {
        using C = ColonyRootsOf;
        visit(
            &C::field,
            Info{.name = "field", .doc = "What roots take their headings from.", .group = "field"});
        visit(&C::field_scale,
              Info{.name = "field_scale",
                   .unit = "m",
                   .min = 0.02,
                   .max = 10,
                   .doc = "Size of the field's features: smaller ones wind roots more.",
                   .group = "field"});
        visit(&C::heading_deg, Info{.name = "heading_deg",
                                    .unit = "deg",
                                    .min = -180,
                                    .max = 180,
                                    .doc = "Angle that the first branch keeps to the field.",
                                    .group = "field"});
        visit(&C::arms, Info{.name = "arms",
                             .min = 1,
                             .max = 12,
                             .doc = "Branches that leave the base, evenly round it.",
                             .group = "roots"});
        visit(&C::segment_length, Info{.name = "segment_length",
                                       .unit = "m",
                                       .min = 0.002,
                                       .max = 1,
                                       .doc = "Of root segments at the base.",
                                       .group = "roots"});
        visit(&C::decay, Info{.name = "decay",
                              .min = 0,
                              .max = 1,
                              .doc = "How fast segments shorten: by e to the minus this from one "
                                     "to the next.",
                              .group = "roots"});
        visit(&C::depth, Info{.name = "depth",
                              .min = 1,
                              .max = 60,
                              .doc = "Segments from the base to the farthest tips.",
                              .group = "roots"});
        visit(&C::branch_distance,
              Info{.name = "branch_distance",
                   .unit = "m",
                   .min = 0.005,
                   .max = 100,
                   .doc = "Length of root between two branchings, in the mean.",
                   .group = "roots"});
        visit(&C::branch_jitter_deg, Info{.name = "branch_jitter_deg",
                                          .unit = "deg",
                                          .min = 0,
                                          .max = 80,
                                          .doc = "How far side branches depart from 90 deg, at "
                                                 "most.",
                                          .group = "roots"});
        visit(&C::root_radius, Info{.name = "root_radius",
                                    .unit = "m",
                                    .min = 0.0002,
                                    .max = 0.2,
                                    .doc = "Of the root at the base.",
                                    .group = "roots"});
        visit(&C::area_decay, Info{.name = "area_decay",
                                   .min = 0,
                                   .max = 3,
                                   .doc = "How fast the section of roots shrinks, in decays of "
                                          "their lengths.",
                                   .group = "roots"});
        visit(&C::stem_height, Info{.name = "stem_height",
                                    .unit = "m",
                                    .min = 0.002,
                                    .max = 1,
                                    .doc = "Of a stem at the base.",
                                    .group = "stems"});
        visit(&C::stem_decay, Info{.name = "stem_decay",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How fast stems grow lower away from the base.",
                                   .group = "stems"});
        visit(&C::stem_probability, Info{.name = "stem_probability",
                                         .min = 0,
                                         .max = 1,
                                         .doc = "Share of root nodes that bear a stem.",
                                         .group = "stems"});
        visit(&C::stem_displacement,
              Info{.name = "stem_displacement",
                   .unit = "m",
                   .min = 0,
                   .max = 0.5,
                   .doc = "How far the tops of stems stand away from the base, along a parabola.",
                   .group = "stems"});
        visit(&C::stem_segments, Info{.name = "stem_segments",
                                      .min = 1,
                                      .max = 16,
                                      .doc = "Segments of a stem.",
                                      .group = "stems"});
    }
    bool operator==(const ColonyRootsOf&) const = default;
};
using ColonyRoots = ColonyRootsOf<Plain>;
static_assert(well_described<ColonyRoots>() && well_described<ColonyRootsOf<Maybe>>());

/// The largest number of root nodes.
inline constexpr std::size_t most_root_nodes = 20'000;

/// Returns the mean number of root nodes, before any work: a branch of length l has l /
/// branch_distance side branches.
[[nodiscard]] double expected_root_nodes(const ColonyRoots& roots);

/// Roots, and the stems on them. Metres, +y up, the base at the origin, roots in the plane y = 0.
struct ColonySkeleton {
    /// A branch: its own nodes, from the one after its start to its tip.
    struct Branch {
        std::uint32_t parent = 0;  ///< parent branch; itself if it starts at the base
        double angle = 0.0;        ///< to the field, radians
        std::vector<std::uint32_t> nodes;
        std::vector<double> splits;  ///< lengths along it at which side branches start
        double length = 0.0;
    };
    struct Stem {
        std::uint32_t root = 0;            ///< node
        std::vector<std::uint32_t> nodes;  ///< above the root node, the top last
        double height = 0.0, radius = 0.0;
        glm::dvec3 along{0.0, 1.0, 0.0};  ///< unit tangent at the top: the axis of the cap
    };
    Skeleton skeleton;
    std::uint32_t root_nodes = 0;  ///< the first nodes of the skeleton
    std::vector<int> depths;       ///< of root nodes: number of whole segments from the base
    std::vector<bool> inserted;    ///< of root nodes: a side branch starts within a segment
    std::vector<Branch> branches;
    std::vector<Stem> stems;
};

/// Grows roots segment by segment and stems on their nodes; nothing is moved apart.
///
/// Segment d has length L e^(-decay d) and follows the field at the branch's own angle; side
/// branches start after exponentially distributed lengths, at 90 deg and a perturbation to either
/// side, and begin with the next segment's length. Radii are r e^(-area_decay decay d / 2). A stem
/// stands on each root node with its probability, H e^(-stem_decay d) high, its axis base + h up +
/// D (h / H)^2 outwards, with the radius of its node.
///
/// throws  InvalidInput with all that check() reports; Impossible (path "/branch_distance") naming
///         the expected number of nodes
/// source  [Torres]; differs: side branches start where the Poisson event falls, not at the next
///         node, so that their distances are exponentially distributed
[[nodiscard]] ColonySkeleton colony_skeleton(const ColonyRoots& roots, std::uint32_t seed);

/// Returns the unit direction of the field at a position on the ground (x, z); zero where it has
/// none.
[[nodiscard]] glm::dvec2 field_heading(const ColonyRoots& roots, std::uint32_t seed,
                                       const glm::dvec2& place);

}  // namespace sporeprint
