#pragma once

#include "render/frames/shaded_mesh.h"

namespace regrasp::render {

/// Remove the details of a mesh that are smaller than a tolerance.
///
/// A vertex moves to a neighbour as long as the neighbour is within `tolerance` of the planes of
/// all triangles that the vertex replaces (quadric error metric, Garland and Heckbert 1997). Open
/// borders and creases remain. The corners of the result are corners of the mesh with one of their
/// normals there. Deterministic.
///
/// Laws: with tolerance 0 only vertices inside planar areas and straight creases disappear; a
/// closed mesh remains closed.
///
/// @param mesh       a mesh without colours; others are returned unchanged.
/// @param tolerance  largest distance, in units of the mesh, at least 0.
[[nodiscard]] ShadedMesh ReduceDetail(const ShadedMesh& mesh, double tolerance);

}  // namespace regrasp::render
