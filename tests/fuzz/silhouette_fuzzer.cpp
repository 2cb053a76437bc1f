// Fuzzes control points of a silhouette: it is refused or becomes finite, simple curves.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/model/swept.h"
#include "core/problems.h"
#include "core/silhouette/outline.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

namespace {

/// Reads control points from bytes: two 16-bit numbers per point, over the allowed range.
class Points {
  public:
    Points(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    std::uint8_t byte() {
        if (left_ == 0) return 0;
        --left_;
        return *data_++;
    }

    std::vector<OutlinePoint> take(std::size_t count) {
        std::vector<OutlinePoint> points;
        while (points.size() < count && left_ >= 4) {
            const double r = (byte() * 256 + byte()) / 65535.0;
            const double y = (byte() * 256 + byte()) / 65535.0 * 2.5 - 0.5;
            points.push_back({r * 0.25, y * 0.25});
        }
        return points;
    }

  private:
    const std::uint8_t* data_;
    std::size_t left_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Points points(data, size);
    Silhouette silhouette;
    const std::uint8_t shape = points.byte();
    silhouette.junction = shape & 1 ? Join::smooth : Join::corner;
    silhouette.margin = shape & 2 ? Join::smooth : Join::corner;
    silhouette.stem = points.take(2 + (shape >> 2) % 8);
    silhouette.hymenium = points.take(shape >> 5);
    silhouette.cap = points.take(32);
    if (shape & 16 && !silhouette.cap.empty() && !silhouette.stem.empty()) {
        silhouette.stem.front().r = 0;  // so that most inputs pass the first checks
        silhouette.cap.back().r = 0;
        if (!silhouette.hymenium.empty()) silhouette.hymenium.front() = silhouette.stem.back();
        silhouette.cap.front() =
            silhouette.hymenium.empty() ? silhouette.stem.back() : silhouette.hymenium.back();
    }

    std::vector<Problem> problems;
    check(silhouette, Info{.name = ""}, "", problems);
    if (!problems.empty()) return 0;
    try {
        const Outline outline(silhouette);
        for (const SubCurve* curve : {&outline.stem, &outline.hymenium, &outline.cap}) {
            if (curve->empty()) continue;
            expect(std::isfinite(curve->length()), "lengths are finite");
            double share = 0;
            for (const OutlineSample& sample : curve->sampled(24)) {
                expect(std::isfinite(sample.r) && std::isfinite(sample.y), "points are finite");
                expect(sample.r >= 0, "radii are not negative");
                expect(sample.share >= share && sample.share <= 1, "samples go forward");
                const double tangent =
                    sample.tangent_r * sample.tangent_r + sample.tangent_y * sample.tangent_y;
                expect(std::abs(tangent - 1) < 1e-6, "tangents are unit vectors");
                share = sample.share;
            }
        }
    } catch (const InvalidInput&) {
        // refused with a reason, as specified
    }
    return 0;
}
