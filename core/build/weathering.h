// Weathering as geometry: margins cut back, walls of flesh, lumps, furrows and pits, rolled skin, drips and drops. All of it reads the places of core/model/marks.h; paint reads the same.
#pragma once

#include <cstdint>
#include <vector>

#include "core/build/cuts.h"
#include "core/mesh/mesh.h"
#include "core/model/individual.h"
#include "core/model/marks.h"
#include "core/surface/charts.h"

namespace sporeprint {

/// A face of a swept mesh: `shares.size()` rings of `columns + 1` vertices.
struct FaceGrid {
    Part part = Part::cap;
    std::uint32_t first = 0;
    std::vector<double> shares;  ///< of the part's own sub-curve, base to apex
};

/// The body of a swept mesh.
struct SweptBody {
    FaceGrid stem, hymenium, cap;  ///< no rings where a form has no lower face
};

/// A melting margin rolls up and outwards. What stands on the faces goes with them.
class Curl {
  public:
    Curl() = default;

    /// away  where each column of `cuts`, which must outlive this, goes to: unit vectors
    Curl(const Individual& individual, const Cuts& cuts, std::vector<glm::dvec3> away);

    [[nodiscard]] bool none() const { return away_.empty(); }

    /// How far a place goes, metres. at: on the cap its sigma, on the lower face its share, where the cuts have brought it
    [[nodiscard]] glm::dvec3 moved(bool cap, double at, double angle) const;

    /// The same in a column, where the faces end there.
    [[nodiscard]] glm::dvec3 moved(bool cap, double at, double cap_end, double lower_end,
                                   std::size_t column) const;

    /// How much of its new normal a vertex takes that has gone so far, 0..1.
    [[nodiscard]] double turned(const glm::dvec3& by) const;

  private:
    [[nodiscard]] double height(bool cap, double at, double cap_end, double lower_end) const;

    const Cuts* cuts_ = nullptr;
    double cap_length_ = 0.0, lower_length_ = 0.0, reach_ = 0.0, most_ = 0.0;
    std::vector<glm::dvec3> away_;
};

/// What weathering adds to a mesh; no amount changes it.
struct WeatheringCount {
    std::uint64_t columns = 0;  ///< of the body
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;  ///< when all is there
};
[[nodiscard]] WeatheringCount weathering_count(const Individual& individual, int lod);

/// Moves the vertices of a body that has just been swept: dents it, cuts it back and closes the cuts; then adds what stands on it.
/// An individual that nothing can wear is left as it is, to the bit.
///
/// body, cuts   the columns of the body are those of the cuts
/// keep_absent  whether triangles of what is absent stay, without area
Curl weather(Mesh& mesh, const SweptBody& body, const Individual& individual, const Cuts& cuts,
             int lod, bool keep_absent);

/// Lumps and furrows of the skin: what stands on it, or is all but gone, goes with them.
class Dents {
  public:
    explicit Dents(const Individual& individual);

    /// Height at a place of the cap (sigma 0 at the apex) or the stem (sigma 0 at the ground), metres.
    [[nodiscard]] double cap(double sigma, double angle) const;
    [[nodiscard]] double stem(double sigma, double angle) const;

  private:
    [[nodiscard]] double lumps(const SubCurve& curve, const std::vector<Mark>& marks, double unit,
                               bool stem, double sigma, double angle) const;
    [[nodiscard]] double furrow(double sigma, double angle, bool on_stem) const;

    const Outline& outline_;
    std::vector<Mark> cap_lumps_, stem_lumps_;
    std::vector<Furrow> furrows_;
    double bumps_, creases_, clubs_, radius_ = 0.0;
};

}  // namespace sporeprint
