#include "core/grow/mushroom.h"

#include <fstream>

int main() {
    using namespace sporeprint;
    MushroomSpec spec;
    spec.mix.push_back({"amanita_muscaria"});
    spec.params.seed = 7;
    spec.params.deformation.bend_deg = 20;
    const Mushroom mushroom = grow_mushroom(spec, *built_in_atlas());
    std::ofstream file("mushroom.glb", std::ios::binary);
    for (const Slice& slice : mushroom.glb)
        file.write(reinterpret_cast<const char*>(slice.data()), static_cast<long>(slice.size));
}
