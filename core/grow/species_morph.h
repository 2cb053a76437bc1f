// Pipeline of a correspondence between two species, for diagrams: which parts of one become which
// parts of the other.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/params/describe.h"
#include "core/silhouette/morph_set.h"
#include "core/silhouette/outline.h"

namespace sporeprint {

/// A segment of one species' branch graph.
struct SegmentShape {
    std::array<double, 3> start{}, end{};
    double radius = 0.0, presence = 0.0;

    static constexpr void fields(auto visit) {
        using L = SegmentShape;
        visit(&L::start,
              Info{.name = "start", .unit = "m", .min = -10, .max = 10, .doc = "Where it begins."});
        visit(&L::end,
              Info{.name = "end", .unit = "m", .min = -10, .max = 10, .doc = "Where it ends."});
        visit(&L::radius, Info{.name = "radius", .unit = "m", .max = 1, .doc = "At its end."});
        visit(&L::presence,
              Info{.name = "presence",
                   .max = 1,
                   .doc = "How much of it there is: 0 for a limb that the species lacks, which has "
                          "neither length nor radius."});
    }
    bool operator==(const SegmentShape&) const = default;
};

/// A segment that two species have in common.
struct SegmentPair {
    int parent = -1;
    bool goes_on = true;
    SegmentShape a, b;

    static constexpr void fields(auto visit) {
        using L = SegmentPair;
        visit(&L::parent, Info{.name = "bearer",
                               .min = -1,
                               .max = 100000,
                               .doc = "Place in this list of the limb that bears it, which comes "
                                      "before it; -1 for a trunk."});
        visit(&L::goes_on, Info{.name = "goes_on",
                                .doc = "Whether it is the branch that goes on as its bearer; the "
                                       "other leaves it."});
        visit(&L::a, Info{.name = "a", .doc = "What it is in the first species."});
        visit(&L::b, Info{.name = "b", .doc = "What it is in the second."});
    }
    bool operator==(const SegmentPair&) const = default;
};

/// Properties of the branch graphs between two species, and whether they were checked.
struct SegmentCertificate {
    bool matched = true;
    bool checked = false;

    static constexpr void fields(auto visit) {
        using C = SegmentCertificate;
        visit(&C::matched,
              Info{.name = "matched",
                   .doc = "Whether every limb has its counterpart at every moment: so by "
                          "construction, both bushes are drawn on one graph, fork on fork."});
        visit(&C::checked,
              Info{.name = "checked",
                   .doc = "Whether limbs between the two were looked at for passing through each "
                          "other: they are not, and may."});
    }
    bool operator==(const SegmentCertificate&) const = default;
};

/// Two species of one age, each as its template defines it, without individual variation. Branched
/// species have only segments, those of seed 1; swept species only outlines.
struct SpeciesMorph {
    /// [species][CurveName] rings at LOD 0, metres: ring k of one species corresponds to ring k of
    /// the other.
    std::array<std::array<std::vector<OutlineSample>, 3>, 2> outlines;
    std::vector<Arc> arcs;  ///< a sample of corresponding points, besides ends of sub-curves
    /// Result of the proof that no intermediate outline intersects itself.
    Certificate certificate;
    std::vector<SegmentPair> segments;  ///< parents first
    SegmentCertificate segment_certificate;
};

/// Computes the correspondence of two species.
///
/// species  two different ids of one family, in any order
/// throws   InvalidInput, Impossible; Cancelled
[[nodiscard]] SpeciesMorph species_morph(const std::array<std::string, 2>& species, double age,
                                         const Atlas& atlas,
                                         const ExecutionContext& execution = {});

}  // namespace sporeprint
