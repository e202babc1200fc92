#include <algorithm>
#include <iterator>

#include "wheelwright/case/common_keys.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/manufacture_words.h"
#include "wheelwright/case/unlimited.h"

namespace wheelwright {

const Section<Objective>& objective_section() {
  static const Section<Objective> section{
      .name = "objective",
      .meaning =
          "weights of the functionals in the objective J, which is summed over all load positions and "
          "minimized",
      .in = [](Case& c) -> Objective& { return c.objective; },
      .keys = {
          {.name = "minimize",
           .field = QuantityField<Objective>{&Objective::minimize},
           .meaning =
               "what is minimized; objective: the weighted sum; any other quantity replaces it, and "
               "the weights then only select the functionals in history.csv. Of several load cases it is "
               "the weighted sum of each one's"},
          {.name = "layer",
           .field = TextField<Objective>{&Objective::layer, "the whole ring"},
           .meaning = "the layer whose quantity `minimize` is, by its name"},
          {.name = "over",
           .field = choice<&Objective::over>({"mean", "worst"}),
           .meaning = "how `minimize` is aggregated over the load positions: mean, or the maximum; not for "
                      "the weighted sum"},
          {.name = "strain_energy",
           .field = NumberField<Objective>{&Objective::strain_energy, between(0, 1e9)},
           .meaning = "weight of the strain energy J_e (3)"},
          {.name = "uniformity_annulus",
           .field = NumberField<Objective>{&Objective::uniformity_annulus, between(0, 1e9)},
           .meaning = "weight alpha_1 of J_p1 (60): uniformity of the contact stress over the load "
                      "positions, in an annulus"},
          {.name = "uniformity_dual",
           .field = NumberField<Objective>{&Objective::uniformity_dual, between(0, 1e9)},
           .meaning = "weight alpha_2 of J_p2 (61): uniformity of the contact stress over the load "
                      "positions, in H^-1/2"},
          {.name = "uniformity_l2",
           .field = NumberField<Objective>{&Objective::uniformity_l2, between(0, 1e9)},
           .meaning = "weight of J_p (4), the naive uniformity functional; for comparison"},
          {.name = "annulus_matches_dual",
           .field = OptionalNumberField<Objective>{&Objective::annulus_matches_dual, above(0, 1e9),
                                                   "uniformity_annulus is used"},
           .meaning =
               "computes uniformity_annulus by (83): weighted J_p1 starts equal to J_p2 with this weight"},
          {.name = "annulus",
           .unit = "m",
           .field = OptionalNumberField<Objective>{&Objective::annulus, above(0, 1000), "one radial cell"},
           .meaning = "epsilon: thickness of the annulus of J_p1, a whole number of radial cells; it remains "
                      "material"},
          {.name = "length",
           .unit = "m",
           .field = OptionalNumberField<Objective>{&Objective::length, above(0, 1000), "epsilon"},
           .meaning = "L: characteristic length of J_p1 and J_p"},
          {.name = "mean",
           .field = choice<&Objective::mean>({"exact", "held"}),
           .meaning = "mean contact stress p_mean (73); exact: of the shape itself; held: of the last "
                      "accepted shape, as in the paper"},
          {.name = "dual_norm",
           .field = choice<&Objective::dual_norm>({"elasticity", "poisson"}),
           .meaning =
               "the problem on the ring without holes that defines the H^-1/2 norm of J_p2; elasticity: "
               "(68), as in the paper; poisson: Poisson's problem of Remark 7, with E instead of the "
               "elasticity tensor"}}};
  return section;
}

namespace {

ObjectiveTerm example_term() { return {.quantity = built_in("peak_von_mises"), .weight = 1e-6}; }

Constraint example_constraint() {
  Constraint energy;
  energy.quantity = built_in("strain_energy");
  energy.at_most = 5;
  return energy;
}

}  // namespace

const SectionArray<ObjectiveTerm>& objective_term_sections() {
  static const SectionArray<ObjectiveTerm> sections{
      .parent = "objective",
      .name = "term",
      .meaning =
          "a further term of the weighted sum: a quantity as histories have it, its mean over the load "
          "positions, or the largest value of a peak; any number of tables",
      .in = [](Case& c) -> std::vector<ObjectiveTerm>& { return c.objective.terms; },
      .example = example_term(),
      .keys = {{.name = "quantity",
                .unit = "",
                .field = QuantityField<ObjectiveTerm>{&ObjectiveTerm::quantity},
                .meaning = "any quantity with a derivative and without a weight of its own in [objective]",
                .presence = Presence::required},
               {.name = "layer",
                .field = TextField<ObjectiveTerm>{&ObjectiveTerm::layer, "the whole ring"},
                .meaning = "the layer whose quantity it is, by its name"},
               {.name = "weight",
                .unit = "",
                .field = NumberField<ObjectiveTerm>{&ObjectiveTerm::weight, between(0, 1e9)},
                .meaning = "its weight, by which its number in SI units is multiplied"}}};
  return sections;
}

const SectionArray<Constraint>& constraint_sections() {
  static constexpr Range positive = values_of(UnitKind::energy);
  static const SectionArray<Constraint> sections{
      .parent = "",
      .name = "constraint",
      .meaning =
          "a bound that the optimized wheel must satisfy, with method = \"sequential_quadratic\"; a run that "
          "violates it ends with exit code 9; any number of tables with ten bounds in total; the volume is "
          "free if volume_fraction or mass is bounded or minimized",
      .in = [](Case& c) -> std::vector<Constraint>& { return c.constraints; },
      .example = example_constraint(),
      .keys = {
          {.name = "quantity",
           .field = QuantityField<Constraint>{&Constraint::quantity},
           .meaning = "what is bounded, by the names of history.csv and [[expect]]",
           .presence = Presence::required},
          {.name = "layer",
           .field = TextField<Constraint>{&Constraint::layer, "the whole ring"},
           .meaning = "the layer whose quantity it is, by its name; \"material\" for what lies in none"},
          {.name = "at_least",
           .unit = unit_of_quantity,
           .field = OptionalNumberField<Constraint>{&Constraint::at_least, positive, "no such bound"},
           .meaning = "lower bound. A plain number is in SI units, in 2D per metre of width for forces, "
                      "energies, masses and stiffnesses, as in history.csv. With a unit, as in \"6000 "
                      "N/mm\", it applies to the whole wheel, as in tables. A temperature may be any above "
                      "absolute zero"},
          {.name = "at_most",
           .unit = unit_of_quantity,
           .field = OptionalNumberField<Constraint>{&Constraint::at_most, positive, "no such bound"},
           .meaning = "upper bound"},
          {.name = "equals",
           .unit = unit_of_quantity,
           .field = OptionalNumberField<Constraint>{&Constraint::equals, positive, "no such bound"},
           .meaning = "the required value, instead of bounds"},
          {.name = "over",
           .field = choice<&Constraint::over>({"mean", "worst", "each"}),
           .meaning = "how the quantity is aggregated over the load positions: mean, worst, or each one with "
                      "its own bound"},
          {.name = "load_case",
           .field = TextField<Constraint>{&Constraint::load_case, "every load case"},
           .meaning = "the name of the [[load.case]] to which it applies"}}};
  return sections;
}

const Section<Volume>& volume_section() {
  static const Section<Volume> section{
      .name = "volume",
      .meaning = "the volume constraint",
      .in = [](Case& c) -> Volume& { return c.volume; },
      .keys = {
          {.name = "control",
           .field = choice<&Volume::control>({"exact", "paper"}),
           .meaning = "exact: every shape has the target volume once it is reached; paper: the rule "
                      "lambda_k of section 4.2, "
                      "which lets the volume drift"},
          {.name = "target",
           .field = OptionalNumberField<Volume>{&Volume::target, above(0, 1), "that of the initial shape"},
           .meaning = "material as a fraction of the ring; the run changes the volume to it from that of the "
                      "initial shape"},
          {.name = "rate",
           .field = NumberField<Volume>{&Volume::rate, above(0, 1)},
           .meaning = "on the way to the target the volume changes by at most this fraction of the ring per "
                      "shape; only with control = \"exact\""}}};
  return section;
}

namespace {

/// How the next shape is found.
std::vector<Key<Optimizer>> search_keys() {
  return {
      {.name = "method",
       .field = choice<&Optimizer::method>({"auto", "sequential_quadratic", "descent"}),
       .meaning = "sequential_quadratic: steps of a quadratic model that learns the curvature from earlier "
                  "shapes; descent: along the gradient; auto: descent with volume.control = "
                  "\"paper\" and "
                  "with velocity = \"harmonic\", which need it, else sequential_quadratic"},
      {.name = "iterations",
       .field = IntegerField<Optimizer>{&Optimizer::iterations, between(0, unlimited_iterations)},
       .meaning = "maximum number of accepted shapes after the initial one"},
      {.name = "coarse_levels",
       .field = IntegerField<Optimizer>{&Optimizer::coarse_levels, between(0, 4)},
       .meaning = "the descent starts on a grid whose cells are doubled this many times along each axis, and "
                  "moves to the next finer one when J has fallen by less than 0.5 % in 6 trials (with "
                  "method = \"descent\" over 10 shapes), until "
                  "it is on the case's own grid; 0: on the case's own grid from the start"},
      {.name = "velocity",
       .field = choice<&Optimizer::velocity>({"auto", "vector", "h1", "harmonic"}),
       .meaning = "what moves the boundary. vector: a smooth vector field; h1: a smooth speed along the "
                  "normal; harmonic: the speed of the paper's harmonic extension; auto: vector with "
                  "sequential quadratic steps for the weighted sum without bounds in 2D, else h1"},
      {.name = "velocity_length",
       .unit = "cells",
       .field =
           OptionalNumberField<Optimizer>{&Optimizer::velocity_length, between(0, 1000),
                                          "h1: 2; vector: 8, or 0.3 * grid.radial_cells if that is less"},
       .meaning = "length over which vector and h1 smooth the motion of the boundary"},
      {.name = "step",
       .unit = "cells",
       .field = OptionalNumberField<Optimizer>{&Optimizer::step, above(0, 10),
                                               "1.25; with method = \"descent\" 0.5"},
       .meaning = "maximum move of the boundary from one shape to the next"},
      {.name = "max_halvings",
       .field = IntegerField<Optimizer>{&Optimizer::max_halvings, between(0, 50)},
       .meaning = "how many times a rejected step is halved before the run stops"},
      {.name = "accepted_increase",
       .field = NumberField<Optimizer>{&Optimizer::accepted_increase, between(0, 1)},
       .meaning = "a shape is accepted if its J exceeds the best J so far by at most this fraction; before "
                  "walls and gaps are repaired also if it is at most the larger J of the last two shapes"},
      {.name = "tolerance",
       .field = OptionalNumberField<Optimizer>{&Optimizer::tolerance, between(0, 1),
                                               "2e-4; with method = \"descent\" 1e-5"},
       .meaning = "the run has converged when J has fallen by less than this fraction in 6 trials, or with "
                  "method = \"descent\" over 10 shapes; 0 means never"},
      {.name = "redistance_every",
       .unit = "shapes",
       .field = IntegerField<Optimizer>{&Optimizer::redistance_every, between(0, 1000000)},
       .meaning = "how often the level set is redistanced (replaced by a signed distance); 0 means never"},
      {.name = "smoothing",
       .unit = "cells^2",
       .field = NumberField<Optimizer>{&Optimizer::smoothing, between(0, 1000)},
       .meaning = "tau of (76); 0 means no smoothing, and then small holes may fray"},
      {.name = "smooth_every",
       .unit = "shapes",
       .field = IntegerField<Optimizer>{&Optimizer::smooth_every, between(1, 1000000)},
       .meaning = "how often the level set is smoothed by (76)"}};
}

/// How the wheel is made.
std::vector<Key<Optimizer>> manufacture_keys() {
  return {
      {.name = "made",
       .field = choice<&Optimizer::made>({manufacture_words.begin(), manufacture_words.end()}),
       .meaning =
           "in 3D, what every shape of a run is. extruded: the same all along the axle; turned: a body of "
           "revolution, by default in sectors of one cell and, without losses and fatigue, with one load "
           "position; moulded: without undercuts in a mould of two halves that open along the axle; printed: "
           "layer by layer along the axle, without support and without closed cavities"},
      {.name = "parting_plane",
       .unit = "m",
       .field = OptionalNumberField<Optimizer>{&Optimizer::parting_plane, between(0, 1000),
                                               "between the cells nearest the middle of the width"},
       .meaning = "with made = \"moulded\", z of the plane in which the halves of the mould meet, between "
                  "cells; 0 or wheel.width: one half is flat"},
      {.name = "parting",
       .field = choice<&Optimizer::parting>({"given", "found"}),
       .meaning =
           "with made = \"moulded\", found: before the first shape, a run solves the initial wheel for "
           "every plane between cells, at the same volume, and takes the one with the least objective as "
           "parting_plane"},
      {.name = "draft",
       .unit = "deg",
       .field = NumberField<Optimizer>{&Optimizer::draft, between(0, 30), degree_of_arc},
       .meaning = "with made = \"moulded\", the least angle between the edges of holes and the axle"},
      {.name = "overhang",
       .unit = "deg",
       .field = OptionalNumberField<Optimizer>{&Optimizer::overhang, between(0, 75), "45", degree_of_arc},
       .meaning = "with made = \"printed\", the largest angle against the axle by which the edges of holes "
                  "lean over the layers below them; 0: holes nowhere narrow upwards"},
      {.name = "stands_on",
       .field = choice<&Optimizer::stands_on>({"smaller_z", "larger_z"}),
       .meaning = "with made = \"printed\", the side face on which the wheel stands while it is printed"}};
}

/// Minimum widths and new holes.
std::vector<Key<Optimizer>> feature_keys() {
  return {
      {.name = "rim_band",
       .unit = "m",
       .field = OptionalNumberField<Optimizer>{&Optimizer::rim_band, between(0, 1000), "1/14 of the ring"},
       .meaning = "thickness of the band at the rim that remains material, at least one radial cell; holes "
                  "extend to it, so the optimum depends on it"},
      {.name = "tread_band",
       .unit = "m",
       .field = OptionalNumberField<Optimizer>{&Optimizer::tread_band, between(0, 1000),
                                               "1/14 of the ring, or 1/28 more than the annulus"},
       .meaning =
           "thickness of the band at the tread that remains material, at least one radial cell more than "
           "the annulus"},
      {.name = "minimum_wall",
       .unit = "m",
       .field = OptionalNumberField<Optimizer>{&Optimizer::minimum_wall, between(0, 1000),
                                               "any at first, one cell in the last part of a run"},
       .meaning = "minimum thickness of the material between two edges, in every shape; the bands at rim and "
                  "tread must be at least as thick; 0 means no minimum to the end"},
      {.name = "minimum_gap",
       .unit = "m",
       .field = OptionalNumberField<Optimizer>{&Optimizer::minimum_gap, between(0, 1000),
                                               "any at first, 1.5 cells in the last part of a run"},
       .meaning = "minimum width of a hole, in every shape: narrower parts of holes, and smaller holes, are "
                  "filled; 0 means no minimum to the end"},
      {.name = "minimum_radius",
       .unit = "m",
       .field = OptionalNumberField<Optimizer>{&Optimizer::minimum_radius, between(0, 1000),
                                               "any at first, 1 cell in the last part of a run"},
       .meaning = "minimum radius of internal corners, those of the holes, for milling cutters and low "
                  "stress; gaps are at least twice as wide; 0 means no minimum to the end"},
      {.name = "nucleation",
       .field = choice<&Optimizer::nucleation>({"never", "converged"}),
       .meaning =
           "when new holes are created. converged: when the search has converged, small holes are "
           "created where they lower J most according to the topological derivative; if J has not "
           "fallen when it has converged again, they are removed and the run ends; in 3D balls, only with "
           "made = \"free\""}};
}

std::vector<Key<Optimizer>> optimizer_keys() {
  auto keys = search_keys();
  std::ranges::move(manufacture_keys(), std::back_inserter(keys));
  std::ranges::move(feature_keys(), std::back_inserter(keys));
  return keys;
}

}  // namespace

const Section<Optimizer>& optimizer_section() {
  static const Section<Optimizer> section{
      .name = "optimizer",
      .meaning =
          "the search for a better shape; the unit \"cell\" is the shortest edge of a grid cell at "
          "mid-ring",
      .in = [](Case& c) -> Optimizer& { return c.optimizer; },
      .keys = optimizer_keys()};
  return section;
}

}  // namespace wheelwright
