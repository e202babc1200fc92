#pragma once

#include <array>
#include <span>
#include <vector>

#include "wheelwright/shape/evolution/made_shapes.h"
#include "wheelwright/shape/geometry/print.h"

namespace wheelwright {

/// Whether a level set falls nowhere with the distance from the plate, so that all its holes stay as wide as
/// they are or become wider.
bool rises_from_the_plate(const LevelSet<3>& psi, SideFace plate);

/// The shapes of one lattice that can be printed layer by layer, by a condition on the coefficients of their
/// splines: from one layer to the next, none sinks by more than the spline of the layer falls within the
/// reach of the overhang (docs/method.md, "Printed shapes"; after M. Langelaar, Struct. Multidisc. Optim. 55,
/// 2017). So material rests on material, and edges lean over by at most the overhang. A level set rounds the
/// ridge of a roof, and a round ridge hangs over by a right angle. So no hole ends below a roof: the reach
/// decreases to nothing where holes are narrow, and they continue up to the side face. There is no closed
/// cavity.
class PrintedShapes : public MadeShapes<3> {
 public:
  /// Level sets and coefficients that are the same along the axle and that no shape exceeds, e.g. of
  /// protected bands. The spline of these coefficients does not exceed that level set.
  struct Ceiling {
    std::span<const double> of_level_set, of_coefficients;
  };

  PrintedShapes(const Lattice<3>& lattice, const Print& print, const Ceiling& ceiling);

  LevelSet<3> keep_coefficients(LevelSet<3> coefficients) const override;

  /// A level set whose coefficients are not allowed near an edge becomes the spline of allowed ones, which
  /// are about a distance, unless it rises from the plate.
  LevelSet<3> keep(LevelSet<3> psi) const override;

  bool follow(const LevelSet<3>& coefficients, const LevelSet<3>& moved, Following& following) const override;

 private:
  /// A function of coefficients, with its linear dependence on them.
  struct Value {
    double value = 0;
    std::vector<Dependence> of = {};

    void add(double factor, const Value& other);
  };

  /// A place in a layer of nodes, in units of cells.
  struct Spot {
    double line, column;
  };

  struct Fall {
    Value down, up;
  };

  int node_at(int line, int column, int layer) const;
  std::vector<Dependence> at(double line, double column, int layer, std::array<int, 2> order = {}) const;
  std::array<double, 2> cell_lengths(double radius) const;
  Value spline(std::span<const double> values, const Spot& spot, int layer) const;
  Value spline(std::span<const double> values, const Spot& spot, int layer,
               const std::array<Value, 2>& moves) const;
  Value depth(std::span<const double> values, const Spot& spot, int layer) const;
  Fall fall(std::span<const double> values, const Spot& spot, int layer, const Value& distance) const;
  Value bound(std::span<const double> values, int line, int column, int layer) const;
  LevelSet<3> supported(LevelSet<3> coefficients) const;
  template <class Visit>
  void for_each_layer(Visit visit) const;
  template <class Visit>
  void for_each_vertex(Visit visit) const;

  Lattice<3> lattice_;
  int up_;              ///< 1 or -1: from layer to layer
  double cell_;         ///< the longest edge of a cell across the axle [m]
  double layer_reach_;  ///< the largest reach [m]
  double unchanged_;
  std::vector<double> ceiling_, ceiling_of_coefficients_;
};

}  // namespace wheelwright
