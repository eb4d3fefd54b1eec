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

/// Start or goal grasp of a query, as a place in one set of the model.
template <typename Place>
struct Attachment {
  SetIndex set;
  Place place;
  bool whole = true;  ///< true: the place is the grasp itself; false: a switch connects them
};

/// Finger switch: two grasps of adjacent sets. Kept contacts are bit-identical in both.
template <typename Place>
struct SetSwitch {
  Place before;
  Place after;
};

/// Query for a switch between two sets; `before` and `after` fix its grasps if they are not null.
template <typename Place>
struct SwitchEnds {
  SetIndex from;
  SetIndex to;
  const Place* before = nullptr;
  const Place* after = nullptr;
};

/// Base of all models of grasp sets: types of places, and the evaluator of chosen grasps.
template <typename PlaceOfModel>
class EvaluatedModel {
 public:
  using Place = PlaceOfModel;
  using Attachments = std::vector<Attachment<Place>>;
  using Switch = SetSwitch<Place>;
  using Ends = SwitchEnds<Place>;

  /// Evaluator for the object, the acceptance criteria and the hand of the request.
  [[nodiscard]] const criteria::GraspEvaluator& evaluator() const { return evaluator_; }

 protected:
  /// @param request  query; its object must outlive this model.
  explicit EvaluatedModel(const planning::PlanRequest& request)
      : evaluator_(*request.object, request.criteria, request.hand) {}

 private:
  criteria::GraspEvaluator evaluator_;
};

/// Interface of a planner over grasp sets (polygon, contour, polyhedron); see set_planner.h.
///
/// A set is a vertex of the switching graph. A Place is a grasp in a set, in a representation of
/// the model. All functions may throw TimeUp. A model may also have
///   std::optional<double> Refine(Switch& change)
/// which optimizes a chosen switch for the objective and returns the half-width of the contact
/// region of its new contacts.
template <typename Model>
concept GraspSetModel = std::derived_from<Model, EvaluatedModel<typename Model::Place>> &&
    requires(Model model, SetIndex set, const typename Model::Place& place,
             const grasp::Grasp& grasp, RandomStream& random, const typename Model::Ends& ends) {
  { model.graph() } -> std::convertible_to<const SetGraph&>;
  /// Name of the sets for messages: "focus cells".
  { model.sets_name() } -> std::convertible_to<std::string>;
  /// Width of a set; paths through wide sets are preferred.
  { model.WidthOf(set) } -> std::convertible_to<double>;
  /// Draw a random grasp of a set; nullopt if none is found.
  { model.Draw(set, random) } -> std::same_as<std::optional<typename Model::Place>>;

  { model.GraspOf(place) } -> std::same_as<grasp::Grasp>;
  /// Find the places of a grasp, best first; empty if no set contains it.
  { model.Attach(grasp) } -> std::same_as<typename Model::Attachments>;
  /// Explain why no set contains a grasp: "in none of …".
  { model.WhyUnattached(grasp) } -> std::convertible_to<std::string>;

  /// Find the best switch with the given ends.
  { model.FindSwitch(ends) } -> std::same_as<std::optional<typename Model::Switch>>;
  /// Find the waypoints of a sliding step inside a set, including both ends; empty if there are
  /// none. Between two waypoints, contacts move straight, or one contact passes to the next face.
  { model.FindRoute(place, place) } -> std::same_as<std::vector<typename Model::Place>>;
};

}  // namespace regrasp::sets
