#include "core/geometry/segment_relief.h"

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/noise.h"

namespace sporeprint {

namespace {

// No source or measurement is recorded for the values of this file.

/// An octave of the relief: its wavelength in radii of a trunk, and its height in radii of a tube for
/// a gnarl of 1.
struct Octave {
    double length, height;
};
constexpr std::array<Octave, 3> octaves = {{{2.1, 0.55}, {0.8, 0.45}, {0.33, 0.2}}};

/// How much longer than wide swellings are: segments are ribbed along, and they stand upright.
constexpr double upright = 2.2;

/// Distance over which slopes of an octave are taken, in its wavelength.
constexpr double slope_step = 0.05;

/// Noise of one octave at places that are moved by one step.
class Samples {
  public:
    explicit Samples(std::size_t count) : x_(count), y_(count), z_(count), noise_(count) {}

    /// Returns the noise at all places, moved by `step` wavelengths.
    const std::vector<float>& at(const std::vector<glm::dvec3>& places, const glm::dvec3& step,
                                 double length, std::uint32_t seed) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const glm::dvec3 at = places[i] / length + step;
            x_[i] = static_cast<float>(at.x);
            y_[i] = static_cast<float>(at.y / upright);
            z_[i] = static_cast<float>(at.z);
        }
        gradient_noise(x_, y_, z_, seed, noise_);
        return noise_;
    }

  private:
    std::vector<float> x_, y_, z_, noise_;
};

}  // namespace

void add_segment_relief(Mesh& mesh, const std::vector<Tube>& tubes, double gnarl,
                        double trunk_radius, std::uint32_t seed) {
    if (!(gnarl > 0.0) || !(trunk_radius > 0.0)) return;
    std::vector<std::size_t> vertices;
    std::vector<double> radii;
    std::vector<glm::dvec3> places;
    for (const Tube& tube : tubes)
        for (const TubeRows& rows : tube.rows)
            for (std::size_t row = 0; row < rows.count; ++row)
                for (std::size_t column = 0; column < rows.width(); ++column) {
                    vertices.push_back(rows.first_vertex + row * rows.width() + column);
                    radii.push_back(tube.stations[rows.from + row].radius);
                    places.emplace_back(mesh.positions[vertices.back()]);
                }
    std::vector<double> raised(places.size(), 0.0);
    std::vector<glm::dvec3> slopes(places.size(), glm::dvec3(0.0));
    Samples samples(places.size());
    for (std::size_t k = 0; k < octaves.size(); ++k) {
        const Octave& octave = octaves[k];
        const double length = octave.length * trunk_radius, height = gnarl * octave.height;
        const auto noise = [&](const glm::dvec3& step) -> const std::vector<float>& {
            return samples.at(places, step, length, seed + static_cast<std::uint32_t>(k));
        };
        const std::vector<float>& middle = noise(glm::dvec3(0.0));
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double value = height * static_cast<double>(middle[i]);
            raised[i] += value;
            slopes[i] -= glm::dvec3(value / (slope_step * length));
        }
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = slope_step;
            const std::vector<float>& moved = noise(step);
            for (std::size_t i = 0; i < places.size(); ++i)
                slopes[i][axis] += height * static_cast<double>(moved[i]) / (slope_step * length);
        }
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3 normal(mesh.normals[vertices[i]]);
        const glm::dvec3 slope = radii[i] * slopes[i];
        mesh.positions[vertices[i]] = glm::vec3(places[i] + radii[i] * raised[i] * normal);
        mesh.normals[vertices[i]] =
            glm::vec3(unit_or(normal - (slope - glm::dot(slope, normal) * normal), normal));
    }
}

}  // namespace sporeprint
