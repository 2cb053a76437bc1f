#include "core/grow/colony.h"

#include <fstream>

int main() {
    using namespace sporeprint;
    ColonySpec spec;
    spec.mix = {{"hypholoma_fasciculare", 1000}};
    spec.params.count = 24;
    spec.params.distinct = 4;
    spec.params.lod = 2;
    const Grown colony = grow_colony(spec, *built_in_atlas());
    std::ofstream file("colony.glb", std::ios::binary);
    for (const Slice& slice : colony.glb)
        file.write(reinterpret_cast<const char*>(slice.data()), static_cast<long>(slice.size));
}
