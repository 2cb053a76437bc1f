#include "core/silhouette/correspondence.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace sporeprint {

namespace {

constexpr double steepest_map = 8.0;
constexpr int edges_per_curve = 48, fewest_edges = 4;
constexpr int smoothings = 3;
constexpr std::size_t steepest_step = 4;

double squared_distance(const glm::dvec2& a, const glm::dvec2& b) { return glm::dot(a - b, a - b); }

/// Returns true if `a` precedes `b` in an order that is independent of the order of arguments.
bool comes_before(const Edges& a, const Edges& b) {
    if (a.length != b.length) return a.length < b.length;
    for (std::size_t i = 0; i < a.directions.size(); ++i) {
        if (a.directions[i].x != b.directions[i].x) return a.directions[i].x < b.directions[i].x;
        if (a.directions[i].y != b.directions[i].y) return a.directions[i].y < b.directions[i].y;
    }
    return true;
}

/// The share of a step in which an edge of one curve corresponds to an edge of the other; indices
/// count from the start of the step.
struct Piece {
    std::size_t a = 0, b = 0;
    double share = 0.0;
};

/// The pieces of a step: both curves are split where either has a vertex.
class Pieces {
  public:
    constexpr Pieces() = default;
    constexpr explicit Pieces(const Link& over) {
        const auto over_a = static_cast<std::size_t>(over.a);
        const auto over_b = static_cast<std::size_t>(over.b);
        for (std::size_t cut = 0; cut < over_a * over_b;) {
            const std::size_t i = cut / over_b, j = cut / over_a;
            const std::size_t next = std::min((i + 1) * over_b, (j + 1) * over_a);
            pieces_[count_++] = {
                i, j, static_cast<double>(next - cut) / static_cast<double>(over_a * over_b)};
            cut = next;
        }
    }
    [[nodiscard]] constexpr const Piece* begin() const { return pieces_.data(); }
    [[nodiscard]] constexpr const Piece* end() const { return pieces_.data() + count_; }

  private:
    std::array<Piece, 2 * steepest_step> pieces_{};
    std::size_t count_ = 0;
};

/// The work of a kind of step: for stretching, and for a bend of its whole length by 1.
struct StepWork {
    double stretched = 0.0, bend = 0.0;

    StepWork() = default;
    StepWork(const BlendWork& work, const Edges& a, const Edges& b, const Link& over) {
        const double length_a = a.length * over.a / static_cast<double>(a.directions.size());
        const double length_b = b.length * over.b / static_cast<double>(b.directions.size());
        const double shorter = std::min(length_a, length_b), longer = std::max(length_a, length_b);
        stretched = work.stretch * (longer - shorter) * (longer - shorter) /
                    ((1.0 - work.share_of_long) * shorter + work.share_of_long * longer);
        bend = work.bend * 0.5 * (length_a + length_b);
    }
};

/// Returns the straight edges of a curve between two shares of its length.
Edges edges_of(const SubCurve& curve, double from, double to, int count) {
    Edges edges;
    edges.length = to - from;
    const auto place = [&](int i) {
        const OutlineSample s = curve.at(from + (to - from) * i / count);
        return glm::dvec2(s.r, s.y);
    };
    glm::dvec2 last = place(0);
    for (int i = 1; i <= count; ++i) {
        const glm::dvec2 here = place(i), step = here - last;
        const double length = std::sqrt(glm::dot(step, step));
        edges.directions.push_back(length > 0.0 ? step / length : glm::dvec2(0.0));
        last = here;
    }
    return edges;
}

/// Returns the offsets b - a along (a + b) / 2 of a chain of links at n + 1 even positions,
/// smoothed and bounded by the steepest slope of the map.
std::vector<double> even_offsets(const std::vector<Link>& links, int n) {
    std::vector<double> offsets;
    std::size_t k = 0;
    for (int i = 0; i <= n; ++i) {
        while (links[k].a + links[k].b < 2 * i) ++k;
        const int past = links[k].a + links[k].b - 2 * i;  // a step may pass over the position
        const double here = links[k].b - links[k].a;
        if (past == 0) {
            offsets.push_back(here);
            continue;
        }
        const Link& last = links[k - 1];
        const double share =
            static_cast<double>(past) / (links[k].a + links[k].b - last.a - last.b);
        offsets.push_back((1.0 - share) * here + share * (last.b - last.a));
    }
    for (int pass = 0; pass < smoothings; ++pass) {
        double before = 0.0;
        for (std::size_t i = 1; i + 1 < offsets.size(); ++i) {
            const double here = offsets[i];
            offsets[i] = 0.25 * before + 0.5 * here + 0.25 * offsets[i + 1];
            before = here;
        }
    }
    // The slope is db/da = (1 + d/2) / (1 - d/2) for an offset that grows by d per position.
    constexpr double most = 2.0 * (steepest_map - 1.0) / (steepest_map + 1.0);
    offsets.front() = offsets.back() = 0.0;
    for (std::size_t i = 1; i < offsets.size(); ++i)
        offsets[i] = std::clamp(offsets[i], offsets[i - 1] - most, offsets[i - 1] + most);
    offsets.back() = 0.0;
    for (std::size_t i = offsets.size() - 1; i-- > 0;)
        offsets[i] = std::clamp(offsets[i], offsets[i + 1] - most, offsets[i + 1] + most);
    return offsets;
}

}  // namespace

ShareMap::ShareMap(std::vector<double> from, std::vector<double> to, double steepest)
    : from_(std::move(from)), to_(std::move(to)) {
    assert(from_.size() == to_.size() && from_.size() >= 2);
    const std::size_t n = from_.size();
    std::vector<double> secants(n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        assert(from_[i + 1] > from_[i] && to_[i + 1] > to_[i]);
        secants[i] = (to_[i + 1] - to_[i]) / (from_[i + 1] - from_[i]);
    }
    slopes_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double before = secants[i == 0 ? 0 : i - 1];
        const double after = secants[i + 1 == n ? n - 2 : i];
        double slope = before;
        if (i > 0 && i + 1 < n) {
            const double h0 = from_[i] - from_[i - 1], h1 = from_[i + 1] - from_[i];
            const double w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
            slope = (w0 + w1) / (w0 / before + w1 / after);
        }
        slopes_[i] =
            std::min(std::clamp(slope, 1.0 / steepest, steepest), 3.0 * std::min(before, after));
    }
}

ShareMap::Value ShareMap::operator()(double share) const {
    const auto above = std::upper_bound(from_.begin() + 1, from_.end() - 1, share);
    const auto i = static_cast<std::size_t>(above - from_.begin()) - 1;
    const double h = from_[i + 1] - from_[i], rise = to_[i + 1] - to_[i];
    const double t = std::clamp((share - from_[i]) / h, 0.0, 1.0);
    const double leaving = slopes_[i] * h, arriving = slopes_[i + 1] * h;
    const double c = 3.0 * rise - 2.0 * leaving - arriving, d = leaving + arriving - 2.0 * rise;
    if (t == 1.0) return {to_[i + 1], slopes_[i + 1]};
    return {to_[i] + t * (leaving + t * (c + t * d)), (leaving + t * (2.0 * c + 3.0 * t * d)) / h};
}

double BlendWork::step(const Edges& a, const Edges& b, std::size_t at_a, std::size_t at_b,
                       const Link& over) const {
    double bent = 0.0;
    for (const Piece& piece : Pieces(over))
        bent += piece.share *
                squared_distance(a.directions[at_a + piece.a], b.directions[at_b + piece.b]);
    const StepWork work(*this, a, b, over);
    return work.stretched + work.bend * bent;
}

namespace {

// The last step of the path of least work to each pair of vertices.
struct StepTable {
    std::size_t row;                  ///< length of a row: one pair of vertices for each of b
    std::vector<std::uint8_t> steps;  ///< indices into link_steps, row by row of vertices of a
};

// Returns the table of two outlines with the same number of edges, by dynamic programming.
StepTable step_table(const Edges& a, const Edges& b, const BlendWork& work) {
    const std::size_t n = a.directions.size(), row = n + 1;
    std::vector<double> squared_distances(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            squared_distances[i * n + j] = squared_distance(a.directions[i], b.directions[j]);
    static constexpr auto pieces = [] {
        std::array<Pieces, link_steps.size()> all;
        for (std::size_t s = 0; s < all.size(); ++s) all[s] = Pieces(link_steps[s]);
        return all;
    }();
    std::array<StepWork, link_steps.size()> works;
    for (std::size_t s = 0; s < works.size(); ++s) works[s] = {work, a, b, link_steps[s]};
    constexpr double never = std::numeric_limits<double>::infinity();
    std::vector<double> least(row * row, never);
    std::vector<std::uint8_t> best_steps(row * row, 0);
    least[0] = 0.0;
    for (std::size_t i = 1; i <= n; ++i) {
        // The loop covers only cells that are reachable from the first vertices and from which the
        // last are reachable.
        const auto near = [&](std::size_t x) { return (x + steepest_step - 1) / steepest_step; };
        const std::size_t least_j = std::max(near(i), n - std::min(n, steepest_step * (n - i)));
        const std::size_t most_j = std::min(n - near(n - i), steepest_step * i);
        for (std::size_t j = least_j; j <= most_j; ++j) {
            double best = never;
            std::size_t best_step = 0;
            for (std::size_t s = 0; s < link_steps.size(); ++s) {
                const auto over_a = static_cast<std::size_t>(link_steps[s].a);
                const auto over_b = static_cast<std::size_t>(link_steps[s].b);
                if (over_a > i || over_b > j) continue;
                double total = least[(i - over_a) * row + j - over_b] + works[s].stretched;
                if (total >= best) continue;
                const double* corner = &squared_distances[(i - over_a) * n + j - over_b];
                double bent = 0.0;
                for (const Piece& piece : pieces[s])
                    bent += piece.share * corner[piece.a * n + piece.b];
                total += works[s].bend * bent;
                if (total < best) {
                    best = total;
                    best_step = s;
                }
            }
            least[i * row + j] = best;
            best_steps[i * row + j] = static_cast<std::uint8_t>(best_step);
        }
    }
    return {row, std::move(best_steps)};
}

}  // namespace

std::vector<Link> least_work_links(const Edges& a, const Edges& b, const BlendWork& work) {
    assert(a.directions.size() == b.directions.size() && !a.directions.empty());
    if (!comes_before(a, b)) {
        std::vector<Link> links = least_work_links(b, a, work);
        for (Link& link : links) std::swap(link.a, link.b);
        return links;
    }
    const StepTable table = step_table(a, b, work);
    const auto last = static_cast<int>(a.directions.size());
    std::vector<Link> links{{last, last}};
    while (links.back().a > 0) {
        const Link end = links.back();
        const auto cell =
            static_cast<std::size_t>(end.a) * table.row + static_cast<std::size_t>(end.b);
        const Link step = link_steps[table.steps[cell]];
        links.push_back({end.a - step.a, end.b - step.b});
    }
    std::reverse(links.begin(), links.end());
    return links;
}

ShareMap correspondence(const SubCurve& a, const SubCurve& b, std::span<const Landmark> landmarks) {
    std::vector<double> from{0.0}, to{0.0};
    Landmark last;
    for (std::size_t section = 0; section <= landmarks.size(); ++section) {
        const Landmark end = section < landmarks.size() ? landmarks[section] : Landmark{1.0, 1.0};
        const double length_a = end.a - last.a, length_b = end.b - last.b;
        const int n = std::max(
            fewest_edges, static_cast<int>(edges_per_curve * 0.5 * (length_a + length_b) + 0.5));
        const auto offsets = even_offsets(
            least_work_links(edges_of(a, last.a, end.a, n), edges_of(b, last.b, end.b, n)), n);
        for (int i = 1; i < n; ++i) {
            const double half = 0.5 * offsets[static_cast<std::size_t>(i)];
            from.push_back(last.a + length_a * ((i - half) / n));
            to.push_back(last.b + length_b * ((i + half) / n));
        }
        from.push_back(end.a);
        to.push_back(end.b);
        last = end;
    }
    return {std::move(from), std::move(to)};
}

}  // namespace sporeprint
