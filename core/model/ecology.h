// Where a species lives, how its mycelia grow, and when and how densely they fruit in a world.
#pragma once

#include <string>
#include <vector>

#include "core/params/describe.h"
#include "core/problems.h"

namespace sporeprint {

/// What a fungus lives on: the roots of living trees, fallen leaves and needles, turf, or wood.
enum class Guild { ectomycorrhizal, litter, grass, wood };

constexpr const char* name(Guild guild) {
    switch (guild) {
        case Guild::ectomycorrhizal:
            return "ectomycorrhizal";
        case Guild::litter:
            return "litter";
        case Guild::grass:
            return "grass";
        case Guild::wood:
            return "wood";
    }
    return nullptr;
}

/// How a species responds to a condition of its place: 0 beyond what it tolerates, 1 within what it prefers, linear
/// between.
template <int From, int To>
struct ResponseOver {
    Range tolerates{From, To};
    Range prefers{From, To};

    static constexpr void fields(auto visit) {
        using R = ResponseOver;
        visit(&R::tolerates, Info{.name = "tolerates",
                                  .min = From,
                                  .max = To,
                                  .doc = "It lives nowhere outside this range."});
        visit(&R::prefers, Info{.name = "prefers",
                                .min = From,
                                .max = To,
                                .doc = "Nothing in this range limits it; within the other one."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (prefers.from < tolerates.from || prefers.to > tolerates.to)
            report(problems, path + "/prefers", "must lie within what it tolerates");
    }
    /// Returns the response to a value, 0..1.
    [[nodiscard]] constexpr double at(double value) const {
        if (value < tolerates.from || value > tolerates.to) return 0.0;
        if (value < prefers.from) return (value - tolerates.from) / (prefers.from - tolerates.from);
        if (value > prefers.to) return (tolerates.to - value) / (tolerates.to - prefers.to);
        return 1.0;
    }
    bool operator==(const ResponseOver&) const = default;
};

/// A response to a share: of the light of the open sky, of the water that soil can hold, of acidity.
using ShareResponse = ResponseOver<0, 1>;
/// A response to a temperature of the air, degrees Celsius.
using WarmthResponse = ResponseOver<-20, 45>;

/// How the mycelia of a species begin, spread and end.
struct GenetHabit {
    double rate = 0.0003;
    double speed = 0.15;
    double life = 30.0;
    double reach = 8.0;

    static constexpr void fields(auto visit) {
        using G = GenetHabit;
        visit(&G::rate,
              Info{.name = "rate",
                   .unit = "per m² and year",
                   .min = 0,
                   .max = 0.001,
                   .doc = "New mycelia where all conditions are best and none of its guild lives "
                          "yet; on wood, per square metre of bark, a hundred times that."});
        visit(&G::speed, Info{.name = "speed",
                              .unit = "m per year",
                              .min = 0,
                              .max = 2,
                              .doc = "How fast the margin of a mycelium advances."});
        visit(&G::life, Info{.name = "life",
                             .unit = "years",
                             .min = 0.5,
                             .max = 300,
                             .doc = "Mean life of a mycelium."});
        visit(&G::reach, Info{.name = "reach",
                              .unit = "m",
                              .min = 0,
                              .max = 20,
                              .doc = "Greatest radius of a mycelium; beyond 8 m in turf alone."});
    }
    bool operator==(const GenetHabit&) const = default;
};

/// Where round a host or a centre the fruit bodies of a mycelium stand: in arcs of a ring.
struct RingHabit {
    bool pioneer = false;
    double spread = 0.3;
    double inner = 0.0;
    int arcs = 5;
    double covered = 0.6;

    static constexpr void fields(auto visit) {
        using R = RingHabit;
        visit(&R::pioneer,
              Info{.name = "pioneer",
                   .doc = "Of mycorrhizal species: the ring lies where the youngest roots of the "
                          "host are, as far from it as the mycelium has advanced since the host "
                          "was young. Otherwise at about 0.7 of the radius of its crown."});
        visit(&R::spread, Info{.name = "spread",
                               .unit = "m",
                               .min = 0,
                               .max = 3,
                               .doc = "Standard deviation of the distance from the ring's middle "
                                      "line; of rings in turf and litter, breadth of the band "
                                      "behind the margin."});
        visit(&R::inner, Info{.name = "inner",
                              .min = 0,
                              .max = 1,
                              .doc = "Share of bodies in a second ring, at 0.27 of the radius."});
        visit(&R::arcs, Info{.name = "arcs",
                             .min = 1,
                             .max = 16,
                             .doc = "Number of arcs that the ring is broken into."});
        visit(&R::covered, Info{.name = "covered",
                                .min = 0.05,
                                .max = 1,
                                .doc = "Share of the circle that arcs cover."});
    }
    bool operator==(const RingHabit&) const = default;
};

/// How many fruit bodies there are, and how they stand together.
struct FruitHabit {
    double density = 1.0;
    double clusters = 2.0;
    double cluster_spread = 0.1;
    double tufts = 1.0;
    double tuft_spread = 0.012;
    int rain_memory = 12;

    static constexpr void fields(auto visit) {
        using F = FruitHabit;
        visit(&F::density,
              Info{.name = "density",
                   .min = 0,
                   .max = 200,
                   .doc = "Fruit bodies in a flush where nothing limits them: of mycorrhizal "
                          "species and in turf, per metre of ring; in litter, per square metre of "
                          "mycelium; on wood, per square metre of bark."});
        visit(&F::clusters, Info{.name = "clusters",
                                 .min = 1,
                                 .max = 100,
                                 .doc = "Mean number of tufts in a cluster."});
        visit(&F::cluster_spread, Info{.name = "cluster_spread",
                                       .unit = "m",
                                       .min = 0,
                                       .max = 3,
                                       .doc = "Standard deviation of a tuft's place about that of "
                                              "its cluster, in each direction."});
        visit(
            &F::tufts,
            Info{.name = "tufts", .min = 1, .max = 60, .doc = "Mean number of bodies in a tuft."});
        visit(&F::tuft_spread, Info{.name = "tuft_spread",
                                    .unit = "m",
                                    .min = 0,
                                    .max = 0.3,
                                    .doc = "Standard deviation of a body's place about that of its "
                                           "tuft, in each direction."});
        visit(&F::rain_memory,
              Info{.name = "rain_memory",
                   .unit = "days",
                   .min = 1,
                   .max = 40,
                   .doc = "Mean time from rain to the bodies that it makes: about 12 for agarics, "
                          "2 for jellies."});
    }
    bool operator==(const FruitHabit&) const = default;
};

/// How long a fruit body takes to mature and how long it stays.
struct BodyLife {
    double days_to_mature = 8.0;
    double days_alive = 12.0;
    bool perennial = false;

    static constexpr void fields(auto visit) {
        using B = BodyLife;
        visit(&B::days_to_mature, Info{.name = "days_to_mature",
                                       .unit = "days",
                                       .min = 0.5,
                                       .max = 2000,
                                       .doc = "From the first pin to age 0.6."});
        visit(&B::days_alive, Info{.name = "days_alive",
                                   .unit = "days",
                                   .min = 0.5,
                                   .max = 11000,
                                   .doc = "From then to age 1, when it is gone."});
        visit(&B::perennial,
              Info{.name = "perennial", .doc = "A bracket that stands through winters."});
    }
    bool operator==(const BodyLife&) const = default;
};

/// How spores leave and fall.
struct SporeHabit {
    double settling = 0.0015;
    double height = 0.06;

    static constexpr void fields(auto visit) {
        using S = SporeHabit;
        visit(&S::settling, Info{.name = "settling",
                                 .unit = "m/s",
                                 .min = 0.0001,
                                 .max = 0.05,
                                 .doc = "Speed at which spores fall in still air."});
        visit(&S::height, Info{.name = "height",
                               .unit = "m",
                               .min = 0.001,
                               .max = 20,
                               .doc = "Height above the ground at which they are released."});
    }
    bool operator==(const SporeHabit&) const = default;
};

/// The ecology of a species. Months of fruiting are among its facts.
struct Ecology {
    Guild guild = Guild::litter;
    std::vector<Text<48>> trees;
    Range decay{0.0, 1.0};
    bool on_standing_wood = false;
    ShareResponse light, wetness, acidity;
    WarmthResponse temperature{{0.0, 28.0}, {7.0, 18.0}};
    GenetHabit genet;
    RingHabit ring;
    FruitHabit fruit;
    BodyLife body;
    SporeHabit spores;

    static constexpr void fields(auto visit) {
        using E = Ecology;
        visit(&E::guild, Info{.name = "guild", .doc = "What it lives on."});
        visit(&E::trees, Info{.name = "trees",
                              .most = 12,
                              .doc = "Kinds of trees (presets under /v1/trees) on whose roots, "
                                     "litter or wood it lives; any if the list is empty."});
        visit(&E::decay, Info{.name = "decay",
                              .min = 0,
                              .max = 1,
                              .doc = "Of wood: which share of its mass is lost while the species "
                                     "lives on it."});
        visit(&E::on_standing_wood,
              Info{.name = "on_standing_wood", .doc = "It also lives on trunks that stand."});
        visit(&E::light, Info{.name = "light", .doc = "To the share of the light of an open sky."});
        visit(&E::wetness, Info{.name = "wetness",
                                .doc = "To how wet the ground is on the mean of autumn days: 1 "
                                       "where water stands at the surface."});
        visit(&E::acidity, Info{.name = "acidity",
                                .doc = "To the acidity of the soil: 0 on chalk, 1 on sand and "
                                       "raw humus."});
        visit(&E::temperature, Info{.name = "temperature",
                                    .unit = "°C",
                                    .doc = "Of fruiting, to the mean of five days."});
        visit(&E::genet, Info{.name = "genet", .doc = "Its mycelia."});
        visit(&E::ring, Info{.name = "ring", .doc = "Where bodies stand round a host or centre."});
        visit(&E::fruit, Info{.name = "fruit", .doc = "How many bodies, and how close together."});
        visit(&E::body, Info{.name = "body", .doc = "Life of a fruit body."});
        visit(&E::spores, Info{.name = "spores", .doc = "How spores leave and fall."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (genet.reach > 8.0 && guild != Guild::grass)
            report(problems, path + "/genet/reach", "is at most 8 m outside turf");
    }
    bool operator==(const Ecology&) const = default;
};
static_assert(well_described<Ecology>());

}  // namespace sporeprint
