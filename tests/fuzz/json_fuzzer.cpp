// Fuzzes JSON bodies: parsed, read as a Model, written, and read again.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/model/model.h"
#include "core/params/canonical.h"
#include "core/params/reader.h"
#include "core/params/value.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    std::vector<Problem> problems;
    const Value json = parse(text, problems);
    if (!problems.empty()) return 0;
    expect(text.find('\0') == std::string_view::npos, "a zero byte is no JSON");

    const std::string own = dump(json);
    const Value again = parse(own, problems);
    expect(problems.empty() && dump(again) == own, "what we write reads back the same");

    const Model model = read_all<Model>(json, problems);
    check(model, Info{.name = ""}, "", problems);
    if (!problems.empty()) return 0;
    const Model copy = read_all<Model>(write(model), problems);
    std::string before, after;
    canonical(model, before);
    canonical(copy, after);
    expect(problems.empty() && before == after, "a written model reads back the same");
    return 0;
}
