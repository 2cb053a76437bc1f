// An atlas of a few species, for tests of what draws all species of an atlas.
#pragma once

#include <memory>

#include "core/atlas/atlas.h"
#include "core/params/reader.h"
#include "core/params/value.h"
#include "tests/support/atlas.h"

namespace sporeprint {

/// Returns eight species of the built-in atlas, one of each form that is traced and a coral among them, with all
/// leaves, trees and worlds.
inline std::shared_ptr<const Atlas> small_atlas() {
    static const std::shared_ptr<const Atlas> made = [] {
        AtlasTexts texts;
        for (const char* id : {"amanita_muscaria", "artomyces_pyxidatus", "boletus_edulis",
                               "clavariadelphus_pistillaris", "craterellus_cornucopioides",
                               "hydnum_repandum", "lactarius_deliciosus", "russula_emetica"})
            texts.species.push_back(dump(write(atlas().find(id)->species)));
        for (const LeafPreset& leaf : leaf_presets()) texts.leaves.push_back(dump(write(leaf)));
        for (const TreePreset& tree : tree_presets()) texts.trees.push_back(dump(write(tree)));
        for (const WorldPreset& world : atlas().worlds())
            texts.worlds.push_back(dump(write(world)));
        return std::make_shared<const Atlas>(texts);
    }();
    return made;
}

}  // namespace sporeprint
