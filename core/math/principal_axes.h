// The principal axes of a distribution of points or surfaces in space.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace sporeprint {

/// The eigenvectors of a covariance matrix, unit and square to each other, by falling variance.
struct PrincipalAxes {
    std::array<glm::dvec3, 3> directions{glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0),
                                         glm::dvec3(0.0, 0.0, 1.0)};
    std::array<double, 3> variances{0.0, 0.0, 0.0};  ///< at least 0
};

/// Returns the principal axes of a symmetric positive semidefinite matrix.
///
/// source  the cyclic Jacobi eigenvalue algorithm, by exact operations only, so that every machine
///         finds the same bits
[[nodiscard]] PrincipalAxes principal_axes(glm::dmat3 covariance);

}  // namespace sporeprint
