#include <fstream>

#include "core/grow/mushroom.h"
#include "core/grow/nearest_species.h"
#include "core/params/reader.h"
#include "core/params/value.h"
#include "core/render/render.h"
#include "core/trace/cut.h"
#include "core/trace/photo_file.h"
#include "core/trace/trace.h"
#include "core/trace/whole_species.h"

int main() {
    using namespace sporeprint;
    const auto atlas = built_in_atlas();

    // The photograph, here a picture of our own: any JPEG, PNG or WebP file will do.
    MushroomSpec sitter;
    sitter.mix.push_back({"russula_emetica"});
    sitter.params.base = Base::clean;
    Extras camera;
    Bytes photograph;
    camera.write = [&](const GlbScene& scene, const Parallel&) {
        photograph = rendered_png(
            scene,
            {.width = 800, .height = 800, .view = View::front, .background = Background::grey});
        return Body{};
    };
    static_cast<void>(grow_mushroom(sitter, *atlas, camera));

    // A line from the foot to the top, and one across the cap, in pixels of what is traced.
    const Picture photo =
        trace::reduced(trace::decoded_photo(photograph, "/photo").picture, trace::large_side);
    const trace::Gesture gesture{{{445, 720}, {390, 90}}, {{150, 130}, {680, 90}}, {}, {}, {}};
    const trace::Mask mask = trace::cut_out(photo, gesture);
    const trace::Traced traced = trace::traced(mask, gesture, {0.08});

    // All other stages are those of the species that it looks like.
    const NearSpecies nearest = NearestSpecies(*atlas).find(trace::likeness_of(photo, mask), 1)[0];
    Species species =
        trace::whole_species(atlas->find(nearest.id)->species, traced.shape, nearest.age).species;
    species.id = Text<48>("my_mushroom");

    MushroomSpec spec;
    spec.mix.push_back({"my_mushroom"});
    spec.params.seed = 7;
    const Mushroom mushroom = grow_mushroom(spec, Atlas({.species = {dump(write(species))}}));
    std::ofstream file("species_from_a_photograph.glb", std::ios::binary);
    for (const Slice& slice : mushroom.glb)
        file.write(reinterpret_cast<const char*>(slice.data()), static_cast<long>(slice.size));
}
