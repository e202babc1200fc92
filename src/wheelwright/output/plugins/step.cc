#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_ExtendedString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_WorkSession.hxx>
#include <sstream>
#include <stdexcept>

#include "wheelwright/output/export/plugin.h"
#include "wheelwright/output/plugins/step_solid.h"

// Writes the solid as a STEP file (AP214) by OpenCASCADE. An extruded one has planes above and below,
// cylinders along circles and arcs, B-spline surfaces along splines; one of revolution has cylinders, planes,
// cones, tori and surfaces of revolution. A wheel of several materials has one body per layer.

namespace wheelwright {
namespace {

Handle(TCollection_HAsciiString) text(const std::string& t) {
  return new TCollection_HAsciiString(t.c_str());
}

/// The header contains no time or place, so that the same wheel gives the same bytes.
template <class Model>
void set_header(const Handle(StepData_StepModel) & model, const Model& wheel) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(text(wheel.title));
  header.SetTimeStamp(text("1970-01-01T00:00:00"));
  header.SetAuthorValue(1, text(""));
  header.SetOrganizationValue(1, text(""));
  header.SetOriginatingSystem(text(wheel.program));
  header.SetAuthorisation(text(""));
}

template <class Model>
TopoDS_Shape valid_solid(const Model& wheel) {
  TopoDS_Shape shape = solid_of(wheel);
  if (!BRepCheck_Analyzer(shape).IsValid()) throw InvalidSolid("OpenCASCADE did not produce a valid solid");
  return shape;
}

void expect_done(bool is_done) {
  if (!is_done) throw std::runtime_error("OpenCASCADE could not convert the solid to STEP");
}

Quantity_Color colour(std::size_t layer) {
  const auto [red, green, blue] = layer_colour(layer);
  return {red / 255.0, green / 255.0, blue / 255.0, Quantity_TOC_sRGB};
}

/// Adds the layers one after the other, with their names and colours: OpenCASCADE would write the colours of
/// the parts of an assembly in the order of their addresses.
template <class Model>
void add_layers(const Model& wheel, STEPCAFControl_Writer& writer) {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  for (std::size_t k = 0; k < wheel.layers.size(); ++k) {
    const auto& layer = wheel.layers[k];
    const TDF_Label body = shapes->AddShape(valid_solid(layer_model(wheel, layer)), Standard_False);
    TDataStd_Name::Set(body, TCollection_ExtendedString(layer.name.c_str(), Standard_True));
    colours->SetColor(body, colour(k), XCAFDoc_ColorSurf);
    expect_done(writer.Transfer(body, STEPControl_AsIs));
  }
}

/// What a writer has converted, as text.
template <class Model>
std::string text_of(STEPControl_Writer& writer, const Model& wheel) {
  const Handle(StepData_StepModel) model = writer.Model();
  set_header(model, wheel);
  StepData_StepWriter step(model);
  step.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream stream;
  step.Print(stream);
  return stream.str();
}

template <class Model>
std::string file(const Model& wheel) {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  STEPCAFControl_Writer of_layers;
  STEPControl_Writer& writer = of_layers.ChangeWriter();
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetCVal("write.step.product.name", wheel.title.c_str());
  if (wheel.layers.empty())
    expect_done(writer.Transfer(valid_solid(wheel), STEPControl_AsIs) == IFSelect_RetDone);
  else
    add_layers(wheel, of_layers);
  return text_of(writer, wheel);
}

}  // namespace
}  // namespace wheelwright

extern "C" __attribute__((visibility("default"))) void wheelwright_plugin_file(
    const wheelwright::StepModel& model, std::string& bytes) {
  try {
    bytes += std::visit([](const auto* wheel) { return wheelwright::file(*wheel); }, model);
  } catch (const Standard_Failure& failure) {
    throw std::runtime_error(std::string("OpenCASCADE: ") + failure.GetMessageString());
  }
}
