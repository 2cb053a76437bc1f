#include "core/world/world_edits.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "core/params/canonical.h"

namespace sporeprint {

namespace {

std::string canonical_edits(const WorldEdits& edits) {
    std::string text;
    for (const auto& [id, own] : edits.ecologies) {
        text += "ecology " + id + ' ';
        canonical(own, text);
        text += '\n';
    }
    for (const auto& [id, list] : edits.founders) {
        text += "founders " + id;
        for (const Founder& one : list)
            text += ' ' + number_text(one.x) + ',' + number_text(one.y) + ',' +
                    std::to_string(one.year);
        text += '\n';
    }
    for (const auto& [name, mask] : edits.masks)
        text += "mask " + name + ' ' + text_of(*mask) + '\n';
    return text;
}

/// Sorts a list by a key and removes what repeats.
template <class Item, class Key>
void without_repetition(std::vector<Item>& list, const Key& key) {
    std::ranges::sort(list, {}, key);
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

std::uint16_t bits_of_months(std::span<const int> months) {
    std::uint16_t bits = 0;
    for (const int month : months) bits = static_cast<std::uint16_t>(bits | 1U << (month - 1));
    return months.empty() ? std::uint16_t{0xFFF} : bits;
}

std::shared_ptr<const WorldMask> WorldEdits::mask(std::string_view name) const {
    const auto found = masks.find(name);
    return found == masks.end() ? nullptr : found->second;
}

std::size_t WorldEdits::bytes() const {
    std::size_t sum = sizeof(*this) + text.size();
    for (const auto& [id, mask] : masks) sum += id.size() + mask->bytes();
    for (const auto& [id, list] : founders) sum += id.size() + list.size() * sizeof(Founder);
    return sum + ecologies.size() * sizeof(SpeciesEcology);
}

SpeciesEcology settled(SpeciesEcology own) {
    without_repetition(own.months, std::identity());
    return own;
}

WorldEdits settled(WorldEdits edits) {
    for (auto& [id, own] : edits.ecologies) own = settled(std::move(own));
    for (auto& [id, list] : edits.founders)
        without_repetition(list,
                           [](const Founder& one) { return std::tuple(one.year, one.x, one.y); });
    std::erase_if(edits.founders, [](const auto& one) { return one.second.empty(); });
    std::erase_if(edits.masks, [](const auto& one) { return one.second->is_full(); });
    edits.text = canonical_edits(edits);
    return edits;
}

}  // namespace sporeprint
