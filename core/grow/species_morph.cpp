#include "core/grow/species_morph.h"

#include <utility>

#include "core/model/resolve.h"

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

}  // namespace

SpeciesMorph species_morph(const std::array<std::string, 2>& species, double age,
                           const Atlas& atlas, const Workshop& workshop) {
    workshop.observer(Step::resolve);
    MushroomOrder order;
    order.mix = {{species[0], 500}, {species[1], 500}};
    order.params.age = age;
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
