#include "core/colony/separation.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// Least depth of an occupied space, relative to its reach: points a cell apart must not pass
/// through a thin cap.
constexpr double least_depth = 0.1;
/// Adjustments: lean of tops, in heights of their stem, and factors on the height.
constexpr std::array<double, 3> leans = {0.12, 0.24, 0.36};
constexpr std::array<double, 4> heights = {1.0, 0.85, 1.15, 0.7};
constexpr std::size_t most_younger = 3;
/// Whole individuals rotate about their base: radians per unit of lean.
constexpr double whole_tilt = 0.7;
/// Number of points of a stem that must be clear of caps; its base may be fused with others.
constexpr int stem_samples = 6;

}  // namespace

OccupancyGrid::OccupancyGrid(const Mesh& mesh) {
    const Bounds box = bounds(mesh);
    const double side = std::max({static_cast<double>(box.max.x - box.min.x),
                                  static_cast<double>(box.max.z - box.min.z), 1e-6});
    // Slightly larger, so that the boundary lies inside the grid.
    cell_ = side * 1.001 / cells;
    middle_ = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
    corner_ = {middle_.x - 0.5 * cells * cell_, middle_.z - 0.5 * cells * cell_};
    const auto column = [&](float x, double from) {
        const double at = std::floor((static_cast<double>(x) - from) / cell_);
        return static_cast<int>(std::min(std::max(at, 0.0), cells - 1.0));
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3& a = mesh.positions[mesh.indices[i]];
        const glm::vec3& b = mesh.positions[mesh.indices[i + 1]];
        const glm::vec3& c = mesh.positions[mesh.indices[i + 2]];
        const glm::vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        for (int z = column(low.z, corner_.y); z <= column(high.z, corner_.y); ++z)
            for (int x = column(low.x, corner_.x); x <= column(high.x, corner_.x); ++x) {
                Span& span = spans_[static_cast<std::size_t>(z * cells + x)];
                if (span.low > span.high) {
                    span = {low.y, high.y};
                } else {
                    span.low = std::min(span.low, low.y);
                    span.high = std::max(span.high, high.y);
                }
            }
    }
    const auto least = static_cast<float>(least_depth * 0.5 * side);
    for (Span& span : spans_)
        if (const float depth = span.high - span.low; depth >= 0.0F && depth < least) {
            span.low -= 0.5F * (least - depth);
            span.high += 0.5F * (least - depth);
        }
    const auto full = [&](int x, int z) {
        return x >= 0 && z >= 0 && x < cells && z < cells && at(x, z).low <= at(x, z).high;
    };
    for (int z = 0; z < cells; ++z)
        for (int x = 0; x < cells; ++x) {
            if (!full(x, z)) continue;
            const Span& span = at(x, z);
            const bool inside =
                full(x - 1, z) && full(x + 1, z) && full(x, z - 1) && full(x, z + 1);
            if (inside && (x + z) % 2 == 1) continue;
            const double px = corner_.x + (x + 0.5) * cell_, pz = corner_.y + (z + 0.5) * cell_;
            border_.emplace_back(px, static_cast<double>(span.low), pz);
            border_.emplace_back(px, static_cast<double>(span.high), pz);
            if (!inside)
                border_.emplace_back(px, 0.5 * static_cast<double>(span.low + span.high), pz);
        }
    for (const glm::dvec3& point : border_)
        reach_ = std::max(reach_, glm::length(point - middle_) + 0.75 * cell_);
}

bool OccupancyGrid::contains(const glm::dvec3& point) const {
    const double x = (point.x - corner_.x) / cell_, z = (point.z - corner_.y) / cell_;
    if (!(x >= 0.0 && z >= 0.0 && x < cells && z < cells)) return false;
    const Span& span = at(static_cast<int>(x), static_cast<int>(z));
    return point.y >= static_cast<double>(span.low) && point.y <= static_cast<double>(span.high);
}

bool OccupancyGrid::contains(const glm::dvec3& point, double margin) const {
    const auto column = [&](double x) { return static_cast<int>(std::floor(x / cell_)); };
    const double x = point.x - corner_.x, z = point.z - corner_.y;
    const double whole = cells * cell_;
    if (!(x >= -margin && z >= -margin && x < whole + margin && z < whole + margin)) return false;
    const int x0 = std::max(column(x - margin), 0), x1 = std::min(column(x + margin), cells - 1);
    const int z0 = std::max(column(z - margin), 0), z1 = std::min(column(z + margin), cells - 1);
    for (int j = z0; j <= z1; ++j)
        for (int i = x0; i <= x1; ++i) {
            const Span& span = at(i, j);
            if (span.low <= span.high && point.y >= static_cast<double>(span.low) - margin &&
                point.y <= static_cast<double>(span.high) + margin)
                return true;
        }
    return false;
}

glm::dmat3 upright(const glm::dvec3& up, double turn) {
    const SineCosine at = sine_cosine(turn);
    const glm::dvec3 y(0.0, 1.0, 0.0);
    const auto carried = [&](const glm::dvec3& v) {
        const glm::dvec3 moved = v - (y + up) * (glm::dot(v, up) / (1.0 + up.y));
        return glm::normalize(moved - up * glm::dot(up, moved));
    };
    const glm::dvec3 x = carried({at.cosine, 0.0, -at.sine});
    return {x, up, glm::cross(x, up)};
}

bool overlap(const OccupancyGrid& a, const Pose& pose_a, const OccupancyGrid& b,
             const Pose& pose_b) {
    const double apart = glm::length(pose_a.world(a.middle()) - pose_b.world(b.middle()));
    if (apart > pose_a.scale * a.reach() + pose_b.scale * b.reach()) return false;
    const auto enters = [](const OccupancyGrid& from, const Pose& pose, const OccupancyGrid& into,
                           const Pose& other) {
        // The transform from one frame to the other.
        const glm::dmat3 turn = glm::transpose(other.turn) * pose.turn * (pose.scale / other.scale);
        const glm::dvec3 at = other.own(pose.at);
        return std::any_of(
            from.border().begin(), from.border().end(),
            [&](const glm::dvec3& point) { return into.contains(at + turn * point); });
    };
    return enters(a, pose_a, b, pose_b) || enters(b, pose_b, a, pose_a);
}

namespace {

class Placer {
  public:
    Placer(const ColonySite& site, const std::vector<ColonyModel>& models,
           const ColonyParams& params, const ColonyTraits& traits)
        : site_(site), models_(models), params_(params), traits_(traits) {}

    std::vector<ColonyMember> all() {
        for (std::size_t i = 0; i < site_.places.size(); ++i) {
            Random random(traits_.seed, purposes::colony_postures, site_.places[i].number);
            const double turn = random.uniform(0.0, 2.0 * pi), jitter = random.symmetric();
            place_member(i, turn, jitter);
        }
        return std::move(placed_);
    }

  private:
    /// A change of an individual that avoids an intersection.
    struct Adjustment {
        glm::dvec3 lean{0.0};  ///< of the top, in heights
        std::size_t younger = 0;
        double height = 1.0;
    };

    ColonyMember posed(std::size_t index, double turn, std::size_t oldest,
                       const Adjustment& adjustment) const {
        const ColonyPlace& place = site_.places[index];
        ColonyMember member;
        member.place = index;
        member.model = std::min(oldest + adjustment.younger, models_.size() - 1);
        const double radius = models_[member.model].radius;
        if (traits_.capped) {
            member.rise = adjustment.height * place.rise;
            member.swing = adjustment.height * place.swing;
            const double height = std::max(member.rise.y + member.swing.y, 1e-6);
            member.swing += height * adjustment.lean;
            member.pose.at = place.foot + member.rise + member.swing;
            member.pose.turn = upright(glm::normalize(member.rise + 2.0 * member.swing), turn);
            member.pose.scale = params_.cap_scale * place.radius / radius;
            return member;
        }
        member.pose.scale = place.radius / radius;
        member.pose.at = place.foot;
        if (traits_.lateral) {
            // Its front points away from the trunk; its height may vary slightly.
            const glm::dvec3 z = place.outwards;
            member.pose.turn = {glm::cross(place.up, z), place.up, z};
            member.pose.at += (adjustment.height - 1.0) * models_[member.model].occupancy.reach() *
                              member.pose.scale * place.up;
        } else {
            const glm::dvec3 up = glm::normalize(place.up + whole_tilt * adjustment.lean);
            member.pose.turn = upright(up, turn);
        }
        return member;
    }

    /// Returns a placed member that it intersects, or nullptr. The last blocker is tested first.
    [[nodiscard]] const ColonyMember* collision_of(const ColonyMember& one) {
        if (blocker_ < placed_.size() && collides(one, placed_[blocker_]))
            return &placed_[blocker_];
        for (std::size_t i = 0; i < placed_.size(); ++i)
            if (i != blocker_ && collides(one, placed_[i])) {
                blocker_ = i;
                return &placed_[i];
            }
        return nullptr;
    }

    [[nodiscard]] bool collides(const ColonyMember& one, const ColonyMember& other) const {
        const OccupancyGrid &occupancy = models_[one.model].occupancy,
                            &beside = models_[other.model].occupancy;
        return overlap(occupancy, one.pose, beside, other.pose) ||
               (traits_.capped && (stem_crosses_cap(one, other) || stem_crosses_cap(other, one)));
    }

    /// Returns true if the stem of one crosses the cap of another.
    [[nodiscard]] bool stem_crosses_cap(const ColonyMember& one, const ColonyMember& other) const {
        const OccupancyGrid& occupancy = models_[other.model].occupancy;
        const ColonyPlace& place = site_.places[one.place];
        const double radius = place.radius / other.pose.scale;
        for (int i = 1; i <= stem_samples; ++i) {
            const double t = static_cast<double>(i) / stem_samples;
            const glm::dvec3 at = other.pose.own(place.foot + t * one.rise + t * t * one.swing);
            const glm::dvec3 off = at - occupancy.middle();
            const double far = occupancy.reach() + radius;
            if (glm::dot(off, off) <= far * far && occupancy.contains(at, radius)) return true;
        }
        return false;
    }

    void place_member(std::size_t index, double turn, double jitter) {
        const ColonyPlace& place = site_.places[index];
        const double last = static_cast<double>(models_.size() - 1);
        const double wished = place.share * last + 0.8 * jitter;
        const auto oldest =
            static_cast<std::size_t>(std::min(std::max(std::floor(wished + 0.5), 0.0), last));
        const std::size_t younger = std::min(most_younger, models_.size() - 1 - oldest);
        const bool may_lean = !traits_.lateral;
        int steps = 0;
        for (const double height : heights) {
            if (height != 1.0 && !traits_.capped && !traits_.lateral) break;
            for (std::size_t age = 0; age <= younger; ++age) {
                ColonyMember member = posed(index, turn, oldest, {{}, age, height});
                const ColonyMember* blocker = collision_of(member);
                member.steps = steps++;
                if (!blocker) {
                    placed_.push_back(member);
                    return;
                }
                if (!may_lean) continue;
                glm::dvec3 aside = member.pose.at - blocker->pose.at;
                aside.y = 0.0;
                const double off = glm::length(aside);
                aside = off > 1e-9 ? aside / off : place.outwards;
                for (const glm::dvec3& direction : {place.outwards, aside}) {
                    if (direction == glm::dvec3(0.0)) continue;
                    for (const double lean : leans) {
                        member = posed(index, turn, oldest, {lean * direction, age, height});
                        member.steps = steps++;
                        if (collision_of(member)) continue;
                        placed_.push_back(member);
                        return;
                    }
                }
            }
        }
    }

    const ColonySite& site_;
    const std::vector<ColonyModel>& models_;
    const ColonyParams& params_;
    const ColonyTraits& traits_;
    std::vector<ColonyMember> placed_;
    std::size_t blocker_ = 0;
};

}  // namespace

std::vector<ColonyMember> placed_members(const ColonySite& site,
                                         const std::vector<ColonyModel>& models,
                                         const ColonyParams& params, const ColonyTraits& traits) {
    return Placer(site, models, params, traits).all();
}

}  // namespace sporeprint
