#include "core/colony/habit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/blend.h"

namespace sporeprint {

namespace {

const glm::dvec3 vertical(0.0, 1.0, 0.0);

/// Individuals lean by up to so much, in heights.
constexpr double natural_lean = 0.08;

/// Tufts: distance of caps, in cap radii, and of stem bases, in stem radii, each per square root of
/// their number; lean of stems, in their heights; how far all bend towards the light and each aside,
/// in heights; how much lower the outermost stand; how deep the bases are, in stem radii.
constexpr double tuft_top = 0.7, tuft_foot = 0.8, tuft_lean = 0.7, tuft_light = 0.1,
                 tuft_aside = 0.08, tuft_dome = 0.2, tuft_depth = 1.6;
/// Half axes of the outline of a tuft are this factor and its inverse.
constexpr double tuft_oval = 1.15;

/// Troops: mean number of individuals of a patch and the deviation of their places, in cap radii;
/// the probability that one stands against another; the distance that the others keep, in cap radii.
constexpr double patch_members = 6.0, patch_spread = 2.2, troop_beside = 0.35, troop_apart = 2.05;

/// Rings: individuals of an arc in the mean.
constexpr double arc_members = 9.0;

/// Number of candidates for a place.
constexpr int candidates = 10;

glm::dvec3 horizontal(double angle) {
    const SineCosine at = sine_cosine(angle);
    return {at.cosine, 0.0, at.sine};
}

/// The habits without roots.
class Layout {
  public:
    Layout(const ColonyParams& params, const ColonyTraits& traits, const ColonyRoots& growth,
           const ColonyFits& fits)
        : params_(params),
          traits_(traits),
          growth_(growth),
          cap_(fits.oldest.cap_radius * params.cap_scale *
               (traits.capped ? growth.root_radius / fits.oldest.radius : 1.0)),
          whole_height_(fits.oldest.height) {
        // Whole individuals have the size of their age by themselves.
        if (!traits.capped) return;
        young_height_ = std::min(fits.youngest.height / fits.oldest.height, 1.0);
        young_radius_ = std::min(fits.youngest.radius / fits.oldest.radius, 1.0);
    }

    /// Returns a place with the smaller stem of an individual at `share` of the way to the
    /// youngest.
    ColonyPlace place(const glm::dvec3& foot, double share, const glm::dvec3& outwards,
                      Random& random) const {
        const double thick = random.symmetric(), tall = random.symmetric();
        const double lean = natural_lean * random.uniform(), aside = random.uniform(0.0, 2.0 * pi);
        ColonyPlace place;
        place.foot = foot;
        place.share = share;
        place.outwards = outwards;
        const auto grown = [&](double young) { return 1.0 - (1.0 - young) * share; };
        place.radius = growth_.root_radius * grown(young_radius_) * (1.0 + 0.1 * thick);
        if (traits_.capped) {
            place.rise =
                growth_.stem_height * grown(young_height_) * (1.0 + 0.12 * tall) * vertical;
            place.swing =
                growth_.stem_displacement * outwards + lean * place.rise.y * horizontal(aside);
        } else if (!traits_.lateral) {
            place.up = glm::normalize(vertical + lean * horizontal(aside));
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
        Random whole(traits_.seed, purposes::colony_places, 0);
        const glm::dvec3 light = horizontal(whole.uniform(0.0, 2.0 * pi));
        const double longest = whole.uniform(0.0, pi);
        std::vector<glm::dvec3> tops;  // in the circle of radius 1
        for (int i = 0; i < params_.count; ++i) {
            Random random(traits_.seed, purposes::colony_places, 1 + static_cast<std::uint32_t>(i));
            const double off = random.uniform(), aside = random.symmetric(),
                         pressed = random.uniform(0.55, 1.0), turned = random.symmetric(),
                         young = random.uniform();
            // Rings of equal areas from the middle outwards.
            const double share = std::sqrt((i + off) / params_.count);
            tops.push_back(farthest_from(
                tops, [&] { return share * horizontal(random.uniform(0.0, 2.0 * pi)); }));
            const glm::dvec3 at = oval(tops.back(), longest);
            const double ring = std::max(glm::length(at), 1e-9);
            const glm::dvec3 outwards = at / ring;
            const double top = spread * crowd * ring;
            // Young ones are everywhere, and most at the outside.
            ColonyPlace one = place({}, 0.4 * share + 0.6 * young, outwards, random);
            one.radius *= small;
            const double foot = foot_spread * crowd * ring * pressed;
            glm::dvec3 from = outwards;
            if (traits_.capped) {
                const double tall = one.rise.y * (1.0 + 0.5 * tuft_dome - tuft_dome * share);
                const double lean = std::min(std::max(top - foot, 0.0), tuft_lean * tall);
                // Stems of a tuft start at a slant and turn upwards, none quite straight out.
                const glm::dvec3 across(-outwards.z, 0.0, outwards.x);
                from = glm::normalize(outwards + 0.4 * turned * across);
                one.rise = 1.6 * lean * outwards + 0.85 * tall * vertical;
                one.swing += -0.6 * lean * outwards + 0.15 * tall * vertical +
                             tall * (tuft_light * light + tuft_aside * aside * across);
            }
            one.foot = foot * from;
            // No slanting base shows its end above the ground.
            if (traits_.capped) one.foot -= tuft_depth * one.radius * vertical;
            site.places.push_back(one);
        }
        return site;
    }

    ColonySite troop() const {
        ColonySite site;
        const double reach = 2.1 * cap_ * std::sqrt(static_cast<double>(params_.count));
        const int patches =
            std::max(1, static_cast<int>(std::floor(params_.count / patch_members + 0.5)));
        std::vector<glm::dvec3> middles, feet;
        for (int i = 0; i < patches; ++i) {
            Random random(traits_.seed, purposes::colony_patches, static_cast<std::uint32_t>(i));
            middles.push_back(farthest_from(middles, [&] {
                const double angle = random.uniform(0.0, 2.0 * pi), area = random.uniform();
                return reach * std::sqrt(area) * horizontal(angle);
            }));
        }
        for (int i = 0; i < params_.count; ++i) {
            Random random(traits_.seed, purposes::colony_places, static_cast<std::uint32_t>(i));
            const double chance = random.uniform(), which = random.uniform();
            const double young = random.uniform(), towards = random.uniform(0.0, 2.0 * pi);
            if (i > 0 && chance < troop_beside) {
                // A younger one stands against another one and leans away from it.
                const glm::dvec3 beside = feet[static_cast<std::size_t>(which * i)];
                const double apart = cap_ * random.uniform(1.5, 1.9);
                feet.push_back(farthest_from(feet, [&] {
                    return beside + apart * horizontal(random.uniform(0.0, 2.0 * pi));
                }));
                const glm::dvec3 away = glm::normalize(feet.back() - beside);
                site.places.push_back(place(feet.back(), 0.5 + 0.5 * young, away, random));
                continue;
            }
            const glm::dvec3& middle = middles[static_cast<std::size_t>(which * patches)];
            feet.push_back(farthest_from(
                feet,
                [&] {
                    const double x = random.normal(), z = random.normal();
                    return middle + patch_spread * cap_ * glm::dvec3(x, 0.0, z);
                },
                troop_apart * cap_));
            site.places.push_back(place(feet.back(), young, horizontal(towards), random));
        }
        return site;
    }

    ColonySite ring() const {
        ColonySite site;
        Random whole(traits_.seed, purposes::colony_places, 0);
        const int arcs = std::max(1, static_cast<int>(std::floor(params_.count / arc_members)));
        const double first = whole.uniform(0.0, 2.0 * pi), wave = whole.uniform(0.0, 2.0 * pi);
        // Steps along the ring in cap radii: some touch, some stand apart, and arcs are apart.
        std::vector<double> steps;
        for (int i = 0; i < params_.count; ++i) {
            const double apart = whole.uniform();
            steps.push_back(1.8 + 1.4 * apart * apart);
        }
        for (int i = 0; i < arcs; ++i) {
            const double where = whole.uniform(), gap = whole.uniform(1.5, 5.0);
            steps[static_cast<std::size_t>(where * params_.count)] += gap;
        }
        const double length = std::accumulate(steps.begin(), steps.end(), 0.0);
        const double around = std::max(length / (2.0 * pi), 1.5) * cap_;
        double along = 0.0;
        for (int i = 0; i < params_.count; ++i) {
            Random random(traits_.seed, purposes::colony_places, 1 + static_cast<std::uint32_t>(i));
            const double off = random.normal(), share = random.uniform();
            along += steps[static_cast<std::size_t>(i)];
            const double angle = first + 2.0 * pi * along / length;
            const glm::dvec3 outwards = horizontal(angle);
            // Mycelia do not grow equally fast in all directions.
            const double radius =
                params_.count > 1
                    ? around * (1.0 + 0.05 * cosine(2.0 * angle + wave)) + 0.35 * cap_ * off
                    : 0.0;
            site.places.push_back(place(radius * outwards, share, outwards, random));
        }
        return site;
    }

    ColonySite tier(double trunk) const {
        ColonySite site;
        const auto [in_row, step, level] = tier_rows(traits_, cap_, whole_height_, trunk);
        // Rows follow a crack in the bark: they rise to one side.
        const double slope =
            0.25 * Random(traits_.seed, purposes::colony_patches, 0).symmetric() / step;
        for (int i = 0; i < params_.count; ++i) {
            Random random(traits_.seed, purposes::colony_places, static_cast<std::uint32_t>(i));
            const double aside = random.symmetric(), up = random.symmetric();
            const double share = random.uniform();
            const int row = i / in_row;
            // Rows are offset like bricks, filled from the middle of the first outwards.
            const int column = i % in_row;
            const int side = (column + 1) / 2 * (column % 2 == 1 ? 1 : -1);
            const double angle = step * (side + (row % 2 == 1 ? 0.5 : 0.0) + 0.22 * aside);
            const SineCosine at = sine_cosine(angle);
            const glm::dvec3 outwards(at.sine, 0.0, at.cosine);
            const glm::dvec3 foot = trunk * (outwards - glm::dvec3(0.0, 0.0, 1.0)) +
                                    level * (row + slope * angle + 0.25 * up) * vertical;
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
    /// Returns the first candidate that keeps a distance from all places, or else the farthest.
    template <class Candidate>
    static glm::dvec3 farthest_from(const std::vector<glm::dvec3>& places, Candidate&& candidate,
                                    double enough = 1e9) {
        glm::dvec3 best(0.0);
        double farthest = -1.0;
        for (int look = 0; look < candidates && farthest < enough; ++look) {
            const glm::dvec3 at = candidate();
            double nearest = enough;
            for (const glm::dvec3& other : places)
                nearest = std::min(nearest, glm::distance(other, at));
            if (nearest > farthest) {
                farthest = nearest;
                best = at;
            }
        }
        return best;
    }

    /// Returns a place stretched in one direction and narrowed across it.
    static glm::dvec3 oval(const glm::dvec3& place, double direction) {
        const glm::dvec3 longer = horizontal(direction);
        const double along = glm::dot(place, longer);
        return place / tuft_oval + (tuft_oval - 1.0 / tuft_oval) * along * longer;
    }

    const ColonyParams& params_;
    const ColonyTraits& traits_;
    const ColonyRoots& growth_;
    double cap_, whole_height_;
    double young_height_ = 1.0, young_radius_ = 1.0;  ///< of the youngest, for those of the oldest
};

ColonySite rooted(const ColonyParams& params, const ColonyTraits& traits,
                  const ColonyRoots& growth) {
    const ColonySkeleton grown = colony_skeleton(growth, traits.seed);
    ColonySite site;
    const auto roots = grown.skeleton.nodes.begin();
    site.ground.nodes.assign(roots, roots + grown.root_nodes);
    for (const Skeleton::Segment& segment : grown.skeleton.segments)
        if (segment.from < grown.root_nodes && segment.to < grown.root_nodes)
            site.ground.segments.push_back(segment);
    // If there are too many stems, each remains with the same probability.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> chances;
    for (const ColonySkeleton::Stem& stem : grown.stems)
        chances.emplace_back(Random(traits.seed, purposes::colony_thinning, stem.root).bits(),
                             stem.root);
    std::sort(chances.begin(), chances.end());
    const auto most = static_cast<std::size_t>(params.count);
    for (const ColonySkeleton::Stem& stem : grown.stems) {
        const std::pair<std::uint32_t, std::uint32_t> own{
            Random(traits.seed, purposes::colony_thinning, stem.root).bits(), stem.root};
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

TierRows tier_rows(const ColonyTraits& traits, double cap_radius, double whole_height,
                   double trunk) {
    // Brackets of a row touch, and those of the next one stand close above the gaps between them.
    const double apart = traits.capped ? 2.1 : traits.lateral ? 1.7 : 1.9;
    const double step = std::min(apart * cap_radius / trunk, 0.7 * pi);
    return {std::max(1, static_cast<int>(0.9 * pi / step)), step,
            traits.lateral ? std::max(0.6 * whole_height, 0.4 * cap_radius) : 1.9 * cap_radius};
}

ColonySite colony_site(const ColonyParams& params, const ColonyTraits& traits,
                       const ColonyRoots& growth, const ColonyFits& fits) {
    if (traits.habit == Habit::rooted) return rooted(params, traits, growth);
    const Layout layout(params, traits, growth, fits);
    ColonySite site = traits.habit == Habit::tuft   ? layout.tuft()
                      : traits.habit == Habit::ring ? layout.ring()
                      : traits.habit == Habit::tier ? layout.tier(trunk_radius(params, fits.oldest))
                                                    : layout.troop();
    for (std::size_t i = 0; i < site.places.size(); ++i)
        site.places[i].number = static_cast<std::uint32_t>(i);
    return site;
}

}  // namespace sporeprint
