#include "small_objects.h"

namespace regrasp {

const object::Polyhedron& SmallSolid() {
  // Never destroyed, so that nothing runs after the end of main.
  static const object::Polyhedron* const cube = new object::Polyhedron(object::Polyhedron::FromSoup(
      {{{-1, -1, -1},
        {1, -1, -1},
        {1, 1, -1},
        {-1, 1, -1},
        {-1, -1, 1},
        {1, -1, 1},
        {1, 1, 1},
        {-1, 1, 1}},
       {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
      "cube"));
  return *cube;
}

const object::Polygon& SmallPolygon() {
  static const object::Polygon* const square = new object::Polygon(
      object::Polygon::FromRings({{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, "square"));
  return *square;
}

}  // namespace regrasp
