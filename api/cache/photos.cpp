#include "api/cache/photos.h"

#include <algorithm>
#include <utility>

#include "api/http/random.h"

namespace sporeprint::api {

namespace {

/// Returns the size of a cut: a working copy of three bytes a pixel, and a mask of one.
std::size_t cut_bytes(const StoredPhoto& photo) {
    const trace::PictureSize size =
        trace::reduced_size(photo.width, photo.height, trace::large_side);
    return 4 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

}  // namespace

void Photos::drop_expired(Time now) {
    while (!entries_.empty() && entries_.front().expires <= now) {
        bytes_ -= entries_.front().bytes;
        entries_.pop_front();
    }
}

std::list<Photos::Entry>::iterator Photos::entry(std::string_view name, Time now) {
    drop_expired(now);
    return std::find_if(entries_.begin(), entries_.end(),
                        [&](const Entry& one) { return one.name == name; });
}

std::string Photos::insert(StoredPhoto photo, Time now) {
    const std::size_t bytes =
        photo.jpeg.size + cut_bytes(photo) + (photo.cut_out ? photo.cut_out->inside.size() : 0);
    Entry added{random_name(), std::make_shared<const StoredPhoto>(std::move(photo)), nullptr,
                bytes, now + lifetime};
    std::string name = added.name;
    const std::lock_guard lock(mutex_);
    drop_expired(now);
    entries_.push_back(std::move(added));
    bytes_ += bytes;
    while (bytes_ > most_bytes_ && entries_.size() > 1) {
        bytes_ -= entries_.front().bytes;
        entries_.pop_front();
    }
    return name;
}

std::shared_ptr<const StoredPhoto> Photos::find(std::string_view name, Time now) {
    const std::lock_guard lock(mutex_);
    const auto found = entry(name, now);
    return found == entries_.end() ? nullptr : found->photo;
}

bool Photos::erase(std::string_view name, Time now) {
    const std::lock_guard lock(mutex_);
    const auto found = entry(name, now);
    if (found == entries_.end()) return false;
    bytes_ -= found->bytes;
    entries_.erase(found);
    return true;
}

std::shared_ptr<const StoredCut> Photos::cut(std::string_view name, std::string_view gesture,
                                             Time now) {
    std::shared_ptr<const StoredCut> last = last_cut(name, now);
    return last && last->gesture == gesture ? last : nullptr;
}

std::shared_ptr<const StoredCut> Photos::last_cut(std::string_view name, Time now) {
    const std::lock_guard lock(mutex_);
    const auto found = entry(name, now);
    return found == entries_.end() ? nullptr : found->cut;
}

void Photos::store_cut(std::string_view name, std::shared_ptr<const StoredCut> cut, Time now) {
    const std::lock_guard lock(mutex_);
    const auto found = entry(name, now);
    if (found != entries_.end()) found->cut = std::move(cut);
}

std::size_t Photos::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

}  // namespace sporeprint::api
