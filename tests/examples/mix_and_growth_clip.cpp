#include <fstream>

#include "core/grow/mushroom.h"

int main() {
    using namespace sporeprint;
    MushroomSpec spec;
    spec.mix = {{"amanita_muscaria", 700}, {"boletus_edulis", 300}};
    spec.params.lod = 1;
    spec.params.animation = Animation::growth;
    spec.params.frames = 5;
    const Mushroom mushroom = grow_mushroom(spec, *built_in_atlas());
    std::ofstream file("mix_and_growth_clip.glb", std::ios::binary);
    for (const Slice& slice : mushroom.glb)
        file.write(reinterpret_cast<const char*>(slice.data()), static_cast<long>(slice.size));
}
