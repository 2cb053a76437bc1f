// Names of meshes, nodes, materials and files. An engine keeps the parts of all files of a folder
// by name, so equal names mean equal parts. Names have letters of ASCII, digits and '_' only.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/colony/colony_spec.h"
#include "core/individual/mushroom_spec.h"
#include "core/params/shared_params.h"
#include "core/plant/leaf_spec.h"
#include "core/plant/tree_spec.h"
#include "core/plant/wood_image.h"

namespace sporeprint {

/// Returns the identifier of a species as a part of a name: itself if it has the letters of names alone. "~owner.name@3"
/// of a library becomes "owner_name_3_5b0c9a1e", with a hash, since "~owner_name.x" reads the same without its signs.
[[nodiscard]] std::string name_of_species(const std::string& id);

/// Returns a mix as it stands in a URL: no weight for a single species, no trailing zeros:
/// "amanita_muscaria:0.7,boletus_edulis:0.3".
[[nodiscard]] std::string mix_text(const Mix& mix);

/// Returns the name of what a spec describes, the same at every level of detail and however its
/// file is written: the species or the preset, the kind of product unless it is a mushroom, the
/// seed, the age in percent, and a hash if anything else differs from its default:
/// "amanita_muscaria_s7_a60", "maple_leaf_s7_5b0c9a1e".
[[nodiscard]] std::string product_name(const MushroomSpec& spec);
[[nodiscard]] std::string product_name(const ColonySpec& spec);
[[nodiscard]] std::string product_name(const LeafSpec& spec, const Atlas& atlas);
[[nodiscard]] std::string product_name(const TreeSpec& spec, const Atlas& atlas);

/// Returns the name of a level of detail, as engines expect it: "amanita_muscaria_s7_a60_LOD1".
[[nodiscard]] std::string level_name(const std::string& name, int lod);

/// Returns the name of a level of detail of the file of a mushroom. A file of one whole level has
/// that of the level. The levels of all others are numbered from 0, since engines group by number;
/// before it stands what tells them from those of other files: "amanita_muscaria_s7_a60_from1_LOD2"
/// with lods and lod=1, "amanita_muscaria_s7_a60_t15000_LOD0" with triangles=15000.
///
/// index  of the level in the file
[[nodiscard]] std::string level_name(const MushroomSpec& spec, std::size_t index);

/// Returns the name of the file without its ending: that of its first level of detail, and how it
/// is written: "amanita_muscaria_s7_a60_LOD0_msft_meshopt". With a number of triangles, which it states,
/// the first level is not known before the individual: "amanita_muscaria_s7_a60_t15000_LOD0".
[[nodiscard]] std::string file_name(const std::string& name, int lod,
                                    const std::optional<int>& triangles, const FileOptions& file);

/// Returns the name of the material of a mushroom, and of all individuals of a colony. Its images
/// depend on the seed, and its resolution on the level of detail: "amanita_muscaria_s7_a60_skin_LOD1".
[[nodiscard]] std::string skin_name(const MushroomSpec& spec);
[[nodiscard]] std::string skin_name(const ColonySpec& spec);

/// Returns the name of a material whose images are tiles of an atlas, from the species and a hash of
/// all tiles: "amanita_muscaria_atlas_5b0c9a1e".
///
/// mix    of all tiles; empty for an atlas of several
/// tiles  skin_name() of each
[[nodiscard]] std::string atlas_name(const Mix& mix, const std::vector<std::string>& tiles);

/// Returns the name of the material of wood that fungi stand on: "birch_wood_1024_embedded".
[[nodiscard]] std::string wood_name(const WoodPaint& paint, Textures textures);

/// Returns the name of a material that all individuals with the same images share, from the preset
/// and a hash of everything that the images depend on: "broadleaf_bark_5b0c9a1e".
///
/// textures  how the file has its images
[[nodiscard]] std::string bark_name(const std::string& preset, const TreePaint& paint,
                                    Textures textures);
[[nodiscard]] std::string leaf_material_name(const std::string& preset, const LeafPaint& paint,
                                             Textures textures);

}  // namespace sporeprint
