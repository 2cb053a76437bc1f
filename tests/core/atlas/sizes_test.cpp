// Recorded sizes of each species, listed here a second time with their sources, compared with
// generated meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/collar.h"
#include "core/surface/charts.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::atlas_sizes_test {
namespace {

struct Sizes {
    double from, to;
};

/// Sizes in centimetres. Where only the stem is recorded, the height ends above it by the depth of
/// a large cap.
struct Recorded {
    std::string_view id;
    Sizes cap;     ///< diameter, to the greatest that is reported; 0 without a cap
    Sizes height;  ///< of the whole fruit body
    const char* source;
};

constexpr const char* wagner = "Wagner, Heider, Hattab 2021, primary_data_edited.csv";
constexpr const char* phillips = "Phillips, Mushrooms 2006";

constexpr std::array recorded = {
    Recorded{"amanita_muscaria", {8, 39}, {6, 28}, wagner},
    Recorded{"amanita_phalloides", {4, 20}, {5, 17}, wagner},
    Recorded{"armillaria_mellea", {3, 15}, {5, 21.5}, wagner},
    Recorded{"artomyces_pyxidatus", {2, 10}, {4, 13}, "mushroomexpert.com artomyces_pyxidatus"},
    Recorded{"auricularia_auricula_judae", {2, 12}, {0.6, 3}, "uoguelph.ca gbarron auricula"},
    Recorded{"boletus_edulis", {5, 30}, {3, 31}, wagner},
    Recorded{"cantharellus_cibarius", {2, 11}, {2, 10}, wagner},
    Recorded{"clathrus_ruber", {4, 10}, {5, 20}, phillips},
    Recorded{"clavariadelphus_pistillaris", {0, 0}, {7, 30}, wagner},
    Recorded{"coprinellus_disseminatus", {0.5, 2}, {1.5, 4.8}, wagner},
    Recorded{"coprinopsis_atramentaria", {3, 12}, {5, 19}, wagner},
    Recorded{"coprinus_comatus", {2.5, 7}, {8, 35}, wagner},
    Recorded{"craterellus_cornucopioides", {2, 8}, {3, 12}, "uoguelph.ca gbarron"},
    Recorded{"cyathus_striatus", {0.4, 1.5}, {0.5, 1.5}, "connecticutwilderness.com cyathus"},
    Recorded{"daldinia_concentrica", {2, 10}, {2, 10}, "thewcg.org.uk Daldiniaconcentrica"},
    Recorded{"disciotis_venosa", {3, 21}, {0.5, 6}, "bib.ge/soko"},
    Recorded{"fomes_fomentarius", {5, 50}, {2, 25}, wagner},
    Recorded{"geastrum_triplex", {5, 15}, {2, 8}, phillips},
    Recorded{"gyromitra_esculenta", {2.5, 14}, {3.5, 17}, "fungi.myspecies.info 5182"},
    Recorded{"hericium_erinaceus", {5, 40}, {5, 40}, "jungledragon.com 5126"},
    Recorded{"hydnum_repandum", {3, 25}, {2, 11.5}, wagner},
    Recorded{"hygrocybe_coccinea", {2, 5}, {3, 7}, wagner},
    Recorded{"hygrocybe_conica", {1.5, 10}, {3, 12}, wagner},
    Recorded{"hypholoma_fasciculare", {2, 9}, {4, 14}, wagner},
    Recorded{"infundibulicybe_geotropa", {4, 20}, {5, 17}, phillips},
    Recorded{"infundibulicybe_gibba", {3, 9}, {2.5, 10.5}, wagner},
    Recorded{"laccaria_amethystina", {1, 7}, {3, 10.8}, wagner},
    Recorded{"lactarius_deliciosus", {3, 20}, {3, 11.5}, wagner},
    Recorded{"lepista_nuda", {4, 20}, {3, 12}, wagner},
    Recorded{"lycoperdon_perlatum", {1.5, 6}, {2, 10}, phillips},
    Recorded{"macrolepiota_procera", {10, 30}, {15, 38}, wagner},
    Recorded{"marasmius_oreades", {1, 8}, {2, 10.5}, wagner},
    Recorded{"morchella_esculenta", {2, 7}, {4, 19}, wagner},
    Recorded{"mycena_galericulata", {1, 6}, {3, 15}, wagner},
    Recorded{"mycena_haematopus", {1, 4}, {2.5, 11}, "bib.ge/soko 792, englishfungi.org"},
    Recorded{"mycena_sanguinolenta", {0.5, 1.5}, {4, 8}, wagner},
    Recorded{"phallus_impudicus", {2.5, 5}, {10, 30}, phillips},
    Recorded{"pleurotus_ostreatus", {5, 25}, {1, 14}, wagner},
    Recorded{"psilocybe_semilanceata", {0.5, 2.5}, {2.5, 11}, wagner},
    Recorded{"ramaria_formosa", {3, 15}, {7, 30}, phillips},
    Recorded{"russula_emetica", {3, 10}, {4, 10.5}, wagner},
    Recorded{"russula_vinosa", {5, 12}, {4, 9}, "cs.wikipedia, Holubinka tečkovaná"},
    Recorded{"sarcoscypha_austriaca", {1, 7}, {1, 5.5}, phillips},
    Recorded{"stereum_hirsutum", {2, 10}, {0.1, 4}, phillips},
    Recorded{"trametes_versicolor", {2, 10}, {0.1, 6}, wagner},
    Recorded{"tremella_mesenterica", {2, 10}, {1, 4}, phillips},
    Recorded{"xylaria_hypoxylon", {0, 0}, {3, 8}, "en.wikipedia Xylaria_hypoxylon"},
};

/// Returns the atlas with straight axes.
const Atlas& straight_atlas() {
    static const Atlas straight = [] {
        std::vector<std::string> texts;
        for (const AtlasEntry& entry : atlas().entries()) {
            std::string json = entry.json;
            for (std::size_t at = 0; (at = json.find("\"axis\":[", at)) != std::string::npos;
                 at += 9) {
                const std::size_t from = at + 8;
                json.erase(from, json.find(']', from) - from);
            }
            texts.push_back(std::move(json));
        }
        return Atlas({.species = texts});
    }();
    return straight;
}

struct Measured {
    double width = 0.0, height = 0.0;  ///< centimetres
};

/// Returns true if a vertex uses the chart of a part.
bool uses_chart(const glm::vec2& uv, Part part) {
    const Chart& chart = swept_charts[static_cast<std::size_t>(part)];
    return uv.x >= chart.u && uv.x <= chart.u + chart.width && uv.y >= chart.v &&
           uv.y <= chart.v + chart.height;
}

/// Returns the cap's width and the height of its top, from the vertices that use the charts of its
/// faces or are those of a receptacle: no ring, volva, bulb, wart or bend. The rays of an earthstar
/// are faces too. A fruit body
/// on a wall has its height from its lowest point, not from the ground.
Measured measure(MushroomSpec order) {
    order.params.deformation.bend_deg = order.params.deformation.lean_deg = 0.0;
    order = textured(order);
    const Individual individual = resolve(order, straight_atlas());
    const Mesh mesh = mushroom_mesh(order, individual);
    glm::vec3 low(1e9F), high(-1e9F);
    // The last vertices are those of the collar. Records give the thickness of what stands out from
    // the wood; flesh that lies flat on the bark is no part of it.
    const std::size_t spread = collar_count(individual, order.params.lod).vertices;
    for (std::size_t i = 0; i + spread < mesh.positions.size(); ++i) {
        const glm::vec2 uv = mesh.texture_coordinates[i];
        const bool is_net = !individual.receptacles.empty() && uses_chart(uv, Part::veil);
        if (!is_net && !uses_chart(uv, Part::cap) && !uses_chart(uv, Part::hymenium)) continue;
        low = glm::min(low, mesh.positions[i]);
        high = glm::max(high, mesh.positions[i]);
    }
    const float lowest = individual.azimuth.lateral > 0.0 ? low.y : 0.0F;
    return {100.0 * std::max(high.x - low.x, high.z - low.z), 100.0 * (high.y - lowest)};
}

constexpr double rounding = 1e-6;

TEST(Sizes, FactsLieWithinTheRecord) {
    std::size_t known = 0;
    for (const AtlasEntry& entry : atlas().entries()) {
        const Facts& facts = entry.species.facts;
        const std::string id = entry.species.id.string();
        const auto* const row = std::find_if(recorded.begin(), recorded.end(),
                                             [&](const Recorded& one) { return one.id == id; });
        // A new species is one file and is compared with its own facts below; species of the record
        // are compared with it too.
        if (row == recorded.end()) continue;
        ++known;
        EXPECT_GE(100.0 * facts.height_m.from, row->height.from - rounding) << id;
        EXPECT_LE(100.0 * facts.height_m.to, row->height.to + rounding) << id;
        EXPECT_EQ(facts.cap_diameter_m.has_value(), row->cap.to > 0.0) << id;
        if (!facts.cap_diameter_m) continue;
        EXPECT_GE(100.0 * facts.cap_diameter_m->from, row->cap.from - rounding) << id;
        EXPECT_LE(100.0 * facts.cap_diameter_m->to, row->cap.to + rounding) << id;
    }
    EXPECT_GE(known, 38U) << "species of the record that the atlas has";
}

TEST(Sizes, MatureMushroomsLieWithinTheRecordedRange) {
    for (const AtlasEntry& entry : atlas().entries()) {
        const Facts& facts = entry.species.facts;
        const std::string id = entry.species.id.string();
        MushroomSpec order = order_of(id);
        order.params.variation = 0.0;
        const Measured size = measure(order);
        EXPECT_GE(size.height, 100.0 * facts.height_m.from) << id;
        EXPECT_LE(size.height, 100.0 * facts.height_m.to) << id;
        if (!facts.cap_diameter_m) continue;
        EXPECT_GE(size.width, 100.0 * facts.cap_diameter_m->from) << id;
        EXPECT_LE(size.width, 100.0 * facts.cap_diameter_m->to) << id;
    }
}

TEST(Sizes, IndividualsSpanTheRecordedRange) {
    for (const AtlasEntry& entry : atlas().entries()) {
        const Facts& facts = entry.species.facts;
        const std::string id = entry.species.id.string();
        Sizes width{1e9, 0.0}, height{1e9, 0.0};
        for (std::uint32_t seed = 1; seed <= 96; ++seed) {
            // The second level of detail of branched forms omits segments.
            MushroomSpec order = order_of(id, 0.6, seed, is_branched(entry.species) ? 1 : 2);
            order.params.variation = 1.0;
            const Measured size = measure(order);
            width = {std::min(width.from, size.width), std::max(width.to, size.width)};
            height = {std::min(height.from, size.height), std::max(height.to, size.height)};
        }
        // The shares are of logarithms, because sizes vary by factors.
        const auto expect_span = [&](const char* what, Sizes made, Range fact) {
            EXPECT_GE(made.from, 100.0 * fact.from) << id << ": " << what;
            EXPECT_LE(made.to, 100.0 * fact.to) << id << ": " << what;
            EXPECT_GE(std::log(made.to / made.from), 0.54 * std::log(fact.to / fact.from))
                << id << ": " << what << " from " << made.from << " to " << made.to;
        };
        expect_span("height", height, facts.height_m);
        if (facts.cap_diameter_m) expect_span("cap", width, *facts.cap_diameter_m);
    }
}

}  // namespace
}  // namespace sporeprint::atlas_sizes_test
