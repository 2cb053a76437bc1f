// Fuzzes control points: a set of silhouettes that pass their check is refused with a reason, or
// none of its mixes self-intersects at any level of detail, and the certificates of its paths hold.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/params/describe.h"
#include "core/problems.h"
#include "core/silhouette/morph_set.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

namespace {

/// Reads numbers from bytes; zeros after their end.
class Numbers {
  public:
    Numbers(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    [[nodiscard]] bool empty() const { return left_ == 0; }

    std::size_t byte() {
        if (left_ == 0) return 0;
        --left_;
        return *data_++;
    }

    double share() { return static_cast<double>(byte()) / 255.0; }

    std::vector<OutlinePoint> points(std::size_t count) {
        std::vector<OutlinePoint> points;
        while (points.size() < count && left_ >= 4) {
            const double r = static_cast<double>(byte() * 256 + byte()) / 65535.0;
            const double y = static_cast<double>(byte() * 256 + byte()) / 65535.0;
            points.push_back({0.25 * r, 0.625 * y - 0.125});
        }
        return points;
    }

  private:
    const std::uint8_t* data_;
    std::size_t left_;
};

/// Reads up to four species of up to four stages; empty if a silhouette is refused.
std::vector<ControlShape> shapes_from(Numbers& in) {
    std::vector<ControlShape> shapes;
    const std::size_t species_count = 1 + in.byte() % 4;
    for (std::size_t species_index = 0; species_index < species_count; ++species_index) {
        const std::size_t joins = in.byte(), stages = 1 + in.byte() % 4;
        const std::array<std::size_t, 3> counts = {2 + in.byte() % 15, in.byte() % 16,
                                                   2 + in.byte() % 15};
        double age = 0.0;
        for (std::size_t stage = 0; stage < stages; ++stage) {
            age = stage == 0 ? 0.3 * in.share() : std::min(1.0, age + 0.05 + 0.5 * in.share());
            Silhouette s;
            s.junction = (joins & 1) != 0 ? Join::smooth : Join::corner;
            s.margin = (joins & 2) != 0 ? Join::smooth : Join::corner;
            s.stem = in.points(counts[0]);
            s.hymenium = in.points(counts[1]);
            s.cap = in.points(counts[2]);
            if (s.stem.size() != counts[0] || s.hymenium.size() != counts[1] ||
                s.cap.size() != counts[2])
                return {};
            s.stem.front().r = s.cap.back().r = 0;
            if (!s.hymenium.empty()) s.hymenium.front() = s.stem.back();
            s.cap.front() = s.hymenium.empty() ? s.stem.back() : s.hymenium.back();
            std::vector<Problem> problems;
            check(s, Info{.name = ""}, "", problems);
            if (!problems.empty()) return {};
            double size = 0.0;
            for (const auto* part : {&s.stem, &s.hymenium, &s.cap})
                for (const OutlinePoint& p : *part) size = std::max({size, p.r, p.y});
            shapes.push_back({std::move(s), std::max(size, 1e-3), species_index, age});
        }
    }
    return shapes;
}

std::vector<double> weights_from(Numbers& in, std::size_t count) {
    std::vector<double> weights(count);
    double sum = 0.0;
    for (double& w : weights) sum += w = in.share();
    if (sum == 0.0) weights[0] = sum = 1.0;
    for (double& w : weights) w /= sum;
    return weights;
}

/// Expects the outline for these weights to be finite, on its side of the axis, and simple.
void expect_simple(const MorphSet& set, const std::vector<double>& weights, const char* promise) {
    const Outline outline(set.nodes(weights));
    for (int lod = 0; lod < 4; ++lod) {
        const Polyline line = polyline(outline, lod);
        expect(line.size() > 1, "an outline has points");
        for (const glm::dvec2& p : line)
            expect(std::isfinite(p.x) && std::isfinite(p.y) && p.x >= 0.0,
                   "points are finite and on their side of the axis");
        expect(!static_intersection(line), promise);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Numbers in(data, size);
    std::vector<ControlShape> shapes = shapes_from(in);
    if (shapes.empty()) return 0;
    std::vector<Arc> arcs;
    if (shapes.back().species_index == 1)
        for (std::size_t left = in.byte() % 5; left > 0; --left)
            arcs.push_back({curve_names[in.byte() % 3], in.share(), in.share()});
    const double arcs_age = in.share();
    try {
        const MorphSet set(shapes, arcs, arcs_age);
        const auto first = weights_from(in, set.size()), second = weights_from(in, set.size());
        expect_simple(set, first, "no mix that is served crosses itself");
        const Certificate path = set.certificate(first, second);
        for (int i = 0; i <= 8; ++i) {
            std::vector<double> between(set.size());
            for (std::size_t k = 0; k < between.size(); ++k)
                between[k] = first[k] + (second[k] - first[k]) * i / 8.0;
            expect_simple(set, between, "no mix along the path crosses itself");
        }
        expect(path.indirect >= 0.0 && path.indirect <= 1.0,
               "the share of the indirect path is in 0..1");
        const Certificate whole = set.certificate();
        expect(whole.indirect >= 0.0 && whole.indirect <= 1.0,
               "the share of the indirect path is in 0..1");
        const std::vector<double> grown = set.growth_weights(arcs_age);
        expect(grown.size() == set.size(), "every shape has its growth");
        if (shapes.back().species_index == 1)
            for (const Arc& arc : set.arcs(arcs_age, 8))
                expect(arc.a >= 0.0 && arc.a <= 1.0 && arc.b >= 0.0 && arc.b <= 1.0,
                       "arcs are shares");
    } catch (const InvalidInput&) {
        // refused with a reason, as specified
    }
    return 0;
}
