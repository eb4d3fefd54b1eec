#include "planner/plan/plan.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>
#include <stdexcept>
#include <vector>

#include "planner/grasp/required_friction_angle.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/object/rotation.h"

namespace regrasp::plan {

namespace {

void SetTorsion(double torsion, FingerGrasp& grasp) {
  for (FingerContact& held : grasp) held.contact.torsion = torsion;
}

}  // namespace

void SetTorsion(double torsion, Plan& plan) {
  plan.torsion = torsion;
  SetTorsion(torsion, plan.initial);
  for (Step& step : plan.steps) {
    if (auto* finger_switch = std::get_if<Switch>(&step)) {
      SetTorsion(torsion, finger_switch->place);
    } else if (auto* align = std::get_if<Align>(&step)) {
      for (FingerGrasp& waypoint : align->waypoints) SetTorsion(torsion, waypoint);
    } else {
      for (FingerGrasp& rolled : std::get<Move>(step).contacts) SetTorsion(torsion, rolled);
    }
  }
  for (grasp::Contact& contact : plan.goal) contact.torsion = torsion;
}

const char* StepKind(const Step& step) {
  if (std::holds_alternative<Switch>(step)) return "switch";
  return std::holds_alternative<Align>(step) ? "align" : "move";
}

const FingerContact* FindFinger(const FingerGrasp& grasp, FingerIndex finger) {
  const auto found = std::ranges::find(grasp, finger, &FingerContact::finger);
  return found == grasp.end() ? nullptr : &*found;
}

bool HaveSameFingers(const FingerGrasp& a, const FingerGrasp& b) {
  return a.size() == b.size() && std::ranges::all_of(a, [&](const FingerContact& held) {
           return FindFinger(b, held.finger) != nullptr;
         });
}

FingerGrasp GraspAfter(const FingerGrasp& before, const Step& step) {
  if (const auto* align = std::get_if<Align>(&step)) {
    return align->waypoints.empty() ? before : align->waypoints.back();
  }
  if (const auto* move = std::get_if<Move>(&step)) {
    return move->contacts.empty() ? before : move->contacts.back();
  }
  const auto& finger_switch = std::get<Switch>(step);
  FingerGrasp after = before;
  std::erase_if(after, [&](const FingerContact& held) {
    return std::ranges::find(finger_switch.release, held.finger) != finger_switch.release.end();
  });
  after.insert(after.end(), finger_switch.place.begin(), finger_switch.place.end());
  return after;
}

FingerGrasp GraspBetween(const FingerGrasp& from, const FingerGrasp& to, double share) {
  FingerGrasp between = from;
  for (FingerContact& held : between) {
    const FingerContact* next = FindFinger(to, held.finger);
    if (next == nullptr) continue;
    held.contact = motion::ContactMotion(held.contact, next->contact).At(share);
  }
  return between;
}

FingerGrasp FingersInOrder(const grasp::Grasp& grasp) {
  FingerGrasp held;
  for (FingerIndex finger{0}; finger < std::ssize(grasp); ++finger) {
    held.push_back({finger, grasp[finger]});
  }
  return held;
}

grasp::Grasp ContactsOf(const FingerGrasp& grasp) {
  grasp::Grasp contacts;
  contacts.reserve(grasp.size());
  for (const FingerContact& held : grasp) contacts.push_back(held.contact);
  return contacts;
}

bool AreSameContact(const grasp::Contact& a, const grasp::Contact& b, double tolerance) {
  return (a.p - b.p).norm() <= tolerance && grasp::AngleBetween(a.n, b.n) <= kNormalTolerance;
}

bool AreSameGrasp(const grasp::Grasp& a, const grasp::Grasp& b, double tolerance) {
  if (a.size() != b.size()) return false;
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
  Graph graph(a.size() + b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (AreSameContact(a[i], b[j], tolerance)) boost::add_edge(i, a.size() + j, graph);
    }
  }
  std::vector<Graph::vertex_descriptor> mate(a.size() + b.size());
  boost::edmonds_maximum_cardinality_matching(graph, mate.data());
  return boost::matching_size(graph, mate.data()) == a.size();
}

bool AreIdentical(const FingerGrasp& a, const FingerGrasp& b) {
  return std::ranges::equal(a, b, [](const FingerContact& x, const FingerContact& y) {
    return x.finger == y.finger && x.contact.p == y.contact.p && x.contact.n == y.contact.n &&
           x.contact.torsion == y.contact.torsion;
  });
}

HandState StateBetween(const HandState& from, const HandState& to, double share) {
  HandState state = from;
  state.pose.translation() += share * (to.pose.translation() - from.pose.translation());
  const Eigen::AngleAxisd turn = object::RotationInBody(from.pose.linear(), to.pose.linear());
  state.pose.linear() =
      from.pose.linear() * Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix();
  for (std::size_t i = 0; i < from.joints.size(); ++i) {
    for (std::size_t k = 0; k < from.joints[i].size(); ++k) {
      state.joints[i][k] += share * (to.joints[i][k] - from.joints[i][k]);
    }
  }
  return state;
}

HandState StateAfter(const HandState& before, const Step& step) {
  const std::vector<const HandPath*> paths = PathsOf(step);
  for (auto path = paths.rbegin(); path != paths.rend(); ++path) {
    if (!(*path)->empty()) return (*path)->back();
  }
  return before;
}

HandEnd EndOfPlan(const Plan& plan) {
  if (!plan.hand) throw std::invalid_argument("the plan is not for a hand");
  HandEnd end{plan.hand->initial, plan.initial};
  for (const Step& step : plan.steps) {
    end.state = StateAfter(end.state, step);
    end.grasp = GraspAfter(end.grasp, step);
  }
  return end;
}

bool HasRolling(const Plan& plan) {
  return std::ranges::any_of(plan.steps, [](const Step& step) {
    const auto* move = std::get_if<Move>(&step);
    return move != nullptr && !move->contacts.empty();
  });
}

std::vector<const HandPath*> PathsOf(const Step& step) {
  std::vector<const HandPath*> paths;
  if (const auto* move = std::get_if<Move>(&step)) paths.push_back(&move->path);
  if (const auto* align = std::get_if<Align>(&step); align != nullptr && align->motion) {
    for (const HandPath& path : *align->motion) paths.push_back(&path);
  }
  if (const auto* change = std::get_if<Switch>(&step); change != nullptr && change->motion) {
    paths.push_back(&change->motion->place);
    paths.push_back(&change->motion->release);
  }
  return paths;
}

}  // namespace regrasp::plan
