#include "server/http/hot_table.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "api/http/encoding.h"

namespace sporeprint::server {

namespace {

constexpr std::size_t entry_overhead = 512;         ///< bytes of an entry beyond its contents
constexpr std::size_t least_file_size = 32u << 10;  ///< bytes; copying less is cheaper than a file
constexpr std::uint32_t bypass_every = 256;         ///< uses of an entry

/// Returns an in-memory file with these bytes; -1 on failure, or if fewer than half of the
/// descriptors would be left to connections.
int file_of(const Body& body) {
    const int file = memfd_create("answer", MFD_CLOEXEC);
    if (file < 0) return -1;
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 ||
        static_cast<rlim_t>(file) >= limit.rlim_cur / 2) {  // the lowest free number
        ::close(file);
        return -1;
    }
    for (const Slice& slice : body)
        for (std::size_t done = 0; done < slice.size;) {
            const ssize_t wrote = ::write(file, slice.data() + done, slice.size - done);
            if (wrote <= 0) {
                ::close(file);
                return -1;
            }
            done += static_cast<std::size_t>(wrote);
        }
    return file;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view one) { return same_token(name, one); });
}

}  // namespace

HotResponse::~HotResponse() {
    if (file >= 0) ::close(file);
}

std::size_t HotResponse::weight() const {
    return size + body.size() * sizeof(Slice) + 2 * target.size() + head.size() +
           not_modified.size() + etag.size() + entry_overhead;
}

std::shared_ptr<const HotResponse> hot_response(std::string_view target, const Sending& sending,
                                                std::string_view label) {
    const api::Response& response = sending.response;
    if (!response.cacheable || response.status != 200 || !response.has_body || sending.closing ||
        sending.head.empty())
        return nullptr;
    auto hot = std::make_shared<HotResponse>();
    hot->target = target;
    hot->label = label;
    std::string_view rest = sending.head;
    const auto next_line = [&rest] {
        const std::size_t end = rest.find("\r\n") + 2;
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end);
        return line;
    };
    hot->head = next_line();
    hot->not_modified = "HTTP/1.1 304 Not Modified\r\n";
    while (rest.size() > 2) {
        const std::string_view line = next_line();
        const std::string_view name = line.substr(0, line.find(':'));
        const std::string_view value = line.substr(name.size() + 2, line.size() - name.size() - 4);
        if (same_token(name, "Vary")) {
            if (!same_token(value, "Accept-Encoding")) return nullptr;
            if (hot->coding == Coding::any) hot->coding = Coding::identity;
        }
        if (same_token(name, "Content-Encoding")) hot->coding = Coding::gzip;
        if (same_token(name, "X-Request-Id")) {
            hot->has_request_id = true;
        } else if (same_token(name, "Keep-Alive")) {
            hot->keep_alive = line;
        } else if (!same_token(name, "Date")) {
            hot->head += line;
            if (same_token(name, "ETag")) hot->etag = value;
            if (same_token(name, "Cache-Status")) {
                hot->cache = value;
                hot->cache_not_modified = hot->cache + "; detail=not-modified";
                ((hot->not_modified += "Cache-Status: ") += hot->cache_not_modified) += "\r\n";
            } else if (!is_one_of(name, {"Content-Type", "Content-Disposition", "Content-Encoding",
                                         "Content-Length", "Accept-Ranges"})) {
                hot->not_modified += line;
            }
        }
    }
    if (hot->etag.empty()) hot->not_modified.clear();
    constexpr std::string_view of_gzip = "-gz\"";
    if (hot->coding == Coding::gzip && hot->etag.ends_with(of_gzip))
        hot->identity_etag = hot->etag.substr(0, hot->etag.size() - of_gzip.size()) + '"';
    hot->size = size_of(response.body);
    if (hot->size >= least_file_size) hot->file = file_of(response.body);
    if (hot->file < 0) hot->body = response.body;
    return hot;
}

HotLookup hot_lookup(const Head& head) {
    HotLookup lookup;
    if ((head.method != "GET" && head.method != "HEAD") || head.content_length.value_or(0) > 0)
        return lookup;
    for (const auto& [name, value] : head.headers) {
        switch (name[0] | 0x20) {  // in lower case
            case 'a':
                if (same_token(name, "Accept-Encoding")) {
                    if (!lookup.accept_encoding.empty()) return lookup;
                    lookup.accept_encoding = value;
                }
                break;
            case 'c':  // the service handles requests for a fresh response
                if (same_token(name, "Cache-Control")) return lookup;
                break;
            case 'e':
                if (same_token(name, "Expect")) return lookup;
                break;
            case 'i':
                if (same_token(name, "If-None-Match")) {
                    if (lookup.line.empty()) {
                        lookup.line = value;
                    } else {
                        if (lookup.lines.empty()) lookup.lines = lookup.line;
                        (lookup.lines += ", ") += value;
                    }
                } else if (same_token(std::string_view(name).substr(0, 3), "If-")) {
                    return lookup;
                }
                break;
            case 'p':
                if (same_token(name, "Pragma")) return lookup;
                break;
            case 'r':
                if (same_token(name, "Range")) return lookup;
                break;
            case 'x':
                if (lookup.id.empty() && same_token(name, "X-Request-Id")) lookup.id = value;
                break;
            default:
                break;
        }
    }
    lookup.simple = true;
    return lookup;
}

const std::shared_ptr<const HotResponse>* HotTable::find(std::string_view target,
                                                         std::string_view accept_encoding) {
    const auto found = map_.find(target);
    if (found == map_.end()) return nullptr;
    const Variants& variants = found->second;
    // Most responses are for all clients; then Accept-Encoding is not parsed.
    const bool gzip = variants.identity != variants.gzip && api::accepts_gzip(accept_encoding);
    const std::optional<List::iterator>& variant = gzip ? variants.gzip : variants.identity;
    if (!variant) return nullptr;
    Entry& entry = **variant;
    entry.visited = true;
    if (!entry.pinned && ++entry.uses % bypass_every == 0) return nullptr;
    return &entry.response;
}

bool HotTable::is_pinned(std::string_view target) const {
    const auto found = map_.find(target);
    return found != map_.end() && found->second.identity && (*found->second.identity)->pinned;
}

void HotTable::insert(std::shared_ptr<const HotResponse> response) {
    if (is_pinned(response->target)) return;
    const auto replaced = [&](std::optional<List::iterator> Variants::*variant) {
        const auto found = map_.find(response->target);
        if (found != map_.end() && found->second.*variant) drop(*(found->second.*variant));
    };
    if (response->coding != Coding::gzip) replaced(&Variants::identity);
    if (response->coding != Coding::identity) replaced(&Variants::gzip);
    const std::size_t weight = response->weight();
    if (weight > budget_ / 8) return;
    while (stats_.bytes + weight > budget_) evict();
    add(std::move(response), weight, false);
}

void HotTable::insert_pinned(std::shared_ptr<const HotResponse> response) {
    add(std::move(response), 0, true);
}

void HotTable::clear() {
    while (!list_.empty()) drop(list_.begin());
}

void HotTable::add(std::shared_ptr<const HotResponse> response, std::size_t weight, bool pinned) {
    List& list = pinned ? pinned_ : list_;
    list.push_front({std::move(response), weight, 0, false, pinned});
    const HotResponse& added = *list.front().response;
    Variants& variants = map_[added.target];
    if (added.coding != Coding::gzip) variants.identity = list.begin();
    if (added.coding != Coding::identity) variants.gzip = list.begin();
    stats_.bytes += weight;
    stats_.entries += pinned ? 0 : 1;
}

void HotTable::drop(List::iterator entry) {
    if (hand_ == entry) hand_ = entry == list_.begin() ? list_.end() : std::prev(entry);
    // The key may point into the removed response; it is replaced by that of the remaining variant.
    auto node = map_.extract(entry->response->target);
    Variants& variants = node.mapped();
    if (variants.identity == entry) variants.identity.reset();
    if (variants.gzip == entry) variants.gzip.reset();
    if (const auto& other = variants.identity ? variants.identity : variants.gzip) {
        node.key() = (*other)->response->target;
        map_.insert(std::move(node));
    }
    stats_.bytes -= entry->weight;
    --stats_.entries;
    list_.erase(entry);
}

void HotTable::evict() {
    for (;;) {
        if (hand_ == list_.end()) hand_ = std::prev(list_.end());
        if (!hand_->visited) break;
        hand_->visited = false;
        hand_ = hand_ == list_.begin() ? list_.end() : std::prev(hand_);
    }
    ++stats_.evictions;
    drop(hand_);
}

}  // namespace sporeprint::server
