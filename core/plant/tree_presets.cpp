#include <vector>

#include "core/plant/tree.h"

namespace sporeprint {

namespace {

std::vector<TreePreset> make_presets() {
    std::vector<TreePreset> presets;
    {
        TreeShape oak;
        oak.topology.matrix = MatrixKind::random_increasing;
        oak.topology.toward = MatrixKind::random_binary;
        oak.topology.blend = 0.6;
        oak.topology.order = 7;
        oak.fork_deg = 34;
        oak.main_deg = 20;
        oak.side_deg = 76;
        oak.length_law = OrderLaw::geometric;
        oak.length_rise = 1.18;
        oak.twig_length = 0.1;
        oak.width_rise = 2.0;
        oak.twig_radius = 0.0028;
        oak.trunk = 0.8;
        oak.plagiotropy = 0.3;
        oak.gravitropism = 0.015;
        oak.evenness = 0.5;
        oak.phototropism = 0.02;
        presets.push_back({"broadleaf",
                           "Broadleaf",
                           "oak",
                           oak,
                           {.per_tip = 9, .leaf_size = 1.7, .leaf_deg = 60, .droop = 0.3},
                           {.ridge = {112, 98, 82},
                            .furrow = {44, 37, 31},
                            .furrows = 0.9,
                            .ridges = 14,
                            .stretch = 5}});
    }
    {
        TreeShape birch;
        birch.topology.matrix = MatrixKind::own;
        birch.topology.rows = {
            {0.7, 0.3}, {0.35, 0.4, 0.25}, {0.1, 0.3, 0.45, 0.15}, {0.02, 0.08, 0.45, 0.4, 0.05}};
        birch.topology.order = 5;
        birch.fork_deg = 24;
        birch.main_deg = 6;
        birch.side_deg = 62;
        birch.length_law = OrderLaw::geometric;
        birch.length_rise = 1.12;
        birch.twig_length = 0.13;
        birch.width_rise = 2.0;
        birch.twig_radius = 0.002;
        birch.trunk = 1.2;
        birch.shortening = 0.5;
        birch.gravitropism = -0.015;
        birch.evenness = 0.5;
        presets.push_back({"birch",
                           "Birch-like",
                           "birch",
                           birch,
                           {.per_tip = 8, .leaf_size = 1.9, .leaf_deg = 50, .droop = 0.8},
                           {.ridge = {222, 218, 208},
                            .furrow = {90, 84, 80},
                            .furrows = 0.15,
                            .ridges = 6,
                            .stretch = 1.5,
                            .lenticels = 0.5}});
    }
    {
        TreeShape spruce;
        spruce.topology.matrix = MatrixKind::own;
        spruce.topology.rows = {{0.92, 0.08}, {0.5, 0.42, 0.08}, {0.02, 0.966, 0.0, 0.014}};
        spruce.topology.order = 4;
        spruce.fork_deg = 20;
        spruce.main_deg = 0;
        spruce.side_deg = 100;
        spruce.length_law = OrderLaw::geometric;
        spruce.length_rise = 0.72;
        spruce.twig_length = 0.19;
        spruce.width_rise = 2.0;
        spruce.twig_radius = 0.0022;
        spruce.trunk = 0.5;
        spruce.shortening = 0.9;
        spruce.plagiotropy = 0.9;
        spruce.gravitropism = -0.008;
        spruce.evenness = 0.9;
        spruce.variation = 0.1;
        presets.push_back(
            {"spruce",
             "Spruce-like",
             "shoot",
             spruce,
             {.per_tip = 7, .leaf_size = 1.9, .leaf_deg = 45, .droop = 0.15, .size_spread = 0.3},
             {.ridge = {112, 84, 66},
              .furrow = {62, 44, 36},
              .furrows = 0.6,
              .ridges = 18,
              .stretch = 1.4}});
    }
    {
        TreeShape poplar;
        poplar.topology.matrix = MatrixKind::own;
        poplar.topology.rows = {{0.75, 0.25}, {0.4, 0.45, 0.15}, {0.05, 0.3, 0.62, 0.03}};
        poplar.topology.order = 4;
        poplar.fork_deg = 16;
        poplar.main_deg = 4;
        poplar.side_deg = 80;
        poplar.length_law = OrderLaw::geometric;
        poplar.length_rise = 1.15;
        poplar.twig_length = 0.11;
        poplar.width_rise = 2.0;
        poplar.twig_radius = 0.003;
        poplar.trunk = 0.6;
        poplar.shortening = 0.5;
        poplar.gravitropism = 0.06;
        poplar.evenness = 0.7;
        presets.push_back({"poplar",
                           "Poplar-like",
                           "birch",
                           poplar,
                           {.per_tip = 9, .leaf_size = 1.8, .leaf_deg = 55, .droop = 0.35},
                           {.ridge = {122, 116, 100},
                            .furrow = {58, 52, 44},
                            .furrows = 0.7,
                            .ridges = 10,
                            .stretch = 6}});
    }
    {
        TreeShape shrub;
        shrub.topology.matrix = MatrixKind::perfect;
        shrub.topology.toward = MatrixKind::random_increasing;
        shrub.topology.blend = 0.5;
        shrub.topology.order = 8;
        shrub.fork_deg = 26;
        shrub.main_deg = 14;
        shrub.side_deg = 50;
        shrub.length_law = OrderLaw::linear;
        shrub.length_rise = 0.12;
        shrub.twig_length = 0.08;
        shrub.width_rise = 2.4;
        shrub.twig_radius = 0.0022;
        shrub.trunk = 0.05;
        shrub.gravitropism = 0.04;
        shrub.evenness = 0.4;
        presets.push_back({"shrub",
                           "Shrub",
                           "maple",
                           shrub,
                           {.per_tip = 4, .leaf_size = 0.5, .leaf_deg = 55, .droop = 0.2},
                           {.ridge = {104, 84, 62},
                            .furrow = {70, 56, 42},
                            .furrows = 0.2,
                            .ridges = 10,
                            .stretch = 4,
                            .lenticels = 0.2,
                            .lenticel = {150, 128, 100}}});
    }
    {
        TreeShape herb;
        herb.topology.matrix = MatrixKind::own;
        herb.topology.rows = {{0.6, 0.4}, {0.25, 0.6, 0.15}};
        herb.topology.order = 3;
        herb.topology.tips = MatrixKind::fishbone;
        herb.topology.forks = 0.35;
        herb.topology.tip_order = 3;
        herb.fork_deg = 22;
        herb.main_deg = 8;
        herb.side_deg = 48;
        herb.length_law = OrderLaw::linear;
        herb.length_rise = 0.5;
        herb.twig_length = 0.014;
        herb.width_rise = 2.6;
        herb.twig_radius = 0.0005;
        herb.trunk = 0.03;
        herb.gravitropism = 0.08;
        presets.push_back({"herb",
                           "Herb",
                           "birch",
                           herb,
                           {.per_tip = 3, .leaf_size = 0.5, .leaf_deg = 60, .droop = 0.1},
                           {.ridge = {96, 120, 62},
                            .furrow = {70, 96, 46},
                            .furrows = 0.25,
                            .ridges = 8,
                            .stretch = 12}});
    }
    return presets;
}

}  // namespace

std::span<const TreePreset> tree_presets() {
    static const std::vector<TreePreset> presets = make_presets();
    return presets;
}

const TreePreset* tree_preset(std::string_view id) {
    for (const TreePreset& preset : tree_presets())
        if (id == preset.id) return &preset;
    return nullptr;
}

}  // namespace sporeprint
