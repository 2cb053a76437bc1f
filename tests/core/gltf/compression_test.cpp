#include "core/gltf/compression.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/gltf/glb.h"
#include "core/grow/colony.h"
#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "core/mesh/index_order.h"
#include "core/params/value.h"
#include "tests/support/atlas.h"
#include "tests/support/glb_parts.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::gltf_compression_test {
namespace {

/// A GLB whose buffer views are decompressed.
class Decoded {
  public:
    explicit Decoded(const Body& body) {
        for (const Slice& slice : body)
            file_.insert(file_.end(), slice.data(), slice.data() + slice.size);
        const std::size_t json_size = word(12);
        std::vector<Problem> problems;
        json = parse({reinterpret_cast<const char*>(file_.data()) + 20, json_size}, problems);
        EXPECT_TRUE(problems.empty());
        binary_ = 20 + json_size + 8;
    }

    [[nodiscard]] const Value& at(const std::string& pointer) const {
        const Value* found = json.at_pointer(pointer);
        EXPECT_TRUE(found) << pointer;
        return *found;
    }
    [[nodiscard]] std::size_t number(const std::string& pointer) const {
        return static_cast<std::size_t>(at(pointer).as_number());
    }

    /// Returns the bytes of a buffer view, decompressed by meshoptimizer.
    [[nodiscard]] Bytes view(std::size_t index) const {
        const std::string path = "/bufferViews/" + std::to_string(index);
        Bytes out(number(path + "/byteLength"));
        const std::string extension = path + "/extensions/EXT_meshopt_compression";
        if (!json.at_pointer(extension)) {
            EXPECT_EQ(number(path + "/buffer"), 0u);
            std::memcpy(out.data(), data(number(path + "/byteOffset")), out.size());
            return out;
        }
        EXPECT_EQ(number(path + "/buffer"), 1u);
        const std::uint8_t* const from = data(number(extension + "/byteOffset"));
        const std::size_t count = number(extension + "/count"),
                          stride = number(extension + "/byteStride"),
                          length = number(extension + "/byteLength");
        EXPECT_EQ(out.size(), count * stride);
        if (at(extension + "/mode").as_string() == "TRIANGLES") {
            EXPECT_EQ(from[0], 0xe1) << "the extension requires version 1";
            EXPECT_EQ(meshopt_decodeIndexBuffer(out.data(), count, stride, from, length), 0);
        } else {
            EXPECT_EQ(from[0], 0xa0) << "the extension requires version 0";
            EXPECT_EQ(meshopt_decodeVertexBuffer(out.data(), count, stride, from, length), 0);
            const Value* const filter = json.at_pointer(extension + "/filter");
            const std::string name(filter ? filter->as_string() : "NONE");
            if (name == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), count, stride);
            if (name == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), count, stride);
        }
        return out;
    }

    /// Returns the vectors of an accessor of three floats or i16, normalised or not.
    [[nodiscard]] std::vector<glm::vec3> vectors(std::size_t accessor) const {
        const std::string path = "/accessors/" + std::to_string(accessor);
        const std::size_t count = number(path + "/count");
        const Bytes bytes = view(number(path + "/bufferView"));
        const std::size_t stride = bytes.size() / count;
        std::vector<glm::vec3> out(count);
        for (std::size_t i = 0; i < count; ++i)
            if (number(path + "/componentType") == 5126) {
                std::memcpy(&out[i], bytes.data() + i * stride, 12);
            } else {
                Quantized16 item;
                std::memcpy(item.data(), bytes.data() + i * stride, 8);
                EXPECT_EQ(item[3], 0);
                const float unit = json.at_pointer(path + "/normalized") ? 32767.0F : 1.0F;
                out[i] = glm::vec3(item[0], item[1], item[2]) / unit;
            }
        return out;
    }

    /// Returns the quaternions of an accessor of four floats.
    [[nodiscard]] std::vector<glm::vec4> rotations(std::size_t accessor) const {
        const std::string path = "/accessors/" + std::to_string(accessor);
        const std::size_t count = number(path + "/count");
        EXPECT_EQ(number(path + "/componentType"), 5126u);
        const Bytes bytes = view(number(path + "/bufferView"));
        std::vector<glm::vec4> out(count);
        EXPECT_EQ(bytes.size(), 16 * count);
        std::memcpy(out.data(), bytes.data(), 16 * count);
        return out;
    }

    [[nodiscard]] std::vector<std::uint32_t> indices(std::size_t accessor) const {
        const std::string path = "/accessors/" + std::to_string(accessor);
        const Bytes bytes = view(number(path + "/bufferView"));
        const std::size_t count = number(path + "/count"), size = bytes.size() / count;
        std::vector<std::uint32_t> out(count, 0);
        for (std::size_t i = 0; i < count; ++i) std::memcpy(&out[i], bytes.data() + i * size, size);
        return out;
    }

    Value json;

  private:
    [[nodiscard]] std::size_t word(std::size_t at) const {
        std::uint32_t value = 0;
        std::memcpy(&value, file_.data() + at, 4);
        return value;
    }
    [[nodiscard]] const std::uint8_t* data(std::size_t offset) const {
        return file_.data() + binary_ + offset;
    }

    std::vector<std::uint8_t> file_;
    std::size_t binary_ = 0;
};

double largest_difference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b,
                          float scale) {
    EXPECT_EQ(a.size(), b.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(largest, static_cast<double>(glm::length(a[i] - scale * b[i])));
    return largest;
}

/// Returns triangles beginning with their smallest index, in their order.
std::vector<std::uint32_t> rotated(std::vector<std::uint32_t> indices) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const auto first = indices.begin() + static_cast<std::ptrdiff_t>(i);
        std::rotate(first, std::min_element(first, first + 3), first + 3);
    }
    return indices;
}

RC_GTEST_PROP(Compression, VectorsAreWithinHalfAStep, ()) {
    const auto numbers = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::array<int, 3>>>(
        rc::gen::container<std::array<int, 3>>(rc::gen::inRange(-30'000, 30'001))));
    std::vector<glm::vec3> values;
    for (const auto& one : numbers) values.push_back(0.0001F * glm::vec3(one[0], one[1], one[2]));
    const float step = largest_coordinate(values, 1e-6F) / static_cast<float>(most_quantized);
    const std::vector<Quantized16> items = quantized(values, step);
    for (std::size_t i = 0; i < values.size(); ++i)
        for (int k = 0; k < 3; ++k)
            RC_ASSERT(std::abs(static_cast<float>(items[i][static_cast<std::size_t>(k)]) * step -
                               values[i][k]) <= 0.501F * step);
}

TEST(Compression, TangentsKeepTheirDirectionAndHandedness) {
    for (const float w : {1.0F, -1.0F})
        for (int i = 0; i < 360; ++i) {
            const float angle = static_cast<float>(i) * 0.0174533F;
            const glm::vec4 tangent(std::cos(angle), 0.0F, std::sin(angle), w);
            const Quantized8 item = quantized_tangents(std::vector{tangent})[0];
            const glm::vec3 back(item[0] / 127.0F, item[1] / 127.0F, item[2] / 127.0F);
            EXPECT_GT(glm::dot(glm::normalize(back), glm::vec3(tangent)), 0.99996F);
            EXPECT_EQ(item[3], w > 0.0F ? 127 : -127);
        }
}

/// Returns the mesh in the order in which it is compressed.
Mesh in_file_order(const Mesh& mesh) {
    Mesh out = mesh;
    const std::size_t n = mesh.positions.size();
    out.indices = triangles_by_last_vertex(mesh.indices, n);
    const std::vector<std::uint32_t> order = renumbered_by_first_use(out.indices, n).order;
    std::vector<std::uint32_t> place(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        place[order[i]] = i;
        out.positions[i] = mesh.positions[order[i]];
        out.normals[i] = mesh.normals[order[i]];
    }
    for (std::uint32_t& index : out.indices) index = place[index];
    return out;
}

TEST(Compression, EveryStorageIsTheSameMesh) {
    for (const std::string& id : species_ids()) {
        const Mesh built = mesh_of(textured(order_of(id, 0.6, 1, 1)));
        GlbParts parts;
        parts.name = id;
        parts.image_urls = {"a.jpg", "b.jpg", "c.jpg"};
        const std::size_t plain = size_of(glb(built, parts));
        for (const GlbGeometry storage : {GlbGeometry::quantized, GlbGeometry::compressed}) {
            parts.geometry = storage;
            const Body body = glb(built, parts);
            const Mesh mesh = storage == GlbGeometry::compressed ? in_file_order(built) : built;
            EXPECT_LT(size_of(body),
                      1500 + plain * (storage == GlbGeometry::quantized ? 65 : 40) / 100)
                << id;
            const Decoded file(body);
            const std::string primitive = "/meshes/0/primitives/0/";
            const auto scale = static_cast<float>(file.at("/nodes/0/scale/0").as_number());
            EXPECT_EQ(scale, largest_coordinate(mesh.positions) / most_quantized);
            EXPECT_FALSE(file.json.at_pointer("/nodes/0/translation")) << "the pivot stays";
            const auto accessor = [&](const std::string& name) {
                return file.number(primitive + name);
            };
            EXPECT_LE(largest_difference(mesh.positions,
                                         file.vectors(accessor("attributes/POSITION")), scale),
                      0.9 * static_cast<double>(scale))
                << id;
            EXPECT_LE(
                largest_difference(mesh.normals, file.vectors(accessor("attributes/NORMAL")), 1.0F),
                storage == GlbGeometry::quantized ? 0.00005 : 0.005);
            EXPECT_EQ(rotated(file.indices(accessor("indices"))), rotated(mesh.indices)) << id;
            EXPECT_EQ(file.at("/extensionsRequired").items().size(),
                      storage == GlbGeometry::quantized ? 1u : 2u);
        }
    }
}

TEST(Compression, StreamsAreTheSameInWhateverOrderTheyAreMade) {
    const Parallel backwards = [](std::span<const std::function<void()>> tasks) {
        for (std::size_t i = tasks.size(); i-- > 0;) tasks[i]();
    };
    for (const Animation animation : {Animation::none, Animation::growth})
        for (const Compression compress : {Compression::quantize, Compression::meshopt}) {
            MushroomSpec spec = order_of("amanita_muscaria", 0.6, 2, 1);
            spec.params.animation = animation;
            if (animation != Animation::none) spec.params.frames = 3;
            spec.params.file.compress = compress;
            spec.params.file.lods = animation == Animation::none ? Lods::nodes : Lods::single;
            Extras extras;
            bool is_written = false;
            extras.write = [&](const GlbScene& scene, const Parallel&) -> Body {
                EXPECT_TRUE(joined(glb(scene, backwards)) == joined(glb(scene)));
                is_written = true;
                return {};
            };
            (void)grow_mushroom(spec, atlas(), extras);
            EXPECT_TRUE(is_written);
        }
}

TEST(Compression, GrowthClipsMoveAsFar) {
    MushroomSpec spec = order_of("amanita_muscaria", 0.6, 2, 1);
    spec.params.animation = Animation::growth;
    spec.params.frames = 3;
    const Decoded plain(grow_mushroom(spec, atlas()).glb);
    for (const Compression compress : {Compression::quantize, Compression::meshopt}) {
        spec.params.file.compress = compress;
        const Decoded file(grow_mushroom(spec, atlas()).glb);
        const auto scale = static_cast<float>(file.at("/nodes/0/scale/0").as_number());
        for (int frame = 0; frame < 3; ++frame) {
            const std::string target =
                "/meshes/0/primitives/0/targets/" + std::to_string(frame) + '/';
            EXPECT_LE(largest_difference(plain.vectors(plain.number(target + "POSITION")),
                                         file.vectors(file.number(target + "POSITION")), scale),
                      0.00005);
            EXPECT_EQ(plain.vectors(plain.number(target + "NORMAL")),
                      file.vectors(file.number(target + "NORMAL")));
        }
    }
}

// The meshes of a colony have a scale each; nodes and instances are scaled by it.
TEST(Compression, InstancesAndNodesKeepTheirSizes) {
    for (const Instancing instancing : {Instancing::nodes, Instancing::gpu}) {
        ColonySpec spec;
        spec.mix = {{"hypholoma_fasciculare", 1000}};
        spec.params.count = 6;
        spec.params.distinct = 2;
        spec.params.lod = 2;
        spec.params.textures = Textures::none;
        spec.params.instancing = instancing;
        const Decoded plain(grow_colony(spec, atlas()).glb);
        spec.params.file.compress = Compression::meshopt;
        const Decoded file(grow_colony(spec, atlas()).glb);
        ASSERT_EQ(plain.at("/nodes").items().size(), file.at("/nodes").items().size());
        for (std::size_t i = 0; i < plain.at("/nodes").items().size(); ++i) {
            const std::string node = "/nodes/" + std::to_string(i);
            const std::string mesh = "/meshes/" + std::to_string(file.number(node + "/mesh"));
            const auto largest = [&](const Decoded& of) {
                return largest_coordinate(
                    of.vectors(of.number(mesh + "/primitives/0/attributes/POSITION")));
            };
            const auto factor = [&](const Decoded& of) {
                const std::string extension = node + "/extensions/EXT_mesh_gpu_instancing";
                const Value* scale = of.json.at_pointer(node + "/scale/0");
                const float of_node = scale ? static_cast<float>(scale->as_number()) : 1.0F;
                if (of.json.at_pointer(extension))
                    return of_node *
                           of.vectors(of.number(extension + "/attributes/SCALE")).front().x;
                return of_node;
            };
            const float expected = largest(plain) * factor(plain);
            EXPECT_NEAR(largest(file) * factor(file), expected,
                        (instancing == Instancing::gpu ? 1e-3F : 1e-4F) * expected);
        }
    }
}

TEST(Compression, BothPartsOfATreeHaveOneScale) {
    TreeSpec spec{"shrub", params_of(*atlas().find_tree("shrub"))};
    spec.params.lod = 2;
    spec.params.textures = Textures::none;
    const TreeMeshes meshes = tree_meshes(spec, atlas());
    spec.params.file.compress = Compression::meshopt;
    const Decoded file(grow_tree(spec, atlas()).glb);
    const auto scale = static_cast<float>(file.at("/nodes/0/scale/0").as_number());
    const std::array<const Mesh*, 2> parts = {&meshes.bark, &meshes.leaves};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Mesh part = in_file_order(*parts[i]);
        const std::string primitive = "/meshes/0/primitives/" + std::to_string(i) + '/';
        EXPECT_LE(
            largest_difference(part.positions,
                               file.vectors(file.number(primitive + "attributes/POSITION")), scale),
            0.9 * static_cast<double>(scale));
        EXPECT_EQ(rotated(file.indices(file.number(primitive + "indices"))), rotated(part.indices))
            << i;
    }
}

RC_GTEST_PROP(Compression, RenumberedTrianglesUseEachVertexInTurn, ()) {
    const auto vertices = *rc::gen::inRange<std::size_t>(1, 60);
    const auto indices = *rc::gen::container<std::vector<std::uint32_t>>(
        rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(vertices)));
    const auto [order, numbered] = renumbered_by_first_use(indices, vertices);
    RC_ASSERT(numbered.size() == indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) RC_ASSERT(order.at(numbered[i]) == indices[i]);
    std::vector<std::uint32_t> place(vertices, 1000);
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    RC_ASSERT(order.size() == vertices);
    RC_ASSERT(std::find(place.begin(), place.end(), 1000U) == place.end());
    std::uint32_t next = 0;
    for (const std::uint32_t index : indices) {
        RC_ASSERT(place[index] <= next);
        next = std::max(next, place[index] + 1);
    }
    for (std::uint32_t i = next; i + 1 < vertices; ++i) RC_ASSERT(order[i] < order[i + 1]);
}

// Leaves of a tree, each with a size and a breadth of its own.
TEST(Compression, InstancesStandAndTurnAsTheyDid) {
    TreeSpec spec{"shrub", params_of(*atlas().find_tree("shrub"))};
    spec.params.lod = 2;
    spec.params.textures = Textures::none;
    spec.params.instancing = LeafInstancing::gpu;
    const std::string places = "/nodes/1/extensions/EXT_mesh_gpu_instancing/attributes/";
    const Decoded plain(grow_tree(spec, atlas()).glb);
    for (const Compression compress : {Compression::quantize, Compression::meshopt}) {
        SCOPED_TRACE(name(compress));
        spec.params.file.compress = compress;
        const Decoded file(grow_tree(spec, atlas()).glb);
        const auto vectors = [&](const Decoded& of, const char* attribute) {
            return of.vectors(of.number(places + attribute));
        };
        const std::vector<glm::vec3> translations = vectors(plain, "TRANSLATION"),
                                     scales = vectors(plain, "SCALE");
        EXPECT_GT(translations.size(), 500u);
        // The one leaf is quantised, and the node is scaled by the step.
        const auto step = static_cast<float>(file.at("/nodes/1/scale/0").as_number());
        EXPECT_LE(largest_difference(translations, vectors(file, "TRANSLATION"), step),
                  static_cast<double>(largest_coordinate(translations)) / 8192.0);
        EXPECT_LE(largest_difference(scales, vectors(file, "SCALE"), 1.0F),
                  static_cast<double>(largest_coordinate(scales)) / 512.0);
        const auto rotations = [&](const Decoded& of) {
            return of.rotations(of.number(places + "ROTATION"));
        };
        const std::vector<glm::vec4> turns = rotations(plain), turned = rotations(file);
        ASSERT_EQ(turns.size(), turned.size());
        for (std::size_t i = 0; i < turns.size(); ++i)
            EXPECT_GT(std::abs(glm::dot(turns[i], glm::normalize(turned[i]))), 0.9999995F);
    }
}

}  // namespace
}  // namespace sporeprint::gltf_compression_test
