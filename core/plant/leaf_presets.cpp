#include <span>
#include <string_view>
#include <vector>

#include "core/plant/leaf.h"

namespace sporeprint {

namespace {

LeafPalette palette(LeafColours summer, LeafColours turning, LeafColours fallen, double paler) {
    return {summer, turning, fallen, paler};
}

std::vector<LeafPreset> make_presets() {
    std::vector<LeafPreset> presets;
    {
        LeafShape maple;
        maple.venation = {.lobes = {5},
                          .nodes = 5,
                          .node_loss = 0.9,
                          .vein_deg = 46,
                          .side_deg = 42,
                          .law = LengthLaw::logarithmic,
                          .rise = 0.5,
                          .side_length = 1.2,
                          .narrow_tip = 0.5,
                          .border = 1.2,
                          .sinus = 0.45,
                          .smooth = 0.8,
                          .pointed = 1.0};
        maple.length = 0.11;
        maple.petiole = 0.8;
        maple.curl_deg = 20;
        maple.fold_deg = 8;
        presets.push_back({"maple", "Maple-like", maple,
                           palette({{170, 186, 104},
                                    {62, 104, 38},
                                    {84, 128, 46},
                                    {92, 132, 50},
                                    0.016,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{226, 196, 92},
                                    {226, 150, 30},
                                    {206, 62, 20},
                                    {176, 28, 22},
                                    0.016,
                                    GradationLaw::linear,
                                    GradationLaw::soft,
                                    0.6},
                                   {{150, 108, 62},
                                    {132, 66, 30},
                                    {104, 46, 26},
                                    {88, 40, 26},
                                    0.016,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.35)});
    }
    {
        LeafShape oak;
        oak.venation = {.lobes = {1},
                        .nodes = 7,
                        .side_deg = 54,
                        .law = LengthLaw::logarithmic,
                        .rise = 0.25,
                        .side_length = 2.7,
                        .narrow_base = 0.9,
                        .narrow_tip = 0.85,
                        .border = 1.06,
                        .sinus = 0.36,
                        .smooth = 1.0,
                        .pointed = 0.0};
        oak.length = 0.11;
        oak.petiole = 0.07;
        oak.curl_deg = 25;
        oak.wave = 0.35;
        presets.push_back({"oak", "Oak-like", oak,
                           palette({{152, 168, 92},
                                    {58, 92, 34},
                                    {74, 110, 40},
                                    {82, 114, 44},
                                    0.014,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.3},
                                   {{196, 158, 84},
                                    {172, 118, 44},
                                    {160, 92, 34},
                                    {138, 70, 30},
                                    0.014,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.5},
                                   {{136, 98, 60},
                                    {116, 76, 44},
                                    {100, 62, 36},
                                    {86, 54, 34},
                                    0.014,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.3)});
    }
    {
        LeafShape birch;
        birch.venation = {.lobes = {1},
                          .nodes = 8,
                          .side_deg = 48,
                          .base_deg = 14,
                          .law = LengthLaw::logarithmic,
                          .rise = 3,
                          .side_length = 2.4,
                          .narrow_base = 0.15,
                          .narrow_tip = 0.95,
                          .border = 1.06,
                          .smooth = 0.9,
                          .pointed = 0.7,
                          .teeth = 0.6,
                          .teeth_per_vein = 3};
        birch.length = 0.055;
        birch.petiole = 0.4;
        birch.curl_deg = 18;
        birch.fold_deg = 12;
        presets.push_back({"birch", "Birch-like", birch,
                           palette({{158, 182, 92},
                                    {78, 122, 40},
                                    {98, 142, 50},
                                    {104, 146, 54},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{206, 200, 96},
                                    {226, 190, 40},
                                    {236, 200, 44},
                                    {220, 170, 34},
                                    0.012,
                                    GradationLaw::early,
                                    GradationLaw::late,
                                    0.4},
                                   {{158, 124, 60},
                                    {150, 108, 46},
                                    {130, 86, 38},
                                    {112, 72, 34},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.3)});
    }
    {
        LeafShape ivy;
        ivy.venation = {.lobes = {5},
                        .nodes = 6,
                        .node_loss = 1.0,
                        .vein_deg = 48,
                        .side_deg = 46,
                        .base_deg = 20,
                        .law = LengthLaw::logarithmic,
                        .rise = 0.8,
                        .side_length = 1.6,
                        .narrow_base = 0,
                        .narrow_tip = 0.95,
                        .border = 1.1,
                        .smooth = 0.7,
                        .pointed = 1.0};
        ivy.length = 0.065;
        ivy.petiole = 0.9;
        ivy.thickness = 0.01;
        ivy.curl_deg = 30;
        ivy.fold_deg = 4;
        presets.push_back({"ivy", "Ivy-like", ivy,
                           palette({{176, 192, 138},
                                    {34, 70, 34},
                                    {44, 84, 40},
                                    {50, 88, 42},
                                    0.024,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.3},
                                   {{164, 156, 108},
                                    {66, 62, 34},
                                    {92, 52, 40},
                                    {106, 44, 42},
                                    0.024,
                                    GradationLaw::late,
                                    GradationLaw::soft,
                                    0.5},
                                   {{138, 116, 76},
                                    {112, 84, 48},
                                    {98, 70, 42},
                                    {88, 62, 40},
                                    0.02,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.4)});
    }
    {
        LeafShape fern;
        fern.venation = {.lobes = {1},
                         .nodes = 24,
                         .side_deg = 70,
                         .law = LengthLaw::linear,
                         .rise = 0.06,
                         .side_length = 4.6,
                         .narrow_base = 0.5,
                         .narrow_tip = 0.9,
                         .border = 1.06,
                         .sinus = 0.9,
                         .smooth = 0.6,
                         .pointed = 0.4};
        fern.length = 0.5;
        fern.petiole = 0.35;
        fern.relief = 0.3;
        fern.curl_deg = 55;
        fern.fold_deg = 6;
        fern.wave = 0.1;
        presets.push_back({"fern", "Fern frond", fern,
                           palette({{122, 140, 66},
                                    {74, 122, 40},
                                    {102, 150, 52},
                                    {116, 158, 60},
                                    0.012,
                                    GradationLaw::linear,
                                    GradationLaw::late,
                                    0.4},
                                   {{160, 128, 66},
                                    {186, 156, 60},
                                    {170, 116, 48},
                                    {150, 92, 42},
                                    0.012,
                                    GradationLaw::linear,
                                    GradationLaw::soft,
                                    0.5},
                                   {{118, 80, 48},
                                    {128, 84, 46},
                                    {108, 66, 38},
                                    {94, 58, 36},
                                    0.012,
                                    GradationLaw::linear,
                                    GradationLaw::late,
                                    0.4},
                                   0.25)});
    }
    {
        // A shoot of a conifer modelled as one leaf: needles in two rows.
        LeafShape shoot;
        shoot.venation = {.lobes = {1},
                          .nodes = 24,
                          .side_deg = 55,
                          .law = LengthLaw::constant,
                          .rise = 0,
                          .side_length = 4.0,
                          .narrow_base = 0.3,
                          .narrow_tip = 0.9,
                          .border = 1.05,
                          .sinus = 0.95,
                          .smooth = 0.3,
                          .pointed = 0.6};
        shoot.length = 0.12;
        shoot.petiole = 0.05;
        shoot.thickness = 0.012;
        shoot.relief = 0.0;
        shoot.curl_deg = 12;
        shoot.fold_deg = 14;
        shoot.wave = 0;
        presets.push_back({"shoot", "Shoot of needles", shoot,
                           palette({{78, 70, 44},
                                    {30, 60, 36},
                                    {40, 78, 44},
                                    {74, 112, 56},
                                    0.03,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.6},
                                   {{104, 84, 48},
                                    {104, 96, 44},
                                    {124, 108, 48},
                                    {134, 106, 48},
                                    0.03,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{104, 76, 46},
                                    {118, 78, 42},
                                    {112, 72, 40},
                                    {104, 66, 38},
                                    0.03,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.3)});
    }
    {
        LeafShape needle;
        needle.venation = {.lobes = {1},
                           .nodes = 2,
                           .side_deg = 20,
                           .law = LengthLaw::constant,
                           .rise = 0,
                           .side_length = 0.1,
                           .border = 1.0,
                           .smooth = 1.0,
                           .pointed = 0.0};
        needle.length = 0.018;
        needle.petiole = 0.04;
        needle.thickness = 0.045;
        needle.relief = 0;
        needle.curl_deg = 14;
        needle.fold_deg = 0;
        needle.wave = 0;
        presets.push_back({"needle", "Needle", needle,
                           palette({{96, 124, 76},
                                    {38, 72, 40},
                                    {46, 82, 46},
                                    {58, 92, 52},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{130, 120, 60},
                                    {118, 108, 48},
                                    {128, 112, 50},
                                    {140, 112, 52},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   {{130, 92, 52},
                                    {124, 82, 44},
                                    {116, 74, 40},
                                    {104, 66, 38},
                                    0.012,
                                    GradationLaw::soft,
                                    GradationLaw::late,
                                    0.4},
                                   0.3)});
    }
    return presets;
}

}  // namespace

std::span<const LeafPreset> leaf_presets() {
    static const std::vector<LeafPreset> presets = make_presets();
    return presets;
}

const LeafPreset* leaf_preset(std::string_view id) {
    for (const LeafPreset& preset : leaf_presets())
        if (id == preset.id) return &preset;
    return nullptr;
}

}  // namespace sporeprint
