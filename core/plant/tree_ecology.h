// What a stand in a world needs to know of a kind of tree: where it grows, how tall and old it becomes,
// and how its crown and its dead wood differ from those of others.
#pragma once

#include "core/model/ecology.h"
#include "core/params/describe.h"

namespace sporeprint {

/// The ecology of a kind of tree.
struct TreeEcology {
    ShareResponse light, wetness, acidity;
    double height = 28.0;
    double life = 180.0;
    double decay = 0.054;
    double crown = 1.0;
    double crown_base = 0.4;
    bool evergreen = false;
    double leaf_density = 0.5;

    static constexpr void fields(auto visit) {
        using E = TreeEcology;
        visit(&E::light, Info{.name = "light",
                              .doc = "To the share of the light of an open sky in which its "
                                     "seedlings stand."});
        visit(&E::wetness, Info{.name = "wetness",
                                .doc = "To how wet the ground is on the mean: 1 where water stands "
                                       "at the surface."});
        visit(&E::acidity, Info{.name = "acidity",
                                .doc = "To the acidity of the soil: 0 on chalk, 1 on sand and raw "
                                       "humus."});
        visit(&E::height, Info{.name = "height",
                               .unit = "m",
                               .min = 0.1,
                               .max = 60,
                               .doc = "Mean height in old age."});
        visit(&E::life, Info{.name = "life",
                             .unit = "years",
                             .min = 0.5,
                             .max = 1000,
                             .doc = "Mean age at death of trees that neither storm nor neighbour "
                                    "kills."});
        visit(&E::decay, Info{.name = "decay",
                              .unit = "per year",
                              .min = 0.01,
                              .max = 2,
                              .doc = "k of the mass e^(-k t) that is left of dead wood after a "
                                     "time t."});
        visit(&E::crown, Info{.name = "crown",
                              .min = 0.1,
                              .max = 3,
                              .doc = "Radius of the crown, as a multiple of that of a beech as "
                                     "tall."});
        visit(&E::crown_base, Info{.name = "crown_base",
                                   .min = 0,
                                   .max = 0.95,
                                   .doc = "Height of the lowest leaves in a stand, as a share of "
                                          "that of the tree."});
        visit(&E::evergreen, Info{.name = "evergreen", .doc = "It has leaves in winter too."});
        visit(&E::leaf_density, Info{.name = "leaf_density",
                                     .unit = "m² per m³",
                                     .min = 0,
                                     .max = 5,
                                     .doc = "Area of leaves in a volume of the crown in summer."});
    }
    bool operator==(const TreeEcology&) const = default;
};
static_assert(well_described<TreeEcology>());

}  // namespace sporeprint
