// Points of a scene by cells of space, so that those near a place are found quickly.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace sporeprint {

/// Numbered points in cubic cells. The order in which points are visited depends on that in which they were inserted,
/// and on nothing else.
class PointGrid {
  public:
    /// side      of a cell, metres, greater than 0
    /// expected  about how many points there will be
    explicit PointGrid(double side = 1.0, std::size_t expected = 0) : side_(side) {
        std::size_t slots = 16;
        while (slots < 2 * expected) slots *= 2;
        slots_.resize(slots);
        entries_.reserve(expected);
    }

    void insert(const glm::dvec3& at, std::uint32_t number) {
        if (2 * (used_ + 1) > slots_.size()) grow();
        Slot& slot = slots_[slot_of(cell_of(at))];
        if (slot.head == none) {
            slot.cell = cell_of(at);
            ++used_;
        }
        entries_.push_back({number, slot.head});
        slot.head = static_cast<std::uint32_t>(entries_.size() - 1);
    }

    /// Calls visit(number) for all points within a radius of a place, and for some that are a little farther.
    template <class Visit>
    void each_near(const glm::dvec3& at, double radius, const Visit& visit) const {
        const Cell low = cell_of(at - glm::dvec3(radius)), high = cell_of(at + glm::dvec3(radius));
        for (std::int32_t x = low[0]; x <= high[0]; ++x)
            for (std::int32_t y = low[1]; y <= high[1]; ++y)
                for (std::int32_t z = low[2]; z <= high[2]; ++z)
                    for (std::uint32_t i = slots_[slot_of({x, y, z})].head; i != none;
                         i = entries_[i].next)
                        visit(entries_[i].number);
    }

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const {
        return slots_.size() * sizeof(Slot) + entries_.size() * sizeof(Entry);
    }

  private:
    using Cell = std::array<std::int32_t, 3>;
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    struct Slot {
        Cell cell{};
        std::uint32_t head = none;
    };
    struct Entry {
        std::uint32_t number, next;
    };

    [[nodiscard]] Cell cell_of(const glm::dvec3& at) const {
        const auto along = [&](double metres) {
            return static_cast<std::int32_t>(std::floor(metres / side_));
        };
        return {along(at.x), along(at.y), along(at.z)};
    }

    /// Returns the slot of a cell, or the empty one where it would be.
    [[nodiscard]] std::size_t slot_of(const Cell& cell) const {
        std::uint64_t hash = 0x9E3779B97F4A7C15U;
        for (const std::int32_t part : cell) {
            hash ^= static_cast<std::uint32_t>(part);
            hash *= 0xFF51AFD7ED558CCDU;
            hash ^= hash >> 32U;
        }
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = static_cast<std::size_t>(hash) & mask;
        while (slots_[at].head != none && slots_[at].cell != cell) at = (at + 1) & mask;
        return at;
    }

    void grow() {
        std::vector<Slot> old(2 * slots_.size());
        old.swap(slots_);
        for (const Slot& slot : old)
            if (slot.head != none) slots_[slot_of(slot.cell)] = slot;
    }

    double side_;
    std::size_t used_ = 0;
    std::vector<Slot> slots_;
    std::vector<Entry> entries_;
};

}  // namespace sporeprint
