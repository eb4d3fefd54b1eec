// Concurrent grasps drawn without the graph. Each must be in a piece of the graph, and each cell of
// small objects must contain one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <set>

#include "planner/grasp/force_closure.h"
#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace random_grasps_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegrees[] = {10, 18, 35};
constexpr std::uint64_t kSeed = 8;
constexpr int kFocusPoints = 1500;  // focus points per graph
constexpr int kDirections = 4;      // directions per face and focus point
constexpr int kTries = 50000;       // draws per contact that must exist

/// Distance from a face's border or a part's side below which contacts are ignored, divided by the
/// diameter. Their part depends on rounding.
constexpr double kAtBorder = 1e-9;

/// Contact that a focus point sees, with the half of its part.
struct Seen {
  HalfIndex half;
  double slope;  ///< tangent of the angle with the normal
  Vector3d contact;
};

class GraspDraw {
 public:
  GraspDraw(const object::Polyhedron& body, const FaceParts& parts) : body_(body), parts_(parts) {}

  /// Draw a point around the object at various distances.
  Vector3d FocusPoint() {
    const double size = body_.diameter() * std::pow(4, 2 * unit_(engine_) - 2);
    const Vector3d drawn(normal_(engine_), normal_(engine_), normal_(engine_));
    return body_.mass_properties().centroid + size * drawn;
  }

  /// Return the contact of a face in a random direction inside the double cone about a focus point.
  std::optional<Seen> See(int face, double tangent, const Vector3d& focus) {
    const Vector3d n = body_.inward_normal(FaceIndex(face));
    const double height = n.dot(focus - body_.CentroidOf(FaceIndex(face)));
    const Vector3d u = n.unitOrthogonal();
    const double slope = tangent * std::sqrt(unit_(engine_)) * (1 - kAtBorder);
    const double around = 2 * M_PI * unit_(engine_);
    const Vector3d aside = std::cos(around) * u + std::sin(around) * n.cross(u);
    const Vector3d contact = focus - height * (n + slope * aside);
    if (!IsOnFace(face, contact)) return std::nullopt;
    const PartIndex part(PartOf(face, contact));
    if (!part.valid()) return std::nullopt;
    return Seen{HalfOf(part, height > 0), slope, contact};
  }

  std::size_t Index(std::size_t count) { return engine_() % count; }

 private:
  /// Return whether a contact is on a face, by counting crossings of its border with a ray in its
  /// plane.
  [[nodiscard]] bool IsOnFace(int face, const Vector3d& contact) const {
    if (body_.DistanceToBorder(FaceIndex(face), contact) < kAtBorder * body_.diameter())
      return false;
    const Vector3d n = body_.inward_normal(FaceIndex(face));
    const Vector3d u = n.unitOrthogonal();
    const Vector3d v = n.cross(u);
    bool inside = false;
    for (const object::FaceBorder& border : body_.BordersOf(FaceIndex(face))) {
      const Vector3d a = border.a - contact;
      const Vector3d b = border.b - contact;
      if ((v.dot(a) > 0) == (v.dot(b) > 0)) continue;
      const double share = v.dot(a) / (v.dot(a) - v.dot(b));
      if (u.dot(a) + share * (u.dot(b) - u.dot(a)) > 0) inside = !inside;
    }
    return inside;
  }

  /// Return the part that contains a point of a face; −1 if the point is between two.
  [[nodiscard]] int PartOf(int face, const Vector3d& contact) const {
    for (int p = parts_.first[face]; p < parts_.first[face + 1]; ++p) {
      const FacePart& part = parts_.parts[p];
      const Vector2d y(part.u.dot(contact - part.origin), part.v.dot(contact - part.origin));
      const std::vector<Vector2d> outline = part.outline();
      bool inside = true;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector2d& a = outline[i];
        const Vector2d side = (outline[(i + 1) % outline.size()] - a).normalized();
        const double depth = side.x() * (y - a).y() - side.y() * (y - a).x();
        inside = inside && depth > kAtBorder * body_.diameter();
      }
      if (inside) return p;
    }
    return -1;
  }

  const object::Polyhedron& body_;
  const FaceParts& parts_;
  std::mt19937_64 engine_{kSeed};
  std::uniform_real_distribution<double> unit_{0, 1};
  std::normal_distribution<double> normal_;
};

bool IsHeld(const object::Polyhedron& body, const std::array<Seen, 4>& grasp,
            const FaceQuadruple& faces, double friction_angle) {
  std::vector<grasp::Contact> contacts;
  for (std::size_t k = 0; k < grasp.size(); ++k) {
    contacts.push_back(
        {grasp[k].contact, body.inward_normal(FaceIndex(faces[k])), FaceIndex(faces[k])});
  }
  return grasp::IsForceClosure(contacts, body.wrench_frame(), friction_angle);
}

struct Count {
  int grasps = 0;
  int outer = 0;  ///< grasps with a contact seen from the outer side
  int cells = 0;
  std::set<Halves> pieces;
};

class GraspOracle {
 public:
  GraspOracle(const object::Polyhedron& body, double degrees, planning::Spanning spanning)
      : body_(body),
        friction_angle_(Radians(degrees)),
        graph_(body, friction_angle_, spanning),
        draw_(body, graph_.finder().parts()) {
    for (int cell = 0; cell < graph_.vertex_count(); ++cell) {
      for (const FocusPiece& piece : graph_.cells()[cell].pieces) cell_of_[piece.halves] = cell;
    }
    std::vector<Vector3d> normals;
    for (FaceIndex f{0}; f < body.face_count(); ++f) normals.push_back(body.inward_normal(f));
    candidates_ = FindQuadrupleCandidates(normals, std::tan(friction_angle_), spanning);
  }

  /// Check that every grasp of contacts seen by random focus points is in a cell.
  void CheckDrawnGrasps(Count& count) {
    for (int i = 0; i < kFocusPoints; ++i) {
      const Vector3d focus = draw_.FocusPoint();
      std::vector<std::vector<Seen>> seen(body_.face_count());
      for (FaceIndex face{0}; face < body_.face_count(); ++face) {
        for (int k = 0; k < kDirections; ++k) {
          if (const auto contact = draw_.See(face, std::tan(friction_angle_), focus)) {
            seen[face].push_back(*contact);
          }
        }
      }
      for (const QuadrupleCandidate& candidate : candidates_) {
        const auto grasp = Choose(candidate, seen);
        if (grasp) CheckGrasp(candidate, *grasp, focus, count);
      }
    }
  }

  /// Check that the deepest focus point of every piece sees contacts on its four halves, and that
  /// these are force closure.
  void CheckEveryCell(Count& count) {
    for (const FocusCell& cell : graph_.cells()) {
      ++count.cells;
      for (const FocusPiece& piece : cell.pieces) {
        std::vector<UnionVolume> volumes;
        for (const HalfIndex half : piece.halves) {
          volumes.push_back(graph_.finder().VolumeOf(half, cell.tangent));
        }
        const auto deepest = graph_.finder().FindDeepest(volumes);
        ASSERT_TRUE(deepest);
        std::array<Seen, 4> grasp;
        bool found = true;
        for (std::size_t k = 0; k < grasp.size(); ++k) {
          found = found &&
                  FindOn(cell.faces[k], piece.halves[k], cell.tangent, deepest->point, grasp[k]);
        }
        EXPECT_TRUE(found) << "depth " << deepest->value;
        if (!found) continue;
        EXPECT_TRUE(IsHeld(body_, grasp, cell.faces, friction_angle_));
        ++count.grasps;
      }
    }
  }

 private:
  /// Choose one contact per face inside the candidate's own cones.
  std::optional<std::array<Seen, 4>> Choose(const QuadrupleCandidate& candidate,
                                            const std::vector<std::vector<Seen>>& seen) {
    std::array<Seen, 4> grasp;
    for (std::size_t k = 0; k < grasp.size(); ++k) {
      const std::vector<Seen>& of_face = seen[candidate.faces[k]];
      if (of_face.empty()) return std::nullopt;
      grasp[k] = of_face[draw_.Index(of_face.size())];
      if (grasp[k].slope >= candidate.tangent) return std::nullopt;
    }
    return grasp;
  }

  void CheckGrasp(const QuadrupleCandidate& candidate, const std::array<Seen, 4>& grasp,
                  const Vector3d& focus, Count& count) {
    Halves halves;
    for (std::size_t k = 0; k < grasp.size(); ++k) halves[k] = grasp[k].half;
    const auto cell = cell_of_.find(halves);
    ASSERT_NE(cell, cell_of_.end());
    EXPECT_EQ(graph_.cells()[cell->second].faces, candidate.faces);
    for (const HalfIndex half : halves) {
      EXPECT_LT(graph_.finder().VolumeOf(half, candidate.tangent).At(focus), 0);
    }
    EXPECT_TRUE(IsHeld(body_, grasp, candidate.faces, friction_angle_));
    ++count.grasps;
    if (std::ranges::any_of(halves, [](HalfIndex half) { return !IsInner(half); })) ++count.outer;
    count.pieces.insert(halves);
  }

  bool FindOn(int face, HalfIndex half, double tangent, const Vector3d& focus, Seen& contact) {
    for (int i = 0; i < kTries; ++i) {
      const auto seen = draw_.See(face, tangent, focus);
      if (!seen || seen->half != half) continue;
      contact = *seen;
      return true;
    }
    // Nearly no direction meets the face, so its nearest point is used. The part does not matter if
    // there is only one.
    const auto& first = graph_.finder().parts().first;
    if (first[face + 1] - first[face] > 1) return false;
    contact.contact = body_.ClosestPoint(FaceIndex(face), focus);
    const Vector3d line = focus - contact.contact;
    const double height = body_.inward_normal(FaceIndex(face)).dot(line) * (IsInner(half) ? 1 : -1);
    return height > 0 && line.squaredNorm() < height * height * (1 + tangent * tangent);
  }

  const object::Polyhedron& body_;
  double friction_angle_;
  PolyhedronGraph graph_;
  GraspDraw draw_;
  std::map<Halves, int> cell_of_;  // cells by the halves of their pieces
  std::vector<QuadrupleCandidate> candidates_;
};

template <class Check>
Count CheckAll(const Check& check) {
  Count count;
  ForEachSmallBody(
      kDegrees, [&](const object::Polyhedron& body, double degrees, planning::Spanning spanning) {
        GraspOracle oracle(body, degrees, spanning);
        check(oracle, count);
      });
  return count;
}

TEST(RandomGrasps, LieInPiecesThatTheGraphHasAndHoldTheBody) {
  const Count count = CheckAll([](GraspOracle& o, Count& c) { o.CheckDrawnGrasps(c); });
  RecordProperty("grasps", count.grasps);
  RecordProperty("outer", count.outer);
  RecordProperty("pieces", static_cast<int>(count.pieces.size()));
  EXPECT_GT(count.grasps, 10000);
  EXPECT_GT(count.outer, 200);
  EXPECT_GT(count.pieces.size(), 300U);
}

TEST(RandomGrasps, AreFoundInEveryPieceOfEveryCell) {
  const Count count = CheckAll([](GraspOracle& o, Count& c) { o.CheckEveryCell(c); });
  RecordProperty("cells", count.cells);
  RecordProperty("grasps", count.grasps);
  EXPECT_GT(count.cells, 1000);
  EXPECT_GT(count.grasps, count.cells);
}

}  // namespace random_grasps_test
}  // namespace regrasp::polyhedron
