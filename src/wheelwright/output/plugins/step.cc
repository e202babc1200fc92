#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Writer.hxx>
#include <ShapeCustom.hxx>
#include <Standard_Failure.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <XSControl_WorkSession.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <sstream>
#include <stdexcept>

#include "wheelwright/output/export/plugin.h"

// Writes the solid as a STEP file (AP214) by OpenCASCADE: planes above and below, cylinders along circles and
// arcs, B-spline surfaces along splines.

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

/// Splits a long spline into several edges at its knots: the default quadrature by which programs compute
/// areas and volumes has too few points for an edge of many cubics.
std::vector<TopoDS_Edge> edges(const cad::Spline& spline) {
  constexpr int max_cubics = 4;
  const Handle(Geom_BSplineCurve) whole = whole_curve(spline);
  const int n_cubics = whole->NbKnots() - 1, parts = (n_cubics + max_cubics - 1) / max_cubics;
  std::vector<TopoDS_Edge> edges;
  for (int i = 0; i < parts; ++i) {
    const Handle(Geom_BSplineCurve) part = Handle(Geom_BSplineCurve)::DownCast(whole->Copy());
    part->Segment(whole->Knot(1 + i * n_cubics / parts), whole->Knot(1 + (i + 1) * n_cubics / parts));
    edges.push_back(BRepBuilderAPI_MakeEdge(part));
  }
  return edges;
}

std::vector<TopoDS_Edge> edges(const cad::Line& line) { return {edge(line)}; }
std::vector<TopoDS_Edge> edges(const cad::Arc& arc) { return {edge(arc)}; }

TopoDS_Wire wire(const cad::Loop& loop) {
  BRepBuilderAPI_MakeWire wire;
  for (const cad::Curve& curve : loop.curves)
    for (const TopoDS_Edge& part : std::visit([](const auto& c) { return edges(c); }, curve)) wire.Add(part);
  return wire.Wire();
}

TopoDS_Shape solid(const cad::Body& body, double width) {
  BRepBuilderAPI_MakeFace face(gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), wire(*body.edge));
  for (const cad::Loop* hole : body.holes) face.Add(wire(*hole));
  const TopoDS_Shape prism = BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, width * millimetres_per_metre));
  return ShapeCustom::ConvertToBSpline(prism, Standard_True, Standard_False, Standard_False);
}

TopoDS_Shape solids(const WheelModel& wheel) {
  const auto all = bodies(wheel.outline);
  if (all.size() == 1) return solid(all.front(), wheel.width);
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const cad::Body& body : all) builder.Add(compound, solid(body, wheel.width));
  return compound;
}

Handle(TCollection_HAsciiString) text(const std::string& t) {
  return new TCollection_HAsciiString(t.c_str());
}

/// The header contains no time or place, so that the same wheel gives the same bytes.
void set_header(const Handle(StepData_StepModel) & model, const WheelModel& wheel) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(text(wheel.title));
  header.SetTimeStamp(text("1970-01-01T00:00:00"));
  header.SetAuthorValue(1, text(""));
  header.SetOrganizationValue(1, text(""));
  header.SetOriginatingSystem(text(wheel.program));
  header.SetAuthorisation(text(""));
}

std::string file(const WheelModel& wheel) {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  const TopoDS_Shape shape = solids(wheel);
  if (!BRepCheck_Analyzer(shape).IsValid())
    throw std::runtime_error("OpenCASCADE did not produce a valid solid");
  STEPControl_Writer writer;
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetCVal("write.step.product.name", wheel.title.c_str());
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
    throw std::runtime_error("OpenCASCADE could not convert the solid to STEP");
  const Handle(StepData_StepModel) model = writer.Model();
  set_header(model, wheel);
  StepData_StepWriter step(model);
  step.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream stream;
  step.Print(stream);
  return stream.str();
}

}  // namespace
}  // namespace wheelwright

extern "C" __attribute__((visibility("default"))) void wheelwright_plugin_file(
    const wheelwright::WheelModel& wheel, std::string& bytes) {
  try {
    bytes += wheelwright::file(wheel);
  } catch (const Standard_Failure& failure) {
    throw std::runtime_error(std::string("OpenCASCADE: ") + failure.GetMessageString());
  }
}
