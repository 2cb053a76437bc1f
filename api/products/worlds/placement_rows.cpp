#include "api/products/worlds/placement_rows.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "core/grow/world/plot_parts.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

const std::string& species_of(const Placement& row, const PlacementNames& names) {
    return (row.kind == PlacementKind::fungus ? names.species : names.kinds)[row.species];
}

std::string substrate_of(const Placement& row, const PlacementNames& names) {
    if (row.kind != PlacementKind::fungus) return {};
    return row.trunk != 0 ? names.kinds[row.wood] : names.substrates[row.species];
}

double rounded_age(const Placement& row) { return std::round(row.age * 100.0) / 100.0; }

/// Returns the address of the individual's model; empty for dead wood.
std::string model_of(const Placement& row, const PlacementNames& names) {
    if (row.kind == PlacementKind::tree)
        return names.trees[row.species * tree_shapes_of_kind + row.seed - 1];
    if (row.kind != PlacementKind::fungus) return {};
    return names.folder + names.species[row.species] + model_of_body(row.seed, rounded_age(row));
}

/// Returns a moment in days since the beginning of year 0.
double days_of(WorldTime time) { return static_cast<double>(time) / ticks_of_day; }

/// Appends numbers with fixed numbers of digits to a line of CSV.
class CsvLine {
  public:
    explicit CsvLine(std::string& out) : out_(out) {}
    CsvLine& text(std::string_view value) {
        if (!is_first_) out_ += ',';
        is_first_ = false;
        out_ += value;
        return *this;
    }
    CsvLine& number(double value, int digits) {
        std::array<char, 40> buffer{};
        const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                       std::chars_format::fixed, digits);
        std::string_view digits_of(buffer.data(),
                                   static_cast<std::size_t>(end.ptr - buffer.data()));
        const bool is_zero = digits_of.find_first_not_of("-0.") == std::string_view::npos;
        if (is_zero && digits_of.starts_with('-')) digits_of.remove_prefix(1);
        return text(digits_of);
    }
    CsvLine& number_if(bool is_there, double value, int digits) {
        return is_there ? number(value, digits) : text("");
    }

  private:
    std::string& out_;
    bool is_first_ = true;
};

double rounded(double value, double steps) { return std::round(value * steps) / steps + 0.0; }

Value row_value(const Placement& row, const PlacementNames& names) {
    const auto list = [](const auto& vector, int count, double steps) {
        Value::Array numbers;
        for (int i = 0; i < count; ++i) numbers.emplace_back(rounded(vector[i], steps));
        return Value(std::move(numbers));
    };
    Value value = Value::object()
                      .set("id", id_text(row.id))
                      .set("kind", name(row.kind))
                      .set("species", species_of(row, names))
                      .set("translation", list(row.place.translation, 3, 1e3))
                      .set("rotation", list(row.place.rotation, 4, 1e5))
                      .set("scale", list(row.place.scale, 3, 1e4))
                      .set("began_day", days_of(row.began));
    if (row.kind == PlacementKind::fungus) {
        value.set("age", rounded_age(row)).set("substrate", substrate_of(row, names));
        if (row.host) value.set("host", id_text(row.host));
        if (row.trunk) value.set("trunk", id_text(row.trunk));
    } else {
        value.set("length_m", rounded(row.length, 1e2))
            .set("diameter_m", rounded(row.diameter, 1e3));
    }
    if (const std::string model = model_of(row, names); !model.empty()) value.set("model", model);
    return value;
}

/// Appends numbers, low byte first.
class LittleEndian {
  public:
    explicit LittleEndian(std::string& out) : out_(out) {}
    void u64(std::uint64_t value) { bytes(value, 8); }
    void u32(std::uint32_t value) { bytes(value, 4); }
    void u16(std::uint16_t value) { bytes(value, 2); }
    void u8(std::uint8_t value) { bytes(value, 1); }
    void f32(double value) { u32(std::bit_cast<std::uint32_t>(static_cast<float>(value) + 0.0F)); }

  private:
    void bytes(std::uint64_t value, int count) {
        for (int i = 0; i < count; ++i) out_ += static_cast<char>(value >> (8 * i) & 255U);
    }
    std::string& out_;
};

constexpr std::uint32_t bytes_of_head = 24, bytes_of_row = 88;

}  // namespace

/// Returns what fungi of a guild that are not on a trunk stand on.
const char* ground_of_guild(Guild guild) {
    switch (guild) {
        case Guild::ectomycorrhizal:
            return "soil";
        case Guild::litter:
            return "litter";
        case Guild::grass:
            return "turf";
        case Guild::wood:
            return "wood";
    }
    return "";
}

std::string model_of_body(std::uint32_t seed, double age) {
    return ".glb?seed=" + std::to_string(seed) + "&age=" + number_text(age) + "&substrate=none";
}

std::string csv_of(std::span<const Placement> rows, const PlacementNames& names) {
    std::string out =
        "id,kind,species,x,y,z,qx,qy,qz,qw,sx,sy,sz,length,diameter,began,age,substrate,host,trunk,"
        "model\r\n";
    out.reserve(out.size() + rows.size() * 220);
    for (const Placement& row : rows) {
        const bool is_fungus = row.kind == PlacementKind::fungus;
        CsvLine line(out);
        line.text(id_text(row.id)).text(name(row.kind)).text(species_of(row, names));
        for (int i = 0; i < 3; ++i) line.number(row.place.translation[i], 3);
        for (int i = 0; i < 4; ++i) line.number(row.place.rotation[i], 5);
        for (int i = 0; i < 3; ++i) line.number(row.place.scale[i], 4);
        line.number_if(!is_fungus, row.length, 2).number_if(!is_fungus, row.diameter, 3);
        line.number(days_of(row.began), 4).number_if(is_fungus, row.age, 2);
        line.text(substrate_of(row, names));
        line.text(row.host ? id_text(row.host) : "").text(row.trunk ? id_text(row.trunk) : "");
        line.text(model_of(row, names));
        out += "\r\n";
    }
    return out;
}

// Row by row, since a Value of all would take several times the memory of the text.
std::string json_of(std::span<const Placement> rows, const PlacementNames& names, Value head) {
    head.set("count", rows.size());
    std::string out = dump(head);
    out.erase(out.rfind('}'));
    out += ",\"placements\":[";
    for (const Placement& row : rows) {
        if (&row != rows.data()) out += ',';
        out += dump(row_value(row, names));
    }
    return out += "]}";
}

// A head of 24 bytes, rows of 88 bytes, and JSON with the names that they refer to; README.md has the table.
std::string bin_of(std::span<const Placement> rows, const PlacementNames& names) {
    const auto list = [](const std::vector<std::string>& texts) {
        return Value(Value::Array(texts.begin(), texts.end()));
    };
    const std::string words = dump(Value::object()
                                       .set("kinds", list(names.kinds))
                                       .set("species", list(names.species))
                                       .set("trees", list(names.trees))
                                       .set("mushrooms", names.folder));
    const auto count = static_cast<std::uint32_t>(rows.size());
    std::string out = "SPPL";
    out.reserve(bytes_of_head + std::size_t{bytes_of_row} * count + words.size());
    LittleEndian write(out);
    write.u32(1);  // version of the format
    write.u32(count);
    write.u32(bytes_of_row);
    write.u32(bytes_of_head + bytes_of_row * count);
    write.u32(static_cast<std::uint32_t>(words.size()));
    for (const Placement& row : rows) {
        write.u64(row.id);
        write.u64(row.host);
        write.u64(row.trunk);
        for (int i = 0; i < 3; ++i) write.f32(row.place.translation[i]);
        for (int i = 0; i < 4; ++i) write.f32(row.place.rotation[i]);
        for (int i = 0; i < 3; ++i) write.f32(row.place.scale[i]);
        write.f32(row.length);
        write.f32(row.diameter);
        write.f32(days_of(row.began));
        write.f32(row.age);
        write.u32(row.seed);
        write.u8(static_cast<std::uint8_t>(row.kind));
        write.u8(row.species);
        write.u16(row.wood);
    }
    return out += words;
}

const char* ending_of(PlacementFile file) {
    switch (file) {
        case PlacementFile::csv:
            return ".csv";
        case PlacementFile::json:
            return ".json";
        case PlacementFile::bin:
            return ".bin";
    }
    return "";
}

const char* type_of(PlacementFile file) {
    switch (file) {
        case PlacementFile::csv:
            return "text/csv";
        case PlacementFile::json:
            return "application/json";
        case PlacementFile::bin:
            return "application/octet-stream";
    }
    return "";
}

}  // namespace sporeprint::api
