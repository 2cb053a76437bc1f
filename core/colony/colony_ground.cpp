#include "core/colony/colony_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/colony/colony_skin.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/index_order.h"
#include "core/mesh/measure.h"

namespace sporeprint {

namespace {

// No source or measurement is recorded for the values below.

/// Triangles of the ground by level of detail, at most: at the second level enough for some soil at
/// the feet of the largest colony, at the last one for those of the usual number.
constexpr std::array<std::uint64_t, 4> most_triangles = {20'000, 4'700, 850, 450};
/// A row of pieces is used down to so many sixteenths of them; then the next coarser row is.
constexpr int sixteenths = 16, least_sixteenths = 5;

/// Soil of the youngest foot, for that of the thickest.
constexpr double least_soil = 0.5;

/// A tuft holds more soil than one stem does: factors on how far it reaches, how high it rises, on the
/// size of its pieces, and, for a tuft of many, on their number.
constexpr double tuft_reach = 1.9, tuft_rise = 2.0, tuft_size = 1.15, tuft_pieces = 2.0;

/// Each stem of a tuft has pushed up a little mound of the common soil: factors on how far it reaches
/// and how high it rises, at least and at most; how many rows coarser it is than the common clod.
constexpr double mound_reach = 0.75, least_mound = 2.2, most_mound = 4.5;
constexpr int mound_coarser = 2;

/// Numbers of the random draws of mounds, after those of the clods of feet.
constexpr std::uint32_t first_mound = 1U << 20U;

/// Directions in which the outline of a tuft is sampled; how much wider than its stems it is.
constexpr int directions = 96;
constexpr double round_stems = 1.15;

/// How far a clod reaches below the surface of a foot, in reaches of its soil; least depth of that
/// surface, in that of the foot.
constexpr double clod_below = 0.5, least_depth = 0.35;

/// Directions in which the foot of a whole individual is measured, and the share of its height that
/// counts as foot if nothing of it is below the ground.
constexpr int sectors = 16;
constexpr double low_share = 0.08;

const glm::dvec3 upwards(0.0, 1.0, 0.0);

glm::dvec3 horizontal(double angle) {
    const SineCosine at = sine_cosine(angle);
    return {at.cosine, 0.0, at.sine};
}

/// Returns how deep the surface lies of which the clod is an offset, so that the clod is little deeper
/// than the foot itself: what only some levels have should not change the bounds.
double depth_below(const ColonyFoot& foot, const std::vector<GroundLayer>& layers) {
    double reach = 0.0;
    for (const GroundLayer& layer : layers)
        reach = std::max(reach, layer.weight * layer.style.soil.reach);
    return std::max(foot.depth - clod_below * reach, least_depth * foot.depth);
}

/// Returns the surface of one foot below the ground: a slanting stem with a round end.
Foot surface_of(ColonyFoot foot, const std::vector<GroundLayer>& layers) {
    foot.depth = depth_below(foot, layers);
    const double steep = std::max(foot.along.y, 0.3);
    const glm::dvec3 down = -foot.along / steep;
    const glm::dvec3 aside = unit_or({foot.along.x, 0.0, foot.along.z}, {1.0, 0.0, 0.0});
    return [foot, down, aside, steep](double depth, double angle) {
        const glm::dvec3 out = horizontal(angle);
        const double round = std::sqrt(std::max(1.0 - depth * depth * depth * depth, 0.0));
        // A level section of a slanting stem is longer the way it slants.
        const glm::dvec3 section = out + (1.0 / steep - 1.0) * glm::dot(out, aside) * aside;
        return FootPoint{foot.at + foot.depth * depth * down + foot.radius * round * section,
                         unit_or(round * out - depth * depth * upwards, out)};
    };
}

/// The outline of all feet of a tuft, seen from above, about their middle.
class TuftOutline {
  public:
    TuftOutline(const std::vector<ColonyFoot>& feet, const std::vector<GroundLayer>& layers) {
        for (const ColonyFoot& foot : feet) {
            middle_ += foot.at / static_cast<double>(feet.size());
            depth_ = std::max(depth_, depth_below(foot, layers));
        }
        std::array<double, directions> reach{};
        for (int i = 0; i < directions; ++i)
            for (const ColonyFoot& foot : feet)
                reach[static_cast<std::size_t>(i)] =
                    std::max(reach[static_cast<std::size_t>(i)],
                             reach_of(foot, horizontal(2.0 * pi * i / directions)));
        // Soil bridges narrow gaps between stems.
        for (int i = 0; i < directions; ++i)
            reach_[static_cast<std::size_t>(i)] = 0.4 * at(reach, i) +
                                                  0.2 * (at(reach, i - 1) + at(reach, i + 1)) +
                                                  0.1 * (at(reach, i - 2) + at(reach, i + 2));
    }

    /// Returns the surface of the tuft below the ground, which narrows to its lowest point.
    [[nodiscard]] FootPoint surface(double depth, double angle) const {
        const double turns = angle / (2.0 * pi), place = (turns - std::floor(turns)) * directions;
        const int below = static_cast<int>(place);
        const double share = place - below;
        const double reach = (1.0 - share) * at(reach_, below) + share * at(reach_, below + 1);
        const glm::dvec3 out = horizontal(angle);
        const double round = std::sqrt(std::max(1.0 - depth * depth, 0.0));
        return {middle_ + round * reach * out - depth * depth_ * upwards,
                unit_or(round * out - depth * upwards, out)};
    }

  private:
    glm::dvec3 middle_{0.0};
    double depth_ = 0.0;
    std::array<double, directions> reach_{};

    static double at(const std::array<double, directions>& table, int direction) {
        return table[static_cast<std::size_t>((direction + directions) % directions)];
    }

    /// Returns how far a foot, and what lies between it and the middle, reach in a direction.
    [[nodiscard]] double reach_of(const ColonyFoot& foot, const glm::dvec3& out) const {
        const double radius = round_stems * foot.radius;
        // A slanting stem is longer in section, and farther out where it leaves the soil.
        const double slant = 1.0 / std::max(foot.along.y, 0.3) - 1.0;
        const glm::dvec3 to =
            foot.at - middle_ + slant * foot.radius * glm::dvec3(foot.along.x, 0.0, foot.along.z);
        const double ahead = glm::dot(to, out);
        const double far = glm::dot(to, to), aside = std::max(far - ahead * ahead, 0.0);
        if (ahead <= 0.0) return far <= radius * radius ? within(radius, ahead, aside) : radius;
        if (aside < radius * radius) return within(radius, ahead, aside);
        // Beside the foot, what lies between has the width of the foot.
        return radius * std::sqrt(far / aside);
    }
    static double within(double radius, double ahead, double aside) {
        return ahead + std::sqrt(std::max(radius * radius - aside, 0.0));
    }
};

/// Returns layers of other sizes: factors on the soil's reach, on its rise, and on all pieces.
std::vector<GroundLayer> scaled(std::vector<GroundLayer> layers, double reach, double rise,
                                double size) {
    for (GroundLayer& layer : layers) {
        layer.style.soil.reach *= reach;
        layer.style.soil.rise *= rise;
        for (double* const length :
             {&layer.style.soil.size, &layer.style.litter.length, &layer.style.strands.length})
            *length *= size;
    }
    return layers;
}

/// Returns the layers of the one clod of a tuft.
std::vector<GroundLayer> tuft_layers(std::vector<GroundLayer> layers, int count) {
    const double more = std::min(tuft_pieces, 0.75 + 0.25 * count);
    for (GroundLayer& layer : layers)
        for (int* const pieces : {&layer.style.soil.lumps, &layer.style.litter.pieces})
            *pieces = static_cast<int>(std::ceil(more * *pieces));
    return scaled(std::move(layers), tuft_reach, tuft_rise, tuft_size);
}

/// Returns the layers of the mounds of a tuft, without litter.
std::vector<GroundLayer> mound_layers(std::vector<GroundLayer> layers, double rise) {
    for (GroundLayer& layer : layers) layer.style.litter.pieces = layer.style.strands.count = 0;
    return scaled(std::move(layers), mound_reach, rise, 1.0);
}

/// Returns the detail of the mounds of a tuft; those of the coarsest rows are left out.
ColonyGroundDetail mound_detail(const ColonyGroundDetail& tuft) {
    const int row = tuft.row + mound_coarser;
    if (row >= ground_rows) return {ground_rows - 1, 0.0, false};
    return {row, tuft.share, false};
}

/// The layers that the ground of a colony is counted by: of the clod of one foot, or of the one clod
/// and of each mound of a tuft.
struct CountedLayers {
    std::vector<GroundLayer> clod, mound;

    CountedLayers(const std::vector<GroundLayer>& layers, bool fused, int count)
        : clod(fused ? tuft_layers(layers, count) : layers) {
        if (fused) mound = mound_layers(layers, 1.0);
    }

    /// Returns the counts of all of it.
    [[nodiscard]] MeshCount total(const ColonyGroundDetail& detail, int count) const {
        if (!detail.fused) return ground_count(clod, detail).times(count);
        MeshCount sum = ground_count(clod, detail);
        sum += ground_count(mound, mound_detail(detail)).times(count);
        return sum;
    }
};

}  // namespace

bool stands_in_soil(const ColonyTraits& traits) {
    return traits.habit != Habit::tier && traits.roots == RootsShown::buried;
}

ColonyFoot foot_of(const Mesh& mesh) {
    const Bounds box = bounds(mesh);
    const auto low = static_cast<double>(box.min.y), high = static_cast<double>(box.max.y);
    const double top = low < 0.0 ? 0.0 : low + low_share * (high - low);
    std::array<double, sectors> reach{};
    for (const glm::vec3& place : mesh.positions) {
        if (static_cast<double>(place.y) > top) continue;
        const glm::dvec3 at(place);
        for (int i = 0; i < sectors; ++i)
            reach[static_cast<std::size_t>(i)] =
                std::max(reach[static_cast<std::size_t>(i)],
                         glm::dot(at, horizontal(2.0 * pi * i / sectors)));
    }
    ColonyFoot foot;
    for (const double one : reach) foot.radius += one / sectors;
    foot.depth = std::max(-low, 0.0);
    return foot;
}

std::vector<ColonyFoot> feet_of(const ColonySite& site, const std::vector<ColonyMember>& members,
                                const std::vector<ColonyFoot>& models) {
    std::vector<ColonyFoot> feet;
    for (const ColonyMember& member : members) {
        const ColonyPlace& place = site.places[member.place];
        ColonyFoot foot;
        if (!models.empty()) {
            foot = models[member.model];
            foot.radius *= member.pose.scale;
            foot.depth *= member.pose.scale;
            foot.along = member.pose.turn[1];
            foot.at = {member.pose.at.x, 0.0, member.pose.at.z};
        } else {
            // Stems of a tuft begin below the ground.
            const auto at = [&](double t) {
                return place.foot + t * member.rise + t * t * member.swing;
            };
            double below = 0.0, above = 1.0;
            for (int i = 0; i < 40 && place.foot.y < 0.0; ++i) {
                const double t = 0.5 * (below + above);
                (at(t).y < 0.0 ? below : above) = t;
            }
            foot.at = at(below);
            foot.at.y = 0.0;
            foot.along = unit_or(member.rise + 2.0 * below * member.swing, upwards);
            foot.radius = place.radius;
            foot.depth = std::max(-place.foot.y, 0.0) +
                         (stem_below_ground * unit_or(member.rise, upwards).y + 0.5) * place.radius;
        }
        foot.number = place.number;
        feet.push_back(foot);
    }
    return feet;
}

ColonyGroundDetail colony_ground_detail(const std::vector<GroundLayer>& layers,
                                        const ColonyTraits& traits, int count, int lod) {
    ColonyGroundDetail detail;
    detail.fused = traits.habit == Habit::tuft;
    const std::uint64_t most = most_triangles[static_cast<std::size_t>(lod)];
    const CountedLayers counted(layers, detail.fused, count);
    if (stands_in_soil(traits))
        for (detail.row = lod; detail.row < ground_rows; ++detail.row)
            for (int share = sixteenths; share >= least_sixteenths; --share) {
                detail.share = static_cast<double>(share) / sixteenths;
                if (counted.total(detail, count).triangles <= most) return detail;
            }
    detail.row = ground_rows - 1;
    detail.share = 0.0;
    return detail;
}

MeshCount colony_ground_count(const std::vector<GroundLayer>& layers, const ColonyTraits& traits,
                              int count, int lod) {
    const ColonyGroundDetail detail = colony_ground_detail(layers, traits, count, lod);
    return CountedLayers(layers, detail.fused, count).total(detail, count);
}

Mesh colony_ground(const std::vector<GroundLayer>& layers, const std::vector<ColonyFoot>& feet,
                   const ColonyTraits& traits, int count, int lod, bool textured) {
    Mesh mesh;
    const ColonyGroundDetail detail = colony_ground_detail(layers, traits, count, lod);
    if (feet.empty() || layers.empty() || !(detail.share > 0.0)) return mesh;
    const auto seed_of = [&](std::uint32_t number) {
        return Random(traits.seed, purposes::ground, number).bits();
    };
    if (detail.fused) {
        const std::vector<GroundLayer> common = tuft_layers(layers, count);
        const TuftOutline outline(feet, common);
        const Foot surface = [&](double depth, double angle) {
            return outline.surface(depth, angle);
        };
        add_ground(mesh, common, surface, detail, seed_of(0), textured);
        for (const ColonyFoot& foot : feet) {
            Random random(traits.seed, purposes::ground, first_mound + foot.number);
            const double rise = random.uniform(least_mound, most_mound);
            const std::vector<GroundLayer> mound = mound_layers(layers, rise);
            add_ground(mesh, mound, surface_of(foot, mound), mound_detail(detail), random.bits(),
                       textured);
        }
    } else {
        double thickest = 0.0;
        for (const ColonyFoot& foot : feet) thickest = std::max(thickest, foot.radius);
        for (const ColonyFoot& foot : feet) {
            const double grown =
                least_soil + (1.0 - least_soil) * foot.radius / std::max(thickest, 1e-9);
            const std::vector<GroundLayer> own = scaled(layers, grown, grown, grown);
            add_ground(mesh, own, surface_of(foot, own), detail, seed_of(foot.number), textured);
        }
    }
    order_for_vertex_cache(mesh);
    return mesh;
}

}  // namespace sporeprint
