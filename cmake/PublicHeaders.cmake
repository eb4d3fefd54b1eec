# The public interface: these headers are installed and described in the reference, no other. Each
# compiles alone, includes no header that is not public, and none of CGAL, GMP, MuJoCo or OpenGL
# (tests/package). examples/ uses them.
set(regrasp_public_headers
  # Values and errors.
  planner/base/number.h
  planner/base/deadline.h
  planner/base/error.h
  planner/base/index.h
  planner/base/random.h
  # Objects.
  planner/object/wrench_frame.h
  planner/object/polygon_soup.h
  planner/object/object.h
  planner/object/polygon.h
  planner/object/polyhedron.h
  planner/object/triangle_mesh.h
  # Grasps.
  planner/grasp/contact.h
  planner/grasp/required_friction_angle.h
  planner/grasp/force_closure.h
  planner/grasp/quality.h
  # Plans: reading, writing, the analytic check.
  planner/motion/motion_segment.h
  planner/certificate/force_proof.h
  planner/plan/check.h
  planner/plan/grasp_io.h
  planner/plan/projection.h
  planner/plan/goal_set.h
  planner/plan/plan.h
  planner/plan/plan_io.h
  planner/plan/reason.h
  planner/plan/contact_region.h
  # Planning: a request, a result, and the planners by their names.
  planner/criteria/grasp_criteria.h
  planner/hand/hand.h
  planner/planning/plan_request.h
  planner/planning/planner.h
  planner/planning/solve.h
  planner/registry/registry.h
  planner/roadmap/roadmap_parameters.h
  planner/sets/set_parameters.h
  # Hands: a hand's file, a task for it, the planner, the replay by its actuators.
  planner/collision/convex_shape.h
  planner/kinematics/hand_model.h
  planner/kinematics/hand_file.h
  planner/planning/in_hand_task.h
  planner/gait/gait_planner.h
  sim/hand/check_hand.h
  sim/actuation/condition_replays.h
  sim/actuation/conditions.h
  sim/actuation/hand_replay.h
  sim/actuation/simulate_execution.h
  # Validation, its replays and its report.
  sim/scene/settings.h
  sim/scene/measured.h
  sim/world/replay_observer.h
  sim/replay/disagreement.h
  sim/replay/replay.h
  sim/replay/trials.h
  sim/validation/goal_report.h
  sim/validation/validation.h
  sim/validation/validation_report.h
  report/report.h
)

# Libraries without a public header are not installed: what draws, writes pages and runs batches.
set(regrasp_private_libraries picture frames viewer figures render page pictures batch)
