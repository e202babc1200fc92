#include "wheelwright/mechanics/ring/cyclic_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/ring/nested_dissection.h"

namespace wheelwright {
namespace {

/// A node of a sector's boundary as all sectors number it: that of the first face in place of that of the
/// last.
template <int dim>
struct BoundaryNode {
  std::array<int, dim> position;
  int shift;  ///< sectors ahead
};

template <int dim>
BoundaryNode<dim> boundary_node(const SectorSpace<dim>& space, std::array<int, dim> p) {
  if (p[1] < space.last_line()) return {p, 0};
  p[1] = space.last_line() - p[1];
  return {p, 1};
}

template <int dim>
bool is_on_outer_line(const SectorSpace<dim>& space, const std::array<int, dim>& p) {
  return p[0] == space.degree() * space.core_rows() && p[1] >= 0 && p[1] <= space.last_line();
}

template <int dim>
BoundaryLayout<dim> boundary_layout(const SectorSpace<dim>& space) {
  std::vector<char> trailing(space.n_nodes(), 0);
  BoundaryLayout<dim> layout;
  for (int node = 0; node < space.n_nodes(); ++node) {
    const auto& p = space.position(node);
    if (is_on_outer_line<dim>(space, p)) {
      trailing[node] = 1;
    } else if (p[1] >= space.last_line()) {
      trailing[node] = 1;
      layout.interface_nodes.push_back(boundary_node<dim>(space, p).position);
      if (const int own = space.number(layout.interface_nodes.back()); own >= 0) trailing[own] = 1;
    }
  }
  for (int node = 0; node < space.n_nodes(); ++node)
    (trailing[node] ? layout.trailing_nodes : layout.interior_nodes).push_back(node);
  return layout;
}

/// All unknowns that are not on the outer line as those of the interface, line after line along the longer
/// side of the section, in which order they are eliminated: the section is so narrow that nested dissection
/// takes more operations.
template <int dim>
BoundaryLayout<dim> section_layout(const SectorSpace<dim>& space) {
  BoundaryLayout<dim> layout;
  for (int node = 0; node < space.n_nodes(); ++node) {
    layout.trailing_nodes.push_back(node);
    const auto& p = space.position(node);
    if (p[1] < space.last_line() && !is_on_outer_line<dim>(space, p)) layout.interface_nodes.push_back(p);
  }
  const int along = dim == 3 && space.grid().cells[dim - 1] > space.core_rows() ? dim - 1 : 0;
  std::ranges::stable_sort(layout.interface_nodes, {}, [along](const auto& p) { return p[along]; });
  return layout;
}

template <class Scalar>
DenseMatrix<Scalar> stacked(const DenseMatrix<Scalar>& top, const DenseMatrix<Scalar>& bottom) {
  auto result = DenseMatrix<Scalar>::unfilled(top.rows() + bottom.rows(), top.columns());
  for (int j = 0; j < top.columns(); ++j) {
    std::copy_n(top.column(j), top.rows(), result.column(j));
    std::copy_n(bottom.column(j), bottom.rows(), result.column(j) + top.rows());
  }
  return result;
}

/// Finding the strong modes takes about as long as four complex factors. On small interfaces most modes are
/// strong, and the harmonics take little time.
InterfaceRoute best_route(const BoundarySymmetry& symmetry, const SectorHarmonics& harmonics) {
  constexpr int fewest_harmonics = 6, smallest_interface = 1000;
  const bool is_worth_it =
      harmonics.n_harmonics() >= fewest_harmonics && symmetry.n_interface >= smallest_interface;
  return is_worth_it && !symmetry.azimuth && !symmetry.width ? InterfaceRoute::strong_modes
                                                             : InterfaceRoute::all_unknowns;
}

std::shared_ptr<BoundarySymmetry> without_symmetry(int n_interface, int n_outer) {
  auto symmetry = std::make_shared<BoundarySymmetry>();
  symmetry->n_interface = n_interface;
  symmetry->classes.emplace_back(n_interface + n_outer, n_interface);
  return symmetry;
}

/// The numbers of a sector's boundary unknowns.
template <int dim>
class BoundaryNumbers {
 public:
  BoundaryNumbers(const SectorSpace<dim>& space, const BoundaryLayout<dim>& layout) : space_(space) {
    for (const auto& p : layout.interface_nodes)
      interface_index_.emplace(p, static_cast<int>(interface_index_.size()));
    if constexpr (dim == 3) axial_nodes_ = space.degree() * space.grid().cells[2] + 1;
  }

  int axial_nodes() const { return axial_nodes_; }
  int n_interface() const { return dim * static_cast<int>(interface_index_.size()); }
  int n_outer() const { return dim * space_.last_line() * axial_nodes_; }

  /// The first unknown of a node at a position in the sector's own period; -1 if it is not on the boundary.
  int first_unknown(const std::array<int, dim>& p) const {
    if (is_on_outer_line<dim>(space_, p)) {
      int line = p[1];
      if constexpr (dim == 3) line = line * axial_nodes_ + p[2];
      return n_interface() + dim * line;
    }
    const auto found = interface_index_.find(p);
    return found == interface_index_.end() ? -1 : dim * found->second;
  }

 private:
  const SectorSpace<dim>& space_;
  std::map<std::array<int, dim>, int> interface_index_;
  int axial_nodes_ = 1;
};

}  // namespace

template <int dim>
CyclicStiffness<dim>::CyclicStiffness(SectorStiffness<dim> sector, FactoredSector factored,
                                      const SectorHarmonics& harmonics, Boundary boundary,
                                      std::shared_ptr<const BoundarySymmetry> symmetry,
                                      std::optional<InterfaceModes> modes,
                                      std::vector<HarmonicFactor> harmonic_factors)
    : sector_(std::move(sector)),
      sector_factor_(std::move(factored.factor)),
      harmonics_(harmonics),
      row_(std::move(factored.row)),
      trailing_(std::move(boundary.trailing)),
      n_boundary_(boundary.size()),
      n_outer_(boundary.n_outer),
      symmetry_(std::move(symmetry)),
      modes_(std::move(modes)),
      harmonic_factors_(std::move(harmonic_factors)) {}

template <int dim>
Expected<CyclicStiffness<dim>> CyclicStiffness<dim>::factor(SectorStiffness<dim> sector,
                                                            const OuterStiffness& outer_stiffness,
                                                            const SectorHarmonics& harmonics,
                                                            std::optional<InterfaceRoute> route) {
  if (route.value_or(InterfaceRoute::section) == InterfaceRoute::section)
    if (auto of_section = factor_section(sector, outer_stiffness, harmonics)) return *std::move(of_section);
  const BoundaryLayout<dim> layout = boundary_layout(sector.space);
  auto factored = factor_sector(sector, layout);
  if (!factored) return factored.failure();
  Boundary boundary = boundary_of(sector.space, layout);
  CoupledSectors coupled(boundary.trailing, factored->factor.release_schur(), boundary.size());
  auto symmetry = symmetry_of(coupled, boundary);
  OfHarmonics of_harmonics = reduced_to_modes(std::move(coupled), boundary, symmetry,
                                              route.value_or(best_route(*symmetry, harmonics)));
  auto factors = factor_harmonics(of_harmonics.coupled, of_harmonics.symmetry, outer_stiffness, harmonics);
  if (!factors) return factors.failure();
  return CyclicStiffness(std::move(sector), *std::move(factored), harmonics, std::move(boundary),
                         std::move(symmetry), std::move(of_harmonics.modes), *std::move(factors));
}

/// Eliminates the interior of a sector.
template <int dim>
Expected<typename CyclicStiffness<dim>::FactoredSector> CyclicStiffness<dim>::factor_sector(
    const SectorStiffness<dim>& sector, const BoundaryLayout<dim>& layout) {
  std::vector<int> nodes = nested_dissection(sector, layout.interior_nodes);
  nodes.insert(nodes.end(), layout.trailing_nodes.begin(), layout.trailing_nodes.end());
  auto factor =
      PartialCholesky::factor(sector.matrix, dim, nodes, static_cast<int>(layout.trailing_nodes.size()));
  if (!factor) return factor.failure();
  std::vector<int> row(dim * nodes.size());
  for (int k = 0; k < static_cast<int>(nodes.size()); ++k)
    for (int c = 0; c < dim; ++c) row[dim * nodes[k] + c] = dim * k + c;
  return FactoredSector{*std::move(factor), std::move(row)};
}

template <int dim>
std::optional<Expected<CyclicStiffness<dim>>> CyclicStiffness<dim>::factor_section(
    SectorStiffness<dim>& sector, const OuterStiffness& outer_stiffness, const SectorHarmonics& harmonics) {
  if (sector.space.grid().cells[1] != 1 || harmonics.n_sectors() < 3) return {};
  const BoundaryLayout<dim> layout = section_layout(sector.space);
  Boundary boundary = boundary_of(sector.space, layout);
  const SectionStiffness section(sector.matrix, boundary.trailing, boundary.azimuth);
  if (!section.is_mirror_symmetric()) return {};
  auto symmetry = without_symmetry(boundary.n_interface, boundary.n_outer);
  symmetry->azimuth = boundary.azimuth;

  std::vector<int> order(boundary.size() / dim);
  std::iota(order.begin(), order.end(), 0);
  const auto basis_of = [&](int h) { return MirrorBasis(boundary.azimuth, harmonics.phase(h, 1)); };
  const auto analysis =
      PartialCholesky::analyze(section.of_harmonic(basis_of(0), 1.0), dim, order, boundary.n_outer / dim);
  if (!analysis) return analysis.failure();
  std::vector<std::optional<HarmonicFactor>> factors(harmonics.n_harmonics());
  parallel_for(harmonics.n_harmonics(), [&](int h) {
    const MirrorBasis basis = basis_of(h);
    const ComplexMatrix on_outer_line = outer_stiffness(h);
    auto on_last = Matrix::unfilled(boundary.n_outer, boundary.n_outer);
    for (int j = 0; j < boundary.n_outer; ++j)
      for (int i = 0; i < boundary.n_outer; ++i)
        on_last(i, j) =
            basis.of_own_images(boundary.n_interface + i, boundary.n_interface + j, on_outer_line(i, j));
    auto factor =
        SparseTwoBlockCholesky::factor(section.of_harmonic(basis, harmonics.phase(h, 1)), on_last, *analysis);
    if (factor) factors[h].emplace(symmetry, *std::move(factor), basis);
  });
  auto all = all_of(std::move(factors));
  if (!all) return all.failure();
  std::vector<int> row(sector.space.n_dofs());
  std::iota(row.begin(), row.end(), 0);
  FactoredSector factored{PartialCholesky::without_interior(sector.space.n_dofs()), std::move(row)};
  return CyclicStiffness(std::move(sector), std::move(factored), harmonics, std::move(boundary),
                         std::move(symmetry), {}, *std::move(all));
}

template <int dim>
typename CyclicStiffness<dim>::Boundary CyclicStiffness<dim>::boundary_of(const SectorSpace<dim>& space,
                                                                          const BoundaryLayout<dim>& layout) {
  const BoundaryNumbers<dim> numbers(space, layout);
  Boundary boundary{numbers.n_interface(), numbers.n_outer(), {}, {}, {}};
  BoundaryMirror width;
  boundary.azimuth.unknowns.resize(boundary.size());
  width.unknowns.resize(boundary.size());
  bool has_images_across = dim == 3;
  for (int node : layout.trailing_nodes) {
    const auto [p, shift] = boundary_node<dim>(space, space.position(node));
    auto behind = p, across = p;
    if (p[1] > 0) behind[1] = space.last_line() - p[1];
    if constexpr (dim == 3) across[2] = numbers.axial_nodes() - 1 - p[2];
    const int first = numbers.first_unknown(p), image = numbers.first_unknown(behind),
              image_across = numbers.first_unknown(across);
    has_images_across &= image_across >= 0;
    const double of_derivative = p[1] == -1 ? -1 : 1;  // the first one changes its sign with the azimuth
    for (int c = 0; c < dim; ++c) {
      boundary.trailing.push_back({first + c, shift});
      boundary.azimuth.unknowns[first + c] = {image + c, p[1] <= 0 ? 0 : 1,
                                              of_derivative * (c == 1 ? -1.0 : 1.0)};
      width.unknowns[first + c] = {image_across + c, 0, c == 2 ? -1.0 : 1.0};
    }
  }
  if (has_images_across) boundary.width = std::move(width);
  return boundary;
}

template <int dim>
std::shared_ptr<const BoundarySymmetry> CyclicStiffness<dim>::symmetry_of(const CoupledSectors& coupled,
                                                                          const Boundary& boundary) {
  auto symmetry = std::make_shared<BoundarySymmetry>();
  symmetry->n_interface = boundary.n_interface;
  if (coupled.commute_with_azimuth(boundary.azimuth)) symmetry->azimuth = boundary.azimuth;
  if (boundary.width && coupled.commute_with_width(*boundary.width)) {
    for (const double sign : {1.0, -1.0})
      symmetry->classes.emplace_back(*boundary.width, boundary.n_interface, sign);
    symmetry->width = boundary.width;
  } else {
    symmetry->classes.emplace_back(boundary.size(), boundary.n_interface);
  }
  return symmetry;
}

template <int dim>
typename CyclicStiffness<dim>::OfHarmonics CyclicStiffness<dim>::reduced_to_modes(
    CoupledSectors coupled, const Boundary& boundary, std::shared_ptr<const BoundarySymmetry> symmetry,
    InterfaceRoute route) {
  std::optional<InterfaceModes> modes;
  if (route == InterfaceRoute::strong_modes && coupled.farthest() == 1)
    modes = InterfaceModes::find(coupled.matrix(0), coupled.matrix(1), boundary.n_interface);
  if (!modes) return {std::move(coupled), std::move(symmetry), {}};
  CoupledSectors of_modes(modes->release_stiffness());
  auto without = without_symmetry(modes->n_strong(), boundary.n_outer);
  return {std::move(of_modes), std::move(without), std::move(modes)};
}

template <int dim>
Expected<std::vector<HarmonicFactor>> CyclicStiffness<dim>::factor_harmonics(
    const CoupledSectors& coupled, const std::shared_ptr<const BoundarySymmetry>& of_harmonics,
    const OuterStiffness& outer_stiffness, const SectorHarmonics& harmonics) {
  const int n_first = of_harmonics->n_interface;
  std::vector<std::optional<HarmonicFactor>> factors(harmonics.n_harmonics());
  parallel_for(harmonics.n_harmonics(), [&](int h) {
    const ComplexMatrix on_outer_line = outer_stiffness(h);
    std::vector<std::complex<double>> twice;
    for (int d = 1; d <= coupled.farthest(); ++d) twice.push_back(2.0 * harmonics.phase(h, d));
    const auto entry = [&](int i, int j) {
      std::complex<double> sum = coupled.sum(twice, i, j);
      if (i >= n_first && j >= n_first) sum += on_outer_line(i - n_first, j - n_first);
      return sum;
    };
    factors[h] = HarmonicFactor::factor(of_harmonics, harmonics.phase(h, 1),
                                        h == 0 || 2 * h == harmonics.n_sectors(), entry);
  });
  return all_of(std::move(factors));
}

template <int dim>
Expected<std::vector<HarmonicFactor>> CyclicStiffness<dim>::all_of(
    std::vector<std::optional<HarmonicFactor>> factors) {
  std::vector<HarmonicFactor> result;
  for (size_t h = 0; h < factors.size(); ++h) {
    if (!factors[h])
      return Failure{
          FailureReason::not_positive_definite,
          fmt::format("the ring's stiffness is not positive definite for harmonic {}: use a larger "
                      "contact.gamma_0, or another grid.angular_cells{}",
                      h,
                      dim == 3 ? "; cells that are 40 times as high as thick need more radial cells" : "")};
    result.push_back(*std::move(factors[h]));
  }
  return result;
}

template <int dim>
CyclicStiffness<dim>::CoupledSectors::CoupledSectors(const std::vector<SharedUnknown>& trailing,
                                                     const Matrix& schur, int n_boundary) {
  int farthest = 0;
  for (const SharedUnknown& t : trailing) farthest = std::max(farthest, t.shift);
  resize(n_boundary, farthest);
  for (int j = 0; j < schur.columns(); ++j)
    for (int i = 0; i < schur.rows(); ++i)
      add(trailing[j].shift - trailing[i].shift, trailing[i].boundary, trailing[j].boundary, schur(i, j));
}

template <int dim>
CyclicStiffness<dim>::CoupledSectors::CoupledSectors(const std::vector<Matrix>& by_difference) {
  const int farthest = static_cast<int>(by_difference.size()) / 2;
  resize(by_difference.front().rows(), farthest);
  for (int d = 0; d <= farthest; ++d)
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) add(d, i, j, by_difference[farthest + d](i, j));
}

template <int dim>
void CyclicStiffness<dim>::CoupledSectors::resize(int n, int farthest) {
  n_ = n;
  const size_t size = size_t(n) * (n + 1) / 2;
  own_.assign(size, 0.0);
  ahead_.assign(farthest, {own_, own_});
}

/// Every entry is given together with its image. Images, for negative differences and above the diagonal of
/// the sector's own matrix, are not kept and are ignored.
template <int dim>
void CyclicStiffness<dim>::CoupledSectors::add(int difference, int i, int j, double value) {
  if (difference < 0) return;
  if (difference == 0) {
    if (i >= j) own_[place(i, j)] += value;
    return;
  }
  Ahead& ahead = ahead_[difference - 1];
  ahead.symmetric[place(i, j)] += i == j ? value : 0.5 * value;
  if (i != j) ahead.antisymmetric[place(i, j)] += i > j ? 0.5 * value : -0.5 * value;
}

/// The place in packed storage of an entry or of its image below the diagonal.
template <int dim>
size_t CyclicStiffness<dim>::CoupledSectors::place(int i, int j) const {
  const auto [column, row] = std::minmax(i, j);
  return size_t(column) * (2 * size_t(n_) - column - 1) / 2 + row;
}

template <int dim>
double CyclicStiffness<dim>::CoupledSectors::entry(int difference, int i, int j) const {
  if (std::abs(difference) > farthest()) return 0;
  if (difference < 0) return entry(-difference, j, i);
  if (difference == 0) return own_[place(i, j)];
  const Ahead& ahead = ahead_[difference - 1];
  const double turned = ahead.antisymmetric[place(i, j)];
  return ahead.symmetric[place(i, j)] + (i >= j ? turned : -turned);
}

template <int dim>
Matrix CyclicStiffness<dim>::CoupledSectors::matrix(int difference) const {
  auto result = Matrix::unfilled(n_, n_);
  parallel_for(n_, [&](int j) {
    for (int i = 0; i < n_; ++i) result(i, j) = entry(difference, i, j);
  });
  return result;
}

template <int dim>
std::complex<double> CyclicStiffness<dim>::CoupledSectors::sum(const std::vector<std::complex<double>>& twice,
                                                               int i, int j) const {
  const size_t k = place(i, j);
  double real = own_[k], imaginary = 0;
  for (size_t d = 0; d < ahead_.size(); ++d) {
    real += twice[d].real() * ahead_[d].symmetric[k];
    imaginary += twice[d].imag() * ahead_[d].antisymmetric[k];
  }
  return {real, i >= j ? imaginary : -imaginary};
}

/// Whether image(difference, i, j) is entry(difference, i, j), up to what rounding leaves of their
/// difference, relative to the diagonal.
template <int dim>
template <class Image>
bool CyclicStiffness<dim>::CoupledSectors::equals(Image image) const {
  constexpr double rounding = 1e-10;
  std::vector<double> scale;
  for (int i = 0; i < n_; ++i) scale.push_back(std::sqrt(std::abs(entry(0, i, i))));
  for (int d = 0; d <= farthest(); ++d)
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i)
        if (!(std::abs(entry(d, i, j) - image(d, i, j)) <= rounding * scale[i] * scale[j])) return false;
  return true;
}

template <int dim>
bool CyclicStiffness<dim>::CoupledSectors::commute_with_azimuth(const BoundaryMirror& mirror) const {
  return equals([&](int difference, int i, int j) {
    const auto &from = mirror.unknowns[i], &to = mirror.unknowns[j];
    return from.sign * to.sign * entry(from.ahead - to.ahead - difference, from.image, to.image);
  });
}

template <int dim>
bool CyclicStiffness<dim>::CoupledSectors::commute_with_width(const BoundaryMirror& mirror) const {
  return equals([&](int difference, int i, int j) {
    const auto &from = mirror.unknowns[i], &to = mirror.unknowns[j];
    return from.sign * to.sign * entry(difference, from.image, to.image);
  });
}

template <int dim>
Matrix CyclicStiffness<dim>::boundary_loads(const Matrix& trailing_loads) const {
  const int n = n_sectors();
  Matrix boundary(n_boundary_, trailing_loads.rows());
  parallel_for(boundary.columns() / n, [&](int rhs) {
    for (size_t t = 0; t < trailing_.size(); ++t) {
      const double* load = trailing_loads.column(static_cast<int>(t)) + rhs * n;
      for (int s = 0; s < n; ++s)
        boundary(trailing_[t].boundary, rhs * n + (s + trailing_[t].shift) % n) += load[s];
    }
  });
  return boundary;
}

template <int dim>
typename CyclicStiffness<dim>::EliminatedInterface CyclicStiffness<dim>::eliminate_interface(
    Matrix boundary_loads) const {
  EliminatedInterface result;
  if (modes_) result.interface.weak_modes = modes_->eliminate(boundary_loads, n_sectors());
  const int n_first = n_interface_of_harmonics();
  result.interface.by_harmonic = harmonics_.forward_each(boundary_loads);
  std::vector<ComplexMatrix> outer(harmonics_.n_harmonics());
  parallel_for(harmonics_.n_harmonics(), [&](int h) {
    ComplexMatrix& loads = result.interface.by_harmonic[h];
    harmonic_factors_[h].eliminate(loads);
    outer[h] = block(loads, n_first, 0, n_outer_, loads.columns());
    loads = block(loads, 0, 0, n_first, loads.columns());
  });
  result.outer = harmonics_.backward_each(outer);
  return result;
}

template <int dim>
Matrix CyclicStiffness<dim>::outer_displacements(const Matrix& condensed_loads) const {
  std::vector<ComplexMatrix> outer = harmonics_.forward_each(condensed_loads);
  parallel_for(harmonics_.n_harmonics(), [&](int h) { harmonic_factors_[h].solve_last(outer[h]); });
  return harmonics_.backward_each(outer);
}

template <int dim>
std::vector<Matrix> CyclicStiffness<dim>::outer_compliance(int farthest, std::optional<int> together) const {
  return harmonics_.between_sectors(
      n_outer_, n_outer_, farthest, [&](int harmonic) { return outer_compliance_of(harmonic); }, together);
}

template <int dim>
Matrix CyclicStiffness<dim>::boundary_displacements(const Matrix& outer,
                                                    const InterfaceLoads& interface) const {
  const int n_first = n_interface_of_harmonics();
  std::vector<ComplexMatrix> x = harmonics_.forward_each(outer);
  parallel_for(harmonics_.n_harmonics(), [&](int h) {
    x[h] = stacked(
        interface.by_harmonic.empty() ? ComplexMatrix(n_first, x[h].columns()) : interface.by_harmonic[h],
        x[h]);
    harmonic_factors_[h].substitute(x[h]);
    x[h] = block(x[h], 0, 0, n_first, x[h].columns());
  });
  const Matrix first = harmonics_.backward_each(x);
  return stacked(modes_ ? modes_->displacements(first, outer, interface.weak_modes, n_sectors()) : first,
                 outer);
}

template <int dim>
Matrix CyclicStiffness<dim>::trailing_displacements(const Matrix& boundary) const {
  const int n = n_sectors();
  auto trailing = Matrix::unfilled(boundary.columns(), static_cast<int>(trailing_.size()));
  parallel_for(boundary.columns() / n, [&](int rhs) {
    for (size_t t = 0; t < trailing_.size(); ++t) {
      double* displacement = trailing.column(static_cast<int>(t)) + rhs * n;
      for (int s = 0; s < n; ++s)
        displacement[s] = boundary(trailing_[t].boundary, rhs * n + (s + trailing_[t].shift) % n);
    }
  });
  return trailing;
}

template class CyclicStiffness<2>;
template class CyclicStiffness<3>;

}  // namespace wheelwright
