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

/// Rooms are at least this deep, in their reach: points a cell apart must not pass through a thin cap.
constexpr double least_depth = 0.1;
/// How far tops lean, in heights of their stem, and how much higher or lower they grow.
constexpr std::array<double, 3> leans = {0.12, 0.24, 0.36};
constexpr std::array<double, 4> heights = {1.0, 0.85, 1.15, 0.7};
constexpr std::size_t most_younger = 3;
/// What stands whole and leans turns about its foot, radians to a lean of one.
constexpr double whole_tilt = 0.7;
/// Places of a stem that must be clear of caps: the base may be fused.
constexpr int stem_looks = 6;

}  // namespace

OccupancyGrid::OccupancyGrid(const Mesh& mesh) {
    const Bounds box = bounds(mesh);
    const double side = std::max({static_cast<double>(box.max.x - box.min.x),
                                  static_cast<double>(box.max.z - box.min.z), 1e-6});
    // A little more, so that the border lies inside the grid.
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

bool OccupancyGrid::holds(const glm::dvec3& point) const {
    const double x = (point.x - corner_.x) / cell_, z = (point.z - corner_.y) / cell_;
    if (!(x >= 0.0 && z >= 0.0 && x < cells && z < cells)) return false;
    const Span& span = at(static_cast<int>(x), static_cast<int>(z));
    return point.y >= static_cast<double>(span.low) && point.y <= static_cast<double>(span.high);
}

bool OccupancyGrid::holds(const glm::dvec3& point, double margin) const {
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

bool meet(const OccupancyGrid& a, const Posture& posture_a, const OccupancyGrid& b,
          const Posture& posture_b) {
    const double apart = glm::length(posture_a.world(a.middle()) - posture_b.world(b.middle()));
    if (apart > posture_a.scale * a.reach() + posture_b.scale * b.reach()) return false;
    const auto enters = [](const OccupancyGrid& from, const Posture& pose,
                           const OccupancyGrid& into, const Posture& other) {
        // Both frames at once.
        const glm::dmat3 turn = glm::transpose(other.turn) * pose.turn * (pose.scale / other.scale);
        const glm::dvec3 at = other.own(pose.at);
        return std::any_of(from.border().begin(), from.border().end(),
                           [&](const glm::dvec3& point) { return into.holds(at + turn * point); });
    };
    return enters(a, posture_a, b, posture_b) || enters(b, posture_b, a, posture_a);
}

namespace {

class Settler {
  public:
    Settler(const ColonySite& site, const std::vector<ColonyModel>& models,
            const ColonyParams& params, const ColonyNature& nature)
        : site_(site), models_(models), params_(params), nature_(nature) {}

    std::vector<ColonyMember> all() {
        for (std::size_t i = 0; i < site_.places.size(); ++i) {
            Random random(params_.seed, purposes::colony_postures, site_.places[i].number);
            const double turn = random.uniform(0.0, 2.0 * pi), jitter = random.symmetric();
            settle(i, turn, jitter);
        }
        return std::move(settled_);
    }

  private:
    /// How one gives way.
    struct Way {
        glm::dvec3 lean{0.0};  ///< of the top, in heights
        std::size_t younger = 0;
        double height = 1.0;
    };

    ColonyMember stood(std::size_t index, double turn, std::size_t oldest, const Way& way) const {
        const ColonyPlace& place = site_.places[index];
        ColonyMember member;
        member.place = index;
        member.model = std::min(oldest + way.younger, models_.size() - 1);
        const double radius = models_[member.model].radius;
        if (nature_.capped) {
            member.rise = way.height * place.rise;
            member.swing = way.height * place.swing;
            const double height = std::max(member.rise.y + member.swing.y, 1e-6);
            member.swing += height * way.lean;
            member.posture.at = place.foot + member.rise + member.swing;
            member.posture.turn = upright(glm::normalize(member.rise + 2.0 * member.swing), turn);
            member.posture.scale = params_.cap_scale * place.radius / radius;
            return member;
        }
        member.posture.scale = place.radius / radius;
        member.posture.at = place.foot;
        if (nature_.lateral) {
            // Its front away from the trunk; it may stand a little higher or lower.
            const glm::dvec3 z = place.outwards;
            member.posture.turn = {glm::cross(place.up, z), place.up, z};
            member.posture.at += (way.height - 1.0) * models_[member.model].room.reach() *
                                 member.posture.scale * place.up;
        } else {
            const glm::dvec3 up = glm::normalize(place.up + whole_tilt * way.lean);
            member.posture.turn = upright(up, turn);
        }
        return member;
    }

    /// One that it meets, or none. Who stood in the way last is asked first.
    [[nodiscard]] const ColonyMember* met(const ColonyMember& one) {
        if (blocker_ < settled_.size() && meets(one, settled_[blocker_]))
            return &settled_[blocker_];
        for (std::size_t i = 0; i < settled_.size(); ++i)
            if (i != blocker_ && meets(one, settled_[i])) {
                blocker_ = i;
                return &settled_[i];
            }
        return nullptr;
    }

    [[nodiscard]] bool meets(const ColonyMember& one, const ColonyMember& other) const {
        const OccupancyGrid &room = models_[one.model].room, &beside = models_[other.model].room;
        return meet(room, one.posture, beside, other.posture) ||
               (nature_.capped && (runs_through(one, other) || runs_through(other, one)));
    }

    /// Whether the stem of one runs through the cap of another.
    [[nodiscard]] bool runs_through(const ColonyMember& one, const ColonyMember& other) const {
        const OccupancyGrid& room = models_[other.model].room;
        const ColonyPlace& place = site_.places[one.place];
        const double radius = place.radius / other.posture.scale;
        for (int i = 1; i <= stem_looks; ++i) {
            const double t = static_cast<double>(i) / stem_looks;
            const glm::dvec3 at = other.posture.own(place.foot + t * one.rise + t * t * one.swing);
            const glm::dvec3 off = at - room.middle();
            const double far = room.reach() + radius;
            if (glm::dot(off, off) <= far * far && room.holds(at, radius)) return true;
        }
        return false;
    }

    void settle(std::size_t index, double turn, double jitter) {
        const ColonyPlace& place = site_.places[index];
        const double last = static_cast<double>(models_.size() - 1);
        const double wished = place.share * last + 0.8 * jitter;
        const auto oldest =
            static_cast<std::size_t>(std::min(std::max(std::floor(wished + 0.5), 0.0), last));
        const std::size_t younger = std::min(most_younger, models_.size() - 1 - oldest);
        const bool leans_at_all = !nature_.lateral;
        int steps = 0;
        for (const double height : heights) {
            if (height != 1.0 && !nature_.capped && !nature_.lateral) break;
            for (std::size_t age = 0; age <= younger; ++age) {
                ColonyMember member = stood(index, turn, oldest, {{}, age, height});
                const ColonyMember* blocker = met(member);
                member.steps = steps++;
                if (!blocker) {
                    settled_.push_back(member);
                    return;
                }
                if (!leans_at_all) continue;
                glm::dvec3 aside = member.posture.at - blocker->posture.at;
                aside.y = 0.0;
                const double off = glm::length(aside);
                aside = off > 1e-9 ? aside / off : place.outwards;
                for (const glm::dvec3& way : {place.outwards, aside}) {
                    if (way == glm::dvec3(0.0)) continue;
                    for (const double lean : leans) {
                        member = stood(index, turn, oldest, {lean * way, age, height});
                        member.steps = steps++;
                        if (met(member)) continue;
                        settled_.push_back(member);
                        return;
                    }
                }
            }
        }
    }

    const ColonySite& site_;
    const std::vector<ColonyModel>& models_;
    const ColonyParams& params_;
    const ColonyNature& nature_;
    std::vector<ColonyMember> settled_;
    std::size_t blocker_ = 0;
};

}  // namespace

std::vector<ColonyMember> settled(const ColonySite& site, const std::vector<ColonyModel>& models,
                                  const ColonyParams& params, const ColonyNature& nature) {
    return Settler(site, models, params, nature).all();
}

}  // namespace sporeprint
