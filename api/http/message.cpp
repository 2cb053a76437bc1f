#include "api/http/message.h"

#include <algorithm>

#include "api/http/text.h"

namespace sporeprint::api {

namespace {

/// One count of a Cost, and its microseconds per unit.
struct Term {
    std::uint64_t Cost::*count;
    double microseconds;
};

/// Fitted to the processor times of about 450 requests to all routes, each on one thread with
/// nothing cached, in a release build of generator version 10; tests/api/costs_test.cpp checks them
/// against measurements.
constexpr Term terms[] = {
    {&Cost::base, 1.0},
    {&Cost::outlines, 500.0},  // one species alone 0.5 ms, two 1.6 ms, four 4 ms
    {&Cost::pairs, 500.0},
    {&Cost::individuals, 200.0},  // frames of a clip at lod=3
    {&Cost::branch_graphs, 650.0},
    {&Cost::vertices, 0.2},           // 0.15 for one that is only outline, 0.3 for scales and warts
    {&Cost::placed_vertices, 0.045},  // a tree of 240,000 takes 11 to 18 ms
    {&Cost::twigs, 1.6},
    {&Cost::members, 10.0},
    {&Cost::member_pairs, 0.65},
    {&Cost::solids, 9000.0},  // of a bolete 8 ms, of a chanterelle 19 ms
    {&Cost::atlases, 500.0},
    {&Cost::texels, 0.01},
    {&Cost::leaf_atlases, 200.0},  // 16 x 16 take 0.3 ms, 256 x 256 5 ms, 1024 x 1024 30 ms
    {&Cost::leaf_rows, 6.0},
    {&Cost::leaf_row_vertices, 1.0 / 300.0},  // a needle takes a fifth of a birch leaf
    {&Cost::leaf_texels, 0.005},
    {&Cost::bark_atlases, 2000.0},
    {&Cost::bark_texels, 0.025},  // 512 x 512 takes 11 to 36 ms: bark is noise of many octaves
    {&Cost::webp_texels, 0.04},
    {&Cost::pixels, 0.008},  // a PNG of 2048 x 2048 takes 26 ms when flat, 60 ms when noisy
    {&Cost::shadow_triangles, 0.03},
    {&Cost::samples, 0.03},
    {&Cost::impostor_triangles, 0.03},
    {&Cost::impostor_texels, 0.2},  // 392 x 392 seen take 40 ms, and 3,000,000 triangles 90 ms
    {&Cost::json_bytes, 0.005},
    {&Cost::json_values, 0.03},
    {&Cost::bytes, 1.0 / 2048.0},
    {&Cost::gzip_bytes, 0.017},  // zlib level 1: a tree of 8.6 MB takes 126 ms
};

}  // namespace

std::uint64_t Cost::work() const {
    double sum = 50.0;  // of every request
    for (const Term& term : terms)
        sum += term.microseconds * static_cast<double>(this->*term.count);
    return static_cast<std::uint64_t>(sum);
}

Cost& Cost::operator+=(const Cost& other) {
    for (const Term& term : terms) this->*term.count += other.*term.count;
    return *this;
}

Cost cost_of_json(std::string_view text) {
    // Commas and colons inside strings count too, so such bodies are charged too much.
    Cost cost;
    cost.json_bytes = text.size();
    for (const char c : text) cost.json_values += c == ',' || c == ':' ? 1 : 0;
    return cost;
}

std::string_view Request::header(std::string_view name) const {
    for (const auto& [key, value] : headers)
        if (same_word(key, name)) return value;
    return {};
}

}  // namespace sporeprint::api
