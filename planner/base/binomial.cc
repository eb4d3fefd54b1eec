#include "planner/base/binomial.h"

#include <boost/math/distributions/binomial.hpp>
#include <stdexcept>

namespace regrasp {

ShareInterval ComputeShareInterval(int successes, int trials, double confidence) {
  if (trials < 1 || successes < 0 || successes > trials) {
    throw std::invalid_argument("ComputeShareInterval: not 0 <= successes <= trials");
  }
  if (!(confidence > 0 && confidence < 1)) {
    throw std::invalid_argument("ComputeShareInterval: the confidence is not between 0 and 1");
  }
  using Binomial = boost::math::binomial_distribution<double>;
  const double left_out = (1 - confidence) / 2;
  return {Binomial::find_lower_bound_on_p(trials, successes, left_out),
          Binomial::find_upper_bound_on_p(trials, successes, left_out)};
}

}  // namespace regrasp
