#include "core/colony/habit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/blend.h"

namespace sporeprint {

namespace {

constexpr double golden_angle = 2.39996322972865332;
const glm::dvec3 vertical(0.0, 1.0, 0.0);

/// Tufts: distance of caps, in cap radii, and of stem bases, in stem radii, each per square root of
/// their number; lean of stems, in their heights.
constexpr double tuft_top = 0.92, tuft_foot = 1.05, tuft_lean = 0.9;

glm::dvec3 horizontal(double angle) {
    const SineCosine at = sine_cosine(angle);
    return {at.cosine, 0.0, at.sine};
}

/// The habits without roots.
class Layout {
  public:
    Layout(const ColonyParams& params, const ColonyTraits& traits, const ColonyRoots& growth,
           const StemFit& fit)
        : params_(params),
          traits_(traits),
          growth_(growth),
          cap_(fit.cap_radius * params.cap_scale *
               (traits.capped ? growth.root_radius / fit.radius : 1.0)),
          whole_height_(fit.height) {}

    /// Returns a place with the smaller stem of an individual at `share` of the way to the
    /// youngest.
    ColonyPlace place(const glm::dvec3& foot, double share, const glm::dvec3& outwards,
                      Random& random) const {
        const double thick = random.symmetric(), tall = random.symmetric();
        ColonyPlace place;
        place.foot = foot;
        place.share = share;
        place.outwards = outwards;
        place.radius = growth_.root_radius * (1.0 - 0.25 * share) * (1.0 + 0.1 * thick);
        if (traits_.capped) {
            place.rise = growth_.stem_height * (1.0 - 0.2 * share) * (1.0 + 0.12 * tall) * vertical;
            place.swing = growth_.stem_displacement * outwards;
        }
        return place;
    }

    ColonySite tuft() const {
        ColonySite site;
        const double thickness = growth_.root_radius, height = growth_.stem_height;
        const double crowd = std::sqrt(static_cast<double>(params_.count));
        // With many on one base all are smaller, down to half, because their stems could not reach
        // out far enough.
        double small = 1.0;
        if (traits_.capped && tuft_top * cap_ > tuft_foot * thickness)
            small = std::min(
                1.0, std::max(0.5, tuft_lean * height /
                                       (crowd * (tuft_top * cap_ - tuft_foot * thickness))));
        const double spread = (traits_.capped ? tuft_top : 1.08) * cap_ * small;
        const double foot_spread = traits_.capped ? tuft_foot * thickness * small : spread;
        Random random(params_.seed, purposes::colony_places);
        const double first = random.uniform(0.0, 2.0 * pi);
        for (int i = 0; i < params_.count; ++i) {
            const double wander = random.symmetric(), aside = random.symmetric();
            const double ring = std::sqrt(i + 0.2);
            const glm::dvec3 outwards = horizontal(first + i * golden_angle + 0.15 * aside);
            const double top = spread * ring * (1.0 + 0.1 * wander);
            ColonyPlace one = place({}, ring / crowd, outwards, random);
            one.radius *= small;
            double foot = foot_spread * ring;
            if (traits_.capped) {
                const double tall = one.rise.y;
                const double lean = std::min(std::max(top - foot, 0.0), tuft_lean * tall);
                foot = std::max(foot, top - lean);
                // Stems of a tuft start at a slant and turn upwards.
                one.rise = 1.6 * lean * outwards + 0.85 * tall * vertical;
                one.swing += -0.6 * lean * outwards + 0.15 * tall * vertical;
            }
            one.foot = foot * outwards;
            site.places.push_back(one);
        }
        return site;
    }

    ColonySite troop() const {
        ColonySite site;
        const double apart = 2.5 * cap_;
        const double reach = 0.62 * apart * std::sqrt(static_cast<double>(params_.count));
        for (int i = 0; i < params_.count; ++i) {
            Random random(params_.seed, purposes::colony_places, static_cast<std::uint32_t>(i));
            // The candidate farthest from all others is chosen.
            glm::dvec3 best(0.0);
            double farthest = -1.0;
            for (int look = 0; look < 10; ++look) {
                const double angle = random.uniform(0.0, 2.0 * pi), area = random.uniform();
                const glm::dvec3 at = reach * std::sqrt(area) * horizontal(angle);
                double nearest = 1e9;
                for (const ColonyPlace& other : site.places)
                    nearest = std::min(nearest, glm::length(other.foot - at));
                if (nearest > farthest) {
                    farthest = nearest;
                    best = at;
                }
                if (i == 0) break;
            }
            const double share = random.uniform(), towards = random.uniform(0.0, 2.0 * pi);
            site.places.push_back(place(best, share, horizontal(towards), random));
        }
        return site;
    }

    ColonySite ring() const {
        ColonySite site;
        const double around = std::max(2.4 * cap_ * params_.count / (2.0 * pi), 1.5 * cap_);
        for (int i = 0; i < params_.count; ++i) {
            Random random(params_.seed, purposes::colony_places, static_cast<std::uint32_t>(i));
            const double aside = random.symmetric(), off = random.normal(),
                         share = random.uniform();
            const glm::dvec3 outwards = horizontal(2.0 * pi * (i + 0.3 * aside) / params_.count);
            const double radius = params_.count > 1 ? around + 0.35 * cap_ * off : 0.0;
            site.places.push_back(place(radius * outwards, share, outwards, random));
        }
        return site;
    }

    ColonySite tier(double trunk) const {
        ColonySite site;
        const double step = std::min((traits_.capped ? 2.1 : 1.9) * cap_ / trunk, 0.7 * pi);
        const int in_row = std::max(1, static_cast<int>(0.9 * pi / step));
        const double level =
            traits_.lateral ? std::max(0.75 * whole_height_, 0.55 * cap_) : 1.9 * cap_;
        for (int i = 0; i < params_.count; ++i) {
            Random random(params_.seed, purposes::colony_places, static_cast<std::uint32_t>(i));
            const double aside = random.symmetric(), up = random.symmetric();
            const double share = random.uniform();
            const int row = i / in_row;
            // Rows are offset like bricks, filled from the middle of the first outwards.
            const int column = i % in_row;
            const int side = (column + 1) / 2 * (column % 2 == 1 ? 1 : -1);
            const double angle = step * (side + (row % 2 == 1 ? 0.5 : 0.0) + 0.18 * aside);
            const SineCosine at = sine_cosine(angle);
            const glm::dvec3 outwards(at.sine, 0.0, at.cosine);
            const glm::dvec3 foot = trunk * (outwards - glm::dvec3(0.0, 0.0, 1.0)) +
                                    level * (row + 0.2 * up) * vertical;
            ColonyPlace one = place(foot, share, outwards, random);
            if (traits_.capped) {
                // Outwards from the bark, then upwards.
                const double height = one.rise.y, out = std::max(0.6 * height, 1.3 * cap_);
                one.rise = 2.0 * out * outwards;
                one.swing = -out * outwards + height * vertical;
            } else if (!traits_.lateral) {
                one.up = glm::normalize(0.9 * outwards + 0.45 * vertical);
            }
            site.places.push_back(one);
        }
        return site;
    }

  private:
    const ColonyParams& params_;
    const ColonyTraits& traits_;
    const ColonyRoots& growth_;
    double cap_, whole_height_;
};

ColonySite rooted(const ColonyParams& params, const ColonyTraits& traits,
                  const ColonyRoots& growth) {
    const ColonySkeleton grown = colony_skeleton(growth, params.seed);
    ColonySite site;
    const auto roots = grown.skeleton.nodes.begin();
    site.ground.nodes.assign(roots, roots + grown.root_nodes);
    for (const Skeleton::Segment& segment : grown.skeleton.segments)
        if (segment.from < grown.root_nodes && segment.to < grown.root_nodes)
            site.ground.segments.push_back(segment);
    // If there are too many stems, each remains with the same probability.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> chances;
    for (const ColonySkeleton::Stem& stem : grown.stems)
        chances.emplace_back(Random(params.seed, purposes::colony_thinning, stem.root).bits(),
                             stem.root);
    std::sort(chances.begin(), chances.end());
    const auto most = static_cast<std::size_t>(params.count);
    for (const ColonySkeleton::Stem& stem : grown.stems) {
        const std::pair<std::uint32_t, std::uint32_t> own{
            Random(params.seed, purposes::colony_thinning, stem.root).bits(), stem.root};
        if (chances.size() > most && own >= chances[most]) continue;
        ColonyPlace place;
        place.foot = grown.skeleton.nodes[stem.root].place;
        place.number = stem.root;
        place.radius = stem.radius;
        place.share = static_cast<double>(grown.depths[stem.root]) / growth.depth;
        const double far = glm::length(place.foot);
        if (far > 1e-9) place.outwards = place.foot / far;
        if (traits.capped) {
            place.rise = stem.height * vertical;
            place.swing = growth.stem_displacement * place.outwards;
        }
        site.places.push_back(place);
    }
    std::stable_sort(site.places.begin(), site.places.end(),
                     [](const ColonyPlace& a, const ColonyPlace& b) { return a.share < b.share; });
    return site;
}

}  // namespace

ColonyRoots colony_growth(const ColonyParams& params, const ColonyTraits& traits,
                          const StemFit& fit) {
    ColonyRoots growth;
    const auto within = [](double value, double least, double most) {
        return std::min(std::max(value, least), most);
    };
    growth.root_radius = params.growth.root_radius.value_or(within(fit.radius, 0.0002, 0.2));
    const double cap =
        fit.cap_radius * (traits.capped ? params.cap_scale * growth.root_radius / fit.radius : 1.0);
    growth.stem_height = within(fit.height, 0.002, 1.0);
    growth.stem_displacement = within(0.18 * fit.height, 0.0, 0.5);
    if (traits.habit != Habit::rooted) growth.stem_displacement *= 0.5;
    // About as many caps as fit along a root.
    growth.segment_length = within(std::max(0.7 * cap, 4.5 * growth.root_radius), 0.002, 1.0);
    growth.branch_distance = within(4.0 * growth.segment_length, 0.005, 100.0);
    growth.field_scale = within(12.0 * growth.segment_length, 0.02, 10.0);
    overlay(params.growth, growth);
    return growth;
}

double trunk_radius(const ColonyParams& params, const StemFit& fit) {
    return params.trunk_radius.value_or(
        std::min(std::max(2.2 * fit.cap_radius * params.cap_scale, 0.03), 5.0));
}

ColonySite colony_site(const ColonyParams& params, const ColonyTraits& traits,
                       const ColonyRoots& growth, const StemFit& fit) {
    if (traits.habit == Habit::rooted) return rooted(params, traits, growth);
    const Layout layout(params, traits, growth, fit);
    ColonySite site = traits.habit == Habit::tuft   ? layout.tuft()
                      : traits.habit == Habit::ring ? layout.ring()
                      : traits.habit == Habit::tier ? layout.tier(trunk_radius(params, fit))
                                                    : layout.troop();
    for (std::size_t i = 0; i < site.places.size(); ++i)
        site.places[i].number = static_cast<std::uint32_t>(i);
    return site;
}

}  // namespace sporeprint
