// Count force-closure grasps among random ones on the unit sphere: force_closure [COUNT]
#include "planner/grasp/force_closure.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>

#include "planner/base/number.h"

using namespace regrasp;

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 100000;
  // Torques are taken about the centre and divided by the length 1.
  const object::WrenchFrame frame{Eigen::Vector3d::Zero(), 1, 3};
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const double angle_deg : {10.0, 20.0, 30.0}) {
    int closed = 0;
    for (int i = 0; i < count; ++i) {
      grasp::Grasp grasp;
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d p =
            Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
        grasp.push_back({p, -p});  // contact point, inward normal
      }
      closed += grasp::IsForceClosure(grasp, frame, Radians(angle_deg)) ? 1 : 0;
    }
    std::cout << "friction angle " << angle_deg << " deg: " << closed << " of " << count
              << " grasps are force closure\n";
  }
  return 0;
}
