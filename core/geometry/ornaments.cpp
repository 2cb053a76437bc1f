#include "core/geometry/ornaments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/geometry/fallen_litter.h"
#include "core/geometry/grid_solid.h"
#include "core/geometry/ground.h"
#include "core/geometry/receptacle.h"
#include "core/geometry/shells.h"
#include "core/geometry/spines.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

// No source or measurement is recorded for the values below.

/// Radii of a patch's seven corners, random; and its tip: deviation from the middle and
/// displacement for `lift` 1, all in radii.
constexpr double least_corner = 0.78, most_corner = 1.12, tip_deviation = 0.25, tip_lift = 1.1;

/// Heights of a style, in radii, between which patches change from cushions to spines; how much
/// wider than a cone the middle of a cushion is, and how much narrower that of a spine.
constexpr double cushion_height = 0.9, spine_height = 1.5, bulge = 1.15, spine_hollow = 0.66;

/// Warts are crumbs of a veil that has burst, not cones: how much their corners stray, across in
/// shares of their distance from the middle and upwards in heights, and how flat their tops are.
constexpr double crumb_stray = 0.3, crumb_rise = 0.28, crumb_top = 0.65;

/// Depth of a patch's base under the surface, in radii.
constexpr double patch_depth = 0.25;

/// A spine stands on a skirt, in which the skin rises to it: how much wider its base is, how much
/// less deep it lies, and the power by which the rings between base and tip move down to it.
constexpr double skirt_width = 0.35, skirt_rise = 0.5, skirt_power = 0.5;

/// A scale is a flap of torn skin: it passes into the skin at its upper end, and `lift` 1 raises its
/// lower end so far, in radii, and thins it there by such a share. Its lower corners are torn: how much
/// nearer or farther they lie.
constexpr double flap_rise = 0.55, flap_thinning = 0.6, flap_tear = 0.38, flap_narrowing = 0.3;

SolidGrid patch_grid(const Detail& detail) {
    return {detail.patch_rings + 2, detail.patch_sides, false};
}

/// Returns 0 for a layer of cushions and flaps, 1 for one of spines.
double pointed_share(const PatchLayer& layer) {
    return smooth_step(cushion_height, spine_height, layer.style.height);
}

/// Returns how far the pieces of a layer stand on skirts: as far as they are spines, scales never.
double skirt_share(const PatchLayer& layer) {
    return layer.purpose == purposes::scales ? 0.0 : pointed_share(layer);
}

bool is_tuft(const PatchLayer& layer) {
    return layer.purpose == purposes::scales && layer.style.fray > 0.0;
}

/// Returns the number of pieces of a layer, absent ones included, so that no amount changes the
/// number of vertices. Tufts of hairs are only painted.
int piece_count(const PatchLayer& layer, const OrnamentDetail& detail) {
    if (detail.patch_sides == 0 || is_tuft(layer) ||
        std::abs(layer.style.to - layer.style.from) < least_window)
        return 0;
    return static_cast<int>(
        std::ceil(detail.patches * detail.offered(layer.style.count, sure_patches)));
}

/// Returns the share of the current stem's arc length that corresponds to a share of the mature
/// stem: the same segment, at the same share of it. For the mature stem it is the identity.
double grown_share(const std::vector<double>& mature, const std::vector<double>& now,
                   double share) {
    if (mature.size() != now.size()) return share;  // other ages have no corresponding segments
    std::size_t k = 0;
    while (k + 2 < mature.size() && mature[k + 1] <= share) ++k;
    const double length = mature[k + 1] - mature[k];
    const double within = length > 0.0 ? std::clamp((share - mature[k]) / length, 0.0, 1.0) : 0.0;
    return now[k] + within * (now[k + 1] - now[k]);
}

/// Values that all pieces of one layer share.
struct LayerPlace {
    bool on_stem;  ///< positions run up the stem, otherwise down from the apex
    const SubCurve& curve;
    std::vector<double> segments;      ///< shares of the stem's segments
    std::vector<OutlineSample> rings;  ///< of the mesh of the part
    double wider;                      ///< factor on outlines, see below
};

/// A coordinate frame on the surface, in which a piece is built: (round, outward, normal) is
/// right-handed, so corners run counter-clockwise seen from outside.
struct PatchFrame {
    glm::dvec3 centre, round, outward, normal;
    AxisStation station;
    double share;  ///< of the sub-curve
};

LayerPlace place_of(const PatchLayer& layer, const OrnamentContext& context) {
    const bool on_stem = layer.purpose == purposes::bulb_scales;
    const SubCurve& curve = on_stem ? context.outline.stem : context.outline.cap;
    // An outline with fewer corners is widened, so that it covers the same area.
    const auto covered = [](int corners) { return corners * sine(2.0 * pi / corners); };
    return {on_stem, curve, on_stem ? curve.segment_shares() : std::vector<double>{},
            context.outline.rings(on_stem ? CurveName::stem : CurveName::cap, context.level),
            std::sqrt(covered(details[0].patch_sides) / covered(context.detail.patch_sides))};
}

PatchFrame frame_of(const Patch& patch, const PatchLayer& layer, const LayerPlace& place,
                    const OrnamentContext& context) {
    // A piece where the margin is cut moves inwards with the surface.
    const OutlineSample at =
        place.curve.at(place.on_stem ? grown_share(layer.segments, place.segments, patch.sigma)
                                     : 1.0 - context.cuts.cap(patch.sigma, patch.theta));
    // The base lies on the mesh itself, whose chords lie off the surface: otherwise a vanishing
    // piece would be hidden under it, or float above.
    const SurfacePoint point =
        context.rest_surface.meshed(place.on_stem ? Part::stem : Part::cap, place.rings,
                                    detail_of(context.level).columns, at.share, patch.theta);
    glm::dvec3 normal = glm::cross(point.meridian, point.azimuth), meridian = point.meridian;
    if (!context.rest_surface.plain()) {
        normal = unit_or(normal, glm::dvec3(0.0, 1.0, 0.0));
        meridian = square_to(normal, meridian);
    }
    const glm::dvec3 outward = place.on_stem ? meridian : -meridian;
    const glm::dvec3 round = glm::cross(outward, normal);
    glm::dvec3 centre = point.position;
    if (!place.on_stem) centre += context.dents.cap(patch.sigma, patch.theta) * normal;
    const AxisStation station = context.deformer.frozen_station(
        place.on_stem ? std::min(at.y, context.deformer.top()) : context.deformer.top());
    return {centre, round, outward, normal, station, at.share};
}

/// Builds the corners of a piece with this radius, in its frame at rest.
void build_patch(GridSolid& solid, const Patch& patch, const PatchLayer& layer, double radius,
                 const PatchFrame& frame, double wider, const OrnamentContext& context) {
    const PatchStyle& style = layer.style;
    const int sides = solid.columns;
    // Low pieces are cushions, tall ones spines.
    const double pointed = pointed_share(layer);
    const double skirt = skirt_share(layer);
    const double height = patch.height * radius;
    solid.corners.clear();
    Random random(context.seed, purposes::corners + layer.purpose - purposes::warts, patch.id);
    // Seven numbers are drawn at every level of detail; a coarser outline uses some of them.
    std::array<double, 7> reach{};
    for (double& r : reach) r = random.uniform(least_corner, most_corner);
    const double tip_round = tip_deviation * random.symmetric();
    const double tip_outward = tip_deviation * random.symmetric() + tip_lift * style.lift;
    // Likewise how its corners stray, in four rings between its base and its tip.
    constexpr int crumb_rings = 4;
    std::array<std::array<double, 2>, std::size_t{7} * crumb_rings> stray{};
    for (auto& [across, up] : stray) {
        across = crumb_stray * random.symmetric();
        up = crumb_rise * random.symmetric();
    }
    const bool is_scale = layer.purpose == purposes::scales;
    const double crumbled = is_scale ? 0.0 : 1.0 - pointed;
    const double flap = is_scale ? std::max(style.lift, 0.0) : 0.0;
    std::array<glm::dvec3, 7> rim{};
    std::array<double, 7> lower{};  // how far a corner lies towards the margin, -1..1
    for (int j = 0; j < sides; ++j) {
        const auto side = static_cast<std::size_t>(j);
        const auto turn = sine_cosine(patch.spin + 2.0 * pi * j / sides);
        lower[side] = turn.sine;
        const double torn = flap * flap_tear / crumb_stray * stray[side][0];
        const double below = std::max(turn.sine, 0.0);
        rim[side] =
            wider * radius * reach[static_cast<std::size_t>(j * 7 / sides)] * (1.0 + torn * below) *
            ((1.0 - flap * flap_narrowing * std::max(-turn.sine, 0.0)) * turn.cosine * frame.round +
             turn.sine * style.elongation * frame.outward);
    }
    // How high a place of a flap lies, in radii, and how thick it is there, relative to a cushion.
    const auto raised = [&](double down) {
        const double share = std::clamp(0.5 * (1.0 + down), 0.0, 1.25);
        return flap * flap_rise * share * share;
    };
    const auto thickness = [&](double down) {
        return 1.0 - flap * flap_thinning * std::clamp(0.5 * (1.0 + down), 0.0, 1.0);
    };
    const glm::dvec3 tip =
        radius * (tip_round * frame.round + tip_outward * style.elongation * frame.outward);
    for (int i = 0; i < solid.rows; ++i) {
        const double row = static_cast<double>(i) / (solid.rows - 1);
        const double up = row * (1.0 - skirt_power * skirt * (1.0 - row));
        const double narrowing =
            (1.0 - up) * (1.0 + up * (bulge - (bulge + spine_hollow) * pointed)) +
            (i == 0 ? skirt_width * skirt : 0.0);
        const double risen = up * (1.0 + crumbled * crumb_top * (1.0 - up));
        const double crumb = i > 0 && i + 1 < solid.rows ? crumbled : 0.0;
        const std::size_t ring = static_cast<std::size_t>(up * crumb_rings * 0.999);
        for (int j = 0; j < sides; ++j) {
            const auto side = static_cast<std::size_t>(j);
            const auto [across, upwards] =
                stray[7 * ring + side * 7 / static_cast<std::size_t>(sides)];
            const double down = up * tip_outward + narrowing * lower[side];
            const double rise =
                radius * raised(down) +
                thickness(down) * (i == 0 ? (skirt_rise * skirt - 1.0) * patch_depth * radius
                                          : height * (risen + crumb * upwards * up));
            solid.corners.push_back(frame.centre + up * tip + rise * frame.normal +
                                    narrowing * (1.0 + crumb * across) * rim[side]);
        }
        solid.corners.push_back(
            solid.corners[solid.corners.size() - static_cast<std::size_t>(sides)]);
    }
}

/// Returns the pieces of a layer that a level of detail builds: the largest ones.
std::vector<Patch> built_patches(const PatchLayer& layer, const OrnamentContext& context) {
    std::vector<Patch> built = patches(layer.style, context.seed, layer.purpose);
    const auto count = static_cast<std::size_t>(piece_count(layer, context.detail));
    if (count < built.size()) {
        std::stable_sort(built.begin(), built.end(),
                         [](const Patch& a, const Patch& b) { return a.drawn > b.drawn; });
        built.resize(count);
    }
    return built;
}

/// Appends the pieces of one layer.
void add_layer(Mesh& mesh, const PatchLayer& layer, const OrnamentContext& context) {
    if (piece_count(layer, context.detail) == 0) return;
    const LayerPlace place = place_of(layer, context);
    const double length = context.outline.cap.length();
    GridSolid solid{patch_grid(context.detail), Part::veil, {}, {}};
    for (const Patch& patch : built_patches(layer, context)) {
        const double scale = layer.weight * patch_scale(patch, layer.amount);
        const double radius = patch.radius * scale * length;
        const PatchFrame frame = frame_of(patch, layer, place, context);
        build_patch(solid, patch, layer, radius, frame, place.wider, context);
        context.deformer.apply(solid.corners, frame.station);
        if (!place.on_stem && !context.curl.none()) {
            const glm::dvec3 by = context.curl.moved(true, 1.0 - frame.share, patch.theta);
            for (glm::dvec3& corner : solid.corners) corner += by;
        }
        const glm::dvec3 fallback =
            unit_or(frame.station.direction(frame.centre, frame.normal), glm::dvec3(0.0, 1.0, 0.0));
        solid.skirt = skirt_share(layer) * fallback;
        append(mesh, solid, fallback, context.textured, radius > 0.0 || context.keep_absent);
    }
}

}  // namespace

MeshCount ornament_count(const Individual& individual, const OrnamentDetail& detail) {
    MeshCount sum = shell_count(individual, detail);
    sum += spine_count(individual.spines, detail);
    sum += peridiole_count(individual, detail);
    sum += receptacle_count(individual, detail);
    sum += ground_count(individual.grounds, detail);
    sum += fallen_litter_count(individual.grounds, detail);
    for (const PatchLayer& layer : individual.layers)
        sum += patch_grid(detail).count().times(piece_count(layer, detail));
    return sum;
}

void add_ornaments(Mesh& mesh, const Individual& individual, const OrnamentContext& context) {
    for (const PatchLayer& layer : individual.layers) add_layer(mesh, layer, context);
    add_ring(mesh, individual, context);
    add_sac(mesh, individual, context);
    add_spines(mesh, individual, context);
    add_peridioles(mesh, individual, context);
    add_receptacles(mesh, individual, context);
    add_ground(mesh, individual, context);
    add_fallen_litter(mesh, individual, context);
}

}  // namespace sporeprint
