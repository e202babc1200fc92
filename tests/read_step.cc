// Reads a STEP file with OpenCASCADE and prints what it holds, of an assembly the name, validity, volume,
// number of solids and colour of each part, and for every point "x y z" of the standard input whether it lies
// in a solid. usage: read_step FILE

#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <iostream>
#include <map>

namespace {

int solids_in(const TopoDS_Shape& shape) {
  int solids = 0;
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next()) ++solids;
  return solids;
}

void print_bodies(const char* file) {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  STEPCAFControl_Reader reader;
  reader.SetNameMode(true);
  reader.SetColorMode(true);
  if (reader.ReadFile(file) != IFSelect_RetDone || !reader.Transfer(document)) return;
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  TDF_LabelSequence bodies;
  shapes->GetFreeShapes(bodies);
  for (const TDF_Label& label : bodies) {
    Handle(TDataStd_Name) name;
    label.FindAttribute(TDataStd_Name::GetID(), name);
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
    GProp_GProps volume;
    BRepGProp::VolumeProperties(shape, volume, 1e-9);
    Quantity_Color colour;
    const bool has_colour = colours->GetColor(label, XCAFDoc_ColorSurf, colour) ||
                            colours->GetColor(label, XCAFDoc_ColorGen, colour);
    std::cout << "body " << BRepCheck_Analyzer(shape).IsValid() << " " << volume.Mass() << " "
              << solids_in(shape) << " "
              << (has_colour ? Quantity_Color::ColorToHex(colour).ToCString() : "none") << " "
              << TCollection_AsciiString(name->Get()).ToCString() << "\n";
  }
}

}  // namespace

int main(int, char** argv) {
  STEPControl_Reader reader;
  std::streambuf* out = std::cout.rdbuf(nullptr);  // OpenCASCADE reports there
  const bool read = reader.ReadFile(argv[1]) == IFSelect_RetDone && reader.TransferRoots() > 0;
  std::cout.rdbuf(out);
  std::cout.clear();
  if (!read) return 1;
  const TopoDS_Shape shape = reader.OneShape();
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  GProp_GProps volume;
  BRepGProp::VolumeProperties(shape, volume, 1e-9);
  GProp_GProps usual;  // by the rule that programs use by default
  BRepGProp::VolumeProperties(shape, usual);
  std::map<std::string, int> faces;
  for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
    const auto kind = BRepAdaptor_Surface(TopoDS::Face(face.Current())).GetType();
    ++faces[kind == GeomAbs_Plane            ? "plane"
            : kind == GeomAbs_Cylinder       ? "cylinder"
            : kind == GeomAbs_BSplineSurface ? "b_spline"
                                             : "other"];
  }
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box);
  double low[3], high[3];
  box.Get(low[0], low[1], low[2], high[0], high[1], high[2]);
  std::cout.precision(15);
  std::cout << "unit " << lengths.First() << "\nvalid " << BRepCheck_Analyzer(shape).IsValid() << "\nsolids "
            << solids_in(shape) << "\nvolume " << volume.Mass() << "\nusual_volume " << usual.Mass() << "\n";
  for (const auto& [kind, n] : faces) std::cout << kind << " " << n << "\n";
  std::cout << "lower " << low[0] << " " << low[1] << " " << low[2] << "\nupper " << high[0] << " " << high[1]
            << " " << high[2] << "\n";
  print_bodies(argv[1]);
  BRepClass3d_SolidClassifier classifier(shape);
  for (double x, y, z; std::cin >> x >> y >> z;) {
    classifier.Perform(gp_Pnt(x, y, z), 1e-7);
    std::cout << (classifier.State() == TopAbs_IN ? "in" : "out") << "\n";
  }
}
