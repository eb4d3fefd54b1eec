#include "apps/hand_options.h"

#include <cmath>
#include <sstream>

#include "apps/help.h"
#include "apps/options.h"
#include "planner/base/angle.h"
#include "planner/base/error.h"

namespace regrasp::apps {
namespace {

constexpr double kMostTurns = 10;
constexpr double kLargestClearance_m = 0.05;

}  // namespace

void HandOptions::AddTo(CLI::App& app) {
  BeginGroup(app, "A hand");
  app.add_option("--hand", hand,
                 "The hand that moves the object; a file of the format regrasp-hand. The plan then "
                 "has the joints of every finger and the object's pose in the palm all along")
      ->type_name("FILE");
  app.add_option("--turn", turn,
                 "Turn the object in the hand; about an axis of its own by so many degrees, as in "
                 "\"z 90\". The hand begins where the object's z axis is upright and its fingers "
                 "reach most")
      ->type_name("AXIS_DEGREES");
  AddNumber(app, "--clearance", clearance_m, {0, kLargestClearance_m, true, true},
            "What links keep from each other, from the palm and from the object; in metres "
            "(default 0.001)",
            "M");
}

gait::Turn HandOptions::ParseTurn() const {
  std::istringstream words(turn);
  std::string axis;
  std::string rest;
  double degrees = 0;
  const auto fail = [&]() -> gait::Turn {
    throw InputError("--turn: expected an axis and degrees, as in \"z 90\", found \"" + turn +
                     "\"");
  };
  if (!(words >> axis >> degrees) || words >> rest || axis.size() != 1) return fail();
  const std::size_t which = std::string("xyz").find(axis);
  if (which == std::string::npos) return fail();
  if (!std::isfinite(degrees) || degrees == 0 || std::abs(degrees) > kMostTurns * 360) {
    throw InputError("--turn: degrees must be other than 0 and at most 3600, found \"" + turn +
                     "\"");
  }
  return {Eigen::Vector3d::Unit(static_cast<Eigen::Index>(which)), Radians(degrees)};
}

}  // namespace regrasp::apps
