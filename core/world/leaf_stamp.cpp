#include "core/world/leaf_stamp.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <utility>

#include "core/math/elementary.h"
#include "core/plant/venation.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Breadth by length of a leaf below which it is a needle.
constexpr double widest_needle = 0.16;

constexpr int samples = 3;  // of a texel in each direction

struct Box {
    glm::dvec2 from{1e9}, to{-1e9};
};

Box box_of(const Lamina& lamina) {
    Box box;
    for (const glm::dvec2& at : border_of(lamina)) {
        box.from = glm::min(box.from, at);
        box.to = glm::max(box.to, at);
    }
    return box;
}

glm::vec3 encoded(const glm::dvec3& light) {
    return {static_cast<float>(linear_to_srgb(light.x)),
            static_cast<float>(linear_to_srgb(light.y)),
            static_cast<float>(linear_to_srgb(light.z))};
}

}  // namespace

bool has_needles(const LeafLitter& kind) {
    const Box box = box_of(lamina_of(kind.shape.venation, 1));
    return box.to.x - box.from.x < widest_needle * (box.to.y - box.from.y);
}

LeafStamp leaf_stamp(const LeafLitter& kind, int columns) {
    if (columns < 8 || columns > 128) throw InvalidInput("/columns", "a stamp has 8..128 columns");
    const LaminaSampler lamina(lamina_of(kind.shape.venation, 3));
    const Box box = box_of(lamina.lamina());
    const glm::dvec2 middle = 0.5 * (box.from + box.to), size = box.to - box.from;
    const double extent = 1.04 * size.y;
    const LeafColourMap colours(kind.palette);
    LeafStamp stamp;
    stamp.columns = columns;
    stamp.rows =
        std::clamp(static_cast<int>(std::ceil(1.04 * columns * size.x / size.y)), 2, 4 * columns);
    stamp.length = extent * kind.shape.length;
    stamp.half = static_cast<float>(0.5 * stamp.rows / columns);
    stamp.texels.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(stamp.rows));
    for (int row = 0; row < stamp.rows; ++row)
        for (int column = 0; column < columns; ++column) {
            glm::dvec3 upper(0.0), lower(0.0);
            double rise = 0.0;
            int inside = 0;
            for (int i = 0; i < samples; ++i)
                for (int j = 0; j < samples; ++j) {
                    const double along = (column + (i + 0.5) / samples) / columns - 0.5;
                    const double across = (row + (j + 0.5) / samples - 0.5 * stamp.rows) / columns;
                    const LaminaPlace place =
                        lamina.at(middle + extent * glm::dvec2(across, along));
                    if (!place.inside) continue;
                    ++inside;
                    const LeafColourMap::Faces faces = colours.at(place, 1.0);
                    // Veins lie deep, and dry borders bend up.
                    const double vein =
                        1.0 - smooth_step(0.0, 0.03, std::min(place.from_main, place.from_side));
                    upper += (1.0 - 0.16 * vein) * faces.upper;
                    lower += faces.lower;
                    rise += 0.03 * place.affinity * place.affinity - 0.012 * vein;
                }
            if (inside == 0) continue;
            LeafStamp::Texel& texel =
                stamp.texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                             static_cast<std::size_t>(column)];
            texel.upper = encoded(upper / static_cast<double>(inside));
            texel.lower = encoded(lower / static_cast<double>(inside));
            texel.cover = static_cast<float>(inside) / static_cast<float>(samples * samples);
            texel.rise = static_cast<float>(rise / inside);
        }
    return stamp;
}

}  // namespace sporeprint
