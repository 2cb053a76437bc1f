// The mushroom as plain data: the paper's tuple (skeleton, silhouette, deformation, images), plus
// ornaments and weathering.
#pragma once

#include <variant>

#include "core/model/branched.h"
#include "core/model/deformation.h"
#include "core/model/hymenium.h"
#include "core/model/receptacle.h"
#include "core/model/spines.h"
#include "core/model/surface.h"
#include "core/model/swept.h"
#include "core/model/veils.h"
#include "core/model/weathering.h"
#include "core/params/describe.h"
#include "core/params/types.h"

namespace sporeprint {

/// All parameters of one mushroom as plain data without behaviour.
struct Model {
    std::variant<Swept, Branched> shape;
    DeformationOf<Plain> deformation;
    HymeniumOf<Plain> hymenium;
    PatchStyle warts;
    PatchStyle scales;
    PatchStyle volva;
    SacStyle sac;
    RingStyle ring;
    SpineStyle spines;
    PeridioleStyle peridioles;
    ReceptacleStyle receptacle;
    OrnamentsOf<Plain> ornaments;
    WeatheringOf<Plain> weathering;
    Surface surface;
    Material material;

    static constexpr void fields(auto visit) {
        visit(&Model::shape, Info{.name = "", .doc = "Shape family."});
        visit(&Model::deformation,
              Info{.name = "deformation", .doc = "Axial and free-form deformation."});
        visit(&Model::hymenium, Info{.name = "hymenium", .doc = "Gills, ridges, pores or teeth."});
        visit(&Model::warts,
              Info{.name = "warts", .doc = "Remnants of the universal veil on the cap."});
        visit(&Model::scales, Info{.name = "scales", .doc = "Scales of the cap's torn skin."});
        visit(
            &Model::volva,
            Info{.name = "volva",
                 .doc =
                     "Scales on the bulb; positions run from the ground (0) to the stem top (1) of "
                     "the mature stem, and stay on the skin where it grows."});
        visit(&Model::sac, Info{.name = "sac", .doc = "A sac round the base of the stem."});
        visit(&Model::ring, Info{.name = "ring", .doc = "Ring on the stem."});
        visit(&Model::spines, Info{.name = "spines", .doc = "Hanging spines of tooth fungi."});
        visit(&Model::peridioles,
              Info{.name = "peridioles", .doc = "Packets of spores in the cup of a bird's nest."});
        visit(&Model::receptacle,
              Info{.name = "receptacle", .doc = "The net that a cage fungus unfolds."});
        visit(&Model::ornaments, Info{.name = "ornaments",
                                      .doc = "How much is left of the veils, and of "
                                             "what forms under them; glow."});
        visit(&Model::weathering, Info{.name = "weathering", .doc = "What time and weather did."});
        visit(&Model::surface, Info{.name = "surface", .doc = "What is painted."});
        visit(&Model::material,
              Info{.name = "material", .doc = "Slime, velvet, light through the flesh, and glow."});
    }
    bool operator==(const Model&) const = default;
};

}  // namespace sporeprint
