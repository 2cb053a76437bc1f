// Export and import of species with all their versions, byte for byte.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "api/library/species_text.h"
#include "api/library/tokens.h"
#include "api/products/library_handlers.h"
#include "core/params/messages.h"
#include "core/params/types.h"

namespace sporeprint::api {

namespace {

/// The format of an export, and what it is.
constexpr int export_format = 1;

Value exported(const Version& version) {
    Value images = Value::array();
    for (const Blob& blob : version.content.blobs)
        images.push(Value::object().set("place", blob.place).set("sha256", hex_of(blob.sha256)));
    return Value::object()
        .set("number", version.number)
        .set("made_s", version.made)
        .set("note", version.note)
        .set("format", version.content.format)
        .set("sha256", hex_of(version.content.hash))
        .set("text", version.content.text)
        .set("images", std::move(images));
}

/// Reads the members of an export, and reports what is missing or of another kind.
class ExportReader {
  public:
    ExportReader(const Value& json, std::string path, std::vector<Problem>& problems)
        : json_(json), path_(std::move(path)), problems_(problems) {}

    std::string text(const char* key) const {
        const Value* const value = json_.find(key);
        if (value && value->is_string()) return value->as_string();
        problem(key, value, "a text");
        return {};
    }

    std::int64_t integer(const char* key, std::int64_t least, std::int64_t most) const {
        const Value* const value = json_.find(key);
        if (value && value->is_number()) {
            const double number = value->as_number();
            if (number >= static_cast<double>(least) && number <= static_cast<double>(most) &&
                number == static_cast<double>(static_cast<std::int64_t>(number)))
                return static_cast<std::int64_t>(number);
        }
        problem(key, value,
                "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
        return least;
    }

    Value::Array list(const char* key) const {
        const Value* const value = json_.find(key);
        if (value && value->is_array()) return value->items();
        problem(key, value, "a list");
        return {};
    }

    /// Returns a text that has this SHA-256, in hexadecimal digits.
    Digest digest(const char* key, std::string_view bytes) const {
        const std::optional<Digest> stated = read_hex(text(key));
        if (!stated || *stated != sha256_of(bytes))
            report(problems_, path_ + '/' + key,
                   "is not the SHA-256 of the bytes, 64 hexadecimal digits; the export was changed "
                   "or damaged");
        return stated.value_or(Digest{});
    }

  private:
    void problem(const char* key, const Value* value, const std::string& wanted) const {
        report(problems_, path_ + '/' + key,
               value ? "is " + shown(*value) + "; expected is " + wanted
                     : "is missing; expected is " + wanted);
    }

    const Value& json_;
    std::string path_;
    std::vector<Problem>& problems_;
};

constexpr std::int64_t latest_time = std::int64_t{1} << 40U;

/// The images of an export by their SHA-256: versions have most of them in common.
using ExportedImages = std::map<Digest, std::vector<std::uint8_t>>;

/// Greatest number of images of a version: three for each of eight stages.
constexpr std::size_t most_images = 24;

ExportedImages read_images(const Value::Array& given, std::vector<Problem>& problems) {
    ExportedImages images;
    if (given.size() > most_images * (most_versions + 1)) {
        report(problems, "/images", std::to_string(given.size()) + " images are too many");
        return images;
    }
    for (std::size_t i = 0; i < given.size() && problems.size() < most_problems; ++i) {
        const std::string at = "/images/" + std::to_string(i);
        const ExportReader image(given[i], at, problems);
        std::vector<std::uint8_t> bytes;
        if (!read_base64(image.text("base64"), bytes))
            report(problems, at + "/base64", "is not base64 (RFC 4648, padded, no white space)");
        const Digest digest =
            image.digest("sha256", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        images.emplace(digest, std::move(bytes));
    }
    return images;
}

/// Returns true if two lists have the same images at the same places.
bool has_same_images(std::vector<Blob> a, std::vector<Blob> b) {
    const auto by_place = [](const Blob& one, const Blob& other) {
        return one.place < other.place;
    };
    std::sort(a.begin(), a.end(), by_place);
    std::sort(b.begin(), b.end(), by_place);
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Blob& one, const Blob& other) {
                          return one.place == other.place && one.sha256 == other.sha256;
                      });
}

Version read_version(const Value& json, const std::string& path, const std::string& name,
                     const ExportedImages& known, std::vector<Problem>& problems) {
    const std::size_t before = problems.size();
    const ExportReader reader(json, path, problems);
    Version version;
    version.number = static_cast<int>(reader.integer("number", 0, most_versions));
    version.made = reader.integer("made_s", 0, latest_time);
    version.note = reader.text("note");
    refuse_deceptive_texts(Value(version.note), path + "/note", problems);
    version.content.format = static_cast<int>(reader.integer("format", 1, species_format));
    version.content.text = reader.text("text");
    version.content.hash = reader.digest("sha256", version.content.text);
    if (version.note.size() > Text<200>::capacity)
        report(problems, path + "/note",
               "has " + std::to_string(version.note.size()) + " bytes; at most 200 are allowed");
    const Value::Array images = reader.list("images");
    if (images.size() > most_images)
        report(problems, path + "/images",
               std::to_string(images.size()) + " images; at most " + std::to_string(most_images) +
                   " are in one version");
    for (std::size_t i = 0; i < images.size() && i < most_images; ++i) {
        const std::string at = path + "/images/" + std::to_string(i);
        const ExportReader image(images[i], at, problems);
        const std::string place = image.text("place");
        const auto found = known.find(read_hex(image.text("sha256")).value_or(Digest{}));
        if (found == known.end())
            report(problems, at + "/sha256", "is that of no image of the export");
        else
            version.content.blobs.push_back({place, "", found->first, found->second});
    }
    if (problems.size() > before) return version;
    try {
        const Species species = species_of(version.content);
        if (species.id.view() != name)
            report(problems, path + "/text",
                   "its id is " + in_quotes(species.id.view()) + "; expected is the name, " +
                       in_quotes(name));
        refuse_deceptive_texts(write(species), path + "/text", problems);
        // The text is stored as it is, so it has to be what this program would have written.
        const Content again = content_of(species);
        if (version.content.format == species_format && again.hash != version.content.hash)
            report(problems, path + "/text", "is not the canonical text of its species");
        if (!has_same_images(version.content.blobs, again.blobs))
            report(problems, path + "/images", "are not those that the text names");
        version.content.blobs = again.blobs;
        version.content.kind = again.kind;
        version.content.title = again.title;
    } catch (const GenerationError& error) {
        report(problems, path + "/text", error.what());
    }
    return version;
}

}  // namespace

Response export_species(LibraryCall& call) {
    ValidationErrors errors;
    const LibraryName name = read_species(call.captured[0], false, errors);
    if (!errors.empty()) return call.problem(errors);
    if (!call.caller.is(name.owner)) return unseen(call, name);
    const std::optional<StoredDocument> document = call.records.document(name.owner, name.name);
    if (!document) return unseen(call, name);
    if (document->state == DocumentState::purged)
        return refused_write(call, WriteResult::purged, name);
    Value versions = Value::array(), images = Value::array();
    std::set<Digest> written;
    for (int number = 0; number <= document->newest; ++number)
        if (const std::optional<Version> version =
                call.records.version(name.owner, name.name, number)) {
            versions.push(exported(*version));
            for (const Blob& blob : version->content.blobs)
                if (written.insert(blob.sha256).second)
                    images.push(Value::object()
                                    .set("media", blob.media)
                                    .set("sha256", hex_of(blob.sha256))
                                    .set("base64", base64_text(blob.bytes)));
        }
    Response response = private_json(Value::object()
                                         .set("format", export_format)
                                         .set("owner", name.owner)
                                         .set("name", name.name)
                                         .set("state", api::name(document->state))
                                         .set("parent", document->parent)
                                         .set("parent2", document->parent2)
                                         .set("created_s", document->created)
                                         .set("updated_s", document->updated)
                                         .set("versions", std::move(versions))
                                         .set("images", std::move(images)));
    set_header(response, "Content-Disposition", "attachment; filename=\"" + name.name + ".json\"");
    return response;
}

Response import_species(LibraryCall& call) {
    ValidationErrors errors;
    const auto options = read_options<ImportOptions>(call, errors);
    const std::optional<Value> body = read_body(call.request.body, errors);
    if (!errors.empty()) return call.problem(errors);
    std::vector<Problem> problems;
    const ExportReader reader(*body, "", problems);
    reader.integer("format", 1, export_format);
    StoredDocument document;
    document.owner = call.caller.owner;
    document.name = reader.text("name");
    if (!is_species_name(document.name))
        report(problems, "/name",
               in_quotes(document.name) + " cannot be a name; allowed are " + name_grammar);
    const std::string state = reader.text("state");
    if (state == name(DocumentState::unlisted))
        document.state = DocumentState::unlisted;
    else if (state != name(DocumentState::active))
        report(problems, "/state", "is " + in_quotes(state) + "; allowed are active and unlisted");
    document.parent = reader.text("parent");
    document.parent2 = reader.text("parent2");
    for (const auto& [key, parent] :
         {std::pair("/parent", &document.parent), std::pair("/parent2", &document.parent2)})
        if (!parent->empty() && !read_library_name(*parent) && !invalid_id_message(*parent).empty())
            report(problems, key, in_quotes(*parent) + " is not the id of a species");
    document.created = reader.integer("created_s", 0, latest_time);
    document.updated = reader.integer("updated_s", 0, latest_time);
    const ExportedImages images = read_images(reader.list("images"), problems);
    std::vector<Version> versions;
    const Value::Array given = reader.list("versions");
    if (given.empty() || given.size() > static_cast<std::size_t>(most_versions) + 1)
        report(problems, "/versions",
               std::to_string(given.size()) + " versions; allowed are the draft and at most " +
                   std::to_string(most_versions) + " more");
    for (std::size_t i = 0; i < given.size() && problems.size() < most_problems; ++i) {
        const std::string path = "/versions/" + std::to_string(i);
        versions.push_back(read_version(given[i], path, document.name, images, problems));
        if (versions.back().number != static_cast<int>(i))
            report(problems, path + "/number",
                   "is " + std::to_string(versions.back().number) +
                       "; the draft is 0 and the first, and the others are counted from 1");
    }
    errors.add(400, problems);
    if (!errors.empty()) return call.problem(errors);
    const LibraryName name{document.owner, document.name};
    Value result = Value::object();
    result.set("id", text_of(name)).set("newest", static_cast<int>(versions.size()) - 1);
    result.set("written", !options.dry_run);
    if (options.dry_run) {
        if (call.records.document(name.owner, name.name))
            return refused_write(call, WriteResult::taken, name);
        return private_json(result);
    }
    const Written written = call.records.restore(document, versions);
    if (written.result != WriteResult::done) return refused_write(call, written.result, name);
    call.library.refresh();
    Response response = private_json(result, 201);
    set_header(response, "Location", call.responses().link("/v1/library/" + text_of(name)));
    return response;
}

}  // namespace sporeprint::api
