#include "planner/gait/random_stances.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/gait/hand_scene.h"
#include "planner/gait/initial_pose.h"
#include "planner/kinematics/finger_kinematics.h"

namespace regrasp::gait {

namespace {

/// Number of candidate contacts per draw, shared by all fingers.
constexpr int kRandomContacts = 24;
/// Minimum distance between contacts and face borders, in diameters.
constexpr double kRandomBorderClearance = 0.02;
/// Number of configurations drawn for an idle finger.
constexpr int kConfigurations = 200;

}  // namespace

RandomStances::RandomStances(const GaitRequest& request, RandomStanceOptions options)
    : request_(request),
      options_(std::move(options)),
      sampler_(*request.solid, FingersOf(request).fingertip_radius, kRandomBorderClearance),
      surface_(*request.solid, request.scale),
      scene_(*request.hand, surface_, request.margin),
      evaluator_(*request.solid, request.criteria, FingersOf(request),
                 criteria::QualityTest::kQuick),
      centre_(request.scale * request.solid->mass_properties().centroid) {
  if (options_.fewest < 3 || options_.most < options_.fewest ||
      options_.most > scene_.finger_count()) {
    throw std::invalid_argument("random stances: requires from 3 to all fingers in contact");
  }
  for (const kinematics::Finger& finger : request.hand->fingers) {
    inverse_.emplace_back(finger);
    for (const Eigen::Vector3d& tip : inverse_.back().sampled_tips()) tips_box_.extend(tip);
  }
}

Eigen::Isometry3d RandomStances::DrawPose(RandomStream& random) const {
  if (request_.start_pose) return *request_.start_pose;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = DrawOrientation(random);
  Eigen::Vector3d position;
  for (int k = 0; k < 3; ++k) {
    position[k] = tips_box_.min()[k] + random.Uniform() * tips_box_.sizes()[k];
  }
  pose.translation() = position - pose.linear() * centre_;
  return pose;
}

bool RandomStances::IsClear(const PlacedFinger& placed, const Holding& holding,
                            TipContact tip) const {
  return scene_.KeepsOffHand(placed) &&
         scene_.KeepsOffObject(placed, holding.stance.state.pose, tip) &&
         std::ranges::all_of(holding.placed, [&](const PlacedFinger& other) {
           return scene_.KeepApart(other, placed);
         });
}

bool RandomStances::PlaceAt(FingerIndex finger, const grasp::Contact& contact,
                            Holding& holding) const {
  const kinematics::Finger& chain = scene_.finger(finger);
  const SurfacePoint point{request_.scale * contact.p, contact.n};
  const kinematics::TipTarget target = TargetAt(chain, point, holding.stance.state.pose);
  const auto configuration = inverse_[finger].Solve(target);
  if (!configuration) return false;
  PlacedFinger placed = scene_.Place(finger, *configuration);
  if (!IsClear(placed, holding, TipContact::kTouching)) return false;
  if (!scene_.IsShallow(placed, holding.stance.state.pose, target.towards)) return false;
  holding.placed.push_back(std::move(placed));
  holding.stance.state.joints[finger] = kinematics::JointAngles(chain, *configuration);
  holding.stance.grasp.push_back({finger, contact});
  return true;
}

std::vector<grasp::Contact> RandomStances::DrawContacts(RandomStream& random) const {
  std::vector<grasp::Contact> contacts;
  const auto given = static_cast<int>(options_.among.size());
  for (const int i : random.Choose(given, std::min(given, kRandomContacts))) {
    contacts.push_back(options_.among[i]);
  }
  for (int i = 0; given == 0 && i < kRandomContacts; ++i) {
    if (const auto contact = sampler_.TryDraw(random)) contacts.push_back(*contact);
  }
  return contacts;
}

std::optional<RandomStances::Holding> RandomStances::DrawHolding(RandomStream& random) const {
  Holding holding;
  holding.stance.state.pose = DrawPose(random);
  if (!scene_.KeepsOffPalm(holding.stance.state.pose)) return std::nullopt;
  const int fingers = scene_.finger_count();
  holding.stance.state.joints.resize(fingers);
  const std::vector<grasp::Contact> contacts = DrawContacts(random);
  const int choices = options_.most - options_.fewest + 1;
  const int wanted = options_.fewest + static_cast<int>(random.Index(choices));
  const int count = static_cast<int>(contacts.size());
  for (const int finger : random.Choose(fingers, fingers)) {
    const std::vector<int> order = random.Choose(count, count);
    std::ranges::any_of(order,
                        [&](int i) { return PlaceAt(FingerIndex{finger}, contacts[i], holding); });
    if (std::ssize(holding.placed) == wanted) break;
  }
  if (std::ssize(holding.placed) < wanted) return std::nullopt;
  std::ranges::sort(holding.stance.grasp, {}, &plan::FingerContact::finger);
  return holding;
}

std::optional<RandomStance> RandomStances::TryDraw(RandomStream& random) const {
  auto holding = DrawHolding(random);
  if (!holding) return std::nullopt;
  return std::move(holding->stance);
}

bool RandomStances::PlaceIdleFingers(Holding& holding, RandomStream& random) const {
  std::vector<std::vector<double>>& joints = holding.stance.state.joints;
  for (FingerIndex finger{0}; finger < scene_.finger_count(); ++finger) {
    for (int i = 0; joints[finger].empty(); ++i) {
      if (i == kConfigurations) return false;
      const JointConfiguration configuration = scene_.DrawConfiguration(finger, random);
      PlacedFinger placed = scene_.Place(finger, configuration);
      if (!IsClear(placed, holding, TipContact::kFree)) continue;
      holding.placed.push_back(std::move(placed));
      joints[finger] = kinematics::JointAngles(scene_.finger(finger), configuration);
    }
  }
  return true;
}

std::optional<RandomStance> RandomStances::Draw(RandomStream& random, int tries) const {
  for (int i = 0; i < tries; ++i) {
    auto holding = DrawHolding(random);
    if (!holding) continue;
    grasp::Grasp grasp;
    for (const plan::FingerContact& one : holding->stance.grasp) grasp.push_back(one.contact);
    if (evaluator_.IsAdmitted(grasp) && PlaceIdleFingers(*holding, random))
      return std::move(holding->stance);
  }
  return std::nullopt;
}

}  // namespace regrasp::gait
