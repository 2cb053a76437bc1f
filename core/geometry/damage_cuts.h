// Margin cuts: what bites, splits and deliquescence remove from the margin, and the mesh columns
// that represent them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/individual/damage.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"

namespace sporeprint {

/// A notch of a species, and its present size: 0..1, of one with the species' weight.
struct SizedNotch {
    Notch notch;
    double size = 0.0;
};

/// Returns how many of a level's cuts of a kind a species of a mix has: together they have as many as
/// one alone, because a pair needs its triangles for other parts.
///
/// limit    cuts of the kind at the level
/// species  its place in `all`
/// can      whether a species can have the kind
[[nodiscard]] std::size_t own_share(int limit, std::span<const MarginDamage> all,
                                    std::size_t species, bool MarginDamage::*can);

/// Computes, for each angle round the axis (radians), where the upper and the lower face end. A cut
/// removes about the same length from both meridians; the remaining surface is compressed along its
/// meridian, so that gills, warts and pores move with it. A zone next to the axis does not move.
///
/// The mesh always has evenly spaced columns; where a cut needs more, columns are inserted between
/// them, whatever the amount of damage. While no cut is open there, inserted columns are collapsed
/// onto the chord between their neighbours, close to the left one. The surface of a species with an
/// uncut margin is then the same, whether or not other species of its mix can have cuts.
class MarginCuts {
  public:
    /// The factor by which a collapsed column's share of its chord (0 left end, 1 right end) is
    /// reduced: collapsed columns lie close to the left end, in their order. If they lay in the
    /// middle, they would divide quads that are twisted on folded surfaces, and either half would
    /// bend differently from the whole.
    static constexpr double collapsed_width = 0.02;

    /// cost  about 20 us; constructed once per mesh
    MarginCuts(const Individual& individual, DetailLevel level);

    /// Returns true when no cut is open.
    [[nodiscard]] bool none() const { return open_.empty() && melted_ <= 0.0; }

    /// Returns true when the margin would be cut at some amount of damage, whatever the present
    /// one is.
    [[nodiscard]] bool possible() const { return possible_; }

    /// Returns the share of the upper face's meridian to which the cut at an angle moves the share
    /// `sigma`; both are 0 at the apex and 1 at the uncut margin.
    [[nodiscard]] double cap(double sigma, double angle) const {
        return none() ? sigma : cap_to(sigma, cap_end(angle));
    }

    /// Returns the same for the lower face, whose shares are 0 at the stem and 1 at the uncut
    /// margin.
    [[nodiscard]] double lower(double share, double angle) const {
        return none() ? share : lower_to(share, lower_end(angle));
    }

    /// Return the same as cap() and lower() for a face that ends at the share `end`.
    [[nodiscard]] static double cap_to(double sigma, double end);
    [[nodiscard]] static double lower_to(double share, double end);

    /// Return the shares at which the faces end at an angle: 1 where nothing is cut.
    [[nodiscard]] double cap_end(double angle) const;
    [[nodiscard]] double lower_end(double angle) const;

    /// Returns the length removed from the cap at an angle, metres; linear between columns, as the margin of the
    /// mesh is.
    [[nodiscard]] double depth(double angle) const;

    /// Returns how far the lips of splits are raised from the margin at an angle, metres; nowhere
    /// while no split is open.
    [[nodiscard]] double lift(double angle) const;

    /// Returns the positions of the columns, in turns (0..1), increasing from 0. They do not depend
    /// on the amounts of damage.
    [[nodiscard]] const std::vector<double>& turns() const { return turns_; }

    /// Returns the positions of the columns after collapsing those of closed cuts, in turns,
    /// increasing from 0.
    [[nodiscard]] const std::vector<double>& placed_turns() const { return placed_turns_; }

    /// A column inserted between even ones. While its cut is closed it lies on the chord between
    /// the nearest active columns beside it: even ones and those of open cuts. While other cuts
    /// open, it is a weighted mean over several chords.
    struct InsertedColumn {
        std::size_t column;
        double open;              ///< 0: collapsed onto the chords, 1: at its own position
        std::size_t first, last;  ///< range of its chords
    };
    struct Chord {
        std::size_t left, right;  ///< columns; right may be turns().size(), the repeated first one
        double share;             ///< of the column's own position, from left to right
        double weight;            ///< weights of a column sum to 1
    };
    [[nodiscard]] std::span<const InsertedColumn> inserted_columns() const { return inserted_; }
    [[nodiscard]] std::span<const Chord> chords(const InsertedColumn& column) const {
        return std::span(chords_).subspan(column.first, column.last - column.first);
    }

    /// Returns true when some amount of damage could cut between a column and the next. The mesh
    /// then has faces there for the cut surface between upper and lower face.
    [[nodiscard]] bool may_cut(std::size_t column) const { return may_cut_[column]; }

  private:
    /// A column that a cut needs: its turn, and how far the cut is open.
    struct CutColumn {
        double turn, open;
    };
    struct Open {
        Notch notch;
        double depth;  // at full size, metres
        double size;   // present one, 0..1
    };
    /// Returns the length removed from the cap or from the lower face.
    [[nodiscard]] double cut_at(double angle, bool lower) const;
    [[nodiscard]] std::vector<double> depths_of(bool lower) const;
    [[nodiscard]] double between_columns(const std::vector<double>& depths, double angle) const;
    /// How many columns cuts have.
    struct ColumnLimits {
        int inside;       ///< on each side of a bite's middle, beside its edge
        int long_splits;  ///< how many splits may have one in the middle of each lip, if long
    };
    /// Returns the columns of all notches in the order of their turns.
    [[nodiscard]] static std::vector<CutColumn> columns_of(const std::vector<SizedNotch>& notches,
                                                           ColumnLimits limits);
    void place_columns(const std::vector<CutColumn>& own, const std::vector<SizedNotch>& notches,
                       int even);
    void insert_columns(std::size_t left, double to, const std::vector<double>& open);

    std::vector<Open> open_;
    std::vector<double> turns_, placed_turns_;
    // Per column, the first one repeated; empty when nothing is cut.
    std::vector<double> depths_, lower_depths_;
    std::vector<InsertedColumn> inserted_;
    std::vector<Chord> chords_;
    std::vector<bool> may_cut_;
    double cap_length_ = 0.0, lower_length_ = 0.0, cap_radius_ = 0.0, melted_ = 0.0, phase_ = 0.0;
    bool melts_ = false, possible_ = false;
};

}  // namespace sporeprint
