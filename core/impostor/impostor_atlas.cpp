#include "core/impostor/impostor_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <span>
#include <vector>

#include "core/impostor/fill.h"
#include "core/math/srgb_table.h"
#include "core/problems.h"
#include "core/render/cutout.h"
#include "core/render/draw_list.h"
#include "core/render/texture.h"
#include "core/render/visibility.h"
#include "core/surface/codecs.h"

namespace sporeprint {

namespace {

using render::Draw;
using render::DrawList;
using render::DrawMaterial;
using render::Visibility;

/// Samples of a texel in each direction.
constexpr int samples = 2;
constexpr std::size_t samples_of_texel = static_cast<std::size_t>(samples) * samples;

/// Texels between the farthest vertex and the border of a frame.
constexpr float margin = 1.0F;

glm::vec3 normalised(const glm::vec3& v, const glm::vec3& otherwise) {
    const float squared = glm::dot(v, v);
    return squared > 1e-20F ? v * (1.0F / std::sqrt(squared)) : otherwise;
}

std::uint8_t byte_of(float share) {
    return static_cast<std::uint8_t>(std::clamp(share, 0.0F, 1.0F) * 255.0F + 0.5F);
}

/// The map of a scene into a frame: x to the right and y down, in texels.
struct FrameView {
    FrameAxes axes;
    glm::vec3 centre{0.0F};
    float radius = 1.0F, scale = 1.0F;  ///< texels of a metre
    int side = 0;                       ///< texels

    /// Returns the place of a point, and its depth in metres.
    [[nodiscard]] glm::vec3 place_of(const glm::vec3& point) const {
        const glm::vec3 p = axes.seen(point - centre);
        const float half = 0.5F * static_cast<float>(side);
        return {half + p.x * scale, half - p.y * scale, p.z};
    }
};

/// Returns what is in front at each sample of a frame; nearness is in metres towards the viewer.
Visibility visible(const DrawList& list, const FrameView& view) {
    const int side = view.side * samples;
    Visibility found(side, side);
    std::vector<render::SnappedCorner> corners;
    for (std::size_t d = 0; d < list.draws.size(); ++d) {
        const Draw& draw = list.draws[d];
        corners.resize(draw.mesh->positions.size());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::vec3 at = view.place_of(draw.placement.point(draw.mesh->positions[i]));
            corners[i] = render::snapped({at.x * samples, at.y * samples, at.z});
        }
        const DrawMaterial& material = list.materials[draw.material];
        render::Cutouts cutouts;
        if (!material.alpha.empty())
            cutouts = [&](std::uint32_t first) {
                std::array<glm::vec3, 3> places;
                for (std::size_t i = 0; i < places.size(); ++i) {
                    const glm::vec3& at = draw.mesh->positions[draw.mesh->indices[first + i]];
                    places[i] = glm::vec3(
                        glm::vec2(view.place_of(draw.placement.point(at))) * float{samples}, 1.0F);
                }
                return render::Cutout(*draw.mesh, material, first, places,
                                      {glm::vec2(0.5F), glm::vec2(1.0F)});
            };
        found.show(d, draw.mesh->indices, corners, 0, side, {}, cutouts);
    }
    return found;
}

/// What a sample shows; the colour is linear, the normal in the axes of the frame.
struct Sample {
    glm::vec3 colour{0.0F}, normal{0.0F};
    float roughness = 0.0F;

    void add(const Sample& other) {
        colour += other.colour;
        normal += other.normal;
        roughness += other.roughness;
    }
};

/// A triangle ready to be sampled.
class Facet {
  public:
    Facet(const DrawList& list, const FrameView& view, std::uint32_t draw, std::uint32_t corner)
        : draw_(&list.draws[draw]), material_(&list.materials[draw_->material]), view_(&view) {
        const Mesh& mesh = *draw_->mesh;
        for (std::size_t i = 0; i < 3; ++i) {
            index_[i] = mesh.indices[corner + i];
            at_[i] = glm::vec2(view.place_of(draw_->placement.point(mesh.positions[index_[i]])));
        }
        area_ = area(at_[0], at_[1], at_[2]);
        if (!has_images()) return;
        const auto texture = [&](std::size_t i) { return mesh.texture_coordinates[index_[i]]; };
        const float image = std::abs(area(texture(0), texture(1), texture(2)));
        const auto side = static_cast<float>(material_->base_color.side());
        texels_ = side * std::sqrt(image / std::max(std::abs(area_), 0.01F));
    }

    /// Returns what is at a place of the frame, texels.
    [[nodiscard]] Sample at(const glm::vec2& place) const {
        const glm::vec3 w = weights(place);
        const Mesh& mesh = *draw_->mesh;
        glm::vec3 normal =
            normalised(draw_->placement.of_normals * mixed(mesh.normals, w), view_->axes.toward);
        Sample found{glm::vec3(0.8F), glm::vec3(0.0F), 0.9F};
        if (has_images()) {
            const glm::vec2 uv = mixed(mesh.texture_coordinates, w);
            found.colour = material_->base_color.at(uv, texels_);
            const glm::vec3 orm = material_->orm.at(uv, texels_);
            // No channel is left for occlusion, which holds for about half of the light.
            found.colour *= 0.5F + 0.5F * orm.x;
            found.roughness = orm.y;
            const glm::vec3 bump = material_->normal.at(uv, texels_) * 2.0F - glm::vec3(1.0F);
            const glm::vec4 tangent = mixed(mesh.tangents, w);
            const glm::vec3 along = normalised(draw_->placement.linear * glm::vec3(tangent),
                                               glm::vec3(1.0F, 0.0F, 0.0F));
            const glm::vec3 across = glm::cross(normal, along) * (tangent.w < 0.0F ? -1.0F : 1.0F);
            normal = normalised(along * bump.x + across * bump.y + normal * bump.z, normal);
        }
        found.colour *= draw_->tint;
        if (!mesh.tints.empty()) found.colour *= mixed(mesh.tints, w);
        found.normal = view_->axes.seen(normal);
        return found;
    }

  private:
    const Draw* draw_;
    const DrawMaterial* material_;
    const FrameView* view_;
    std::array<std::uint32_t, 3> index_{};
    std::array<glm::vec2, 3> at_{};
    float area_ = 0.0F, texels_ = 1.0F;

    [[nodiscard]] bool has_images() const {
        return !material_->base_color.empty() && !draw_->mesh->texture_coordinates.empty();
    }

    static float area(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }

    [[nodiscard]] glm::vec3 weights(const glm::vec2& place) const {
        // A sample beside a triangle that is seen edge-on takes its nearest point.
        if (std::abs(area_) < 1e-12F) return glm::vec3(1.0F / 3.0F);
        const glm::vec3 w =
            glm::clamp(glm::vec3(area(place, at_[1], at_[2]), area(place, at_[2], at_[0]),
                                 area(place, at_[0], at_[1])) /
                           area_,
                       glm::vec3(0.0F), glm::vec3(1.0F));
        return w / (w.x + w.y + w.z);
    }

    template <class Vector>
    [[nodiscard]] Vector mixed(const std::vector<Vector>& of, const glm::vec3& w) const {
        return of[index_[0]] * w.x + of[index_[1]] * w.y + of[index_[2]] * w.z;
    }
};

/// Draws frames into an atlas.
class FramePainter {
  public:
    FramePainter(const DrawList& list, const SrgbTable& srgb, ImpostorAtlas& atlas)
        : list_(list), srgb_(srgb), atlas_(atlas) {}

    /// Draws a frame; different ones may be drawn at the same time.
    void draw(FrameCell cell) {
        FrameView view{axes_of(cell), atlas_.centre, atlas_.radius, 0.0F, atlas_.frame_side};
        view.scale = 0.5F * static_cast<float>(view.side) / view.radius;
        const Visibility visibility = visible(list_, view);
        FilledFrame frame(view.side);
        FrameContent content{view.side, view.side, 0, 0};
        for (int y = 0; y < view.side; ++y)
            for (int x = 0; x < view.side; ++x) {
                if (!paint(view, visibility, x, y, frame.texel(x, y))) continue;
                content = {std::min(content.left, x), std::min(content.top, y),
                           std::max(content.right, x + 1), std::max(content.bottom, y + 1)};
            }
        const auto index = static_cast<std::size_t>(cell.row * frame_grid + cell.column);
        add_normals(frame, normals_[index]);
        frame.fill();
        write(frame, cell);
        atlas_.content[index] = content;
    }

    /// Returns ImpostorAtlas::normal_length once all frames are drawn.
    [[nodiscard]] float normal_length() const {
        NormalSum sum;
        for (const NormalSum& one : normals_) {
            sum.length += one.length;
            sum.coverage += one.coverage;
        }
        return sum.coverage > 0.0F ? std::min(sum.length / sum.coverage, 1.0F) : 1.0F;
    }

  private:
    /// Sums over the blocks of a frame, weighted by coverage.
    struct NormalSum {
        float length = 0.0F;  ///< of the mean normal of a block
        float coverage = 0.0F;
    };

    const DrawList& list_;
    const SrgbTable& srgb_;
    ImpostorAtlas& atlas_;
    std::array<NormalSum, frame_count> normals_;

    /// Adds the lengths of the mean normals of blocks of 2 x 2 texels, which lossy images mix.
    static void add_normals(const FilledFrame& frame, NormalSum& sum) {
        for (int y = 0; y + 1 < frame.side(); y += 2)
            for (int x = 0; x + 1 < frame.side(); x += 2) {
                glm::vec3 normal(0.0F);
                for (int k = 0; k < 4; ++k) {
                    const FilledTexel& texel = frame.texel(x + k % 2, y + k / 2);
                    normal += texel.normal * texel.coverage;
                    sum.coverage += texel.coverage;
                }
                sum.length += std::sqrt(glm::dot(normal, normal));
            }
    }

    /// Paints a texel; returns whether it shows something.
    bool paint(const FrameView& view, const Visibility& visibility, int x, int y,
               FilledTexel& texel) const {
        std::array<std::size_t, samples_of_texel> at{};
        std::size_t shown = 0;
        for (int i = 0; i < samples; ++i)
            for (int j = 0; j < samples; ++j) {
                const auto one = static_cast<std::size_t>((y * samples + i) * visibility.width +
                                                          x * samples + j);
                if (visibility.shows(one)) at[shown++] = one;
            }
        if (shown == 0) return false;
        Sample sum;
        float depth = 0.0F;
        // The samples of one triangle are next to each other; it is sampled once, at their middle.
        for (std::size_t first = 0, last = 0; first < shown; first = last) {
            glm::vec2 middle(0.0F);
            for (last = first; last < shown && visibility.same(at[last], at[first]); ++last) {
                const auto side = static_cast<std::size_t>(visibility.width);
                const std::size_t row = at[last] / side, column = at[last] % side;
                middle +=
                    glm::vec2(static_cast<float>(column) + 0.5F, static_cast<float>(row) + 0.5F);
                depth += visibility.nearness[at[last]];
            }
            const auto count = static_cast<float>(last - first);
            const Facet facet(list_, view, visibility.draw[at[first]],
                              visibility.corner[at[first]]);
            Sample one = facet.at(middle * (1.0F / (count * static_cast<float>(samples))));
            one.colour *= count;
            one.normal *= count;
            one.roughness *= count;
            sum.add(one);
        }
        const float share = 1.0F / static_cast<float>(shown);
        glm::vec3 normal = sum.normal * share;
        // Normal maps, and means over an edge, may face away from the viewer.
        normal.z = std::max(normal.z, 0.05F * std::sqrt(glm::dot(normal, normal)));
        texel.colour = sum.colour * share;
        texel.normal = normal;
        texel.roughness = sum.roughness * share;
        texel.depth = 0.5F + 0.5F * depth * share / view.radius;
        texel.coverage = static_cast<float>(shown) / static_cast<float>(samples_of_texel);
        return true;
    }

    /// Returns the mean roughness of the square of 8 x 8 texels around one.
    static float roughness_around(const FilledFrame& frame, int x, int y) {
        constexpr int block = 8;
        float sum = 0.0F, weight = 0.0F;
        for (int i = y / block * block; i < y / block * block + block; ++i)
            for (int j = x / block * block; j < x / block * block + block; ++j) {
                // Texels that show nothing count where all do.
                const float own = frame.texel(j, i).coverage + 1e-4F;
                sum += own * frame.texel(j, i).roughness;
                weight += own;
            }
        return sum / weight;
    }

    void write(const FilledFrame& frame, FrameCell cell) {
        const auto side = static_cast<std::size_t>(atlas_.side());
        for (int y = 0; y < frame.side(); ++y) {
            const std::size_t first = static_cast<std::size_t>(cell.row * frame.side() + y) * side +
                                      static_cast<std::size_t>(cell.column * frame.side());
            for (int x = 0; x < frame.side(); ++x) {
                const FilledTexel& texel = frame.texel(x, y);
                const std::size_t at = first + static_cast<std::size_t>(x);
                const glm::vec3 normal =
                    normalised(texel.normal, glm::vec3(0.0F, 0.0F, 1.0F)) * 0.5F + 0.5F;
                for (int c = 0; c < 3; ++c) {
                    const auto channel = static_cast<std::size_t>(c);
                    atlas_.base_color[4 * at + channel] = srgb_.of(texel.colour[c]);
                    atlas_.normal[3 * at + channel] = byte_of(normal[c]);
                }
                atlas_.base_color[4 * at + 3] = byte_of(texel.coverage);
                atlas_.orm[3 * at] = atlas_.orm[3 * at + 2] = byte_of(texel.depth);
                atlas_.orm[3 * at + 1] = byte_of(roughness_around(frame, x, y));
            }
        }
    }
};

/// Continues the last texels of frames to the right and below, without coverage.
void continue_frames(ImpostorAtlas& atlas) {
    const auto used = static_cast<std::size_t>(frame_grid * atlas.frame_side),
               side = static_cast<std::size_t>(atlas.side());
    const auto copy = [&](std::size_t from, std::size_t to) {
        for (std::size_t c = 0; c < 3; ++c) {
            atlas.base_color[4 * to + c] = atlas.base_color[4 * from + c];
            atlas.normal[3 * to + c] = atlas.normal[3 * from + c];
            atlas.orm[3 * to + c] = atlas.orm[3 * from + c];
        }
    };
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = y < used ? used : 0; x < side; ++x)
            copy(y < used ? y * side + used - 1 : (used - 1) * side + x, y * side + x);
}

/// Returns the largest distance of a vertex from a point.
float reach_of(const DrawList& list, const glm::vec3& centre) {
    float squared = 0.0F;
    for (const Draw& draw : list.draws)
        for (const glm::vec3& position : draw.mesh->positions) {
            const glm::vec3 from = draw.placement.point(position) - centre;
            squared = std::max(squared, glm::dot(from, from));
        }
    return std::sqrt(squared);
}

}  // namespace

ImpostorAtlas impostor_atlas(const GlbScene& scene, int frame_side, const Parallel& parallel) {
    if (frame_side < least_frame_side || frame_side > largest_frame_side || frame_side % 8 != 0)
        throw GenerationError("the side of a frame is a multiple of 8 between 32 and 512 texels");
    const DrawList list = render::draw_list(scene, parallel);
    ImpostorAtlas atlas;
    atlas.frame_side = frame_side;
    atlas.box = list.box;
    atlas.centre = 0.5F * (list.box.min + list.box.max);
    const auto texels = static_cast<float>(frame_side);
    atlas.radius =
        std::max(reach_of(list, atlas.centre), 1e-6F) * texels / (texels - 2.0F * margin);
    const auto side = static_cast<std::size_t>(atlas.side());
    atlas.base_color.resize(4 * side * side);
    atlas.normal.resize(3 * side * side);
    atlas.orm.resize(3 * side * side);
    const SrgbTable& srgb = srgb_table();
    FramePainter painter(list, srgb, atlas);
    std::vector<std::function<void()>> tasks;
    for (int row = 0; row < frame_grid; ++row)
        for (int column = 0; column < frame_grid; ++column)
            tasks.emplace_back([&painter, row, column] { painter.draw({column, row}); });
    parallel(tasks);
    atlas.normal_length = painter.normal_length();
    continue_frames(atlas);
    return atlas;
}

double cutoff_of(const Bytes& rgba, int side) {
    constexpr int copies = 3;
    constexpr std::size_t least = 64, most = 128;  // of 255
    std::vector<std::uint32_t> alpha(static_cast<std::size_t>(side) *
                                     static_cast<std::size_t>(side));
    std::uint64_t covered = 0;  // in 255ths of a texel
    for (std::size_t i = 0; i < alpha.size(); ++i) covered += alpha[i] = rgba[4 * i + 3];
    if (covered == 0) return 0.5;
    // Sum over all copies of how far the area that each cutoff leaves is from the true one.
    std::vector<std::uint64_t> errors(most + 1, 0);
    int width = side;
    for (int copy = 1; copy <= copies && width % 2 == 0; ++copy) {
        const auto row = static_cast<std::size_t>(width), half = row / 2;
        std::vector<std::uint32_t> halved(half * half);
        for (std::size_t y = 0; y < half; ++y)
            for (std::size_t x = 0; x < half; ++x) {
                const std::size_t at = 2 * y * row + 2 * x;
                halved[y * half + x] =
                    (alpha[at] + alpha[at + 1] + alpha[at + row] + alpha[at + row + 1] + 2) / 4;
            }
        alpha = std::move(halved);
        width /= 2;
        std::array<std::uint64_t, 256> count{};
        for (const std::uint32_t value : alpha) ++count[value];
        const std::uint64_t area_of_texel = std::uint64_t{255} << (2 * copy);
        std::uint64_t above = 0;
        for (std::size_t value = 256; value-- > least;) {
            above += count[value];
            if (value > most) continue;
            const std::uint64_t area = above * area_of_texel;
            errors[value] += area > covered ? area - covered : covered - area;
        }
    }
    std::size_t best = most;
    for (std::size_t value = most; value >= least; --value)
        if (errors[value] < errors[best]) best = value;
    return static_cast<double>(best) / 256.0;
}

ImageSet encoded(const ImpostorAtlas& atlas, ImageFormat format, const Parallel& parallel) {
    const int side = atlas.side();
    ImageSet set;
    set.format = format;
    set.has_alpha = true;
    const bool is_webp = format == ImageFormat::webp;
    const auto keep = [&](ImageKind kind, Bytes file) {
        set.files[static_cast<std::size_t>(kind)] =
            Slice(std::make_shared<const Bytes>(std::move(file)));
    };
    const std::array<std::function<void()>, 3> tasks = {
        [&] {
            keep(ImageKind::base_color, is_webp ? webp_with_alpha(atlas.base_color, side, side, 50)
                                                : png(atlas.base_color, side, side));
        },
        [&] {
            keep(ImageKind::normal, is_webp ? webp(atlas.normal, side, side, 55)
                                            : jpeg(atlas.normal, side, side, 88, Chroma::full));
        },
        [&] {
            keep(ImageKind::orm, is_webp ? webp(atlas.orm, side, side, 55)
                                         : jpeg(atlas.orm, side, side, 88, Chroma::full));
        }};
    parallel(tasks);
    return set;
}

}  // namespace sporeprint
