// What fungi that grow from a wall stand on: the kinds of wood.
#pragma once

#include <array>

#include "core/model/species.h"

namespace sporeprint {

/// What fungi that grow from a wall stand on: nothing, or wood with the bark of a tree.
enum class Substrate { none, beech, birch, oak, poplar, spruce };
/// All that are wood.
inline constexpr std::array all_woods = {Substrate::beech, Substrate::birch, Substrate::oak,
                                         Substrate::poplar, Substrate::spruce};

constexpr const char* name(Substrate substrate) {
    switch (substrate) {
        case Substrate::none:
            return "none";
        case Substrate::beech:
            return "beech";
        case Substrate::birch:
            return "birch";
        case Substrate::oak:
            return "oak";
        case Substrate::poplar:
            return "poplar";
        case Substrate::spruce:
            return "spruce";
    }
    return nullptr;
}

/// Returns the wood of the tree that the habitat of a species mentions first; beech for those that
/// mention none.
[[nodiscard]] Substrate wood_of(const Facts& facts);

}  // namespace sporeprint
