#include "render/figures/surface_buffer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

constexpr float kNormalSteps = 127;
constexpr float kFarthest = -std::numeric_limits<float>::infinity();

std::array<signed char, 3> Packed(const Vector3d& normal) {
  const Vector3d n = (normal.z() < 0 ? -1 : 1) * kNormalSteps * normal.normalized();
  return {static_cast<signed char>(std::lround(n.x())),
          static_cast<signed char>(std::lround(n.y())),
          static_cast<signed char>(std::lround(n.z()))};
}

}  // namespace

SurfaceBuffer::SurfaceBuffer(int width, int height)
    : width_(width),
      height_(height),
      samples_(std::size_t(width) * height, Sample{kFarthest, kNothing, {}}) {
  assert(width > 0 && height > 0);
}

int SurfaceBuffer::LabelAt(int x, int y) const {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return kNothing;
  return samples_[std::size_t(y) * width_ + x].label;
}

float SurfaceBuffer::DepthAt(int x, int y) const {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return kFarthest;
  return samples_[std::size_t(y) * width_ + x].depth;
}

Eigen::Vector3f SurfaceBuffer::NormalAt(int x, int y) const {
  const auto& [a, b, c] = samples_[std::size_t(y) * width_ + x].normal;
  return Eigen::Vector3f(a, b, c).normalized();
}

void SurfaceBuffer::Add(const ShadedMesh& mesh, int label,
                        const std::function<Vector3d(const Vector3d&)>& place,
                        const Eigen::Matrix3d& turn, double lift) {
  assert(label >= 0 && label <= std::numeric_limits<short>::max());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vector3d, 3> corners, normals;
    for (int i = 0; i < 3; ++i) {
      corners[i] = place(mesh.triangles[t][i]) + lift * Vector3d::UnitZ();
      normals[i] = turn * mesh.normals[t][i];
    }
    AddTriangle(corners, normals, label);
  }
}

bool SurfaceBuffer::IsAtStep(int x, int y, double step) const {
  const float depth = DepthAt(x, y);
  for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
    const float other = DepthAt(x + dx, y + dy);
    if (depth != other && !(std::abs(depth - other) < step)) return true;
  }
  return false;
}

void SurfaceBuffer::RemoveSpecks(double step) {
  constexpr int kReach = 2;
  constexpr int kWindow = (2 * kReach + 1) * (2 * kReach + 1);
  std::vector<Sample> filtered = samples_;
  for (int y = kReach; y < height_ - kReach; ++y) {
    for (int x = kReach; x < width_ - kReach; ++x) {
      if (!IsAtStep(x, y, step)) continue;
      std::array<const Sample*, kWindow> window;
      int count = 0;
      for (int v = y - kReach; v <= y + kReach; ++v) {
        for (int u = x - kReach; u <= x + kReach; ++u) {
          window[count++] = &samples_[std::size_t(v) * width_ + u];
        }
      }
      std::ranges::nth_element(window, window.begin() + kWindow / 2, {},
                               [](const Sample* sample) { return sample->depth; });
      filtered[std::size_t(y) * width_ + x] = *window[kWindow / 2];
    }
  }
  samples_ = std::move(filtered);
}

void SurfaceBuffer::AddTriangle(const std::array<Vector3d, 3>& corners,
                                const std::array<Vector3d, 3>& normals, int label) {
  const auto& [a, b, c] = corners;
  const double area = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  if (!(std::abs(area) > 0)) return;  // seen from the side, or not finite
  const auto first = [](double least, int most) {
    return static_cast<int>(std::clamp(std::ceil(least - 0.5), 0.0, static_cast<double>(most)));
  };
  const auto [left, right] = std::minmax({a.x(), b.x(), c.x()});
  const auto [top, bottom] = std::minmax({a.y(), b.y(), c.y()});
  const int end_x = first(std::nextafter(right, right + 1), width_);
  const int end_y = first(std::nextafter(bottom, bottom + 1), height_);
  for (int y = first(top, height_); y < end_y; ++y) {
    for (int x = first(left, width_); x < end_x; ++x) {
      // Barycentric coordinates of the centre of the sample.
      const double px = x + 0.5 - a.x(), py = y + 0.5 - a.y();
      const double v = (px * (c - a).y() - py * (c - a).x()) / area;
      const double w = ((b - a).x() * py - (b - a).y() * px) / area;
      if (v < 0 || w < 0 || v + w > 1) continue;
      const double u = 1 - v - w;
      const auto depth = static_cast<float>(u * a.z() + v * b.z() + w * c.z());
      Sample& sample = samples_[std::size_t(y) * width_ + x];
      if (depth <= sample.depth) continue;
      sample = {depth, static_cast<short>(label),
                Packed(u * normals[0] + v * normals[1] + w * normals[2])};
    }
  }
}

bool IsOutline(const SurfaceBuffer& surfaces, double step, int x, int y, int x2, int y2) {
  constexpr int kNothing = SurfaceBuffer::kNothing;
  const int label = surfaces.LabelAt(x, y), label2 = surfaces.LabelAt(x2, y2);
  if (label == kNothing || label2 == kNothing) return label != label2;
  const float rise = surfaces.DepthAt(x2, y2) - surfaces.DepthAt(x, y);
  if (std::abs(rise) < step) return false;
  // A steep surface rises at about the same rate in front of and after the samples.
  const int dx = x2 - x, dy = y2 - y;
  const float before = surfaces.DepthAt(x, y) - surfaces.DepthAt(x - dx, y - dy);
  const float after = surfaces.DepthAt(x2 + dx, y2 + dy) - surfaces.DepthAt(x2, y2);
  return std::abs(rise - before) > step / 2 && std::abs(rise - after) > step / 2;
}

}  // namespace regrasp::render
