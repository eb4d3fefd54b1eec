#include "planner/sets/candidate_search.h"

#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "tests/fixtures/edge_grasp.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::sets {
namespace candidate_search_test {

using search::VertexPair;

const object::Polygon kSquare = Square(1);
const grasp::Grasp kStart = MakeGrasp(kSquare, {{0, 0.5}, {2, 0.5}});
const grasp::Grasp kGood = MakeGrasp(kSquare, {{0, 0.4}, {2, 0.4}});
/// Grasps at 30° (tan 0.577) with force closure and a quality below 0.01: tangents of 0.57 and
/// 0.576.
const grasp::Grasp kWeak = MakeGrasp(kSquare, {{0, 0.22}, {2, 0.21}});
const grasp::Grasp kWeaker = MakeGrasp(kSquare, {{0, 0.22}, {2, 0.204}});

/// Graph with two short paths from vertex 0 to 3, over 1 and over 2, and a wider detour over 4 and
/// 5.
class TwoPaths final : public search::SwitchingGraph {
 public:
  [[nodiscard]] int vertex_count() const override { return 6; }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override {
    static const std::vector<std::vector<int>> kNeighbours = {{1, 2, 4}, {0, 3}, {0, 3},
                                                              {1, 2, 5}, {0, 5}, {3, 4}};
    neighbours = kNeighbours[vertex];
  }
};

TEST(FindWidePath, OfTheShortestPathsTheWidest) {
  const auto path_by = [](double of_1, double of_2) {
    return FindWidePath(TwoPaths(), 0, 3, [=](int vertex) {
      return vertex == 1 ? of_1 : vertex == 2 ? of_2 : 9.0;
    });
  };
  EXPECT_EQ(path_by(1, 2), (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(path_by(2, 1), (std::vector<int>{0, 1, 3}));
}

/// Paths with one switch each to a given grasp. A path is available until its switch is banned.
class Offers {
 public:
  explicit Offers(std::vector<grasp::Grasp> grasps) : grasps_(std::move(grasps)) {}

  [[nodiscard]] std::optional<planning::CandidateSequence> Find(double radius = 0,
                                                                const Deadline& deadline = {}) {
    const criteria::GraspEvaluator evaluator(kSquare, {Radians(30), 0.01},
                                             {.fingertip_radius = radius});
    return FindCandidate(
        evaluator,
        [&](const std::set<VertexPair>& banned) {
          for (int i = 0; i < std::ssize(grasps_); ++i) {
            if (!banned.contains(EdgeOf(i))) return std::vector<int>{i};
          }
          return std::vector<int>();
        },
        [&](const std::vector<int>& path, auto& /*banned*/) {
          tried_.push_back(path.front());
          planning::CandidateSequence made = planning::StartOf(kStart);
          made.rests.push_back({grasps_[path.front()], EdgeOf(path.front())});
          made.steps.emplace_back(
              plan::Align{{made.initial, plan::FingersInOrder(grasps_[path.front()])}});
          return std::optional(made);
        },
        deadline);
  }
  [[nodiscard]] const std::vector<int>& tried() const { return tried_; }

 private:
  static VertexPair EdgeOf(int path) { return {path, path + 100}; }

  std::vector<grasp::Grasp> grasps_;
  std::vector<int> tried_;
};

double TopOf(const planning::CandidateSequence& found) { return found.rests[1].grasp[1].p.x(); }

TEST(FindCandidate, TheFirstThatIsGoodEndsTheSearch) {
  Offers offers({kWeak, kGood, kWeaker});
  const auto found = offers.Find();
  ASSERT_TRUE(found);
  EXPECT_EQ(TopOf(*found), kGood[1].p.x());
  EXPECT_EQ(offers.tried(), (std::vector<int>{0, 1}));
}

TEST(FindCandidate, WhereNoneIsGoodItIsTheLeastPoor) {
  for (const auto& grasps : {std::vector{kWeaker, kWeak}, std::vector{kWeak, kWeaker}}) {
    Offers offers(grasps);
    const auto found = offers.Find();
    ASSERT_TRUE(found);
    EXPECT_EQ(TopOf(*found), kWeak[1].p.x());
    EXPECT_EQ(offers.tried(), (std::vector<int>{0, 1}));
  }
  EXPECT_FALSE(Offers({}).Find());
}

TEST(FindCandidate, WhereTheTimeIsUpItIsTheBestSoFar) {
  int looks = 0;
  const auto deadline_after = [&](int most) {
    looks = 0;
    return Deadline(Deadline::Clock::time_point(std::chrono::seconds(1)), [&looks, most] {
      return Deadline::Clock::time_point(std::chrono::seconds(++looks > most ? 2 : 0));
    });
  };
  const auto found = Offers({kWeaker, kWeak}).Find(0, deadline_after(1));
  ASSERT_TRUE(found);
  EXPECT_EQ(TopOf(*found), kWeaker[1].p.x());
  EXPECT_THROW((void)Offers({kWeaker, kWeak}).Find(0, deadline_after(0)), TimeUp);
}

}  // namespace candidate_search_test
}  // namespace regrasp::sets
