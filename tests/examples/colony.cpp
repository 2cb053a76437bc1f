#include "core/grow/colony.h"

#include <fstream>

int main() {
    using namespace sporeprint;
    ColonyOrder order;
    order.mix = {{"hypholoma_fasciculare", 1000}};
    order.params.count = 24;
    order.params.distinct = 4;
    order.params.lod = 2;
    const Grown colony = grow_colony(order, *built_in_atlas());
    std::ofstream file("colony.glb", std::ios::binary);
    for (const Slice& slice : colony.glb)
        file.write(reinterpret_cast<const char*>(slice.data()), static_cast<long>(slice.size));
}
