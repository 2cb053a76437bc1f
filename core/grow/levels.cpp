#include "core/grow/levels.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/grow/names.h"
#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// name  product_name()
std::string name_of(const Level& level, const std::string& name) {
    return level.name.empty() ? level_name(name, level.lod.lod) : level.name;
}

}  // namespace

double inscribed_error(int corners) {
    const double half = pi / corners;
    return 1.0 - sine_cosine(half).cosine;
}

void set_coverages(std::vector<Level>& levels, const Bounds& box, std::span<const double> errors) {
    if (levels.empty() || errors.size() != levels.size())
        throw GenerationError("each level of detail has an error");
    const glm::vec3 size = box.max - box.min;
    const double extent = std::max({size.x, size.y, size.z});
    double finer = 1.0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const bool is_last = i + 1 == levels.size();
        const double pixels = is_last ? least_pixels : extent / std::max(errors[i + 1], 1e-9);
        finer = std::min(finer, std::max(pixels, least_pixels) / screen_pixels);
        levels[i].screen_coverage = finer;
    }
}

int nearest_level(int triangles, const std::function<double(int)>& count_at) {
    int nearest = 0;
    double least = 0.0;
    for (int lod = 0; lod < static_cast<int>(details.size()); ++lod) {
        const double count = count_at(lod), wanted = triangles;
        const double off = std::max(count, wanted) / std::min(count, wanted);
        if (lod > 0 && off >= least) continue;
        nearest = lod;
        least = off;
    }
    return nearest;
}

Value level_list(std::span<const Level> levels) {
    Value list = Value::array();
    for (const Level& level : levels) {
        Value item = Value::object();
        item.set("lod", level.lod.is_whole() ? Value(level.lod.lod) : Value(level.lod.number()));
        item.set("vertices", Value(level.vertices));
        item.set("triangles", Value(level.triangles));
        item.set("screen_coverage", Value(level.screen_coverage));
        if (!level.name.empty()) item.set("name", level.name);
        list.push(std::move(item));
    }
    return list;
}

void link_levels(GlbScene& scene, std::span<const std::size_t> nodes, std::span<const Level> levels,
                 Lods lods) {
    if (lods != Lods::msft || nodes.size() < 2) return;
    Value ids = Value::array(), coverages = Value::array();
    for (const std::size_t node : nodes.subspan(1)) {
        ids.push(Value(node));
        scene.nodes[node].in_scene = false;
    }
    for (const Level& level : levels) coverages.push(Value(level.screen_coverage));
    GlbNode& first = scene.nodes[nodes.front()];
    first.extensions.push_back({"MSFT_lod", dump(Value::object().set("ids", std::move(ids)))});
    first.extras_json = dump(Value::object().set("MSFT_screencoverage", std::move(coverages)));
}

void add_grouped_levels(GlbScene& scene, const std::string& name, std::span<const Level> levels,
                        Lods lods,
                        const std::function<void(std::size_t, const std::string&)>& add) {
    std::vector<std::size_t> nodes;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const std::string own = name_of(levels[i], name);
        std::size_t first = scene.nodes.size();
        if (lods != Lods::single) {
            nodes.push_back(first++);
            scene.nodes.push_back({.name = own});
        }
        add(i, own);
        if (lods != Lods::single)
            for (; first < scene.nodes.size(); ++first)
                scene.nodes[nodes.back()].children.push_back(first);
    }
    link_levels(scene, nodes, levels, lods);
}

void add_levels(GlbScene& scene, const std::string& name,
                std::span<const std::vector<GlbPrimitive>> primitives,
                std::span<const Level> levels, Lods lods) {
    std::vector<std::size_t> nodes;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const std::string own = name_of(levels[i], name);
        nodes.push_back(scene.nodes.size());
        scene.nodes.push_back({.name = own, .mesh = scene.meshes.size()});
        scene.meshes.push_back({own, primitives[i]});
    }
    link_levels(scene, nodes, levels, lods);
}

}  // namespace sporeprint
