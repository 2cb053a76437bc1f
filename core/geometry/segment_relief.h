// The relief of segments: swellings, ribs and wrinkles along the tubes of a branch graph.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/tube.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Raises and sinks the rows of tubes, and turns their normals by it. What is added depends on the
/// place and on the radius there alone, so that tubes which cross keep one skin; for a gnarl of 0 it
/// is nothing.
///
/// mesh          normals and positions of the rows are changed
/// gnarl         0..1, see SegmentStyle
/// trunk_radius  metres: swellings are about as large
/// cost          O(vertices)
void add_segment_relief(Mesh& mesh, const std::vector<Tube>& tubes, double gnarl,
                        double trunk_radius, std::uint32_t seed);

}  // namespace sporeprint
