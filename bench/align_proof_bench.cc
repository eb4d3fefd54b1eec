// Benchmark of the proofs of sliding steps.
// It uses random pairs of force-closure grasps of four contacts on the same faces, connected by
// straight segments. It counts the valid segments that are proved by forces of degree 1, of degree
// 2, and of degree 1 with bisection, with the number of pieces and the time of each. The reference
// is the decision of the plan checker, whose proofs are checked exactly.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/motion/check_motion_proof.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/motion/moving_forces.h"
#include "planner/motion/path_force_closure.h"
#include "planner/object/object.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check_step.h"

namespace {

using namespace regrasp;
using Eigen::Vector3d;

constexpr int kContacts = 4;
constexpr int kSegments = 400;
/// Number of draws to find a grasp on the same faces as another.
constexpr int kPartnerDraws = 2000;
constexpr std::array kBodies{"cube", "prism", "l_block", "hole_block", "body42"};
constexpr std::array kDegrees{25.0, 15.0, 10.0, 5.0};

/// Return the processor time of this thread, µs. Other load of the machine does not count.
double ProcessorMicroseconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Sampler of points, uniform over the surface or over a face.
class SurfaceDraw {
 public:
  explicit SurfaceDraw(const object::Polyhedron& solid) : solid_(solid) {
    std::vector<double> areas;
    for (FaceIndex face{0}; face < solid.face_count(); ++face) {
      areas.push_back(solid.face_measure(face));
      std::vector<double> parts;
      for (const int triangle : solid.TrianglesOf(face)) parts.push_back(Doubled(triangle).norm());
      triangles_.emplace_back(parts.begin(), parts.end());
    }
    faces_ = std::discrete_distribution<int>(areas.begin(), areas.end());
  }

  grasp::Contact Draw() { return DrawOn(FaceIndex(faces_(engine_))); }
  grasp::Contact DrawOn(FaceIndex face) {
    const int triangle = solid_.TrianglesOf(face)[triangles_[face](engine_)];
    std::uniform_real_distribution<double> uniform(0, 1);
    double a = uniform(engine_);
    double b = uniform(engine_);
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    return {Corner(triangle, 0) + a * (Corner(triangle, 1) - Corner(triangle, 0)) +
                b * (Corner(triangle, 2) - Corner(triangle, 0)),
            solid_.inward_normal(face), face};
  }

 private:
  [[nodiscard]] const Vector3d& Corner(int triangle, int corner) const {
    return solid_.vertices()[solid_.triangles()[triangle][corner]];
  }
  [[nodiscard]] Vector3d Doubled(int triangle) const {
    return (Corner(triangle, 1) - Corner(triangle, 0))
        .cross(Corner(triangle, 2) - Corner(triangle, 0));
  }

  const object::Polyhedron& solid_;
  std::mt19937_64 engine_{2026};
  std::discrete_distribution<int> faces_;
  std::vector<std::discrete_distribution<int>> triangles_;
};

struct Segment {
  grasp::Grasp from;
  grasp::Grasp to;
  motion::GraspMotion motion;
};

std::optional<Segment> SegmentBetween(const object::Polyhedron& solid, const grasp::Grasp& from,
                                      const grasp::Grasp& to) {
  Segment segment{from, to, {}};
  for (int i = 0; i < kContacts; ++i) {
    if (plan::FindMotionFault(solid, from[i], to[i])) return std::nullopt;
    segment.motion.emplace_back(from[i], to[i]);
  }
  return segment;
}

std::vector<Segment> DrawSegments(const object::Polyhedron& solid, double friction_angle) {
  SurfaceDraw draw(solid);
  const object::WrenchFrame frame = solid.wrench_frame();
  std::vector<Segment> segments;
  while (segments.size() < kSegments) {
    grasp::Grasp from;
    for (int i = 0; i < kContacts; ++i) from.push_back(draw.Draw());
    if (!grasp::IsForceClosure(from, frame, friction_angle)) continue;
    for (int tries = 0; tries < kPartnerDraws; ++tries) {
      grasp::Grasp to;
      for (const grasp::Contact& contact : from) to.push_back(draw.DrawOn(contact.face));
      if (!grasp::IsForceClosure(to, frame, friction_angle)) continue;
      auto segment = SegmentBetween(solid, from, to);
      if (!segment) continue;
      segments.push_back(std::move(*segment));
      break;
    }
  }
  return segments;
}

/// Return the contacts of a whole segment in a frame that moves with their centre.
motion::MovingContacts MovingContactsOf(const Segment& segment, double friction_angle) {
  Vector3d start = Vector3d::Zero();
  Vector3d end = Vector3d::Zero();
  for (int i = 0; i < kContacts; ++i) {
    start += segment.from[i].p / kContacts;
    end += segment.to[i].p / kContacts;
  }
  double radius = 0;
  for (int i = 0; i < kContacts; ++i) {
    radius = std::max({radius, (segment.from[i].p - start).norm(), (segment.to[i].p - end).norm()});
  }
  motion::MovingContacts contacts;
  for (int i = 0; i < kContacts; ++i) {
    const Eigen::Vector3d from = (segment.from[i].p - start) / radius;
    const Eigen::Vector3d to = (segment.to[i].p - end) / radius;
    contacts.push_back({from, to, to - from, segment.from[i].n, std::cos(friction_angle),
                        std::sin(friction_angle)});
  }
  return contacts;
}

/// Result of a proof method on all segments.
struct Outcome {
  int proved = 0;
  int pieces = 0;
  double proved_us = 0;
  double rejected_us = 0;
};

/// @param prove  function that returns the number of pieces, 0 if a segment is not proved.
template <typename Prove>
Outcome Measure(const std::vector<Segment>& segments, const Prove& prove) {
  Outcome outcome;
  for (const Segment& segment : segments) {
    const double begin = ProcessorMicroseconds();
    const int pieces = prove(segment);
    const double took = ProcessorMicroseconds() - begin;
    outcome.proved += pieces > 0 ? 1 : 0;
    outcome.pieces += pieces;
    (pieces > 0 ? outcome.proved_us : outcome.rejected_us) += took;
  }
  return outcome;
}

template <int kDegree>
Outcome MeasureOnePiece(const std::vector<Segment>& segments, double friction_angle) {
  return Measure(segments, [&](const Segment& segment) {
    motion::MovingForces<kDegree> forces;
    return motion::FindMovingForces<3, kDegree>(MovingContactsOf(segment, friction_angle), forces)
               ? 1
               : 0;
  });
}

/// Return the number of proofs that exact arithmetic rejects.
int CountRefused(const std::vector<Segment>& segments, double friction_angle) {
  int refused = 0;
  for (const Segment& segment : segments) {
    const auto pieces = motion::FindMotionProof(segment.motion, 3, friction_angle);
    if (!pieces) continue;
    const double mu = std::tan(friction_angle);
    refused += motion::CheckMotionProof(segment.from, segment.to, 3, mu, *pieces).proves() ? 0 : 1;
  }
  return refused;
}

double Each(double sum, int count) { return count > 0 ? sum / count : 0; }

void PrintRow(const std::string& body, double degrees) {
  const object::ObjectFile file =
      object::ReadObject(std::string(REGRASP_MODELS "/") + body + ".obj");
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*file.object);
  const object::WrenchFrame frame = solid.wrench_frame();
  const double friction_angle = Radians(degrees);
  const std::vector<Segment> segments = DrawSegments(solid, friction_angle);
  const Outcome truth = Measure(segments, [&](const Segment& segment) {
    return motion::DecidePathForceClosure(segment.motion, frame, friction_angle).holds() ? 1 : 0;
  });
  const Outcome first = MeasureOnePiece<1>(segments, friction_angle);
  const Outcome second = MeasureOnePiece<2>(segments, friction_angle);
  const Outcome halved = Measure(segments, [&](const Segment& segment) {
    const auto pieces = motion::FindMotionProof(segment.motion, 3, friction_angle);
    return pieces ? static_cast<int>(pieces->size()) : 0;
  });
  const auto share = [&](const Outcome& outcome) {
    return 100 * Each(outcome.proved, truth.proved);
  };
  std::printf("| %s | %g | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.2f | %.1f | %.1f | %.0f |\n",
              body.c_str(), degrees, 100.0 * truth.proved / kSegments, share(first),
              (first.proved_us + first.rejected_us) / kSegments, share(second),
              (second.proved_us + second.rejected_us) / kSegments, share(halved),
              Each(halved.pieces, halved.proved), Each(halved.proved_us, halved.proved),
              Each(halved.rejected_us, kSegments - halved.proved),
              (truth.proved_us + truth.rejected_us) / kSegments);
  if (const int refused = CountRefused(segments, friction_angle)) {
    std::printf("%d proofs refused by exact arithmetic\n", refused);
  }
}

}  // namespace

int main() {
  std::printf(
      "| object | friction angle, degrees | valid segments, %% | degree 1, %% | us | degree 2, %% "
      "| "
      "us | halved, %% | pieces | us proved | us rejected | decided, us |\n");
  for (const char* body : kBodies) {
    for (const double degrees : kDegrees) PrintRow(body, degrees);
  }
  return 0;
}
