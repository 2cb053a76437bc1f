// What every geometry test ends with, and how tests look at a mesh.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "core/mesh/measure.h"

namespace sporeprint {

/// Whether two arrays have the same bits: -0 and 0 differ.
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

/// The mesh cut into its connected pieces, by shared vertices or shared places, in order of first use.
inline std::vector<Mesh> pieces(const Mesh& mesh) {
    std::map<std::array<float, 3>, std::uint32_t> places;
    std::vector<std::uint32_t> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::uint32_t i = 0; i < parent.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        const auto [place, fresh] = places.try_emplace({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}, i);
        if (!fresh) parent[root(i)] = root(place->second);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 1; k < 3; ++k)
            parent[root(mesh.indices[i + k])] = root(mesh.indices[i]);
    std::vector<Mesh> found;
    std::map<std::uint32_t, std::size_t> number;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto [place, fresh] = number.try_emplace(root(mesh.indices[i]), found.size());
        if (fresh) {
            found.emplace_back();
            found.back().positions = mesh.positions;
        }
        for (std::size_t k = 0; k < 3; ++k)
            found[place->second].indices.push_back(mesh.indices[i + k]);
    }
    return found;
}

/// The contract of every mesh: nothing in defects(), and each closed piece faces outwards.
inline void expect_valid(const Mesh& mesh) {
    for (const std::string& defect : defects(mesh)) ADD_FAILURE() << defect;
    double smallest = 1.0;
    for (const Mesh& piece : pieces(mesh)) smallest = std::min(smallest, volume(piece));
    // A wart at the very end of its life is a few micrometres across: its volume rounds to nothing.
    EXPECT_GT(smallest, -1e-13) << "a piece is inside out";
    EXPECT_GT(volume(mesh), 0.0);
}

/// Largest distance between corresponding corners of two boxes.
inline double distance(const Bounds& a, const Bounds& b) {
    return std::max(glm::distance(a.min, b.min), glm::distance(a.max, b.max));
}

inline double diagonal(const Bounds& box) { return glm::distance(box.min, box.max); }

}  // namespace sporeprint
