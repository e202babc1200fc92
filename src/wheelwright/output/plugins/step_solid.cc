#include "wheelwright/output/plugins/step_solid.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTools_Modification.hxx>
#include <BRepTools_Modifier.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <ShapeCustom.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <functional>
#include <gp.hxx>
#include <gp_Ax2d.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include "wheelwright/cad/outline/spline_parts.h"

namespace wheelwright {
namespace {

gp_Pnt point(const Vec<2>& p) { return {p[0] * millimetres_per_metre, p[1] * millimetres_per_metre, 0}; }

TopoDS_Edge edge(const cad::Line& line) {
  return BRepBuilderAPI_MakeEdge(point(line.start), point(line.end));
}

/// The circle's axis points down for an arc that runs clockwise.
TopoDS_Edge edge(const cad::Arc& arc) {
  const bool clockwise = arc.sweep < 0;
  const gp_Ax2 axes(point(arc.centre), gp_Dir(0, 0, clockwise ? -1 : 1),
                    gp_Dir(std::cos(arc.begin), std::sin(arc.begin), 0));
  const gp_Circ circle(axes, arc.radius * millimetres_per_metre);
  if (is_circle(arc)) return BRepBuilderAPI_MakeEdge(circle);
  return BRepBuilderAPI_MakeEdge(circle, 0, std::abs(arc.sweep));
}

Handle(Geom_BSplineCurve) whole_curve(const cad::Spline& spline) {
  constexpr int degree = 3, clamped = degree + 1;
  const int n_points = static_cast<int>(spline.points.size()), n_knots = n_points - degree + 1;
  TColgp_Array1OfPnt poles(1, n_points);
  for (int i = 0; i < n_points; ++i) poles.SetValue(i + 1, point(spline.points[i]));
  TColStd_Array1OfReal knots(1, n_knots);
  TColStd_Array1OfInteger multiplicities(1, n_knots);
  for (int i = 0; i < n_knots; ++i) {
    knots.SetValue(i + 1, spline.knots[i + degree]);
    multiplicities.SetValue(i + 1, i == 0 || i == n_knots - 1 ? clamped : 1);
  }
  return new Geom_BSplineCurve(poles, knots, multiplicities, degree);
}

/// Divides a spline between its cubics: the numbers of cubics before the first part and after each part.
using Division = std::function<std::vector<int>(const cad::Spline&)>;

std::vector<TopoDS_Edge> edges(const cad::Spline& spline, const Division& division) {
  const Handle(Geom_BSplineCurve) whole = whole_curve(spline);
  const auto ends = division(spline);
  std::vector<TopoDS_Edge> edges;
  for (size_t i = 1; i < ends.size(); ++i) {
    const Handle(Geom_BSplineCurve) part = Handle(Geom_BSplineCurve)::DownCast(whole->Copy());
    part->Segment(whole->Knot(1 + ends[i - 1]), whole->Knot(1 + ends[i]));
    edges.push_back(BRepBuilderAPI_MakeEdge(part));
  }
  return edges;
}

std::vector<TopoDS_Edge> edges(const cad::Line& line, const Division&) { return {edge(line)}; }
std::vector<TopoDS_Edge> edges(const cad::Arc& arc, const Division&) { return {edge(arc)}; }

/// A loop, with one edge for every part of its splines.
TopoDS_Wire wire(const cad::Loop& loop, const Division& division) {
  BRepBuilderAPI_MakeWire wire;
  for (const cad::Curve& curve : loop.curves)
    for (const TopoDS_Edge& part : std::visit([&](const auto& c) { return edges(c, division); }, curve))
      wire.Add(part);
  return wire.Wire();
}

/// As few parts as the usual rule integrates to within a tolerance [m].
Division few_parts(double tolerance) {
  return [tolerance](const cad::Spline& spline) { return cad::spline_parts(spline, tolerance); };
}

/// Parts of four cubics: by the usual rule, OpenCASCADE integrates over a surface of revolution with a fixed
/// number of points, which suffice for these.
std::vector<int> short_parts(const cad::Spline& spline) {
  constexpr int cubics = 4;
  const int n = static_cast<int>(spline.points.size()) - cad::Spline::degree;
  std::vector<int> ends;
  for (int i = 0; i < n; i += cubics) ends.push_back(i);
  ends.push_back(n);
  return ends;
}

/// Exchanges the parameters of B-spline surfaces, so that their curves run along V: along U, OpenCASCADE
/// integrates over a face with as many points as its straight direction needs, which is eight.
class CurvesAlongV : public BRepTools_Modification {
 public:
  Standard_Boolean NewSurface(const TopoDS_Face& face, Handle(Geom_Surface) & surface,
                              TopLoc_Location& location, Standard_Real& tolerance,
                              Standard_Boolean& reverses_wires, Standard_Boolean& reverses_face) override {
    const auto spline = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face, location));
    if (spline.IsNull()) return false;
    const auto exchanged = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
    exchanged->ExchangeUV();
    surface = exchanged;
    tolerance = BRep_Tool::Tolerance(face);
    reverses_wires = reverses_face = true;
    return true;
  }

  Standard_Boolean NewCurve2d(const TopoDS_Edge& edge, const TopoDS_Face& face, const TopoDS_Edge&,
                              const TopoDS_Face&, Handle(Geom2d_Curve) & curve,
                              Standard_Real& tolerance) override {
    TopLoc_Location location;
    if (Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face, location)).IsNull()) return false;
    double first, last;
    curve = Handle(Geom2d_Curve)::DownCast(BRep_Tool::CurveOnSurface(edge, face, first, last)->Copy());
    curve->Mirror(gp_Ax2d(gp_Pnt2d(0, 0), gp_Dir2d(1, 1)));
    tolerance = BRep_Tool::Tolerance(edge);
    return true;
  }

  Standard_Boolean NewCurve(const TopoDS_Edge&, Handle(Geom_Curve) &, TopLoc_Location&,
                            Standard_Real&) override {
    return false;
  }
  Standard_Boolean NewPoint(const TopoDS_Vertex&, gp_Pnt&, Standard_Real&) override { return false; }
  Standard_Boolean NewParameter(const TopoDS_Vertex&, const TopoDS_Edge&, Standard_Real&,
                                Standard_Real&) override {
    return false;
  }
  GeomAbs_Shape Continuity(const TopoDS_Edge& edge, const TopoDS_Face& one, const TopoDS_Face& other,
                           const TopoDS_Edge&, const TopoDS_Face&, const TopoDS_Face&) override {
    return BRep_Tool::Continuity(edge, one, other);
  }
};

TopoDS_Shape solid(const cad::Body& body, const WheelModel& wheel) {
  const Division division = few_parts(0.5 * wheel.tolerance);
  BRepBuilderAPI_MakeFace face(gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), wire(*body.edge, division));
  for (const cad::Loop* hole : body.holes) face.Add(wire(*hole, division));
  const TopoDS_Shape prism =
      BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, wheel.width * millimetres_per_metre));
  const TopoDS_Shape splines =
      ShapeCustom::ConvertToBSpline(prism, Standard_True, Standard_False, Standard_False);
  return BRepTools_Modifier(splines, new CurvesAlongV).ModifiedShape(splines);
}

/// From the plane of a profile, where x is axial and y the radius, to the half-plane of azimuth 0.
gp_Trsf to_half_plane() {
  gp_Trsf turn;
  turn.SetDisplacement(gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)),
                       gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 1, 0), gp_Dir(0, 0, 1)));
  return turn;
}

/// The closed shell that a loop of a profile describes about the axle, with its outer side outside.
TopoDS_Shell turned_shell(const cad::Loop& loop) {
  const BRepBuilderAPI_MakeFace face(gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), wire(loop, short_parts));
  const TopoDS_Shape placed = BRepBuilderAPI_Transform(face.Face(), to_half_plane(), Standard_True).Shape();
  TopoDS_Solid solid =
      TopoDS::Solid(TopExp_Explorer(BRepPrimAPI_MakeRevol(placed, gp::OZ()).Shape(), TopAbs_SOLID).Current());
  BRepLib::OrientClosedSolid(solid);
  return TopoDS::Shell(TopExp_Explorer(solid, TopAbs_SHELL).Current());
}

TopoDS_Shape solid(const cad::Body& body, const TurnedModel&) {
  TopoDS_Solid result;
  BRep_Builder builder;
  builder.MakeSolid(result);
  builder.Add(result, turned_shell(*body.edge));
  for (const cad::Loop* cavity : body.holes) builder.Add(result, turned_shell(*cavity).Reversed());
  return result;
}

template <class Model>
TopoDS_Shape solids(const Model& wheel) {
  const auto all = bodies(wheel.outline);
  if (all.size() == 1) return solid(all.front(), wheel);
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const cad::Body& body : all) builder.Add(compound, solid(body, wheel));
  return compound;
}

}  // namespace

TopoDS_Shape solid_of(const WheelModel& wheel) { return solids(wheel); }
TopoDS_Shape solid_of(const TurnedModel& wheel) { return solids(wheel); }

TopoDS_Shape solid_of(const FacesModel& wheel) {
  return std::visit([](const auto& solid) { return solid_of(solid); }, wheel.solid);
}

}  // namespace wheelwright
