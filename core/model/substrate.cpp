#include "core/model/substrate.h"

#include <string_view>

#include "core/model/mentions.h"

namespace sporeprint {

Substrate wood_of(const Facts& facts) {
    struct Word {
        std::string_view text;
        Substrate wood;
    };
    static constexpr std::array<Word, 9> words = {{{"beech", Substrate::beech},
                                                   {"birch", Substrate::birch},
                                                   {"oak", Substrate::oak},
                                                   {"poplar", Substrate::poplar},
                                                   {"willow", Substrate::poplar},
                                                   {"spruce", Substrate::spruce},
                                                   {"pine", Substrate::spruce},
                                                   {"conifer", Substrate::spruce},
                                                   {"broad-leaved", Substrate::beech}}};
    return first_mentioned(facts.habitat.view(), words, &Word::wood, Substrate::beech);
}

}  // namespace sporeprint
