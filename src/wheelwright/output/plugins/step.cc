#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <sstream>
#include <stdexcept>

#include "wheelwright/output/export/plugin.h"
#include "wheelwright/output/plugins/step_solid.h"

// Writes the solid as a STEP file (AP214) by OpenCASCADE: planes above and below, cylinders along circles and
// arcs, B-spline surfaces along splines.

namespace wheelwright {
namespace {

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
  const TopoDS_Shape shape = solid_of(wheel);
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
