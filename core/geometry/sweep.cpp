#include "core/geometry/sweep.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/geometry/budget.h"
#include "core/geometry/collar.h"
#include "core/geometry/curl.h"
#include "core/geometry/damage_dents.h"
#include "core/geometry/hymenium.h"
#include "core/geometry/ornaments.h"
#include "core/geometry/weathering.h"
#include "core/geometry/wrap.h"
#include "core/individual/proportion.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/measure.h"
#include "core/params/messages.h"
#include "core/problems.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

constexpr int cap_dents = 7, stem_dents = 4;

glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(glm::dot(v, v)); }

std::string text(double value) {
    std::string digits = std::to_string(std::floor(value * 10.0) / 10.0);
    return digits.substr(0, digits.find('.') + 2);
}

class Sweeper {
  public:
    /// columns  their positions, in turns
    Sweeper(Mesh& mesh, const Deformer& deformer, const RestSurface& rest_surface,
            const std::vector<double>& columns, bool textured)
        : mesh_(mesh),
          deformer_(deformer),
          rest_surface_(rest_surface),
          columns_(static_cast<int>(columns.size())),
          textured_(textured),
          shares_(columns),
          row_(columns.size() + 1) {
        for (const double turn : columns) turns_.push_back(rest_surface.column(2.0 * pi * turn));
        turns_.push_back(turns_.front());
        shares_.push_back(1.0);
    }

    FaceGrid face(Part part, const std::vector<OutlineSample>& samples) {
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        FaceGrid grid{part, first, {}};
        for (const OutlineSample& sample : samples) {
            ring(part, sample);
            grid.shares.push_back(sample.share);
        }
        const auto row = static_cast<std::uint32_t>(columns_ + 1);
        for (std::uint32_t i = 0; i + 1 < samples.size(); ++i) {
            const bool below = samples[i].r > 0.0, above = samples[i + 1].r > 0.0;
            for (std::uint32_t j = 0; j + 1 < row; ++j) {
                const std::uint32_t a = first + i * row + j, b = a + 1, c = a + row, d = c + 1;
                if (below) mesh_.indices.insert(mesh_.indices.end(), {a, c, b});
                if (above) mesh_.indices.insert(mesh_.indices.end(), {b, c, d});
            }
        }
        return grid;
    }

  private:
    void ring(Part part, const OutlineSample& sample) {
        const AxisStation station = deformer_.station(part, sample);
        const Chart& chart = swept_charts[static_cast<std::size_t>(part)];
        const double length = rest_surface_.curve(part).length();
        for (int j = 0; j <= columns_; ++j)
            row_[static_cast<std::size_t>(j)] =
                rest_surface_.at(part, sample, turns_[static_cast<std::size_t>(j)]);
        deformer_.apply(row_, station);
        for (int j = 0; j <= columns_; ++j) {
            const SurfacePoint& point = row_[static_cast<std::size_t>(j)];
            const glm::dvec3 normal = unit(glm::cross(point.meridian, point.azimuth));
            mesh_.positions.emplace_back(point.position);
            mesh_.normals.emplace_back(normal);
            if (textured_) texture(part, chart, sample, length, j, point, normal);
        }
    }

    void texture(Part part, const Chart& chart, const OutlineSample& sample, double length, int j,
                 const SurfacePoint& point, const glm::dvec3& normal) {
        const auto [s, c] = turns_[static_cast<std::size_t>(j)].azimuth.from;
        glm::dvec3 along;
        TexturePoint at{};
        double handedness = -1.0;
        if (part == Part::stem) {
            at = strip_point(chart, sample.share, shares_[static_cast<std::size_t>(j)]);
            along = point.meridian;
        } else {
            const bool cap = part == Part::cap;
            const double share =
                cap ? 1.0 - sample.share
                    : hymenium_inner_share + (1.0 - hymenium_inner_share) * sample.share;
            const double by_radius =
                cap ? -length
                    : length / (1.0 - hymenium_inner_share);  // arc length per disc radius
            const double by_angle =
                share > 1e-9 ? sample.r / share : length;  // `length` is the limit at the pole
            at = disc_point(chart, share, c, s);
            along = c * by_radius * point.meridian - s * by_angle * point.azimuth;
            handedness = cap ? 1.0 : -1.0;
        }
        along -= glm::dot(along, normal) * normal;
        const double size = glm::dot(along, along);
        const glm::dvec3 tangent =
            size > 1e-24 ? along / std::sqrt(size)
                         : unit(point.azimuth - glm::dot(point.azimuth, normal) * normal);
        mesh_.texture_coordinates.emplace_back(at.u, at.v);
        mesh_.tangents.emplace_back(glm::vec3(tangent), static_cast<float>(handedness));
    }

    Mesh& mesh_;
    const Deformer& deformer_;
    const RestSurface& rest_surface_;
    int columns_;
    bool textured_;
    std::vector<double> shares_;  // positions of the columns, in turns
    std::vector<RestSurface::Column> turns_;
    std::vector<SurfacePoint> row_;
};

}  // namespace

Deformer::Deformer(const Individual& individual)
    : base_(individual.stem_base),
      top_(std::max(individual.stem_top, individual.stem_base + 1e-4)),
      axis_(individual.axis, individual.model.deformation, axis_angles(individual), base_, top_),
      unevenness_(individual) {
    const Model& model = individual.model;
    const Outline& outline = individual.outline;
    const std::uint32_t seed = individual.shape_seed;
    const double radius = unevenness_.reach_of_stem(greatest_radius(outline.stem));
    const double fold = axis_.greatest_curvature() * radius;
    DeformationOf<Plain> unbent = model.deformation;
    unbent.bend_deg = 0.0;
    if (fold >= 0.98 &&
        Axis(individual.axis, unbent, {}, base_, top_).greatest_curvature() * radius >= 0.98)
        throw Impossible({{"/model/axis", "curves so tightly that the stem, " +
                                              text(2000.0 * greatest_radius(outline.stem)) +
                                              " mm wide, folds"}});
    if (fold >= 0.98)
        throw Impossible(
            {{"/deformation/bend_deg",
              text(model.deformation.bend_deg) + " folds this stem; about " +
                  text(0.95 * model.deformation.bend_deg / fold) + " is the most over this zone"}});
    if (model.deformation.imperfection <= 0.0) return;
    const AzimuthMap azimuth(individual, details[0].columns);
    const auto push_at = [&](std::uint32_t index, const SubCurve& curve, double share, double size,
                             double reach) {
        Random random(seed, purposes::dents, index);
        const double angle = random.uniform(0.0, 2.0 * pi);
        const double along = random.uniform();
        const double strength = random.symmetric();
        const double width = random.uniform(0.75, 1.25);
        const OutlineSample at = curve.at(share * along);
        const auto [s, c] = sine_cosine(angle);
        SurfacePoint place{{at.r * c, at.y, at.r * s},
                           {at.tangent_r * c, at.tangent_y, at.tangent_r * s},
                           {-s, 0.0, c}};
        glm::dvec3 normal(at.tangent_y * c, -at.tangent_r, at.tangent_y * s);
        if (!azimuth.identity()) {
            azimuth.apply(place, azimuth.column(angle));
            normal = unit(glm::cross(place.meridian, place.azimuth));
        }
        const double push = model.deformation.imperfection *
                            (strength < 0.0 ? strength - 0.3 : strength + 0.3) * reach;
        dents_.push_back(dent(place.position, glm::dvec3(size * width), push * normal));
    };
    const double cap_radius = greatest_radius(outline.cap);
    for (std::uint32_t i = 0; i < cap_dents; ++i)
        push_at(i, outline.cap, 0.9, 1.5 * cap_radius, 0.055 * cap_radius);
    const double stem_radius = greatest_radius(outline.stem);
    const double stem_size = std::max(2.5 * stem_radius, 0.3 * (top_ - base_));
    for (std::uint32_t i = 0; i < stem_dents; ++i)
        push_at(100 + i, outline.stem, 1.0, stem_size, 0.14 * stem_radius);
}

AxisStation Deformer::station(Part part, const OutlineSample& sample) const {
    // Everything above the stem's end (a bulging top) moves with the cap, where the frame is
    // constant.
    if (part != Part::stem) return frozen_station(top_);
    return station(sample.share == 1.0 ? top_ : sample.y);
}

void Deformer::apply(std::span<SurfacePoint> points, const AxisStation& station) const {
    for (const FreeForm& dent : dents_) dent.apply(points);
    unevenness_.apply(points);
    for (SurfacePoint& point : points) {
        point.meridian = station.direction(point.position, point.meridian);
        point.azimuth = station.direction(point.position, point.azimuth);
        point.position = station.point(point.position);
    }
}

void Deformer::apply(std::span<glm::dvec3> places, const AxisStation& station) const {
    for (const FreeForm& dent : dents_) dent.apply(places);
    unevenness_.apply(places);
    for (glm::dvec3& place : places) place = station.point(place);
}

Mesh swept_mesh(const Individual& individual, DetailLevel level, const SweepOptions& options) {
    const Outline& outline = individual.outline;
    const Detail detail = detail_of(level);
    const std::uint32_t seed = individual.painted_seed;
    const Deformer deformer(individual);
    // Images have the relief that the mesh of their level does not carry, so that a finer mesh must
    // not carry more.
    const RestSurface rest_surface(individual, detail,
                                   detail_of(std::max(level, DetailLevel(level.nearest()))));
    const MarginCuts cuts(individual, level);
    Mesh mesh;
    const Budget budget = budget_of(individual, level);
    const auto vertices = static_cast<std::size_t>(budget.count.vertices);
    mesh.positions.reserve(vertices);
    mesh.normals.reserve(vertices);
    mesh.indices.reserve(vertices * 6);
    if (options.textured) {
        mesh.texture_coordinates.reserve(vertices);
        mesh.tangents.reserve(vertices);
    }
    SweptBody body;
    Sweeper sweeper(mesh, deformer, rest_surface, cuts.turns(), options.textured);
    body.stem = sweeper.face(
        Part::stem, options.stem.empty()
                        ? outline.rings(CurveName::stem, level)
                        : std::vector<OutlineSample>(options.stem.begin(), options.stem.end()));
    const LowerFace lower(individual, level, budget.solids);
    const std::vector<OutlineSample> flesh = lower.flesh(outline, level);
    body.hymenium = sweeper.face(Part::hymenium, flesh);
    body.cap = sweeper.face(Part::cap, outline.rings(CurveName::cap, level));
    // A sheet a metre wide would be thinner than its dents on the mesh; no species of the atlas is
    // one.
    if (individual.parts.front().id.empty() && volume(mesh) <= 0.0)
        throw Impossible("/model/silhouette",
                         "so thin for its width that dents turn it inside out at level of detail " +
                             number_text(level.number()));
    const Curl curl = weather(mesh, body, individual, cuts, level, options.keep_absent);
    const Dents dents(individual);
    const OrnamentContext context{outline,
                                  deformer,
                                  rest_surface,
                                  budget.ornaments,
                                  level,
                                  seed,
                                  options.textured,
                                  options.keep_absent,
                                  cuts,
                                  curl,
                                  dents,
                                  flesh,
                                  individual};
    add_ornaments(mesh, individual, context);
    if (budget.solids) add_hymenium(mesh, individual, lower, context, budget);
    BracketBase(individual).apply(mesh);
    add_collar(mesh, body, budget.solids ? &lower : nullptr, cuts.turns(), individual, level,
               options.textured);
    wrap_round_trunk(mesh, individual.bending_radius());
    return mesh;
}

}  // namespace sporeprint
