#include "wheelwright/mechanics/ring/surface_compliance.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/mechanics/ring/line_harmonics.h"

namespace wheelwright {
namespace {

/// Number of right-hand sides solved together: enough for fast products, few enough to save memory.
constexpr int rhs_together = 192;

/// Neighbouring seams whose compliance is computed together: they share most of the outer line.
constexpr int seams_together = 12;

/// What a seam is on the base: identity on its own part, and the tread's map for its line.
template <int dim>
class SeamMap {
 public:
  explicit SeamMap(const Tread<dim>& tread) : tread_(tread) {}

  int n_seam() const { return tread_.n_seam(); }
  int per_column() const { return tread_.base_per_column(); }
  int reach() const { return tread_.base_reach(); }
  int n_line() const { return tread_.n_line(); }

  /// Calls visit(row, column) for `n` columns from `first` on: the parts of the base in them, one below the
  /// other from row 0 on, and the columns of the ring, 0 <= column < n_columns().
  template <class Visit>
  void for_each_part(int first, int n, Visit visit) const {
    for (int c = 0; c < n; ++c) visit(per_column() * c, wrap(first + c, tread_.n_columns()));
  }

  /// Displacements of the seams seam - width - 1 to seam + width + 1, one below the other, for unit loads on
  /// the unknowns of `seam`. `base`: the displacements of the base, from the column reach() before the first
  /// of these seams on.
  Matrix seen(const Matrix& base, int width) const {
    const int n_seams = 2 * width + 3;
    auto result = Matrix::unfilled(n_seam() * n_seams, base.columns());
    for (int k = 0; k < n_seams; ++k) {
      const int first = n_seam() * k, apart = k - width - 1;
      multiply_rows(1, tread_.line_of_base(), base, per_column() * k, 0, result, first + per_column());
      for (int j = 0; j < base.columns(); ++j)
        std::copy_n(base.column(j) + per_column() * (k + reach()), per_column(), result.column(j) + first);
      add_own_lines(apart, first, result);
    }
    return result;
  }

  /// Adds the compliance of the lines on a fixed base to the displacements of the seam `apart` columns
  /// farther on, which begin in row `first`.
  void add_own_lines(int apart, int first, Matrix& displacements) const {
    if (std::abs(apart) > tread_.reach()) return;
    const Matrix& own = tread_.line_compliance(apart);
    for (int j = 0; j < n_line(); ++j)
      for (int i = 0; i < n_line(); ++i)
        displacements(first + per_column() + i, per_column() + j) += own(i, j);
  }

 private:
  const Tread<dim>& tread_;
};

/// responses() of some seams of the sector, by solving the ring for each of their unknowns.
template <int dim>
void solve_for_seams(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width,
                     std::span<const int> seams, std::vector<Matrix>& responses) {
  const SeamMap<dim> map(tread);
  const int n_sectors = ring.n_sectors(), per_sector = tread.columns_per_sector(), n_unknowns = map.n_seam(),
            n_base = map.per_column(), reach = map.reach(), n_seams = static_cast<int>(seams.size());
  // The field is periodic with the sectors of the factored ring.
  const auto sector = [&](int column) { return column / per_sector % n_sectors; };
  const auto row = [&](int column) { return n_base * (column % per_sector); };
  Matrix loads(ring.n_outer(), n_seams * n_unknowns * n_sectors);
  const auto field = [&](int seam, int unknown) { return (seam * n_unknowns + unknown) * n_sectors; };
  for (int k = 0; k < n_seams; ++k) {
    for (int i = 0; i < n_base; ++i) loads(row(seams[k]) + i, field(k, i) + sector(seams[k])) = 1;
    map.for_each_part(seams[k] - reach, 2 * reach + 1, [&](int first, int column) {
      for (int i = 0; i < map.n_line(); ++i)
        for (int j = 0; j < n_base; ++j)
          loads(row(column) + j, field(k, n_base + i) + sector(column)) += tread.line_of_base()(i, first + j);
    });
  }
  const Matrix outer = ring.outer_displacements(loads);
  parallel_for(n_seams, [&](int k) {
    const int n_seen = 2 * (width + 1 + reach) + 1;
    auto base = Matrix::unfilled(n_base * n_seen, n_unknowns);
    map.for_each_part(seams[k] - width - 1 - reach, n_seen, [&](int first, int column) {
      for (int unknown = 0; unknown < n_unknowns; ++unknown)
        std::copy_n(outer.column(field(k, unknown) + sector(column)) + row(column), n_base,
                    base.column(unknown) + first);
    });
    responses[seams[k]] = map.seen(base, width);
  });
}

/// Neighbouring columns of the ring in one sector.
struct SectorPart {
  int first;   ///< among the columns that were divided
  int sector;  ///< not wrapped: of column 0 it is 0, before it -1
  int column;  ///< the first one's, in the sector
  int n;
};

/// `n` columns from `first` on, by sectors.
std::vector<SectorPart> by_sectors(int first, int n, int per_sector) {
  std::vector<SectorPart> parts;
  for (int k = 0; k < n; k += parts.back().n) {
    const int column = wrap(first + k, per_sector);
    parts.push_back({k, (first + k - column) / per_sector, column, std::min(n - k, per_sector - column)});
  }
  return parts;
}

/// The compliance of the outer line between `n_to` columns of the ring from `first_to` on (rows) and `n_from`
/// columns from `first_from` on. `by_sector`: CyclicStiffness::outer_compliance().
Matrix outer_compliance(const std::vector<Matrix>& by_sector, int per_column, int per_sector, int first_to,
                        int n_to, int first_from, int n_from) {
  const int n_sectors = static_cast<int>(by_sector.size());
  auto result = Matrix::unfilled(per_column * n_to, per_column * n_from);
  for (const SectorPart& from : by_sectors(first_from, n_from, per_sector))
    for (const SectorPart& to : by_sectors(first_to, n_to, per_sector)) {
      const Matrix& g = by_sector[wrap(to.sector - from.sector, n_sectors)];
      for (int j = 0; j < per_column * from.n; ++j)
        std::copy_n(g.column(per_column * from.column + j) + per_column * to.column, per_column * to.n,
                    result.column(per_column * from.first + j) + per_column * to.first);
    }
  return result;
}

/// The displacements of the outer line in `n_to` columns of the ring from `first_to` on for loads on columns
/// from `first_from` on. The whole compliance between them would take most of the memory of a shape in 3D.
/// The sectors of the result are shared among the threads.
Matrix outer_displacements(const std::vector<Matrix>& by_sector, int per_column, int per_sector, int first_to,
                           int n_to, int first_from, const Matrix& loads) {
  Matrix result(per_column * n_to, loads.columns());
  const auto all_from = by_sectors(first_from, loads.rows() / per_column, per_sector),
             all_to = by_sectors(first_to, n_to, per_sector);
  parallel_for(static_cast<int>(all_to.size()), [&](int k) {
    const SectorPart& to = all_to[k];
    for (const SectorPart& from : all_from) {
      const Matrix g = outer_compliance(by_sector, per_column, per_sector, first_to + to.first, to.n,
                                        first_from + from.first, from.n);
      multiply_rows(1, g, loads, per_column * from.first, 1, result, per_column * to.first);
    }
  });
  return result;
}

/// Runs of neighbours among ascending numbers, of at most `longest`.
std::vector<std::span<const int>> runs(std::span<const int> numbers, int longest) {
  std::vector<std::span<const int>> result;
  size_t first = 0;
  for (size_t k = 1; k <= numbers.size(); ++k)
    if (k == numbers.size() || numbers[k] != numbers[k - 1] + 1 || k - first == size_t(longest)) {
      result.push_back(numbers.subspan(first, k - first));
      first = k;
    }
  return result;
}

/// responses() of some seams of the sector, ascending, from the compliance of the outer line.
template <int dim>
void apply_to_outer_line(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width,
                         std::span<const int> seams, std::vector<Matrix>& responses) {
  const SeamMap<dim> map(tread);
  const int reach = map.reach(), n_base = map.per_column(), n_line = map.n_line(),
            per_sector = tread.columns_per_sector();
  const int farthest = (2 * reach + width + 1 + seams_together) / per_sector + 1;
  const std::vector<Matrix> by_sector = ring.outer_compliance(farthest);
  const auto groups = runs(seams, seams_together);
  parallel_for(static_cast<int>(groups.size()), [&](int group) {
    const int first = groups[group].front(), n = static_cast<int>(groups[group].size());
    Matrix on_base(n_base * (n + 2 * reach), n_line * n);  // loads on the lines, as loads on the base
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n_line; ++i)
        for (int j = 0; j < tread.line_of_base().columns(); ++j)
          on_base(n_base * k + j, n_line * k + i) = tread.line_of_base()(i, j);
    const Matrix of_lines = outer_displacements(by_sector, n_base, per_sector, first - width - 1 - reach,
                                                n + 2 * (width + 1 + reach), first - reach, on_base);
    const int n_seen = 2 * (width + 1 + reach) + 1;
    parallel_for(n, [&](int k) {
      const Matrix of_base = outer_compliance(by_sector, n_base, per_sector, first + k - width - 1 - reach,
                                              n_seen, first + k, 1);
      auto base = Matrix::unfilled(n_base * n_seen, map.n_seam());
      for (int i = 0; i < map.n_seam(); ++i)
        std::copy_n(i < n_base ? of_base.column(i) : of_lines.column(n_line * k + i - n_base) + n_base * k,
                    base.rows(), base.column(i));
      responses[first + k] = map.seen(base, width);
    });
  });
}

/// Sectors between a seam and the farthest of those that are at most width + 1 columns apart.
int farthest_sector(int width, int per_sector) { return (width + per_sector) / per_sector; }

/// The seams X G X^T of a harmonic, one below the other, for unit loads on the unknowns of the given ones.
template <int dim>
ComplexMatrix seams_of_harmonic(const CyclicStiffness<dim>& ring, const Tread<dim>& tread,
                                std::span<const int> seams, int harmonic) {
  const int n_base = tread.base_per_column(), n_line = tread.n_line(), n_seam = tread.n_seam(),
            per_sector = tread.columns_per_sector();
  const LineHarmonics lines(tread, ring.harmonics(), harmonic);
  const ComplexMatrix base = ring.outer_compliance_of(harmonic), base_of_lines = lines.times_adjoint(base),
                      lines_of_base = adjoint(base_of_lines), own = lines.times_adjoint(lines_of_base);
  auto result = ComplexMatrix::unfilled(per_sector * n_seam, static_cast<int>(seams.size()) * n_seam);
  for (int k = 0; k < static_cast<int>(seams.size()); ++k)
    for (int j = 0; j < n_seam; ++j) {
      const bool is_base = j < n_base;
      const int column = is_base ? n_base * seams[k] + j : n_line * seams[k] + j - n_base;
      const std::complex<double>*on_base = (is_base ? base : base_of_lines).column(column),
            *on_lines = (is_base ? lines_of_base : own).column(column);
      for (int c = 0; c < per_sector; ++c) {
        std::complex<double>* to = result.column(n_seam * k + j) + n_seam * c;
        std::copy_n(on_base + n_base * c, n_base, to);
        std::copy_n(on_lines + n_line * c, n_line, to + n_base);
      }
    }
  return result;
}

/// responses() of some seams of the sector, with the tread applied in every harmonic.
template <int dim>
void map_harmonics(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width,
                   std::span<const int> seams, std::vector<Matrix>& responses) {
  const SeamMap<dim> map(tread);
  const int n_seam = map.n_seam(), per_sector = tread.columns_per_sector(),
            n_seams = static_cast<int>(seams.size()), range = width + 1;
  const std::vector<Matrix> by_sector = ring.harmonics().between_sectors(
      per_sector * n_seam, n_seams * n_seam, farthest_sector(width, per_sector),
      [&](int harmonic) { return seams_of_harmonic(ring, tread, seams, harmonic); });
  parallel_for(n_seams, [&](int k) {
    auto result = Matrix::unfilled(n_seam * (2 * range + 1), n_seam);
    for (const SectorPart& part : by_sectors(seams[k] - range, 2 * range + 1, per_sector)) {
      const Matrix& ahead = by_sector[wrap(part.sector, ring.n_sectors())];
      for (int j = 0; j < n_seam; ++j)
        std::copy_n(ahead.column(n_seam * k + j) + n_seam * part.column, n_seam * part.n,
                    result.column(j) + n_seam * part.first);
    }
    for (int apart = -range; apart <= range; ++apart)
      map.add_own_lines(apart, n_seam * (apart + range), result);
    responses[seams[k]] = std::move(result);
  });
}

/// The mirror image of a seam's unknown in the plane of azimuth 0: unknown `image` of seam -c - `behind`.
struct SeamImage {
  int image, behind;
  double sign;
};

template <int dim>
std::vector<SeamImage> seam_images(const Tread<dim>& tread) {
  const int n_base = tread.base_per_column(), per_line = tread.n_base() - n_base;  // per azimuth of the base
  std::vector<SeamImage> images;
  for (int i = 0; i < tread.n_seam(); ++i) {
    const double sign = i % dim == 1 ? -1 : 1;
    const bool inside = i >= per_line && i < n_base;  // on an azimuth between this seam and the next
    images.push_back({inside ? n_base - per_line * (i / per_line) + i % per_line : i, inside ? 1 : 0, sign});
  }
  return images;
}

/// responses() of a seam from those of its mirror images.
template <int dim>
Matrix mirror_image(const Tread<dim>& tread, int width, const Matrix& of_image,
                    const Matrix& of_image_before) {
  const auto images = seam_images(tread);
  const int n = tread.n_seam(), range = width + 1;
  Matrix result(of_image.rows(), n);
  for (int j = 0; j < n; ++j) {
    const SeamImage& from = images[j];
    const Matrix& source = from.behind == 0 ? of_image : of_image_before;
    for (int d = -range; d <= range; ++d)
      for (int i = 0; i < n; ++i) {
        const SeamImage& to = images[i];
        const int apart = -d - to.behind + from.behind;
        // Farther than `range` are only unknowns that no pair of columns within `width` needs.
        if (std::abs(apart) <= range)
          result(n * (d + range) + i, j) =
              from.sign * to.sign * source(n * (apart + range) + to.image, from.image);
      }
  }
  return result;
}

/// The seams of the sector whose responses are computed, ascending, and those that are their mirror images.
struct Seams {
  std::vector<int> computed, mirrored;
};

Seams seams_of(const std::vector<bool>& loaded_columns, bool is_mirror_symmetric) {
  const int n = static_cast<int>(loaded_columns.size());
  const auto is_loaded = [&](int seam) {
    return loaded_columns[wrap(seam, n)] || loaded_columns[wrap(seam - 1, n)];
  };
  Seams seams;
  for (int c = 0; c < n; ++c) {
    if (!is_loaded(c)) continue;
    const bool is_image = is_mirror_symmetric && 2 * c > n && is_loaded(n - c) && is_loaded(n - c - 1);
    (is_image ? seams.mirrored : seams.computed).push_back(c);
  }
  return seams;
}

/// Floating-point operations.
struct Work {
  double triangular, products;  ///< of triangular factors, and of dense products
  double longest_chain;         ///< of both: those that one thread does
  double flops() const { return triangular + products; }
  /// In units of an operation of a product: one of a triangular factor takes twice as long.
  double time() const { return 2 * triangular + products; }
};

/// Of SeamMap::seen(), with which the routes end that apply the tread to the sectors.
template <int dim>
double flops_of_seeing(const Tread<dim>& tread, int width, double n_seams) {
  return 2 * n_seams * tread.n_seam() * static_cast<double>(tread.line_of_base().entries().size()) *
         (2 * width + 3);
}

/// A product of a real number and a complex one counts as two real ones, one of two complex ones as four. The
/// parts of a ring that is symmetric across its width have half the size.
template <int dim>
Work work_of_solving(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width, double n_seams) {
  const int n_harmonics = ring.n_sectors() / 2 + 1;
  const double outer = ring.n_outer(), n_loads = n_seams * tread.n_seam();
  const double of_harmonic = n_loads * (ring.is_mirror_symmetric() ? 2 : 4) * 2 * outer * outer *
                             (ring.is_symmetric_across_width() ? 0.5 : 1);
  return {.triangular = n_harmonics * of_harmonic,
          .products =
              n_loads * n_harmonics * 8 * ring.n_sectors() * outer + flops_of_seeing(tread, width, n_seams),
          .longest_chain = of_harmonic};
}

/// Floating-point operations that the compliance of the outer line takes in one harmonic.
template <int dim>
double flops_of_outer_compliance(const CyclicStiffness<dim>& ring) {
  const double outer = ring.n_outer();
  return (ring.is_mirror_symmetric() ? 1 : 4) * 2.0 / 3 * outer * outer * outer *
         (ring.is_symmetric_across_width() ? 0.25 : 1);
}

template <int dim>
Work work_of_inverting(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width,
                       std::span<const int> seams) {
  const int n_harmonics = ring.n_sectors() / 2 + 1;
  const double n_base = tread.base_per_column(), reach = tread.base_reach();
  const double of_harmonic = flops_of_outer_compliance(ring);
  Work work{.triangular = n_harmonics * of_harmonic, .products = 0, .longest_chain = of_harmonic};
  double longest_group = 0;
  for (const auto group : runs(seams, seams_together)) {
    const double n = static_cast<double>(group.size()), n_to = n + 2 * (width + 1 + reach);
    const double of_column = 2 * n_base * n_base * (n + 2 * reach) * tread.n_line() * n;
    work.products += of_column * n_to;
    // One thread computes the columns of a sector, and then those of a seam.
    longest_group = std::max(longest_group, of_column * std::min<double>(n_to, tread.columns_per_sector()) +
                                                flops_of_seeing(tread, width, 1));
  }
  work.longest_chain += longest_group;
  work.products += flops_of_seeing(tread, width, static_cast<double>(seams.size()));
  return work;
}

template <int dim>
Work work_of_mapping(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width,
                     std::span<const int> seams) {
  const int n_harmonics = ring.n_sectors() / 2 + 1, per_sector = tread.columns_per_sector();
  const int n_needed = std::min(ring.n_sectors(), 2 * farthest_sector(width, per_sector) + 1);
  const double n_seam = tread.n_seam(), n_seams = static_cast<double>(seams.size());
  const double of_harmonic = flops_of_outer_compliance(ring),
               mapped = LineHarmonics::flops(tread, per_sector * n_seam);
  return {.triangular = n_harmonics * of_harmonic,
          .products = n_harmonics * (mapped + 4 * n_needed * per_sector * n_seam * n_seam * n_seams),
          .longest_chain = of_harmonic + mapped};
}

}  // namespace

template <int dim>
SurfaceCompliance<dim>::SurfaceCompliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread,
                                          int width, const std::vector<bool>& loaded,
                                          std::optional<ComplianceRoute> route)
    : columns_per_sector_(tread.columns_per_sector()), width_(width), responses_(columns_per_sector_) {
  // R + X G X^T with the compliance R of the lines on a fixed base, that of the core G, and the seams X on
  // the base.
  const Seams seams = seams_of(loaded, ring.is_mirror_symmetric());
  const std::array<std::pair<ComplianceRoute, Work>, 3> routes{
      {{ComplianceRoute::solve_seams,
        work_of_solving(ring, tread, width, static_cast<double>(seams.computed.size()))},
       {ComplianceRoute::invert_outer_line, work_of_inverting(ring, tread, width, seams.computed)},
       {ComplianceRoute::map_harmonics, work_of_mapping(ring, tread, width, seams.computed)}}};
  const auto& [chosen, work] =
      *(route ? std::ranges::find(routes, *route, [](const auto& r) { return r.first; })
              : std::ranges::min_element(routes, {}, [](const auto& r) { return r.second.time(); }));
  route_ = chosen;
  flops_ = work.flops();
  longest_chain_flops_ = work.longest_chain;
  switch (route_) {
    case ComplianceRoute::solve_seams: {
      const size_t together = std::max(1, rhs_together / tread.n_seam());
      for (size_t first = 0; first < seams.computed.size(); first += together)
        solve_for_seams(
            ring, tread, width,
            std::span(seams.computed).subspan(first, std::min(together, seams.computed.size() - first)),
            responses_);
      break;
    }
    case ComplianceRoute::invert_outer_line:
      apply_to_outer_line(ring, tread, width, seams.computed, responses_);
      break;
    case ComplianceRoute::map_harmonics:
      map_harmonics(ring, tread, width, seams.computed, responses_);
      break;
  }
  parallel_for(static_cast<int>(seams.mirrored.size()), [&](int k) {
    const int seam = seams.mirrored[k], image = columns_per_sector_ - seam;
    responses_[seam] = mirror_image(tread, width, responses_[image], responses_[image - 1]);
  });
}

template class SurfaceCompliance<2>;
template class SurfaceCompliance<3>;

}  // namespace wheelwright
