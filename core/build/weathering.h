// Weathering as geometry: margins cut back by bites, tears and melting, walls of flesh, lumps, furrows and pits, rolled skin, drips
// and drops. All of it reads the places of core/model/marks.h; paint reads the same.
#pragma once

#include <cstdint>
#include <vector>

#include "core/build/detail.h"
#include "core/mesh/mesh.h"
#include "core/model/individual.h"
#include "core/surface/charts.h"

namespace sporeprint {

/// Where cap and lower face end. A cut takes the same length off both meridians; what lies further in moves along its meridian, so
/// that images stretch only there and gills, warts and pores follow.
class Cuts {
  public:
    Cuts(const Individual& individual, int lod);

    /// Whether nothing is cut at present.
    [[nodiscard]] bool none() const { return !cut_; }

    /// Where a place of the upper face goes; sigma 0 at the apex, 1 at the margin.
    [[nodiscard]] double cap(double sigma, double angle) const;

    /// Where a place of the lower face goes; share 0 at the stem, 1 at the margin.
    [[nodiscard]] double lower(double share, double angle) const;

    /// Where the faces end at an angle, in the same shares: 1 where nothing is cut.
    [[nodiscard]] double cap_end(double angle) const;
    [[nodiscard]] double lower_end(double angle) const;

    /// Length taken off at an angle, metres.
    [[nodiscard]] double depth(double angle) const;

    /// Whether some amount could cut here: what has walls, whatever the amounts are at present.
    [[nodiscard]] bool reaches(double angle) const;

  private:
    struct Cut {
        double theta, half_width, depth;  // depth in metres, at present
        bool bitten;
    };
    std::vector<Cut> cuts_;
    double cap_length_ = 0.0, lower_length_ = 0.0, melted_ = 0.0, phase_ = 0.0;
    bool melts_ = false, cut_ = false;
};

/// Places of the columns of a mesh, in turns, rising from 0: evenly spaced, and more where a cut needs them. Equal for all amounts.
[[nodiscard]] std::vector<double> column_turns(const Individual& individual, int lod);

/// A face of a swept mesh: `shares.size()` rings of `columns + 1` vertices.
struct FaceGrid {
    Part part = Part::cap;
    std::uint32_t first = 0;
    std::vector<double> shares;  ///< of the part's own sub-curve, base to apex
};

/// The body of a swept mesh.
struct SweptBody {
    FaceGrid stem, hymenium, cap;  ///< no rings where a form has no lower face
    std::vector<double> turns;     ///< of the columns
};

/// What weathering adds to a mesh; no amount changes it.
struct WeatheringCount {
    std::uint64_t columns = 0;  ///< of the body
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;  ///< when all is there
};
[[nodiscard]] WeatheringCount weathering_count(const Individual& individual, int lod);

/// Moves the vertices of a body that has just been swept: dents it, cuts it back and closes the cuts; then adds what stands on it.
/// An individual without any weathering is left as it is, to the bit.
///
/// keep_absent  whether triangles of what is absent stay, without area
void weather(Mesh& mesh, const SweptBody& body, const Individual& individual, int lod,
             bool keep_absent);

/// Height of lumps at a place of the cap (sigma 0 at the apex), metres: what stands on the skin is lifted by it.
[[nodiscard]] double lump_at(const Individual& individual, double sigma, double angle);

}  // namespace sporeprint
