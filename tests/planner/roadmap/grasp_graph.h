#pragma once

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "planner/grasp/force_closure.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp::roadmap {

/// Explicit graph of grasps, in which two are connected if they share three contacts. It is the
/// reference for searches that evaluate grasps lazily.
class GraspGraph {
 public:
  explicit GraspGraph(const std::set<Quadruple>& grasps) {
    for (const Quadruple& grasp : grasps) {
      const int number = static_cast<int>(number_of_.size());
      number_of_[grasp] = number;
      for (int left_out = 0; left_out < 4; ++left_out) {
        std::vector<int> triple(grasp.begin(), grasp.end());
        triple.erase(triple.begin() + left_out);
        sets_.union_set(number, with_triple_.try_emplace(triple, number).first->second);
      }
    }
  }

  [[nodiscard]] bool Has(const Quadruple& grasp) const { return number_of_.contains(grasp); }
  [[nodiscard]] int size() const { return static_cast<int>(number_of_.size()); }
  [[nodiscard]] bool Joined(const Quadruple& a, const Quadruple& b) {
    return Has(a) && Has(b) && ComponentOf(a) == ComponentOf(b);
  }
  [[nodiscard]] int ComponentOf(const Quadruple& grasp) {
    return sets_.find_set(number_of_.at(grasp));
  }
  [[nodiscard]] std::map<int, std::vector<Quadruple>> Components() {
    std::map<int, std::vector<Quadruple>> components;
    for (const auto& [grasp, number] : number_of_) {
      components[sets_.find_set(number)].push_back(grasp);
    }
    return components;
  }

 private:
  std::map<Quadruple, int> number_of_;
  std::map<std::vector<int>, int> with_triple_;
  boost::disjoint_sets_with_storage<> sets_{1 << 18};
};

/// Predicate whether four contacts, given by their numbers, are a grasp.
using IsGrasp = std::function<bool(const Quadruple&)>;

/// Return a predicate for force closure of the contacts.
inline IsGrasp ForceClosureOf(const std::vector<grasp::Contact>& contacts,
                              const object::WrenchFrame& frame, double friction_angle) {
  return [&contacts, frame, friction_angle](const Quadruple& g) {
    return grasp::IsForceClosure(
        grasp::Grasp{contacts[g[0]], contacts[g[1]], contacts[g[2]], contacts[g[3]]}, frame,
        friction_angle);
  };
}

/// Return all grasps with one contact from each of four sets.
inline std::set<Quadruple> Product(const std::array<std::vector<int>, 4>& sets,
                                   const IsGrasp& is_grasp) {
  std::set<Quadruple> grasps;
  for (const int a : sets[0]) {
    for (const int b : sets[1]) {
      for (const int c : sets[2]) {
        for (const int d : sets[3]) {
          Quadruple grasp = {a, b, c, d};
          std::sort(grasp.begin(), grasp.end());
          if (std::adjacent_find(grasp.begin(), grasp.end()) != grasp.end()) continue;
          if (!grasps.contains(grasp) && is_grasp(grasp)) grasps.insert(grasp);
        }
      }
    }
  }
  return grasps;
}

/// Return all grasps of four of the contacts.
inline std::set<Quadruple> Subsets(std::vector<int> contacts, const IsGrasp& is_grasp) {
  std::sort(contacts.begin(), contacts.end());
  std::set<Quadruple> grasps;
  const std::size_t n = contacts.size();
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c) {
        for (std::size_t d = c + 1; d < n; ++d) {
          const Quadruple grasp = {contacts[a], contacts[b], contacts[c], contacts[d]};
          if (is_grasp(grasp)) grasps.insert(grasps.end(), grasp);
        }
      }
    }
  }
  return grasps;
}

/// Return the number of contacts in which two grasps differ.
inline int Differences(const Quadruple& a, const Quadruple& b) {
  return static_cast<int>(std::count_if(
      a.begin(), a.end(), [&](int c) { return std::find(b.begin(), b.end(), c) == b.end(); }));
}

/// Return the first error of a path between two grasps; nullopt if it is valid.
/// Errors are wrong ends, an invalid grasp, and a step that does not change exactly one contact.
inline std::optional<std::string> FaultOf(const std::vector<Quadruple>& way, const Quadruple& from,
                                          const Quadruple& to, const IsGrasp& is_grasp) {
  if (way.empty() || way.front() != from || way.back() != to) return "ends";
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (!is_grasp(way[i])) return "grasp " + std::to_string(i);
    if (i > 0 && Differences(way[i - 1], way[i]) != 1) return "step " + std::to_string(i);
  }
  return std::nullopt;
}

}  // namespace regrasp::roadmap
