#include <gtest/gtest.h>

#include <algorithm>

#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {
namespace {

/// A sector of 6 x 5 cells, or 6 x 5 x 2, of which only the cells that `holds` names have material.
template <int dim, class Holds>
CutDomain<dim> domain_of(Holds holds) {
  PolarGrid<dim> grid{0.20, 0.34, 0.12, 7, {6, 5}};
  if constexpr (dim == 3) grid.cells[2] = 2;
  CutDomain<dim> domain{grid, std::vector<CellKind>(grid.n_cells(), CellKind::outside), {}, {}};
  for (int cell = 0; cell < grid.n_cells(); ++cell)
    if (holds(grid.cell_position(cell))) domain.kinds[cell] = CellKind::inside;
  return domain;
}

/// A step from the rim in one column of cells to the tread in another. The step is taken in row 2 and has to
/// cross the face between the sectors.
template <int dim>
CutDomain<dim> step_across_the_sector_face(int rim_column, int tread_column) {
  return domain_of<dim>([=](const std::array<int, dim>& p) {
    return p[0] == 5 || (p[0] <= 2 && p[1] == rim_column) || (p[0] >= 2 && p[1] == tread_column);
  });
}

template <int dim>
void expect_attached(const CutDomain<dim>& domain) {
  const auto failure = check_attached<dim>(domain, 0, 1);
  EXPECT_FALSE(failure) << failure->detail;
}

template <int dim>
void expect_failure(const CutDomain<dim>& domain, FailureReason reason) {
  const auto failure = check_attached<dim>(domain, 0, 1);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->reason, reason) << failure->detail;
}

TEST(CheckAttached, MaterialIsAttachedAcrossEitherSectorFace) {
  expect_attached(step_across_the_sector_face<2>(0, 4));
  expect_attached(step_across_the_sector_face<2>(4, 0));
  expect_attached(step_across_the_sector_face<3>(0, 4));
  expect_attached(step_across_the_sector_face<3>(4, 0));
}

TEST(CheckAttached, NonadjacentColumnsAreNotConnected) {
  expect_failure(step_across_the_sector_face<2>(0, 3), FailureReason::tread_cut_off);
  expect_failure(step_across_the_sector_face<2>(1, 4), FailureReason::tread_cut_off);
  expect_failure(step_across_the_sector_face<3>(2, 4), FailureReason::tread_cut_off);
}

TEST(CheckAttached, CellsSharingOnlyAnEdgeAreNotConnected) {
  expect_failure(domain_of<2>([](const std::array<int, 2>& p) {
                   return p[0] == 5 || (p[0] <= 2 && p[1] == 0) || (p[0] >= 3 && p[1] == 4);
                 }),
                 FailureReason::tread_cut_off);
}

/// Two cells on the two sides of the sector face, which hold each other and nothing else.
TEST(CheckAttached, AnIslandAcrossTheSectorFaceIsAnIsland) {
  auto domain = domain_of<2>([](const std::array<int, 2>& p) {
    return p[0] == 5 || p[1] == 2 || (p[0] == 3 && (p[1] == 0 || p[1] == 4));
  });
  expect_failure(domain, FailureReason::disconnected_material);
  domain.kinds[domain.grid.cell_index({3, 1})] = CellKind::cut;
  expect_attached(domain);
}

TEST(CheckAttached, EveryCellOfTheProtectedRowsMustBeFull) {
  for (const int row : {0, 1, 3, 4, 5})
    for (int column = 0; column < 5; ++column) {
      auto domain = domain_of<2>([](const std::array<int, 2>&) { return true; });
      domain.kinds[domain.grid.cell_index({row, column})] = CellKind::cut;
      const auto failure = check_attached<2>(domain, 1, 2);
      EXPECT_EQ(failure.has_value(), row < 1 || row >= 4) << row;
      if (failure) {
        EXPECT_EQ(failure->reason, FailureReason::protected_band);
      }
    }
}

/// A domain turned by any number of columns is as attached as before.
TEST(CheckAttached, DoesNotDependOnWhereTheSectorBegins) {
  for (int turn = 0; turn < 5; ++turn) {
    const auto column = [&](int c) { return (c + turn) % 5; };
    expect_attached(step_across_the_sector_face<2>(column(0), column(1)));
    expect_attached(step_across_the_sector_face<2>(column(1), column(0)));
    expect_failure(step_across_the_sector_face<2>(column(0), column(2)), FailureReason::tread_cut_off);
  }
}

}  // namespace
}  // namespace wheelwright
