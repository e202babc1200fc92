// Reads a 3MF file with lib3mf, prints its unit, 0 for a micrometre to 5 for a metre, and the number and
// the names of its objects, and writes what it holds as an STL file.
// usage: read_3mf FILE STL_FILE

#include <Model/COM/NMR_DLLInterfaces.h>

#include <iostream>

int main(int, char** argv) {
  using namespace NMR;
  PLib3MFModel* model;
  PLib3MFModelReader* reader;
  PLib3MFModelWriter* writer;
  PLib3MFModelResourceIterator* objects;
  DWORD unit = 0;
  BOOL next = 0;
  int n_objects = -1;
  const auto check = [](LIB3MFRESULT result, const char* what) {
    if (result == LIB3MF_OK) return;
    std::cerr << what << ": " << result << "\n";
    std::exit(1);
  };
  check(lib3mf_createmodel(&model), "model");
  check(lib3mf_model_queryreader(model, "3mf", &reader), "reader");
  check(lib3mf_reader_readfromfileutf8(reader, argv[1]), "read");
  DWORD n_warnings = 0;
  check(lib3mf_reader_getwarningcount(reader, &n_warnings), "warnings");
  check(lib3mf_model_getunit(model, &unit), "unit");
  check(lib3mf_model_getmeshobjects(model, &objects), "objects");
  do {
    ++n_objects;
    check(lib3mf_resourceiterator_movenext(objects, &next), "next");
    if (!next) break;
    PLib3MFModelResource* object;
    char name[100];
    ULONG length = 0;
    check(lib3mf_resourceiterator_getcurrent(objects, &object), "object");
    check(lib3mf_object_getnameutf8(object, name, sizeof name, &length), "name");
    std::cout << "object " << name << "\n";
  } while (next);
  check(lib3mf_model_querywriter(model, "stl", &writer), "writer");
  check(lib3mf_writer_writetofileutf8(writer, argv[2]), "write");
  std::cout << "unit " << unit << "\nobjects " << n_objects << "\nwarnings " << n_warnings << "\n";
}
