#include "bench/random_rests.h"

#include <algorithm>
#include <stdexcept>

#include "planner/gait/home.h"

namespace regrasp::bench {
namespace {

constexpr int kHolding = 3;
/// Postures drawn for a finger that does not hold.
constexpr int kPostures = 200;

/// Those that a search of the request has.
std::vector<grasp::Contact> ContactsOf(gait::GaitRequest request) {
  request.most_expanded = 0;
  return gait::FindGait(request).contacts;
}

}  // namespace

RandomRests::RandomRests(const gait::GaitRequest& request)
    : request_(request),
      contacts_(ContactsOf(request)),
      surface_(*request.solid, request.scale),
      scene_(*request.hand, surface_, request.margin),
      within_reach_(request.hand->fingers.size()),
      memory_(*request.solid, request.criteria, gait::FingersOf(request),
              criteria::QualityTest::kQuick) {
  memory_.Append(contacts_);
  for (const kinematics::Finger& finger : request.hand->fingers) inverse_.emplace_back(finger);
  std::vector<gait::SurfacePoint> points;
  for (const grasp::Contact& contact : contacts_) {
    points.push_back({request.scale * contact.p, contact.n});
  }
  const gait::HandSetup setup{scene_, inverse_, points, request.scale};
  const gait::Journey nowhere(request.scale * request.solid->mass_properties().centroid, {}, {});
  RandomStream random(request.seed, RandomUse::kHomes);
  homes_ = gait::FindHomes(setup, nowhere, {}, memory_, random);
  if (homes_.empty()) throw std::runtime_error("the object is nowhere within reach of the fingers");
  for (FingerIndex finger{0}; finger < scene_.finger_count(); ++finger) {
    for (int i = 0; i < std::ssize(contacts_); ++i) {
      if (PlaceAt(finger, i)) within_reach_[finger].push_back(i);
    }
  }
}

std::optional<gait::PlacedFinger> RandomRests::PlaceAt(FingerIndex finger, int contact) const {
  const gait::SurfacePoint point{request_.scale * contacts_[contact].p, contacts_[contact].n};
  const auto posture = inverse_[finger].Solve(TargetAt(scene_.finger(finger), point, pose()));
  if (!posture) return std::nullopt;
  return scene_.Place(finger, *posture);
}

bool RandomRests::IsClear(const gait::PlacedFinger& placed,
                          const std::vector<gait::PlacedFinger>& others,
                          gait::TipContact tip) const {
  return scene_.KeepsOffHand(placed) && scene_.KeepsOffObject(placed, pose(), tip) &&
         std::ranges::all_of(others, [&](const gait::PlacedFinger& other) {
           return scene_.KeepApart(other, placed);
         });
}

std::optional<gait::Holding> RandomRests::TryDraw(RandomStream& random) const {
  gait::Holding holding(scene_.finger_count(), gait::kNone);
  if (!scene_.KeepsOffPalm(pose())) return std::nullopt;
  std::vector<gait::PlacedFinger> placed;
  for (const int drawn : random.Choose(scene_.finger_count(), kHolding)) {
    const FingerIndex finger{drawn};
    const std::vector<int>& contacts = within_reach_[finger];
    if (contacts.empty()) return std::nullopt;
    holding[finger] = contacts[random.Index(contacts.size())];
    auto there = *PlaceAt(finger, holding[finger]);
    if (!IsClear(there, placed, gait::TipContact::kTouching)) return std::nullopt;
    placed.push_back(std::move(there));
  }
  return holding;
}

bool RandomRests::HaveRoom(const gait::Holding& holding, RandomStream& random) const {
  std::vector<gait::PlacedFinger> placed;
  for (FingerIndex finger{0}; finger < scene_.finger_count(); ++finger) {
    if (holding[finger] != gait::kNone) placed.push_back(*PlaceAt(finger, holding[finger]));
  }
  for (FingerIndex finger{0}; finger < scene_.finger_count(); ++finger) {
    if (holding[finger] != gait::kNone) continue;
    bool has_room = false;
    for (int i = 0; i < kPostures && !has_room; ++i) {
      auto there = scene_.Place(finger, scene_.DrawPosture(finger, random));
      has_room = IsClear(there, placed, gait::TipContact::kFree);
      if (has_room) placed.push_back(std::move(there));
    }
    if (!has_room) return false;
  }
  return true;
}

std::optional<grasp::Grasp> RandomRests::Draw(RandomStream& random, int tries) {
  for (int i = 0; i < tries; ++i) {
    const auto holding = TryDraw(random);
    if (!holding) continue;
    criteria::ContactSet set;
    for (const int contact : *holding) {
      if (contact != gait::kNone && !set.Has(contact)) set.Insert(contact);
    }
    if (set.size() < kHolding || !memory_.Admits(set) || !HaveRoom(*holding, random)) continue;
    return memory_.GraspOf(set);
  }
  return std::nullopt;
}

}  // namespace regrasp::bench
