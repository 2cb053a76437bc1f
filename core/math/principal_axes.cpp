#include "core/math/principal_axes.h"

#include <algorithm>
#include <cmath>

namespace sporeprint {

namespace {

// Sweeps over all three pairs of axes; the off-diagonal entries fall quadratically, so that double
// precision is reached after five.
constexpr int sweeps = 8;

// Zeroes the entry of a pair of axes by a rotation in their plane, and turns the vectors with it.
void rotate(glm::dmat3& matrix, glm::dmat3& vectors, int p, int q) {
    if (matrix[p][q] == 0.0) return;
    const double theta = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
    const double tangent =
        (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
    const double cosine = 1.0 / std::sqrt(tangent * tangent + 1.0), sine = tangent * cosine;
    for (int k = 0; k < 3; ++k) {
        const double a = matrix[k][p], b = matrix[k][q];
        matrix[k][p] = cosine * a - sine * b;
        matrix[k][q] = sine * a + cosine * b;
    }
    for (int k = 0; k < 3; ++k) {
        const double a = matrix[p][k], b = matrix[q][k];
        matrix[p][k] = cosine * a - sine * b;
        matrix[q][k] = sine * a + cosine * b;
    }
    const glm::dvec3 a = vectors[p], b = vectors[q];
    vectors[p] = cosine * a - sine * b;
    vectors[q] = sine * a + cosine * b;
}

}  // namespace

PrincipalAxes principal_axes(glm::dmat3 covariance) {
    glm::dmat3 vectors(1.0);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        rotate(covariance, vectors, 0, 1);
        rotate(covariance, vectors, 0, 2);
        rotate(covariance, vectors, 1, 2);
    }
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return covariance[a][a] > covariance[b][b]; });
    PrincipalAxes axes;
    for (std::size_t i = 0; i < 3; ++i) {
        axes.directions[i] = vectors[order[i]];
        axes.variances[i] = std::max(0.0, covariance[order[i]][order[i]]);
    }
    return axes;
}

}  // namespace sporeprint
