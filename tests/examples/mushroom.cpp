#include "core/grow/mushroom.h"

#include <fstream>

int main() {
    using namespace sporeprint;
    MushroomOrder order;
    order.mix.push_back({"amanita_muscaria"});
    order.params.seed = 7;
    order.params.deformation.bend_deg = 20;
    const Mushroom mushroom = grow_mushroom(order, *built_in_atlas());
    std::ofstream file("mushroom.glb", std::ios::binary);
    for (const Slice& slice : mushroom.glb)
        file.write(reinterpret_cast<const char*>(slice.data()), static_cast<long>(slice.size));
}
