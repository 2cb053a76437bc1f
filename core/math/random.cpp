#include "core/math/random.h"

#include <xxhash.h>

namespace sporeprint {

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> c,
                                    std::array<std::uint32_t, 2> k) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t first = std::uint64_t{0xD2511F53U} * c[0];
        const std::uint64_t second = std::uint64_t{0xCD9E8D57U} * c[2];
        c = {static_cast<std::uint32_t>(second >> 32) ^ c[1] ^ k[0],
             static_cast<std::uint32_t>(second),
             static_cast<std::uint32_t>(first >> 32) ^ c[3] ^ k[1],
             static_cast<std::uint32_t>(first)};
        k[0] += 0x9E3779B9U;
        k[1] += 0xBB67AE85U;
    }
    return c;
}

std::uint32_t stream_of(std::string_view name) { return XXH32(name.data(), name.size(), 0); }

std::uint32_t Random::bits() {
    if (used_ == 4) {
        words_ = philox({object_, block_, static_cast<std::uint32_t>(cell_.x),
                         static_cast<std::uint32_t>(cell_.y)},
                        {seed_, purpose_});
        ++block_;
        used_ = 0;
    }
    return words_[static_cast<std::size_t>(used_++)];
}

double Random::uniform() { return (bits() >> 8) * 0x1p-24; }

double Random::uniform(double from, double to) { return from + (to - from) * uniform(); }

double Random::symmetric() { return 2.0 * uniform() - 1.0; }

double Random::normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
}

}  // namespace sporeprint
