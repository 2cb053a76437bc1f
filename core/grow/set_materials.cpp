#include "core/grow/set_materials.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "core/grow/names.h"
#include "core/grow/painting.h"
#include "core/math/elementary.h"
#include "core/surface/codecs.h"

namespace sporeprint {

namespace {

/// Returns a PNG image with a texel for each tile of a grid; tiles beyond the colours are black.
Slice image_of_tiles(TileGrid grid, const std::vector<std::array<std::uint8_t, 3>>& colours) {
    Bytes rgba(4 * grid.size(), 0);
    for (std::size_t tile = 0; tile < grid.size(); ++tile) {
        if (tile < colours.size())
            std::copy(colours[tile].begin(), colours[tile].end(), &rgba[4 * tile]);
        rgba[4 * tile + 3] = 255;
    }
    return Slice(std::make_shared<const Bytes>(png(rgba, grid.columns, grid.rows)));
}

std::uint8_t byte_of(double value) { return static_cast<std::uint8_t>(value * 255.0 + 0.5); }

/// Returns the look with the largest coat and sheen of all.
MaterialLook largest_look(const std::vector<MaterialLook>& looks) {
    MaterialLook largest = looks.front();
    for (const MaterialLook& look : looks) {
        largest.coat = std::max(largest.coat, look.coat);
        for (int c = 0; c < 3; ++c) largest.sheen[c] = std::max(largest.sheen[c], look.sheen[c]);
    }
    return largest;
}

/// Returns what differs between looks, relative to the largest.
TileLooks tile_looks(TileGrid grid, const std::vector<MaterialLook>& looks,
                     const MaterialLook& largest) {
    std::vector<std::array<std::uint8_t, 3>> coats, sheens;
    bool coats_differ = false, sheens_differ = false;
    for (const MaterialLook& look : looks) {
        coats_differ = coats_differ || look.coat != largest.coat;
        sheens_differ = sheens_differ || look.sheen != largest.sheen;
        coats.push_back(
            {largest.coat > 0.0 ? byte_of(look.coat / largest.coat) : std::uint8_t{0}, 0, 0});
        std::array<std::uint8_t, 3>& sheen = sheens.emplace_back();
        for (int c = 0; c < 3; ++c)
            if (largest.sheen[c] > 0.0)
                sheen[static_cast<std::size_t>(c)] =
                    byte_of(linear_to_srgb(look.sheen[c] / largest.sheen[c]));
    }
    TileLooks differing;
    if (coats_differ) differing.coat = image_of_tiles(grid, coats);
    if (sheens_differ) differing.sheen = image_of_tiles(grid, sheens);
    return differing;
}

/// Returns the images of an atlas, cached or painted now.
///
/// painted  the atlas before encoding, if it is painted already
std::shared_ptr<const ImageSet> tiled_images(const std::vector<PaintSpec>& tiles,
                                             std::optional<TiledImages>& painted,
                                             const ExecutionContext& execution,
                                             ImageFormat format) {
    std::string key = "tiles";
    for (const PaintSpec& tile : tiles) (key += '\n') += image_key(tile, format);
    return execution.caches.images(key, [&] {
        if (!painted) {
            painted.emplace(grid_of(tiles.size()), side_of(tiles.front()));
            for (std::size_t i = 0; i < tiles.size(); ++i) {
                throw_if_cancelled(execution);
                painted->place(i, raw_images(tiles[i], execution));
            }
        }
        return std::make_shared<const ImageSet>(painted->encoded(format, execution.parallel));
    });
}

}  // namespace

SetTile SetMaterials::add(const SetIndividual& one, const MaterialLook& look,
                          const std::function<Flesh()>& flesh) {
    const MushroomSpec first = file_spec(spec_, one, 0);
    // Names of skins state what their images depend on.
    std::string name = skin_name(first), shared;
    switch (spec_.params.atlas) {
        case AtlasShare::none:
            shared = name;
            break;
        case AtlasShare::species:
            shared = std::to_string(one.species);
            break;
        case AtlasShare::set:
            break;
    }
    const auto [found, is_new] = material_of_.try_emplace(std::move(shared), materials_.size());
    if (is_new) materials_.push_back({one.species, {}});
    std::vector<Tile>& tiles = materials_[found->second].tiles;
    const auto same = std::find_if(tiles.begin(), tiles.end(),
                                   [&](const Tile& tile) { return tile.name == name; });
    const auto tile = static_cast<std::size_t>(same - tiles.begin());
    if (same == tiles.end()) {
        const bool is_rich = spec_.mushroom.file.materials == MaterialSet::rich;
        tiles.push_back({std::move(name), first, look, is_rich ? flesh() : Flesh{}});
    }
    return {found->second, tile};
}

TileGrid SetMaterials::grid_of(std::size_t material) const {
    return sporeprint::grid_of(materials_[material].tiles.size());
}

void SetMaterials::move_to_tile(Mesh& mesh, const SetTile& place) const {
    const TileGrid grid = grid_of(place.material);
    if (grid == TileGrid{}) return;
    const glm::vec2 sides(grid.columns, grid.rows),
        corner(grid.column_of(place.tile), grid.row_of(place.tile));
    for (glm::vec2& uv : mesh.texture_coordinates) uv = (corner + uv) / sides;
}

std::string SetMaterials::name_of(const Material& material) const {
    if (spec_.params.atlas == AtlasShare::none) return material.tiles.front().name;
    std::vector<std::string> tiles;
    for (const Tile& tile : material.tiles) tiles.push_back(tile.name);
    return atlas_name(
        spec_.params.atlas == AtlasShare::species ? spec_.species[material.species] : Mix{}, tiles);
}

GlbMaterial SetMaterials::atlas_material(const Material& material) const {
    std::vector<MaterialLook> looks;
    std::vector<Flesh> fleshes;
    for (const Tile& tile : material.tiles) {
        looks.push_back(tile.look);
        fleshes.push_back(tile.flesh);
        if (tile.look.glow != looks.front().glow)
            throw Impossible("/atlas",
                             std::string("'") + name(spec_.params.atlas) +
                                 "' is impossible for species that glow differently, such as " +
                                 mix_text(material.tiles.front().painted.mix) + " and " +
                                 mix_text(tile.painted.mix) +
                                 "; ask for ornaments.glow=0, or for atlas=none");
    }
    GlbMaterial out;
    out.name = name_of(material);
    out.look = largest_look(looks);
    out.tile_looks = tile_looks(sporeprint::grid_of(looks.size()), looks, out.look);
    out.transmission = transmission_of(sporeprint::grid_of(looks.size()), fleshes);
    return out;
}

void SetMaterials::add_to(GlbScene& scene, const Atlas& atlas, const ImageLinks& links,
                          const ExecutionContext& execution) {
    const MushroomParams& mushroom = spec_.mushroom;
    for (const Material& material : materials_) {
        throw_if_cancelled(execution);
        scene.materials.push_back(atlas_material(material));
        const MushroomSpec& first = material.tiles.front().painted;
        const ImageUrls urls =
            has_addresses(mushroom.textures) && links ? links(first) : ImageUrls{};
        std::vector<PaintSpec> tiles;
        std::optional<TiledImages> painted;
        images_.push_back(attach_images(
            scene.materials.back(), mushroom.textures, mushroom.file, urls, execution,
            [&](ImageFormat format) {
                if (tiles.empty())
                    for (const Tile& tile : material.tiles)
                        tiles.push_back(paint_spec_of(tile.painted, atlas, execution.caches));
                return tiles.size() == 1 ? painted_images(tiles.front(), execution, format)
                                         : tiled_images(tiles, painted, execution, format);
            }));
    }
}

Value SetMaterials::atlases_value() const {
    Value list = Value::array();
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        const TileGrid grid = grid_of(i);
        list.push(Value::object()
                      .set("material", i)
                      .set("columns", grid.columns)
                      .set("rows", grid.rows)
                      .set("tiles", materials_[i].tiles.size()));
    }
    return list;
}

}  // namespace sporeprint
