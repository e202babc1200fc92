#include <gtest/gtest.h>

#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "tests/support.h"
#include "tests/von_mises.h"
#include "wheelwright/mechanics/equilibrium/large_deformation_problem.h"
#include "wheelwright/mechanics/hyperelastic/hyperelastic_law.h"
#include "wheelwright/mechanics/state/strain_peaks.h"
#include "wheelwright/output/report/rolling_report.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"

namespace wheelwright {
namespace {

using std::numbers::pi;
using testing::all_states;
using testing::Hole;
using testing::paper_holes;
using testing::paper_model;

/// A case solved and analyzed.
struct Analyzed {
  std::shared_ptr<const RollingProblem<2>> problem;
  std::shared_ptr<const State<2>> state;
  RollingAnalysis analysis;
};

Analyzed analyzed(const RollingModel<2>& model, const std::vector<Hole>& holes) {
  auto problem = std::make_shared<const RollingProblem<2>>(*RollingProblem<2>::create(model));
  auto state = testing::all_states<2>(*problem, testing::holes(model.grid, 2, holes));
  auto analysis = rolling_analysis<2>(*problem, **state);
  return {std::move(problem), *std::move(state), std::move(analysis)};
}

RollingModel<2> coarse_model(int n_positions) {
  RollingModel<2> model = testing::paper_model(14, 192);
  model.n_positions = n_positions;
  return model;
}

const std::vector<Hole> no_holes, one_hole{{0.27, pi / 16, 0.036}};

std::vector<double> member(const std::vector<ContactSummary>& positions, double ContactSummary::*m) {
  std::vector<double> result;
  for (const ContactSummary& p : positions) result.push_back(p.*m);
  return result;
}

double relative_peak_to_peak(const std::vector<double>& values) {
  const RollingVariation v = rolling_variation(values);
  return v.peak_to_peak() / v.mean;
}

// --- Harmonics -----------------------------------------------------------------------------------------

TEST(RollingVariation, KnowsTheAmplitudesOfAKnownSignal) {
  for (int n : {7, 16, 64}) {
    const std::vector<double> amplitudes{0.3, 0, 0.02};
    std::vector<double> values;
    for (int j = 0; j < n; ++j) {
      double value = 5;
      for (size_t k = 0; k < amplitudes.size(); ++k)
        value += amplitudes[k] * std::cos(2 * pi * (k + 1.0) * j / n + 0.7 + static_cast<double>(k));
      values.push_back(value);
    }
    const RollingVariation v = rolling_variation(values);
    EXPECT_NEAR(v.mean, 5, 1e-14);
    ASSERT_EQ(v.harmonics.size(), size_t(n - 1) / 2);
    for (size_t k = 0; k < v.harmonics.size(); ++k)
      EXPECT_NEAR(v.harmonics[k], k < amplitudes.size() ? amplitudes[k] : 0, 1e-14);
    EXPECT_EQ(v.peak_to_peak(), *std::ranges::max_element(values) - *std::ranges::min_element(values));
  }
}

TEST(RollingVariation, OneOrTwoValuesHaveNoHarmonics) {
  EXPECT_TRUE(rolling_variation(std::vector<double>{3}).harmonics.empty());
  EXPECT_TRUE(rolling_variation(std::vector<double>{3, 4}).harmonics.empty());
}

// --- The plain ring ------------------------------------------------------------------------------------

/// Hertz's pressure on a patch of half-width a about c at points a distance h apart.
ContactPatch<2> hertz_patch(double a, double c, double h) {
  ContactPatch<2> patch{};
  for (double x = -2 * a; x < 2 * a; x += h) {
    const double s = (x - c) / a, p = std::abs(s) < 1 ? std::sqrt(1 - s * s) : 0;
    patch.points.push_back({});
    patch.points.back().position = {0, x};
    patch.points.back().weight = h;
    patch.points.back().augmented = {p > 0 ? -p : 0.1 * (std::abs(s) - 1), 0};
    patch.points.back().traction = {-p, 0};
  }
  return patch;
}

TEST(Analysis, PatchEndsWhereSquaredPressureVanishes) {
  for (const double points : {20, 37, 80})
    EXPECT_NEAR(contact_summary(hertz_patch(6e-3, 0.3e-3, 12e-3 / points)).patch_length, 12e-3, 0.002 * 12e-3)
        << points;
  EXPECT_EQ(contact_summary(ContactPatch<2>{}).patch_length, 0);
}

/// Hertz's pressures on two patches with half-widths a and b and a gap about 0 between them.
ContactPatch<2> two_patches(double a, double b, double gap, double h) {
  ContactPatch<2> patch{};
  for (double x = -3 * a - gap; x < 3 * b + gap; x += h) {
    const double s = x < 0 ? (x + a + 0.5 * gap) / a : (x - b - 0.5 * gap) / b;
    const double p = std::abs(s) < 1 ? std::sqrt(1 - s * s) : 0;
    patch.points.push_back({});
    patch.points.back().position = {0, x};
    patch.points.back().weight = h;
    patch.points.back().augmented = {p > 0 ? -p : 0.1 * (std::abs(s) - 1), 0};
    patch.points.back().traction = {-p, 0};
  }
  return patch;
}

TEST(Analysis, PatchLengthExcludesGaps) {
  const double a = 6e-3, b = 3e-3;
  for (const double gap : {8e-3, 1e-3}) {
    const ContactSummary found = contact_summary(two_patches(a, b, gap, 0.1e-3));
    EXPECT_NEAR(found.patch_length, 2 * a + 2 * b, 0.01 * a);
    EXPECT_NEAR(found.patch_extent, 2 * a + 2 * b + gap, 0.01 * a);
  }
  const ContactSummary one = contact_summary(hertz_patch(a, 0, 0.1e-3));
  EXPECT_EQ(one.patch_length, one.patch_extent);
}

// Strains by their principal values and axes, turned.
TEST(Analysis, PrincipalStrainsAreTheEigenvalues) {
  const double a = 0.03, b = -0.01, angle = 0.7, c = std::cos(angle), s = std::sin(angle);
  const double plane[3] = {a * c * c + b * s * s, a * s * s + b * c * c, 2 * (a - b) * c * s};
  auto found = principal_strains<2>(plane, -0.5 * (a + b));
  std::ranges::sort(found);
  EXPECT_NEAR(found[0], -0.01, 1e-15);
  EXPECT_NEAR(found[1], -0.01, 1e-15);
  EXPECT_NEAR(found[2], 0.03, 1e-15);
  // The same in space, about the first axis: the shear strains are 23, 13, 12.
  const double space[6] = {0.02, plane[0], plane[1], plane[2], 0, 0};
  found = principal_strains<3>(space, 0);
  std::ranges::sort(found);
  EXPECT_NEAR(found[0], -0.01, 1e-12);
  EXPECT_NEAR(found[1], 0.02, 1e-12);
  EXPECT_NEAR(found[2], 0.03, 1e-12);
}

// Of a mirror-symmetric wheel one of each pair of positions is solved; its analysis is that of all.
TEST(Analysis, SolvedPositionsRepresentAll) {
  auto model = paper_model(14, 192);
  model.contact.friction = 0.3;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = paper_holes(model.grid);
  const auto solved = problem->distinct_positions(psi);
  ASSERT_LT(solved.size(), model.n_positions);
  const auto some = problem->states(psi, solved, Interrupt());
  const auto all = problem->states(psi, problem->all_positions(), Interrupt());
  ASSERT_TRUE(some && all);
  const auto a = rolling_analysis<2>(*problem, **some), b = rolling_analysis<2>(*problem, **all);
  ASSERT_TRUE(a.travel_at_load && b.travel_at_load && a.force_at_travel && b.force_at_travel);
  EXPECT_NEAR(a.load, b.load, 1e-9 * b.load);
  EXPECT_NEAR(a.travel, b.travel, 1e-9 * b.travel);
  const auto expect_same = [&](const std::vector<double>& one, const std::vector<double>& other) {
    ASSERT_EQ(one.size(), size_t(model.n_positions));
    EXPECT_LT(testing::relative_difference(one, other), 1e-7);
  };
  for (const auto values : {&RollingAnalysis::azimuths, &RollingAnalysis::strain_energy,
                            &RollingAnalysis::peak_von_mises, &RollingAnalysis::peak_strain})
    expect_same(a.*values, b.*values);
  for (const auto values : {&RollingAnalysis::travel_at_load, &RollingAnalysis::force_at_travel})
    expect_same(*(a.*values), *(b.*values));
  const auto errors = [](const RollingAnalysis& analysis) {
    std::vector<double> result;
    for (const PositionDeformation& position : analysis.deformations)
      result.push_back(position.neglected.size());
    return result;
  };
  expect_same(errors(a), errors(b));
  double friction = 0;
  for (int i = 0; i < model.n_positions; ++i) {
    const ContactSummary &one = a.positions[i], &other = b.positions[i];
    EXPECT_NEAR(one.peak_pressure, other.peak_pressure, 1e-7 * other.peak_pressure);
    EXPECT_NEAR(one.peak_friction, other.peak_friction, 1e-7 * other.peak_pressure);
    EXPECT_NEAR(one.friction_force, other.friction_force, 1e-7 * other.radial_force);
    friction = std::max(friction, std::abs(other.friction_force) / other.radial_force);
  }
  EXPECT_GT(friction, 1e-4);  // so that its sign counts
}

// A rigid turn of the material inside the rim is what the rotation measures; the paper's wheel turns little.
TEST(Analysis, DeformationOfThePapersWheelIsSmall) {
  auto model = paper_model(14, 192);
  // The slope in the patch, its half-width by the radius, grows with the root of the load: it is not
  // resolved.
  model.dilatation = DilatationKind::pointwise;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = paper_holes(model.grid);
  const auto state = all_states<2>(*problem, psi);
  ASSERT_TRUE(state);
  const DeformationSize size = deformation_size<2>(*problem, psi, **state);
  EXPECT_FALSE(size.edges_overlap);
  EXPECT_EQ(deformation_warning(size), "");
  EXPECT_EQ(size.strain, std::ranges::max((*state)->strain_peaks().principal));
  // Twice the load deforms nearly twice as much: only the contact is not linear.
  auto doubled = model;
  doubled.load *= 2;
  const auto other = RollingProblem<2>::create(doubled);
  const auto more = all_states<2>(*other, psi);
  const DeformationSize twice = deformation_size<2>(*other, psi, **more);
  EXPECT_NEAR(twice.rotation / size.rotation, 2, 0.2);
  EXPECT_NEAR(twice.travel / size.travel, 2, 0.1);
  EXPECT_NEAR(twice.error.size() / size.error.size(), 2, 0.2);
}

TEST(Analysis, RingRunsTrueAtThePositionsOfColumns) {
  const auto [problem, state, a] = analyzed(coarse_model(12), no_holes);
  EXPECT_LT(relative_peak_to_peak(*a.travel_at_load), 1e-9);
  EXPECT_LT(relative_peak_to_peak(*a.force_at_travel), 1e-9);
  EXPECT_LT(relative_peak_to_peak(member(a.positions, &ContactSummary::peak_pressure)), 1e-9);
  EXPECT_LT(relative_peak_to_peak(a.peak_von_mises), 1e-9);
  EXPECT_LT(relative_peak_to_peak(a.strain_energy), 1e-9);
}

/// Seven positions a column, all harmonics of a sector but those of a column vanish.
TEST(Analysis, BetweenColumnsRunOutIsGridError) {
  std::vector<double> run_out;
  for (int refinement : {1, 2}) {
    RollingModel<2> model = testing::paper_model(14 * refinement, 192 * refinement);
    const int columns = model.grid.columns();
    model.n_positions = 7 * columns;
    const auto [problem, state, a] = analyzed(model, no_holes);
    const RollingVariation travel = rolling_variation(*a.travel_at_load);
    run_out.push_back(travel.peak_to_peak() / travel.mean);
    for (size_t k = 0; k < travel.harmonics.size(); ++k)
      if ((static_cast<int>(k) + 1) % columns != 0) {
        EXPECT_LT(travel.harmonics[k], 1e-9 * travel.mean);
      }
  }
  RecordProperty("run_out", std::to_string(run_out[0]) + " " + std::to_string(run_out[1]));
  EXPECT_LT(run_out[0], 0.02);
  EXPECT_GT(std::log2(run_out[0] / run_out[1]), 1.5);
}

// --- Identities ----------------------------------------------------------------------------------------

TEST(Analysis, MirrorSymmetricShapeGivesMirrorSymmetricCurves) {
  const int n = 10;
  const auto [problem, state, a] = analyzed(coarse_model(n), one_hole);
  for (int i = 1; i < n; ++i) {
    EXPECT_NEAR((*a.travel_at_load)[i] / (*a.travel_at_load)[n - i], 1, 1e-9);
    EXPECT_NEAR((*a.force_at_travel)[i] / (*a.force_at_travel)[n - i], 1, 1e-9);
    EXPECT_NEAR(a.positions[i].peak_pressure / a.positions[n - i].peak_pressure, 1, 1e-9);
    EXPECT_NEAR(a.positions[i].patch_length / a.positions[n - i].patch_length, 1, 1e-9);
    EXPECT_NEAR(a.peak_von_mises[i] / a.peak_von_mises[n - i], 1, 1e-9);
  }
}

TEST(Analysis, TravelOfALoadNeedsThatForce) {
  const RollingModel<2> model = coarse_model(6);
  const auto [problem, state, a] = analyzed(model, one_hole);
  for (size_t i = 0; i < a.positions.size(); ++i) {
    EXPECT_NEAR(a.positions[i].radial_force / model.load, 1, 1e-9);
    RollingModel<2> held = model;
    held.travel = a.positions[i].travel;
    const auto rolled = state->contacts_under(std::span(&held, 1), {}).front();
    ASSERT_TRUE(rolled);
    EXPECT_NEAR(contact_summary((*rolled)[i]).radial_force / model.load, 1, 1e-9);
  }
}

TEST(Analysis, FixedTravelAndLoadGiveTheSameCurves) {
  RollingModel<2> model = coarse_model(6);
  const auto loaded = analyzed(model, one_hole);
  EXPECT_EQ(loaded.analysis.held, Held::load);
  model.travel = loaded.analysis.travel;
  const auto held = analyzed(model, one_hole);
  EXPECT_EQ(held.analysis.held, Held::travel);
  EXPECT_LT(testing::relative_difference(*held.analysis.force_at_travel, *loaded.analysis.force_at_travel),
            1e-9);
  const std::vector<double> load{held.analysis.load};
  const auto again = under_loads<2>(*loaded.state, load);
  ASSERT_TRUE(again[0]);
  EXPECT_LT(
      testing::relative_difference(*held.analysis.travel_at_load, member(*again[0], &ContactSummary::travel)),
      1e-9);
}

TEST(Analysis, LoadsAgreeWithSolvingAfresh) {
  const RollingModel<2> model = coarse_model(4);
  const auto base = analyzed(model, one_hole);
  // Up to a load whose contact leaves the zone of the first one.
  const std::vector<double> loads{0.1 * model.load, model.load, 20 * model.load};
  const auto curve = under_loads<2>(*base.state, loads);
  for (size_t k = 0; k < loads.size(); ++k) {
    ASSERT_TRUE(curve[k]);
    RollingModel<2> other = model;
    other.load = loads[k];
    const auto fresh = analyzed(other, one_hole);
    for (auto m : {&ContactSummary::travel, &ContactSummary::radial_force, &ContactSummary::peak_pressure,
                   &ContactSummary::patch_length})
      EXPECT_LT(testing::relative_difference(member(*curve[k], m), member(fresh.analysis.positions, m)),
                1e-9);
  }
}

/// The stiffnesses under a load against differences of the loads and travels around it.
void expect_tangent_stiffness(const State<2>& state, double load) {
  constexpr double step = 1e-5;  // rarely is there a load at which a point comes to touch in it
  const std::vector<double> loads{(1 - step) * load, load, (1 + step) * load};
  const auto curve = under_loads<2>(state, loads);
  for (const auto& of_load : curve) ASSERT_TRUE(of_load) << of_load.failure().detail;
  double mean = 0;
  for (size_t i = 0; i < curve[1]->size(); ++i) {
    const double travels = (*curve[2])[i].travel - (*curve[0])[i].travel;
    ASSERT_TRUE((*curve[1])[i].stiffness);
    EXPECT_NEAR(*(*curve[1])[i].stiffness * travels / (loads[2] - loads[0]), 1, 1e-5);
    mean += travels / static_cast<double>(curve[1]->size());
  }
  EXPECT_NEAR(*tangent_stiffness(*curve[1]) * mean / (loads[2] - loads[0]), 1, 1e-5);
}

// On a wheel without symmetry with friction and a force along the ground.
TEST(Analysis, TangentStiffnessIsTheDerivativeOfTheLoadByTheTravel) {
  RollingModel<2> model = coarse_model(3);
  model.contact.friction = 0.4;
  model.horizontal_force = 0.1 * model.load;
  const std::vector<Hole> holes{{0.2513, 0.04 * pi / 8, 0.0213}, {0.2731, 0.53 * pi / 8, 0.0267}};
  expect_tangent_stiffness(*analyzed(model, holes).state, 1.5 * model.load);
  model.materials = Materials<2>(std::make_shared<HyperelasticLaw<2>>(Material{8e6, 0.48}));
  model.contact.theta_nitsche = 0;
  model.contact.gamma_0 = 20;
  const auto problem = *LargeDeformationProblem<2>::create(model);
  const auto state = testing::all_states<2>(problem, testing::holes(model.grid, 2, holes));
  ASSERT_TRUE(state) << state.failure().detail;
  expect_tangent_stiffness(**state, 1.5 * model.load);
}

// --- Physics -------------------------------------------------------------------------------------------

/// Nothing but the ghost penalty and Nitsche's terms take work that is not strain energy.
TEST(Analysis, WorkOfTheLoadIsTheStrainEnergy) {
  RollingModel<2> model = coarse_model(2);
  model.tread.levels = 2;
  const auto [problem, state, a] = analyzed(model, one_hole);
  const int n = 200;
  std::vector<double> loads;
  for (int k = 1; k <= n; ++k) loads.push_back(k * model.load / n);
  const auto curve = under_loads<2>(*state, loads);
  for (const auto& of_load : curve) ASSERT_TRUE(of_load);
  for (size_t i = 0; i < a.positions.size(); ++i) {
    double work = 0, travel = 0;
    for (int k = 0; k < n; ++k) {
      const double next = (*curve[k])[i].travel;
      work += (loads[k] - 0.5 * model.load / n) * (next - travel);
      travel = next;
    }
    EXPECT_NEAR(work / a.strain_energy[i], 1, 5e-3);
  }
}

/// Hertz: the patch of a disc grows with the root of the load, and so does the peak pressure.
TEST(Analysis, PatchAndPressureOfAThickRingGrowAsHertzSays) {
  RollingModel<2> model = coarse_model(1);
  model.tread.levels = 5;
  const auto [problem, state, a] = analyzed(model, no_holes);
  const std::vector<double> loads{0.25 * model.load, model.load};
  const auto curve = under_loads<2>(*state, loads);
  ASSERT_TRUE(curve[0] && curve[1]);
  const ContactSummary &quarter = (*curve[0])[0], &whole = (*curve[1])[0];
  EXPECT_NEAR(whole.patch_length / quarter.patch_length, 2, 0.02);
  EXPECT_NEAR(whole.peak_pressure / quarter.peak_pressure, 2, 0.04);
  const double half_width = 2 * std::sqrt(model.load * model.grid.outer_radius /
                                          (pi * model.materials.at_tread().contact_modulus()));
  EXPECT_NEAR(whole.patch_length / (2 * half_width), 1, 0.02);
  EXPECT_NEAR(whole.peak_pressure / (2 * model.load / (pi * half_width)), 1, 0.02);
}

/// Strain and rotation by differences of the displacement field at the quadrature points of whole cells. The
/// stress of a projected dilatation belongs to a cell and is no function of the strain at a point.
TEST(Analysis, PeaksAreThoseOfTheDisplacementField) {
  RollingModel<2> model = coarse_model(3);
  model.dilatation = DilatationKind::pointwise;
  const auto [problem, state, a] = analyzed(model, no_holes);
  const Lattice<2> lattice(model.grid, model.degree);
  const auto points = unit_cell_rule<2>(model.degree + 1);
  for (int position = 0; position < 3; ++position) {
    const RingField field = state->displacement().at_nodes(position);
    double peak = 0, rotation = 0;
    for (int sector = 0; sector < model.grid.n_sectors; ++sector)
      for (int cell = 0; cell < model.grid.n_cells(); ++cell) {
        const auto c = model.grid.cell_position(cell);
        const CellMap<2> map(model.grid, model.degree, c);
        const auto nodes = ring_cell_nodes<2>(lattice, {c[0], c[1] + sector * model.grid.columns()});
        const int n_nodes = nodes_per_cell<2>(model.degree);
        for (const auto& q : points) {
          Mat<2> gradient{}, jacobian{};  // by xi
          for (int g = 0; g < 2; ++g) {
            Vec<2> ahead = q.xi, back = q.xi;
            const double h = 1e-3;  // exact for polynomials of degree 2
            ahead[g] += h;
            back[g] -= h;
            const ShapeFunctions<2> to(model.degree, ahead), from(model.degree, back);
            const Vec<2> x = map.position(to), y = map.position(from);
            const double angle = sector * model.grid.sector_angle() +
                                 model.grid.cell_position(cell)[1] * model.grid.column_angle();
            Vec<2> du{};
            for (int d = 0; d < 2; ++d)
              du[d] = (interpolate(field, nodes, std::span(to.value).first(n_nodes), d) -
                       interpolate(field, nodes, std::span(from.value).first(n_nodes), d)) /
                      (2 * h);
            du = rotated<2>(du, -angle);
            for (int d = 0; d < 2; ++d) {
              jacobian[d][g] = (x[d] - y[d]) / (2 * h);
              gradient[d][g] = du[d];
            }
          }
          const double det = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
          const Mat<2> inverse{
              {{jacobian[1][1] / det, -jacobian[0][1] / det}, {-jacobian[1][0] / det, jacobian[0][0] / det}}};
          Mat<2> du{};
          for (int d = 0; d < 2; ++d)
            for (int e = 0; e < 2; ++e)
              for (int g = 0; g < 2; ++g) du[d][e] += gradient[d][g] * inverse[g][e];
          const Voigt<2> strain{du[0][0], du[1][1], du[0][1] + du[1][0]};
          peak = std::max(peak, testing::von_mises<2>(*model.materials.at_tread().isotropic(),
                                                      stress<2>(model.materials.at_tread(), strain)));
          rotation = std::max(rotation, 0.5 * std::abs(du[1][0] - du[0][1]));
        }
      }
    EXPECT_NEAR(a.peak_von_mises[position] / peak, 1, 1e-8);
    EXPECT_NEAR(a.deformations[position].largest_rotation / rotation, 1, 1e-8);
  }
}

// --- Report --------------------------------------------------------------------------------------------

TEST(Report, TheTableShowsEveryPositionsNumbers) {
  const RollingModel<2> model = coarse_model(5);
  auto [problem, state, a] = analyzed(model, one_hole);
  std::istringstream table(rolling_table({"wheel", 1, 16, a, {}, {}}));
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(table, line);) {
    std::istringstream cells(line);
    std::vector<double> row;
    for (double x; cells >> x;) row.push_back(x);
    if (row.size() == 8) rows.push_back(row);
  }
  ASSERT_EQ(rows.size(), 5u);
  for (size_t i = 0; i < 5; ++i) {
    const ContactSummary& p = a.positions[i];
    const std::vector<double> expected{a.azimuths[i] * 180 / std::numbers::pi,
                                       p.radial_force / p.travel * 1e-3,
                                       p.peak_pressure * 1e-6,
                                       p.patch_length * 1e3,
                                       a.peak_von_mises[i] * 1e-6,
                                       a.strain_energy[i],
                                       (*a.travel_at_load)[i] * 1e3,
                                       (*a.force_at_travel)[i]};
    for (size_t k = 0; k < 8; ++k) EXPECT_NEAR(rows[i][k], expected[k], k == 1 || k == 7 ? 6e-3 : 6e-4) << k;
  }
  EXPECT_GT(std::abs(a.peak_von_mises[2] - a.peak_von_mises[0]), 1e4);  // which the table can tell apart
}

TEST(Report, JsonReadsBackToTheSameNumbers) {
  const RollingModel<2> model = coarse_model(5);
  auto [problem, state, a] = analyzed(model, one_hole);
  const std::vector<double> loads{0.5 * model.load, 2 * model.load};
  const auto curve = under_loads<2>(*state, loads);
  const RollingReport report{"a \"wheel\"", 1, 16, a, loads, curve};
  const auto json = nlohmann::json::parse(rolling_json(report));
  EXPECT_EQ(json["title"], report.title);
  ASSERT_EQ(json["positions"].size(), 5u);
  for (size_t i = 0; i < 5; ++i) {
    const auto& position = json["positions"][i];
    EXPECT_EQ(position["azimuth_rad"], a.azimuths[i]);
    EXPECT_EQ(position["travel_m"], a.positions[i].travel);
    EXPECT_EQ(position["force_at_travel_N"], (*a.force_at_travel)[i]);
    EXPECT_EQ(position["peak_von_mises_Pa"], a.peak_von_mises[i]);
    EXPECT_EQ(position["stiffness_N_per_m"], a.positions[i].radial_force / a.positions[i].travel);
    EXPECT_EQ(position["friction_force_N"], a.positions[i].friction_force);
    EXPECT_EQ(position["peak_friction_Pa"], a.positions[i].peak_friction);
    EXPECT_EQ(position["travel_along_ground_m"], a.positions[i].travel_along_ground);
    EXPECT_EQ(position["wind_up_rad"], a.positions[i].wind_up);
    const PositionDeformation& deformation = a.deformations[i];
    EXPECT_EQ(position["largest_rotation_rad"], deformation.largest_rotation);
    EXPECT_EQ(position["root_mean_strain"], deformation.root_mean_strain);
    EXPECT_EQ(position["linear_theory_error"], deformation.neglected.size());
    EXPECT_EQ(position["linear_theory"]["of_rotation"], deformation.neglected.of_rotation);
  }
  const RollingVariation travel = rolling_variation(*a.travel_at_load);
  EXPECT_EQ(json["travel_at_load_m"]["mean"], travel.mean);
  ASSERT_EQ(json["travel_at_load_m"]["harmonics"].size(), travel.harmonics.size());
  EXPECT_EQ(json["travel_at_load_m"]["harmonics"][1]["waves_per_revolution"], 32);
  EXPECT_EQ(json["travel_at_load_m"]["harmonics"][1]["amplitude"], travel.harmonics[1]);
  ASSERT_EQ(json["loads"].size(), 2u);
  EXPECT_EQ(json["loads"][1]["load_N"], loads[1]);
  EXPECT_EQ(json["loads"][1]["positions"][3]["travel_m"], (*curve[1])[3].travel);
  EXPECT_EQ(json["loads"][1]["positions"][3]["tangent_stiffness_N_per_m"], *(*curve[1])[3].stiffness);
  EXPECT_EQ(json["loads"][1]["tangent_stiffness_N_per_m"], *tangent_stiffness(*curve[1]));
}

// What a second solve would give is missing; everything else is there.
TEST(Report, MissingForceAtFixedTravelLeavesTheRest) {
  const RollingModel<2> model = coarse_model(5);
  auto [problem, state, a] = analyzed(model, one_hole);
  const Failure failure{FailureReason::newton_stalled, "on purpose"};
  a.force_at_travel = failure;
  const std::vector<double> loads{model.load, 2 * model.load};
  std::vector<Expected<std::vector<ContactSummary>>> curve = under_loads<2>(*state, loads);
  curve[0] = failure;
  const RollingReport report{"", 1, 16, a, loads, curve};
  const auto json = nlohmann::json::parse(rolling_json(report));
  EXPECT_TRUE(json["force_at_travel_N"].is_null());
  EXPECT_TRUE(json["positions"][2]["force_at_travel_N"].is_null());
  EXPECT_EQ(json["positions"][2]["travel_at_load_m"], (*a.travel_at_load)[2]);
  EXPECT_EQ(json["missing"]["force_at_travel_N"], "newton_stalled: on purpose");
  EXPECT_EQ(json["loads"][0]["missing"], "newton_stalled: on purpose");
  EXPECT_EQ(json["loads"][1]["positions"][3]["travel_m"], (*curve[1])[3].travel);
  const std::string table = rolling_table(report);
  EXPECT_NE(table.find("newton_stalled: on purpose"), std::string::npos);
  EXPECT_EQ(load_plot(report).curves[1].x.size(), 2u);  // zero and the load that was solved
}

TEST(Report, ForcesAreOnTheWholeWidth) {
  const RollingModel<2> model = coarse_model(2);
  const auto [problem, state, a] = analyzed(model, one_hole);
  const auto json = nlohmann::json::parse(rolling_json({"", 0.12, 16, a, {}, {}}));
  EXPECT_NEAR(double(json["load_N"]) / (0.12 * model.load), 1, 1e-14);
  EXPECT_NEAR(double(json["positions"][0]["radial_force_N"]) / (0.12 * model.load), 1, 1e-9);
  EXPECT_FALSE(json.contains("loads"));
}

TEST(Report, CurvesOfASectorAreClosed) {
  const auto [problem, state, a] = analyzed(coarse_model(6), one_hole);
  const RollingReport report{"", 0.12, 16, a, {}, {}};
  for (const LinePlot& plot : {travel_plot(report), force_plot(report), peak_pressure_plot(report)}) {
    ASSERT_EQ(plot.curves.size(), 1u);
    EXPECT_EQ(plot.curves[0].y.front(), plot.curves[0].y.back());
    EXPECT_NEAR(plot.curves[0].x.back() - plot.curves[0].x.front(), 22.5, 1e-12);
  }
}

}  // namespace
}  // namespace wheelwright
