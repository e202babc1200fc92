#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <cmath>
#include <gp.hxx>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "wheelwright/output/plugins/step_solid.h"

namespace wheelwright {
namespace {

constexpr double vertex_tolerance = 1e-7;  // [mm]

/// The cylinder of rim or tread, with the circles at both ends.
struct Cylinder {
  TopoDS_Face face;
  std::array<TopoDS_Edge, 2> circles;  ///< at z = 0 and at the width, counter-clockwise about the axle
};

Cylinder cylinder(double radius, double width) {
  const Handle(Geom_CylindricalSurface) surface = new Geom_CylindricalSurface(gp_Ax3(), radius);
  Cylinder result{
      BRepBuilderAPI_MakeFace(surface, 0, 2 * std::numbers::pi, 0, width, vertex_tolerance).Face(), {}};
  for (TopExp_Explorer edges(result.face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current().Oriented(TopAbs_FORWARD));
    const TopoDS_Vertex first = TopExp::FirstVertex(edge), last = TopExp::LastVertex(edge);
    if (first.IsSame(last)) result.circles[BRep_Tool::Pnt(first).Z() > 0.5 * width] = edge;
  }
  return result;
}

/// Builds the faces of a solid, which share their edges.
class Facets {
 public:
  explicit Facets(const FacetedSolid& solid) : solid_(solid), shells_(solid.n_shells) {
    for (TopoDS_Shell& shell : shells_) builder_.MakeShell(shell);
    for (const Vec<3>& x : solid.points) {
      points_.emplace_back(x[0] * millimetres_per_metre, x[1] * millimetres_per_metre,
                           x[2] * millimetres_per_metre);
      vertices_.emplace_back();
    }
    add_cylinders();
    for (const auto& face : solid.side_faces) add(face);
    for (const auto& triangle : solid.triangles) add(triangle);
  }

  std::vector<TopoDS_Shell> shells() {
    for (TopoDS_Shell& shell : shells_) shell.Closed(true);
    return shells_;
  }

 private:
  double width() const { return solid_.width * millimetres_per_metre; }

  void add_cylinders() {
    if (solid_.has_tread_cylinder) {
      tread_ = cylinder(solid_.outer_radius * millimetres_per_metre, width());
      builder_.Add(shells_[solid_.shell_of_tread], tread_->face);
    }
    if (solid_.has_rim_cylinder) {
      rim_ = cylinder(solid_.inner_radius * millimetres_per_metre, width());
      builder_.Add(shells_[solid_.shell_of_rim], rim_->face.Reversed());
    }
  }

  const TopoDS_Vertex& vertex(int point) {
    if (vertices_[point].IsNull()) builder_.MakeVertex(vertices_[point], points_[point], vertex_tolerance);
    return vertices_[point];
  }

  TopoDS_Edge edge(int from, int to) {
    TopoDS_Edge& shared = edges_[std::minmax(from, to)];
    if (shared.IsNull())
      shared = BRepBuilderAPI_MakeEdge(vertex(std::min(from, to)), vertex(std::max(from, to)));
    return TopoDS::Edge(shared.Oriented(from < to ? TopAbs_FORWARD : TopAbs_REVERSED));
  }

  template <class Corners>
  TopoDS_Wire polygon(const Corners& corners) {
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (std::size_t k = 0; k < corners.size(); ++k)
      builder_.Add(wire, edge(corners[k], corners[(k + 1) % corners.size()]));
    wire.Closed(true);
    return wire;
  }

  TopoDS_Wire circle(const Cylinder& of, bool is_last, bool is_counter_clockwise) {
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    builder_.Add(wire, of.circles[is_last].Oriented(is_counter_clockwise ? TopAbs_FORWARD : TopAbs_REVERSED));
    wire.Closed(true);
    return wire;
  }

  /// A face without edges as yet.
  TopoDS_Face plane(const gp_Ax3& axes) {
    TopoDS_Face face;
    builder_.MakeFace(face, new Geom_Plane(axes), vertex_tolerance);
    return face;
  }

  void add(const FacetedSolid::SideFace& side) {
    const gp_Pnt origin(0, 0, side.is_last ? width() : 0);
    TopoDS_Face face = plane(gp_Ax3(origin, gp_Dir(0, 0, side.is_last ? 1 : -1)));
    // Wires have the material on the left as seen from outside.
    if (side.ends_at_tread) builder_.Add(face, circle(*tread_, side.is_last, side.is_last));
    if (side.ends_at_rim) builder_.Add(face, circle(*rim_, side.is_last, !side.is_last));
    for (const auto& loop : side.polygons) builder_.Add(face, polygon(loop));
    builder_.Add(shells_[side.shell], face);
  }

  void add(const FacetedSolid::Triangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    const gp_Vec along(points_[a], points_[b]), other(points_[a], points_[c]);
    TopoDS_Face face = plane(gp_Ax3(points_[a], along ^ other, along));
    builder_.Add(face, polygon(triangle.corners));
    builder_.Add(shells_[triangle.shell], face);
  }

  const FacetedSolid& solid_;
  BRep_Builder builder_;
  std::vector<TopoDS_Shell> shells_;
  std::vector<gp_Pnt> points_;
  std::vector<TopoDS_Vertex> vertices_;
  std::map<std::pair<int, int>, TopoDS_Edge> edges_;
  std::optional<Cylinder> rim_, tread_;
};

double enclosed(const TopoDS_Shell& shell) {
  GProp_GProps volume;
  BRepGProp::VolumeProperties(shell, volume);
  return volume.Mass();
}

gp_Pnt some_point(const TopoDS_Shell& shell) {
  return BRep_Tool::Pnt(TopoDS::Vertex(TopExp_Explorer(shell, TopAbs_VERTEX).Current()));
}

}  // namespace

TopoDS_Shape solid_of(const FacetedSolid& solid) {
  BRep_Builder builder;
  std::vector<TopoDS_Solid> bodies;
  std::vector<TopoDS_Shell> cavities;
  for (const TopoDS_Shell& shell : Facets(solid).shells()) {
    if (enclosed(shell) < 0) {
      cavities.push_back(shell);
      continue;
    }
    builder.MakeSolid(bodies.emplace_back());
    builder.Add(bodies.back(), shell);
  }
  for (const TopoDS_Shell& cavity : cavities) {
    const auto around = std::ranges::find_if(bodies, [&](const TopoDS_Solid& body) {
      return bodies.size() == 1 ||
             BRepClass3d_SolidClassifier(body, some_point(cavity), vertex_tolerance).State() == TopAbs_IN;
    });
    if (around == bodies.end()) throw std::runtime_error("a cavity lies in no body");
    builder.Add(*around, cavity);
  }
  if (bodies.size() == 1) return bodies.front();
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (const TopoDS_Solid& body : bodies) builder.Add(compound, body);
  return compound;
}

}  // namespace wheelwright
