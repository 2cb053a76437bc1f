#include "core/geometry/receptacle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "core/geometry/grid_solid.h"
#include "core/geometry/sphere_cells.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/surface/charts.h"
#include "core/surface/veil_bands.h"

namespace sporeprint {

namespace {

constexpr const Chart& veil = swept_charts[static_cast<std::size_t>(Part::veil)];

// No source or measurement is recorded for the values down to `crest_lumps`.

/// Deviations of a peridiole: of its radius from that of the style, of its outline from a circle,
/// of its place along the meridian and its tilt.
constexpr double size_spread = 0.12, outline_waves = 0.06, place_spread = 0.25, tilt_spread = 0.35;

/// Latitude of the lower rim of a lens, which lies on its flat side, radians below its equator.
constexpr double lens_bottom = 1.0;

/// Share of the peridioles that lie on the bottom of the cup; the others lie on them.
constexpr double lowest_layer = 0.64;

/// How deep a peridiole lies in what is under it, in its thicknesses.
constexpr double sunk = 0.12;

/// Amount of peridioles below which the last one is gone, and over which each shrinks away.
constexpr double last_amount = 0.05, vanishing = 0.08;

/// The largest share of the way to the middle of a mesh that an arm takes.
constexpr double most_inset = 0.82;

/// Rounds in which the corners of a mesh are rounded.
constexpr int rounding = 11;

/// Lumps of a spongy arm: across it, and of its crest, in its own widths and thicknesses.
constexpr double side_lumps = 0.3, crest_lumps = 0.2;

/// Rounds in which lumps are evened along an arm.
constexpr int lump_rounds = 4;

/// Exponents of the section of an arm, which is flattened with round edges: of the sine and cosine of
/// its angle, and of their share in the normal.
constexpr double section_power = 0.62, normal_power = 1.4;

/// Where round an arm, from its outer to its inner crest, the gleba begins and how soon it covers
/// all; the share of the veil's strip that paints what is outside it.
constexpr double gleba_begins = 0.5, gleba_border = 0.2, outer_paint = 0.35;

/// Samples of an edge of a mesh at the finest level; others use every second, sixth or twelfth.
constexpr int edge_samples = 12;

/// Resolution of solids by the columns of their level of detail.
struct Resolution {
    int least_columns;
    int lens_rows, lens_columns;     ///< 0: not built
    int edge_step, section_samples;  ///< every n-th sample of an edge; bands from crest to crest
    int most_meshes;                 ///< of a net; the arms of fewer meshes are wider
};
constexpr std::array<Resolution, 7> resolutions = {{{64, 6, 16, 1, 4, 40},
                                                    {48, 5, 12, 2, 3, 40},
                                                    {36, 4, 8, 6, 4, 40},
                                                    {28, 4, 8, 6, 3, 40},
                                                    {20, 4, 8, 12, 3, 40},
                                                    {12, 3, 6, 12, 2, 25},
                                                    {0, 0, 0, 12, 2, 5}}};

const Resolution& resolution_of(const Detail& detail) { return by_columns(resolutions, detail); }

/// Returns the share of peridioles and meshes that a crowded level builds: spines are left out first.
double retained(const Detail& detail) { return std::min(2.0 * detail.free_solids, 1.0); }

/// Returns how many meshes of a net a level builds.
int built_meshes(const ReceptacleLayer& layer, const Detail& detail) {
    const int most =
        std::min(std::max(layer.style.meshes, least_cells), resolution_of(detail).most_meshes);
    if (detail.free_solids <= 0.0) return 0;
    return std::max(static_cast<int>(std::floor(most * retained(detail) + 0.5)), least_cells);
}

SolidGrid lens_grid(const Detail& detail) {
    const Resolution& resolution = resolution_of(detail);
    return {resolution.lens_rows, resolution.lens_columns, false};
}

/// Returns the factor on the size of a net by which its straight chords lie as far outside its
/// surface as inside.
double outwards(int meshes, const Resolution& resolution) {
    // A regular hexagon of side a has the area 1.5 sqrt(3) a^2; the meshes cover the sphere.
    const double side = std::sqrt(4.0 * pi / (1.5 * std::sqrt(3.0) * meshes));
    const double half = 0.5 * side * resolution.edge_step / edge_samples;
    return 1.0 + 0.25 * half * half;
}

/// Returns how many peridioles a level builds.
int built_lenses(const PeridioleLayer& layer, const Detail& detail) {
    if (resolution_of(detail).lens_rows == 0) return 0;
    return static_cast<int>(std::floor(layer.style.count * retained(detail) + 0.5));
}

/// Returns the size factor of the k-th of `count` peridioles: the last ones leave first.
double left(int k, int count, double amount) {
    const double needed = last_amount + (1.0 - last_amount - vanishing) * k / count;
    return smooth_step(needed, needed + vanishing, amount);
}

/// Builds one lens in a frame at rest.
///
/// up  unit normal of its flat side
void build_lens(GridSolid& solid, const glm::dvec3& centre, const glm::dvec3& up, double radius,
                double thickness, Random& random) {
    const double second = random.uniform(0.0, 2.0 * pi), third = random.uniform(0.0, 2.0 * pi);
    const glm::dvec3 ahead = square_to(up, glm::dvec3(1.0, 0.0, 0.0));
    const glm::dvec3 aside = glm::cross(ahead, up);
    solid.corners.clear();
    for (int i = 0; i < solid.rows; ++i) {
        const SineCosine latitude =
            sine_cosine(-lens_bottom + (0.5 * pi + lens_bottom) * i / (solid.rows - 1));
        const bool is_tip = i == solid.rows - 1;
        for (int j = 0; j <= solid.columns; ++j) {
            const double angle = -2.0 * pi * (j % solid.columns) / solid.columns;
            const SineCosine turn = sine_cosine(angle);
            const double wavy =
                1.0 + outline_waves * (sine(2.0 * angle + second) + sine(3.0 * angle + third));
            const double r = is_tip ? 0.0 : radius * wavy * latitude.cosine;
            solid.corners.push_back(centre + r * (turn.cosine * ahead + turn.sine * aside) +
                                    0.5 * thickness * latitude.sine * up);
        }
    }
}

void add_layer(Mesh& mesh, const PeridioleLayer& layer, const OrnamentContext& context) {
    GridSolid solid{lens_grid(context.detail), Part::flesh, {}, {}};
    const PeridioleStyle& style = layer.style;
    const std::vector<OutlineSample> rings = context.outline.rings(CurveName::cap, context.level);
    const AxisStation station = context.deformer.frozen_station(context.deformer.top());
    const int columns = detail_of(context.level).columns;
    const int below = static_cast<int>(std::ceil(lowest_layer * style.count));
    const double golden = pi * (3.0 - std::sqrt(5.0));
    for (int k = 0; k < built_lenses(layer, context.detail); ++k) {
        Random random(context.seed, purposes::peridioles, static_cast<std::uint32_t>(k));
        const double drawn = 1.0 + size_spread * random.symmetric();
        const double nearer = place_spread * random.symmetric();
        const double turned = random.uniform(0.0, 2.0 * pi);
        glm::dvec3 tilt(0.0);
        tilt.x = tilt_spread * random.symmetric();
        tilt.z = tilt_spread * random.symmetric();
        const int storey = k / below, place = k % below,
                  lying = std::min(below, style.count - storey * below);
        const double scale = layer.weight * left(k, style.count, layer.amount);
        const double radius = 0.5 * scale * drawn * style.size;
        const double thickness = 2.0 * radius * style.thickness;
        const double sigma =
            style.reach * std::sqrt(std::clamp((place + 0.5 + nearer) / lying, 0.0, 1.0));
        const double theta = golden * place + turned * 0.15 + 1.1 * storey;
        const SurfacePoint at =
            context.rest_surface.meshed(Part::cap, rings, columns, 1.0 - sigma,
                                        theta - 2.0 * pi * std::floor(theta / (2.0 * pi)));
        const glm::dvec3 normal =
            unit_or(glm::cross(at.meridian, at.azimuth), glm::dvec3(0.0, 1.0, 0.0));
        const glm::dvec3 up = unit_or(normal + tilt, normal);
        const double lift = thickness * (0.5 * sine(lens_bottom) - sunk + (1.0 - sunk) * storey);
        const glm::dvec3 dented = at.position + context.dents.cap(sigma, theta) * normal;
        build_lens(solid, dented + lift * normal, up, radius, thickness, random);
        context.deformer.apply(solid.corners, station);
        append(mesh, solid, unit_or(station.direction(dented, up), glm::dvec3(0.0, 1.0, 0.0)),
               context.textured, radius > 0.0 || context.keep_absent);
    }
}

/// The egg-shaped surface of revolution along which a receptacle's arms run.
class EggShape {
  public:
    /// floor  height at which it is rooted, metres
    /// scale  factor on all sizes
    EggShape(const ReceptacleStyle& style, double floor, double scale)
        : style_(style), floor_(floor), scale_(scale) {
        for (int i = 0; i <= samples; ++i) {
            const double t = static_cast<double>(i) / samples;
            places_[static_cast<std::size_t>(i)] = place(t);
        }
        for (std::size_t i = 1; i <= samples; ++i)
            arcs_[i] = arcs_[i - 1] + glm::length(places_[i] - places_[i - 1]);
    }

    struct Point {
        glm::dvec3 position, normal;
    };

    /// Returns the point in a direction from the middle of a sphere that is stretched over it.
    [[nodiscard]] Point at(const glm::dvec3& direction) const {
        const double across = std::sqrt(direction.x * direction.x + direction.z * direction.z);
        const double latitude = arc_tangent(across, -direction.y) / pi;  // 0 at the base, 1 on top
        const double share = latitude * (1.0 + style_.stretch * (1.0 - latitude));
        const glm::dvec2 here = along(share), ahead = along(std::min(share + step, 1.0)),
                         behind = along(std::max(share - step, 0.0));
        const glm::dvec2 run = ahead - behind;
        const double length = std::max(glm::length(run), 1e-15);
        const double x = across > 0.0 ? direction.x / across : 1.0,
                     z = across > 0.0 ? direction.z / across : 0.0;
        const double out = run.y / length, up = -run.x / length;
        return {{here.x * x, here.y, here.x * z},
                unit_or(glm::dvec3(out * x, up, out * z), glm::dvec3(0.0, 1.0, 0.0))};
    }

  private:
    static constexpr int samples = 64;
    static constexpr double step = 0.01;

    /// Returns radius and height at a share of the height.
    [[nodiscard]] glm::dvec2 place(double t) const {
        const double widest = style_.widest, reach = 0.5 * scale_ * style_.width;
        // Both ends run into the axis at right angles to it; samples are denser there.
        const double even = 0.5 - 0.5 * cosine(pi * t);
        double r = 0.0;
        if (even < widest) {
            const double up = even / widest;
            const double bulge = sine(0.5 * pi * up);
            const double closes =
                std::sqrt(std::min(1.0, up / bottom) * (2.0 - std::min(1.0, up / bottom)));
            r = (style_.neck + (1.0 - style_.neck) * bulge * bulge) * closes;
        } else {
            const double up = (even - widest) / (1.0 - widest);
            r = std::sqrt(std::max(1.0 - up * up, 0.0));
        }
        return {reach * r, floor_ + scale_ * (style_.base + style_.height * even)};
    }
    /// Share of the height below the widest place over which the base closes.
    static constexpr double bottom = 0.12;

    [[nodiscard]] glm::dvec2 along(double share) const {
        const double arc = share * arcs_.back();
        std::size_t k = 0;
        while (k + 1 < samples && arcs_[k + 1] < arc) ++k;
        const double length = arcs_[k + 1] - arcs_[k];
        const double t = length > 0.0 ? std::clamp((arc - arcs_[k]) / length, 0.0, 1.0) : 0.0;
        return places_[k] + t * (places_[k + 1] - places_[k]);
    }

    const ReceptacleStyle& style_;
    double floor_, scale_;
    std::array<glm::dvec2, samples + 1> places_{};
    std::array<double, samples + 1> arcs_{};
};

/// A sample of the middle line of an arm, which two meshes share.
struct Crest {
    glm::dvec3 position, normal;
    double half;  ///< half the thickness of the arm
};

/// Returns the samples of the arm between two corners, from the one with the lower index to the
/// other, so that both of its meshes have the same numbers.
std::vector<Crest> arm_between(const SphereCells& net, std::size_t from, std::size_t to,
                               const EggShape& egg, double thickness, std::uint32_t seed) {
    const auto key = static_cast<std::uint32_t>(from * net.corners.size() + to);
    std::vector<Crest> crests;
    Random random(seed, purposes::net_arms, key);
    double lump = 0.0;
    for (int i = 0; i <= edge_samples; ++i) {
        const double t = static_cast<double>(i) / edge_samples;
        const glm::dvec3 direction =
            unit_or((1.0 - t) * net.corners[from] + t * net.corners[to], glm::dvec3(0.0, 1.0, 0.0));
        const EggShape::Point at = egg.at(direction);
        lump = 0.75 * lump + 0.66 * crest_lumps * random.symmetric();
        // At its ends an arm meets two others, and all three have the same thickness there.
        const bool is_end = i == 0 || i == edge_samples;
        crests.push_back({at.position, at.normal, 0.5 * thickness * (is_end ? 1.0 : 1.0 + lump)});
    }
    return crests;
}

/// Returns where on the veil's strip a place of an arm is painted, 0..1: the tip's colour, which is
/// that of the gleba, covers the inner side.
///
/// round  0 on the outer crest, 1 on the inner one
double painted(double round) {
    return round < gleba_begins
               ? outer_paint * round / gleba_begins
               : outer_paint +
                     (1.0 - outer_paint) * std::min((round - gleba_begins) / gleba_border, 1.0);
}

/// One mesh of the net: samples of its border and, for each, of the rim of its hole.
struct NetMesh {
    std::vector<Crest> border;
    std::vector<glm::dvec3> rim;
};

NetMesh mesh_of(const SphereCells& net, const SphereCells::Cell& cell, const EggShape& egg,
                double width, double thickness, std::uint32_t seed) {
    NetMesh out;
    std::vector<glm::dvec3> inwards;  // unit, square to the arm, at each sample
    const EggShape::Point middle = egg.at(cell.centre);
    for (std::size_t k = 0; k < cell.corners.size(); ++k) {
        const std::size_t a = cell.corners[k], b = cell.corners[(k + 1) % cell.corners.size()];
        std::vector<Crest> arm =
            arm_between(net, std::min(a, b), std::max(a, b), egg, thickness, seed);
        if (a > b) std::reverse(arm.begin(), arm.end());
        const glm::dvec3 run = arm.back().position - arm.front().position;
        for (std::size_t i = 0; i + 1 < arm.size(); ++i) {
            out.border.push_back(arm[i]);
            inwards.push_back(
                unit_or(glm::cross(arm[i].normal, run), middle.position - arm[i].position));
        }
    }
    // The rim runs at half a width from the border; where two arms meet, at that from both.
    const std::size_t count = out.border.size();
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 way = middle.position - out.border[i].position;
        const bool is_corner = i % edge_samples == 0;
        const glm::dvec3 inward =
            is_corner ? unit_or(inwards[i] + inwards[(i + count - 1) % count], inwards[i])
                      : inwards[i];
        const double far = std::max(glm::dot(way, inward), 1e-12);
        out.rim.push_back(out.border[i].position + std::min(0.5 * width / far, most_inset) * way);
    }
    std::vector<glm::dvec3> before;
    for (int round = 0; round < rounding; ++round) {
        before = out.rim;
        for (std::size_t i = 0; i < count; ++i)
            out.rim[i] = 0.5 * before[i] +
                         0.25 * (before[(i + 1) % count] + before[(i + count - 1) % count]);
    }
    return out;
}

/// Appends one mesh: bands from the outer crest of its border round the rim to the inner one.
void append_mesh(Mesh& mesh, const NetMesh& one, const OrnamentContext& context,
                 const AxisStation& station, Random& random, bool drawn) {
    const Resolution& resolution = resolution_of(context.detail);
    const std::size_t step = static_cast<std::size_t>(resolution.edge_step),
                      columns = one.border.size() / step;
    const int bands = resolution.section_samples;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    // Lumps are drawn for all samples, so that every level has the same.
    std::vector<double> lumps;
    for (std::size_t i = 0; i < one.border.size(); ++i) lumps.push_back(random.symmetric());
    std::vector<double> before_round;
    for (int round = 0; round < lump_rounds; ++round) {
        before_round = lumps;
        for (std::size_t i = 0; i < lumps.size(); ++i)
            lumps[i] = 0.5 * before_round[i] +
                       0.25 * (before_round[(i + 1) % lumps.size()] +
                               before_round[(i + lumps.size() - 1) % lumps.size()]);
    }
    for (int band = 0; band <= bands; ++band) {
        const SineCosine round = sine_cosine(pi * band / bands);
        const bool is_crest = band == 0 || band == bands;
        const double across = is_crest ? 0.0 : power(round.sine, section_power);
        const double up =
            std::abs(round.cosine) > 1e-9 ? power(std::abs(round.cosine), section_power) : 0.0;
        for (std::size_t j = 0; j <= columns; ++j) {
            const std::size_t i = (j % columns) * step;
            const Crest& crest = one.border[i];
            const glm::dvec3 to_rim = one.rim[i] - crest.position;
            const double lump = lumps[i];
            const double side = round.cosine < 0.0 ? -1.0 : 1.0;
            const double height = is_crest ? (band == 0 ? 1.0 : -1.0) : side * up;
            glm::dvec3 place = crest.position +
                               across * (1.0 + side_lumps * lump * across) * to_rim +
                               height * crest.half * crest.normal;
            const glm::dvec3 normal =
                (is_crest ? height : side * power(std::max(up, 1e-9), normal_power)) *
                    crest.normal +
                (is_crest ? 0.0 : power(across, normal_power)) * unit_or(to_rim, crest.normal);
            const std::size_t after = (i + step) % one.border.size(),
                              before = (i + one.border.size() - step) % one.border.size();
            const glm::dvec3 ahead =
                (1.0 - across) * (one.border[after].position - one.border[before].position) +
                across * (one.rim[after] - one.rim[before]);
            const glm::dvec3 turned =
                unit_or(station.direction(place, normal), glm::dvec3(0.0, 1.0, 0.0));
            context.deformer.apply(std::span(&place, 1), station);
            mesh.positions.emplace_back(place);
            mesh.normals.emplace_back(turned);
            if (!context.textured) continue;
            const TexturePoint uv =
                strip_point(veil, static_cast<double>(j) / static_cast<double>(columns),
                            veil_outer_to * painted(static_cast<double>(band) / bands));
            mesh.texture_coordinates.emplace_back(uv.u, uv.v);
            mesh.tangents.emplace_back(
                glm::vec3(square_to(turned, station.direction(place, ahead))), -1.0F);
        }
    }
    if (!drawn) return;
    const auto row = static_cast<std::uint32_t>(columns + 1);
    for (int band = 0; band < bands; ++band)
        for (std::size_t j = 0; j < columns; ++j) {
            const std::uint32_t at =
                first + static_cast<std::uint32_t>(band) * row + static_cast<std::uint32_t>(j);
            mesh.indices.insert(mesh.indices.end(),
                                {at, at + 1, at + row, at + 1, at + row + 1, at + row});
        }
}

}  // namespace

MeshCount peridiole_count(const Individual& individual, const Detail& detail) {
    MeshCount sum;
    for (const PeridioleLayer& layer : individual.peridioles)
        sum += lens_grid(detail).count().times(built_lenses(layer, detail));
    return sum;
}

MeshCount receptacle_count(const Individual& individual, const Detail& detail) {
    const Resolution& resolution = resolution_of(detail);
    MeshCount sum;
    for (const ReceptacleLayer& layer : individual.receptacles) {
        const int meshes = built_meshes(layer, detail);
        if (meshes == 0) continue;
        // Each of the 3 n - 6 arms is sampled once from either side.
        const int columns = 2 * (3 * meshes - 6) * (edge_samples / resolution.edge_step);
        const auto bands = static_cast<std::uint64_t>(resolution.section_samples);
        sum += MeshCount{bands + 1, 2 * bands}.times(columns);
        sum.vertices += (bands + 1) * static_cast<std::uint64_t>(meshes);  // repeated seams
    }
    return sum;
}

void add_peridioles(Mesh& mesh, const Individual& individual, const OrnamentContext& context) {
    for (const PeridioleLayer& layer : individual.peridioles) add_layer(mesh, layer, context);
}

void add_receptacles(Mesh& mesh, const Individual& individual, const OrnamentContext& context) {
    for (const ReceptacleLayer& layer : individual.receptacles) {
        const ReceptacleStyle& style = layer.style;
        const double scale = layer.weight * layer.amount;
        const int meshes = built_meshes(layer, context.detail);
        if (meshes == 0) continue;
        const EggShape egg(style, context.outline.cap.at(1.0).y,
                           scale * outwards(meshes, resolution_of(context.detail)));
        const SphereCells net = sphere_cells(meshes, context.seed);
        const AxisStation station = context.deformer.frozen_station(context.deformer.top());
        // Arms of fewer meshes are as much wider as keeps what is seen through them.
        const double width =
            scale * style.arm * std::sqrt(static_cast<double>(style.meshes) / meshes);
        for (std::size_t k = 0; k < net.cells.size(); ++k) {
            Random random(context.seed, purposes::net_lumps, static_cast<std::uint32_t>(k));
            append_mesh(mesh,
                        mesh_of(net, net.cells[k], egg, width, width * (1.0 - style.flatness),
                                context.seed),
                        context, station, random, scale > 0.0 || context.keep_absent);
        }
    }
}

}  // namespace sporeprint
