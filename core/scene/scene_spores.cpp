#include "core/scene/scene_spores.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/world/dispersal.h"

namespace sporeprint {

namespace {

/// Height of the grass that slows the wind, metres.
constexpr double grass_height = 0.15;

/// Eddies have this share of the height, and turn the wind up and down by a quarter of its speed. They are no smaller
/// and no larger than at these heights, metres.
constexpr double eddy_share = 0.4, turbulence = 0.25, lowest_eddy = 0.1, highest_eddy = 2.0;

/// Air above a scene in which packets drift, as a share of its size and at least so much, metres.
constexpr double air_share = 0.1, least_air = 2.0;

/// Share of the arriving packets that come from upwind; the others sink from above.
constexpr double share_from_upwind = 0.75;

/// Less wind than this carries nothing, m/s.
constexpr double still_wind = 0.02;

constexpr int most_steps = 500;

/// Surfels that catch a packet are at most so many spacings away.
constexpr double catch_spacings = 3.0;

/// Rounds in which what lands is spread over neighbours, since packets are few.
constexpr int smoothing_rounds = 4;

/// Of ground in the open, spores from outside settle so much of it in five years; and those of full cover of its own.
constexpr double arrival_rate = 0.15, establishment_rate = 3.0;

/// Growth and loss of cover in five years, as in worlds.
constexpr double growth = 0.35, loss = 0.02;

/// The first year of the spread.
constexpr int begin_year = -40;

/// How much of the spores that water passes over it takes up.
constexpr double wash_strength = 0.5;

/// The box in which packets drift.
struct Air {
    glm::dvec3 low{0.0}, high{0.0};
    double radius = 0.0;  ///< of its circle in the plan

    explicit Air(const Surfels& surfels) {
        low = glm::dvec3(std::numeric_limits<double>::max());
        high = -low;
        for (const Surfel& surfel : surfels) {
            low = glm::min(low, glm::dvec3(surfel.at));
            high = glm::max(high, glm::dvec3(surfel.at));
        }
        const glm::dvec3 size = high - low;
        radius = 0.5 * std::sqrt(size.x * size.x + size.z * size.z) + 0.01;
        high.y += std::max(least_air, air_share * std::max(size.x, size.z));
    }
    [[nodiscard]] glm::dvec3 middle() const { return 0.5 * (low + high); }
    [[nodiscard]] double footprint() const { return 4.0 * radius * radius; }
    /// Returns whether a packet may still meet something.
    [[nodiscard]] bool has(const glm::dvec3& at) const {
        const double x = at.x - middle().x, z = at.z - middle().z;
        return at.y >= low.y - 0.01 && x * x + z * z <= 2.01 * radius * radius;
    }
};

/// Returns the wind from a direction that is drawn by the rose: a unit vector in the plane.
glm::dvec3 drawn_wind(const WindRose& rose, double which, double first, double second) {
    std::size_t sector = 0;
    while (sector + 1 < wind_sectors && which >= rose[sector].share) which -= rose[sector++].share;
    const double from =
        (static_cast<double>(sector) + first + second - 1.0) * (2.0 * pi / wind_sectors);
    const auto [sine_from, cosine_from] = sine_cosine(from);
    return scene_direction(-sine_from, 0.0, -cosine_from);
}

double wind_at_height(const WindRose& rose, double height) {
    return wind_above_grass(rose[0].speed, std::max(0.0, height), grass_height);
}

/// Packets of spores in the air of a scene.
class Drift {
  public:
    Drift(const SceneHabitat& habitat, const Air& air, const WindRose& rose, double settling)
        : habitat_(habitat), air_(air), rose_(rose), settling_(settling) {}

    struct Landing {
        glm::dvec3 at{0.0};
        std::uint32_t triangle = 0;
    };

    /// Follows a packet until it meets a triangle or leaves the scene.
    ///
    /// wind     its direction
    /// ground   height of the ground below which there is no wind, metres
    /// is_bare  whether there is nothing but that ground
    std::optional<Landing> follow(glm::dvec3 at, const glm::dvec3& wind, double ground,
                                  bool is_bare, Random random) const {
        const TriangleTree& tree = habitat_.shape->tree;
        for (int step = 0; step < most_steps; ++step) {
            const double height = std::max(0.0, at.y - ground);
            const double speed = wind_at_height(rose_, height);
            const double toss = random.normal();
            glm::dvec3 way(0.0, -1.0, 0.0);
            if (speed > still_wind) {
                const double eddy = eddy_share * std::clamp(height, lowest_eddy, highest_eddy);
                const double time = eddy / (turbulence * speed);
                way = time * speed * wind;
                way.y = eddy * toss - settling_ * time;
            }
            // Eddies bring back what they take out at the top.
            if (at.y + way.y > air_.high.y) way.y = 2.0 * (air_.high.y - at.y) - way.y;
            if (is_bare) {
                if (at.y + way.y <= air_.low.y) {
                    const double share = way.y < 0.0 ? (air_.low.y - at.y) / way.y : 0.0;
                    return Landing{at + std::clamp(share, 0.0, 1.0) * way, 0};
                }
            } else if (const auto hit = tree.first_hit(at, way, 0.0, 1.0)) {
                return Landing{at + hit->distance * way, hit->triangle};
            }
            at += way;
            if (!air_.has(at)) return std::nullopt;
        }
        return std::nullopt;
    }

    /// Returns the surfel that catches what lands on a triangle.
    [[nodiscard]] std::optional<std::uint32_t> caught(const Landing& landing) const {
        const Surfels& surfels = habitat_.surfels();
        return surfels.nearest(landing.at, normal_of(*habitat_.shape->scene, landing.triangle),
                               catch_spacings * surfels.spacing());
    }

  private:
    const SceneHabitat& habitat_;
    const Air& air_;
    const WindRose& rose_;
    double settling_;
};

/// Spreads amounts over neighbours: each surfel gives half of what it has to them, by their areas.
void spread_out(const SceneHabitat& habitat, std::vector<double>& amounts,
                std::vector<double>& next) {
    const Surfels& surfels = habitat.surfels();
    next.assign(amounts.size(), 0.0);
    for (std::size_t i = 0; i < amounts.size(); ++i) {
        if (amounts[i] <= 0.0) continue;
        double around = 0.0;
        for (const SurfelGraph::Way& way : habitat.shape->graph.ways(i))
            around += static_cast<double>(surfels[way.to].area);
        if (around <= 0.0) {
            next[i] += amounts[i];
            continue;
        }
        next[i] += 0.5 * amounts[i];
        const double given = 0.5 * amounts[i] / around;
        for (const SurfelGraph::Way& way : habitat.shape->graph.ways(i))
            next[way.to] += given * static_cast<double>(surfels[way.to].area);
    }
    amounts.swap(next);
}

/// Returns how many rounds of that spread the spores that fall beside a body as far as they fall.
int rounds_beside(double spacing) {
    // Neighbours are about 1.6 spacings away; the variance of a fall beside a body is 6 near_scale^2 in the plane.
    const double step = 0.5 * 2.56 * spacing * spacing;
    return std::clamp(static_cast<int>(std::floor(6.0 * near_scale * near_scale / step + 0.5)), 1,
                      4);
}

std::uint8_t quantised(double share) {
    return static_cast<std::uint8_t>(std::clamp(std::floor(share * 255.0 + 0.5), 0.0, 255.0));
}

}  // namespace

std::vector<double> arriving_spores(const SceneHabitat& habitat, const WindRose& rose,
                                    const SporeHabit& spores, std::uint32_t stream) {
    const Surfels& surfels = habitat.surfels();
    std::vector<double> amounts(surfels.size(), 0.0);
    if (surfels.size() == 0) return amounts;
    const Air air(surfels);
    const Drift drift(habitat, air, rose, spores.settling);
    const bool is_still = wind_at_height(rose, air.high.y - air.low.y) <= still_wind;
    const auto upwind =
        is_still ? std::size_t{0} : static_cast<std::size_t>(share_from_upwind * arriving_packets);
    const double high = air.high.y - air.low.y;
    double on_bare = 0.0;
    for (std::uint32_t packet = 0; packet < arriving_packets; ++packet) {
        Random random(habitat.conditions.seed, purposes::spore_packets, stream,
                      {static_cast<std::int32_t>(packet), 0});
        const double which = random.uniform(), first = random.uniform(), second = random.uniform();
        const double across = random.symmetric(), up = random.uniform(), along = random.symmetric();
        const glm::dvec3 wind = drawn_wind(rose, which, first, second);
        const glm::dvec3 side(-wind.z, 0.0, wind.x);
        glm::dvec3 at(air.middle());
        double weight = 0.0;
        if (packet < upwind) {
            at += air.radius * across * side - air.radius * wind;
            at.y = air.low.y + high * up;
            // As many as the wind carries through that plane, whose concentration is 1.
            weight = wind_at_height(rose, high * up) * 2.0 * air.radius * high /
                     static_cast<double>(upwind);
        } else {
            at += air.radius * across * side + air.radius * along * wind;
            at.y = air.high.y;
            weight =
                spores.settling * air.footprint() / static_cast<double>(arriving_packets - upwind);
        }
        if (const auto landing = drift.follow(at, wind, air.low.y, true, random))
            if (std::abs(glm::dot(landing->at - air.middle(), side)) <= air.radius &&
                std::abs(glm::dot(landing->at - air.middle(), wind)) <= air.radius)
                on_bare += weight;
        if (const auto landing = drift.follow(at, wind, air.low.y, false, random))
            if (const auto surfel = drift.caught(*landing)) amounts[*surfel] += weight;
    }
    std::vector<double> next;
    for (int round = 0; round < smoothing_rounds; ++round) spread_out(habitat, amounts, next);
    const double of_open = on_bare / air.footprint();
    for (std::size_t i = 0; i < amounts.size(); ++i) {
        const auto area = static_cast<double>(surfels[i].area);
        amounts[i] = of_open > 0.0 && area > 0.0 ? amounts[i] / area / of_open : 0.0;
    }
    return amounts;
}

std::vector<SporePath> spore_paths(const SceneHabitat& habitat, const WindRose& rose,
                                   const SporeHabit& spores, std::uint32_t stream,
                                   const std::vector<float>& suits) {
    std::vector<SporePath> paths;
    const Surfels& surfels = habitat.surfels();
    std::vector<double> sums;
    sums.reserve(surfels.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        if (suits[i] > 0.0F) sum += static_cast<double>(surfels[i].area);
        sums.push_back(sum);
    }
    if (!(sum > 0.0)) return paths;
    const Air air(surfels);
    const Drift drift(habitat, air, rose, spores.settling);
    for (std::uint32_t packet = 0; packet < leaving_packets; ++packet) {
        Random random(habitat.conditions.seed, purposes::spore_packets, stream,
                      {static_cast<std::int32_t>(packet), 1});
        const double where = random.uniform(), which = random.uniform(), first = random.uniform(),
                     second = random.uniform();
        // One from each equal part of the area.
        const double place = (packet + where) / static_cast<double>(leaving_packets) * sum;
        const auto from = static_cast<std::uint32_t>(
            std::min<std::ptrdiff_t>(std::ranges::upper_bound(sums, place) - sums.begin(),
                                     static_cast<std::ptrdiff_t>(sums.size()) - 1));
        const Surfel& surfel = surfels[from];
        constexpr double beside = 0.02;
        glm::dvec3 at = glm::dvec3(surfel.at) + beside * glm::dvec3(surfel.normal);
        const double ground = at.y;
        if (habitat.substrates.soils[from] != Soil::wood) at.y += spores.height;
        // What is below a ceiling that is too low stays there.
        const glm::dvec3 rise = at - glm::dvec3(surfel.at);
        if (habitat.shape->tree.is_blocked(glm::dvec3(surfel.at) + 1e-3 * glm::dvec3(surfel.normal),
                                           rise, 0.0, 1.0))
            continue;
        const double foot = habitat.substrates.soils[from] == Soil::wood ? air.low.y : ground;
        const glm::dvec3 wind = drawn_wind(rose, which, first, second);
        const auto landing = drift.follow(at, wind, foot, false, random);
        if (!landing) continue;
        if (const auto to = drift.caught(*landing)) paths.push_back({from, *to});
    }
    return paths;
}

double SceneEstablishment::at(std::size_t surfel, double year) const {
    const double moment = std::clamp(year / spread_interval, 0.0, spread_moments - 1.0);
    const auto before = std::min(static_cast<std::size_t>(moment), spread_moments - 2);
    const double t = moment - static_cast<double>(before);
    return ((1.0 - t) * shares[before][surfel] + t * shares[before + 1][surfel]) / 255.0;
}

std::size_t SceneEstablishment::bytes() const {
    return sizeof(*this) + spread_moments * shares[0].size();
}

SceneEstablishment scene_spread(const SceneHabitat& habitat, const FungusSpecies& species) {
    const Surfels& surfels = habitat.surfels();
    const std::size_t count = surfels.size();
    SceneEstablishment out;
    for (std::vector<std::uint8_t>& shares : out.shares) shares.assign(count, 0);
    std::vector<float> suits(count, 0.0F);
    double potential = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        suits[i] = static_cast<float>(habitat.suitability(species, i));
        if (suits[i] > 0.0F) potential += static_cast<double>(surfels[i].area);
    }
    if (!(potential > 0.0)) return out;
    const WindRose rose = wind_rose(habitat.conditions.climate);
    const SporeHabit& spores = species.ecology.spores;
    std::vector<double> outside = arriving_spores(habitat, rose, spores, species.stream);
    for (std::size_t i = 0; i < count; ++i) outside[i] *= static_cast<double>(surfels[i].area);
    static_cast<void>(wash_down(habitat.run_off, wash_strength, outside));
    const std::vector<SporePath> paths = spore_paths(habitat, rose, spores, species.stream, suits);
    const double wind = wind_at_height(rose, spores.height);
    const DispersalKernel kernel =
        dispersal_kernel({.height = spores.height, .settling = spores.settling, .wind = wind});
    const double of_packet = (1.0 - kernel.beside) * potential / leaving_packets;
    const int rounds = rounds_beside(surfels.spacing());

    std::vector<double> cover(count, 0.0), amounts(count, 0.0), next;
    for (int year = begin_year; year <= last_year; year += spread_step) {
        if (year >= 0 && year % spread_interval == 0)
            for (std::size_t i = 0; i < count; ++i)
                out.shares[static_cast<std::size_t>(year / spread_interval)][i] =
                    quantised(cover[i]);
        for (std::size_t i = 0; i < count; ++i)
            amounts[i] = kernel.beside * cover[i] * static_cast<double>(surfels[i].area);
        for (int round = 0; round < rounds; ++round) spread_out(habitat, amounts, next);
        for (const SporePath& path : paths) amounts[path.to] += of_packet * cover[path.from];
        static_cast<void>(wash_down(habitat.run_off, wash_strength, amounts));
        for (std::size_t i = 0; i < count; ++i) {
            if (suits[i] <= 0.0F) continue;
            const auto area = static_cast<double>(surfels[i].area);
            if (area <= 0.0) continue;
            const double deposit =
                (arrival_rate * outside[i] + establishment_rate * amounts[i]) / area;
            const double settled = 1.0 - exponential(-deposit * static_cast<double>(suits[i]));
            cover[i] += (1.0 - cover[i]) * (settled + (1.0 - settled) * growth * cover[i]) -
                        loss * cover[i];
        }
    }
    return out;
}

}  // namespace sporeprint
