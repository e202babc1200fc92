#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <gp.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <numbers>

#include "wheelwright/output/export/plugin.h"
#include "wheelwright/output/plugins/step_solid.h"

namespace wheelwright {
namespace {

using cad::LoftedSolid;
using cad::SplineSurface;

constexpr double sewing_tolerance = 1e-4;  // [mm]

/// The whole surface, with U around the hole.
Handle(Geom_BSplineSurface) whole_surface(const SplineSurface& surface) {
  constexpr int degree = 3;
  const int columns = surface.columns, rows = surface.rows, per_column = surface.poles_per_column();
  TColgp_Array2OfPnt poles(1, columns, 1, per_column);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < per_column; ++j) {
      const Vec<3> x = millimetres_per_metre * surface.pole(i - 1, j);
      poles.SetValue(i + 1, j + 1, gp_Pnt(x[0], x[1], x[2]));
    }
  TColStd_Array1OfReal around(1, columns + 1), along(1, rows + 1);
  TColStd_Array1OfInteger once(1, columns + 1), multiplicities(1, rows + 1);
  for (int i = 0; i <= columns; ++i) {
    around.SetValue(i + 1, i);
    once.SetValue(i + 1, 1);
  }
  for (int j = 0; j <= rows; ++j) {
    along.SetValue(j + 1, j);
    multiplicities.SetValue(j + 1, j == 0 || j == rows ? degree + 1 : 1);
  }
  return new Geom_BSplineSurface(poles, around, along, once, multiplicities, degree, degree, true, false);
}

/// Quarters of the surface around the hole.
std::vector<Handle(Geom_BSplineSurface)> quarters(const SplineSurface& surface) {
  constexpr int parts = LoftedSolid::faces_per_hole;
  std::vector<Handle(Geom_BSplineSurface)> result;
  for (int k = 0; k < parts; ++k) {
    const auto quarter = Handle(Geom_BSplineSurface)::DownCast(whole_surface(surface)->Copy());
    quarter->Segment(double(surface.columns) * k / parts, double(surface.columns) * (k + 1) / parts, 0,
                     surface.rows);
    result.push_back(quarter);
  }
  return result;
}

TopoDS_Wire circle(double radius, double z, bool is_counter_clockwise) {
  const gp_Circ circle(gp_Ax2(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)), radius);
  const TopoDS_Wire wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle)).Wire();
  return is_counter_clockwise ? wire : TopoDS::Wire(wire.Reversed());
}

/// Where the surfaces of a hole end.
TopoDS_Wire edge(const std::vector<Handle(Geom_BSplineSurface)>& hole, const LoftedSolid::Edge& edge) {
  BRepBuilderAPI_MakeWire wire;
  for (const auto& quarter : hole) {
    double u_first, u_last, v_first, v_last;
    quarter->Bounds(u_first, u_last, v_first, v_last);
    wire.Add(BRepBuilderAPI_MakeEdge(quarter->VIso(edge.is_last ? v_last : v_first)).Edge());
  }
  return edge.is_counter_clockwise ? wire.Wire() : TopoDS::Wire(wire.Wire().Reversed());
}

TopoDS_Face cylinder(double radius, double width) {
  return BRepBuilderAPI_MakeFace(new Geom_CylindricalSurface(gp_Ax3(), radius), 0, 2 * std::numbers::pi, 0,
                                 width, sewing_tolerance);
}

}  // namespace

TopoDS_Shape solid_of(const LoftedSolid& solid) {
  const double width = solid.width * millimetres_per_metre;
  const double inner_radius = solid.inner_radius * millimetres_per_metre,
               outer_radius = solid.outer_radius * millimetres_per_metre;
  BRepBuilderAPI_Sewing sewing(sewing_tolerance);
  sewing.Add(cylinder(outer_radius, width));
  sewing.Add(cylinder(inner_radius, width));
  std::vector<std::vector<Handle(Geom_BSplineSurface)>> holes;
  for (const auto& hole : solid.holes)
    for (const auto& quarter : holes.emplace_back(quarters(hole.surface)))
      sewing.Add(BRepBuilderAPI_MakeFace(quarter, sewing_tolerance).Face());
  for (const auto& side : solid.side_faces) {
    const gp_Pln plane(gp_Pnt(0, 0, side.is_last ? width : 0), gp_Dir(0, 0, side.is_last ? 1 : -1));
    std::vector<TopoDS_Wire> wires;
    if (side.ends_at_tread) wires.push_back(circle(outer_radius, plane.Location().Z(), side.is_last));
    if (side.ends_at_rim) wires.push_back(circle(inner_radius, plane.Location().Z(), !side.is_last));
    for (const auto& of_hole : side.edges) wires.push_back(edge(holes[of_hole.hole], of_hole));
    BRepBuilderAPI_MakeFace face(plane, wires.front(), false);
    for (std::size_t k = 1; k < wires.size(); ++k) face.Add(wires[k]);
    sewing.Add(face.Face());
  }
  sewing.Perform();
  if (sewing.NbFreeEdges() != 0) throw InvalidSolid("lofted faces do not close");
  const TopExp_Explorer shell(sewing.SewedShape(), TopAbs_SHELL);
  if (!shell.More()) throw InvalidSolid("lofted faces do not make a shell");
  TopoDS_Solid result;
  BRep_Builder builder;
  builder.MakeSolid(result);
  builder.Add(result, shell.Current());
  BRepLib::OrientClosedSolid(result);
  return result;
}

}  // namespace wheelwright
