#include "core/plant/lamina.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

constexpr double least_abscissa_gap = 4e-3;

class LaminaMesher {
  public:
    LaminaMesher(const Lamina& lamina, std::vector<double> rows, std::size_t fill)
        : lamina_(lamina), rows_(std::move(rows)) {
        const std::size_t lobes = lamina.lobes.size();
        for (std::size_t i = 0; i < lobes; ++i)
            for (std::size_t side = 0; side < 2; ++side)
                abscissas_.push_back(
                    abscissas_of(lamina.lobes[i], lamina.lobes[i].halves[side], fill));
        root_ = add({});
        for (std::size_t i = 0; i + 1 < lobes; ++i) seams_.push_back(seam(i));
        for (std::size_t i = 0; i < lobes; ++i) {
            const Line middle = main_vein(i);
            half(i, 0, middle);
            half(i, 1, middle);
        }
    }

    LaminaMesh take() { return std::move(made_); }

  private:
    // Vertices along a line, with their positions on it.
    struct Line {
        std::vector<double> at;
        std::vector<std::uint32_t> vertices;

        // Returns the vertices between two positions, both included.
        [[nodiscard]] std::vector<std::uint32_t> between(double from, double to) const {
            std::vector<std::uint32_t> found;
            for (std::size_t i = 0; i < at.size(); ++i)
                if (at[i] >= from - tolerance && at[i] <= to + tolerance)
                    found.push_back(vertices[i]);
            return found;
        }
    };
    static constexpr double tolerance = 1e-7;

    static std::vector<double> abscissas_of(const Lobe& lobe, const HalfLobe& half,
                                            std::size_t fill) {
        std::vector<double> abscissas = half.abscissas;
        const auto put = [&](double abscissa) {
            const auto after = std::lower_bound(abscissas.begin(), abscissas.end(), abscissa);
            if (after == abscissas.begin() || after == abscissas.end()) return;
            if (*after - abscissa < least_abscissa_gap * lobe.reach ||
                abscissa - *(after - 1) < least_abscissa_gap * lobe.reach)
                return;
            abscissas.insert(after, abscissa);
        };
        if (fill == 0) return abscissas;
        std::vector<double> veins = {0.0};
        for (const HalfLobe::SideVein& vein : half.side_veins) veins.push_back(vein.abscissa);
        veins.push_back(lobe.nodes.back());
        for (std::size_t i = 1; i < veins.size(); ++i) {
            for (std::size_t k = 1; k < fill; ++k)
                put(veins[i - 1] +
                    (veins[i] - veins[i - 1]) * static_cast<double>(k) / static_cast<double>(fill));
            put(veins[i]);
        }
        return abscissas;
    }

    std::uint32_t add(const LaminaVertex& vertex) {
        made_.vertices.push_back(vertex);
        return static_cast<std::uint32_t>(made_.vertices.size() - 1);
    }

    void triangle(bool mirrored, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (mirrored)
            made_.triangles.push_back({a, c, b});
        else
            made_.triangles.push_back({a, b, c});
    }

    static void sort_unique(std::vector<double>& sorted) {
        std::sort(sorted.begin(), sorted.end());
        sorted.erase(std::unique(sorted.begin(), sorted.end(),
                                 [](double a, double b) { return b - a < tolerance; }),
                     sorted.end());
    }

    Line main_vein(std::size_t lobe) {
        const Lobe& one = lamina_.lobes[lobe];
        Line line{abscissas_[2 * lobe], {}};
        line.at.insert(line.at.end(), abscissas_[2 * lobe + 1].begin(),
                       abscissas_[2 * lobe + 1].end());
        sort_unique(line.at);
        for (std::size_t i = 0; i < line.at.size(); ++i) {
            LaminaVertex vertex;
            vertex.place = one.place(0, line.at[i], 0.0);
            const double share = line.at[i] / one.reach;
            vertex.groove = 1.0 - share;
            vertex.rib = 1.0 - 0.9 * share;
            for (std::size_t side = 0; side < 2; ++side)
                vertex.breadth += 0.5 * half_breadth(one, side, line.at[i]);
            vertex.rim = i + 1 == line.at.size();
            line.vertices.push_back(i == 0 ? root_ : add(vertex));
        }
        return line;
    }

    // Returns the ray between a lobe and the next, by distance from the root.
    Line seam(std::size_t lobe) {
        const Lobe& right = lamina_.lobes[lobe];
        Line line;
        for (std::size_t k = 0; k < 2; ++k) {
            const Lobe& one = lamina_.lobes[lobe + k];
            const HalfLobe& half = one.halves[k];
            for (const double abscissa : abscissas_[2 * (lobe + k) + k])
                if (abscissa <= half.joined) line.at.push_back(distance(one, k, abscissa));
        }
        sort_unique(line.at);
        const SineCosine ray = sine_cosine(right.turn + right.halves[0].limit);
        for (std::size_t i = 0; i < line.at.size(); ++i) {
            LaminaVertex vertex;
            vertex.place = line.at[i] * glm::dvec2(-ray.sine, ray.cosine);
            vertex.affinity = 1.0;
            vertex.breadth = line.at[i];
            vertex.rim = i + 1 == line.at.size();
            line.vertices.push_back(i == 0 ? root_ : add(vertex));
        }
        return line;
    }

    // Returns the distance of the border from the main vein on the line of an abscissa.
    static double half_breadth(const Lobe& lobe, std::size_t side, double abscissa) {
        return lobe.halves[side].height(abscissa) * sine_cosine(lobe.angle(side, abscissa)).sine;
    }

    static double distance(const Lobe& lobe, std::size_t side, double abscissa) {
        return glm::length(lobe.place(side, abscissa, lobe.halves[side].height(abscissa)));
    }

    void half(std::size_t lobe, std::size_t side, const Line& middle) {
        const Lobe& one = lamina_.lobes[lobe];
        const HalfLobe& half = one.halves[side];
        const std::vector<double>& abscissas = abscissas_[2 * lobe + side];
        const Line* seam = nullptr;
        if (half.joined > 0.0) seam = &seams_[side == 0 ? lobe : lobe - 1];
        const Grid grid = half_grid(lobe, side, seam);
        for (std::size_t i = 0; i + 1 < abscissas.size(); ++i) {
            Column column{side == 1, i == 0,      i + 2 == abscissas.size(), {}, {},
                          grid[i],   grid[i + 1], middle.vertices.back()};
            column.inner = middle.between(abscissas[i], abscissas[i + 1]);
            if (seam != nullptr && abscissas[i + 1] <= half.joined)
                column.outer = seam->between(distance(one, side, abscissas[i]),
                                             distance(one, side, abscissas[i + 1]));
            else
                column.outer = {column.first ? root_ : grid[i].back(),
                                column.last ? column.tip : grid[i + 1].back()};
            if (rows_.size() == 2)
                fill_low_column(column);
            else
                fill_column(column);
        }
    }

    // A grid lists the vertices of each abscissa, from the first row off the main vein to the
    // border.
    using Grid = std::vector<std::vector<std::uint32_t>>;

    // Adds the vertices of a half between its main vein and its border, which is `seam` where the
    // half is joined to its neighbour.
    Grid half_grid(std::size_t lobe, std::size_t side, const Line* seam) {
        const Lobe& one = lamina_.lobes[lobe];
        const HalfLobe& half = one.halves[side];
        const std::vector<double>& abscissas = abscissas_[2 * lobe + side];
        const std::size_t rows = rows_.size();
        Grid grid(abscissas.size());
        for (std::size_t i = 1; i + 1 < abscissas.size(); ++i)
            for (std::size_t k = 1; k < rows; ++k) {
                if (k + 1 == rows && seam != nullptr && abscissas[i] <= half.joined) {
                    const double t = distance(one, side, abscissas[i]);
                    grid[i].push_back(seam->between(t, t).front());
                    continue;
                }
                LaminaVertex vertex;
                vertex.place = one.place(side, abscissas[i], rows_[k] * half.height(abscissas[i]));
                vertex.affinity = rows_[k];
                vertex.rim = k + 1 == rows;
                vertex.breadth =
                    half_breadth(one, side, abscissas[i]) * std::sqrt(1.0 - rows_[k] * rows_[k]);
                relief(half, abscissas[i], rows_[k] * half.height(abscissas[i]), vertex);
                grid[i].push_back(add(vertex));
            }
        return grid;
    }

    // A column of a half, from one abscissa to the next. The first starts at the root and the last
    // ends at the tip of the main vein, where all rows meet.
    struct Column {
        bool mirrored, first, last;
        std::vector<std::uint32_t> inner, outer;          ///< on the main vein and on the border
        const std::vector<std::uint32_t>&before, &after;  ///< of the grid, at either abscissa
        std::uint32_t tip;                                ///< of the main vein
    };

    // Adds the triangles of a column that has no row between main vein and border.
    void fill_low_column(const Column& column) {
        const auto& [mirrored, first, last, inner, outer, before, after, tip] = column;
        const std::uint32_t apex = outer[first ? 1 : 0];
        for (std::size_t k = 1; k < inner.size(); ++k)
            triangle(mirrored, inner[k - 1], inner[k], apex);
        if (last) return;
        for (std::size_t k = first ? 2 : 1; k < outer.size(); ++k)
            triangle(mirrored, inner.back(), outer[k], outer[k - 1]);
    }

    // Adds the triangles of a column: a fan at the main vein, quads between rows, a fan at the
    // border.
    void fill_column(const Column& column) {
        const auto& [mirrored, first, last, inner, outer, before, after, tip] = column;
        const std::size_t rows = rows_.size();
        const std::uint32_t low_apex = first ? after.front() : before.front();
        for (std::size_t k = 1; k < inner.size(); ++k)
            triangle(mirrored, inner[k - 1], inner[k], low_apex);
        if (!first && !last) triangle(mirrored, inner.back(), after.front(), before.front());
        for (std::size_t k = 1; k + 2 < rows; ++k) {
            const std::uint32_t a0 = first ? root_ : before[k - 1];
            const std::uint32_t b0 = first ? root_ : before[k];
            const std::uint32_t a1 = last ? tip : after[k - 1];
            const std::uint32_t b1 = last ? tip : after[k];
            if (!last) triangle(mirrored, a0, a1, b1);
            if (!first) triangle(mirrored, a0, b1, b0);
        }
        const std::uint32_t near_root = first ? root_ : before[rows - 3];
        const std::uint32_t near_tip = last ? tip : after[rows - 3];
        const std::uint32_t high_apex = first ? near_tip : near_root;
        for (std::size_t k = 1; k < outer.size(); ++k)
            triangle(mirrored, high_apex, outer[k], outer[k - 1]);
        if (!first && !last) triangle(mirrored, near_root, near_tip, outer.back());
    }

    // Adds grooves along side veins and swellings between them; nothing at the border.
    static void relief(const HalfLobe& half, double abscissa, double height, LaminaVertex& vertex) {
        const std::vector<HalfLobe::SideVein>& veins = half.side_veins;
        const double fade = 1.0 - vertex.affinity * vertex.affinity;
        double nearest = 1e9, gap = 1.0, length = 0.0;
        for (std::size_t i = 0; i < veins.size(); ++i) {
            const double away = std::abs(abscissa - veins[i].line(height));
            if (away >= nearest) continue;
            nearest = away;
            length = veins[i].length;
            gap = abscissa < veins[i].abscissa
                      ? veins[i].abscissa - (i == 0 ? 0.0 : veins[i - 1].abscissa)
                      : (i + 1 < veins.size() ? veins[i + 1].abscissa : half.abscissas.back()) -
                            veins[i].abscissa;
        }
        const double from_vein = std::min(nearest / (0.5 * std::max(gap, 1e-9)), 1.0);
        vertex.swell = from_vein * fade * std::min(1.0, 4.0 * vertex.affinity);
        const double on_vein = std::max(0.0, 1.0 - 6.0 * from_vein);
        if (on_vein > 0.0 && height < length) {
            vertex.groove = 0.6 * fade * on_vein;
            vertex.rib = 0.5 * fade * on_vein;
        }
    }

    const Lamina& lamina_;
    std::vector<double> rows_;
    std::vector<std::vector<double>> abscissas_;  ///< of each half, indexed by 2 lobe + side
    LaminaMesh made_;
    std::uint32_t root_ = 0;
    std::vector<Line> seams_;
};

}  // namespace

LaminaMesh lamina_mesh(const Lamina& lamina, std::vector<double> rows, std::size_t fill) {
    return LaminaMesher(lamina, std::move(rows), fill).take();
}

}  // namespace sporeprint
