// A tree: a ramification placed in space, its bark and its leaves.
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/plant/bark_image.h"
#include "core/plant/leaf.h"
#include "core/plant/tree_ecology.h"
#include "core/ramification/ramification.h"
#include "core/ramification/topology.h"
#include "core/skeleton/skeleton.h"

namespace sporeprint {

/// The law by which lengths and radii grow with the order k of an edge, relative to order 1
/// (twigs): 1, 1 + A (k - 1), 1 + A log(k) or A^(k - 1) times; pipe: the A-th root of the number of
/// leaves that the edge carries.
enum class OrderLaw { constant, linear, logarithmic, geometric, pipe };

constexpr const char* name(OrderLaw law) {
    switch (law) {
        case OrderLaw::constant:
            return "constant";
        case OrderLaw::linear:
            return "linear";
        case OrderLaw::logarithmic:
            return "logarithmic";
        case OrderLaw::geometric:
            return "geometric";
        case OrderLaw::pipe:
            return "pipe";
    }
    return nullptr;
}

/// The parameters of a tree's shape, leaves excluded.
struct TreeShape {
    TreeTopology topology;
    double fork_deg = 30.0;
    double main_deg = 10.0;
    double side_deg = 45.0;
    double spread = 0.0;
    OrderLaw length_law = OrderLaw::linear;
    double length_rise = 0.15;
    double twig_length = 0.09;
    OrderLaw width_law = OrderLaw::pipe;
    double width_rise = 2.3;
    double twig_radius = 0.0016;
    double trunk = 0.8;
    double shortening = 0.0;
    double rounding = 0.0;
    double evenness = 0.0;
    double variation = 0.2;
    double azimuth_deg = 137.5;
    double plagiotropy = 0.0;
    double gravitropism = 0.05;
    double weeping = 0.0;
    double phototropism = 0.0;
    double light_deg = 60.0;
    double light_azimuth_deg = 0.0;
    double root_flare = 0.0;

    static constexpr void fields(auto visit) {
        using T = TreeShape;
        visit(&T::topology, Info{.name = ""});
        visit(&T::fork_deg, Info{.name = "fork_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 80,
                                 .doc = "Turn of either branch of a fork."});
        visit(&T::main_deg, Info{.name = "main_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 60,
                                 .doc = "Turn of a main branch that bears one nearly its equal; "
                                        "less for lesser ones."});
        visit(&T::side_deg, Info{.name = "side_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 100,
                                 .doc = "Turn of a twig on a much greater branch; less for "
                                        "greater ones."});
        visit(&T::spread, Info{.name = "spread",
                               .min = 0,
                               .max = 1,
                               .doc = "How far greater side branches turn as much as twigs do; at "
                                      "1 boughs stand off a trunk like twigs."});
        visit(&T::length_law, Info{.name = "length_law", .doc = "Lengths of edges by order."});
        visit(&T::length_rise,
              Info{.name = "length_rise", .min = 0, .max = 4, .doc = "A of the law of lengths."});
        visit(&T::twig_length, Info{.name = "twig_length",
                                    .unit = "m",
                                    .min = 0.002,
                                    .max = 1,
                                    .doc = "Of an edge of order 1."});
        visit(&T::width_law, Info{.name = "width_law", .doc = "Radii of edges by order."});
        visit(&T::width_rise, Info{.name = "width_rise",
                                   .min = 0,
                                   .max = 4,
                                   .doc = "A of the law of radii; of pipes 2 keeps the section of "
                                          "all branches together (at least 1)."});
        visit(&T::twig_radius, Info{.name = "twig_radius",
                                    .unit = "m",
                                    .min = 0.0001,
                                    .max = 0.05,
                                    .doc = "Of an edge of order 1."});
        visit(&T::trunk, Info{.name = "trunk",
                              .unit = "m",
                              .min = 0,
                              .max = 10,
                              .doc = "Height of the lowest branch."});
        visit(&T::shortening, Info{.name = "shortening",
                                   .min = 0,
                                   .max = 0.95,
                                   .doc = "How much shorter branches are at the end of their "
                                          "bearer than at its beginning: a cone."});
        visit(&T::rounding,
              Info{.name = "rounding",
                   .min = 0,
                   .max = 0.95,
                   .doc = "How much shorter branches are at the beginning of the trunk than at its "
                          "middle: a round crown."});
        visit(&T::evenness, Info{.name = "evenness",
                                 .min = 0,
                                 .max = 1,
                                 .doc = "How far all axes of an order are as long as each other, "
                                        "however many branches they bear: an even crown."});
        visit(&T::variation, Info{.name = "variation",
                                  .min = 0,
                                  .max = 1,
                                  .doc = "How far lengths and angles vary from axis to axis."});
        visit(&T::azimuth_deg, Info{.name = "azimuth_deg",
                                    .unit = "deg",
                                    .min = 0,
                                    .max = 180,
                                    .doc = "Phyllotaxis: turn about the bearer from one branch to "
                                           "the next; 180 in two rows."});
        visit(&T::plagiotropy, Info{.name = "plagiotropy",
                                    .min = 0,
                                    .max = 1,
                                    .doc = "How far branches of low order spread in level "
                                           "planes."});
        visit(&T::gravitropism, Info{.name = "gravitropism",
                                     .min = -0.5,
                                     .max = 0.5,
                                     .doc = "How far each edge turns up; down below 0."});
        visit(&T::weeping,
              Info{.name = "weeping",
                   .min = 0,
                   .max = 0.5,
                   .doc = "How far each edge of twigs turns down, edges of greater orders less, "
                          "those of the trunk not at all."});
        visit(&T::phototropism, Info{.name = "phototropism",
                                     .min = 0,
                                     .max = 0.5,
                                     .doc = "How far each edge turns to the light."});
        visit(&T::light_deg, Info{.name = "light_deg",
                                  .unit = "deg",
                                  .min = 0,
                                  .max = 90,
                                  .doc = "Height of the light."});
        visit(&T::light_azimuth_deg, Info{.name = "light_azimuth_deg",
                                          .unit = "deg",
                                          .min = -180,
                                          .max = 180,
                                          .doc = "Where the light comes from, from +z to +x."});
        visit(&T::root_flare,
              Info{.name = "root_flare",
                   .min = 0,
                   .max = 2,
                   .doc = "How far the foot of the trunk widens into its roots; 1 is "
                          "about twice as wide as the trunk."});
    }
    bool operator==(const TreeShape&) const = default;

    /// Reports pipes with an exponent below 1.
    void check(const std::string& path, std::vector<Problem>& problems) const;
};
static_assert(well_described<TreeShape>());

/// The expected properties of the edges of one order.
struct ExpectedOrder {
    double edges = 0.0;   ///< number
    double length = 0.0;  ///< mean, metres
    double radius = 0.0;  ///< smallest, metres
};

/// Returns the expected edges of each order from 1 on, before any work. With small trees at the
/// tips, the orders above them are those of most trees.
///
/// shape  with nothing that check() reports
[[nodiscard]] std::vector<ExpectedOrder> expected_orders(const TreeShape& shape);

/// A tree in space. Node 0 of the skeleton stands on the ground; node i + 1 is the end of the edge
/// that enters node i of the ramification, and segment i is that edge.
struct Tree {
    Ramification ramification;
    Skeleton skeleton;
    std::vector<glm::dvec3> headings;  ///< unit, of each segment before it ends
    std::vector<glm::dvec3>
        across;  ///< unit, square to them: the way to the side of its first child
    /// Of each edge, how much shorter it is by its place on its parent; empty for none that is.
    std::vector<double> scales;
};

/// Grows a tree: root at the origin, upwards along +y.
///
/// throws  InvalidInput with all that check() reports; Impossible (path "/order") naming the
///         expected number of tips if it exceeds most_tips
/// cost    O(tips)
/// source  [Viennot1989] sections 4 and 5; angles by biorder, lengths and widths by order, azimuths
///         and tropisms as described
[[nodiscard]] Tree grown_tree(const TreeShape& shape, std::uint32_t seed);

/// The number of levels of detail of a tree.
inline constexpr int tree_lods = 4;

/// The surface of trunk, branches and twigs.
struct Bark {
    Mesh mesh;
    /// By vertex: the node of the ramification that its edge enters.
    std::vector<std::uint32_t> edges;
};

/// Returns the surface of trunk, branches and twigs. High orders are subdivided, twigs are not; each
/// level of detail drops one more of the low orders and subdivides less; of a low tree the trunk
/// and its branches always remain.
///
/// returns  closed pieces with tangents; u goes once round a segment, v along it to the end of the
///          image and back (mirrored repeat), in girths of the segment, so that bark is not
///          stretched anywhere
/// throws   Impossible (path "/twig_radius") for more than most_skeleton_nodes rings
[[nodiscard]] Bark bark_of(const Tree& tree, int lod);

struct TreeCount {
    double vertices = 0.0, triangles = 0.0;
};

/// Returns slightly high estimates of the counts of bark_of(), in microseconds; for a sampled
/// topology about the mean.
///
/// shape   with nothing that check() reports
/// throws  Impossible (path "/twig_radius") for more than most_skeleton_nodes rings
[[nodiscard]] TreeCount count_of_bark(const TreeShape& shape, int lod);

/// The arrangement of leaves on twigs.
struct LeafStyle {
    int per_tip = 3;
    double leaf_size = 1.0;
    double leaf_deg = 50.0;
    double droop = 0.3;
    double size_spread = 0.2;
    double hue_spread = 0.5;
    LeafGroup leaf_group = LeafGroup::leaf;

    static constexpr void fields(auto visit) {
        using L = LeafStyle;
        visit(&L::per_tip,
              Info{.name = "per_tip", .min = 0, .max = 40, .doc = "Leaves to a twig."});
        visit(&L::leaf_size, Info{.name = "leaf_size",
                                  .min = 0.1,
                                  .max = 10,
                                  .doc = "Size of a leaf, in that of its own kind."});
        visit(&L::leaf_deg, Info{.name = "leaf_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 100,
                                 .doc = "Between a leaf and its twig."});
        visit(&L::droop, Info{.name = "droop",
                              .min = 0,
                              .max = 1,
                              .doc = "How far leaves hang down from their twigs."});
        visit(&L::size_spread, Info{.name = "size_spread",
                                    .min = 0,
                                    .max = 0.6,
                                    .doc = "How far leaves vary in size."});
        visit(&L::hue_spread,
              Info{.name = "hue_spread",
                   .min = 0,
                   .max = 1,
                   .doc = "How far branches differ from each other in the hue and the brightness "
                          "of their leaves, and by half of that in their bark: COLOR_0, by which "
                          "viewers multiply the base colour."});
        visit(&L::leaf_group,
              Info{.name = "leaf_group",
                   .doc =
                       "What is drawn at the place of each leaf: it, a twig with five smaller "
                       "leaves, or a branch of such twigs, which cover as much as it; of shoots of "
                       "needles a spray of shoots for either, of other compound leaves none. For "
                       "trees that are shown much larger than they grow."});
    }
    bool operator==(const LeafStyle&) const = default;
};
static_assert(well_described<LeafStyle>());

/// One placed leaf: the position of its root, its axes, and its size relative to the leaf mesh.
struct PlacedLeaf {
    glm::dvec3 place{0.0}, along{0.0, 0.0, 1.0}, up{0.0, 1.0, 0.0};
    double size = 1.0;
    double breadth = 1.0;    ///< relative to its size
    double thickness = 1.0;  ///< relative to its size
    std::uint32_t id = 0;    ///< key of its own random stream
    std::uint32_t twig = 0;  ///< node of the ramification that its edge enters

    /// Returns the position of a point of the leaf mesh.
    [[nodiscard]] glm::dvec3 at(const glm::dvec3& point) const {
        return place + size * (breadth * point.x * glm::cross(up, along) +
                               thickness * point.y * up + point.z * along);
    }
};

/// The largest number of leaves of a tree.
inline constexpr std::size_t most_leaves = 100'000;

/// Places leaves along all twigs. Thinning drops them from the end of the list, so that levels of
/// detail are nested.
///
/// throws  Impossible (path "/per_tip") for more than most_leaves
[[nodiscard]] std::vector<PlacedLeaf> placed_leaves(const Tree& tree, const LeafStyle& style,
                                                    std::uint32_t seed);

/// Returns the first `share` of the leaves, at the same positions, enlarged to the same total area.
[[nodiscard]] std::vector<PlacedLeaf> thinned(std::span<const PlacedLeaf> leaves, double share);

/// Returns all leaves as one mesh of copies of `leaf` (root at the origin, along +z, upper face
/// up).
[[nodiscard]] Mesh merged_leaves(std::span<const PlacedLeaf> leaves, const Mesh& leaf);

/// A preset: a tree to start from. Each is one JSON file in core/atlas/trees.
struct TreePreset {
    Text<48> id;
    Text<48> name;
    int rank = 1000;
    IdChoice leaf;
    TreeShape shape;
    LeafStyle leaves;
    BarkStyle bark;
    TreeEcology ecology;

    static constexpr void fields(auto visit) {
        using P = TreePreset;
        visit(&P::id, info_of<LeafPreset>("id"));
        visit(&P::name, info_of<LeafPreset>("name"));
        visit(&P::rank, info_of<LeafPreset>("rank"));
        visit(&P::leaf, Info{.name = "leaf", .doc = "Id of the preset of its leaf."});
        visit(&P::shape, Info{.name = "shape", .doc = "Trunk and branches."});
        visit(&P::leaves, Info{.name = "leaves", .doc = "How leaves stand on their twigs."});
        visit(&P::bark, Info{.name = "bark", .doc = "What is painted on trunk and branches."});
        visit(&P::ecology,
              Info{.name = "ecology",
                   .doc = "Where it grows in a world, how old and tall it becomes and how its wood "
                          "decays; the shape of a tree does not depend on it."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (const std::string message = invalid_id_message(id); !message.empty())
            report(problems, path + "/id", message);
        if (name.empty()) report(problems, path + "/name", "is missing");
    }
    bool operator==(const TreePreset&) const = default;
};
static_assert(well_described<TreePreset>());

}  // namespace sporeprint
