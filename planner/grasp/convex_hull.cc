#include "planner/grasp/convex_hull.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace regrasp::grasp {
namespace {

/// State of Qhull: freed by the destructor, with messages discarded.
class QhullRun {
 public:
  QhullRun() : messages_(std::fopen("/dev/null", "w"), &std::fclose) { qh_zero(&qh_, stderr); }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;
  ~QhullRun() {
    qh_freeqhull(&qh_, !qh_ALL);
    int current_long = 0;
    int total_long = 0;
    qh_memfreeshort(&qh_, &current_long, &total_long);
  }

  void Compute(Eigen::MatrixXd& points) {
    std::string command = "qhull QJ";
    const int status =
        qh_new_qhull(&qh_, static_cast<int>(points.rows()), static_cast<int>(points.cols()),
                     points.data(), False, command.data(), nullptr, messages_.get());
    if (status != 0) {
      throw std::runtime_error("convex hull: Qhull ended with code " + std::to_string(status));
    }
  }

  [[nodiscard]] qhT& qh() { return qh_; }

 private:
  qhT qh_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;
};

}  // namespace

ConvexHull ComputeConvexHull(const Eigen::MatrixXd& points) {
  Eigen::MatrixXd joggled = points;
  QhullRun run;
  run.Compute(joggled);
  ConvexHull hull;
  qhT* qh = &run.qh();
  // The joggle moves each coordinate by up to JOGGLEmax, and a point by √dimension times that.
  hull.joggle = 2 * qh->JOGGLEmax * std::sqrt(static_cast<double>(points.rows()));
  facetT* facet = nullptr;
  FORALLfacets {
    hull.facets.push_back(
        {Eigen::Map<const Eigen::VectorXd>(facet->normal, points.rows()), -facet->offset});
  }
  return hull;
}

}  // namespace regrasp::grasp
