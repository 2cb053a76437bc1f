#include "api/products/worlds/edits.h"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/product.h"
#include "core/params/messages.h"
#include "core/params/reader.h"
#include "core/params/schema.h"
#include "core/params/types.h"
#include "core/surface/grey_codec.h"
#include "core/world/fungi_params.h"
#include "core/world/ground.h"

namespace sporeprint::api {

namespace {

/// A founder in a body.
struct FounderEntry {
    Text<48> species;
    double x = 0.0, y = 0.0;
    int year = spread_begin;

    static constexpr void fields(auto visit) {
        using F = FounderEntry;
        visit(&F::species, Info{.name = "species",
                                .most = 48,
                                .doc = "One of the fungi of the world. It then has no founders but "
                                       "those of this list."});
        visit(&F::x, Info{.name = "x",
                          .unit = "m",
                          .min = -2048,
                          .max = 2048,
                          .doc = "Its place, to the east of the centre of the world."});
        visit(&F::y, Info{.name = "y",
                          .unit = "m",
                          .min = -2048,
                          .max = 2048,
                          .doc = "Its place, to the north of the centre of the world."});
        visit(&F::year,
              Info{.name = "year",
                   .min = spread_begin,
                   .max = last_year,
                   .doc = "When it arrives. How far it has spread is computed in steps of "
                          "20 years from year 0 on, and linear between them."});
    }
    bool operator==(const FounderEntry&) const = default;
};
static_assert(well_described<FounderEntry>());

/// The members of a body are read into edits by the functions of this class.
class EditReader {
  public:
    EditReader(const WorldParams& world, const Atlas& atlas, ValidationErrors& errors)
        : world_(world), atlas_(atlas), errors_(errors) {
        std::vector<Problem> ignored;  // are reported where the world is read
        species_ = species_in(world.fungi.species, "", ignored);
    }

    void read_ecologies(const Value& json) {
        if (!is_object(json, "/ecology")) return;
        for (const auto& [id, members] : json.members()) {
            const std::string path = "/ecology/" + pointer_token(id);
            if (!lives_here(id, path)) continue;
            const AtlasEntry* const entry = atlas_.find(id);
            if (!entry) continue;
            SpeciesEcology own{entry->species.ecology, entry->species.facts.season};
            const SpeciesEcology usual = settled(own);
            std::vector<Problem> problems;
            sporeprint::read(members, own, Info{.name = ""}, path, problems);
            add_problems(problems, own, path, true, errors_);
            check_kinds(own.ecology, path);
            without_negative_zero(own);
            own = settled(std::move(own));
            if (own != usual) edits_.ecologies.emplace(id, std::move(own));
        }
    }

    void read_founders(const Value& json) {
        std::vector<FounderEntry> list;
        std::vector<Problem> problems;
        sporeprint::read(json, list, Info{.name = "founders", .most = most_founders}, "/founders",
                         problems);
        errors_.add(400, problems);
        if (!problems.empty()) return;
        without_negative_zero(list);
        const WorldBox extent = extent_of(world_);
        for (std::size_t i = 0; i < list.size(); ++i) {
            const FounderEntry& one = list[i];
            const std::string path = "/founders/" + std::to_string(i);
            if (one.species.empty())
                errors_.add(400, path + "/species", "is missing; give one of the fungi");
            else if (!lives_here(one.species.view(), path + "/species"))
                continue;
            check_inside(one.x, extent.west, extent.east, path + "/x");
            check_inside(one.y, extent.south, extent.north, path + "/y");
            edits_.founders[one.species.string()].push_back({one.x, one.y, one.year});
        }
    }

    void read_masks(const Value& json) {
        if (!is_object(json, "/masks")) return;
        std::vector<std::string> names = {mask_of_trees, mask_of_fungi};
        names.insert(names.end(), species_.begin(), species_.end());
        for (const auto& [name, image] : json.members()) {
            const std::string path = "/masks/" + pointer_token(name);
            if (std::ranges::find(names, name) == names.end())
                errors_.add(422, path, unknown_message(name, names));
            else if (!image.is_string())
                errors_.add(400, path, "expected base64 text, got " + shown(image));
            else
                read_mask(name, image.as_string(), path);
        }
    }

    [[nodiscard]] SharedEdits edits() {
        if (!errors_.empty()) return nullptr;
        WorldEdits out = settled(std::move(edits_));
        return out.empty() ? nullptr : std::make_shared<const WorldEdits>(std::move(out));
    }

  private:
    bool is_object(const Value& json, const char* path) {
        if (json.is_object()) return true;
        errors_.add(400, path, "expected an object, got " + shown(json));
        return false;
    }

    bool lives_here(std::string_view id, const std::string& path) {
        if (std::ranges::find(species_, id) != species_.end()) return true;
        errors_.add(422, path, not_of_world(id, species_));
        return false;
    }

    void check_kinds(const Ecology& ecology, const std::string& path) {
        for (std::size_t i = 0; i < ecology.trees.size(); ++i)
            if (!atlas_.find_tree(ecology.trees[i]))
                errors_.add(422, path + "/trees/" + std::to_string(i),
                            "there is no kind of tree " + in_quotes(ecology.trees[i]) +
                                "; those of /v1/trees are known");
    }

    void check_inside(double at, double least, double most, const std::string& path) {
        if (at < least || at > most)
            errors_.add(422, path,
                        number_text(at) + " is outside the world, which reaches from " +
                            number_text(least) + " to " + number_text(most));
    }

    void read_mask(const std::string& name, const std::string& text, const std::string& path) {
        bytes_ += text.size() / 4 * 3;
        if (bytes_ > most_mask_bytes)
            return errors_.add(422, path,
                               "the files of all masks have more than " +
                                   std::to_string(most_mask_bytes) + " bytes together");
        std::vector<std::uint8_t> file;
        if (!read_base64(text, file))
            return errors_.add(400, path, "this is not base64 (RFC 4648, padded, no white space)");
        try {
            const DeclaredSize size = declared_grey_size(file, most_mask_side, path);
            if (size.width != size.height)
                return errors_.add(422, path,
                                   "the image has " + std::to_string(size.width) + " x " +
                                       std::to_string(size.height) +
                                       " pixels; a mask is square, as a world is");
            pixels_ += static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.width);
            if (pixels_ > most_mask_pixels)
                return errors_.add(422, path,
                                   "all masks have more than " + std::to_string(most_mask_pixels) +
                                       " pixels together");
            GreyValues grey = decoded_grey(file, most_mask_side, path);
            edits_.masks.emplace(name, std::make_shared<const WorldMask>(WorldMask{
                                           world_.extent, grey.width, std::move(grey.values)}));
        } catch (const InvalidInput& refused) {
            errors_.add(422, refused.problems());
        }
    }

    const WorldParams& world_;
    const Atlas& atlas_;
    ValidationErrors& errors_;
    std::vector<std::string> species_;
    std::size_t bytes_ = 0, pixels_ = 0;
    WorldEdits edits_;
};

}  // namespace

SharedEdits take_edits(Value& body, const WorldParams& world, const Atlas& atlas,
                       ValidationErrors& errors) {
    EditReader reader(world, atlas, errors);
    if (const Value* const ecologies = body.find("ecology")) reader.read_ecologies(*ecologies);
    if (const Value* const founders = body.find("founders")) reader.read_founders(*founders);
    if (const Value* const masks = body.find("masks")) reader.read_masks(*masks);
    for (const char* name : {"ecology", "founders", "masks"}) body.erase(name);
    return reader.edits();
}

Value::Object edit_members() {
    Value ecology = schema<SpeciesEcology>(), founder = schema<FounderEntry>();
    // Without a default of its own, since that is what the atlas has of the species.
    const auto without_default = [](Value& one) { one.erase("default"); };
    each_schema(ecology, without_default);
    each_schema(founder, without_default);
    founder.set("required", Value(Value::Array{"species"}));
    const Value image = object({{"type", "string"}, {"contentEncoding", "base64"}});
    return {
        {"ecology",
         object({{"type", "object"},
                 {"description",
                  "Members of the ecology of species, by id, that replace those of the atlas; "
                  "months of fruiting too."},
                 {"additionalProperties", std::move(ecology)}})},
        {"founders",
         object({{"type", "array"},
                 {"maxItems", most_founders},
                 {"description",
                  "Where and when species arrive. A species of this list has these founders in "
                  "place of those that are drawn."},
                 {"items", std::move(founder)}})},
        {"masks",
         object({{"type", "object"},
                 {"description",
                  "Square PNG files, grey of 8 or 16 bits, at most 1024 pixels a side, over the "
                  "whole world, north up, by names: trees, fungi (all species), or the id of a "
                  "species. White leaves all, black nothing; each pixel is a square of ground."},
                 {"additionalProperties", image}})}};
}

}  // namespace sporeprint::api
