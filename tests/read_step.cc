// Reads a STEP file with OpenCASCADE and prints what it holds, and for every point "x y z" of the standard
// input whether it lies in a solid. usage: read_step FILE

#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <iostream>
#include <map>

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
  int solids = 0;
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next()) ++solids;
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box);
  double low[3], high[3];
  box.Get(low[0], low[1], low[2], high[0], high[1], high[2]);
  std::cout.precision(15);
  std::cout << "unit " << lengths.First() << "\nvalid " << BRepCheck_Analyzer(shape).IsValid() << "\nsolids "
            << solids << "\nvolume " << volume.Mass() << "\nusual_volume " << usual.Mass() << "\n";
  for (const auto& [kind, n] : faces) std::cout << kind << " " << n << "\n";
  std::cout << "lower " << low[0] << " " << low[1] << " " << low[2] << "\nupper " << high[0] << " " << high[1]
            << " " << high[2] << "\n";
  BRepClass3d_SolidClassifier classifier(shape);
  for (double x, y, z; std::cin >> x >> y >> z;) {
    classifier.Perform(gp_Pnt(x, y, z), 1e-7);
    std::cout << (classifier.State() == TopAbs_IN ? "in" : "out") << "\n";
  }
}
