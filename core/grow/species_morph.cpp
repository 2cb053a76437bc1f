#include "core/grow/species_morph.h"

#include <utility>
#include <variant>

#include "core/individual/resolve.h"

namespace sporeprint {

namespace {

constexpr int arcs_per_curve = 9;

std::vector<OutlineSample> scaled(std::vector<OutlineSample> rings, double size) {
    for (OutlineSample& ring : rings) {
        ring.r *= size;
        ring.y *= size;
    }
    return rings;
}

LimbShape limb_of(const Bush& bush, const Bush::Node& node) {
    const glm::dvec3 bearer =
        node.parent == Bush::none ? glm::dvec3(0.0) : bush.nodes[node.parent].place;
    const glm::dvec3 start = bearer + node.beside;
    return {{start.x, start.y, start.z},
            {node.place.x, node.place.y, node.place.z},
            node.radius,
            node.presence};
}

std::vector<LimbPair> limbs_of(const Bush& a, const Bush& b) {
    std::vector<LimbPair> limbs;
    limbs.reserve(a.nodes.size());
    for (std::uint32_t i = 0; i < a.nodes.size(); ++i) {
        const Bush::Node& node = a.nodes[i];
        LimbPair limb;
        if (node.parent != Bush::none) {
            limb.bearer = static_cast<int>(node.parent);
            limb.goes_on = a.nodes[node.parent].children[0] == i;
        }
        limb.a = limb_of(a, node);
        limb.b = limb_of(b, b.nodes[i]);
        limbs.push_back(limb);
    }
    return limbs;
}

}  // namespace

SpeciesMorph species_morph(const std::array<std::string, 2>& species, double age,
                           const Atlas& atlas, const Workshop& workshop) {
    workshop.observer(Step::resolve);
    MushroomOrder order;
    order.mix = {{species[0], 500}, {species[1], 500}};
    order.params.age = age;
    const AtlasEntry* first = atlas.find(species[0]);
    if (first && std::holds_alternative<Branched>(first->species.stages.front().model.shape)) {
        std::vector<Bush> bushes = species_bushes(order, atlas);
        if (species[1] < species[0]) std::swap(bushes[0], bushes[1]);  // they stand by id
        SpeciesMorph morph;
        morph.limbs = limbs_of(bushes[0], bushes[1]);
        return morph;
    }
    const SpeciesShapes shapes = species_shapes(order, atlas, workshop.memo.morphs);
    if (workshop.stop.stop_requested()) throw Cancelled();

    workshop.observer(Step::build);
    SpeciesMorph morph;
    morph.arcs = shapes.set->arcs(age, arcs_per_curve);
    for (std::size_t side = 0; side < 2; ++side) {
        const Outline outline(shapes.set->nodes(shapes.weights[side]));
        for (const CurveName curve : curve_names)
            morph.outlines[side][static_cast<std::size_t>(curve)] =
                scaled(outline.rings(curve, 0), shapes.sizes[side]);
    }
    morph.certificate = shapes.set->certificate(shapes.weights[0], shapes.weights[1]);
    if (species[1] < species[0]) {  // the set stands by id
        std::swap(morph.outlines[0], morph.outlines[1]);
        for (Arc& arc : morph.arcs) std::swap(arc.a, arc.b);
    }
    return morph;
}

}  // namespace sporeprint
