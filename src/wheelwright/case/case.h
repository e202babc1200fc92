#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wheelwright/cad/drawing/fill.h"
#include "wheelwright/case/own_load.h"
#include "wheelwright/mechanics/elasticity/contact_form.h"
#include "wheelwright/mechanics/elasticity/dilatation.h"
#include "wheelwright/mechanics/elasticity/dual_norm.h"
#include "wheelwright/mechanics/elasticity/ghost_penalty.h"
#include "wheelwright/mechanics/elasticity/material.h"
#include "wheelwright/mechanics/elasticity/side_faces.h"
#include "wheelwright/quantities/functionals/quantities.h"
#include "wheelwright/shape/geometry/level_set.h"
#include "wheelwright/shape/geometry/print.h"

namespace wheelwright {

struct Drawing;
struct Picture;

// A case: everything that defines one optimization, as plain data in SI units and radians. The initial values
// are the defaults of the case file; names, units, ranges and meanings are declared in case/*_keys.cc.

struct Wheel {
  int dimension = 2;           ///< 2: the plane of the wheel; 3: the whole width
  double inner_radius = 0.20;  ///< R_i, the rim
  double outer_radius = 0.34;  ///< R_e, the tread
  double width = 0.12;         ///< w_r, along the axle
  int sectors = 16;            ///< N_s
  SideFaces side_faces = SideFaces::free;
  bool operator==(const Wheel&) const = default;
};

/// The constants of a material whose axes are the radius, the azimuth and the axle, in place of those of an
/// isotropic one: OrthotropicMaterial. All are absent if the material is isotropic.
struct OrthotropicConstants {
  std::optional<double> youngs_modulus_radial, youngs_modulus_azimuthal, youngs_modulus_axial;  ///< [Pa]
  /// The first axis is that of the stress, the second that of the contraction.
  std::optional<double> poissons_ratio_radial_azimuthal, poissons_ratio_radial_axial,
      poissons_ratio_azimuthal_axial;
  std::optional<double> shear_modulus_radial_azimuthal;                             ///< [Pa]
  std::optional<double> shear_modulus_radial_axial, shear_modulus_azimuthal_axial;  ///< in 3D [Pa]
  bool operator==(const OrthotropicConstants&) const = default;
};

/// How a material responds to large strains; small_strain: linear elasticity.
enum class MaterialModel { small_strain, neo_hookean, saint_venant_kirchhoff, mooney_rivlin };

struct LargeStrainConstants {
  MaterialModel model = MaterialModel::small_strain;
  double second_share = 0;  ///< c2 / (c1 + c2) of Mooney and Rivlin's model
  bool operator==(const LargeStrainConstants&) const = default;
};

/// What a material bears over many turns: FatigueStrength.
struct FatigueConstants {
  FatigueMeasure fatigue_measure = FatigueMeasure::none;
  std::optional<double> fatigue_limit = {};            ///< [Pa, J/m^3]
  std::optional<double> fatigue_strain = {};           ///< the limit of principal_strain
  double fatigue_cycles = 1e6;                         ///< turns at the limit
  std::optional<double> fatigue_exponent = {};         ///< of the curve of Woehler
  std::optional<double> fatigue_pressure_factor = {};  ///< alpha of crossland and dang_van
  std::optional<double> ultimate_strength = {};        ///< of goodman [Pa]
  bool operator==(const FatigueConstants&) const = default;
};

/// What lies in no layer of the ring.
struct RingMaterial : Material, LargeStrainConstants, OrthotropicConstants, FatigueConstants {
  bool operator==(const RingMaterial&) const = default;
};

/// Whether holes may lie in a layer of the ring.
enum class LayerHoles { allowed, none };

/// Everything between two radii, of another material than the rest of the ring.
struct MaterialLayer : LargeStrainConstants, OrthotropicConstants, FatigueConstants {
  std::string name = {};
  std::optional<double> inner_radius = {};  ///< absent: the rim
  std::optional<double> outer_radius = {};  ///< absent: the tread
  double youngs_modulus = 200e6;            ///< [Pa]
  double poissons_ratio = 0.48;
  std::optional<double> density = {};  ///< [kg/m^3]
  std::optional<LossFactor> loss_factor = {};
  std::optional<double> conductivity = {};         ///< [W/(m K)]
  std::optional<double> maximum_temperature = {};  ///< [deg C]
  LayerHoles holes = LayerHoles::allowed;
  /// Between which the optimizer chooses its radii together with the shape; absent: they stay [m].
  std::optional<std::array<double, 2>> inner_radius_range = {}, outer_radius_range = {};
  bool operator==(const MaterialLayer&) const = default;
};

/// Thin cords side by side along a circle of the ring.
struct MaterialCord {
  double radius = 0.32;    ///< [m]
  double stiffness = 1e6;  ///< E A per width along the axle [N/m]
  bool operator==(const MaterialCord&) const = default;
};

/// One of several loads: the keys of the section [load] that it changes.
struct CaseLoad {
  std::string name = {};
  double weight = 1;                              ///< of its terms in the objective
  std::optional<double> distance_share = {};      ///< of the distance, driven under it
  std::optional<double> force = {}, travel = {};  ///< at most one of them
  std::optional<double> horizontal_force = {}, torque = {};
  std::optional<std::array<double, 2>> body_force = {};
  std::optional<double> hole_pressure = {}, speed = {};
  std::optional<std::string> ground = {};
  std::optional<double> ground_radius = {}, ground_height = {}, ground_place = {};
  std::vector<std::array<double, 2>> ground_profile = {};  ///< empty: unchanged
  std::vector<OwnValue<std::optional<double>>> own = {};   ///< empty, or in the order of Load::own
  bool operator==(const CaseLoad&) const = default;
};

struct Load {
  double force = 300 * 9.81;  ///< on the whole width [N]
  std::optional<double>
      travel;  ///< prescribed travel of the rim towards the ground [m]; if given, the force is a result
  double horizontal_force = 0;          ///< on the rim, towards larger azimuth, on the whole width [N]
  double lateral_force = 0;             ///< on the rim, towards larger z; in 3D [N]
  double camber = 0;                    ///< the side at larger z nearer to the ground; in 3D [rad]
  double torque = 0;                    ///< on the rim, towards larger azimuth, on the whole width [N m]
  std::array<double, 2> body_force{};   ///< along the ground towards larger azimuth, and down [N/m^3]
  double hole_pressure = 0;             ///< in the holes [Pa]
  double speed = 0;                     ///< of the axle along the ground, for the centrifugal load [m/s]
  std::string ground = "flat";          ///< its kind, one of ground_words
  std::optional<double> ground_radius;  ///< of a drum, a bar or the edge of a kerb [m]
  std::optional<double> ground_height;  ///< of a bar or a kerb above the level of the ground [m]
  double ground_place = 0;              ///< of a bar, a kerb or a profile, from below the axle [m]
  std::vector<std::array<double, 2>> ground_profile = {};  ///< [along, height], ascending [m]
  int positions = 8;                                       ///< N_d, load positions per sector
  std::vector<OwnValue<double>> own = {};                  ///< of the keys that a program adds
  std::vector<CaseLoad> cases = {};                        ///< empty: only this load
  bool operator==(const Load&) const = default;
};

/// How a rolling wheel gives its heat away: Cooling.
struct Heat {
  double ambient_temperature = 20;             ///< [deg C]
  std::optional<double> rim_temperature = {};  ///< absent: the rim is insulated [deg C]
  std::optional<double> convection = {};       ///< of all surfaces without a value of their own [W/(m^2 K)]
  std::optional<double> tread_convection = {}, hole_convection = {}, side_convection = {};
  bool operator==(const Heat&) const = default;
};

struct Contact {
  Counterpart with = Counterpart::ground;
  ContactMethod method = ContactMethod::nitsche;
  double theta = -1;
  double gamma_0 = 1;   ///< gamma = gamma_0 E / h_T [Pa/m]
  double friction = 0;  ///< Coulomb's coefficient F
  int quadrature_points = 5;
  bool operator==(const Contact&) const = default;
};

/// Equal holes, evenly spaced on a circle about the axle.
struct HoleRing {
  int count = 0;
  double center_radius = 0;
  double radius = 0;
  std::optional<double> phase = {};  ///< azimuth of the first hole's centre; absent: half the spacing
  bool operator==(const HoleRing&) const = default;
};

/// A hole that is repeated in every sector.
struct HoleCircle {
  std::array<double, 2> center{};  ///< one of its centres: Cartesian, body frame
  double radius = 0;
  bool operator==(const HoleCircle&) const = default;
};

/// Equal spherical holes, evenly spaced on a circle about the axle; in 3D.
struct HoleSphere {
  int count = 0;
  double center_radius = 0;
  double radius = 0;
  double z = 0;                      ///< of the centres, from the middle of the width
  std::optional<double> phase = {};  ///< as for a ring
  bool operator==(const HoleSphere&) const = default;
};

/// Equal round holes whose radius changes along the axle, evenly spaced on a circle about it; in 3D.
struct HoleTapered {
  int count = 0;
  double center_radius = 0;
  std::vector<std::array<double, 2>> profile;  ///< [z from the middle of the width, radius], z ascending
  std::optional<double> phase = {};            ///< as for a ring
  bool operator==(const HoleTapered&) const = default;
};

enum class GrooveSide { both, smaller_z, larger_z };

/// A groove around the axle in one or both side faces; in 3D.
struct HoleGroove {
  double inner_radius = 0;
  double outer_radius = 0;
  double depth = 0;
  std::optional<double> outer_depth = {};  ///< at its outer side, if its floor leans
  std::optional<double> fillet = {};       ///< radius of its inner corners; absent: half of what has room
  GrooveSide side = GrooveSide::both;
  bool operator==(const HoleGroove&) const = default;
};

struct Holes {
  std::vector<HoleRing> rings;
  std::vector<HoleCircle> circles;
  std::vector<HoleSphere> spheres;
  std::vector<HoleTapered> tapered;
  std::vector<HoleGroove> grooves;
  bool operator==(const Holes&) const = default;
};

// Shapes drawn over the ring, each over the earlier ones: `order` is a shape's position among all of them,
// from 1. Each is repeated `count` times, evenly spaced about the axle; `phase` is the azimuth of the first
// one, by default half the spacing.

struct CircleShape {
  int order = 0;
  Fill as = Fill::hole;
  int count = 0;
  double center_radius = 0;
  double radius = 0;
  std::optional<double> phase = {};
  bool operator==(const CircleShape&) const = default;
};

struct EllipseShape {
  int order = 0;
  Fill as = Fill::hole;
  int count = 0;
  double center_radius = 0;
  double length = 0;
  double width = 0;
  double angle = 0;  ///< of the length, from the direction away from the axle
  std::optional<double> phase = {};
  bool operator==(const EllipseShape&) const = default;
};

/// A rectangle with round ends.
struct SlotShape {
  int order = 0;
  Fill as = Fill::hole;
  int count = 0;
  double center_radius = 0;
  double length = 0;  ///< over all
  double width = 0;
  double angle = 0;  ///< of the length, from the direction away from the axle
  std::optional<double> phase = {};
  bool operator==(const SlotShape&) const = default;
};

struct PolygonShape {
  int order = 0;
  Fill as = Fill::hole;
  int count = 0;
  std::vector<std::array<double, 2>> points;  ///< corners of the first one: Cartesian, body frame
  double phase = 0;                           ///< by which all are turned
  bool operator==(const PolygonShape&) const = default;
};

/// Everything between two radii.
struct AnnulusShape {
  int order = 0;
  Fill as = Fill::hole;
  std::optional<double> inner_radius = {};  ///< absent: the edge of the rim's band
  std::optional<double> outer_radius = {};  ///< absent: the edge of the tread's band
  bool operator==(const AnnulusShape&) const = default;
};

enum class SpokeKind {
  straight,
  curved,  ///< a circular arc
  forked,  ///< two branches from a stem
  pair,    ///< two straight spokes, mirror images of each other
};

struct SpokeShape {
  int order = 0;
  Fill as = Fill::material;
  SpokeKind kind = SpokeKind::straight;
  int count = 0;
  double thickness = 0;
  double angle = 0;   ///< azimuth of the outer end minus that of the foot
  double bend = 0;    ///< by which a curved spoke turns towards larger azimuth on its way out
  double spread = 0;  ///< between the outer ends of a fork, or the feet of a pair
  std::optional<double> fork_radius = {};   ///< absent: the middle of the spoke
  std::optional<double> inner_radius = {};  ///< of the foot; absent: the rim
  std::optional<double> outer_radius = {};  ///< of the outer end; absent: the tread
  std::optional<double> phase = {};
  bool operator==(const SpokeShape&) const = default;
};

/// The contents of a file named in the case. Cases compare files by their checksums.
template <class Contents>
struct Loaded {
  std::shared_ptr<const Contents> contents;
  bool operator==(const Loaded&) const { return true; }
};

enum class DrawingUnit { of_file, metre, centimetre, millimetre, inch };

/// A drawing in a file of curves: SVG or DXF.
struct FileShape {
  int order = 0;
  Fill as = Fill::hole;
  std::string path;  ///< relative to the case's file
  DrawingUnit unit = DrawingUnit::of_file;
  std::optional<std::array<double, 2>> axle;  ///< in the drawing's own unit and axes
  int count = 1;
  double phase = 0;      ///< by which all are turned
  std::string checksum;  ///< of the file; never empty in a case that was read from a file
  Loaded<Drawing> drawing;
  bool operator==(const FileShape&) const = default;
};

enum class PictureLayout {
  wheel,   ///< the whole wheel as seen
  sector,  ///< one of `count` equal parts, unrolled
};

/// A picture of pixels: PNG.
struct PictureShape {
  int order = 0;
  Fill as = Fill::hole;
  std::string path;  ///< relative to the case's file
  PictureLayout layout = PictureLayout::wheel;
  std::optional<double> width;  ///< of the picture of a wheel
  double threshold = 0.5;       ///< darker than this is drawn: 0 white, 1 black
  int count = 1;
  double phase = 0;      ///< by which all are turned
  std::string checksum;  ///< of the file; never empty in a case that was read from a file
  Loaded<Picture> picture;
  bool operator==(const PictureShape&) const = default;
};

/// A shape of a wheel in the plane or in three dimensions.
using SavedLevelSet = std::variant<LevelSet<2>, LevelSet<3>>;

/// The shape of an earlier run to start from, instead of holes and drawn shapes. A 3D wheel may start from
/// the extruded shape of a 2D one.
struct SavedShape {
  std::string from;      ///< a run's folder or a file of its kind; relative to the case's file; empty: none
  std::string checksum;  ///< of the file; never empty in a case that was read from a file with `from`
  Loaded<SavedLevelSet> shape;
  bool operator==(const SavedShape&) const = default;
};

struct Shapes {
  std::vector<CircleShape> circles;
  std::vector<EllipseShape> ellipses;
  std::vector<SlotShape> slots;
  std::vector<PolygonShape> polygons;
  std::vector<AnnulusShape> annuli;
  std::vector<SpokeShape> spokes;
  std::vector<FileShape> files;
  std::vector<PictureShape> pictures;
  bool operator==(const Shapes&) const = default;
};

struct Grid {
  int radial_cells = 28;
  int angular_cells = 384;  ///< around the full ring
  int axial_cells = 4;      ///< along the axle; in 3D
  int degree = 2;           ///< of the displacement
  DilatationKind dilatation = DilatationKind::automatic;
  std::optional<int> level_set_degree;  ///< absent: 2
  std::optional<int>
      tread_levels;  ///< halvings of the cells at the tread; absent: as many as the contact needs
  bool operator==(const Grid&) const = default;
};

/// The mean contact stress p_mean (73) with which the uniformity functionals compare.
enum class MeanStress {
  exact,  ///< that of the shape itself
  held,   ///< that of the last accepted shape, as the paper does
};

/// How a bounded or minimized quantity is aggregated over the load positions.
enum class OverPositions {
  mean,   ///< their mean
  worst,  ///< the worst of them
  each,   ///< every one
};

/// A term of the weighted sum besides those that have a key for their weight.
struct ObjectiveTerm {
  Quantity quantity = {};
  std::string layer = {};  ///< of which it is; empty: of the whole ring
  double weight = 1;
  bool operator==(const ObjectiveTerm&) const = default;
};

/// Weights of the functionals in J, and parameters of the functionals.
struct Objective {
  Quantity minimize = {};  ///< by default the sum with the weights below
  std::string layer = {};  ///< of which the minimized quantity is; empty: of the whole ring
  OverPositions over = OverPositions::mean;
  double strain_energy = 1;
  double uniformity_annulus = 0;               ///< alpha_1 of J_p1
  double uniformity_dual = 0;                  ///< alpha_2 of J_p2
  double uniformity_l2 = 0;                    ///< of the naive functional (4)
  std::optional<double> annulus_matches_dual;  ///< alpha_2 from which (83) gives alpha_1
  std::optional<double> annulus;               ///< epsilon; absent: one radial cell
  std::optional<double> length;                ///< L; absent: epsilon
  MeanStress mean = MeanStress::exact;
  DualNorm dual_norm = DualNorm::elasticity;  ///< of J_p2
  std::vector<ObjectiveTerm> terms = {};
  bool operator==(const Objective&) const = default;
};

/// Bounds of a quantity.
struct Constraint {
  Quantity quantity = {};
  std::string layer = {};  ///< of which it is; empty: of the whole ring
  std::optional<double> at_least = {}, at_most = {}, equals = {};
  OverPositions over = OverPositions::mean;
  std::string load_case = {};  ///< empty: every one
  bool operator==(const Constraint&) const = default;
};

enum class VolumeControl {
  exact,  ///< the level set is shifted to the target volume
  paper,  ///< the multiplier lambda_k of section 4.2
};

struct Volume {
  VolumeControl control = VolumeControl::exact;
  std::optional<double> target;  ///< material as a fraction of the ring; absent: that of the initial shape
  double rate = 0.01;  ///< largest change on the way to the target, per shape, as a fraction of the ring
  bool operator==(const Volume&) const = default;
};

enum class VelocityKind {
  automatic,  ///< vector for sequential quadratic steps for a sum without bounds in 2D, else h1
  vector,
  h1,
  harmonic,
};

enum class OptimizerMethod {
  automatic,  ///< descent if the volume or the velocity needs it, else sequential quadratic
  sequential_quadratic,
  descent,
};

/// When new holes are created.
enum class NucleationTime { never, converged };

/// How the wheel is made, which every shape of a run allows; in 3D.
enum class Manufacture { free, extruded, turned, moulded, printed };

/// Tells where the parting plane of a moulded wheel comes from.
enum class Parting {
  given,  ///< from the case, or its default
  found,  ///< from the first wheels of all planes, before the run begins
};

struct Optimizer {
  OptimizerMethod method = OptimizerMethod::automatic;
  int iterations = 100;
  int coarse_levels = 0;  ///< number of coarser grids on which the descent starts, one after the other
  VelocityKind velocity = VelocityKind::automatic;
  std::optional<double> velocity_length;  ///< [cells]; absent: by the velocity
  std::optional<double> step;  ///< maximum move of the boundary per shape [cells]; absent: by the method
  int max_halvings = 6;
  double accepted_increase = 1e-4;
  std::optional<double> tolerance;  ///< absent: depends on the method
  int redistance_every = 5;
  double smoothing = 0;  ///< tau of (76) [cells^2]
  int smooth_every = 5;
  std::optional<double> rim_band;    ///< absent: 1/14 of the ring
  std::optional<double> tread_band;  ///< absent: see bands()
  std::optional<double> minimum_wall,
      minimum_gap;  ///< [m]; absent: of one cell and 1.5 cells in the last part of a run
  std::optional<double>
      minimum_radius;  ///< of internal corners [m]; absent: of a cell in the last part of a run
  NucleationTime nucleation = NucleationTime::never;
  Manufacture made = Manufacture::free;
  std::optional<double> parting_plane;  ///< z of moulded wheels [m]; absent: in the middle of the width
  Parting parting = Parting::given;
  double draft = 0;                          ///< of moulded wheels [rad]
  std::optional<double> overhang;            ///< the largest of printed wheels [rad]; absent: 45 degrees
  SideFace stands_on = SideFace::smaller_z;  ///< while a printed wheel is printed
  bool operator==(const Optimizer&) const = default;
};

/// Whether the errors of a run's results are estimated on a finer grid, with about three times the memory.
enum class ErrorEstimates { estimated, none };

struct Output {
  std::string folder;  ///< never empty in a case that was read from a file
  int vtu_every = 10;
  int pictures_every = 0;
  int checkpoint_every = 10;       ///< shapes; 0: not by the number of shapes
  double checkpoint_seconds = 60;  ///< 0: not by elapsed time
  ErrorEstimates errors = ErrorEstimates::estimated;
  bool operator==(const Output&) const = default;
};

/// The expected value of one quantity at one accepted shape.
struct Expectation {
  Quantity quantity = {};
  std::string layer = {};        ///< of which it is; empty: of the whole ring
  double value = 0;              ///< in the unit of history.csv
  double margin = 0.01;          ///< relative to the value
  std::optional<int> iteration;  ///< number of the accepted shape; absent: the last one
  std::string load_case = {};    ///< to which it applies; empty: the first one
  bool operator==(const Expectation&) const = default;
};

/// The words that a case can have: the built-in ones and those that a program adds.
struct Vocabulary {
  Quantities quantities = {};
  OwnLoadKeys load_keys = {};
  bool operator==(const Vocabulary&) const = default;
};

struct Case {
  std::string title;
  Wheel wheel;
  RingMaterial material;
  std::vector<MaterialLayer> layers;
  std::vector<MaterialCord> cords;
  Load load;
  Heat heat;
  Contact contact;
  Holes holes;
  SavedShape saved_shape;
  Shapes shapes;
  Grid grid;
  GhostPenalty ghost_penalty;
  Objective objective;
  std::vector<Constraint> constraints;
  Volume volume;
  Optimizer optimizer;
  Output output;
  std::vector<Expectation> expectations;
  Vocabulary vocabulary;
  bool operator==(const Case&) const = default;
};

}  // namespace wheelwright
