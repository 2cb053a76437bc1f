// The built-in atlas, for tests.
#pragma once

#include <span>
#include <string_view>

#include "core/atlas/atlas.h"

namespace sporeprint {

/// Returns the built-in atlas, read once.
inline const Atlas& atlas() {
    static const auto built_in = built_in_atlas();
    return *built_in;
}

inline std::span<const LeafPreset> leaf_presets() { return atlas().leaves(); }
inline std::span<const TreePreset> tree_presets() { return atlas().trees(); }

/// Returns a leaf of the built-in atlas, or nullptr if there is none.
inline const LeafPreset* leaf_preset(std::string_view id) { return atlas().find_leaf(id); }

/// Returns a tree of the built-in atlas, or nullptr if there is none.
inline const TreePreset* tree_preset(std::string_view id) { return atlas().find_tree(id); }

}  // namespace sporeprint
