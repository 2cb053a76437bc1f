#include "core/geometry/ornaments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

constexpr const Chart& veil = swept_charts[static_cast<std::size_t>(Part::veil)];

/// A closed solid made of a grid of corners: rows from its base to its tip, columns round it, the first column repeated.
struct Solid {
    std::vector<glm::dvec3> corners;  ///< [row][column]
    std::vector<glm::dvec3> normals;  ///< worked out by append()
    int rows = 0, columns = 0;        ///< columns without the repeated one
    bool loops =
        false;  ///< the last row meets the first (a ring); else the base is closed by a polygon
};

/// Appends a solid: normals by area over what shares a place, texture from the veil's strip. Without `drawn` its vertices alone.
void append(Mesh& mesh, Solid& solid, const glm::dvec3& fallback, bool textured, bool drawn) {
    const std::size_t indices = mesh.indices.size();
    const int row = solid.columns + 1;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * row + j); };
    const auto& p = solid.corners;
    const bool pointed = !solid.loops;  // its last row is one place
    std::vector<glm::dvec3>& normals = solid.normals;
    normals.assign(p.size(), glm::dvec3(0.0));
    glm::dvec3 tip(0.0);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        const glm::dvec3 n = glm::cross(p[b] - p[a], p[c] - p[a]);
        normals[a] += n;
        normals[b] += n;
        normals[c] += n;
        mesh.indices.insert(mesh.indices.end(), {first + static_cast<std::uint32_t>(a),
                                                 first + static_cast<std::uint32_t>(b),
                                                 first + static_cast<std::uint32_t>(c)});
    };
    const int bands = solid.loops ? solid.rows : solid.rows - 1;
    for (int i = 0; i < bands; ++i)
        for (int j = 0; j < solid.columns; ++j) {
            const int above = (i + 1) % solid.rows;
            add(at(i, j), at(i, j + 1), at(above, j));
            if (!(pointed && above == solid.rows - 1))
                add(at(i, j + 1), at(above, j + 1), at(above, j));
        }
    for (int i = 0; i < solid.rows; ++i) {
        normals[at(i, 0)] += normals[at(i, solid.columns)];
        normals[at(i, solid.columns)] = normals[at(i, 0)];
    }
    if (pointed) {
        for (int j = 0; j < solid.columns; ++j) tip += normals[at(solid.rows - 1, j)];
        for (int j = 0; j <= solid.columns; ++j) normals[at(solid.rows - 1, j)] = tip;
    }
    for (int i = 0; i < solid.rows; ++i)
        for (int j = 0; j <= solid.columns; ++j) {
            const glm::dvec3 normal = unit_or(normals[at(i, j)], fallback);
            mesh.positions.emplace_back(p[at(i, j)]);
            mesh.normals.emplace_back(normal);
            if (!textured) continue;
            const double along =
                solid.loops ? std::min(i, solid.rows - 1 - i) / (0.5 * solid.rows - 1.0 + 1e-9)
                            : static_cast<double>(i) / (solid.rows - 1);
            const TexturePoint uv =
                strip_point(veil, static_cast<double>(j) / solid.columns, std::min(along, 1.0));
            mesh.texture_coordinates.emplace_back(uv.u, uv.v);
            const int ahead = j < solid.columns ? j + 1 : 1,
                      behind = j > 0 ? j - 1 : solid.columns - 1;
            const int side = pointed && i == solid.rows - 1 ? i - 1 : i;
            const glm::dvec3 tangent = p[at(side, ahead)] - p[at(side, behind)];
            // Going round counter-clockwise with the tip above, image-up is towards the base; the ring's other side is mirrored.
            const bool mirrored = solid.loops && i >= solid.rows / 2;
            mesh.tangents.emplace_back(glm::vec3(square_to(normal, tangent)),
                                       mirrored ? 1.0F : -1.0F);
        }
    if (!drawn) mesh.indices.resize(indices);
    if (solid.loops) return;
    // The base, seen from below.
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    glm::dvec3 below(0.0);
    for (int j = 1; j + 1 < solid.columns; ++j)
        below += glm::cross(p[at(0, j + 1)] - p[at(0, 0)], p[at(0, j)] - p[at(0, 0)]);
    below = unit_or(below, -fallback);
    for (int j = 0; j < solid.columns; ++j) {
        mesh.positions.emplace_back(p[at(0, j)]);
        mesh.normals.emplace_back(below);
        if (!textured) continue;
        const TexturePoint uv = strip_point(veil, static_cast<double>(j) / solid.columns, 0.0);
        mesh.texture_coordinates.emplace_back(uv.u, uv.v);
        mesh.tangents.emplace_back(glm::vec3(square_to(below, p[at(0, 1)] - p[at(0, 0)])), 1.0F);
    }
    for (int j = 1; drawn && j + 1 < solid.columns; ++j)
        mesh.indices.insert(mesh.indices.end(), {base, base + static_cast<std::uint32_t>(j + 1),
                                                 base + static_cast<std::uint32_t>(j)});
}

/// Share of the stem's arc length at which a place of the mature stem lies now: on its segment, at its share of it. The same place
/// when the stem is the mature one.
double grown_share(const std::vector<double>& mature, const std::vector<double>& now,
                   double share) {
    if (mature.size() != now.size()) return share;  // nothing known of another age
    std::size_t k = 0;
    while (k + 2 < mature.size() && mature[k + 1] <= share) ++k;
    const double length = mature[k + 1] - mature[k];
    const double within = length > 0.0 ? std::clamp((share - mature[k]) / length, 0.0, 1.0) : 0.0;
    return now[k] + within * (now[k + 1] - now[k]);
}

/// Adds the pieces of one layer.
void add_layer(Mesh& mesh, const PatchLayer& layer, const Ground& ground) {
    if (ground.detail.patch_sides == 0) return;
    const PatchStyle& style = layer.style;
    // Positions run up the stem, or from the apex down.
    const bool on_stem = layer.purpose == purposes::bulb_scales;
    const SubCurve& curve = on_stem ? ground.outline.stem : ground.outline.cap;
    const std::vector<double> segments = on_stem ? curve.segment_shares() : std::vector<double>{};
    const double length = ground.outline.cap.length();
    const Part part = on_stem ? Part::stem : Part::cap;
    const int columns = detail_of(ground.lod).columns;
    const std::vector<OutlineSample> rings =
        ground.outline.rings(on_stem ? CurveName::stem : CurveName::cap, ground.lod);
    const int sides = ground.detail.patch_sides, between = ground.detail.patch_rings;
    // An outline with fewer corners stands wider, so that it covers as much.
    // Low pieces are cushions, tall ones spines.
    const double pointed = smooth_step(0.9, 1.5, style.height);
    const auto covered = [](int corners) { return corners * sine(2.0 * pi / corners); };
    const double wider = std::sqrt(covered(details[0].patch_sides) / covered(sides));
    Solid solid;
    std::vector<Patch> built = patches(style, ground.seed, layer.purpose);
    if (ground.detail.patches < 1.0) {
        std::stable_sort(built.begin(), built.end(),
                         [](const Patch& a, const Patch& b) { return a.drawn > b.drawn; });
        built.resize(
            std::min(built.size(), static_cast<std::size_t>(piece_count(layer, ground.detail))));
    }
    for (const Patch& patch : built) {
        const double scale = layer.weight * patch_scale(patch, layer.amount);
        // What stood where the margin is cut has moved inwards with it.
        const OutlineSample at =
            curve.at(on_stem ? grown_share(layer.segments, segments, patch.sigma)
                             : 1.0 - ground.cuts.cap(patch.sigma, patch.theta));
        // On the mesh itself, whose chords stand off from the skin: nothing is left under it, or in the air.
        const SurfacePoint place = ground.skin.meshed(part, rings, columns, at.share, patch.theta);
        glm::dvec3 normal = glm::cross(place.meridian, place.azimuth), meridian = place.meridian;
        if (!ground.skin.plain()) {
            normal = unit_or(normal, glm::dvec3(0.0, 1.0, 0.0));
            meridian = square_to(normal, meridian);
        }
        const glm::dvec3 outward = on_stem ? meridian : -meridian;
        // (round, outward, normal) is right-handed, so that corners run counter-clockwise seen from outside.
        const glm::dvec3 round = glm::cross(outward, normal);
        const double radius = patch.radius * scale * length, height = patch.height * radius;
        glm::dvec3 centre = place.position;
        if (!on_stem) centre += ground.dents.cap(patch.sigma, patch.theta) * normal;
        const AxisStation station = ground.deformer.frozen_station(
            on_stem ? std::min(at.y, ground.deformer.top()) : ground.deformer.top());
        solid.rows = between + 2;
        solid.columns = sides;
        solid.corners.clear();
        Random random(ground.seed, purposes::corners + layer.purpose - purposes::warts, patch.id);
        // Seven draws whatever the detail; a coarser outline takes some of them.
        std::array<double, 7> reach{};
        for (double& r : reach) r = random.uniform(0.78, 1.12);
        const double tip_round = 0.25 * random.symmetric();
        const double tip_outward = 0.25 * random.symmetric() + 1.1 * style.lift;
        std::array<glm::dvec3, 7> rim{};
        for (int j = 0; j < sides; ++j) {
            const auto turn = sine_cosine(patch.spin + 2.0 * pi * j / sides);
            rim[static_cast<std::size_t>(j)] =
                wider * radius * reach[static_cast<std::size_t>(j * 7 / sides)] *
                (turn.cosine * round + turn.sine * style.elongation * outward);
        }
        const glm::dvec3 tip =
            radius * (tip_round * round + tip_outward * style.elongation * outward);
        for (int i = 0; i < solid.rows; ++i) {
            const double up = static_cast<double>(i) / (solid.rows - 1);
            const double narrowing = (1.0 - up) * (1.0 + 0.55 * up * (1.0 - 2.2 * pointed));
            const glm::dvec3 middle =
                centre + up * tip + (i == 0 ? -0.25 * radius : height * up) * normal;
            for (int j = 0; j < sides; ++j)
                solid.corners.push_back(middle + narrowing * rim[static_cast<std::size_t>(j)]);
            solid.corners.push_back(
                solid.corners[solid.corners.size() - static_cast<std::size_t>(sides)]);
        }
        ground.deformer.apply(solid.corners, station);
        if (!on_stem && !ground.curl.none()) {
            const glm::dvec3 by = ground.curl.moved(true, 1.0 - at.share, patch.theta);
            for (glm::dvec3& corner : solid.corners) corner += by;
        }
        const glm::dvec3 fallback =
            unit_or(station.direction(centre, normal), glm::dvec3(0.0, 1.0, 0.0));
        append(mesh, solid, fallback, ground.textured, radius > 0.0 || ground.keep_absent);
    }
}

/// How far a stem has risen along its way, metres: what is flatter than `least` counts as rising so much of its length, so that a
/// place by its rise never leaps along rays that lie flat or bend down to the ground.
class Rise {
  public:
    Rise(const SubCurve& stem, double least) : stem_(stem) {
        OutlineSample last = stem.at(0.0);
        for (int i = 1; i <= looks; ++i) {
            const OutlineSample here = stem.at(static_cast<double>(i) / looks);
            risen_[static_cast<std::size_t>(i)] =
                risen_[static_cast<std::size_t>(i - 1)] +
                std::max(here.y - last.y, least * stem.length() / looks);
            last = here;
        }
    }
    [[nodiscard]] double whole() const { return risen_.back(); }
    [[nodiscard]] OutlineSample at(double rise) const {
        const auto above = std::upper_bound(risen_.begin() + 1, risen_.end() - 1, rise);
        const double from = *(above - 1), to = *above;
        const double t = to > from ? std::clamp((rise - from) / (to - from), 0.0, 1.0) : 0.0;
        return stem_.at((static_cast<double>(above - 1 - risen_.begin()) + t) / looks);
    }

  private:
    static constexpr int looks = 96;
    const SubCurve& stem_;
    std::array<double, looks + 1> risen_{};
};

/// How far a shell of a size lies on what dents the stem inside it: wholly when all but gone, no more when it is a third as large as
/// the stem is thick.
double lying(double size, double radius) { return 1.0 - smooth_step(0.0, 0.3 * radius, size); }

/// How far an edge is torn at an angle, 0..1: rents between `count` lobes, and a finer raggedness.
class Rents {
  public:
    Rents(Random& random, int least, int most)
        : count_(least +
                 static_cast<int>(random.bits() % static_cast<std::uint32_t>(most - least + 1))) {
        for (double& phase : phases_) phase = random.uniform(0.0, 2.0 * pi);
    }
    [[nodiscard]] double at(double angle) const {
        const double rent = 0.5 + 0.5 * sine(count_ * angle + phases_[0]);
        const double uneven = 0.5 + 0.5 * sine(angle + phases_[1]);
        const double fine = 0.5 + 0.5 * sine((2 * count_ + 3) * angle + phases_[2]);
        return 0.62 * rent * rent * rent + 0.23 * uneven + 0.15 * fine;
    }

  private:
    int count_;
    std::array<double, 3> phases_{};
};

}  // namespace

int shell_rings(const Individual& individual, const Detail& detail) {
    const bool ring = individual.has_ring && detail.veil_rings > 0;
    const bool sac = individual.has_sac && detail.sac_rings > 0;
    return (ring ? 2 * (detail.veil_rings + 1) : 0) + (sac ? 2 * (detail.sac_rings + 1) : 0);
}

int piece_count(const PatchLayer& layer, const Detail& detail) {
    if (detail.patch_sides == 0 || std::abs(layer.style.to - layer.style.from) < least_window)
        return 0;
    return static_cast<int>(std::ceil(detail.patches * layer.style.count));
}

void add_patches(Mesh& mesh, const Individual& individual, const Ground& ground) {
    for (const PatchLayer& layer : individual.layers) add_layer(mesh, layer, ground);
}

void add_ring(Mesh& mesh, const Individual& individual, const Ground& ground) {
    const RingStyle& style = individual.ring;
    const int rings = ground.detail.veil_rings;
    if (rings == 0 || !individual.has_ring) return;
    const Rise rise(ground.outline.stem, 0.2);
    const OutlineSample attachment = rise.at(style.height * rise.whole());
    const double height = attachment.y;
    const double width = style.width;
    const double thickness = std::min(style.thickness, 0.3 * width);
    Random groove_stream(ground.seed, purposes::ring_grooves),
        tear_stream(ground.seed, purposes::ring_tear);
    const int groove_count = 15 + static_cast<int>(groove_stream.bits() % 5);
    const Rents rents(tear_stream, 9, 13);
    Random random(ground.seed, purposes::ring_ruffle);
    const int waves = 5 + static_cast<int>(random.bits() % 4);
    const double phase = random.uniform(0.0, 2.0 * pi);
    const double other = random.uniform(0.0, 2.0 * pi);
    const AxisStation station = ground.deformer.frozen_station(height);

    // Centre line of the cross-section: leaves the stem at the flare and hangs down towards its edge.
    struct Station {
        double r, y, normal_r, normal_y, share;
    };
    std::vector<Station> line;
    // A little inside the stem; a ring that comes or goes no deeper than it is wide.
    const double sunk = std::min(0.02 * attachment.r, 0.25 * width);
    const double clear = style.gap * std::min(attachment.r, width);
    double r = std::max(attachment.r + clear - 0.5 * thickness - sunk, thickness), y = attachment.y;
    for (int i = 0; i <= rings; ++i) {
        const double share = static_cast<double>(i) / rings;
        const auto turn = sine_cosine(radians(style.flare_deg) * (1.0 - style.hang * share));
        line.push_back({r, y, turn.cosine, turn.sine, share});
        r += width / rings * turn.sine;
        y -= width / rings * turn.cosine;
    }
    struct Column {
        SineCosine turn;
        double ruffle, groove, reach, dent;
    };
    // What is left of a ring lies on the stem's furrows and lumps; a whole one spans them.
    const double lies = lying(width, attachment.r);
    std::vector<Column> columns;
    for (int j = 0; j <= ground.detail.columns; ++j) {
        const double angle = -2.0 * pi * (j % ground.detail.columns) /
                             ground.detail.columns;  // counter-clockwise seen from above
        // Grooves too fine for these columns would beat with them.
        columns.push_back(
            {sine_cosine(angle),
             sine(waves * angle + phase) + 0.6 * sine((2 * waves + 1) * angle + other),
             3 * groove_count > ground.detail.columns ? 0.0 : sine(groove_count * angle + other),
             1.0 - 0.8 * style.tear * rents.at(angle),
             lies > 0.0 ? lies * ground.dents.stem(attachment.share, angle) : 0.0});
    }
    // The veil tears off level with its edge, which is thicker.
    Solid solid{{}, {}, 2 * (rings + 1), ground.detail.columns, true};
    for (int i = 0; i < solid.rows; ++i) {
        const bool lower = i <= rings;
        const int row = lower ? i : solid.rows - 1 - i;
        const double whole_share = static_cast<double>(row) / rings;
        // A double edge: two lips that stand off from each other.
        const double half =
            (lower ? -0.5 : 0.5) * thickness *
            (0.6 + 0.8 * whole_share + 5.0 * style.edge * smooth_step(0.45, 1.0, whole_share));
        for (const Column& column : columns) {
            // Where the edge is torn the line ends sooner.
            const double place = row * column.reach;
            const auto before =
                static_cast<std::size_t>(std::min<int>(static_cast<int>(place), rings - 1));
            const double beyond = place - static_cast<double>(before);
            const Station &from = line[before], &to = line[before + 1];
            const Station at{from.r + beyond * (to.r - from.r), from.y + beyond * (to.y - from.y),
                             from.normal_r + beyond * (to.normal_r - from.normal_r),
                             from.normal_y + beyond * (to.normal_y - from.normal_y),
                             from.share + beyond * (to.share - from.share)};
            const double off = half +
                               style.ruffle * 0.16 * width * at.share * at.share * column.ruffle +
                               style.grooves * 0.04 * width * at.share * column.groove;
            const double rr = std::max(at.r + off * at.normal_r + column.dent, 0.0),
                         yy = at.y + off * at.normal_y;
            solid.corners.push_back(
                ground.skin.azimuth().moved({rr * column.turn.cosine, yy, rr * column.turn.sine}));
        }
    }
    ground.deformer.apply(solid.corners, station);
    append(mesh, solid, glm::dvec3(0.0, 1.0, 0.0), ground.textured,
           width > 0.0 || ground.keep_absent);
}

void add_sac(Mesh& mesh, const Individual& individual, const Ground& ground) {
    const SacStyle& style = individual.sac;
    const int rings = ground.detail.sac_rings;
    if (rings == 0 || !individual.has_sac) return;
    const double height = style.height;
    const double thickness = std::min(style.thickness, 0.2 * height);
    // From under the bulb, or where a stem ends that grows from a wall above or below it; a low one holds as much of the bulb as it is
    // high, or it would run in under a flat foot faster than it grows.
    const double base = ground.deformer.base();
    const double level =
        std::min(std::max(base, 0.0), std::max(base, ground.outline.stem.at(1.0).y));
    const double buried = std::min(std::max(level - base, 0.0), 0.6 * height);
    Random random(ground.seed, purposes::sac);
    const Rents rents(random, 3, 5);
    Random fold_stream(ground.seed, purposes::sac_folds);
    const int folds = 5 + static_cast<int>(fold_stream.bits() % 3);
    std::array<double, 3> phases{};
    for (double& phase : phases) phase = fold_stream.uniform(0.0, 2.0 * pi);
    const double lean = fold_stream.uniform(-1.5, 1.5);

    // The way of its skin: along the stem up to where that is widest, and on from there by itself.
    constexpr int samples = 48;
    const Rise way_up(ground.outline.stem, 0.2);
    struct Way {
        double r, y, normal_r, normal_y;
        double clear;  // how far it is from the stem
        double above;  // 0 at the ground, 1 at the highest lobe
        double share;  // of the stem
    };
    std::array<Way, samples + 1> way{};
    double widest = 0.0;
    for (int i = 0; i <= samples; ++i) {
        // Rows crowd under the bulb, where the stem turns.
        const double share = static_cast<double>(i) / samples;
        const double climb = share * (0.12 + 0.88 * share);
        const double y = level - buried + (buried + height) * climb;
        const OutlineSample stem = way_up.at(y - base);
        const double above = height > 0.0 ? std::clamp((y - level) / height, 0.0, 1.0) : 0.0;
        widest = std::max(widest, stem.r);
        const double held = style.hold * (widest - stem.r);
        const double off = held + style.gap * height * above * above;
        const bool free = stem.r < widest;
        way[static_cast<std::size_t>(i)] = {
            stem.r + off, stem.y,    free ? 1.0 : stem.tangent_y, free ? 0.0 : -stem.tangent_r, off,
            above,        stem.share};
    }
    // By arc length, so that rows lie as close where it turns under the bulb as where it rises.
    std::array<double, samples + 1> arcs{};
    for (std::size_t i = 1; i <= samples; ++i) {
        const double dr = way[i].r - way[i - 1].r, dy = way[i].y - way[i - 1].y;
        arcs[i] = arcs[i - 1] + std::sqrt(dr * dr + dy * dy);
    }
    const auto way_at = [&](double share) {
        const double arc = share * arcs.back();
        std::size_t k = 0;
        while (k + 1 < samples && arcs[k + 1] < arc) ++k;
        const double step = arcs[k + 1] - arcs[k];
        const double t = step > 0.0 ? std::clamp((arc - arcs[k]) / step, 0.0, 1.0) : share;
        const Way &a = way[k], &b = way[k + 1];
        const auto mix = [t](double x, double y) { return x + t * (y - x); };
        return Way{mix(a.r, b.r),
                   mix(a.y, b.y),
                   mix(a.normal_r, b.normal_r),
                   mix(a.normal_y, b.normal_y),
                   mix(a.clear, b.clear),
                   mix(a.above, b.above),
                   mix(a.share, b.share)};
    };
    // Folds too fine for these columns would beat with them.
    const bool fine = 4 * (2 * folds + 1) <= ground.detail.columns;
    const auto fold_at = [&](double angle, double share) {
        const double coarse = sine(folds * angle + phases[0] + lean * share);
        return 0.5 * coarse + 0.3 * sine(2.0 * angle + phases[1]) +
               (fine ? 0.2 * sine((2 * folds + 1) * angle + phases[2] - lean * share) : 0.0);
    };
    const double lies = lying(height, widest);
    // Inside the stem where it begins, outside of it before long.
    const double sunk = std::min(0.02 * widest, 0.25 * height);
    // A single band would cut through the bulb: from afar it is the wall alone.
    const double first = rings > 1 ? 0.01 : 0.6;
    Solid solid{{}, {}, 2 * (rings + 1), ground.detail.columns, true};
    for (int i = 0; i < solid.rows; ++i) {
        const bool outside = i <= rings;
        const double share = static_cast<double>(outside ? i : solid.rows - 1 - i) / rings;
        for (int j = 0; j <= ground.detail.columns; ++j) {
            const double angle =
                -2.0 * pi * (j % ground.detail.columns) / ground.detail.columns;  // as the ring
            const double up =
                first + (1.0 - first) * share * (1.0 - 0.62 * style.tear * rents.at(angle));
            const Way at = way_at(up);
            // The skin thins towards its edge, lies in folds where it is loose, and its lobes bend out or in.
            const double half = (outside ? 0.5 : -0.5) * thickness * (1.2 - 0.6 * share);
            const double fold = fold_at(angle, up);
            const double loose = at.clear * (0.5 * fold - 0.12 * at.above);
            const double rise = (sunk + 0.75 * thickness) * smooth_step(0.0, 0.16, share) - sunk;
            const double off = half + rise + std::max(loose, -0.8 * at.clear);
            double r = std::max(at.r + off * at.normal_r, thickness + half);
            if (lies > 0.0) r = std::max(r + lies * ground.dents.stem(at.share, angle), 0.0);
            const auto turn = sine_cosine(angle);
            glm::dvec3 place = ground.skin.azimuth().moved(
                {r * turn.cosine, at.y + off * at.normal_y, r * turn.sine});
            ground.deformer.apply(std::span(&place, 1), ground.deformer.station(std::min(
                                                            place.y, ground.deformer.top())));
            solid.corners.push_back(place);
        }
    }
    append(mesh, solid, glm::dvec3(0.0, 1.0, 0.0), ground.textured,
           height > 0.0 || ground.keep_absent);
}

}  // namespace sporeprint
