#include "planner/tree/repair_quality.h"

#include <algorithm>

#include "planner/tree/subpath.h"
#include "planner/tree/subset_search.h"

namespace regrasp::tree {

namespace {

/// Shares of the criteria that are asked for one after the other.
constexpr int kLevels = 8;

/// Attempts in a row without a gain after which a path is left as it is.
constexpr int kMostFailures = 30;

/// Steps before and behind the weakest grasp that are replaced.
constexpr int kMostAround = 3;

/// Steps that the replacement may have more.
constexpr int kMoreRepairSteps = 1;

class QualityRepair {
 public:
  QualityRepair(const sampling::SurfaceSampler& source, RandomStream& random, SearchSpace& space,
                GraspPath& path)
      : source_(source), random_(random), space_(space), path_(path) {}

  double Run() {
    int failures = 0;
    while (failures < kMostFailures && !space_.IsSpent()) {
      const auto [weakest, level] = Weakest();
      if (weakest < 0) break;
      failures = Raise(weakest, level + 1) ? 0 : failures + 1;
    }
    const double reached = ShareOf(Weakest().second);
    space_.SetShare(1);
    return reached;
  }

 private:
  [[nodiscard]] static double ShareOf(int level) { return static_cast<double>(level) / kLevels; }

  /// Of a step: of the grasp that it leads to, if that is not the path's end, and of the align that
  /// leads there.
  int LevelOf(const PathStep& step) {
    const bool is_end = &step == &path_.steps.back();
    int level = kLevels;
    for (; level > 0; --level) {
      space_.SetShare(ShareOf(level));
      if ((is_end || space_.Admits(step.to)) && (!step.align || AdmitsPath(*step.align, space_))) {
        break;
      }
    }
    return level;
  }

  /// The first of the steps of the lowest level, from 1, and that level; -1 where all are good.
  std::pair<int, int> Weakest() {
    std::pair<int, int> weakest = {-1, kLevels};
    for (int number = 1; number <= static_cast<int>(path_.steps.size()); ++number) {
      const int level = LevelOf(path_.steps[number - 1]);
      if (level < weakest.second) weakest = {number, level};
    }
    return weakest;
  }

  bool Raise(int weakest, int level) {
    const int around = 1 + static_cast<int>(random_.Index(kMostAround));
    const int end = std::min(weakest + around, static_cast<int>(path_.steps.size()));
    Subpath subpath = SubpathBetween(path_, std::max(weakest - around, 0), end);
    if (static_cast<int>(subpath.contacts.size()) >= kMostSubsetContacts) return false;
    FillAround(subpath, kMostSubsetContacts, source_, random_, space_);
    space_.SetShare(ShareOf(level));
    const auto better = SearchSubsets(
        GraspNumber(path_, subpath.begin), GraspNumber(path_, subpath.end), subpath.contacts,
        UseAligns::kYes, subpath.end - subpath.begin + kMoreRepairSteps, space_);
    if (!better) return false;
    ReplaceSubpath(*better, subpath, path_);
    return true;
  }

  const sampling::SurfaceSampler& source_;
  RandomStream& random_;
  SearchSpace& space_;
  GraspPath& path_;
};

}  // namespace

double RepairQuality(const sampling::SurfaceSampler& source, RandomStream& random,
                     SearchSpace& space, GraspPath& path) {
  return QualityRepair(source, random, space, path).Run();
}

}  // namespace regrasp::tree
