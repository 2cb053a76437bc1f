#include "core/colony/root_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

glm::dvec2 turned(const glm::dvec2& v, double angle) {
    const SineCosine at = sine_cosine(angle);
    return {at.cosine * v.x - at.sine * v.y, at.sine * v.x + at.cosine * v.y};
}

// Two noise fields, or the gradient of one.
class Field {
  public:
    Field(const ColonyRoots& roots, std::uint32_t seed) : roots_(roots) {
        Random random(seed, purposes::root_field);
        first_ = random.bits();
        second_ = random.bits();
        // The noise is zero at lattice points, so the base is placed at a random offset.
        shift_.x = random.uniform(100.0, 200.0);
        shift_.y = random.uniform(100.0, 200.0);
    }

    [[nodiscard]] glm::dvec2 at(const glm::dvec2& place) const {
        glm::dvec2 v = place;
        const glm::dvec2 p = place / roots_.field_scale + shift_;
        if (roots_.field == RootField::noise) {
            v = {noise(p, first_), noise(p, second_)};
        } else if (roots_.field == RootField::curl) {
            constexpr double step = 1.0 / 64.0;
            v = {
                noise(p + glm::dvec2(0.0, step), first_) - noise(p - glm::dvec2(0.0, step), first_),
                noise(p - glm::dvec2(step, 0.0), first_) -
                    noise(p + glm::dvec2(step, 0.0), first_)};
        }
        const double size = glm::length(v);
        return size > 1e-6 ? v / size : glm::dvec2(0.0);
    }

  private:
    static double noise(const glm::dvec2& p, std::uint32_t seed) {
        const std::array<float, 1> x = {static_cast<float>(p.x)}, y = {static_cast<float>(p.y)};
        std::array<float, 1> out{};
        gradient_noise(x, y, seed, out);
        return out[0];
    }

    const ColonyRoots& roots_;
    std::uint32_t first_ = 0, second_ = 0;
    glm::dvec2 shift_{0.0};
};

[[noreturn]] void refuse_size(const ColonyRoots& roots) {
    throw Impossible("/branch_distance",
                     "the roots would have about " +
                         number_text(std::floor(expected_root_nodes(roots) + 0.5)) +
                         " nodes; at most " + std::to_string(most_root_nodes) + " are grown");
}

class Grower {
  public:
    Grower(const ColonyRoots& roots, std::uint32_t seed)
        : roots_(roots), seed_(seed), field_(roots, seed) {}

    ColonySkeleton take() {
        node({0.0, 0.0}, 0, false);
        for (int arm = 0; arm < roots_.arms; ++arm) {
            const double angle = radians(roots_.heading_deg) + 2.0 * pi * arm / roots_.arms;
            const auto index = static_cast<std::uint32_t>(made_.branches.size());
            open(index, angle, 0, turned({0.0, 1.0}, angle));
        }
        // Breadth first, so that the index of a branch does not depend on how far others grow.
        while (!waiting_.empty()) {
            const Start start = waiting_.front();
            waiting_.pop_front();
            grow(start);
        }
        made_.root_nodes = static_cast<std::uint32_t>(made_.skeleton.nodes.size());
        for (std::uint32_t i = 0; i < made_.root_nodes; ++i) stem(i);
        return std::move(made_);
    }

  private:
    struct Start {
        std::uint32_t branch = 0;
        glm::dvec2 heading{0.0};
    };

    std::uint32_t node(const glm::dvec2& place, int depth, bool inserted) {
        if (made_.skeleton.nodes.size() >= most_root_nodes) refuse_size(roots_);
        const double radius =
            roots_.root_radius * exponential(-0.5 * roots_.decay * roots_.area_decay * depth);
        made_.skeleton.nodes.push_back({{place.x, 0.0, place.y}, radius});
        made_.depths.push_back(depth);
        made_.inserted.push_back(inserted);
        return static_cast<std::uint32_t>(made_.skeleton.nodes.size() - 1);
    }

    void open(std::uint32_t parent, double angle, std::uint32_t from, const glm::dvec2& heading) {
        const auto index = static_cast<std::uint32_t>(made_.branches.size());
        ColonySkeleton::Branch branch;
        branch.parent = parent;
        branch.angle = angle;
        branch.nodes.push_back(from);
        made_.branches.push_back(std::move(branch));
        waiting_.push_back({index, heading});
    }

    void grow(const Start& start) {
        const double angle = made_.branches[start.branch].angle;
        std::uint32_t here = made_.branches[start.branch].nodes.front();
        glm::dvec2 heading = start.heading;
        Random random(seed_, purposes::root_branches, start.branch);
        double passed = 0.0;
        double next = split(random);
        std::vector<std::uint32_t> nodes = {here};
        std::vector<double> splits;
        for (int depth = made_.depths[here]; depth < roots_.depth; ++depth) {
            const glm::dvec2 place(made_.skeleton.nodes[here].place.x,
                                   made_.skeleton.nodes[here].place.z);
            const glm::dvec2 along = field_.at(place);
            if (along != glm::dvec2(0.0)) heading = turned(along, angle);
            const double length = roots_.segment_length * exponential(-roots_.decay * depth);
            while (next < passed + length) {
                const double share = (next - passed) / length;
                const std::uint32_t fork = node(place + share * length * heading, depth + 1, true);
                link(here, fork);
                nodes.push_back(fork);
                here = fork;
                const double side = random.uniform(), jitter = random.symmetric();
                const double turn =
                    (side < 0.5 ? 0.5 : -0.5) * pi + radians(roots_.branch_jitter_deg) * jitter;
                open(start.branch, angle + turn, fork, turned(heading, turn));
                splits.push_back(next);
                next += split(random);
            }
            const std::uint32_t end = node(place + length * heading, depth + 1, false);
            link(here, end);
            nodes.push_back(end);
            here = end;
            passed += length;
        }
        ColonySkeleton::Branch& branch = made_.branches[start.branch];
        branch.nodes = std::move(nodes);
        branch.splits = std::move(splits);
        branch.length = passed;
    }

    // Returns the length to the next branching, exponentially distributed.
    double split(Random& random) const {
        return -roots_.branch_distance * logarithm(1.0 - random.uniform());
    }

    void link(std::uint32_t from, std::uint32_t to) {
        made_.skeleton.segments.push_back({from, to});
    }

    void stem(std::uint32_t root) {
        Random random(seed_, purposes::root_stems, root);
        if (random.uniform() >= roots_.stem_probability) return;
        const Skeleton::Node base = made_.skeleton.nodes[root];
        ColonySkeleton::Stem stem;
        stem.root = root;
        stem.radius = base.radius;
        stem.height = roots_.stem_height * exponential(-roots_.stem_decay * made_.depths[root]);
        const double from_base = glm::length(base.place);
        const glm::dvec3 outwards = from_base > 1e-9 ? base.place / from_base : glm::dvec3(0.0);
        std::uint32_t below = root;
        for (int i = 1; i <= roots_.stem_segments; ++i) {
            const double share = static_cast<double>(i) / roots_.stem_segments;
            const auto above = static_cast<std::uint32_t>(made_.skeleton.nodes.size());
            made_.skeleton.nodes.push_back({base.place +
                                                share * stem.height * glm::dvec3(0.0, 1.0, 0.0) +
                                                share * share * roots_.stem_displacement * outwards,
                                            base.radius});
            link(below, above);
            stem.nodes.push_back(above);
            below = above;
        }
        stem.along = glm::normalize(glm::dvec3(0.0, stem.height, 0.0) +
                                    2.0 * roots_.stem_displacement * outwards);
        made_.stems.push_back(std::move(stem));
    }

    const ColonyRoots& roots_;
    std::uint32_t seed_;
    Field field_;
    ColonySkeleton made_;
    std::deque<Start> waiting_;
};

}  // namespace

double expected_root_nodes(const ColonyRoots& roots) {
    double tips = roots.arms, nodes = 1.0;
    for (int depth = 0; depth < roots.depth; ++depth) {
        // Each tip grows by one segment; side branches that start on it grow from the next one on.
        const double leaving =
            roots.segment_length * exponential(-roots.decay * depth) / roots.branch_distance;
        nodes += tips * (1.0 + leaving);
        tips *= 1.0 + leaving;
    }
    return nodes;
}

ColonySkeleton colony_skeleton(const ColonyRoots& roots, std::uint32_t seed) {
    std::vector<Problem> problems;
    check(roots, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    if (expected_root_nodes(roots) > static_cast<double>(most_root_nodes)) refuse_size(roots);
    return Grower(roots, seed).take();
}

glm::dvec2 field_heading(const ColonyRoots& roots, std::uint32_t seed, const glm::dvec2& place) {
    return Field(roots, seed).at(place);
}

}  // namespace sporeprint
