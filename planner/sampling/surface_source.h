#pragma once

#include <vector>

#include "planner/base/random.h"
#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp {

/// Random contacts on a body's surface, in space and in the plane; never in a sealed cavity.
class SurfaceSource {
 public:
  /// @param object  outlives this object. @param finger_radius  its unit of length; 0: points.
  explicit SurfaceSource(const Object& object, double finger_radius = 0);

  /// Whether a finger has room at a contact (HasClearance), a little away from the border of its
  /// face, and, if it is no point, comes to it (CanReach).
  [[nodiscard]] bool Serves(const Contact& contact) const;

  /// Evenly over the whole surface or over one face (of no cavity), where it serves.
  [[nodiscard]] Contact Draw(RandomStream& random) const;
  [[nodiscard]] Contact DrawOn(int face, RandomStream& random) const;

  /// Near a contact, on its face: beside it by no more than `reach` along each axis of the face, or
  /// where that is off the face about as far from the border there. May not serve: that costs more
  /// to find out than whether the contact makes a grasp.
  [[nodiscard]] Contact DrawNear(const Contact& contact, double reach, RandomStream& random) const;
  /// The same on whatever face is there; the contact itself where none is.
  [[nodiscard]] Contact DrawAround(const Contact& contact, double reach,
                                   RandomStream& random) const;

 private:
  /// A triangle of a face of a solid; an edge of a polygon, c = b.
  struct Piece {
    Eigen::Vector3d a, b, c;
    int face;
  };

  /// Of the running sums: some pieces that follow each other.
  struct Range {
    double from, to;
  };

  /// A point of the plane that touches at the contact, in the plane of its line.
  [[nodiscard]] Eigen::Vector3d DrawBeside(const Contact& contact, double reach,
                                           RandomStream& random) const;
  /// A point of the face no farther than `reach` from a point of its border.
  [[nodiscard]] Eigen::Vector3d DrawInwards(int face, const Eigen::Vector3d& border, double reach,
                                            RandomStream& random) const;
  void AddPiece(const Piece& piece, double measure);
  [[nodiscard]] Contact DrawIn(const Piece& piece, RandomStream& random) const;
  [[nodiscard]] Range RangeOf(int face) const;
  [[nodiscard]] Contact DrawOnce(const Range& range, RandomStream& random) const;
  [[nodiscard]] Contact DrawServing(const Range& range, RandomStream& random) const;

  const Object& object_;
  double finger_radius_;
  std::vector<Piece> pieces_;     ///< those of one face together
  std::vector<double> up_to_;     ///< running sums of their areas or lengths
  std::vector<int> first_piece_;  ///< by face, and the number of pieces at the end
};

}  // namespace regrasp
