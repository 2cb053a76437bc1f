// A set of outlines with one parameter in common, so that any weighted mean of them is an outline: the paper's morph for any number of shapes.
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

/// What is known about the outlines between shapes.
struct Certificate {
    bool simple = true;
    ProofMethod method = ProofMethod::exact;
    double detour = 0.0;

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
        visit(&C::detour,
              Info{.name = "detour",
                   .max = 1,
                   .doc = "How far the shapes go over to their mature stages half way, or to a "
                          "round bud, because the straight way would fold; 0 where none does."});
    }
    bool operator==(const Certificate&) const = default;
};

/// The polyline of an outline's rings, base to apex, joins once.
[[nodiscard]] Polyline polyline(const Outline& outline, int lod);

/// The sub-curve of a contact on such a polyline: that of the vertex where the later of the two segments ends, or of the vertex
/// itself that is on the wrong side of the axis. The counts of rings are 0 for a sub-curve that the outline lacks.
[[nodiscard]] CurveName curve_of(const Contact& contact, std::size_t stem_rings,
                                 std::size_t hymenium_rings);

class MorphSet {
  public:
    /// Finds what belongs together and how it is blended without folding.
    ///
    /// shapes    at least one; kin numbered from 0 without gaps, each kin's shapes one after another by age.
    ///           The first kin that has a sub-curve is the hub of that sub-curve: all others are put in correspondence with it,
    ///           so another order of three or more kin may move rings along the outlines a little. Callers sort by id.
    /// arcs      only for two kin, a for kin 0 and b for kin 1; `arcs_age` is the age at which the shares are counted
    /// throws    Impossible for a shape that crosses itself or its rings (path below "/model/silhouette"), for arcs that cross one another or
    ///           leave their curve (path "/arcs/<i>")
    /// cost      about 0.7 ms for two kin of five shapes; up to 2 ms more where many ways fold
    /// source    [Desbenoit2004] sec. 4; [SederbergGreenwood1992]
    explicit MorphSet(const std::vector<ControlShape>& shapes, std::span<const Arc> arcs = {},
                      double arcs_age = 0.6);

    /// The outline of a mix, of unit size: never one that touches itself at any level of detail.
    ///
    /// Blends are straight, unless the straight way between stages of two kin folds: then mixes of these two stages make a detour by
    /// the mature ones or, where these fold too, by a round bud; decided once for the set, so that nothing jumps and every kin alone
    /// is itself. A mix of more that touches itself all the same gives way towards the bud, as little as it must: six of a hundred
    /// thousand random mixes of the atlas do.
    ///
    /// weights  one per control shape, >= 0, sum 1
    /// cost     about 25 us, 10 us more where no certificate covers all mixes, a few milliseconds where a mix gives way
    [[nodiscard]] OutlineNodes nodes(std::span<const double> weights) const;

    /// What is known about all mixes of the set in which every kin has the same age.
    ///
    /// cost  some ms where no certificate covers all weights
    [[nodiscard]] Certificate certificate() const;

    /// What is known about the way from one mix to another, for every moment on it: exact where it is straight; where it makes a
    /// detour it is a polynomial, and certified piece by piece.
    ///
    /// cost  0.05 ms straight, 0.2 ms with a detour
    [[nodiscard]] Certificate certificate(std::span<const double> from,
                                          std::span<const double> to) const;

    /// What belongs together between kin 0 and kin 1 at an age: `count` arcs on each sub-curve that both have.
    [[nodiscard]] std::vector<Arc> arcs(double age, int count) const;

    /// Share of growth weight of each shape within its kin at an age: 1 on a stage, linear between two.
    [[nodiscard]] std::vector<double> growth_weights(double age) const;

    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    [[nodiscard]] std::size_t bytes() const;

  private:
    /// The polylines of all shapes, the bud's last if there is one, [lod][shape].
    using Lines = std::array<std::vector<Polyline>, details.size()>;
    /// From one shape to another.
    using Way = std::array<std::size_t, 2>;

    MorphSet(const std::vector<ControlShape>& shapes, AlignedShapes common);

    [[nodiscard]] const OutlineNodes& shape(std::size_t s) const {
        return s < nodes_.size() ? nodes_[s] : bud_;
    }
    [[nodiscard]] OutlineNodes unchecked(std::span<const double> weights) const;
    /// As many points as the outline has rings, at even steps of u: linear in the weights, so that roots and certificates tell of
    /// every moment. Rings follow the outline's own bends instead, and are looked at one by one.
    [[nodiscard]] Polyline polyline(const OutlineNodes& nodes, int lod) const;
    [[nodiscard]] bool moves_simply(const OutlineNodes& nodes) const;
    [[nodiscard]] bool is_swept_simply(const OutlineNodes& nodes) const;
    [[nodiscard]] CurveName curve_of(const Contact& contact, int lod) const;
    [[nodiscard]] bool certified(std::span<const std::size_t> shapes) const;
    [[nodiscard]] Lines lines() const;
    [[nodiscard]] std::vector<Way> folding(const Lines& lines, const Kin& i, const Kin& j) const;
    [[nodiscard]] bool curved_ways_are_simple(const Lines& lines, std::span<const Way> ways) const;
    [[nodiscard]] bool curved_way_touches_half_way(const std::vector<Polyline>& shapes,
                                                   std::span<const double> from,
                                                   std::span<const double> to) const;
    [[nodiscard]] bool curved_way_is_simple(const std::vector<Polyline>& shapes,
                                            std::span<const double> from,
                                            std::span<const double> to) const;
    void certify(const Lines& lines);
    void choose_detours(const Lines& lines, std::size_t i, std::size_t j);

    std::vector<Kin> kins_;
    Detours detours_;
    OutlineNodes bud_;  ///< empty where no way leads by it
    bool for_any_weights_ = false;
    std::vector<double> ages_;
    std::vector<OutlineNodes> nodes_;
};

}  // namespace sporeprint
