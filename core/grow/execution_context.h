// What a recipe borrows from whoever calls it: memory, ears, hands and the right to be stopped.
#pragma once

#include <functional>
#include <stop_token>

#include "core/get_or_compute.h"
#include "core/problems.h"
#include "core/silhouette/morph_set.h"
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

/// Keeps what is expensive to make again, each kind by keys of its own.
struct Memo {
    Remember<ImageSet> images = make_anew<ImageSet>;
    Remember<RawImages> paintings = make_anew<RawImages>;  ///< what a mix dissolves
    Remember<MorphSet> morphs = make_anew<MorphSet>;       ///< correspondence of a set of species
};

struct Workshop {
    Memo memo;
    Observer observer = [](Step) {};
    Parallel parallel = in_turn;
    std::stop_token stop;
};

/// throws  Cancelled if the workshop was asked to stop
inline void stop_if_asked(const Workshop& workshop) {
    if (workshop.stop.stop_requested()) throw Cancelled();
}

}  // namespace sporeprint
