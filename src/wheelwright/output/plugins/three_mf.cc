#include <Model/COM/NMR_DLLInterfaces.h>
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "wheelwright/files/checksum.h"
#include "wheelwright/output/export/plugin.h"

// Writes the bodies of a solid as a 3MF file by lib3mf: one named mesh each, in millimetres.

namespace wheelwright {
namespace {

void check(LIB3MFRESULT result) {
  if (result != LIB3MF_OK)
    throw std::runtime_error("lib3mf refused the solid, error " + std::to_string(result));
}

struct Release {
  void operator()(NMR::PLib3MFBase* object) const { NMR::lib3mf_release(object); }
};
template <class Object>
using Owned = std::unique_ptr<Object, Release>;

/// The object that one of the library's functions creates in its last argument.
template <class Object, class Make>
Owned<Object> made(const Make& make) {
  Object* object = nullptr;
  check(make(&object));
  return Owned<Object>(object);
}

/// A UUID that depends on the solid and the named object, so that the same wheel gives the same bytes.
std::string uuid(const SolidMesh& mesh, std::string_view role) {
  std::uint32_t words[4];
  std::uint32_t last = checksum(role);
  for (std::uint32_t& word : words) {
    last = checksum(
        {reinterpret_cast<const char*>(mesh.points.data()), mesh.points.size() * sizeof mesh.points[0]},
        last);
    word = last;
  }
  return fmt::format("{:08x}-{:04x}-4{:03x}-8{:03x}-{:04x}{:08x}", words[0], words[1] >> 16, words[1] & 0xfff,
                     words[2] >> 20, words[2] & 0xffff, words[3]);
}

/// Adds a body to a model. `role` distinguishes its UUIDs from those of other bodies.
void add(const SolidBody& body, const std::string& role, NMR::PLib3MFModel* model) {
  using namespace NMR;
  const SolidMesh& mesh = body.mesh;
  std::vector<MODELMESHVERTEX> vertices;
  for (const auto& p : mesh.points) vertices.push_back({{p[0], p[1], p[2]}});
  std::vector<MODELMESHTRIANGLE> triangles;
  for (const auto& t : mesh.triangles)
    triangles.push_back({{static_cast<DWORD>(t[0]), static_cast<DWORD>(t[1]), static_cast<DWORD>(t[2])}});
  const auto object =
      made<PLib3MFModelMeshObject>([&](auto o) { return lib3mf_model_addmeshobject(model, o); });
  check(lib3mf_object_setnameutf8(object.get(), body.name.c_str()));
  check(lib3mf_object_setuuidutf8(object.get(), uuid(mesh, "object" + role).c_str()));
  check(lib3mf_meshobject_setgeometry(object.get(), vertices.data(), static_cast<DWORD>(vertices.size()),
                                      triangles.data(), static_cast<DWORD>(triangles.size())));
  const auto item = made<PLib3MFModelBuildItem>(
      [&](auto i) { return lib3mf_model_addbuilditem(model, object.get(), nullptr, i); });
  check(lib3mf_builditem_setuuidutf8(item.get(), uuid(mesh, "item" + role).c_str()));
}

std::string file(const SolidModel& solid) {
  using namespace NMR;
  const auto model = made<PLib3MFModel>([](auto m) { return lib3mf_createmodel(m); });
  check(lib3mf_model_setunit(model.get(), MODELUNIT_MILLIMETER));
  check(lib3mf_model_addmetadatautf8(model.get(), "Title", solid.title.c_str()));
  check(lib3mf_model_addmetadatautf8(model.get(), "Application", solid.program.c_str()));
  for (const SolidBody& body : solid.bodies)
    add(body, &body == &solid.bodies.front() ? "" : body.name, model.get());
  check(lib3mf_model_setbuilduuidutf8(model.get(), uuid(solid.bodies.front().mesh, "build").c_str()));
  const auto writer =
      made<PLib3MFModelWriter>([&](auto w) { return lib3mf_model_querywriter(model.get(), "3mf", w); });
  ULONG64 size = 0;
  check(lib3mf_writer_getstreamsize(writer.get(), &size));
  std::string bytes(size, '\0');
  check(lib3mf_writer_writetobuffer(writer.get(), reinterpret_cast<BYTE*>(bytes.data()), size));
  return bytes;
}

}  // namespace
}  // namespace wheelwright

extern "C" __attribute__((visibility("default"))) void wheelwright_plugin_file(
    const wheelwright::SolidModel& solid, std::string& bytes) {
  bytes += wheelwright::file(solid);
}
