#include "apps/evaluate_reasons.h"

#include <array>

namespace regrasp::apps {

namespace {

using enum plan::FailureCheck;

constexpr auto kEvaluateReasons = std::to_array<plan::FailureReason>({
    {.name = "joints-out-of-range",
     .check = kAnalytic,
     .meaning = "A joint is more than 10⁻³ rad or metres outside its range (`analytic`).",
     .causes = "The joint values are in another order, or for another version of the model.\n"
               "An optimizer without joint limits made the grasp.",
     .remedies = "Compare the joint names and ranges of the data set with those of the model.\n"
                 "Discard the grasp, because the hand cannot reach it."},
    {.name = "penetrates",
     .check = kAnalytic,
     .meaning = "A link is deeper in the object than the protocol allows: 2 mm, or 10 mm at the "
                "start of `dexgraspbench`. That protocol has the same limit for links that "
                "penetrate each other.",
     .causes = "The object has another scale than in the data set.\n"
               "The palm pose is that of another link, such as the wrist.\n"
               "The data set was made with simplified or softer geometry.",
     .remedies = "Check `scale` and the palm frame (`regrasp-convert --palm`) if most grasps of an "
                 "object fail.\n"
                 "Add a `pregrasp` outside the object, which `dexgraspbench` starts from.\n"
                 "Discard the grasp if others of the same object pass."},
    {.name = "no-contact",
     .check = kAnalytic,
     .meaning = "No link is within 1 mm of the surface (`analytic`), or another protocol fails and "
                "no link touches the object after the hand has closed.",
     .causes = "A convention differs: quaternion order, palm frame, or scale. See `likely_cause` "
               "in the report.\n"
               "The closing fingers move the object out of the hand.\n"
               "The configuration is that before the hand closes.",
     .remedies = "Check the conventions if most grasps fail.\n"
                 "Give the configuration that the actuators are commanded to as `target`.\n"
                 "Discard the grasp if others of the same object pass."},
    {.name = "not-force-closure",
     .check = kAnalytic,
     .meaning = "The contacts within 1 mm are not force closure at the friction coefficient "
                "(`analytic`). A grasp that relies on torsional friction, such as two point "
                "contacts, fails this test and can pass the others.",
     .causes = "All contacts are on one side of the object.\n"
               "Links that would close the grasp are more than 1 mm from the surface.\n"
               "The friction coefficient is smaller than that of the data set.",
     .remedies = "Use the friction coefficient of the data set (--mu).\n"
                 "Run a simulated protocol, which moves the fingers to the surface.",
     .see = "force_closure.md",
     .about = "force closure"},
    {.name = "object-moved",
     .check = kReplay,
     .meaning = "The object moves by 5 cm or 15° or more under a force (`dexgraspbench`).",
     .causes = "The grasp force is too small for the mass and the friction.\n"
               "The object rolls between the fingers.\n"
               "The object moves while the hand closes, because the fingers reach it at different "
               "times.",
     .remedies = "Use the mass and the friction coefficient of the data set (--mass, --mu).\n"
                 "Give a `target` that is farther inside the object.\n"
                 "Discard the grasp."},
    {.name = "dropped",
     .check = kReplay,
     .meaning = "No link touches the object for 0.1 s before 3 s have passed (`fall`).",
     .causes = "The grasp force is too small for the weight.\n"
               "The hand supports the object only against gravity in some directions.",
     .remedies = "Use the mass and the friction coefficient of the data set (--mass, --mu).\n"
                 "Give a `target` that is farther inside the object.\n"
                 "Discard the grasp."},
    {.name = "force-not-resisted",
     .check = kReplay,
     .meaning = "The largest resisted force is below 10 N per kg in a direction (`disturbance`). "
                "The object then moves by more than 1 cm or 15° in the hand.",
     .causes = "The grasp force is too small for the mass and the friction.\n"
               "The contacts are not force closure, for example because a finger does not touch.\n"
               "The joints are too compliant: the object moves with the fingers.",
     .remedies = "Compare `resisted_N` of all directions: one weak direction is a property of the "
                 "contacts, equally weak directions are a small grasp force.\n"
                 "Give a `target` that is farther inside the object.\n"
                 "Discard the grasp."},
    {.name = "unstable",
     .check = kReplay,
     .meaning = "The simulation diverges.",
     .causes = "Deep penetration.\n"
               "Actuators that are too stiff for the time step of 4 ms.\n"
               "Links that are much lighter than the object.",
     .remedies = "Add the `armature` of the gears to the model.\n"
                 "Check mass (--mass) and scale of the object."},
});

}  // namespace

std::span<const plan::FailureReason> EvaluateReasons() { return kEvaluateReasons; }

}  // namespace regrasp::apps
