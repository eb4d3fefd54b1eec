// Write a smooth solid as OBJ files into a given folder. There is one solid per run, because CGAL's
// mesher keeps state from one surface to the next.

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>

#include "bodies.h"
#include "remesh.h"

namespace regrasp_meshes {
namespace {

constexpr std::size_t kTriangles[] = {500, 1000};

/// Format a length in metres with nine decimals. The result is the same on machines with different
/// last bits.
std::string Number(double x) {
  constexpr double kUnit = 1e-9;
  char text[32];
  // Adding zero turns -0 into 0.
  std::snprintf(text, sizeof text, "%.9f", std::round(x / kUnit) * kUnit + 0.0);
  return text;
}

void Write(const std::string& path, const Body& body, const Mesh& mesh) {
  std::ofstream file(path);
  file << "# " << body.description << " Written by scripts/make-meshes.\n";
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    file << "v " << Number(p.x()) << ' ' << Number(p.y()) << ' ' << Number(p.z()) << '\n';
  }
  for (const auto f : mesh.faces()) {
    file << 'f';
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) file << ' ' << v.idx() + 1;
    file << '\n';
  }
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

void MakeBody(const Body& body, const std::string& folder) {
  const Mesh fine = FineMesh(body);
  for (const std::size_t triangles : kTriangles) {
    const Mesh mesh = CoarseMesh(fine, body.field, triangles);
    const std::string path = folder + "/" + body.name + std::to_string(triangles) + ".obj";
    Write(path, body, mesh);
    std::cout << path << ": smallest angle " << SmallestAngle(mesh) * 180 / std::numbers::pi
              << " degrees\n";
  }
}

Body FindBody(const std::string& name) {
  for (const Body& body : AllBodies()) {
    if (body.name == name) return body;
  }
  throw std::runtime_error(name + ": no such body");
}

}  // namespace
}  // namespace regrasp_meshes

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: make_meshes FOLDER BODY\n";
    return 2;
  }
  try {
    regrasp_meshes::MakeBody(regrasp_meshes::FindBody(argv[2]), argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "make_meshes: " << error.what() << '\n';
    return 1;
  }
}
