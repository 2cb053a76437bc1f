#include "core/plant/lamina.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

constexpr double least_foot_gap = 4e-3;

class FlatMaker {
  public:
    FlatMaker(const Lamina& lamina, std::vector<double> rows, std::size_t fill)
        : lamina_(lamina), rows_(std::move(rows)) {
        const std::size_t lobes = lamina.lobes.size();
        for (std::size_t i = 0; i < lobes; ++i)
            for (std::size_t side = 0; side < 2; ++side)
                feet_.push_back(feet_of(lamina.lobes[i], lamina.lobes[i].halves[side], fill));
        root_ = add({});
        for (std::size_t i = 0; i + 1 < lobes; ++i) seams_.push_back(seam(i));
        for (std::size_t i = 0; i < lobes; ++i) {
            const Line middle = main_vein(i);
            half(i, 0, middle);
            half(i, 1, middle);
        }
    }

    FlatLamina take() { return std::move(made_); }

  private:
    // Vertices along a line, by how far along it they lie.
    struct Line {
        std::vector<double> at;
        std::vector<std::uint32_t> vertices;

        // Those from one place to another, both included.
        [[nodiscard]] std::vector<std::uint32_t> between(double from, double to) const {
            std::vector<std::uint32_t> found;
            for (std::size_t i = 0; i < at.size(); ++i)
                if (at[i] >= from - tolerance && at[i] <= to + tolerance)
                    found.push_back(vertices[i]);
            return found;
        }
    };
    static constexpr double tolerance = 1e-7;

    static std::vector<double> feet_of(const Lobe& lobe, const HalfLobe& half, std::size_t fill) {
        std::vector<double> feet = half.feet;
        const auto put = [&](double foot) {
            const auto after = std::lower_bound(feet.begin(), feet.end(), foot);
            if (after == feet.begin() || after == feet.end()) return;
            if (*after - foot < least_foot_gap * lobe.reach ||
                foot - *(after - 1) < least_foot_gap * lobe.reach)
                return;
            feet.insert(after, foot);
        };
        if (fill == 0) return feet;
        std::vector<double> veins = {0.0};
        for (const HalfLobe::SideVein& vein : half.side_veins) veins.push_back(vein.foot);
        veins.push_back(lobe.nodes.back());
        for (std::size_t i = 1; i < veins.size(); ++i) {
            for (std::size_t k = 1; k < fill; ++k)
                put(veins[i - 1] +
                    (veins[i] - veins[i - 1]) * static_cast<double>(k) / static_cast<double>(fill));
            put(veins[i]);
        }
        return feet;
    }

    std::uint32_t add(const Flat& vertex) {
        made_.vertices.push_back(vertex);
        return static_cast<std::uint32_t>(made_.vertices.size() - 1);
    }

    void triangle(bool mirrored, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (mirrored)
            made_.triangles.push_back({a, c, b});
        else
            made_.triangles.push_back({a, b, c});
    }

    static void tidy(std::vector<double>& sorted) {
        std::sort(sorted.begin(), sorted.end());
        sorted.erase(std::unique(sorted.begin(), sorted.end(),
                                 [](double a, double b) { return b - a < tolerance; }),
                     sorted.end());
    }

    Line main_vein(std::size_t lobe) {
        const Lobe& one = lamina_.lobes[lobe];
        Line line{feet_[2 * lobe], {}};
        line.at.insert(line.at.end(), feet_[2 * lobe + 1].begin(), feet_[2 * lobe + 1].end());
        tidy(line.at);
        for (std::size_t i = 0; i < line.at.size(); ++i) {
            Flat vertex;
            vertex.place = one.place(0, line.at[i], 0.0);
            const double share = line.at[i] / one.reach;
            vertex.groove = 1.0 - share;
            vertex.rib = 1.0 - 0.9 * share;
            vertex.rim = i + 1 == line.at.size();
            line.vertices.push_back(i == 0 ? root_ : add(vertex));
        }
        return line;
    }

    // The ray between a lobe and the next: by distance from the root.
    Line seam(std::size_t lobe) {
        const Lobe& right = lamina_.lobes[lobe];
        Line line;
        for (std::size_t k = 0; k < 2; ++k) {
            const Lobe& one = lamina_.lobes[lobe + k];
            const HalfLobe& half = one.halves[k];
            for (const double foot : feet_[2 * (lobe + k) + k])
                if (foot <= half.joined) line.at.push_back(distance(one, k, foot));
        }
        tidy(line.at);
        const SineCosine ray = sine_cosine(right.turn + right.halves[0].limit);
        for (std::size_t i = 0; i < line.at.size(); ++i) {
            Flat vertex;
            vertex.place = line.at[i] * glm::dvec2(-ray.sine, ray.cosine);
            vertex.affinity = 1.0;
            vertex.rim = i + 1 == line.at.size();
            line.vertices.push_back(i == 0 ? root_ : add(vertex));
        }
        return line;
    }

    static double distance(const Lobe& lobe, std::size_t side, double foot) {
        return glm::length(lobe.place(side, foot, lobe.halves[side].height(foot)));
    }

    void half(std::size_t lobe, std::size_t side, const Line& middle) {
        const Lobe& one = lamina_.lobes[lobe];
        const HalfLobe& half = one.halves[side];
        const std::vector<double>& feet = feet_[2 * lobe + side];
        const bool mirrored = side == 1;
        const Line* seam = nullptr;
        if (half.joined > 0.0) seam = &seams_[side == 0 ? lobe : lobe - 1];
        // Vertices of each foot, from the first row off the main vein to the border.
        const std::size_t rows = rows_.size();
        std::vector<std::vector<std::uint32_t>> grid(feet.size());
        for (std::size_t i = 1; i + 1 < feet.size(); ++i)
            for (std::size_t k = 1; k < rows; ++k) {
                if (k + 1 == rows && seam != nullptr && feet[i] <= half.joined) {
                    const double t = distance(one, side, feet[i]);
                    grid[i].push_back(seam->between(t, t).front());
                    continue;
                }
                Flat vertex;
                vertex.place = one.place(side, feet[i], rows_[k] * half.height(feet[i]));
                vertex.affinity = rows_[k];
                vertex.rim = k + 1 == rows;
                relief(half, feet[i], rows_[k] * half.height(feet[i]), vertex);
                grid[i].push_back(add(vertex));
            }
        for (std::size_t i = 0; i + 1 < feet.size(); ++i) {
            const bool first = i == 0, last = i + 2 == feet.size();
            const std::vector<std::uint32_t> inner = middle.between(feet[i], feet[i + 1]);
            std::vector<std::uint32_t> outer;
            if (seam != nullptr && feet[i + 1] <= half.joined)
                outer =
                    seam->between(distance(one, side, feet[i]), distance(one, side, feet[i + 1]));
            else
                outer = {first ? root_ : grid[i].back(),
                         last ? middle.vertices.back() : grid[i + 1].back()};
            if (rows == 2) {
                const std::uint32_t apex = outer[first ? 1 : 0];
                for (std::size_t k = 1; k < inner.size(); ++k)
                    triangle(mirrored, inner[k - 1], inner[k], apex);
                if (last) continue;
                for (std::size_t k = first ? 2 : 1; k < outer.size(); ++k)
                    triangle(mirrored, inner.back(), outer[k], outer[k - 1]);
                continue;
            }
            const std::uint32_t low_apex = first ? grid[i + 1].front() : grid[i].front();
            for (std::size_t k = 1; k < inner.size(); ++k)
                triangle(mirrored, inner[k - 1], inner[k], low_apex);
            if (!first && !last)
                triangle(mirrored, inner.back(), grid[i + 1].front(), grid[i].front());
            for (std::size_t k = 1; k + 2 < rows; ++k) {
                const std::uint32_t a0 = first ? root_ : grid[i][k - 1];
                const std::uint32_t b0 = first ? root_ : grid[i][k];
                const std::uint32_t a1 = last ? middle.vertices.back() : grid[i + 1][k - 1];
                const std::uint32_t b1 = last ? middle.vertices.back() : grid[i + 1][k];
                if (!last) triangle(mirrored, a0, a1, b1);
                if (!first) triangle(mirrored, a0, b1, b0);
            }
            const std::uint32_t near_root = first ? root_ : grid[i][rows - 3];
            const std::uint32_t near_tip = last ? middle.vertices.back() : grid[i + 1][rows - 3];
            const std::uint32_t high_apex = first ? near_tip : near_root;
            for (std::size_t k = 1; k < outer.size(); ++k)
                triangle(mirrored, high_apex, outer[k], outer[k - 1]);
            if (!first && !last) triangle(mirrored, near_root, near_tip, outer.back());
        }
    }

    // Grooves over side veins, swells between them; nothing at the border.
    static void relief(const HalfLobe& half, double foot, double height, Flat& vertex) {
        const std::vector<HalfLobe::SideVein>& veins = half.side_veins;
        const double fade = 1.0 - vertex.affinity * vertex.affinity;
        double nearest = 1e9, gap = 1.0, length = 0.0;
        for (std::size_t i = 0; i < veins.size(); ++i) {
            const double away = std::abs(foot - veins[i].foot);
            if (away >= nearest) continue;
            nearest = away;
            length = veins[i].length;
            gap =
                foot < veins[i].foot
                    ? veins[i].foot - (i == 0 ? 0.0 : veins[i - 1].foot)
                    : (i + 1 < veins.size() ? veins[i + 1].foot : half.feet.back()) - veins[i].foot;
        }
        const double from_vein = std::min(nearest / (0.5 * std::max(gap, 1e-9)), 1.0);
        vertex.swell = from_vein * fade * std::min(1.0, 4.0 * vertex.affinity);
        if (from_vein < 0.05 && height < length) {
            vertex.groove = 0.6 * fade;
            vertex.rib = 0.5 * fade;
        }
    }

    const Lamina& lamina_;
    std::vector<double> rows_;
    std::vector<std::vector<double>> feet_;  ///< of each half: 2 lobe + side
    FlatLamina made_;
    std::uint32_t root_ = 0;
    std::vector<Line> seams_;
};

}  // namespace

FlatLamina flat_lamina(const Lamina& lamina, std::vector<double> rows, std::size_t fill) {
    return FlatMaker(lamina, std::move(rows), fill).take();
}

}  // namespace sporeprint
