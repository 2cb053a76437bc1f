#include "core/grow/nearest_species.h"

#include <algorithm>
#include <functional>

#include "core/grow/mushroom.h"

namespace sporeprint {

namespace {

/// Side of the pictures, pixels: two rows for each height of a likeness.
constexpr int side = 80;

/// Returns the likeness of a mushroom without variation and without ground.
trace::Likeness likeness_at(const std::string& id, double age, const Atlas& atlas) {
    MushroomSpec spec;
    spec.mix.push_back({id});
    spec.params.age = age;
    spec.params.variation = 0.0;
    spec.params.lod = 2;
    spec.params.base = Base::clean;
    spec.params.substrate = Substrate::none;
    spec.params.texture_size = TextureSize{128};
    PictureParams params;
    params.view = View::front;
    params.width = params.height = side;
    const RgbaImage image = cut_out_picture(spec, atlas, params);
    Picture picture{side, side, Bytes(3 * static_cast<std::size_t>(side) * side)};
    trace::Mask mask(side, side);
    for (std::size_t i = 0; i < mask.inside.size(); ++i) {
        mask.inside[i] = image.rgba[4 * i + 3] >= 128 ? 1 : 0;
        for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * i + c] = image.rgba[4 * i + c];
    }
    return trace::likeness_of(picture, mask);
}

}  // namespace

RgbaImage cut_out_picture(const MushroomSpec& spec, const Atlas& atlas,
                          const PictureParams& params) {
    RgbaImage image;
    Extras extras;
    extras.write = [&](const GlbScene& scene, const Parallel&) -> Body {
        GlbScene alone = scene;
        alone.stands_on_ground = false;
        image = rendered(alone, params);
        return {};
    };
    static_cast<void>(grow_mushroom(spec, atlas, extras));
    return image;
}

NearSpecies near_species(const trace::Likeness& likeness, const std::string& id,
                         const Atlas& atlas) {
    NearSpecies near{id, 0.0, {}};
    bool is_first = true;
    for (const Stage& stage : atlas.find(id)->species.stages) {
        const trace::Unlikeness apart =
            trace::unlikeness(likeness, likeness_at(id, stage.age, atlas));
        if (!is_first && apart.total() >= near.apart.total()) continue;
        near.age = stage.age;
        near.apart = apart;
        is_first = false;
    }
    return near;
}

NearestSpecies::NearestSpecies(const Atlas& atlas, const Parallel& parallel) {
    std::vector<std::vector<Drawn>> of_species(atlas.entries().size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < of_species.size(); ++i)
        tasks.emplace_back([&, i] {
            const Species& species = atlas.entries()[i].species;
            const std::string id = species.id.string();
            for (const Stage& stage : species.stages)
                of_species[i].push_back({id, stage.age, likeness_at(id, stage.age, atlas)});
        });
    parallel(tasks);
    for (const std::vector<Drawn>& stages : of_species)
        drawn_.insert(drawn_.end(), stages.begin(), stages.end());
}

const NearestSpecies& LazyNearestSpecies::get(const Atlas& atlas, const Parallel& parallel) {
    std::call_once(once_, [&] { made_.emplace(atlas, parallel); });
    return *made_;
}

std::vector<NearSpecies> NearestSpecies::find(const trace::Likeness& likeness,
                                              std::size_t count) const {
    std::vector<NearSpecies> found;
    for (const Drawn& one : drawn_) {
        const trace::Unlikeness apart = trace::unlikeness(likeness, one.likeness);
        if (found.empty() || found.back().id != one.id) {
            found.push_back({one.id, one.age, apart});
        } else if (apart.total() < found.back().apart.total()) {
            found.back().age = one.age;
            found.back().apart = apart;
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const NearSpecies& a, const NearSpecies& b) {
        return a.apart.total() < b.apart.total();
    });
    found.resize(std::min(count, found.size()));
    return found;
}

}  // namespace sporeprint
