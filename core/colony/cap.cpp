#include "core/colony/cap.h"

#include <algorithm>
#include <vector>

#include "core/geometry/sweep.h"
#include "core/individual/proportion.h"
#include "core/math/purposes.h"
#include "core/mesh/detail.h"
#include "core/mesh/index_order.h"

namespace sporeprint {

namespace {

/// Returns a straight stem of constant radius that widens towards the junction.
SubCurve straight_stem(double radius, double base, const OutlineSample& top, double flare) {
    const double from = std::min(base, top.y - 2.0 * flare);
    std::vector<OutlineNode> nodes(3);
    nodes[0] = {{radius, from}, {0.0, top.y - flare - from}};
    nodes[1] = {{radius, top.y - flare}, {0.0, flare}};
    const glm::dvec2 end = top.tangent_y > 0.5 ? flare * glm::dvec2(top.tangent_r, top.tangent_y)
                                               : glm::dvec2(0, flare);
    nodes[2] = {{top.r, top.y}, end};
    return SubCurve(nodes, {0.0, 1.0});
}

/// Returns rings from the axis, over a disc inside the stem, up to the junction. At the lower end
/// they are slightly narrower than the stem and then slightly wider, so that they cross its skin
/// exactly once.
std::vector<OutlineSample> neck_rings(const SubCurve& stem, const OutlineSample& top, double depth,
                                      int lod) {
    struct Ring {
        double below, width;  // shares of the depth and of the stem's radius
    };
    static constexpr Ring fine[] = {{1.0, 0.88}, {0.7, 0.97}, {0.5, 1.012}, {0.25, 1.01}};
    static constexpr Ring coarse[] = {{1.0, 0.86}, {0.5, 1.015}};
    static constexpr Ring farthest[] = {{1.0, 0.97}};
    const std::span<const Ring> rings = lod >= farthest_lod ? std::span<const Ring>(farthest)
                                        : lod <= 1          ? std::span<const Ring>(fine)
                                                            : std::span<const Ring>(coarse);
    std::vector<OutlineSample> samples;
    for (const Ring& ring : rings) {
        OutlineSample sample = stem.at(1.0 - ring.below * depth / stem.length());
        sample.r *= ring.width;
        samples.push_back(sample);
    }
    // The start of a stem has no dents, so that the pole remains one point.
    OutlineSample pole = samples.front();
    pole.share = 0.0;
    pole.r = 0.0;
    pole.tangent_r = 1.0;
    pole.tangent_y = 0.0;
    samples.insert(samples.begin(), pole);
    samples.push_back(top);
    return samples;
}

}  // namespace

StemFit stem_fit(const Individual& individual) {
    if (const BranchGraph& branch_graph = individual.branch_graph; individual.is_branched())
        return {branch_graph.trunk_radius, branch_graph.height, branch_graph.trunk,
                branch_graph.reach};
    const OutlineSample top = individual.outline.stem.at(1.0);
    return {top.r, top.y, individual.outline.stem.length(),
            greatest_radius(individual.outline.cap)};
}

double neck_length(double neck) { return 1.4 + 1.2 * (neck - 1.0); }

Mesh cap_mesh(Individual individual, const CapCut& cut) {
    Outline& outline = individual.outline;
    OutlineSample top = outline.rings(CurveName::stem, cut.lod).back();
    top.share = 1.0;
    const double radius = top.r / cut.neck;
    const double depth = neck_length(cut.neck) * radius;
    outline.stem = straight_stem(radius, individual.stem_base, top, depth);
    individual.stem_base = outline.stem.at(0.0).y;

    // Stems of a colony have their own curve, and there is no ground here.
    individual.axis = AxisCurve();
    DeformationOf<Plain>& deformation = individual.model.deformation;
    deformation.bend_deg = deformation.twist_deg = deformation.lean_deg = deformation.taper = 0.0;
    individual.has_sac = false;
    std::erase_if(individual.layers, [](const PatchLayer& layer) {
        return layer.purpose == purposes::bulb_scales || !layer.segments.empty();
    });
    individual.ring.height = std::max(individual.ring.height, 0.6);

    const std::vector<OutlineSample> rings = neck_rings(outline.stem, top, depth, cut.lod);
    Mesh mesh = swept_mesh(individual, cut.lod, {.textured = cut.textured, .stem = rings});
    for (glm::vec3& place : mesh.positions) place.y -= static_cast<float>(top.y);
    order_for_vertex_cache(mesh);
    return mesh;
}

}  // namespace sporeprint
