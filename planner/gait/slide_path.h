#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "planner/criteria/grasp_memory.h"
#include "planner/gait/finger_path.h"
#include "planner/gait/hand_setup.h"
#include "planner/tree/surface_route.h"

namespace regrasp::gait {

/// Ways that a contact can take along the surface to another one, worked out when first asked for.
class SlideRoutes {
 public:
  /// @param memory  knows the contacts by their numbers; outlives this object.
  explicit SlideRoutes(const criteria::GraspMemory& memory) : memory_(memory) {}

  /// Null where there is none (tree::FindSurfaceRoute). Stays where it is.
  [[nodiscard]] const tree::SurfaceRoute* Between(int from, int to);

 private:
  const criteria::GraspMemory& memory_;
  std::map<std::pair<int, int>, std::optional<tree::SurfaceRoute>> known_;
};

/// How a finger that holds slides along the surface: from contact to contact straight on a face, or
/// about one point from a face to the next.
struct Slide {
  std::vector<grasp::Contact> contacts;  ///< the object's units
  std::vector<FingerPath> paths;         ///< between two contacts, at equal shares of the way
};

/// A slide from a contact to another one that the tip follows within kTipOff, certified to be free
/// and force closure all along, by routes as aligns take them (tree/surface_route.h).
/// @param finger   that slides.
/// @param grasp    its contact, and those of the others, by number; the finger's comes first.
/// @param route    from there.
/// @param from, end  postures of the finger at first and in the end.
/// @param around   the pose and the other fingers.
/// @returns nullopt where none was found.
[[nodiscard]] std::optional<Slide> FindSlide(const HandSetup& setup,
                                             const criteria::GraspMemory& memory,
                                             FingerIndex finger, const std::vector<int>& grasp,
                                             const tree::SurfaceRoute& route, const Posture& from,
                                             const Posture& end, const Surroundings& around);

}  // namespace regrasp::gait
