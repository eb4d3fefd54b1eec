#pragma once

#include <vector>

#include "render/figures/region_lines.h"
#include "render/figures/solid_painter.h"
#include "render/frames/shaded_mesh.h"

namespace regrasp::render {

/// Area and visible outlines of a surface in a panel, points.
struct ScanOutline {
  std::vector<Polyline> areas;  ///< closed lines, filled with the even-odd rule
  std::vector<Polyline> lines;  ///< their rims, and the outlines in front of the surface
};

/// Trace the outlines of a surface that is curved nearly everywhere, like a scan.
///
/// Inner lines follow the steps of depth of the visible surface. The edges of triangles between a
/// front and a back would instead be a zigzag with loose ends, and many paths.
[[nodiscard]] ScanOutline TraceScan(const ShadedMesh& surface, const PanelCamera& camera);

/// Visible area of one colour in a panel, points.
struct TintedArea {
  Color color;
  std::vector<Polyline> areas;  ///< closed lines, filled with the even-odd rule
};

/// Trace the visible areas of a surface by the colour of the first corner of each triangle.
/// @param surface  surface with colours.
[[nodiscard]] std::vector<TintedArea> TraceTints(const ShadedMesh& surface,
                                                 const PanelCamera& camera);

}  // namespace regrasp::render
