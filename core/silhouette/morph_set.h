// A set of outlines with a common parameter, so that any weighted mean of them is an outline: the
// paper's morph for any number of shapes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/mesh/detail.h"
#include "core/silhouette/aligned.h"
#include "core/silhouette/indirect_path.h"
#include "core/silhouette/outline.h"
#include "core/silhouette/proof.h"

namespace sporeprint {

/// The proven properties of the outlines between shapes.
struct Certificate {
    bool simple = true;
    ProofMethod method = ProofMethod::exact;
    double indirect = 0.0;

    static constexpr void fields(auto visit) {
        using C = Certificate;
        visit(&C::simple,
              Info{.name = "simple", .doc = "Whether no outline on the way touches itself."});
        visit(
            &C::method,
            Info{.name = "method",
                 .doc = "exact: by the roots of the moving polylines, for every moment; "
                        "certificate: what keeps segments apart holds for all weights; checked: "
                        "mixes are checked when they are made, and give way towards a round bud if "
                        "they touch themselves."});
        visit(&C::indirect,
              Info{.name = "detour",
                   .max = 1,
                   .doc = "How far the shapes go over to their mature stages half way, or to a "
                          "round bud, because the straight way would fold; 0 where none does."});
    }
    bool operator==(const Certificate&) const = default;
};

/// Returns the polyline of an outline's rings, base to apex, with each join once.
[[nodiscard]] Polyline polyline(const Outline& outline, DetailLevel level);

/// Returns the sub-curve of an intersection on such a polyline: that of the vertex where the later
/// of the two segments ends, or of the vertex itself that is on the wrong side of the axis. The
/// counts of rings are 0 for a sub-curve that the outline lacks.
[[nodiscard]] CurveName curve_of(const Intersection& intersection, std::size_t stem_rings,
                                 std::size_t hymenium_rings);

/// A set of outlines that blend without self-intersection; immutable.
class MorphSet {
  public:
    /// Computes the correspondence of the shapes and the paths by which they blend without
    /// self-intersection.
    ///
    /// shapes    at least one; species numbered from 0 without gaps, the shapes of each contiguous
    ///           and ascending by age. The first species that has a sub-curve is the hub of that
    ///           sub-curve: all others are put in correspondence with it, so another order of three
    ///           or more species may move rings along the outlines a little. Callers sort by id.
    /// arcs      only for two species, a for species 0 and b for species 1; `arcs_age` is the age
    ///           at which the shares are counted
    /// throws    Impossible for a shape that crosses itself or its rings (path below
    ///           "/model/silhouette"), for arcs that cross one another or leave their curve (path
    ///           "/arcs/<i>")
    /// cost      about 0.7 ms for two species of five shapes; up to 2 ms more where many linear
    ///           interpolations self-intersect
    /// source    [Desbenoit2004] sec. 4; [SederbergGreenwood1992]
    explicit MorphSet(const std::vector<ControlShape>& shapes, std::span<const Arc> arcs = {},
                      double arcs_age = 0.6);

    /// Returns the outline of a mix, of unit size; it never self-intersects at any level of detail.
    ///
    /// Blends are linear, unless the linear interpolation between stages of two species
    /// self-intersects: then mixes of these two stages pass through the mature ones or, where these
    /// self-intersect too, through a round intermediate shape. This is decided once for the set, so
    /// that morphs are continuous and weight 1 reproduces each single species. A mix of more shapes
    /// that self-intersects all the same is moved towards the intermediate shape by the least step
    /// that is simple: six of a hundred thousand random mixes of the atlas are.
    ///
    /// weights  one per control shape, >= 0, sum 1
    /// cost     about 25 us, 10 us more where no certificate covers all mixes, a few milliseconds
    ///          where a mix is moved
    [[nodiscard]] OutlineNodes nodes(std::span<const double> weights) const;

    /// Returns what is proven about all mixes of the set in which every species has the same age.
    ///
    /// cost  some ms where no certificate covers all weights
    [[nodiscard]] Certificate certificate() const;

    /// Returns what is proven about the path from one mix to another at every moment: exact where
    /// it is linear; an indirect path is a polynomial and is certified piece by piece.
    ///
    /// cost  0.05 ms for a linear path, 0.2 ms for an indirect one
    [[nodiscard]] Certificate certificate(std::span<const double> from,
                                          std::span<const double> to) const;

    /// Returns the correspondence between species 0 and species 1 at an age: `count` arcs on each
    /// sub-curve that both have.
    [[nodiscard]] std::vector<Arc> arcs(double age, int count) const;

    /// Returns the growth weight of each shape within its species at an age: 1 on a stage, linear
    /// between two.
    [[nodiscard]] std::vector<double> growth_weights(double age) const;

    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    [[nodiscard]] std::size_t bytes() const;

  private:
    /// The polylines of all shapes at [lod][shape], the intermediate shape's last if there is one.
    using Lines = std::array<std::vector<Polyline>, details.size()>;
    /// The two ends of a path, as indices of shapes.
    using PathEnds = std::array<std::size_t, 2>;

    MorphSet(const std::vector<ControlShape>& shapes, AlignedShapes common);

    [[nodiscard]] const OutlineNodes& shape(std::size_t s) const {
        return s < nodes_.size() ? nodes_[s] : intermediate_;
    }
    [[nodiscard]] OutlineNodes unchecked(std::span<const double> weights) const;
    /// Returns as many points as the outline has rings, at even steps of u: they are linear in the
    /// weights, so that roots and certificates cover every moment. The swept rings follow the
    /// outline's bends instead and are checked one by one.
    [[nodiscard]] Polyline polyline(const OutlineNodes& nodes, int lod) const;
    [[nodiscard]] bool uniform_polylines_are_simple(const OutlineNodes& nodes) const;
    [[nodiscard]] bool swept_polylines_are_simple(const OutlineNodes& nodes) const;
    [[nodiscard]] CurveName curve_of(const Intersection& intersection, int lod) const;
    [[nodiscard]] bool certified(std::span<const std::size_t> shapes) const;
    [[nodiscard]] Lines lines() const;
    [[nodiscard]] std::vector<PathEnds> crossing_paths(const Lines& lines, const SpeciesRange& i,
                                                       const SpeciesRange& j) const;
    [[nodiscard]] bool curved_paths_are_simple(const Lines& lines,
                                               std::span<const PathEnds> paths) const;
    [[nodiscard]] bool curved_path_intersects_at_midpoint(const std::vector<Polyline>& shapes,
                                                          std::span<const double> from,
                                                          std::span<const double> to) const;
    [[nodiscard]] bool curved_path_is_simple(const std::vector<Polyline>& shapes,
                                             std::span<const double> from,
                                             std::span<const double> to) const;
    void certify(const Lines& lines);
    void choose_indirect_paths(const Lines& lines, std::size_t i, std::size_t j);

    std::vector<SpeciesRange> species_;
    IndirectPaths indirect_paths_;
    OutlineNodes intermediate_;  ///< empty if no path passes through it
    bool certified_for_all_weights_ = false;
    std::vector<double> ages_;
    std::vector<OutlineNodes> nodes_;
};

}  // namespace sporeprint
