#include "planner/tree/subpath.h"

#include <algorithm>
#include <cmath>

namespace regrasp::tree {

namespace {

/// Contacts are drawn as far away as half the diameter, or so many halvings less.
constexpr int kHalvings = 5;

/// Draws for each contact that is still missing.
constexpr int kDraws = 8;

void AddContact(int contact, std::vector<int>& contacts) {
  if (std::find(contacts.begin(), contacts.end(), contact) == contacts.end()) {
    contacts.push_back(contact);
  }
}

void AddContacts(const criteria::ContactSet& set, std::vector<int>& contacts) {
  for (const int contact : set) AddContact(contact, contacts);
}

}  // namespace

const criteria::ContactSet& GraspNumber(const GraspPath& path, int number) {
  return number == 0 ? path.start : path.steps[number - 1].to;
}

Subpath SubpathBetween(const GraspPath& path, int begin, int end) {
  Subpath subpath{begin, end, {}};
  for (int number = begin; number <= end; ++number) {
    AddContacts(GraspNumber(path, number), subpath.contacts);
  }
  return subpath;
}

Subpath LongestSubpath(const GraspPath& path, int begin) {
  Subpath subpath{begin, begin, {}};
  for (int end = begin; end <= static_cast<int>(path.steps.size()); ++end) {
    std::vector<int> contacts = subpath.contacts;
    AddContacts(GraspNumber(path, end), contacts);
    if (static_cast<int>(contacts.size()) > kSubpathContacts) break;
    subpath.contacts = std::move(contacts);
    subpath.end = end;
  }
  return subpath;
}

GraspPath PartOf(const GraspPath& path, const Subpath& subpath) {
  const auto first = path.steps.begin();
  return {GraspNumber(path, subpath.begin), {first + subpath.begin, first + subpath.end}};
}

void FillUp(Subpath& subpath, int most, const sampling::SurfaceSampler& source,
            RandomStream& random, SearchSpace& space) {
  while (static_cast<int>(subpath.contacts.size()) < most && space.has_capacity()) {
    AddContact(space.Add(source.Draw(random)), subpath.contacts);
  }
}

void FillAround(Subpath& subpath, int most, const sampling::SurfaceSampler& source,
                RandomStream& random, SearchSpace& space) {
  const auto own = static_cast<int>(subpath.contacts.size());
  for (int draw = 0; draw < kDraws * (most - own); ++draw) {
    if (static_cast<int>(subpath.contacts.size()) == most || !space.has_capacity()) return;
    const grasp::Contact& near = space.contact(subpath.contacts[random.Index(own)]);
    const int halvings = static_cast<int>(random.Index(kHalvings + 1));
    const double reach = space.object().diameter() * std::ldexp(0.5, -halvings);
    const grasp::Contact contact = source.DrawAround(near, reach, random);
    if (source.IsValid(contact)) AddContact(space.Add(contact), subpath.contacts);
  }
}

void ReplaceSubpath(const GraspPath& by, const Subpath& subpath, GraspPath& path) {
  const auto first = path.steps.begin();
  const auto place = path.steps.erase(first + subpath.begin, first + subpath.end);
  path.steps.insert(place, by.steps.begin(), by.steps.end());
}

}  // namespace regrasp::tree
