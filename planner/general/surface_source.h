#pragma once

#include <vector>

#include "planner/base/random.h"
#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp {

/// Random contacts, evenly over a body's surface or over one of its faces, in space and in the
/// plane, where fingers have room (HasStandingRoom) and, where they are no points, come to
/// (CanReach).
class SurfaceSource {
 public:
  /// @param object  outlives this object. @param finger_radius  its unit of length; 0: points.
  explicit SurfaceSource(const Object& object, double finger_radius = 0);

  [[nodiscard]] Contact Draw(RandomStream& random) const;
  [[nodiscard]] Contact DrawOn(int face, RandomStream& random) const;
  /// Near a contact, on its face: no farther than `reach` from it along each axis of the face.
  /// The contact itself where the face's border is in the way.
  [[nodiscard]] Contact DrawNear(const Contact& contact, double reach, RandomStream& random) const;
  /// Near a contact, on whatever face is there: about as far from it as `reach` at most.
  [[nodiscard]] Contact DrawAround(const Contact& contact, double reach,
                                   RandomStream& random) const;

 private:
  /// A triangle of a face of a solid; an edge of a polygon, c = b.
  struct Piece {
    Eigen::Vector3d a, b, c;
    int face;
  };

  [[nodiscard]] bool Serves(const Contact& contact) const;
  void AddPiece(const Piece& piece, double measure);
  [[nodiscard]] Contact DrawIn(const Piece& piece, RandomStream& random) const;
  [[nodiscard]] Contact DrawBetween(double from, double to, RandomStream& random) const;

  const Object& object_;
  double finger_radius_;
  std::vector<Piece> pieces_;     ///< those of one face together
  std::vector<double> up_to_;     ///< running sums of their areas or lengths
  std::vector<int> first_piece_;  ///< by face, and the number of pieces at the end
};

}  // namespace regrasp
