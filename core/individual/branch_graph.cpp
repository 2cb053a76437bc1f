#include "core/individual/branch_graph.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/individual/damage.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t none = Bush::none;
constexpr glm::dvec3 upwards(0.0, 1.0, 0.0);
// Of the limb between the two forks of a whorl this much is left.
constexpr double whorl_rest = 0.06;

// What is drawn for a node, whatever species it belongs to: by the way that leads to it.
struct NodeDraws {
    double length, angle, azimuth, x, y, z, side, onset, depth;
};

NodeDraws draws_of(std::uint32_t seed, std::uint32_t way) {
    Random random(seed, purposes::bush_limbs, way);
    NodeDraws d{};
    d.length = random.symmetric();
    d.angle = random.symmetric();
    d.azimuth = random.symmetric();
    d.x = random.symmetric();
    d.y = random.symmetric();
    d.z = random.symmetric();
    d.side = random.symmetric() < 0.0 ? -1.0 : 1.0;
    Random eaten(seed, purposes::eaten_tips, way);
    d.onset = eaten.uniform();
    d.depth = eaten.uniform(0.35, 0.95);
    return d;
}

// Names a way from the ground to a node: what is drawn there is the same for every species that has it.
std::uint32_t way_on(std::uint32_t way, std::uint32_t turn) {
    std::uint32_t word = (way ^ (turn + 1U)) * 0x9e3779b1U;
    word ^= word >> 15U;
    word *= 0x85ebca77U;
    return word ^ (word >> 13U);
}

std::uint32_t trunk_seed(std::uint32_t seed, std::uint32_t trunk) {
    return trunk == 0 ? seed : Random(seed, purposes::bush_trunks, trunk).bits();
}

// What one species wants of a node: lengths of its highest way from fork to tip, radii in its heights.
struct Wanted {
    double length = 0.0, radius = 0.0, presence = 0.0;
    double main_turn = 0.0, other_turn = 0.0;  // radians
    double azimuth = 0.0;                      // radians
};

// One trunk of one species, by the nodes of its ramification.
class Sprout {
  public:
    Sprout(const Branched& shape, Ramification tree, std::vector<NodeDraws> draws)
        : style_(shape.limbs), tree_(std::move(tree)), draws_(std::move(draws)) {
        const std::size_t count = tree_.nodes.size();
        wanted_.resize(count);
        natural_.resize(count);
        rest_.resize(count);
        tips_.assign(count, 0.0);
        for (std::size_t i = count; i > 0; --i) {
            const auto node = static_cast<std::uint32_t>(i - 1);
            natural_[node] = natural_length(node);
            rest_[node] = natural_[node];
            if (tree_.leaf(node))
                tips_[node] = 1.0;
            else
                rest_[node] += rest_[tree_.nodes[node].children[0]];
            if (node > 0) tips_[tree_.nodes[node].parent] += tips_[node];
        }
        wanted_[0].presence = 1.0;
        want(0, rest_[0]);
    }

    [[nodiscard]] const Ramification& tree() const { return tree_; }
    [[nodiscard]] const Wanted& wanted(std::uint32_t node) const { return wanted_[node]; }

  private:
    [[nodiscard]] double natural_length(std::uint32_t node) const {
        if (node == 0) return 0.0;  // the trunk has a length of its own
        const int order = tree_.nodes[node].order;
        double length = power(style_.length_rise, order - 1.0);
        if (order == 1) length *= style_.tip_length;
        if (order % 2 == 0) length *= 1.0 - (1.0 - whorl_rest) * style_.whorls;
        return length * (1.0 + 0.6 * style_.unevenness * draws_[node].length);
    }

    // Gives each node its length, from the ground up: `goal` is what is left from the beginning of its limb to its tip.
    void want(std::uint32_t root, double whole) {
        std::vector<double> goal(tree_.nodes.size(), 0.0);
        goal[root] = whole;
        const int highest = tree_.nodes[root].order;
        const double orders = std::max(1.0, highest - 2.0);
        const double rise = logarithm(std::max(tips_[root], 2.0));
        const double narrow = logarithm(style_.trunk_radius / style_.tip_radius);
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
            const Ramification::Node& node = tree_.nodes[i];
            Wanted& own = wanted_[i];
            const double stretch = rest_[i] > 0.0 ? goal[i] / rest_[i] : 1.0;
            const double length = natural_[i] * stretch;
            own.length = own.presence * length / whole;
            own.radius = own.presence * style_.tip_radius *
                         exponential(narrow * logarithm(tips_[i]) / rise) / style_.height;
            if (tree_.leaf(i)) continue;
            const std::uint32_t main = node.children[0], other = node.children[1];
            const double rest = goal[i] - length;
            goal[main] = rest;
            const double alone = rest_[other] * stretch;
            goal[other] = alone > 0.0 ? alone * power(rest / alone, style_.level) : 0.0;
            const double unfolded =
                smooth_step(0.0, 1.0, style_.unfolding * (highest - 1) - (highest - node.order));
            wanted_[main].presence = own.presence;
            wanted_[other].presence = own.presence * unfolded;

            const double low = std::clamp((node.order - 2.0) / orders, 0.0, 1.0);
            const double fork = style_.tip_fork_deg + low * (style_.fork_deg - style_.tip_fork_deg);
            const int lesser = tree_.nodes[other].order;
            const double varied = 1.0 + 0.45 * style_.unevenness * draws_[i].angle;
            own.main_turn = own.other_turn = radians(fork * varied);
            if (tree_.nodes[main].order == node.order) {
                const double share = lesser / (node.order - 1.0);
                own.main_turn *= 0.5 * share;
                const double side = static_cast<double>(node.order - lesser) / (node.order - 1.0);
                own.other_turn =
                    radians((fork + side * std::max(0.0, style_.side_deg - fork)) * varied);
            }
            own.azimuth =
                radians(style_.azimuth_deg + 40.0 * style_.unevenness * draws_[i].azimuth);
        }
    }

    const LimbStyle& style_;
    Ramification tree_;
    std::vector<NodeDraws> draws_;
    std::vector<double> natural_, rest_, tips_;
    std::vector<Wanted> wanted_;
};

// Numbers of all species, by weight.
struct Common {
    double height = 0.0, trunk = 0.0, trunk_radius = 0.0, splay = 0.0, upright = 0.0, wander = 0.0;
};

class Grower {
  public:
    Grower(const std::vector<BushShare>& shares, const BushProportions& own, std::uint32_t seed)
        : shares_(shares), own_(own), seed_(seed) {}

    Bush grow(double bites) {
        blend_styles();
        overlay();
        blend_nodes();
        for (std::uint32_t i = 0; i < bush_.nodes.size(); ++i) place(i);
        fit();
        colour();
        eat(bites);
        return std::move(bush_);
    }

  private:
    void blend_styles() {
        double log_height = 0.0;
        for (const BushShare& share : shares_) {
            const LimbStyle& style = share.shape->limbs;
            log_height += share.weight * logarithm(style.height);
            common_.trunk += share.weight * style.trunk;
            common_.trunk_radius += share.weight * style.trunk_radius / style.height;
            common_.splay += style.trunks > 1 ? share.weight * radians(style.splay_deg) : 0.0;
            common_.upright += share.weight * style.upright;
            common_.wander += share.weight * style.wander;
            bush_.foot += share.weight * (style.foot - 1.0);
            bush_.flatness += share.weight * style.flatness;
            bush_.web += share.weight * style.web;
            bush_.bluntness += share.weight * style.bluntness;
        }
        common_.height = exponential(log_height) * own_.size;
        bush_.height = common_.height;
        bush_.trunk = std::min(0.96, common_.trunk * own_.trunk) * common_.height;
        bush_.trunk_radius = common_.trunk_radius * common_.height * own_.width;
    }

    std::uint32_t append(std::uint32_t parent, std::uint32_t way) {
        Bush::Node node;
        node.parent = parent;
        bush_.nodes.push_back(node);
        ways_.push_back(way);
        draws_.push_back(draws_of(seed_, way));
        return static_cast<std::uint32_t>(bush_.nodes.size() - 1);
    }

    // The trees of all species, fork on fork.
    void overlay() {
        for (const BushShare& share : shares_)
            while (static_cast<int>(bush_.roots.size()) < share.shape->limbs.trunks) {
                const auto trunk = static_cast<std::uint32_t>(bush_.roots.size());
                bush_.roots.push_back(append(none, way_on(0, trunk)));
            }
        for (const BushShare& share : shares_) {
            const std::size_t first = sprouts_.size();
            std::size_t tips = 0;
            for (int t = 0; t < share.shape->limbs.trunks; ++t) {
                const auto trunk = static_cast<std::uint32_t>(t);
                Ramification tree =
                    ramified(share.shape->ramification, trunk_seed(seed_, trunk), most_bush_tips);
                std::vector<std::uint32_t> at(tree.nodes.size(), bush_.roots[trunk]);
                for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
                    if (tree.leaf(i)) {
                        bush_.nodes[at[i]].may_end = true;
                        ++tips;
                        continue;
                    }
                    for (std::uint32_t k = 0; k < 2; ++k) {
                        if (bush_.nodes[at[i]].children[k] == none) {
                            const std::uint32_t made = append(at[i], way_on(ways_[at[i]], k));
                            bush_.nodes[at[i]].children[k] = made;
                        }
                        at[tree.nodes[i].children[k]] = bush_.nodes[at[i]].children[k];
                    }
                }
                std::vector<NodeDraws> draws;
                draws.reserve(at.size());
                for (const std::uint32_t node : at) draws.push_back(draws_[node]);
                sprouts_.push_back({Sprout(*share.shape, std::move(tree), std::move(draws)),
                                    std::move(at), share.weight});
            }
            for (std::size_t i = first; i < sprouts_.size(); ++i)
                sprouts_[i].few = tips <= few_tips;
        }
        for (std::size_t i = bush_.nodes.size(); i > 0; --i) {
            Bush::Node& node = bush_.nodes[i - 1];
            if (node.children[0] != none)
                node.tips = bush_.nodes[node.children[0]].tips + bush_.nodes[node.children[1]].tips;
        }
    }

    void blend_nodes() {
        wanted_.resize(bush_.nodes.size());
        std::vector<double> angles(bush_.nodes.size(), 0.0), have(bush_.nodes.size(), 0.0);
        for (const auto& [sprout, at, weight, few] : sprouts_)
            for (std::uint32_t i = 0; i < at.size(); ++i) {
                have[at[i]] += weight;
                if (few) bush_.nodes[at[i]].few += weight;
                const Wanted& one = sprout.wanted(i);
                Wanted& all = wanted_[at[i]];
                all.length += weight * one.length;
                all.radius += weight * one.radius;
                all.presence += weight * one.presence;
                if (sprout.tree().leaf(i)) continue;
                // Who has hardly a fork there has hardly a say in its angle.
                const double says = weight * std::max(one.presence, 1e-6);
                all.main_turn += says * one.main_turn;
                all.other_turn += says * one.other_turn;
                all.azimuth += says * one.azimuth;
                angles[at[i]] += says;
            }
        for (std::size_t i = 0; i < wanted_.size(); ++i) {
            Wanted& all = wanted_[i];
            if (angles[i] > 0.0) {
                all.main_turn *= own_.spread / angles[i];
                all.other_turn *= own_.spread / angles[i];
                all.azimuth /= angles[i];
            }
            bush_.nodes[i].presence = all.presence;
            bush_.nodes[i].few /= have[i];
            bush_.nodes[i].radius = all.radius * common_.height * own_.width;
        }
        for (std::size_t i = bush_.nodes.size(); i > 0; --i) {
            Bush::Node& node = bush_.nodes[i - 1];
            if (node.children[0] == none)
                node.left = node.presence;
            else
                node.left = std::max(
                    bush_.nodes[node.children[0]].left + bush_.nodes[node.children[1]].left,
                    node.presence);
        }
    }

    // Turns the heading of a node's limb to its own, puts its end, and says how the limbs that it bears leave it.
    void place(std::uint32_t i) {
        Bush::Node& node = bush_.nodes[i];
        const NodeDraws& drawn = draws_[i];
        if (node.parent == none) {
            const auto trunk = static_cast<double>(
                std::find(bush_.roots.begin(), bush_.roots.end(), i) - bush_.roots.begin());
            // Trunks lean out by the golden angle, so that each keeps its way however many there are.
            const SineCosine out = sine_cosine(radians(137.5) * trunk + drawn.azimuth);
            const SineCosine lean = sine_cosine(common_.splay);
            node.heading = glm::normalize(
                glm::dvec3(lean.sine * out.cosine, lean.cosine, lean.sine * out.sine));
            node.across = square_to(node.heading, glm::dvec3(1.0, 0.0, 0.5 * drawn.z));
        } else {
            const glm::dvec3 before = node.heading;
            glm::dvec3 heading = before;
            heading += common_.upright * (upwards - glm::dot(upwards, heading) * heading);
            heading += 0.7 * common_.wander * glm::dvec3(drawn.x, 0.5 * drawn.y, drawn.z);
            node.heading = glm::normalize(heading);
            node.across = square_to(node.heading, carried(node.across, before, node.heading));
        }
        // A limb that turns up again does not begin further on than where it goes.
        node.beside -= std::min(0.0, glm::dot(node.beside, node.heading)) * node.heading;
        const glm::dvec3 from =
            node.parent == none ? glm::dvec3(0.0) : bush_.nodes[node.parent].place;
        const double length =
            node.parent == none ? node.presence * bush_.trunk : wanted_[i].length * common_.height;
        node.place = from + node.beside + length * node.heading;
        if (node.children[0] == none) return;
        Bush::Node &main = bush_.nodes[node.children[0]], &other = bush_.nodes[node.children[1]];
        if (node.parent != none)
            node.across = turned_square(node.across, node.heading, drawn.side * wanted_[i].azimuth);
        // Where the other branch is not yet, the first goes straight on.
        const double both =
            node.presence > 0.0 ? std::min(1.0, other.presence / node.presence) : 0.0;
        // Limbs that are wider than long leave side by side rather than at an angle.
        const auto free = [&](std::uint32_t child) {
            const double long_as = wanted_[child].length * common_.height;
            return long_as / (long_as + 0.7 * bush_.nodes[child].radius + 1e-12);
        };
        const SineCosine of_main =
            sine_cosine(both * free(node.children[0]) * wanted_[i].main_turn);
        const SineCosine of_other = sine_cosine(free(node.children[1]) * wanted_[i].other_turn);
        const glm::dvec3 side = drawn.side * node.across;
        main.beside = -both * std::max(0.0, node.radius - main.radius) * side;
        // Where one species of a mix has a tip, what goes on leaves its end.
        const double goes_on = 1.0 - bush_.ends(i);
        other.beside = goes_on * std::max(0.0, node.radius - other.radius) * side;
        main.heading = of_main.cosine * node.heading - of_main.sine * side;
        other.heading = of_other.cosine * node.heading + of_other.sine * side;
        main.across = carried(node.across, node.heading, main.heading);
        other.across = carried(node.across, node.heading, other.heading);
    }

    // All limbs above the trunks grow by one factor until the highest tip is where it should be.
    void fit() {
        std::vector<glm::dvec3> foot(bush_.nodes.size());
        double grow = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < bush_.nodes.size(); ++i) {
            const Bush::Node& node = bush_.nodes[i];
            foot[i] = node.parent == none ? node.place : foot[node.parent];
            const double rise = node.place.y - foot[i].y;
            if (rise > 1e-9) grow = std::min(grow, (bush_.height - foot[i].y) / rise);
        }
        if (!std::isfinite(grow)) grow = 1.0;
        for (std::size_t i = 0; i < bush_.nodes.size(); ++i) {
            Bush::Node& node = bush_.nodes[i];
            node.place = foot[i] + grow * (node.place - foot[i]);
            node.beside *= grow;
            bush_.reach = std::max(
                bush_.reach,
                std::sqrt(node.place.x * node.place.x + node.place.z * node.place.z) + node.radius);
        }
    }

    void colour() {
        std::vector<double> rest(bush_.nodes.size(), 0.0);
        for (std::size_t i = bush_.nodes.size(); i > 0; --i) {
            const Bush::Node& node = bush_.nodes[i - 1];
            rest[i - 1] = wanted_[i - 1].length;
            if (node.children[0] != none) rest[i - 1] += rest[node.children[0]];
        }
        for (std::size_t i = 0; i < bush_.nodes.size(); ++i) {
            Bush::Node& node = bush_.nodes[i];
            if (node.parent == none) {
                node.from_tip = 1.0;
                continue;
            }
            const double before = bush_.nodes[node.parent].from_tip;
            const double passed = rest[i] > 0.0 ? wanted_[i].length / rest[i] : 0.0;
            node.from_tip = node.children[0] == none ? 0.0 : before * (1.0 - passed);
        }
    }

    void eat(double bites) {
        if (!(bites > 0.0)) return;
        // What goes on from an eaten end comes down with it.
        std::vector<glm::dvec3> down(bush_.nodes.size(), glm::dvec3(0.0));
        for (std::uint32_t i = 0; i < bush_.nodes.size(); ++i) {
            Bush::Node& node = bush_.nodes[i];
            if (node.parent == none) continue;
            const Bush::Node& bearer = bush_.nodes[node.parent];
            node.place -= down[node.parent];
            down[i] = down[node.parent];
            const double ends = bush_.ends(i);
            if (!(ends > 0.0)) continue;
            node.eaten = ends * draws_[i].depth * grown(draws_[i].onset, bites);
            const glm::dvec3 bitten = node.eaten * (node.place - bearer.place);
            node.place -= bitten;
            down[i] += bitten;
            if (node.children[0] == none)
                node.from_tip = node.eaten * bearer.from_tip;
            else
                node.from_tip += node.eaten * (bearer.from_tip - node.from_tip);
        }
    }

    struct Laid {
        Sprout sprout;
        std::vector<std::uint32_t> at;  // node of the bush, by node of the tree
        double weight;
        bool few = false;  // whether its species has few limbs
    };

    const std::vector<BushShare>& shares_;
    BushProportions own_;
    std::uint32_t seed_;
    Common common_;
    Bush bush_;
    std::vector<std::uint32_t> ways_;
    std::vector<NodeDraws> draws_;
    std::vector<Laid> sprouts_;
    std::vector<Wanted> wanted_;
};

}  // namespace

void Branched::check(const std::string& path, std::vector<Problem>& problems) const {
    if (ramification.order < 2)
        return report(problems, path + "/ramification/order",
                      "1 has no fork; a branched form has at least 2");
    const double tips = expected_tips(ramification) * limbs.trunks;
    if (tips > static_cast<double>(most_bush_tips))
        report(problems, path + "/ramification/order",
               "the bush would have about " + number_text(std::floor(tips + 0.5)) +
                   " tips; at most " + std::to_string(most_bush_tips) + " are grown");
}

Bush bush_of(const std::vector<BushShare>& shares, const BushProportions& own, double bites,
             std::uint32_t seed) {
    return Grower(shares, own, seed).grow(bites);
}

}  // namespace sporeprint
