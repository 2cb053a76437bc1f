#include "api/products/presets.h"

namespace sporeprint::api {

namespace {

/// The rows of a body, if they are lists of numbers at all.
std::optional<RamificationMatrix> rows_of(const Value& given) {
    if (!given.is_array() || given.items().size() >= most_order) return std::nullopt;
    RamificationMatrix matrix;
    for (const Value& row : given.items()) {
        if (!row.is_array() || row.items().size() > most_order) return std::nullopt;
        std::vector<double>& entries = matrix.rows.emplace_back();
        for (const Value& entry : row.items()) {
            if (!entry.is_number()) return std::nullopt;
            entries.push_back(entry.as_number());
        }
    }
    return matrix;
}

bool says(const Value& body, const char* key, const char* text) {
    const Value* given = body.find(key);
    return given && given->is_string() && given->as_string() == text;
}

}  // namespace

void Trees::take_from_body(Value& body, ValidationErrors& errors) {
    const Value* given = body.find("rows");
    const std::optional<RamificationMatrix> matrix = given ? rows_of(*given) : std::nullopt;
    if (!matrix) return;  // what is wrong with the form of it, the reader says
    const char* own = name(MatrixKind::own);
    // No rows are what a tree without a matrix of its own has: its effective parameters say so.
    if (given->items().empty() && body.find("matrix") && !says(body, "matrix", own) &&
        !says(body, "toward", own) && !says(body, "tips", own))
        return;
    const bool requested =
        says(body, "matrix", own) || says(body, "toward", own) || says(body, "tips", own);
    if (!body.find("matrix") && !requested) body.set("matrix", own);
    if (says(body, "matrix", own)) {
        // What the preset blends with and how high it grows was said of its own matrix.
        if (!body.find("order")) body.set("order", matrix->order());
        if (!body.find("blend")) body.set("blend", 0.0);
    } else if (!requested) {
        errors.add(422, "/rows",
                   "rows count where matrix, toward or tips is 'own'; none of them is");
    }
    const std::vector<Problem> problems = validation_errors(*matrix, "/rows");
    errors.add(422, problems);
    if (problems.empty()) return;
    // One fault is not told twice: what follows is read as if nobody had asked for them.
    for (const char* key : {"matrix", "toward", "tips"})
        if (says(body, key, own)) body.erase(key);
    body.erase("rows");
}

bool Trees::has_address(const Order& spec) {
    const auto& rows = spec.params.look.shape.topology.rows;
    return rows.empty() || rows == own_params<Trees>(spec.preset).look.shape.topology.rows;
}

std::string Trees::more_templates() {
    static const std::string text = [] {
        std::string all;
        for (const LeafPreset& preset : leaf_presets())
            (all += ' ') += preset.id + canonical_text(params_of(preset));
        return all;
    }();
    return text;
}

}  // namespace sporeprint::api
