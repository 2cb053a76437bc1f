#include "core/geometry/curl.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

/// How far from the margin it is displaced, in lengths of the cap: where it deliquesces, and beside
/// splits.
constexpr double melt_reach = 0.22, lip_reach = 0.16;
/// Where it deliquesces the lower face is displaced less: its rings are at other places than those of
/// the cap, and the flesh between both is thin. Beside splits both faces remain joined.
constexpr double of_lower_face = 0.75;

}  // namespace

Curl::Curl(const Individual& individual, const MarginCuts& cuts, std::vector<glm::dvec3> away)
    : cuts_(&cuts),
      cap_length_(individual.outline.cap.length()),
      lower_length_(individual.outline.hymenium.length()),
      max_height_(0.075 * cap_length_ *
                  smooth_step(0.0, 0.6, individual.damage.amounts.deliquescence)),
      away_(std::move(away)) {
    for (const double turn : cuts.turns()) lifts_.push_back(cuts.lift(2.0 * pi * turn));
    for (const double lift : lifts_) max_lift_ = std::max(max_lift_, lift);
}

double Curl::height(bool cap, double at, double cap_end, double lower_end, double lift) const {
    const double off = cap ? cap_length_ * (cap_end - at) : lower_length_ * (lower_end - at);
    // The same length on both faces, otherwise they would intersect. Where a face begins it stays
    // attached to its neighbour, however little is left of it.
    const double left = 0.95 * std::min(cap_length_ * cap_end, lower_length_ * lower_end);
    const auto near = [&](double reach) {
        const double whole = std::min(reach * cap_length_, left);
        const double u = whole > 1e-9 ? std::max(0.0, 1.0 - off / whole) : 0.0;
        return u * u;
    };
    return (cap ? 1.0 : of_lower_face) * max_height_ * near(melt_reach) + lift * near(lip_reach);
}

glm::dvec3 Curl::moved(bool cap, double at, double cap_end, double lower_end,
                       std::size_t column) const {
    return height(cap, at, cap_end, lower_end, lifts_[column]) * away_[column];
}

double Curl::turned(const glm::dvec3& by) const {
    return std::min(1.0,
                    80.0 * std::sqrt(glm::length(by) * (max_height_ + max_lift_)) / cap_length_);
}

glm::dvec3 Curl::moved(bool cap, double at, double angle) const {
    if (none()) return glm::dvec3(0.0);
    const std::vector<double>& turns = cuts_->placed_turns();
    double turn = angle / (2.0 * pi);
    turn -= std::floor(turn);
    const auto next = static_cast<std::size_t>(std::upper_bound(turns.begin(), turns.end(), turn) -
                                               turns.begin());
    const std::size_t column = next - 1, after = next == turns.size() ? 0 : next;
    const double to = after == 0 ? 1.0 : turns[after];
    const double t = (turn - turns[column]) / (to - turns[column]);
    const double lift = lifts_[column] + t * (lifts_[after] - lifts_[column]);
    const double high = height(cap, at, cuts_->cap_end(angle), cuts_->lower_end(angle), lift);
    return high * (away_[column] + t * (away_[after] - away_[column]));
}

}  // namespace sporeprint
