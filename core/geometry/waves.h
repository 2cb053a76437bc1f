// Waves of the margin, which has grown longer than its circle.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "core/math/elementary.h"

namespace sporeprint {

/// Height added at a share of a face (0 centre, 1 margin) by the waves of the margin, with
/// derivatives.
class Waves {
  public:
    /// A species of a mix; weights of a mix sum to 1.
    struct Species {
        std::uint32_t stream = 0;  ///< its object in random streams: stream_of() its id
        double weight = 1.0;
    };

    /// Each species has waves of its own at a seed; those of a mix are their weighted sum, so that
    /// they change gradually with the weights.
    ///
    /// amount      of waves, 0..1
    /// cap_radius  metres
    /// columns     of the mesh; waves too fine for them are left out
    Waves(double amount, double cap_radius, int columns, std::uint32_t seed,
          std::span<const Species> mix);

    struct Value {
        double height = 0.0, by_share = 0.0, by_angle = 0.0;
    };
    [[nodiscard]] bool flat() const { return amplitude_ == 0.0; }
    [[nodiscard]] Value at(double share, double angle) const { return at(share, phases(angle)); }

    /// Numbers of crests that a wave of some species can have, and the share of the face at which
    /// it begins. Finer waves begin nearer to the edge, as in any sheet whose edge has grown longer
    /// than its circle.
    struct Form {
        int count;
        double from;
    };
    static constexpr std::array<Form, 9> forms = {{{3, 0.35},
                                                   {4, 0.35},
                                                   {5, 0.35},
                                                   {5, 0.5},
                                                   {6, 0.5},
                                                   {7, 0.5},
                                                   {9, 0.68},
                                                   {11, 0.68},
                                                   {13, 0.68}}};

    /// Phases of the waves at an azimuth; computed once per column.
    using Phases = std::array<SineCosine, forms.size()>;
    [[nodiscard]] Phases phases(double angle) const;
    [[nodiscard]] Value at(double share, const Phases& phases) const;

  private:
    struct Mode {
        Form form;
        glm::dvec2 size;  ///< of its cosine and of its sine
    };
    double amplitude_;  ///< metres
    std::vector<Mode> modes_;
};

}  // namespace sporeprint
