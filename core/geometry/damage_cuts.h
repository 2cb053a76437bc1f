// What bites, splits and melting take off the margin, and the columns of a mesh that can show it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/individual/damage.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// Where cap and lower face end. A cut takes the same length off both meridians; what lies further in moves along its meridian, so
/// that images stretch only there and gills, warts and pores follow.
///
/// Columns of the mesh stand evenly, whatever can be cut, and where a cut needs more there are more between them. Those are laid onto
/// the straight way between their even neighbours, beside the left one, as long as no cut is open there: a species of whose margin
/// nothing is gone has the same surface whether others of its mix can be bitten or not.
class Cuts {
  public:
    /// Where the columns of closed cuts are laid, in shares of their places along their ways: beside the left end, each in its turn.
    /// In the middle they would divide quads, and those of folded skin are twisted: either half would bend another way than the whole.
    static constexpr double closed_width = 0.02;

    /// cost  some twenty microseconds; made once for a mesh
    Cuts(const Individual& individual, int lod);

    /// Whether nothing is cut at present.
    [[nodiscard]] bool none() const { return open_.empty() && melted_ <= 0.0; }

    /// Whether some amount could cut anything.
    [[nodiscard]] bool possible() const { return possible_; }

    /// Where a place of the upper face goes; sigma 0 at the apex, 1 at the margin.
    [[nodiscard]] double cap(double sigma, double angle) const {
        return none() ? sigma : cap_to(sigma, cap_end(angle));
    }

    /// Where a place of the lower face goes; share 0 at the stem, 1 at the margin.
    [[nodiscard]] double lower(double share, double angle) const {
        return none() ? share : lower_to(share, lower_end(angle));
    }

    /// The same where the face ends at `end`.
    [[nodiscard]] static double cap_to(double sigma, double end);
    [[nodiscard]] static double lower_to(double share, double end);

    /// Where the faces end at an angle, in the same shares: 1 where nothing is cut.
    [[nodiscard]] double cap_end(double angle) const;
    [[nodiscard]] double lower_end(double angle) const;

    /// Length taken off at an angle, metres: straight from column to column, as the margin of the mesh runs.
    [[nodiscard]] double depth(double angle) const;

    /// Places of the columns, in turns, rising from 0. Equal for all amounts.
    [[nodiscard]] const std::vector<double>& turns() const { return turns_; }

    /// Where the columns stand once those of closed cuts are laid, in turns, rising from 0.
    [[nodiscard]] const std::vector<double>& laid() const { return laid_; }

    /// A column that stands between even ones. As far as its cut is closed it lies on the straight way between the columns that count
    /// beside it: even ones and those of open cuts. While others open it lies on several ways, by their weights.
    struct Between {
        std::size_t column;
        double open;              ///< 0: laid onto those ways, 1: at its own place
        std::size_t first, last;  ///< of its ways
    };
    struct Way {
        std::size_t left, right;  ///< columns; right may be turns().size(), the repeated first one
        double share;             ///< of its own place, from left to right
        double weight;            ///< those of a column sum to 1
    };
    [[nodiscard]] std::span<const Between> between() const { return between_; }
    [[nodiscard]] std::span<const Way> ways(const Between& column) const {
        return std::span(ways_).subspan(column.first, column.last - column.first);
    }

    /// Whether some amount could cut between a column and the next: where walls may stand, whatever the amounts are at present.
    [[nodiscard]] bool may_cut(std::size_t column) const { return may_cut_[column]; }

  private:
    struct Open {
        Notch notch;
        double depth;  // metres, at present
    };
    [[nodiscard]] double cut_at(double angle) const;
    void place_columns(const std::vector<Notch>& notches, const WeatheringOf<Plain>& amounts,
                       int inside, int even);

    std::vector<Open> open_;
    std::vector<double> turns_, laid_;
    std::vector<double> depths_;  // of the columns and, again, the first; empty when nothing is cut
    std::vector<Between> between_;
    std::vector<Way> ways_;
    std::vector<bool> may_cut_;
    double cap_length_ = 0.0, lower_length_ = 0.0, melted_ = 0.0, phase_ = 0.0;
    bool melts_ = false, possible_ = false;
};

}  // namespace sporeprint
