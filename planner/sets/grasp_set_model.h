#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/plan_request.h"
#include "planner/sets/set_graph.h"

namespace regrasp::sets {

/// A grasp that a model's planning begins or ends at, as a place in one of its sets.
template <typename Place>
struct Attachment {
  SetIndex set;
  Place place;
  bool whole = true;  ///< it is the grasp itself; otherwise a switch leads from one to the other
};

/// Two grasps of neighbouring sets that the hand can switch between: contacts that stay are the
/// same, bit for bit.
template <typename Place>
struct SetSwitch {
  Place before;
  Place after;
};

/// A switch that is asked for: its sets, and the places to begin or end at; nullptr: it is free to
/// choose.
template <typename Place>
struct SwitchEnds {
  SetIndex from;
  SetIndex to;
  const Place* before = nullptr;
  const Place* after = nullptr;
};

/// What every model of grasp sets has: the types of its places, and the evaluator of the grasps
/// that it chooses.
template <typename PlaceOfModel>
class EvaluatedModel {
 public:
  using Place = PlaceOfModel;
  using Attachments = std::vector<Attachment<Place>>;
  using Switch = SetSwitch<Place>;
  using Ends = SwitchEnds<Place>;

  /// For the request's object, criteria and hand.
  [[nodiscard]] const criteria::GraspEvaluator& evaluator() const { return evaluator_; }

 protected:
  /// @param request  its object outlives this one.
  explicit EvaluatedModel(const planning::PlanRequest& request)
      : evaluator_(*request.object, request.criteria, request.hand) {}

 private:
  criteria::GraspEvaluator evaluator_;
};

/// What a planner over sets of grasps supplies (polygon, contour, polyhedron); the planning itself
/// is written once over it (set_planner.h).
///
/// A set is a vertex of the switching graph; a Place is a grasp in a set, in the model's own terms.
/// All functions may throw TimeUp. A model may also have
///   std::optional<double> Refine(Switch& change)
/// which changes a chosen switch to what the objective asks for, and says how far its contacts may
/// be off.
template <typename Model>
concept GraspSetModel = std::derived_from<Model, EvaluatedModel<typename Model::Place>> &&
    requires(Model model, SetIndex set, const typename Model::Place& place,
             const grasp::Grasp& grasp, RandomStream& random, const typename Model::Ends& ends) {
  { model.graph() } -> std::convertible_to<const SetGraph&>;
  /// For messages: "focus cells".
  { model.sets_name() } -> std::convertible_to<std::string>;
  /// How wide a set is to pass; the more the better.
  { model.WidthOf(set) } -> std::convertible_to<double>;
  /// A grasp anywhere in a set; nullopt where none was found.
  { model.Draw(set, random) } -> std::same_as<std::optional<typename Model::Place>>;

  { model.GraspOf(place) } -> std::same_as<grasp::Grasp>;
  /// The places of a grasp, the best first; empty where no set has it.
  { model.Attach(grasp) } -> std::same_as<typename Model::Attachments>;
  /// Why no set has it: "in none of …".
  { model.WhyUnattached(grasp) } -> std::convertible_to<std::string>;

  /// The best switch that has these ends.
  { model.FindSwitch(ends) } -> std::same_as<std::optional<typename Model::Switch>>;
  /// The grasps that an align inside a set passes, both ends included: between two of them contacts
  /// move straight, or one goes from a face to the next; empty where none is found.
  { model.FindRoute(place, place) } -> std::same_as<std::vector<typename Model::Place>>;
};

}  // namespace regrasp::sets
