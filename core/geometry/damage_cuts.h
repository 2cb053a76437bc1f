// Margin cuts: what bites, splits and deliquescence remove from the margin, and the mesh columns
// that represent them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/individual/damage.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// Ends of cap and lower face by angle. A cut removes the same length from both meridians; what
/// lies further in moves along its meridian, so that images stretch only there and gills, warts and
/// pores follow.
///
/// The mesh always has evenly spaced columns; where a cut needs more, columns are inserted between
/// them. Inserted columns are collapsed onto the chord between their neighbours, next to the left
/// one, while no cut is open there: a species with an uncut margin then has the same surface
/// whether or not other species of its mix can be bitten.
class MarginCuts {
  public:
    /// Position of collapsed columns on their chord, as a factor on their own share of it: next to
    /// the left end, in order. In the middle they would divide quads, which are twisted on folded
    /// surfaces, so that either half would bend differently from the whole.
    static constexpr double collapsed_width = 0.02;

    /// cost  about 20 us; constructed once per mesh
    MarginCuts(const Individual& individual, int lod);

    /// Returns true when no cut is open.
    [[nodiscard]] bool none() const { return open_.empty() && melted_ <= 0.0; }

    /// Returns true when some amount of damage could cut the margin.
    [[nodiscard]] bool possible() const { return possible_; }

    /// Returns where a place of the upper face moves to; sigma is 0 at the apex and 1 at the
    /// margin.
    [[nodiscard]] double cap(double sigma, double angle) const {
        return none() ? sigma : cap_to(sigma, cap_end(angle));
    }

    /// Returns where a place of the lower face moves to; share is 0 at the stem and 1 at the
    /// margin.
    [[nodiscard]] double lower(double share, double angle) const {
        return none() ? share : lower_to(share, lower_end(angle));
    }

    /// Return the same for a face that ends at `end`.
    [[nodiscard]] static double cap_to(double sigma, double end);
    [[nodiscard]] static double lower_to(double share, double end);

    /// Return where the faces end at an angle, in the same shares: 1 where nothing is cut.
    [[nodiscard]] double cap_end(double angle) const;
    [[nodiscard]] double lower_end(double angle) const;

    /// Returns the length removed at an angle, metres; linear between columns, as the margin of the
    /// mesh is.
    [[nodiscard]] double depth(double angle) const;

    /// Returns the positions of the columns, in turns, increasing from 0; equal for all amounts.
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

    /// Returns true when some amount could cut between a column and the next, so that walls may be
    /// needed there.
    [[nodiscard]] bool may_cut(std::size_t column) const { return may_cut_[column]; }

  private:
    struct Open {
        Notch notch;
        double depth;  // current depth, metres
    };
    [[nodiscard]] double cut_at(double angle) const;
    void place_columns(const std::vector<Notch>& notches, const WeatheringOf<Plain>& amounts,
                       int inside, int even);

    std::vector<Open> open_;
    std::vector<double> turns_, placed_turns_;
    std::vector<double> depths_;  // per column, the first one repeated; empty when nothing is cut
    std::vector<InsertedColumn> inserted_;
    std::vector<Chord> chords_;
    std::vector<bool> may_cut_;
    double cap_length_ = 0.0, lower_length_ = 0.0, melted_ = 0.0, phase_ = 0.0;
    bool melts_ = false, possible_ = false;
};

}  // namespace sporeprint
