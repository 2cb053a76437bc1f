#include "api/http/compression.h"

#include <zlib.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "api/http/encoding.h"
#include "api/http/ranges.h"
#include "api/http/response_builder.h"
#include "core/params/value.h"
#include "core/problems.h"

namespace sporeprint::api {

namespace {

/// Smaller files are generated while a control is dragged.
constexpr std::size_t least_bytes = 1u << 20;
/// The images of a file that is compressed are less than this fraction of it, since gzip does not
/// make them smaller: a mushroom with images of 1024 texels would cost 37 ms more for a fifth of
/// its bytes.
constexpr std::size_t mesh_shares = 6;
constexpr std::size_t block = 512u << 10;  ///< bytes of input that are compressed independently
/// Offset after the headers of the GLB and of its JSON chunk.
constexpr std::size_t chunk_begins = 20;

/// zlib level. A tree of 8.6 MB takes 126 ms at level 1 and shrinks to 56.0 %, 171 ms at level 4
/// and 55.2 %, 285 ms at level 6 and 55.5 %; a mushroom without images of 0.9 MB takes 18, 22 and
/// 22 ms and shrinks to 70.5, 69.9 and 69.9 %.
constexpr int level = 1;

/// Returns `size` bytes of a body from `begin` on, fewer at its end.
std::string text_at(const Body& body, std::size_t begin, std::size_t size) {
    std::string text;
    for (const Slice& slice : body) {
        if (begin >= slice.size) {
            begin -= slice.size;
            continue;
        }
        const std::size_t taken = std::min(slice.size - begin, size - text.size());
        text.append(reinterpret_cast<const char*>(slice.data()) + begin, taken);
        begin = 0;
        if (text.size() == size) break;
    }
    return text;
}

/// Returns the number of bytes of the images that a GLB embeds.
std::size_t image_bytes(const Body& glb) {
    const std::string header = text_at(glb, 0, chunk_begins);
    if (header.size() < chunk_begins) return 0;
    std::size_t length = 0;
    for (std::size_t i = 4; i-- > 0;)
        length = length << 8 | static_cast<unsigned char>(header[12 + i]);
    std::vector<Problem> problems;
    const Value document = parse(text_at(glb, chunk_begins, length), problems);
    const Value* const images = document.find("images");
    const Value* const views = document.find("bufferViews");
    if (!problems.empty() || !images || !views) return 0;
    std::size_t sum = 0;
    for (const Value& image : images->items())
        if (const Value* const view = image.find("bufferView"))
            sum += static_cast<std::size_t>(views->items()
                                                .at(static_cast<std::size_t>(view->as_number()))
                                                .find("byteLength")
                                                ->as_number());
    return sum;
}

/// Returns a block as raw deflate, to which the next block can be appended.
Bytes deflated(const Body& input, bool is_last) {
    z_stream stream{};
    if (deflateInit2(&stream, level, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    Bytes out(deflateBound(&stream, static_cast<uLong>(size_of(input))) + 16);
    stream.next_out = out.data();
    stream.avail_out = static_cast<uInt>(out.size());
    for (const Slice& slice : input) {
        stream.next_in = const_cast<Bytef*>(slice.data());
        stream.avail_in = static_cast<uInt>(slice.size);
        deflate(&stream, Z_NO_FLUSH);
    }
    deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    out.shrink_to_fit();
    return out;
}

void append_little_endian(Bytes& bytes, std::uint64_t value) {
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

}  // namespace

bool is_worth_gzip(const Body& glb) {
    const std::size_t size = size_of(glb);
    return size >= least_bytes && image_bytes(glb) * mesh_shares < size;
}

Cost gzip_cost(std::uint64_t bytes) { return {.gzip_bytes = bytes}; }

Cost gzip_cost_of_glb(const Cost& estimate) {
    constexpr std::uint64_t bytes_of_a_vertex = 60;
    const std::uint64_t mesh_bytes =
        bytes_of_a_vertex * (estimate.vertices + estimate.placed_vertices);
    const bool is_mostly_mesh = mesh_bytes * mesh_shares > estimate.bytes * (mesh_shares - 1);
    return estimate.bytes >= least_bytes && is_mostly_mesh ? gzip_cost(estimate.bytes) : Cost{};
}

Body gzip_glb(const Body& glb, const std::stop_token& stop, const Parallel& parallel) {
    struct Block {
        Body input;
        Bytes output;
        uLong checksum = 0;
    };
    const std::size_t size = size_of(glb);
    std::vector<Block> blocks;
    blocks.reserve(size / block + 1);
    for (std::size_t at = 0; at == 0 || at < size; at += block)
        blocks.push_back({part_of(glb, {at, std::min(block, size - at)}), {}, 0});
    std::vector<std::function<void()>> pieces;
    pieces.reserve(blocks.size());
    for (Block& one : blocks)
        pieces.emplace_back([&one, &stop, is_last = &one == &blocks.back()] {
            if (stop.stop_requested()) throw Cancelled();
            one.checksum = crc32(0, nullptr, 0);
            for (const Slice& slice : one.input)
                one.checksum = crc32(one.checksum, slice.data(), static_cast<uInt>(slice.size));
            one.output = deflated(one.input, is_last);
        });
    parallel(pieces);

    // A single gzip member, without name and time: some clients read only the first member.
    Bytes header = {0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 4, 255}, trailer;
    Body out{Slice(std::make_shared<const Bytes>(std::move(header)))};
    uLong checksum = crc32(0, nullptr, 0);
    out.reserve(blocks.size() + 2);
    for (Block& one : blocks) {
        checksum = crc32_combine(checksum, one.checksum, static_cast<z_off_t>(size_of(one.input)));
        out.emplace_back(std::make_shared<const Bytes>(std::move(one.output)));
    }
    append_little_endian(trailer, checksum);
    append_little_endian(trailer, size);
    out.emplace_back(std::make_shared<const Bytes>(std::move(trailer)));
    return out;
}

Key gzip_key(const Key& key) { return key + "\ngzip"; }

void select_gzip(Response& response) {
    response.body = std::exchange(response.gzipped, {});
    set_header(response, "ETag", gzip_etag(header_of(response, "ETag")));
    set_header(response, "Content-Encoding", "gzip");
}

}  // namespace sporeprint::api
