#include "planner/plan/contact_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "planner/grasp/force_closure.h"

namespace regrasp::plan {

namespace {

std::optional<double> SmallestClaim(const FingerGrasp& placed) {
  std::optional<double> claimed;
  for (const FingerContact& held : placed) {
    if (held.region) claimed = std::min(claimed.value_or(*held.region), *held.region);
  }
  return claimed;
}

}  // namespace

std::optional<SwitchRegion> MeasureSwitchRegion(const object::Polygon& polygon,
                                                const FingerGrasp& before, const Switch& step,
                                                double friction_angle) {
  const FingerGrasp after = GraspAfter(before, step);
  if (before.size() != 2 || after.size() != 2) return std::nullopt;
  const double limit = polygon.diameter();
  SwitchRegion region;
  // The second search stops at the result of the first one.
  region.half_width = MeasureContactRegion(
      polygon, ContactsOf(after), friction_angle,
      MeasureContactRegion(polygon, ContactsOf(before), friction_angle, limit));
  region.claimed = SmallestClaim(step.place);
  region.holds = !region.claimed || *region.claimed <= region.half_width + object::kPointTolerance *
                                                                               polygon.diameter();
  return region;
}

using Eigen::Vector3d;

namespace {

/// Closed part of an edge, given by its ends.
struct Piece {
  std::array<grasp::Contact, 2> ends;
};

/// Boundary ring of a contact, parameterized by the length from its first vertex.
class RingPlace {
 public:
  RingPlace(const object::Polygon& polygon, const grasp::Contact& contact) : polygon_(polygon) {
    int count = 0;
    for (const auto& ring : polygon.rings()) {
      first_ = FaceIndex(first_ + count);
      count = static_cast<int>(ring.size());
      if (contact.face < first_ + count) break;
    }
    for (FaceIndex edge = first_; edge < first_ + count; ++edge) {
      if (edge == contact.face) {
        place_ = begins_.back() + (contact.p - polygon.edge(edge).first).norm();
      }
      begins_.push_back(begins_.back() + polygon.face_measure(edge));
    }
  }

  /// Return the pieces within `reach` of the contact, both ends included.
  /// The farthest pieces are first, because they are the first to leave a convex set.
  [[nodiscard]] std::vector<Piece> Cut(double reach) const {
    const double perimeter = begins_.back();
    const double half = std::min(reach, perimeter / 2);
    struct Part {
      double middle;
      Piece piece;
    };
    std::vector<Part> parts;
    for (std::size_t k = 0; k + 1 < begins_.size(); ++k) {
      // The contact's interval may extend into the previous and the next turn of the ring.
      for (const double turn : {-perimeter, 0.0, perimeter}) {
        const double low = std::max(begins_[k] + turn, place_ - half);
        const double high = std::min(begins_[k + 1] + turn, place_ + half);
        if (low > high) continue;
        const FaceIndex edge(first_ + static_cast<int>(k));
        parts.push_back(
            {(low + high) / 2,
             {{At(edge, low - turn - begins_[k]), At(edge, high - turn - begins_[k])}}});
      }
    }
    std::ranges::sort(parts, std::greater{},
                      [&](const Part& part) { return std::abs(part.middle - place_); });
    std::vector<Piece> pieces;
    for (const Part& part : parts) pieces.push_back(part.piece);
    return pieces;
  }

 private:
  [[nodiscard]] grasp::Contact At(FaceIndex edge, double length) const {
    const auto [from, to] = polygon_.edge(edge);
    const double share = std::clamp(length / polygon_.face_measure(edge), 0.0, 1.0);
    return {(1 - share) * from + share * to, polygon_.inward_normal(edge), edge};
  }

  const object::Polygon& polygon_;
  FaceIndex first_{0};                ///< first edge of the ring
  std::vector<double> begins_ = {0};  ///< start of each edge, then the perimeter
  double place_ = 0;
};

/// Return whether a grasp presses inwards: its normals point towards each other.
bool IsSqueezing(const grasp::Contact& a, const grasp::Contact& b) {
  return (b.p - a.p).dot(a.n) > 0;
}

class Region {
 public:
  Region(const object::Polygon& polygon, const grasp::Contact& a, const grasp::Contact& b,
         double friction_angle)
      : frame_(polygon.wrench_frame()),
        friction_angle_(friction_angle),
        squeezing_(IsSqueezing(a, b)),
        first_(polygon, a),
        second_(polygon, b) {}

  [[nodiscard]] bool Holds(double reach) const {
    const std::vector<Piece> second = second_.Cut(reach);
    return std::ranges::all_of(first_.Cut(reach), [&](const Piece& a) {
      return std::ranges::all_of(second, [&](const Piece& b) { return Holds(a, b); });
    });
  }

 private:
  [[nodiscard]] bool Holds(const Piece& a, const Piece& b) const {
    return std::ranges::all_of(a.ends, [&](const grasp::Contact& p) {
      return std::ranges::all_of(b.ends, [&](const grasp::Contact& q) {
        return IsSqueezing(p, q) == squeezing_ &&
               grasp::IsForceClosure({{p, q}}, frame_, friction_angle_);
      });
    });
  }

  object::WrenchFrame frame_;
  double friction_angle_;
  bool squeezing_;
  RingPlace first_, second_;
};

void CheckArguments(const object::Polygon& polygon, const grasp::Grasp& grasp, double limit) {
  if (grasp.size() != 2) throw std::invalid_argument("a contact region requires two contacts");
  for (const grasp::Contact& contact : grasp) {
    if (!contact.face.valid() || contact.face >= polygon.face_count()) {
      throw std::invalid_argument("the contacts of a contact region must be on edges");
    }
  }
  if (!(limit >= 0) || !std::isfinite(limit)) {
    throw std::invalid_argument("the limit of a contact region must be a length");
  }
}

}  // namespace

double MeasureContactRegion(const object::Polygon& polygon, const grasp::Grasp& two_contacts,
                            double friction_angle, double limit) {
  CheckArguments(polygon, two_contacts, limit);
  if (!grasp::IsForceClosure(two_contacts, polygon.wrench_frame(), friction_angle)) return 0;
  const Region region(polygon, two_contacts[0], two_contacts[1], friction_angle);
  if (region.Holds(limit)) return limit;
  double low = 0, high = limit;
  while (high - low > kRegionAccuracy * polygon.diameter()) {
    const double middle = (low + high) / 2;
    (region.Holds(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace regrasp::plan
