#pragma once

#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/mechanics/elasticity/orthotropic_material.h"
#include "wheelwright/shape/geometry/bands.h"
#include "wheelwright/shape/geometry/invariance.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {

// Numbers derived from a case without solving. Per metre of width.

/// The case with one of its load cases, counted from 0, as its only load.
Case with_load_case(Case c, int load_case);

/// The case with each of its load cases as the only load, in their order; itself if it has only one load.
std::vector<Case> single_load_cases(const Case& c);

/// The load cases of a constraint, by their numbers: that of its name, or all.
std::vector<int> load_cases_of(const Case& c, const Constraint& constraint);

/// The load case that an expectation is about: the first one, unless it names another.
int load_case_of(const Case& c, const Expectation& expectation);

// Numbers that depend on a load are those of the section [load], unless stated otherwise.

/// P [N/m].
double load_per_metre(const Case& c);

/// E* of Hertz's theory [Pa]: that of the material, or with layers an estimate (contact_modulus()) at the
/// half-width to which it leads.
double effective_contact_modulus(const Case& c);

/// R in Hertz's theory: 1/R = 1/R_e + 1/R_g with the ground's radius R_g where the wheel stands, negative
/// inside a drum; on edges, a fifth of R_e [m].
double contact_radius(const Case& c);

/// a = 2 sqrt(P R / (pi E*)) [m]: half the contact patch of a solid disc under the load, as an estimate for
/// the wheel.
double hertz_half_width(const Case& c);

/// p_0 = 2 P / (pi a) [Pa].
double hertz_peak_pressure(const Case& c);

/// Half of the likely contact patch [m]: Hertz's under a load, and an estimate from the travel if that is
/// given; half the circumference if the tread is bonded.
double likely_half_width(const Case& c);

/// The method of the case, or the one required by its volume and velocity; never automatic.
OptimizerMethod optimizer_method(const Case& c);

/// The relative gain below which a search has converged; 0: it never has.
double convergence_tolerance(const Case& c);

/// The kind of the velocity, which is not `automatic`.
VelocityKind velocity_kind(const Case& c);

/// The number of cells over which h1 and vector smooth the motion of the boundary.
double velocity_length(const Case& c);

/// Degree of the level set: the case's own, or 2.
int level_set_degree(const Case& c);

/// Halvings of the cells at the tread in a run and in results: the case's own, or as many as give 8 and 36
/// cells across the likely contact patch under every load case, as far as the number of contact points stays
/// reasonable; in 3D, where they are far more, none.
int tread_levels(const Case& c);
int tread_levels_of_results(const Case& c);

/// The case with the levels of its results.
Case with_levels_of_results(Case c);

/// Arc length of the smallest cells, at the tread [m].
double tread_cell_width(const Case& c);

/// Cells on the tread under the Hertz patch 2a.
double cells_per_contact_patch(const Case& c);

/// Contact pressures are not resolved with fewer cells per patch than this.
inline constexpr double least_cells_per_contact_patch = 6;

/// The share of the rolling resistance that the load positions do not resolve, as an estimate: that of a
/// half-plane under Hertz's pressure on the likely contact patch, whose harmonics above N / 2 have the share
/// 3 / 8 (2 R_e / (N a))^2, with N positions around the wheel; at most 1.
double unresolved_losses(const Case& c);

/// The frequencies at which the material of a rolling wheel is strained [Hz].
struct StrainFrequencies {
  double turn;     ///< v / (2 pi R_e)
  double contact;  ///< below which three quarters of the losses of a Hertzian contact are: v / (4 a)
  double last;     ///< of the last harmonic that the load positions resolve
};
StrainFrequencies strain_frequencies(const Case& c);

/// The least load.positions that leave at most this share.
int positions_for_losses(const Case& c, double share);

/// Width of the smallest hole in units of the longer cell edge at mid-ring; infinite without holes.
double smallest_hole_in_cells(const Case& c);

/// Smaller holes fray in an optimization without smoothing.
inline constexpr double least_cells_per_hole = 10;

/// 2 pi / N_s [rad].
double sector_angle(const Case& c);

/// N_l = N_d N_s: load positions of the full wheel.
int total_load_positions(const Case& c);

/// Number of radial cells of the annulus of J_p1, condensed once per run; 1 without that functional.
int tread_rows(const Case& c);

/// Whether the gradient of a minimized or bounded function has the kinks of the moving boundary.
bool optimizes_edges(const Case& c);

/// Whether the tractions in the annulus of J_p1 are observed.
bool wants_annulus(const Case& c);

/// Whether the objective is the weighted sum.
bool minimizes_weighted_sum(const Case& c);

/// Whether the volume is fixed: not if it is bounded or minimized.
bool holds_volume(const Case& c);

/// Whether integrals of stresses over the material are minimized or bounded.
bool optimizes_stresses(const Case& c);

/// Whether a temperature is minimized or bounded.
bool optimizes_temperatures(const Case& c);

/// Whether any functional compares the contact stress of the load positions.
bool wants_uniformity(const Case& c);

/// epsilon and L of the uniformity functionals [m].
double annulus_thickness(const Case& c);
double characteristic_length(const Case& c);

/// One sector of the grid; with dim = 2 in the plane of the wheel.
template <int dim>
PolarGrid<dim> polar_grid(const Case& c);

/// The annuli of the layers without holes, from the rim to the tread; neighbours are one.
std::vector<SolidAnnulus> solid_layers(const Case& c);

/// The bands that stay material. By default they are 1/14 of the ring's thickness, whatever the grid; at the
/// tread also at least 1/28 of it thicker than the annulus of J_p1. The outermost rows of cells must be full
/// because they are condensed once per run, and the row below them because it carries the ghost penalty of
/// the cut cells.
Bands bands(const Case& c);

/// The radii [m] between the bands, where holes may be.
HoleRange free_region(const Case& c);

/// The same, but holes may touch the bands: a shift by a thousandth of a cell is negligible.
HoleRange room_for_holes(const Case& c);

/// Whether the initial shape differs from the full ring.
bool has_holes(const Case& c);

/// The holes of one sector, from `[[holes.ring]]` and `[[holes.circle]]`; those of the other sectors are
/// their rotations. A hole may lie in any sector and cross the interfaces between sectors.
std::vector<Circle> sector_holes(const Case& c);

/// The holes of one sector that exist only in 3D.
std::vector<Sphere> sector_spheres(const Case& c);
/// The grooves of all side faces.
std::vector<Groove> grooves(const Case& c);
/// At its inner or its outer side [m].
double largest_depth(const HoleGroove& groove);
/// The radius of the largest fillet that a groove has room for [m].
double largest_fillet(const HoleGroove& groove);
/// What the way of making the wheel asks of its shapes.
Invariance invariance(const Case& c);

/// That of a moulded wheel.
std::optional<Mould> mould(const Case& c);

/// That of a printed wheel.
std::optional<Print> print(const Case& c);
std::vector<TaperedHole> sector_tapered_holes(const Case& c);

/// Nodes of the displacement along the axle: 1 in 2D.
long long axial_nodes(const Case& c);

/// Number of displacement unknowns of the full ring if every cell held material: an upper bound. Including
/// those of fixed rims and side faces.
long long dof_bound(const Case& c);

/// The minimum gamma_0 for which Nitsche's method is safe with this theta and material. At nu = 0.48 in plane
/// strain it is 0 for theta = -1, about 10 for theta = 0 and 100 for theta = 1. In between it is
/// 10 (1 + theta)^2 for the lack of symmetry plus 60 theta for the indefinite boundary term, scaled by
/// (lambda + 2 mu) / E with E = Material::scaling_modulus(). In nearly incompressible material, whose
/// elements project the pressure, that scale stays what it is at nu = 0.485 if theta <= 0. `aspect`: of the
/// cells at the tread, length along it by height: gamma refers to their diameter, but what bounds the
/// tractions is the height.
double minimum_gamma_0(double theta, const Material& material, double aspect = 1);
/// The same by the stiffness along the radius.
double minimum_gamma_0(double theta, const OrthotropicMaterial& material, double aspect = 1);

/// The aspect of a case's cells at the tread.
double tread_cell_aspect(const Case& c);

}  // namespace wheelwright
