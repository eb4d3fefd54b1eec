#pragma once

#include <optional>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {

/// The proof that comes with a decision: for kNo the twist that separates (zero where a pair line
/// or the rank decides), for kYes balanced forces inside the cones.
template <int kDim>
struct ForceClosureProof {
  typename WrenchSimplex<kDim>::Vector twist{};
  boost::container::small_vector<Eigen::Vector3d, kInlineContacts> forces;
};

/// TestForceClosure behind its checks, in the contacts' own frame (ContactFrame), rims of unit
/// force set.
/// @param proof  filled where not null.
/// @param twist  where not null: after kNo the twist that separates, or zero where none was needed.
/// @param used   where not null: the simplex that decided, if one did; it refers to `contacts`.
template <int kDim>
[[nodiscard]] ForceClosure DecideForceClosure(const UnitContacts& contacts,
                                              ForceClosureProof<kDim>* proof = nullptr,
                                              typename WrenchSimplex<kDim>::Vector* twist = nullptr,
                                              std::optional<WrenchSimplex<kDim>>* used = nullptr);

/// The same for a grasp that the lines through pairs of contacts have been seen not to settle.
template <int kDim>
[[nodiscard]] ForceClosure DecideOpenForceClosure(
    const UnitContacts& contacts, ForceClosureProof<kDim>* proof = nullptr,
    typename WrenchSimplex<kDim>::Vector* twist = nullptr,
    std::optional<WrenchSimplex<kDim>>* used = nullptr);

/// Its decision alone, without bounds or forces.
/// @param twist  after kNo the one that separates; zero where the rank decides.
template <int kDim>
[[nodiscard]] Decision DecideOnly(const UnitContacts& contacts,
                                  typename WrenchSimplex<kDim>::Vector& twist);

}  // namespace regrasp::grasp
