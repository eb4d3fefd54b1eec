#include "planner/object/mesh_survey.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/body_measures.h"
#include "planner/object/facet_triangulation.h"
#include "planner/object/solid.h"
#include "planner/object/triangle_mesh.h"
#include "planner/object/weld.h"

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

using Sets = boost::disjoint_sets_with_storage<>;

bool IsSpoilt(const PolygonSoup& soup, const std::vector<int>& facet) {
  return std::ranges::any_of(facet, [&](int v) {
    return v < 0 || v >= std::ssize(soup.vertices) ||
           !(soup.vertices[v].cwiseAbs().array() <= kMaxCoordinate).all();
  });
}

WeldedSoup WeldSound(const PolygonSoup& soup, MeshSurvey& survey) {
  PolygonSoup sound = soup;
  for (std::vector<int>& facet : sound.facets) {
    if (!IsSpoilt(soup, facet)) continue;
    facet.clear();
    ++survey.spoilt_facets;
  }
  return WeldVertices(sound, "mesh");
}

/// Count defects of single polygons. @returns triangles of those that can be triangulated.
TriangleMesh SurveyFacets(const WeldedSoup& soup, MeshSurvey& survey) {
  TriangleMesh mesh{soup.vertices, soup.vertex_in_file, {}, {}, {}, 0};
  survey.degenerate_facets = -survey.spoilt_facets;  // they have no corners either
  std::vector<Vector3d> corners;
  for (int f = 0; f < std::ssize(soup.facets); ++f) {
    const std::vector<int>& facet = soup.facets[f];
    corners.clear();
    for (const int v : facet) corners.push_back(soup.vertices[v]);
    const PolygonCut cut =
        facet.empty() ? PolygonCut{{}, 0, MeshDefect::kDegenerateFacet} : CutPolygon(corners);
    survey.degenerate_facets += cut.defect == MeshDefect::kDegenerateFacet;
    survey.twisted_facets += cut.defect == MeshDefect::kSelfIntersecting;
    survey.bent_facets += cut.off_plane > kBentTolerance * survey.diameter;
    survey.largest_bend = std::max(survey.largest_bend, cut.off_plane);
    for (const auto& [a, b, c] : cut.triangles) {
      mesh.triangles.push_back({facet[a], facet[b], facet[c]});
      mesh.facet_of_triangle.push_back(f);
    }
  }
  for (const RepeatedFacet& repeated : FindRepeatedFacets(soup.facets)) {
    ++(repeated.same_way ? survey.duplicate_facets : survey.opposite_facets);
  }
  return mesh;
}

void SurveyBorders(const WeldedSoup& soup, const std::vector<EdgeSide>& sides, MeshSurvey& survey) {
  Sets joined(soup.vertices.size());
  ForEachEdge(sides, [&](std::span<const EdgeSide> edge) {
    survey.open_edges += edge.size() == 1;
    survey.crowded_edges += edge.size() > 2;
    survey.misoriented_edges += edge.size() == 2 && edge[0].forward == edge[1].forward;
    if (edge.size() == 1) joined.union_set(edge[0].low, edge[0].high);
  });
  std::map<int, double> length;
  ForEachEdge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() != 1) return;
    double& sum = length[joined.find_set(edge[0].low)];
    sum += (soup.vertices[edge[0].high] - soup.vertices[edge[0].low]).norm();
    survey.longest_border = std::max(survey.longest_border, sum);
  });
  survey.borders = static_cast<int>(length.size());
}

/// Maximum number of solid angles summed to find shells inside another: half a second.
constexpr std::size_t kMostSolidAngles = 10'000'000;

/// Find closed shells inside another shell that they do not intersect.
/// @param part  index of each shell in `parts`.
void FindInside(const WeldedSoup& soup, const SurfaceParts& parts, const std::vector<int>& part,
                MeshSurvey& survey) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const int p : part) {
    Eigen::AlignedBox3d& box = boxes.emplace_back();
    for (const int f : parts.facets[p]) {
      for (const int v : soup.facets[f]) box.extend(soup.vertices[v]);
    }
  }
  std::size_t work = 0;
  for (std::size_t inner = 0; inner < part.size(); ++inner) {
    if (survey.shells[inner].overlaps) continue;
    const Vector3d& point = soup.vertices[soup.facets[parts.facets[part[inner]][0]][0]];
    for (std::size_t outer = 0; outer < inner && !survey.shells[inner].inside; ++outer) {
      const bool within = boxes[outer].contains(boxes[inner]);
      work += within ? parts.facets[part[outer]].size() : 1;
      if (work > kMostSolidAngles) {
        survey.all_pairs_seen = false;
        return;
      }
      if (!within) continue;
      constexpr double kHalf = 0.5;  // between 0 (outside) and ±1
      survey.shells[inner].inside =
          std::abs(WindingNumber(soup, parts.facets[part[outer]], point)) > kHalf;
    }
  }
}

/// Store the closed parts, largest first. @returns index of each shell in `parts`.
std::vector<int> CollectShells(const WeldedSoup& soup, const SurfaceParts& parts,
                               MeshSurvey& survey) {
  std::vector<std::pair<int, double>> found;
  for (int p = 0; p < std::ssize(parts.facets); ++p) {
    if (parts.closed[p]) found.emplace_back(p, VolumeOf(soup, parts.facets[p]));
  }
  std::ranges::stable_sort(found, std::ranges::greater(),
                           [](const auto& shell) { return std::abs(shell.second); });
  survey.open_parts = static_cast<int>(parts.facets.size() - found.size());
  std::vector<int> part;
  for (const auto& [p, volume] : found) {
    part.push_back(p);
    survey.shells.push_back(
        {parts.facets[p][0], static_cast<int>(parts.facets[p].size()), volume, false, false});
  }
  return part;
}

void SurveyCrossings(const TriangleMesh& mesh, const SurfaceParts& parts,
                     const std::vector<int>& part, const Deadline& deadline, MeshSurvey& survey) {
  std::vector<int> shell_of_part(parts.facets.size(), -1);
  for (std::size_t s = 0; s < part.size(); ++s) shell_of_part[part[s]] = static_cast<int>(s);
  const auto shell_of = [&](TriangleIndex t) {
    return shell_of_part[parts.of_facet[mesh.facet_of_triangle[t]]];
  };
  std::set<std::pair<int, int>> pairs;
  const auto count = [&](TriangleIndex a, TriangleIndex b) {
    if (pairs.size() == kMostCrossings) return false;
    pairs.insert(std::minmax(mesh.facet_of_triangle[a], mesh.facet_of_triangle[b]));
    const int one = shell_of(a), other = shell_of(b);
    if (one >= 0 && other >= 0 && one != other) {
      survey.shells[one].overlaps = survey.shells[other].overlaps = true;
    }
    return true;
  };
  survey.all_pairs_seen =
      VisitCrossings(mesh, kMostPairsSurveyed, deadline, count) && pairs.size() < kMostCrossings;
  survey.crossing_pairs = static_cast<int>(pairs.size());
}

std::string Count(std::size_t count, const std::string& one, const std::string& more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

std::string ShellsText(const MeshSurvey& survey) {
  if (survey.shells.size() < 2) return "";
  std::string text = std::to_string(survey.shells.size()) + " closed shells (";
  const auto overlap = std::ranges::count_if(survey.shells, &ClosedShell::overlaps);
  const auto inside = std::ranges::count_if(survey.shells, &ClosedShell::inside);
  const std::string least = survey.all_pairs_seen ? "" : "at least ";
  const std::size_t all = survey.shells.size();
  if (overlap > 0) {
    text += least + (std::size_t(overlap) == all ? "all" : std::to_string(overlap)) +
            " of them overlap, ";
  }
  if (inside > 0) text += least + Count(inside, "lies", "lie") + " inside another, ";
  std::vector<double> volumes;
  for (const ClosedShell& shell : survey.shells) volumes.push_back(std::abs(shell.volume));
  return text + "with " + SharesText(volumes) + " of the volume)";
}

}  // namespace

std::string SharesText(const std::vector<double>& volumes) {
  constexpr std::size_t kListed = 5;
  const double sum = std::reduce(volumes.begin(), volumes.end());
  std::string list;
  for (std::size_t i = 0; i < std::min(volumes.size(), kListed); ++i) {
    const double percent = sum > 0 ? 100 * volumes[i] / sum : 0;
    list += (i == 0 ? "" : ", ") + FormatShort(percent, 3) + " %";
  }
  return volumes.size() > kListed ? list + ", …" : list;
}

MeshSurvey SurveyMesh(const PolygonSoup& soup, const Deadline& deadline) {
  MeshSurvey survey;
  const WeldedSoup welded = WeldSound(soup, survey);
  survey.facets = static_cast<int>(soup.facets.size());
  survey.vertices = static_cast<int>(welded.vertices.size());
  survey.diameter = ComputeDiameter(welded.vertices);
  deadline.Check();
  const TriangleMesh mesh = SurveyFacets(welded, survey);
  deadline.Check();
  const std::vector<EdgeSide> sides = SortedEdgeSides(welded.facets, welded.vertices.size());
  SurveyBorders(welded, sides, survey);
  const SurfaceParts parts = FindParts(welded, sides);
  const std::vector<int> part = CollectShells(welded, parts, survey);
  SurveyCrossings(mesh, parts, part, deadline, survey);
  FindInside(welded, parts, part, survey);
  return survey;
}

std::string SurveyText(const MeshSurvey& survey) {
  std::vector<std::string> texts;
  const auto add = [&](std::size_t count, const std::string& one, const std::string& more,
                       const std::string& behind = "") {
    if (count > 0) texts.push_back(Count(count, one, more) + behind);
  };
  add(survey.spoilt_facets, "facet with invalid vertices", "facets with invalid vertices");
  add(survey.degenerate_facets, "facet without area", "facets without area");
  add(survey.duplicate_facets, "duplicate facet", "duplicate facets");
  add(survey.opposite_facets, "facet on the back of another", "facets on the back of other facets");
  add(survey.twisted_facets, "facet whose outline intersects itself",
      "facets whose outlines intersect themselves");
  add(survey.bent_facets, "facet out of plane", "facets out of plane",
      " (by up to " + FormatShort(survey.largest_bend) + ", " +
          FormatShort(survey.largest_bend / survey.diameter) + " of the diameter)");
  add(survey.open_edges, "open edge in ", "open edges in ",
      Count(survey.borders, "border", "borders") + " (the longest " +
          FormatShort(survey.longest_border) + " long)");
  add(survey.crowded_edges, "edge of more than two facets", "edges of more than two facets");
  add(survey.misoriented_edges, "edge between facets of opposite orientation",
      "edges between facets of opposite orientation");
  if (survey.crossing_pairs > 0 && !survey.all_pairs_seen) {
    texts.push_back("at least " + Count(survey.crossing_pairs, "crossing pair", "crossing pairs"));
  } else {
    add(survey.crossing_pairs, "crossing pair", "crossing pairs");
  }
  if (survey.open_parts > 1 || (survey.open_parts == 1 && !survey.shells.empty())) {
    add(survey.open_parts, "open part", "open parts");
  }
  if (const std::string shells = ShellsText(survey); !shells.empty()) texts.push_back(shells);
  std::string line;
  for (const std::string& text : texts) line += (line.empty() ? "" : ", ") + text;
  return line;
}

namespace {

Eigen::AlignedBox3d BoxOf(const WeldedSoup& soup, const std::vector<int>& facets) {
  Eigen::AlignedBox3d box;
  for (const int f : facets) {
    for (const int v : soup.facets[f]) box.extend(soup.vertices[v]);
  }
  return box;
}

/// Find the parts inside the outer shell that have the opposite orientation.
std::vector<bool> FindCavities(const WeldedSoup& soup, const SurfaceParts& parts,
                               const std::vector<double>& volumes, std::size_t outside) {
  const Eigen::AlignedBox3d box = BoxOf(soup, parts.facets[outside]);
  std::vector<bool> is_cavity;
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    const Eigen::Vector3d& point = soup.vertices[soup.facets[parts.facets[p][0]][0]];
    constexpr double kHalf = 0.5;  // between 0 (outside) and ±1
    is_cavity.push_back(volumes[p] * volumes[outside] < 0 &&
                        box.contains(BoxOf(soup, parts.facets[p])) &&
                        std::abs(WindingNumber(soup, parts.facets[outside], point)) > kHalf);
  }
  return is_cavity;
}

}  // namespace

std::optional<LargestShell> FindLargestShell(const WeldedSoup& soup) {
  const SurfaceParts parts = FindParts(soup, SortedEdgeSides(soup.facets, soup.vertices.size()));
  if (std::ranges::find(parts.closed, false) != parts.closed.end()) return std::nullopt;
  std::vector<double> volumes;
  for (const auto& facets : parts.facets) volumes.push_back(VolumeOf(soup, facets));
  const auto size = [](double volume) { return std::abs(volume); };
  const auto largest = std::ranges::max_element(volumes, {}, size);
  if (largest == volumes.end()) return std::nullopt;
  const auto outside = static_cast<std::size_t>(largest - volumes.begin());
  const std::vector<bool> is_cavity = FindCavities(soup, parts, volumes, outside);
  LargestShell found{soup, ""};
  int left_out = 0;
  double volume = 0, all = 0;
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    if (is_cavity[p]) continue;
    all += size(volumes[p]);
    if (p == outside) continue;
    ++left_out;
    volume += size(volumes[p]);
    for (const int f : parts.facets[p]) found.soup.facets[f].clear();
  }
  if (left_out == 0) return std::nullopt;
  DropUnused(found.soup);
  found.text = "the largest of " + std::to_string(left_out + 1) + " closed shells is the object; " +
               std::to_string(left_out) + " with " + FormatShort(100 * volume / all, 3) +
               " % of their volume " + (left_out == 1 ? "is" : "are") + " left out";
  return found;
}

using Eigen::Vector3d;

namespace {

/// Call `visit` with the corners of each triangle of a fan triangulation of the polygons.
template <class Visit>
void ForEachFanTriangle(const WeldedSoup& soup, const std::vector<int>& facets,
                        const Visit& visit) {
  for (const int f : facets) {
    const std::vector<int>& corners = soup.facets[f];
    for (std::size_t k = 2; k < corners.size(); ++k) {
      visit(soup.vertices[corners[0]], soup.vertices[corners[k - 1]], soup.vertices[corners[k]]);
    }
  }
}

}  // namespace

SurfaceParts FindParts(const WeldedSoup& soup, const std::vector<EdgeSide>& sides) {
  boost::disjoint_sets_with_storage<> joined(soup.facets.size());
  ForEachEdge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() == 2) joined.union_set(edge[0].facet, edge[1].facet);
  });
  SurfaceParts parts{std::vector<int>(soup.facets.size(), -1), {}, {}};
  std::vector<int> number(soup.facets.size(), -1);  // part of each set
  for (int f = 0; f < std::ssize(soup.facets); ++f) {
    if (soup.facets[f].empty()) continue;
    int& part = number[joined.find_set(f)];
    if (part < 0) {
      part = static_cast<int>(parts.facets.size());
      parts.facets.emplace_back();
    }
    parts.of_facet[f] = part;
    parts.facets[part].push_back(f);
  }
  // A part is closed if its polygons have each edge equally often in both directions.
  parts.closed.assign(parts.facets.size(), true);
  std::map<int, int> balance;
  ForEachEdge(sides, [&](std::span<const EdgeSide> edge) {
    balance.clear();
    for (const EdgeSide& side : edge) balance[parts.of_facet[side.facet]] += side.forward ? 1 : -1;
    for (const auto& [part, sum] : balance) {
      if (sum != 0) parts.closed[part] = false;
    }
  });
  return parts;
}

double VolumeOf(const WeldedSoup& soup, const std::vector<int>& facets) {
  const Vector3d from = soup.vertices[soup.facets[facets[0]][0]];
  double volume = 0;
  ForEachFanTriangle(soup, facets, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    volume += (a - from).dot((b - from).cross(c - from)) / 6;
  });
  return volume;
}

double WindingNumber(const WeldedSoup& soup, const std::vector<int>& facets,
                     const Vector3d& point) {
  double half_angles = 0;
  ForEachFanTriangle(soup, facets, [&](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
    const Vector3d a = p - point, b = q - point, c = r - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angles +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  });
  return half_angles / (2 * std::numbers::pi);
}

}  // namespace regrasp::object
