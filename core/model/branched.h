// Shape family "branched": corals and antlers, whose segments fork by the same ramification
// matrices as trees.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/params/describe.h"
#include "core/ramification/topology.h"

namespace sporeprint {

/// The greatest number of tips of one species' branch graph.
inline constexpr std::size_t most_branch_graph_tips = 600;

/// Directions, lengths and widths of segments. Orders are those of Horton and Strahler: 1 for the
/// terminal segments.
struct SegmentStyle {
    int trunks = 1;
    double height = 0.08;
    double trunk = 0.25;
    double trunk_radius = 0.008;
    double foot = 1.0;
    double tip_radius = 0.0012;
    double splay_deg = 12.0;
    double fork_deg = 25.0;
    double tip_fork_deg = 25.0;
    double side_deg = 40.0;
    double azimuth_deg = 90.0;
    double length_rise = 1.2;
    double tip_length = 1.0;
    double whorls = 0.0;
    double level = 0.5;
    double upright = 0.1;
    double wander = 0.1;
    double unevenness = 0.3;
    double flatness = 0.0;
    double web = 0.3;
    double ruffle = 0.0;
    double bluntness = 0.6;
    double gnarl = 0.0;
    double unfolding = 1.0;

    static constexpr void fields(auto visit) {
        using L = SegmentStyle;
        visit(&L::trunks,
              Info{.name = "trunks", .min = 1, .max = 9, .doc = "Trunks that rise from one foot."});
        visit(&L::height, Info{.name = "height",
                               .unit = "m",
                               .min = 0.002,
                               .max = 1.0,
                               .doc = "From the ground to the highest tip; all lengths follow."});
        visit(&L::trunk, Info{.name = "trunk",
                              .min = 0.02,
                              .max = 0.95,
                              .doc = "Share of the height below the lowest fork."});
        visit(&L::trunk_radius, Info{.name = "trunk_radius",
                                     .unit = "m",
                                     .min = 0.0001,
                                     .max = 0.2,
                                     .doc = "Radius of a trunk below its lowest fork. Between it "
                                            "and the tips limbs are as thick as the number of tips "
                                            "that they bear, to one power."});
        visit(&L::foot, Info{.name = "foot",
                             .min = 0.2,
                             .max = 3,
                             .doc = "Radius of a trunk at the ground over that at its lowest "
                                    "fork."});
        visit(&L::tip_radius, Info{.name = "tip_radius",
                                   .unit = "m",
                                   .min = 0.00005,
                                   .max = 0.05,
                                   .doc = "Radius of the last branches."});
        visit(&L::splay_deg, Info{.name = "splay_deg",
                                  .unit = "deg",
                                  .min = 0,
                                  .max = 80,
                                  .doc = "How far several trunks lean away from each other."});
        visit(&L::fork_deg, Info{.name = "fork_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 85,
                                 .doc = "Turn of either branch of the lowest fork."});
        visit(&L::tip_fork_deg, Info{.name = "tip_fork_deg",
                                     .unit = "deg",
                                     .min = 0,
                                     .max = 85,
                                     .doc = "The same of the last forks; those between lie "
                                            "between, by their order."});
        visit(&L::side_deg,
              Info{.name = "side_deg",
                   .unit = "deg",
                   .min = 0,
                   .max = 100,
                   .doc = "Turn of a branch of much lower order than its bearer; less "
                          "for greater ones."});
        visit(&L::azimuth_deg, Info{.name = "azimuth_deg",
                                    .unit = "deg",
                                    .min = 0,
                                    .max = 180,
                                    .doc = "Turn of the plane of branching from one fork to the "
                                           "next: 0 keeps all forks in one plane (antlers), 90 "
                                           "crosses them."});
        visit(&L::length_rise, Info{.name = "length_rise",
                                    .min = 0.3,
                                    .max = 3,
                                    .doc = "How many times longer each order's limbs are than "
                                           "those of the order below."});
        visit(&L::tip_length, Info{.name = "tip_length",
                                   .min = 0.02,
                                   .max = 4,
                                   .doc = "Length of the last branches over what that law gives "
                                          "them: small for teeth of a crest or crown."});
        visit(&L::whorls, Info{.name = "whorls",
                               .min = 0,
                               .max = 1,
                               .doc = "How soon every second fork follows the one before: at 1 "
                                      "branches stand in fours round one point, tier over tier, as "
                                      "on a candelabrum."});
        visit(&L::level, Info{.name = "level",
                              .min = 0,
                              .max = 1,
                              .doc = "How far lesser branches reach as high as the greater: 1 "
                                     "ends all in one dome."});
        visit(&L::upright, Info{.name = "upright",
                                .min = -0.5,
                                .max = 1,
                                .doc = "How far each limb turns up again; down below 0."});
        visit(&L::wander, Info{.name = "wander",
                               .min = 0,
                               .max = 1,
                               .doc = "How crooked limbs are, each in its own way."});
        visit(&L::unevenness, Info{.name = "unevenness",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How unlike limbs of one order are in length and "
                                          "angle."});
        visit(&L::flatness, Info{.name = "flatness",
                                 .min = 0,
                                 .max = 0.9,
                                 .doc = "How far limbs are flattened into the plane of their "
                                        "forks; trunks half as far."});
        visit(&L::web, Info{.name = "web",
                            .min = 0,
                            .max = 2,
                            .doc = "How much wider a limb is, in that plane, where it forks."});
        visit(&L::ruffle, Info{.name = "ruffle",
                               .min = 0,
                               .max = 1,
                               .doc = "How far the edges of flat limbs wave and curl to either "
                                      "side, as of the lobes of a cauliflower fungus."});
        visit(&L::bluntness, Info{.name = "bluntness",
                                  .min = 0,
                                  .max = 1,
                                  .doc = "0 for tips that taper to a point, 1 for round ends."});
        visit(&L::gnarl, Info{.name = "gnarl",
                              .min = 0,
                              .max = 1,
                              .doc = "How crooked limbs are between their forks, and how uneven in "
                                     "thickness: 0 are even tubes, 1 has knees and hollows."});
        visit(&L::unfolding, Info{.name = "unfolding",
                                  .min = 0,
                                  .max = 1,
                                  .doc = "How far branching has come, from the lowest fork on: 0 "
                                         "is a bare spike, 1 has all its tips."});
    }
    bool operator==(const SegmentStyle&) const = default;
};

/// Returns a topology of plain forks, three levels deep: the default of a model.
inline TreeTopology plain_forks() {
    TreeTopology forks;
    forks.matrix = MatrixKind::perfect;
    forks.order = 4;
    return forks;
}

/// Shape family "branched": a graph of segments with radii. Its branching is drawn once per
/// individual; all other parameters only move it.
struct Branched {
    static constexpr const char* form = "branched";
    TreeTopology ramification = plain_forks();
    SegmentStyle segments;

    static constexpr void fields(auto visit) {
        visit(&Branched::ramification,
              Info{.name = "ramification", .doc = "How often limbs bear which others."});
        visit(&Branched::segments,
              Info{.name = "limbs", .doc = "How limbs stand, and their size."});
    }
    /// Reports more tips than most_branch_graph_tips.
    void check(const std::string& path, std::vector<Problem>& problems) const;
    bool operator==(const Branched&) const = default;
};

}  // namespace sporeprint
