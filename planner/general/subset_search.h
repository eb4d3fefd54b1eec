#pragma once

#include <optional>
#include <vector>

#include "planner/general/grasp_path.h"
#include "planner/general/search_space.h"

namespace regrasp {

/// Whether aligns are looked for beside finger switches.
enum class UseAligns { kNo, kYes };

/// Joins two grasps over grasps of a few contacts, with the fewest steps: a breadth-first search
/// from both ends in which a subset is tested when it is first reached. In one step a hand of h
/// fingers switches from A to B iff |A ∪ B| ≤ h. Aligns (AlignBetween) take contacts to others of
/// their faces, and two at most to ones beyond edges near by. They are taken to hold until they are
/// part of a way, and are proved then; after some that do not the search does without.
///
/// Laws: none of the sets but the ends needs to be admitted; the fewest steps never grow with more
/// contacts, more friction or aligns. (With aligns a way found is not always the shortest: see
/// above.)
/// @param contacts   those of the ends included, at most kMostSubsetContacts.
/// @param most_steps the search ends there.
/// @returns nullopt where there is no way.
[[nodiscard]] std::optional<GraspPath> SearchSubsets(const ContactSet& from, const ContactSet& to,
                                                     const std::vector<int>& contacts,
                                                     UseAligns aligns, int most_steps,
                                                     SearchSpace& space);

/// Of the ways of at most `most_steps` steps one that needs the least friction, to a milliradian:
/// the half-angle at which SearchSubsets finds one is bisected. What is known of a grasp or an
/// align at one angle spares tests at the others, so that all take little more than the first.
/// @param least  no way is looked for that needs less than this half-angle, radians.
/// @returns nullopt where none needs less than the space's half-angle.
[[nodiscard]] std::optional<GraspPath> SearchWidest(const ContactSet& from, const ContactSet& to,
                                                    const std::vector<int>& contacts,
                                                    UseAligns aligns, int most_steps, double least,
                                                    SearchSpace& space);

/// Over the contacts of the two grasps alone, by switches. With enough friction that joins nearly
/// all pairs.
[[nodiscard]] std::optional<GraspPath> SearchOwnSubsets(const ContactSet& from,
                                                        const ContactSet& to, SearchSpace& space);

/// What is known of every subset is kept in an array of 2¹⁶ numbers at most.
inline constexpr int kMostSubsetContacts = 16;

}  // namespace regrasp
