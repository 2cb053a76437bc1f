#include "core/colony/colony_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/index_order.h"
#include "core/mesh/tangents.h"
#include "core/skeleton/skin.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

/// Distance of the end of a stem's skin below its junction, in radii; its round end reaches half a
/// radius further.
constexpr double short_of_cap = 0.8;
/// Least length of a stem's segment, in radii: cleaning would detach shorter ones; on a root the
/// fork takes up additional length.
constexpr double least_segment = 2.7, least_on_root = 3.6;
/// Number of nodes whose twice subdivided skin has about 60,000 triangles.
constexpr std::size_t most_near_nodes = 210;
/// A strip with a stem on it, or where nothing has a label, is a stem if it rises by more than this
/// many of its radii.
constexpr double risen = 3.2;

/// Share of the band of soil that a root leaves at either edge.
constexpr double soil_margin = 0.06;

/// Radii of the cords on which stems stand, in those of the source: where a stem stands, elsewhere,
/// and at their ends, which are in the ground by this depth; depth of the others, in their radii, and
/// how far it varies.
constexpr double root_at_stem = 0.85, root_elsewhere = 0.5, root_end = 0.3, end_depth = 0.7,
                 root_depth = 0.1, root_heave = 0.25;

/// Numbers of the random draws of roots, beyond those of the ground of a colony.
constexpr std::uint32_t first_cord = 1U << 24U;

/// Along a root between two forks or stems every n-th node remains, by level of detail.
constexpr std::array<std::uint32_t, 4> root_strides = {1, 1, 2, 4};

/// Texture coordinates along a strip, in images, with mirrored repeat. Mirror positions are the
/// rings next to the ends of images.
class MirroredRepeat {
  public:
    /// rings  ascending distances; length > 0
    MirroredRepeat(const std::vector<double>& rings, double length) {
        double turned_at = 0.0;
        int turns = 0;
        for (std::size_t i = 0; i < rings.size(); ++i) {
            const double images = (rings[i] - turned_at) / length;
            // The nearer of two rings at the end of an image.
            const bool ends =
                i + 1 < rings.size() && i > 0 && images > 0.25 &&
                std::abs(images - 1.0) <= std::abs((rings[i + 1] - turned_at) / length - 1.0);
            if (!ends) continue;
            knots_.push_back({rings[i], ++turns});
            turned_at = rings[i];
        }
        length_ = length;
    }

    [[nodiscard]] double at(double distance) const {
        double from = 0.0;
        int turns = 0;
        for (const Knot& knot : knots_) {
            if (distance <= knot.at) {
                const double share = (distance - from) / (knot.at - from);
                return turns % 2 == 0 ? share : 1.0 - share;
            }
            from = knot.at;
            turns = knot.turns;
        }
        const double share = std::min(std::max((distance - from) / length_, 0.0), 1.0);
        return turns % 2 == 0 ? share : 1.0 - share;
    }

  private:
    struct Knot {
        double at;
        int turns;
    };
    std::vector<Knot> knots_;
    double length_ = 1.0;
};

/// Texture coordinates along a stem: what its image shows below the ground is in the ground, and the
/// rest above it.
class StemImage {
  public:
    /// first, last   vertices of the strip
    /// length        of the strip
    /// upwards       it begins at its lower end
    /// painted_from  share of the image that shows what is buried
    StemImage(const SkinnedSkeleton& made, std::size_t first, std::size_t last, double length,
              bool upwards, double painted_from)
        : length_(length), upwards_(upwards), painted_from_(painted_from) {
        double below = 0.0, above = length;
        for (std::size_t i = first; i < last; ++i) {
            const double height = height_of(made.places[i].y);
            if (made.mesh.positions[i].y < 0.0F)
                below = std::max(below, height);
            else
                above = std::min(above, height);
        }
        // Rings of a slanting stem are partly in the ground.
        ground_ = below > 0.0 ? std::min(0.5 * (below + above), 0.5 * length) : 0.0;
    }

    /// along  place along the strip
    [[nodiscard]] double at(double along) const {
        const double height = height_of(along);
        if (height < ground_) return painted_from_ * height / ground_;
        return painted_from_ +
               (1.0 - painted_from_) * (height - ground_) / std::max(length_ - ground_, 1e-9);
    }

  private:
    double length_, ground_ = 0.0;
    bool upwards_;
    double painted_from_;

    /// Returns the distance from the lower end.
    [[nodiscard]] double height_of(double along) const {
        const double within = std::min(std::max(along, 0.0), length_);
        return upwards_ ? within : length_ - within;
    }
};

/// Returns the texture coordinates of a soiled root, across which the image is mirrored.
///
/// along   place in the image, 0..1
/// around  0..1
TexturePoint soil_point(double along, double around) {
    const auto& [low, high] = ground_bands.front();
    const double across = std::abs(2.0 * around - 1.0);
    return strip_point(swept_charts[static_cast<std::size_t>(Part::ground)], along,
                       low + (high - low) * (soil_margin + (1.0 - 2.0 * soil_margin) * across));
}

void add_texture_coordinates(SkinnedSkeleton& made, const SkinOptions& options) {
    Mesh& mesh = made.mesh;
    const Chart& chart = swept_charts[static_cast<std::size_t>(Part::stem)];
    mesh.texture_coordinates.resize(mesh.positions.size());
    std::vector<double> rings;
    const bool has_labels = std::any_of(made.labels.begin(), made.labels.end(),
                                        [](std::uint32_t label) { return label > 0; });
    for (std::size_t s = 0; s < made.strips.size(); ++s) {
        const Scaffold::Strip& strip = made.strips[s];
        const double length = std::max(strip.length, 1e-9);
        const std::size_t first = made.begins[s], last = made.begins[s + 1];
        double low = 1e9, high = -1e9, begins = 0.0, ends = 0.0;
        rings.clear();
        for (std::size_t i = first; i < last; ++i) {
            const auto y = static_cast<double>(mesh.positions[i].y);
            const double along = std::min(std::max(made.places[i].y, 0.0), length);
            low = std::min(low, y);
            high = std::max(high, y);
            // Mean heights, weighted by nearness to either end: a stem starts at the lower one.
            begins += y * (length - along);
            ends += y * along;
            rings.push_back(along);
        }
        std::sort(rings.begin(), rings.end());
        rings.erase(std::unique(rings.begin(), rings.end(),
                                [&](double a, double b) { return b - a < 1e-6 * length; }),
                    rings.end());
        std::size_t labelled = 0;
        for (std::size_t i = first; i < last; ++i) labelled += made.labels[i] > 0 ? 1 : 0;
        // The strip of a stem may begin with a stretch of root.
        const bool has_risen = high - low > risen * strip.radius;
        const bool stem = has_labels ? 2 * labelled > last - first || (labelled > 0 && has_risen)
                                     : !options.soiled && has_risen;
        double sum_begins = 0.0, sum_ends = 0.0;
        for (std::size_t i = first; i < last; ++i) {
            const double along = std::min(std::max(made.places[i].y, 0.0), length);
            sum_begins += length - along;
            sum_ends += along;
        }
        const bool upwards = begins * sum_ends <= ends * sum_begins;
        const StemImage image(made, first, last, length, upwards, options.painted_from);
        const MirroredRepeat root(rings, options.painted_length);
        for (std::size_t i = first; i < last; ++i) {
            const double along = std::min(std::max(made.places[i].y, 0.0), length);
            const double share =
                stem ? image.at(along)
                     : options.painted_from + (1.0 - options.painted_from) * root.at(along);
            const double around = std::min(std::max(made.places[i].x, 0.0), 1.0);
            const TexturePoint at = !stem && options.soiled ? soil_point(root.at(along), around)
                                                            : strip_point(chart, share, around);
            mesh.texture_coordinates[i] = {at.u, at.v};
        }
    }
    add_tangents(mesh);
}

/// Returns roots as cords in the soil rather than tubes on the ground.
///
/// bears  by node: carries a stem
Skeleton sunken_roots(Skeleton ground, const std::vector<bool>& bears, std::uint32_t seed) {
    std::vector<int> segments_at(ground.nodes.size(), 0);
    for (const Skeleton::Segment& segment : ground.segments) {
        ++segments_at[segment.from];
        ++segments_at[segment.to];
    }
    for (std::size_t i = 0; i < ground.nodes.size(); ++i) {
        Skeleton::Node& node = ground.nodes[i];
        Random random(seed, purposes::ground, first_cord + static_cast<std::uint32_t>(i));
        const bool is_end = segments_at[i] == 1 && !bears[i];
        const double deep = is_end ? end_depth : root_depth + root_heave * random.symmetric();
        node.place.y -= deep * node.radius;
        node.radius *= is_end ? root_end : bears[i] ? root_at_stem : root_elsewhere;
    }
    return ground;
}

/// Returns roots with fewer nodes: their ends, forks, nodes that carry a stem, and every
/// `stride`-th of the others.
///
/// ground   segments lead away from the base; parents precede their children
/// bears    by node: carries a stem
/// node_of  set to the new index of each remaining node
Skeleton thinned_roots(const Skeleton& ground, const std::vector<bool>& bears, std::uint32_t stride,
                       std::vector<std::uint32_t>& node_of) {
    const std::size_t count = ground.nodes.size();
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> segments_at(count, 0), skipped(count, 0), last(count, none);
    node_of.resize(count);
    std::iota(node_of.begin(), node_of.end(), 0U);
    if (stride == 1) return ground;
    std::vector<bool> begins(count, true);
    for (const Skeleton::Segment& segment : ground.segments) {
        ++segments_at[segment.from];
        ++segments_at[segment.to];
        begins[segment.to] = false;
    }
    Skeleton roots;
    const auto keep = [&](std::uint32_t node) {
        node_of[node] = static_cast<std::uint32_t>(roots.nodes.size());
        roots.nodes.push_back(ground.nodes[node]);
        last[node] = node;
    };
    for (std::uint32_t i = 0; i < count; ++i)
        if (begins[i]) keep(i);
    for (const Skeleton::Segment& segment : ground.segments) {
        const std::uint32_t passed = skipped[segment.from] + 1;
        if (segments_at[segment.to] == 2 && !bears[segment.to] && passed < stride) {
            skipped[segment.to] = passed;
            last[segment.to] = last[segment.from];
            continue;
        }
        keep(segment.to);
        roots.segments.push_back({node_of[last[segment.from]], node_of[segment.to]});
    }
    return roots;
}

}  // namespace

double root_share(int lod) {
    // Forks and stems always remain.
    constexpr std::array<double, 4> shares = {1.0, 1.0, 0.75, 0.6};
    return shares[static_cast<std::size_t>(lod)];
}

Skeleton colony_skeleton(const ColonySite& site, const std::vector<ColonyMember>& members,
                         const ColonyParams& params, const ColonyTraits& traits, int segments) {
    Skeleton skeleton;
    const bool on_roots = traits.habit == Habit::rooted && traits.roots == RootsShown::shown;
    std::vector<std::uint32_t> node_of;
    if (on_roots) {
        std::vector<bool> bears(site.ground.nodes.size(), false);
        if (traits.capped)
            for (const ColonyMember& member : members)
                bears[site.places[member.place].number] = true;
        skeleton = thinned_roots(sunken_roots(site.ground, bears, traits.seed), bears,
                                 root_strides[static_cast<std::size_t>(params.lod)], node_of);
    }
    if (!traits.capped) return skeleton;
    std::uint32_t stem = 0;
    for (const ColonyMember& member : members) {
        ++stem;
        const ColonyPlace& place = site.places[member.place];
        const auto at = [&](double t) {
            return place.foot + t * member.rise + t * t * member.swing;
        };
        // A neck widens to its cap; a cap that is too small for its stem determines the radius of
        // the stem's end.
        const double top = place.radius * std::min(params.cap_scale, 1.0);
        const double height = glm::length(at(1.0) - place.foot);
        std::uint32_t below = 0;
        if (on_roots) {
            below = node_of[place.number];
        } else {
            const glm::dvec3 way = glm::normalize(member.rise);
            below = static_cast<std::uint32_t>(skeleton.nodes.size());
            skeleton.nodes.push_back(
                {place.foot - stem_below_ground * place.radius * way, place.radius});
        }
        const double least = on_roots ? least_on_root : least_segment;
        const int fitting =
            static_cast<int>((height - short_of_cap * top) / (least * place.radius));
        int count = std::max(1, std::min(segments, fitting));
        const double end = 1.0 - short_of_cap * top / glm::length(member.rise + 2.0 * member.swing);
        // Segments are shortest where a stem turns.
        const auto shortest = [&](int of) {
            double length = height;
            for (int i = 1; i <= of; ++i)
                length = std::min(length, glm::distance(at(end * (i - 1) / of), at(end * i / of)));
            return length;
        };
        while (count > 1 && shortest(count) < (1.0 - 1e-9) * least * place.radius) --count;
        for (int i = 1; i <= count; ++i) {
            const auto above = static_cast<std::uint32_t>(skeleton.nodes.size());
            skeleton.nodes.push_back({at(end * i / count), i == count ? top : place.radius});
            skeleton.segments.push_back({below, above, stem});
            below = above;
        }
    }
    return skeleton;
}

int skin_levels(std::size_t nodes, int lod) {
    return std::max((nodes <= most_near_nodes ? 2 : 1) - lod, 0);
}

ColonySkin colony_skin(const Skeleton& segments, const SkinOptions& options) {
    if (segments.nodes.empty()) return {};
    SkinnedSkeleton made =
        skinned(cleaned(segments).skeleton, skin_levels(segments.nodes.size(), options.lod),
                options.textured ? SkinPlaces::included : SkinPlaces::omitted);
    if (options.textured) add_texture_coordinates(made, options);
    order_for_vertex_cache(made.mesh);
    return {std::move(made.mesh), std::move(made.labels)};
}

}  // namespace sporeprint
