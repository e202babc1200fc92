#include "wheelwright/case/common_keys.h"

namespace wheelwright {

namespace {

constexpr std::string_view convection_unit = "W/(m^2 K)";

Key<Heat> convection_key(std::optional<double> Heat::*member, std::string_view name, std::string_view absent,
                         std::string_view meaning) {
  return {.name = name,
          .unit = convection_unit,
          .field = OptionalNumberField<Heat>{member, between(0, 1e5), absent},
          .meaning = meaning};
}

}  // namespace

const Section<Heat>& heat_section() {
  constexpr Range temperatures = between(-200, 2000);
  static const Section<Heat> section{
      .name = "heat",
      .meaning =
          "how warm the rolling wheel gets: load.speed and the loss factors of the materials give the heat, "
          "their conductivities lead it to the rim and to the surfaces, which the air cools; it is computed "
          "if "
          "the section has a rim_temperature or a convection",
      .in = [](Case& c) -> Heat& { return c.heat; },
      .keys = {
          {.name = "ambient_temperature",
           .unit = "deg C",
           .field = NumberField<Heat>{&Heat::ambient_temperature, temperatures},
           .meaning = "of the air"},
          {.name = "rim_temperature",
           .unit = "deg C",
           .field = OptionalNumberField<Heat>{&Heat::rim_temperature, temperatures, "no heat passes the rim"},
           .meaning = "of the rim, which takes the heat that reaches it"},
          convection_key(&Heat::convection, "convection", "none",
                         "coefficient of convection: heat to the air by area and rise of the "
                         "temperature, the mean over a turn, on all surfaces without one of their own"),
          convection_key(&Heat::tread_convection, "tread_convection",
                         "heat.convection; 0 with contact.with = \"ring\"",
                         "that of the tread; that of a bonded one is to a ring as warm as the air"),
          convection_key(&Heat::hole_convection, "hole_convection", "heat.convection",
                         "that of the edges of the holes"),
          convection_key(&Heat::side_convection, "side_convection", "heat.convection",
                         "that of both side faces; in 2D they take heat from the material between them; "
                         "with wheel.side_faces = \"symmetric\" in 3D there are none")}};
  return section;
}

const Section<Contact>& contact_section() {
  static const Section<Contact> section{
      .name = "contact",
      .meaning = "contact of the tread with the ground",
      .in = [](Case& c) -> Contact& { return c.contact; },
      .keys = {
          {.name = "with",
           .field = choice<&Contact::with>({"ground", "ring"}),
           .meaning = "what the tread is in contact with: flat ground on which it rolls, or a rigid "
                      "ring to which all of it is bonded, as in a bushing; the load then presses the "
                      "rim towards each load position"},
          {.name = "method",
           .field = choice<&Contact::method>({"nitsche", "penalty"}),
           .meaning = "Nitsche's method (28) or penalty (22)"},
          {.name = "theta",
           .field = NumberField<Contact>{&Contact::theta, any_number},
           .meaning = "Nitsche's parameter; -1 works with any gamma_0, 0 and 1 need a large one; at large "
                      "deformation (material.model) it is 0"},
          {.name = "gamma_0",
           .field = NumberField<Contact>{&Contact::gamma_0, above(0, 1e9)},
           .meaning = "gamma = gamma_0 E / h_T, where h_T is the diameter of the contact cell; in plane "
                      "stress with E (1 + 2 nu) / (1 + nu)^2 for E; at large deformation by default 20"},
          {.name = "friction",
           .field = NumberField<Contact>{&Contact::friction, between(0, 10)},
           .meaning = "coefficient F of Coulomb's static friction (16)"},
          {.name = "quadrature_points",
           .field = IntegerField<Contact>{&Contact::quadrature_points, between(1, 20)},
           .meaning =
               "number of Gauss points on each contact face; in 3D along the ground, and along the axle "
               "at most degree + 1"}}};
  return section;
}

const Section<Grid>& grid_section() {
  static const Section<Grid> section{
      .name = "grid",
      .meaning = "uniform polar grid of the full ring",
      .in = [](Case& c) -> Grid& { return c.grid; },
      .keys = {
          {.name = "radial_cells",
           .field =
               IntegerField<Grid>{&Grid::radial_cells, cell_count, "28, or the nearest number that fits"},
           .meaning = "number of cells from rim to tread; it fits if it can be halved "
                      "optimizer.coarse_levels times, "
                      "and the annulus and the given bands are whole rows"},
          {.name = "angular_cells",
           .field =
               IntegerField<Grid>{&Grid::angular_cells, cell_count, "384, or the nearest number that fits"},
           .meaning = "number of cells around the full ring, a multiple of wheel.sectors that can be halved "
                      "optimizer.coarse_levels times in each sector"},
          {.name = "axial_cells",
           .field = IntegerField<Grid>{&Grid::axial_cells, cell_count, "4, or the nearest number that fits"},
           .meaning = "in 3D, number of cells along the axle; if it is even, a wheel that is symmetric "
                      "across the width is solved on half of it"},
          {.name = "degree",
           .field = IntegerField<Grid>{&Grid::degree, between(1, 2)},
           .meaning = "polynomial degree of the displacement"},
          {.name = "dilatation",
           .field = choice<&Grid::dilatation>({"auto", "projected", "pointwise"}),
           .meaning =
               "projected: with degree = 2, the element does not lock at any Poisson's ratio; pointwise: "
               "the element of other programs; auto: pointwise up to a Poisson's ratio of 0.4 and in plane "
               "stress, projected from 0.48 on, in between in part"},
          {.name = "level_set_degree",
           .field = OptionalIntegerField<Grid>{&Grid::level_set_degree, between(1, 2), "2", "auto"},
           .meaning = "polynomial degree of the level set"},
          {.name = "tread_levels",
           .field = OptionalIntegerField<Grid>{&Grid::tread_levels, between(0, 6),
                                               "8 cells across the contact patch in a run, 36 in an analysis "
                                               "and in the results of a run; in 3D with at most 40 points "
                                               "per column and line around the wheel",
                                               "auto"},
           .meaning =
               "how many times the cells at the tread are halved, for accurate contact pressures; the level "
               "set's grid and the cost of the cut cells do not change"}}};
  return section;
}

const Section<GhostPenalty>& ghost_penalty_section() {
  static const Section<GhostPenalty> section{
      .name = "ghost_penalty",
      .meaning = "stabilization of the cut cells",
      .in = [](Case& c) -> GhostPenalty& { return c.ghost_penalty; },
      .keys = {
          {.name = "kind",
           .field = choice<&GhostPenalty::kind>({"full", "paper"}),
           .meaning = "full: jumps of the stress and of the second normal derivative on all faces of cut "
                      "cells; paper: only the jump of the stress, by (81), which is unsafe for degree 2"},
          {.name = "xi",
           .field = NumberField<GhostPenalty>{&GhostPenalty::xi, between(0, 1)},
           .meaning = "weight; a large value stiffens the structure"}}};
  return section;
}

}  // namespace wheelwright
