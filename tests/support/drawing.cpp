#include "tests/support/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace sporeprint {

namespace {

struct Projected {
    double x, y, depth;
};

double linear_light(int byte) {
    const double value = byte / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace

Drawing drawn(const Mesh& mesh, const ViewDirection& view, const ImagePlane& canvas,
              std::uint32_t parts, const RawImages* images) {
    const auto is_clear = [&](const glm::vec2& at) {
        if (images == nullptr || images->alpha.empty()) return false;
        const auto texel = [&](float place) {
            return static_cast<std::size_t>(std::clamp(place, 0.0F, 0.9999F) *
                                            static_cast<float>(images->side));
        };
        return images->alpha[texel(at.y) * static_cast<std::size_t>(images->side) + texel(at.x)] <
               128;
    };
    constexpr double degree = 3.14159265358979323846 / 180.0;
    const double ca = std::cos(view.azimuth * degree), sa = std::sin(view.azimuth * degree);
    const double ce = std::cos(view.elevation * degree), se = std::sin(view.elevation * degree);
    const glm::dvec3 right{ca, 0.0, -sa};
    const glm::dvec3 towards{sa * ce, se, ca * ce};
    const glm::dvec3 up = glm::cross(towards, right);
    const double scale = canvas.pixels / canvas.side;
    std::vector<Projected> points;
    points.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 from = glm::dvec3(position) - glm::dvec3(canvas.middle);
        points.push_back({0.5 * canvas.pixels + scale * glm::dot(from, right),
                          0.5 * canvas.pixels - scale * glm::dot(from, up),
                          glm::dot(from, towards)});
    }
    Drawing drawing;
    drawing.pixels = canvas.pixels;
    drawing.seen.resize(static_cast<std::size_t>(canvas.pixels) *
                        static_cast<std::size_t>(canvas.pixels));
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const std::array<std::uint32_t, 3> corners = {mesh.indices[t], mesh.indices[t + 1],
                                                      mesh.indices[t + 2]};
        const glm::vec2 centre =
            (mesh.texture_coordinates[corners[0]] + mesh.texture_coordinates[corners[1]] +
             mesh.texture_coordinates[corners[2]]) /
            3.0F;
        if ((parts >> static_cast<unsigned>(part_at(centre.x, centre.y)) & 1U) == 0) continue;
        const Projected &a = points[corners[0]], &b = points[corners[1]], &c = points[corners[2]];
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0.0) continue;
        const auto first = [&](double least) {
            return std::max(0, static_cast<int>(std::ceil(least - 0.5)));
        };
        const auto last = [&](double most) {
            return std::min(canvas.pixels - 1, static_cast<int>(std::floor(most - 0.5)));
        };
        for (int y = first(std::min({a.y, b.y, c.y})); y <= last(std::max({a.y, b.y, c.y})); ++y)
            for (int x = first(std::min({a.x, b.x, c.x})); x <= last(std::max({a.x, b.x, c.x}));
                 ++x) {
                const double px = x + 0.5, py = y + 0.5;
                const double wa = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
                const double wb = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
                const double wc = 1.0 - wa - wb;
                if (wa < 0.0 || wb < 0.0 || wc < 0.0) continue;
                const auto depth = static_cast<float>(wa * a.depth + wb * b.depth + wc * c.depth);
                auto& pixel = drawing.seen[static_cast<std::size_t>(y) *
                                               static_cast<std::size_t>(canvas.pixels) +
                                           static_cast<std::size_t>(x)];
                if (pixel && pixel->depth >= depth) continue;
                const glm::vec2 place =
                    mesh.texture_coordinates[corners[0]] * static_cast<float>(wa) +
                    mesh.texture_coordinates[corners[1]] * static_cast<float>(wb) +
                    mesh.texture_coordinates[corners[2]] * static_cast<float>(wc);
                if (!is_clear(place)) pixel = Pixel{depth, place};
            }
    }
    return drawing;
}

int symmetric_difference(const Drawing& a, const Drawing& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.seen.size(); ++i)
        if (a.seen[i].has_value() != b.seen[i].has_value()) ++count;
    return count;
}

double outline_length(const Drawing& drawing) {
    const auto covered = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < drawing.pixels && y < drawing.pixels &&
               drawing.at(x, y).has_value();
    };
    double length = 0.0;
    for (int y = -1; y < drawing.pixels; ++y)
        for (int x = -1; x < drawing.pixels; ++x) {
            const bool a = covered(x, y), b = covered(x + 1, y), c = covered(x, y + 1),
                       d = covered(x + 1, y + 1);
            const int count = int{a} + int{b} + int{c} + int{d};
            if (count == 1 || count == 3)
                length += std::sqrt(0.5);
            else if (count == 2)
                length += a == d ? std::sqrt(2.0) : 1.0;
        }
    return length;
}

void MeanColour::add(const RawImages& images, const glm::vec2& place) {
    const auto texel = [&](float coordinate) {
        const int at = static_cast<int>(std::floor(coordinate * static_cast<float>(images.side)));
        return static_cast<std::size_t>(std::clamp(at, 0, images.side - 1));
    };
    const Bytes& rgb = images.rgb[static_cast<std::size_t>(ImageKind::base_color)];
    const std::size_t at =
        3 * (texel(place.y) * static_cast<std::size_t>(images.side) + texel(place.x));
    red_ += linear_light(rgb[at]);
    green_ += linear_light(rgb[at + 1]);
    blue_ += linear_light(rgb[at + 2]);
    ++count_;
}

Lab MeanColour::mean() const {
    const double r = red_ / count_, g = green_ / count_, b = blue_ / count_;
    const auto curve = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    };
    const double x = curve((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
    const double y = curve(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
    const double z = curve((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double difference(const Lab& a, const Lab& b) {
    return std::sqrt((a.l - b.l) * (a.l - b.l) + (a.a - b.a) * (a.a - b.a) +
                     (a.b - b.b) * (a.b - b.b));
}

}  // namespace sporeprint
