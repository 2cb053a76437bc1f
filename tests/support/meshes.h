// Checks and comparisons of meshes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/mesh/measure.h"

namespace sporeprint {

/// Returns true if two arrays have the same bits; -0 and 0 differ.
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool same_bits(const Mesh& a, const Mesh& b) {
    return same_bits(a.positions, b.positions) && same_bits(a.normals, b.normals) &&
           same_bits(a.tangents, b.tangents) &&
           same_bits(a.texture_coordinates, b.texture_coordinates) &&
           same_bits(a.indices, b.indices);
}

template <class T>
bool same_bits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Returns the connected components of a mesh, by shared vertices or equal positions, in order of
/// first use; each has its own vertices only.
///
/// cost  O(n)
inline std::vector<Mesh> pieces(const Mesh& mesh) {
    constexpr auto unused = static_cast<std::uint32_t>(-1);
    const auto same_place = [](const glm::vec3& a, const glm::vec3& b) { return a == b; };
    const auto hash = [](const glm::vec3& p) {
        std::size_t sum = 0;
        for (const float x : {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}) {  // -0 equals 0
            std::uint32_t bits = 0;
            std::memcpy(&bits, &x, sizeof bits);
            sum = (sum ^ bits) * 0x9e3779b97f4a7c15u;
            sum ^= sum >> 29;
        }
        return sum;
    };
    std::unordered_map<glm::vec3, std::uint32_t, decltype(hash), decltype(same_place)> places(
        mesh.positions.size(), hash, same_place);
    std::vector<std::uint32_t> parent(mesh.positions.size(), unused);
    for (const std::uint32_t i : mesh.indices)
        if (parent[i] == unused) parent[i] = places.try_emplace(mesh.positions[i], i).first->second;
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 1; k < 3; ++k)
            parent[root(mesh.indices[i + k])] = root(mesh.indices[i]);
    std::vector<Mesh> found;
    std::vector<std::uint32_t> number(mesh.positions.size(), unused),
        vertex(mesh.positions.size(), unused);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint32_t from = mesh.indices[i], group = root(from);
        if (number[group] == unused) {
            number[group] = static_cast<std::uint32_t>(found.size());
            found.emplace_back();
        }
        Mesh& piece = found[number[group]];
        if (vertex[from] == unused) {
            vertex[from] = static_cast<std::uint32_t>(piece.positions.size());
            piece.positions.push_back(mesh.positions[from]);
            if (mesh.normals.size() == mesh.positions.size())
                piece.normals.push_back(mesh.normals[from]);
            if (mesh.texture_coordinates.size() == mesh.positions.size())
                piece.texture_coordinates.push_back(mesh.texture_coordinates[from]);
        }
        piece.indices.push_back(vertex[from]);
    }
    return found;
}

/// Expects a valid mesh: no defects(), and all closed components face outwards.
inline void expect_valid(const Mesh& mesh) {
    for (const std::string& defect : defects(mesh)) ADD_FAILURE() << defect;
    double smallest = 1.0;
    for (const Mesh& piece : pieces(mesh)) smallest = std::min(smallest, volume(piece));
    // A vanishing wart is a few micrometres wide, and its volume rounds to 0.
    EXPECT_GT(smallest, -1e-13) << "a component is inside out";
    // The flat leaves of distant trees have area and no volume.
    EXPECT_GT(area(mesh), 0.0);
}

/// Returns the largest distance between corresponding corners of two boxes.
inline double distance(const Bounds& a, const Bounds& b) {
    return std::max(glm::distance(a.min, b.min), glm::distance(a.max, b.max));
}

inline double diagonal(const Bounds& box) { return glm::distance(box.min, box.max); }

}  // namespace sporeprint
