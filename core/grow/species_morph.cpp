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

SegmentShape segment_of(const BranchGraph& branch_graph, const BranchGraph::Node& node) {
    const glm::dvec3 parent_end =
        node.parent == BranchGraph::none ? glm::dvec3(0.0) : branch_graph.nodes[node.parent].place;
    const glm::dvec3 start = parent_end + node.beside;
    return {{start.x, start.y, start.z},
            {node.place.x, node.place.y, node.place.z},
            node.radius,
            node.presence};
}

std::vector<SegmentPair> segment_pairs_of(const BranchGraph& a, const BranchGraph& b) {
    std::vector<SegmentPair> segments;
    segments.reserve(a.nodes.size());
    for (std::uint32_t i = 0; i < a.nodes.size(); ++i) {
        const BranchGraph::Node& node = a.nodes[i];
        SegmentPair segment;
        if (node.parent != BranchGraph::none) {
            segment.parent = static_cast<int>(node.parent);
            segment.goes_on = a.nodes[node.parent].children[0] == i;
        }
        segment.a = segment_of(a, node);
        segment.b = segment_of(b, b.nodes[i]);
        segments.push_back(segment);
    }
    return segments;
}

}  // namespace

SpeciesMorph species_morph(const std::array<std::string, 2>& species, double age,
                           const Atlas& atlas, const ExecutionContext& execution) {
    execution.observer(Step::resolve);
    MushroomSpec spec;
    spec.mix = {{species[0], 500}, {species[1], 500}};
    spec.params.age = age;
    const AtlasEntry* first = atlas.find(species[0]);
    if (first && std::holds_alternative<Branched>(first->species.stages.front().model.shape)) {
        std::vector<BranchGraph> graphs = species_branch_graphs(spec, atlas);
        if (species[1] < species[0]) std::swap(graphs[0], graphs[1]);  // sorted by id
        SpeciesMorph morph;
        morph.segments = segment_pairs_of(graphs[0], graphs[1]);
        return morph;
    }
    const SpeciesShapes shapes = species_shapes(spec, atlas, execution.caches.morphs);
    if (execution.stop.stop_requested()) throw Cancelled();

    execution.observer(Step::build);
    SpeciesMorph morph;
    morph.arcs = shapes.set->arcs(age, arcs_per_curve);
    for (std::size_t side = 0; side < 2; ++side) {
        const Outline outline(shapes.set->nodes(shapes.weights[side]));
        for (const CurveName curve : curve_names)
            morph.outlines[side][static_cast<std::size_t>(curve)] =
                scaled(outline.rings(curve, 0), shapes.sizes[side]);
    }
    morph.certificate = shapes.set->certificate(shapes.weights[0], shapes.weights[1]);
    if (species[1] < species[0]) {  // the set is sorted by id
        std::swap(morph.outlines[0], morph.outlines[1]);
        for (Arc& arc : morph.arcs) std::swap(arc.a, arc.b);
    }
    return morph;
}

}  // namespace sporeprint
