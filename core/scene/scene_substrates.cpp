#include "core/scene/scene_substrates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>

#include "core/params/messages.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Other names of kinds of trees, and of all of them that have broad leaves.
struct TreeWord {
    std::string_view word, kind;
};
constexpr std::array tree_words = {
    TreeWord{"beech", "broadleaf"}, TreeWord{"oak", "broadleaf"},
    TreeWord{"maple", "broadleaf"}, TreeWord{"ash", "broadleaf"},
    TreeWord{"lime", "broadleaf"},  TreeWord{"hornbeam", "broadleaf"},
    TreeWord{"willow", "poplar"},   TreeWord{"aspen", "poplar"},
    TreeWord{"alder", "birch"},     TreeWord{"pine", "spruce"},
    TreeWord{"fir", "spruce"},      TreeWord{"larch", "spruce"},
    TreeWord{"conifer", "spruce"},  TreeWord{"hazel", "shrub"},
    TreeWord{"elder", "shrub"}};

struct SoilWord {
    std::string_view word;
    Soil soil;
};
/// Words in the names of materials. Those of wood come first: a mossy trunk is wood, and so is a root in the soil.
constexpr std::array soil_words = {
    SoilWord{"bark", Soil::wood},     SoilWord{"wood", Soil::wood},
    SoilWord{"log", Soil::wood},      SoilWord{"logs", Soil::wood},
    SoilWord{"trunk", Soil::wood},    SoilWord{"trunks", Soil::wood},
    SoilWord{"stump", Soil::wood},    SoilWord{"branch", Soil::wood},
    SoilWord{"branches", Soil::wood}, SoilWord{"timber", Soil::wood},
    SoilWord{"snag", Soil::wood},     SoilWord{"twig", Soil::wood},
    SoilWord{"rock", Soil::none},     SoilWord{"rocks", Soil::none},
    SoilWord{"stone", Soil::none},    SoilWord{"stones", Soil::none},
    SoilWord{"metal", Soil::none},    SoilWord{"water", Soil::none},
    SoilWord{"concrete", Soil::none}, SoilWord{"brick", Soil::none},
    SoilWord{"litter", Soil::litter}, SoilWord{"needles", Soil::litter},
    SoilWord{"forest", Soil::litter}, SoilWord{"grass", Soil::grass},
    SoilWord{"lawn", Soil::grass},    SoilWord{"meadow", Soil::grass},
    SoilWord{"turf", Soil::grass},    SoilWord{"pasture", Soil::grass},
    SoilWord{"soil", Soil::ground},   SoilWord{"ground", Soil::ground},
    SoilWord{"dirt", Soil::ground},   SoilWord{"earth", Soil::ground},
    SoilWord{"mud", Soil::ground},    SoilWord{"moss", Soil::ground},
    SoilWord{"terrain", Soil::ground}};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = lower(c);
    return out;
}

/// Returns the words of a name in small letters: "ForestFloor_02" has forest and floor.
std::vector<std::string> words_of(std::string_view material) {
    std::vector<std::string> words;
    bool is_inside = false, was_small = false;
    for (const char c : material) {
        const bool is_capital = c >= 'A' && c <= 'Z';
        if (!is_letter(c)) {
            is_inside = false;
            continue;
        }
        if (!is_inside || (is_capital && was_small)) words.emplace_back();
        words.back() += lower(c);
        is_inside = true;
        was_small = !is_capital;
    }
    return words;
}

/// Returns the bit of the kind of tree that a word names; 0 if it names none.
std::uint32_t tree_of(std::string_view word, std::span<const std::string> kinds) {
    for (const TreeWord& other : tree_words)
        if (word == other.word) word = other.kind;
    for (std::size_t i = 0; i < kinds.size() && i < 32; ++i)
        if (kinds[i] == word) return 1U << i;
    return 0;
}

std::optional<Soil> soil_of(std::string_view word) {
    for (const Soil soil : {Soil::none, Soil::ground, Soil::litter, Soil::grass, Soil::wood})
        if (word == name(soil)) return soil;
    return std::nullopt;
}

/// Reads "ground+beech".
std::optional<MaterialSoil> read_soil(std::string_view text, std::span<const std::string> kinds,
                                      const std::string& path, std::vector<Problem>& problems) {
    MaterialSoil out;
    bool is_first = true, has_soil = false;
    while (is_first || !text.empty()) {
        const std::size_t plus = std::min(text.find('+'), text.size());
        const std::string word = lower(text.substr(0, plus));
        text.remove_prefix(std::min(plus + 1, text.size()));
        const std::optional<Soil> soil = is_first ? soil_of(word) : std::nullopt;
        const std::uint32_t tree = tree_of(word, kinds);
        if (soil) {
            out.soil = *soil;
            has_soil = true;
        } else if (tree != 0) {
            if (is_first) out.soil = Soil::wood;
            out.trees |= tree;
        } else {
            std::string known = "none, ground, litter, grass, wood";
            for (const std::string& kind : kinds) (known += ", ") += kind;
            report(problems, path,
                   in_quotes(word) + " is nothing that fungi could live on; expected " + known);
            return std::nullopt;
        }
        is_first = false;
    }
    if (out.trees != 0 && (out.soil == Soil::none || out.soil == Soil::grass)) {
        report(problems, path, std::string(name(out.soil)) + " has no trees");
        return std::nullopt;
    }
    // Wood, and the floor of a wood, of which no tree is named are of any.
    if (has_soil && out.trees == 0 && (out.soil == Soil::wood || out.soil == Soil::litter))
        out.trees = all_trees;
    return out;
}

/// Joins surfels of wood that are neighbours.
class Pieces {
  public:
    explicit Pieces(std::size_t count) : parent_(count) {
        for (std::uint32_t i = 0; i < count; ++i) parent_[i] = i;
    }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t p = root(a), q = root(b);
        // The lowest number stands for a piece.
        parent_[std::max(p, q)] = std::min(p, q);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

/// A piece of wood stands if it is so many times as high as wide, and at least so high, metres.
constexpr double standing_ratio = 1.5, least_standing = 1.0;

/// Roots and litter of a tree that stands in the scene reach so far below what is their foot, metres.
constexpr double deepest_roots = 2.0;

/// Roots reach so many radii of the crown, and no farther than this, metres.
constexpr double roots_per_crown = 2.0, longest_roots = 10.0;

}  // namespace

std::vector<NamedSoil> soils_in(std::string_view text, std::span<const std::string> kinds,
                                const std::string& path, std::vector<Problem>& problems) {
    std::vector<NamedSoil> out;
    const std::size_t before = problems.size();
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        const std::string_view part = text.substr(0, comma);
        text.remove_prefix(std::min(comma + 1, text.size()));
        const std::size_t colon = part.rfind(':');
        if (colon == std::string_view::npos || colon == 0) {
            report(problems, path,
                   in_quotes(part) + " is no material and what it is, as Bark:beech");
            continue;
        }
        const std::string material(part.substr(0, colon));
        if (std::ranges::any_of(out, [&](const NamedSoil& one) {
                return lower(one.material) == lower(material);
            })) {
            report(problems, path, in_quotes(material) + " is named twice");
            continue;
        }
        if (const auto soil = read_soil(part.substr(colon + 1), kinds, path, problems))
            out.push_back({material, *soil});
    }
    if (problems.size() > before) return {};
    return out;
}

MaterialSoil guessed_soil(std::string_view material, std::span<const std::string> kinds) {
    const std::vector<std::string> words = words_of(material);
    MaterialSoil out;
    for (const std::string& word : words) out.trees |= tree_of(word, kinds);
    for (const SoilWord& known : soil_words)
        if (std::ranges::find(words, known.word) != words.end()) {
            out.soil = known.soil;
            if (out.soil == Soil::none || out.soil == Soil::grass) out.trees = 0;
            if ((out.soil == Soil::wood || out.soil == Soil::litter) && out.trees == 0)
                out.trees = all_trees;
            return out;
        }
    // The leaves of a tree are nothing to live on.
    constexpr std::array<std::string_view, 3> of_leaves = {"leaf", "leaves", "foliage"};
    if (std::ranges::any_of(of_leaves, [&](std::string_view leaf) {
            return std::ranges::find(words, leaf) != words.end();
        }))
        return {};
    if (out.trees != 0) out.soil = Soil::wood;
    return out;
}

std::vector<MaterialSoil> soils_of(std::span<const std::string> materials,
                                   std::span<const NamedSoil> named,
                                   std::span<const std::string> kinds, const std::string& path,
                                   std::vector<Problem>& problems) {
    std::vector<MaterialSoil> out;
    std::vector<bool> is_used(named.size(), false);
    for (const std::string& material : materials) {
        out.push_back(guessed_soil(material, kinds));
        for (std::size_t i = 0; i < named.size(); ++i)
            if (lower(named[i].material) == lower(material)) {
                out.back() = named[i].soil;
                is_used[i] = true;
            }
    }
    for (std::size_t i = 0; i < named.size(); ++i)
        if (!is_used[i])
            report(problems, path, "the scene has no material " + in_quotes(named[i].material));
    return out;
}

double root_reach_of(const SceneWood& tree) {
    return std::min(longest_roots, roots_per_crown * crown_radius(tree.height()));
}

bool SurfelSubstrates::suits(const FungusSpecies& species, std::size_t surfel, double decay) const {
    const Ecology& ecology = species.ecology;
    const Soil soil = soils[surfel];
    const bool lives_with = (species.kinds & trees[surfel]) != 0;
    switch (ecology.guild) {
        case Guild::grass:
            return soil == Soil::grass;
        case Guild::litter:
        case Guild::ectomycorrhizal:
            return (soil == Soil::ground || soil == Soil::litter) && lives_with;
        case Guild::wood:
            return soil == Soil::wood && lives_with && ecology.decay.from <= decay &&
                   decay <= ecology.decay.to &&
                   (ecology.on_standing_wood || !wood[pieces[surfel]].stands);
    }
    return false;
}

std::size_t SurfelSubstrates::bytes() const {
    return sizeof(*this) + soils.size() * (sizeof(Soil) + 2 * sizeof(std::uint32_t)) +
           wood.size() * sizeof(SceneWood);
}

SurfelSubstrates substrates_of(const Surfels& surfels, const SurfelGraph& graph,
                               std::span<const MaterialSoil> soils) {
    const auto count = static_cast<std::uint32_t>(surfels.size());
    SurfelSubstrates out;
    out.soils.resize(count);
    out.trees.resize(count);
    out.pieces.assign(count, SurfelSubstrates::no_piece);
    for (std::uint32_t i = 0; i < count; ++i) {
        const MaterialSoil& soil = soils[surfels[i].material];
        out.soils[i] = soil.soil;
        out.trees[i] = soil.trees;
    }
    Pieces pieces(count);
    for (std::uint32_t i = 0; i < count; ++i)
        for (const SurfelGraph::Way& way : graph.ways(i))
            if (out.soils[i] == Soil::wood && out.soils[way.to] == Soil::wood &&
                surfels[i].material == surfels[way.to].material)
                pieces.join(i, way.to);
    std::vector<std::uint32_t> number(count, SurfelSubstrates::no_piece);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (out.soils[i] != Soil::wood) continue;
        const glm::dvec3 at(surfels[i].at);
        std::uint32_t& piece = number[pieces.root(i)];
        if (piece == SurfelSubstrates::no_piece) {
            piece = static_cast<std::uint32_t>(out.wood.size());
            out.wood.push_back({at, at, 0.0, out.trees[i], false});
        }
        out.pieces[i] = piece;
        SceneWood& wood = out.wood[piece];
        wood.low = glm::min(wood.low, at);
        wood.high = glm::max(wood.high, at);
        wood.area += static_cast<double>(surfels[i].area);
    }
    std::vector<std::uint32_t> standing;
    for (std::uint32_t i = 0; i < out.wood.size(); ++i) {
        SceneWood& wood = out.wood[i];
        const double wide = std::max(wood.high.x - wood.low.x, wood.high.z - wood.low.z);
        wood.stands = wood.height() >= std::max(least_standing, standing_ratio * wide);
        if (wood.stands) standing.push_back(i);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        if (out.soils[i] != Soil::ground && out.soils[i] != Soil::litter) continue;
        const glm::dvec3 at(surfels[i].at);
        double least = std::numeric_limits<double>::max();
        for (const std::uint32_t number_of_tree : standing) {
            const SceneWood& tree = out.wood[number_of_tree];
            const double x = at.x - 0.5 * (tree.low.x + tree.high.x),
                         z = at.z - 0.5 * (tree.low.z + tree.high.z);
            const double square = x * x + z * z, reach = root_reach_of(tree);
            if (square > reach * reach || std::abs(at.y - tree.low.y) > deepest_roots) continue;
            out.trees[i] |= tree.trees;
            if (square >= least) continue;
            least = square;
            out.pieces[i] = number_of_tree;
        }
    }
    return out;
}

}  // namespace sporeprint
