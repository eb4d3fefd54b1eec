#pragma once

#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/bidirectional_tree.h"
#include "planner/tree/face_align.h"
#include "tests/fixtures/models.h"

namespace regrasp::tree {

/// Draw a random grasp of `contacts` contacts that meets the criteria.
[[nodiscard]] inline grasp::Grasp DrawGrasp(const object::Object& object, int contacts,
                                            const criteria::GraspCriteria& criteria,
                                            RandomStream& random, const hand::Hand& hand = {}) {
  const sampling::SurfaceSampler source(object);
  SearchSpace space(object, criteria, hand);
  constexpr int kMostDraws = 1'000'000;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    grasp::Grasp grasp;
    for (int i = 0; i < contacts; ++i) grasp.push_back(source.Draw(random));
    if (space.IsAdmitted(grasp)) return grasp;
  }
  ADD_FAILURE() << "no grasp was drawn";
  return {};
}

[[nodiscard]] inline criteria::ContactSet Take(const grasp::Grasp& grasp, SearchSpace& space) {
  const criteria::ContactSet set = space.Add(grasp);
  space.Accept(set);
  return set;
}

}  // namespace regrasp::tree
