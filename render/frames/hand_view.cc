#include "render/frames/hand_view.h"

#include "render/picture/palette.h"

namespace regrasp::render {
namespace {

constexpr Color kHandColor = {214, 206, 196};

}  // namespace

HandView InPicture(HandView hand, const PictureFrame& frame) {
  for (FacetMesh& mesh : hand) {
    for (auto& corners : mesh.triangles) {
      for (Eigen::Vector3d& p : corners) p /= frame.diameter_m;
    }
  }
  return hand;
}

std::vector<Shape> HandShapes(const plan::Snapshot& snapshot, const PictureFrame& frame,
                              int first_mesh) {
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < snapshot.links_W.size(); ++i) {
    Eigen::Isometry3d pose = snapshot.links_W[i];
    pose.translation() = frame.FromWorld(pose.translation());
    shapes.push_back({MeshInstance{first_mesh + static_cast<int>(i), pose}, kHandColor});
  }
  return shapes;
}

}  // namespace regrasp::render
