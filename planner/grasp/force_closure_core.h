#pragma once

#include <optional>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {

/// Proof of a decision. For kNo the twist that separates, which is zero if a pair line or the rank
/// decides; for kYes balanced forces inside the cones.
template <int kDim>
struct ForceClosureProof {
  typename WrenchSimplex<kDim>::Vector twist{};
  boost::container::small_vector<Eigen::Vector3d, kInlineContacts> forces;
};

/// Decide force closure without the argument checks of TestForceClosure.
/// @param contacts  contacts in their own frame (ContactFrame), with rims of unit force.
/// @param proof  output if not null.
/// @param twist  output if not null: after kNo the twist that separates, or zero if none was
///     necessary.
/// @param used   output if not null: the simplex that decided, if any; it refers to `contacts`.
template <int kDim>
[[nodiscard]] ForceClosure DecideForceClosure(const UnitContacts& contacts,
                                              ForceClosureProof<kDim>* proof = nullptr,
                                              typename WrenchSimplex<kDim>::Vector* twist = nullptr,
                                              std::optional<WrenchSimplex<kDim>>* used = nullptr);

/// Decide force closure of a grasp that the lines through pairs of contacts do not decide.
template <int kDim>
[[nodiscard]] ForceClosure DecideOpenForceClosure(
    const UnitContacts& contacts, ForceClosureProof<kDim>* proof = nullptr,
    typename WrenchSimplex<kDim>::Vector* twist = nullptr,
    std::optional<WrenchSimplex<kDim>>* used = nullptr);

/// Return the decision of DecideOpenForceClosure without bounds or forces.
/// @param twist  output: after kNo the twist that separates, or zero if the rank decides.
template <int kDim>
[[nodiscard]] Decision DecideOnly(const UnitContacts& contacts,
                                  typename WrenchSimplex<kDim>::Vector& twist);

}  // namespace regrasp::grasp
