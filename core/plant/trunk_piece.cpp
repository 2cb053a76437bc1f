#include "core/plant/trunk_piece.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/tangents.h"
#include "core/plant/bark_image.h"
#include "core/plant/wood_image.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

class TrunkBuilder {
  public:
    TrunkBuilder(const TrunkPieceParams& params, const std::function<TrunkSection(double)>& section)
        : params_(params), sides_(static_cast<std::size_t>(params.sides)) {
        Random random(params.seed, purposes::trunk_ends);
        const double middle = section(0.5 * params.length).radius;
        const double around = wood_girths * 2.0 * pi * middle;
        // Images end at rings: their length is adapted, so that it divides half of itself.
        double step = 0.5 * around;
        while (params.length / step > params.rings) step *= 2.0;
        image_length_ = std::max(around, step);
        const double first = std::ceil(params.start / step - 1e-9) * step - params.start;
        at_.push_back(0.0);
        for (double s = first; s < params.length - 0.3 * step; s += step)
            if (s > 0.3 * step) at_.push_back(s);
        at_.push_back(params.length);
        glm::dvec3 side(0.0);
        std::vector<TrunkSection> sections;
        sections.reserve(at_.size());
        for (const double s : at_) sections.push_back(section(s));
        for (std::size_t ring = 0; ring < at_.size(); ++ring) {
            const TrunkSection& before = sections[ring > 0 ? ring - 1 : 0];
            const TrunkSection& after = sections[std::min(ring + 1, at_.size() - 1)];
            const glm::dvec3 along = unit_or(after.middle - before.middle, {1.0, 0.0, 0.0});
            side = square_to(along, ring == 0 ? glm::dvec3(-along.z, 0.0, along.x) : side);
            const glm::dvec3 up = glm::cross(side, along);
            const double rise = (after.radius - before.radius) /
                                std::max(glm::length(after.middle - before.middle), 1e-6);
            for (std::size_t k = 0; k < sides_; ++k) {
                const SineCosine turn =
                    sine_cosine(2.0 * pi * static_cast<double>(k) / static_cast<double>(sides_));
                const double uneven = 1.0 + 0.05 * random.symmetric();
                const glm::dvec3 out = turn.cosine * side + turn.sine * up;
                places_.push_back(sections[ring].middle + sections[ring].radius * uneven * out);
                normals_.push_back(glm::normalize(out - rise * along));
            }
            alongs_.push_back(along);
            middles_.push_back(sections[ring].middle);
        }
        if (params.foot == TrunkEnd::broken) break_end(0, 1, random);
        if (params.top == TrunkEnd::broken) break_end(at_.size() - 1, at_.size() - 2, random);
        Random hue(params.seed, purposes::trunk_ends, 1);
        for (std::size_t ring = 0; ring < at_.size(); ++ring) greens_.push_back(hue.uniform());
    }

    Mesh mesh() {
        const std::size_t half = sides_ / 2;
        std::size_t from = 0;
        while (from + 1 < at_.size()) {
            const std::size_t to = end_of_image(from);
            add_bark(from, to, 0, half);
            add_bark(from, to, half, sides_);
            from = to;
        }
        add_end(0, false);
        add_end(at_.size() - 1, true);
        add_tangents(mesh_);
        return std::move(mesh_);
    }

  private:
    const TrunkPieceParams& params_;
    std::size_t sides_;
    double image_length_ = 1.0;
    std::vector<double> at_, greens_;
    std::vector<glm::dvec3> places_, normals_, alongs_, middles_;
    Mesh mesh_;

    [[nodiscard]] std::size_t index(std::size_t ring, std::size_t side) const {
        return ring * sides_ + side % sides_;
    }
    [[nodiscard]] double images(double s) const { return (params_.start + s) / image_length_; }

    /// Moves the corners of an end along the trunk, by less than its last ring is long: few splinters are as long as
    /// the trunk was, and rot makes all shorter.
    void break_end(std::size_t ring, std::size_t next, Random& random) {
        const double last_ring = std::abs(at_[ring] - at_[next]);
        const double inwards = next > ring ? 1.0 : -1.0;
        const double radius = glm::distance(places_[index(ring, 0)], middles_[ring]);
        const double reach = std::min(0.7 * last_ring, 2.0 * radius) * (1.0 - 0.7 * params_.lost);
        for (std::size_t k = 0; k < sides_; ++k) {
            const double by = std::sqrt(random.uniform());
            places_[index(ring, k)] += inwards * reach * by * alongs_[ring];
        }
        middles_[ring] += inwards * reach * 0.8 * alongs_[ring];
    }

    /// Returns the last ring of the image that a ring is on: bark is mirrored from there on.
    [[nodiscard]] std::size_t end_of_image(std::size_t from) const {
        const double image = std::floor(images(at_[from]) + 1e-6);
        std::size_t to = from + 1;
        while (to + 1 < at_.size() && images(at_[to]) < image + 1.0 - 1e-6) ++to;
        return to;
    }

    [[nodiscard]] glm::vec3 tint_of(std::size_t ring, const glm::dvec3& normal) const {
        const double lost = params_.lost;
        const glm::dvec3 rotten = glm::mix(glm::dvec3(1.0), glm::dvec3(0.50, 0.43, 0.36), lost);
        const double upper = smooth_step(-0.1, 0.75, normal.y + 0.5 * (greens_[ring] - 0.5));
        return glm::vec3(
            glm::mix(rotten, glm::dvec3(0.34, 0.43, 0.13), 0.85 * params_.moss * upper));
    }

    std::uint32_t add(const glm::dvec3& at, const glm::dvec3& normal, double u, double v,
                      const glm::vec3& tint) {
        mesh_.positions.emplace_back(at);
        mesh_.normals.emplace_back(normal);
        mesh_.texture_coordinates.emplace_back(u, v);
        mesh_.tints.push_back(tint);
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::vec3 &p = mesh_.positions[a], &q = mesh_.positions[b], &r = mesh_.positions[c];
        if (p == q || q == r || r == p) return;
        mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
    }

    void add_bark(std::size_t from, std::size_t to, std::size_t first, std::size_t last) {
        const auto start = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto columns = static_cast<std::uint32_t>(last - first + 1);
        const double image = std::floor(images(at_[from]) + 1e-6);
        const bool mirrored = image - 2.0 * std::floor(0.5 * image) > 0.5;
        for (std::size_t ring = from; ring <= to; ++ring)
            for (std::size_t k = first; k <= last; ++k) {
                const double part = std::clamp(images(at_[ring]) - image, 0.0, 1.0);
                const double v = wood_bark_end * (mirrored ? 1.0 - part : part);
                // Images turn about the axis, so that their spots do not come again on the same side.
                constexpr double turns = 0.16;
                const double u =
                    mirrored_place(2.0 * static_cast<double>(k) / static_cast<double>(sides_) +
                                   turns * images(at_[ring]));
                const glm::dvec3& normal = normals_[index(ring, k)];
                add(places_[index(ring, k)], normal, u, v, tint_of(ring, normal));
            }
        for (std::uint32_t row = 0; row < to - from; ++row)
            for (std::uint32_t k = 0; k + 1 < columns; ++k) {
                const std::uint32_t a = start + row * columns + k, b = a + 1, c = a + columns,
                                    d = c + 1;
                triangle(a, d, b);
                triangle(a, c, d);
            }
    }

    void add_end(std::size_t ring, bool is_top) {
        const auto start = static_cast<std::uint32_t>(mesh_.positions.size());
        const glm::dvec3 out = is_top ? alongs_[ring] : -alongs_[ring];
        const auto dark = static_cast<float>(1.0 - 0.55 * params_.lost);
        const glm::vec3 tint = dark * glm::vec3(1.0F, 0.95F, 0.88F);
        for (std::size_t k = 0; k <= sides_; ++k) {
            const double u = static_cast<double>(k) / static_cast<double>(sides_);
            add(places_[index(ring, k)], out, u, wood_end_rim, tint);
            add(middles_[ring], out, u, wood_end_middle, tint);
        }
        for (std::uint32_t k = 0; k < sides_; ++k) {
            const std::uint32_t a = start + 2 * k, middle = a + 1, b = a + 2;
            if (is_top)
                triangle(middle, b, a);
            else
                triangle(middle, a, b);
        }
    }
};

}  // namespace

Mesh trunk_piece(const TrunkPieceParams& params,
                 const std::function<TrunkSection(double)>& section) {
    if (!(params.length > 0.0)) throw InvalidInput("/length", "a trunk has a positive length");
    if (params.sides < 6 || params.sides % 2 != 0)
        throw InvalidInput("/sides", "a trunk has an even number of sides, at least 6");
    if (params.rings < 4) throw InvalidInput("/rings", "a trunk has at least 4 rings");
    return TrunkBuilder(params, section).mesh();
}

}  // namespace sporeprint
