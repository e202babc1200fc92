// Errors and times of the quadrature of random cut cells, kind by kind: `cut_cells 3 1000 4 8 16`. The errors
// are those of the divergence theorem (unit vectors and position) and of the complement, where both sides
// fill the cell; neither needs a reference solution.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "tests/random_cells.h"
#include "wheelwright/shape/cut/cell_quadrature.h"

namespace wheelwright {
namespace {

using testing::Cells;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <int dim>
double volume(const CutCell<dim>& cell) {
  double sum = 0;
  for (const auto& q : cell.material) sum += q.weight;
  return sum;
}

struct Times {
  double user = 0;
  size_t points = 0;
  int failures = 0;
};

std::string percentiles(std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  const auto at = [&](double fraction) {
    return errors[static_cast<size_t>(fraction * (errors.size() - 1))];
  };
  char text[80];
  std::snprintf(text, sizeof text, "%8.0e %8.0e %8.0e", at(0.5), at(0.99), at(1));
  return text;
}

template <int dim>
void measure(int n_cells, int points) {
  std::printf(
      "%dD, %d points per direction: divergence theorem and complement, each median, 99 %%, largest\n", dim,
      points);
  for (size_t kind = 0; kind < Cells<dim>::names.size(); ++kind) {
    Cells<dim> cells(1000 + kind);
    std::vector<double> divergence, complement;
    Times times;
    for (int i = 0; i < n_cells; ++i) {
      auto cell = cells.draw(static_cast<int>(kind));
      const CellQuadrature<dim> quadrature(cell.degree, points);
      if (quadrature.classify(cell.values) != CellKind::cut) continue;
      const double begin = seconds();
      const auto inside = quadrature.split(0, cell.values);
      times.user += seconds() - begin;
      auto negative = cell.values;
      for (double& value : negative) value = -value;
      const auto outside = quadrature.split(0, negative);
      if (!inside || !outside) {
        ++times.failures;
        if (std::getenv("WORST")) {
          std::printf("fails:");
          for (const double value : cell.values) std::printf(" %.17g,", value);
          std::printf("\n");
        }
        continue;
      }
      times.points += inside->material.size() + inside->boundary.size();
      divergence.push_back(quadrature.divergence_defect(*inside, cell.values));
      complement.push_back(std::abs(volume(*inside) + volume(*outside) - 1));
      if (const char* worst = std::getenv("WORST"); worst && divergence.back() > std::atof(worst)) {
        std::printf("%g:", divergence.back());
        for (const double value : cell.values) std::printf(" %.17g,", value);
        std::printf("\n");
      }
    }
    if (divergence.empty()) continue;
    const double n = static_cast<double>(divergence.size());
    const auto above =
        std::count_if(divergence.begin(), divergence.end(), [](double x) { return x > 1e-10; });
    std::printf("%-24s %6.0f cells %s |%s | %7.0f us %7.0f points, %td above 1e-10, %d failures\n",
                Cells<dim>::names[kind], n, percentiles(divergence).c_str(), percentiles(complement).c_str(),
                1e6 * times.user / n, static_cast<double>(times.points) / n, above, times.failures);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace wheelwright

int main(int argc, char** argv) {
  if (argc < 4) return std::fputs("usage: cut_cells DIM CELLS POINTS...\n", stderr), 2;
  for (int i = 3; i < argc; ++i)
    if (std::atoi(argv[1]) == 2)
      wheelwright::measure<2>(std::atoi(argv[2]), std::atoi(argv[i]));
    else
      wheelwright::measure<3>(std::atoi(argv[2]), std::atoi(argv[i]));
}
