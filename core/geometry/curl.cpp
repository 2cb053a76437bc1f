#include "core/geometry/curl.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"

namespace sporeprint {

Curl::Curl(const Individual& individual, const MarginCuts& cuts, std::vector<glm::dvec3> away)
    : cuts_(&cuts),
      cap_length_(individual.outline.cap.length()),
      lower_length_(individual.outline.hymenium.length()),
      reach_(0.22 * cap_length_),
      max_height_(0.075 * cap_length_ *
                  smooth_step(0.0, 0.6, individual.damage.amounts.deliquescence)),
      away_(std::move(away)) {}

double Curl::height(bool cap, double at, double cap_end, double lower_end) const {
    const double off = cap ? cap_length_ * (cap_end - at) : lower_length_ * (lower_end - at);
    // The same length on both faces, otherwise they would intersect. Where a face begins it stays
    // attached to its neighbour, however little is left of it.
    const double whole =
        std::min(reach_, 0.95 * std::min(cap_length_ * cap_end, lower_length_ * lower_end));
    const double u = whole > 1e-9 ? std::max(0.0, 1.0 - off / whole) : 0.0;
    // The lower face is displaced less: its rings are at other places than those of the cap, and
    // the flesh between both is thin.
    return (cap ? 1.0 : 0.75) * max_height_ * u * u;
}

glm::dvec3 Curl::moved(bool cap, double at, double cap_end, double lower_end,
                       std::size_t column) const {
    return height(cap, at, cap_end, lower_end) * away_[column];
}

double Curl::turned(const glm::dvec3& by) const {
    return std::min(1.0, 80.0 * std::sqrt(glm::length(by) * max_height_) / cap_length_);
}

glm::dvec3 Curl::moved(bool cap, double at, double angle) const {
    if (none()) return glm::dvec3(0.0);
    const double high = height(cap, at, cuts_->cap_end(angle), cuts_->lower_end(angle));
    if (high <= 0.0) return glm::dvec3(0.0);
    const std::vector<double>& turns = cuts_->placed_turns();
    double turn = angle / (2.0 * pi);
    turn -= std::floor(turn);
    const auto next = static_cast<std::size_t>(std::upper_bound(turns.begin(), turns.end(), turn) -
                                               turns.begin());
    const std::size_t column = next - 1, after = next == turns.size() ? 0 : next;
    const double to = after == 0 ? 1.0 : turns[after];
    const double t = (turn - turns[column]) / (to - turns[column]);
    return high * (away_[column] + t * (away_[after] - away_[column]));
}

}  // namespace sporeprint
