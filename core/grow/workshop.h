// What a recipe borrows from whoever calls it: memory, ears, hands and the right to be stopped.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "core/surface/paint.h"

namespace sporeprint {

enum class Step { resolve, build, paint, pack };

constexpr const char* name(Step step) {
    switch (step) {
        case Step::resolve:
            return "resolve";
        case Step::build:
            return "build";
        case Step::paint:
            return "paint";
        case Step::pack:
            return "pack";
    }
    return nullptr;
}

/// Told when a step begins; holds the clock, which core does not.
using Observer = std::function<void(Step)>;

/// Keeps what is expensive to make again. `remember` returns what it kept under `key`, or what `make` makes now.
struct Memo {
    std::function<std::shared_ptr<const ImageSet>(
        const std::string& key, const std::function<std::shared_ptr<const ImageSet>()>& make)>
        images =
            [](const std::string&, const std::function<std::shared_ptr<const ImageSet>()>& make) {
                return make();
            };
};

struct Workshop {
    Memo memo;
    Observer observer = [](Step) {};
    Parallel parallel = in_turn;
    std::stop_token stop;
};

}  // namespace sporeprint
