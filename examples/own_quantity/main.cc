// Optimizes the wheel of a case file that may name a quantity of this program, bulk_energy: the energy of the
// change of volume, which a nearly incompressible material should not have. Run again, it continues a run
// that was stopped. usage: own_quantity CASE FOLDER

#include <wheelwright/quantities/functionals/material_density_integral.h>
#include <wheelwright/wheelwright.h>

#include <cstdio>
#include <filesystem>

using namespace wheelwright;

/// int K/2 (tr eps)^2 dx at every load position, with the bulk modulus K.
template <int dim>
class BulkEnergy : public MaterialDensityIntegral<dim> {
 public:
  std::string name() const override { return "bulk_energy"; }
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }

 private:
  using typename MaterialDensityIntegral<dim>::Value;

  Value at(const Voigt<dim>& strain, const MaterialLaw<dim>& law) const override {
    const Material& material = *law.isotropic();
    const double bulk_modulus = material.lambda() + 2 * material.mu() / 3;
    double trace = 0;
    for (int d = 0; d < dim; ++d) trace += strain[d];
    Value value{bulk_modulus / 2 * trace * trace, {}};
    for (int d = 0; d < dim; ++d) value.by_strain[d] = bulk_modulus * trace;
    return value;
  }
};

Quantities with_bulk_energy() {
  Quantities quantities;
  quantities.add({.name = "bulk_energy",
                  .unit = UnitKind::energy,
                  .meaning = "energy of the change of volume",
                  .of = Positions::each,
                  .functional = []<int dim>(const QuantityContext<dim>&) {
                    return std::make_shared<const BulkEnergy<dim>>();
                  }});
  return quantities;
}

int main(int count, char** arguments) {
  restart_with_blas_settings(arguments);
  if (count < 3) return 2;
  const CaseResult wheel = read_case(arguments[1], {.quantities = with_bulk_energy()});
  for (const Diagnostic& problem : wheel.problems) std::fprintf(stderr, "%s\n", problem.text().c_str());
  if (!wheel.value) return 2;

  const std::filesystem::path folder = arguments[2];
  auto run = std::filesystem::exists(folder) ? Run<2>::resume(*wheel.value, folder)
                                             : Run<2>::begin(*wheel.value, folder);
  if (!run) return 1;
  CommandQueue commands;
  return run->execute(commands).state ? 0 : 1;
}
