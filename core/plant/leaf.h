// A leaf as a closed thin shell, modelled without alpha cut-outs, with its petiole.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/plant/leaf_colour.h"
#include "core/plant/leaflets.h"
#include "core/plant/venation.h"

namespace sporeprint {

/// The parameters of a leaf's shape.
struct LeafShape {
    Venation venation;
    double length = 0.08;
    double petiole = 0.35;
    double thickness = 0.006;
    double relief = 0.6;
    double curl_deg = 25.0;
    double fold_deg = 10.0;
    double wave = 0.2;
    double waves = 2.0;
    double bow = 0.0;
    double eaten = 0.03;
    Leaflets leaflets;

    static constexpr void fields(auto visit) {
        using L = LeafShape;
        visit(&L::venation, Info{.name = "venation", .doc = "Veins, and the border about them."});
        visit(&L::length, Info{.name = "length",
                               .unit = "m",
                               .min = 0.004,
                               .max = 1,
                               .doc = "From the root of the limb to its tip."});
        visit(&L::petiole, Info{.name = "petiole",
                                .min = 0.02,
                                .max = 2,
                                .doc = "Length of the petiole, in lengths of the limb."});
        visit(&L::thickness, Info{.name = "thickness",
                                  .min = 0.002,
                                  .max = 0.05,
                                  .doc = "Of the limb in its middle, in lengths of it; its border "
                                         "is sharp."});
        visit(&L::relief, Info{.name = "relief",
                               .min = 0,
                               .max = 1,
                               .doc = "How far veins lie in the upper face and stand out of the "
                                      "lower one."});
        visit(&L::curl_deg, Info{.name = "curl_deg",
                                 .unit = "deg",
                                 .min = -180,
                                 .max = 180,
                                 .doc = "Bend along the middle vein, downwards from root to tip."});
        visit(&L::fold_deg, Info{.name = "fold_deg",
                                 .unit = "deg",
                                 .min = -50,
                                 .max = 60,
                                 .doc = "How far both sides stand up from the middle vein."});
        visit(
            &L::wave,
            Info{
                .name = "wave", .min = 0, .max = 1, .doc = "How far the border goes up and down."});
        visit(&L::waves, Info{.name = "waves",
                              .min = 0.5,
                              .max = 6,
                              .doc = "Ups and downs from the root to the tip."});
        visit(&L::bow, Info{.name = "bow",
                            .min = -0.4,
                            .max = 0.4,
                            .doc = "How far the tip stands beside the line of the petiole, in "
                                   "lengths of the limb."});
        visit(&L::eaten,
              Info{.name = "eaten",
                   .min = 0,
                   .max = 0.3,
                   .doc = "Share of the limb that insects have eaten: holes, and bites at its "
                          "border, with brown rims. Of simple leaves; they are open at levels 0 "
                          "and 1 of a leaf, and painted at coarser ones and on trees."});
        visit(&L::leaflets,
              Info{.name = "leaflets",
                   .doc = "Leaflets of a compound leaf. Its length and its curl are those of the "
                          "axis; veins, border, fold and waves those of every leaflet."});
    }
    bool operator==(const LeafShape&) const = default;
};
static_assert(well_described<LeafShape>());

/// A preset: a leaf to start from. Each is one JSON file in core/atlas/leaves.
struct LeafPreset {
    Text<48> id;
    Text<48> name;
    int rank = 1000;
    LeafShape shape;
    LeafPalette palette;

    static constexpr void fields(auto visit) {
        using P = LeafPreset;
        visit(&P::id,
              Info{.name = "id", .doc = "Name in URLs: lower-case letters, digits, underscores."});
        visit(&P::name, Info{.name = "name", .doc = "Name in lists, in English."});
        visit(&P::rank, Info{.name = "rank",
                             .min = 0,
                             .max = 1000,
                             .doc = "Place in lists, ascending; equal ranks are sorted by id."});
        visit(&P::shape, Info{.name = "shape", .doc = "Veins, border and curvature."});
        visit(&P::palette, Info{.name = "palette", .doc = "Colours through the year."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (const std::string message = invalid_id_message(id); !message.empty())
            report(problems, path + "/id", message);
        if (name.empty()) report(problems, path + "/name", "is missing");
    }
    bool operator==(const LeafPreset&) const = default;
};
static_assert(well_described<LeafPreset>());

/// The chart of a leaf on its image: the upper face in the left half, the lower one in the right
/// half, both seen from above, and below them a strip for the petiole.
struct LeafChart {
    glm::dvec2 corner{0.0};  ///< lower corner of the lamina's bounding box, in its plane
    double scale = 1.0;      ///< texture lengths per length of the lamina

    [[nodiscard]] glm::dvec2 texture_point(const glm::dvec2& place, bool upper) const;
    /// The inverse of texture_point(). Whether a point lies on the lamina at all is decided by
    /// LaminaSampler.
    [[nodiscard]] glm::dvec2 place(const glm::dvec2& texture_point, bool& upper) const;
};
/// The top of the petiole's strip; v goes down as in glTF.
inline constexpr double petiole_strip = 0.94;

/// What the image of a leaf shows: it alone, or, on trees, a smaller copy with sprays of leaves beside it. A needle
/// has shoots beside it in any case.
enum class LeafLayout { alone, with_sprays };

[[nodiscard]] LeafChart chart_of(const Lamina& lamina, LeafLayout layout = LeafLayout::alone);

/// The number of levels of detail of a leaf as a product of its own.
inline constexpr int leaf_lods = 4;

/// Returns the argument `steps` of lamina_of() for a leaf at a level of detail.
[[nodiscard]] int leaf_steps(const Venation& venation, int lod);

/// Returns the whole leaf: pivot at the far end of the petiole, the lamina along +z, its upper face
/// up.
///
/// lod      0: up to 5,000 triangles, and up to 400 for each place that is eaten; 1: about 500; 2: the
///          polygon of the source; 3: a fan of most_foliage_triangles of the same length and width, or
///          the polygon if it has no more triangles. Of a compound leaf each leaflet is 0: a lamina
///          with as smooth a border as most_leaflet_triangles for all allow; 1: a fan; 2 and 3: a
///          kite
/// size     scale of the whole
/// seed     determines where the leaf is eaten
/// returns  closed pieces: the lamina, with its veins as relief, and the petiole; or the axis and
///          each leaflet
/// throws   InvalidInput with all that check() reports
[[nodiscard]] Mesh leaf_mesh(const LeafShape& shape, int lod, double size = 1.0,
                             std::uint32_t seed = 1);

struct LeafCount {
    std::uint64_t vertices = 0, triangles = 0;
};

/// The largest number of triangles of all leaflets of a leaf at LOD 0, unless fans have more.
inline constexpr std::uint64_t most_leaflet_triangles = 20'000;

/// Returns upper bounds of the counts of leaf_mesh(), in nanoseconds; up to six times the actual
/// counts where few corners are divided among many lobes. Of a compound leaf they are the counts
/// themselves, in microseconds.
[[nodiscard]] LeafCount most_of_leaf(const LeafShape& shape, int lod);

/// Returns the shape of one individual: slightly longer or shorter, more or less curled, with other
/// angles between its veins.
///
/// shape      with nothing that check() reports
/// variation  0: the shape itself; 1: as different as leaves of one plant
/// returns    a shape with nothing that check() reports
[[nodiscard]] LeafShape individual_leaf(const LeafShape& shape, std::uint32_t seed,
                                        double variation);

/// The largest number of triangles of foliage_leaf().
inline constexpr std::size_t most_foliage_triangles = 16;

/// Returns the leaf of a tree: one closed piece of a few triangles with the area of the lamina seen
/// from above, without a petiole (root of the lamina at the origin). Of four triangles it is flat, a
/// kite on either face, of two one triangle: they have the area and the middle of the leaf of most
/// triangles and lie in its plane, as slender as it is by the variances of its points, since seen
/// from far away a leaf is a spot. They need not reach from its root to its tip. A compound leaf is a
/// star of the area of its leaflets; a shoot of needles is a card, of which its image shows the needles.
///
/// triangles  2, 4, 8, 12 or 16
/// share      area of a leaf of two or four triangles by that of the lamina, greater than 0
/// layout     of its image
/// throws     InvalidInput with all that check() reports, or for another number of triangles
[[nodiscard]] Mesh foliage_leaf(const LeafShape& shape,
                                std::size_t triangles = most_foliage_triangles, double share = 1.0,
                                LeafLayout layout = LeafLayout::alone);

/// What is drawn at the place of a leaf: it, a twig with some smaller leaves, or a branch of such twigs.
enum class LeafGroup { leaf, twig, branch };

constexpr const char* name(LeafGroup group) {
    switch (group) {
        case LeafGroup::leaf:
            return "leaf";
        case LeafGroup::twig:
            return "twig";
        case LeafGroup::branch:
            return "branch";
    }
    return nullptr;
}

/// What stands for one leaf or more.
struct GroupLeaf {
    Mesh mesh;
    double covered = 1.0;  ///< about the share of its area that its image shows leaves on
};

/// Returns what a tree has at the place of a leaf: the foliage_leaf(), or a card with the picture of a group, of which as
/// much is covered as a leaf covers. Of two triangles it is the part of the card between its root's two corners and the
/// middle of its other end. Shoots of needles have a spray of shoots for either group, compound leaves none.
///
/// triangles  2, 4, 8, 12 or 16
/// share      as of foliage_leaf()
/// throws     as foliage_leaf()
[[nodiscard]] GroupLeaf leaf_of_group(const LeafShape& shape, std::size_t triangles,
                                      LeafGroup group, double share = 1.0);

/// Returns the area of the lamina in its plane, of all leaflets of a compound one; square metres.
[[nodiscard]] double lamina_area(const LeafShape& shape);

}  // namespace sporeprint
