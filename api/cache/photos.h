// Photographs that clients upload to be traced: in memory, for half an hour, and nowhere else.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/bytes.h"
#include "core/trace/photo.h"

namespace sporeprint::api {

/// An uploaded photograph as it is stored: pixels that this service has encoded again, without metadata.
struct StoredPhoto {
    Slice jpeg;
    int width = 0, height = 0;
    /// The mushroom on a picture that is cut out already; its size may be less than that of the photograph.
    std::optional<trace::Mask> cut_out;
};

/// The mushroom that a gesture has cut out of a photograph, and the working copy that it was cut out of.
struct StoredCut {
    std::string gesture;  ///< canonical text
    Picture picture;
    trace::Mask mask;
};

/// Photographs by secret names: whoever knows the name of one may see it, and nobody can guess it. The oldest
/// are dropped when there are too many. Thread-safe.
class Photos {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// How long a photograph is stored.
    static constexpr std::chrono::seconds lifetime{1800};

    /// Characters of a name: 128 random bits in base64url.
    static constexpr std::size_t name_length = 22;

    /// most_bytes  of all photographs together
    explicit Photos(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    /// Stores a photograph until `now` + lifetime.
    ///
    /// returns  its name
    /// throws   std::runtime_error if the system has no random numbers
    [[nodiscard]] std::string insert(StoredPhoto photo, Time now);

    /// Returns a photograph; nullptr if there is none with this name, or no longer.
    [[nodiscard]] std::shared_ptr<const StoredPhoto> find(std::string_view name, Time now);

    /// Forgets a photograph. Returns false if there is none.
    bool erase(std::string_view name, Time now);

    /// Returns what a gesture has cut out of a photograph, if that was the last one; nullptr otherwise.
    [[nodiscard]] std::shared_ptr<const StoredCut> cut(std::string_view name,
                                                       std::string_view gesture, Time now);

    /// Returns what the last gesture has cut out of a photograph; nullptr if there was none.
    [[nodiscard]] std::shared_ptr<const StoredCut> last_cut(std::string_view name, Time now);

    /// Stores the last cut of a photograph, if that is still there.
    void store_cut(std::string_view name, std::shared_ptr<const StoredCut> cut, Time now);

    /// Returns the bytes that are stored and their greatest sum.
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] std::size_t most_bytes() const { return most_bytes_; }

  private:
    struct Entry {
        std::string name;
        std::shared_ptr<const StoredPhoto> photo;
        std::shared_ptr<const StoredCut> cut;
        std::size_t bytes = 0;  ///< with its last cut
        Time expires;
    };

    std::size_t most_bytes_;
    mutable std::mutex mutex_;
    std::list<Entry> entries_;  ///< from the oldest to the newest; a few dozen
    std::size_t bytes_ = 0;

    void drop_expired(Time now);
    [[nodiscard]] std::list<Entry>::iterator entry(std::string_view name, Time now);
};

}  // namespace sporeprint::api
