#include "core/silhouette/correspondence.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

constexpr double steepest_map = 8.0;
constexpr int edges_per_curve = 48, fewest_edges = 4;
constexpr int smoothings = 3;

double raised(double x, double exponent) { return exponent == 2.0 ? x * x : power(x, exponent); }

double apart(const glm::dvec2& a, const glm::dvec2& b) { return glm::dot(a - b, a - b); }

/// Whether `a` comes before `b` in an order that does not depend on which is called first.
bool comes_before(const Edges& a, const Edges& b) {
    if (a.length != b.length) return a.length < b.length;
    for (std::size_t i = 0; i < a.directions.size(); ++i) {
        if (a.directions[i].x != b.directions[i].x) return a.directions[i].x < b.directions[i].x;
        if (a.directions[i].y != b.directions[i].y) return a.directions[i].y < b.directions[i].y;
    }
    return true;
}

/// The straight edges of a curve between two shares of its length.
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

/// The offset b - a along (a + b) / 2 of a chain of links, at n + 1 even places, smoothed and no steeper than the map may be.
std::vector<double> even_offsets(const std::vector<Link>& links, int n) {
    std::vector<double> offsets;
    std::size_t k = 0;
    for (int i = 0; i <= n; ++i) {
        while (links[k].a + links[k].b < 2 * i) ++k;
        const int past = links[k].a + links[k].b - 2 * i;  // a step in both may jump over the place
        const double here = links[k].b - links[k].a;
        offsets.push_back(past == 0 ? here : 0.5 * (here + links[k - 1].b - links[k - 1].a));
    }
    for (int pass = 0; pass < smoothings; ++pass) {
        double before = 0.0;
        for (std::size_t i = 1; i + 1 < offsets.size(); ++i) {
            const double here = offsets[i];
            offsets[i] = 0.25 * before + 0.5 * here + 0.25 * offsets[i + 1];
            before = here;
        }
    }
    // db/da = (1 + d/2) / (1 - d/2) for an offset that grows by d from place to place.
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
                       bool moves_a, bool moves_b) const {
    const std::size_t n = a.directions.size(), m = b.directions.size();
    const double length_a = moves_a ? a.length / static_cast<double>(n) : 0.0;
    const double length_b = moves_b ? b.length / static_cast<double>(m) : 0.0;
    const double shorter = std::min(length_a, length_b), longer = std::max(length_a, length_b);
    const double stretched = stretch * raised(longer - shorter, exponent) /
                             ((1.0 - share_of_long) * shorter + share_of_long * longer);
    // An edge that shrinks to a vertex lies between the two edges that meet there.
    const auto at_vertex = [](const glm::dvec2& edge, const Edges& other, std::size_t vertex) {
        const std::size_t last = other.directions.size() - 1;
        return 0.5 * (apart(edge, other.directions[vertex == 0 ? 0 : vertex - 1]) +
                      apart(edge, other.directions[std::min(vertex, last)]));
    };
    const double angle = moves_a && moves_b ? apart(a.directions[at_a], b.directions[at_b])
                         : moves_a          ? at_vertex(a.directions[at_a], b, at_b)
                                            : at_vertex(b.directions[at_b], a, at_a);
    return stretched + bend * 0.5 * (length_a + length_b) * angle +
           (moves_a && moves_b ? 0.0 : collapse);
}

std::vector<Link> least_work_links(const Edges& a, const Edges& b, const BlendWork& work) {
    assert(a.directions.size() == b.directions.size() && !a.directions.empty());
    if (!comes_before(a, b)) {
        std::vector<Link> links = least_work_links(b, a, work);
        for (Link& link : links) std::swap(link.a, link.b);
        return links;
    }
    const std::size_t n = a.directions.size(), row = n + 1;
    // States of a cell: 0 after a step in both, r after r steps in a alone, run + r after r steps in b alone.
    const auto run = static_cast<std::size_t>(work.longest_run), states = 2 * run + 1;
    constexpr double never = std::numeric_limits<double>::infinity();
    std::vector<double> least(row * row * states, never);
    std::vector<std::uint8_t> came_from(row * row * states, 0);
    const auto cell = [&](std::size_t i, std::size_t j) { return (i * row + j) * states; };
    least[0] = 0.0;
    for (std::size_t i = 0; i <= n; ++i)
        for (std::size_t j = 0; j <= n; ++j) {
            const auto enter = [&](std::size_t from, std::size_t source, std::size_t target,
                                   double step) {
                const double total = least[from + source] + step;
                double& best = least[cell(i, j) + target];
                if (total < best) {
                    best = total;
                    came_from[cell(i, j) + target] = static_cast<std::uint8_t>(source);
                }
            };
            if (i > 0 && j > 0) {
                const double step = work.step(a, b, i - 1, j - 1, true, true);
                for (std::size_t s = 0; s < states; ++s) enter(cell(i - 1, j - 1), s, 0, step);
            }
            if (i > 0 && run > 0) {
                const std::size_t from = cell(i - 1, j);
                const double step = work.step(a, b, i - 1, j, true, false);
                enter(from, 0, 1, step);
                for (std::size_t s = run + 1; s < states; ++s) enter(from, s, 1, step);
                for (std::size_t s = 1; s < run; ++s) enter(from, s, s + 1, step);
            }
            if (j > 0 && run > 0) {
                const std::size_t from = cell(i, j - 1);
                const double step = work.step(a, b, i, j - 1, false, true);
                for (std::size_t s = 0; s <= run; ++s) enter(from, s, run + 1, step);
                for (std::size_t s = run + 1; s + 1 < states; ++s) enter(from, s, s + 1, step);
            }
        }
    std::size_t state = 0;
    for (std::size_t s = 1; s < states; ++s)
        if (least[cell(n, n) + s] < least[cell(n, n) + state]) state = s;
    std::vector<Link> links{{static_cast<int>(n), static_cast<int>(n)}};
    for (std::size_t i = n, j = n; i > 0 || j > 0;) {
        const std::size_t before = came_from[cell(i, j) + state];
        if (state <= run) --i;
        if (state == 0 || state > run) --j;
        state = before;
        links.push_back({static_cast<int>(i), static_cast<int>(j)});
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
