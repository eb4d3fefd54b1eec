#include "render/frames/object_tint.h"

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "render/picture/image.h"

namespace regrasp::render {

namespace {

/// Colours of the directions −x, +x, −y, +y, −z and +z.
constexpr std::array<Color, 6> kDirectionColors = {{{200, 220, 242},
                                                    {246, 214, 208},
                                                    {226, 214, 242},
                                                    {208, 236, 210},
                                                    {216, 222, 232},
                                                    {246, 236, 196}}};

Color ColorOf(const Eigen::Vector3d& normal) {
  Eigen::Vector3d mixed = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Color& color = kDirectionColors[2 * axis + (normal[axis] > 0 ? 1 : 0)];
    mixed += normal[axis] * normal[axis] * Eigen::Vector3d(color.r, color.g, color.b);
  }
  const auto channel = [&](int i) { return static_cast<unsigned char>(std::lround(mixed[i])); };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace

void TintByDirection(ShadedMesh& surface) {
  surface.colors.clear();
  for (const auto& normals : surface.normals) {
    surface.colors.push_back({ColorOf(normals[0]), ColorOf(normals[1]), ColorOf(normals[2])});
  }
}

}  // namespace regrasp::render
