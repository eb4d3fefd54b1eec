#include "planner/grasp/judge_grasps.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {
namespace {

/// Grasps that a thread takes at a time: enough that taking them costs nothing, few enough that the
/// threads end together.
constexpr std::size_t kBlock = 256;

std::size_t CountGrasps(const GraspArrays& grasps) {
  if (grasps.contacts < 1) {
    throw std::invalid_argument("a grasp needs a contact, not " + std::to_string(grasps.contacts));
  }
  const std::size_t values = 3 * static_cast<std::size_t>(grasps.contacts);
  if (grasps.points.size() != grasps.normals.size() || grasps.points.size() % values != 0) {
    throw std::invalid_argument("points and normals need as many values, a multiple of " +
                                std::to_string(values) + ", not " +
                                std::to_string(grasps.points.size()) + " and " +
                                std::to_string(grasps.normals.size()));
  }
  return grasps.points.size() / values;
}

void Load(const GraspArrays& grasps, std::size_t index, Grasp& grasp) {
  for (std::size_t c = 0; c < grasp.size(); ++c) {
    const std::size_t start = 3 * (index * grasp.size() + c);
    grasp[c].p = Eigen::Map<const Eigen::Vector3d>(&grasps.points[start]);
    grasp[c].n = Eigen::Map<const Eigen::Vector3d>(&grasps.normals[start]);
  }
}

void Judge(const Grasp& grasp, const JudgeOptions& options, std::size_t index,
           GraspVerdicts& verdicts) {
  verdicts.force_closure[index] = TestForceClosure(grasp, options.frame, options.half_angle);
  if (options.required_half_angle) {
    const auto required = ComputeRequiredHalfAngle(grasp, options.frame);
    verdicts.required_half_angle[index] =
        required ? required->upper : std::numeric_limits<double>::quiet_NaN();
  }
  if (options.quality) {
    verdicts.quality[index] = ComputeQuality(grasp, options.frame, options.half_angle).lower;
  }
}

/// The grasps of one call, handed out block by block. Blocks are taken in order and a block that
/// was taken is finished up to its first bad grasp, so the first bad grasp of all is always found.
class Work {
 public:
  Work(const GraspArrays& grasps, const JudgeOptions& options, GraspVerdicts& verdicts)
      : grasps_(grasps), options_(options), verdicts_(verdicts) {}

  void Run() {
    const std::size_t count = verdicts_.force_closure.size();
    std::size_t index = 0;
    try {
      Grasp grasp(static_cast<std::size_t>(grasps_.contacts));
      while (!failed_) {
        const std::size_t begin = next_.fetch_add(kBlock);
        if (begin >= count) return;
        for (index = begin; index < std::min(count, begin + kBlock); ++index) {
          Load(grasps_, index, grasp);
          Judge(grasp, options_, index, verdicts_);
        }
      }
    } catch (...) {
      Fail(index, std::current_exception());
    }
  }

  void ThrowFailure() const {
    if (!failure_) return;
    try {
      std::rethrow_exception(failure_);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("grasp " + std::to_string(failed_index_) + ": " + error.what());
    }
  }

 private:
  void Fail(std::size_t index, std::exception_ptr failure) {
    const std::scoped_lock lock(mutex_);
    failed_ = true;
    if (failure_ && failed_index_ <= index) return;
    failure_ = std::move(failure);
    failed_index_ = index;
  }

  const GraspArrays& grasps_;
  const JudgeOptions& options_;
  GraspVerdicts& verdicts_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::size_t failed_index_ = 0;
};

std::size_t CountThreads(int asked, std::size_t grasps) {
  if (asked < 0) throw std::invalid_argument(std::to_string(asked) + " threads");
  const std::size_t threads =
      asked > 0 ? static_cast<std::size_t>(asked) : std::thread::hardware_concurrency();
  return std::clamp<std::size_t>(threads, 1, 1 + grasps / kBlock);
}

}  // namespace

GraspVerdicts JudgeGrasps(const GraspArrays& grasps, const JudgeOptions& options) {
  const std::size_t count = CountGrasps(grasps);
  CheckHalfAngle(options.half_angle);
  const std::size_t threads = CountThreads(options.threads, count);
  GraspVerdicts verdicts;
  verdicts.force_closure.resize(count);
  if (options.required_half_angle) verdicts.required_half_angle.resize(count);
  if (options.quality) verdicts.quality.resize(count);

  Work work(grasps, options, verdicts);
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < threads; ++i) others.emplace_back([&work] { work.Run(); });
    work.Run();
  }
  work.ThrowFailure();
  return verdicts;
}

}  // namespace regrasp::grasp
