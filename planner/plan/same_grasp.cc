#include "planner/plan/same_grasp.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>
#include <vector>

#include "planner/grasp/angle_between.h"
#include "planner/plan/tolerance.h"

namespace regrasp::plan {

bool AreSameContact(const grasp::Contact& a, const grasp::Contact& b, double tolerance) {
  return (a.p - b.p).norm() <= tolerance && grasp::AngleBetween(a.n, b.n) <= kNormalTolerance;
}

bool AreSameGrasp(const grasp::Grasp& a, const grasp::Grasp& b, double tolerance) {
  if (a.size() != b.size()) return false;
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
  Graph graph(a.size() + b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (AreSameContact(a[i], b[j], tolerance)) boost::add_edge(i, a.size() + j, graph);
    }
  }
  std::vector<Graph::vertex_descriptor> mate(a.size() + b.size());
  boost::edmonds_maximum_cardinality_matching(graph, mate.data());
  return boost::matching_size(graph, mate.data()) == a.size();
}

bool AreIdentical(const FingerGrasp& a, const FingerGrasp& b) {
  return std::ranges::equal(a, b, [](const FingerContact& x, const FingerContact& y) {
    return x.finger == y.finger && x.contact.p == y.contact.p && x.contact.n == y.contact.n &&
           x.contact.torsion == y.contact.torsion;
  });
}

}  // namespace regrasp::plan
