#include "wheelwright/cad/outline/triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <deque>
#include <unordered_map>

namespace wheelwright::cad {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// Vertices know their number.
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_predicates_tag>;

Delaunay delaunay(std::span<const Polygon> polygons) {
  Delaunay result;
  int number = 0;
  for (const Polygon& polygon : polygons) {
    std::vector<Delaunay::Vertex_handle> corners;
    for (const Vec<2>& p : polygon) {
      corners.push_back(result.insert({p[0], p[1]}, corners.empty() ? nullptr : corners.back()->face()));
      corners.back()->info() = number++;
    }
    for (std::size_t i = 0; i < corners.size(); ++i)
      result.insert_constraint(corners[i], corners[(i + 1) % corners.size()]);
  }
  return result;
}

int n_sides_at(const Delaunay& triangulation, Delaunay::Vertex_handle vertex) {
  int n = 0;
  auto edge = triangulation.incident_edges(vertex);
  const auto first = edge;
  do n += triangulation.is_constrained(*edge);
  while (++edge != first);
  return n;
}

/// For every face whether an odd number of polygons encloses it.
std::unordered_map<Delaunay::Face_handle, bool> inside(const Delaunay& triangulation) {
  std::unordered_map<Delaunay::Face_handle, bool> inside{{triangulation.infinite_face(), false}};
  std::deque<Delaunay::Face_handle> open{triangulation.infinite_face()};
  while (!open.empty()) {
    const auto face = open.front();
    open.pop_front();
    for (int i = 0; i < 3; ++i) {
      const auto [place, is_new] =
          inside.try_emplace(face->neighbor(i), inside.at(face) != face->is_constrained(i));
      if (is_new) open.push_back(place->first);
    }
  }
  return inside;
}

}  // namespace

std::vector<Vec<2>> crossings(std::span<const Polygon> polygons) {
  const Delaunay triangulation = delaunay(polygons);
  std::vector<Vec<2>> result;
  for (auto vertex = triangulation.finite_vertices_begin(); vertex != triangulation.finite_vertices_end();
       ++vertex)
    if (n_sides_at(triangulation, vertex) != 2) result.push_back({vertex->point().x(), vertex->point().y()});
  return result;
}

Triangulation triangulated(std::span<const Polygon> polygons) {
  const Delaunay triangulation = delaunay(polygons);
  Triangulation result;
  for (const Polygon& polygon : polygons)
    result.points.insert(result.points.end(), polygon.begin(), polygon.end());
  const auto is_inside = inside(triangulation);
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face)
    if (is_inside.at(face))
      result.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return result;
}

}  // namespace wheelwright::cad
