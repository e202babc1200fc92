#pragma once

#include <array>
#include <vector>

#include "wheelwright/mechanics/state/ground.h"
#include "wheelwright/mechanics/state/ring_field.h"
#include "wheelwright/shape/geometry/axle_rotation.h"
#include "wheelwright/shape/geometry/contour.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// A point of the loaded wheel as it is drawn.
struct DrawnPoint {
  Vec<2> place;   ///< picture coordinates (output/report/picture_view.h) [m]
  double scalar;  ///< the displayed value there
};

/// A convex polygon of material.
using DrawnPiece = std::vector<DrawnPoint>;

/// What can be below a wheel.
enum class Below {
  ground,
  nothing  ///< a tread bonded to a rigid ring does not move
};

/// The loaded wheel as shown in a picture: turned so that the contact is at the bottom, its displacement
/// multiplied by `magnification`.
///
/// Magnified displacements would move the tread through the ground next to the contact, because the gap there
/// is not magnified. Points of the tread below the ground are drawn on it, and the material between them and
/// the rim is moved up by a share of that: all of it at the tread, nothing at the rim. It is what a wheel
/// that deforms so much looks like. Where nothing crosses, at magnification 1, nothing is moved.
class DeformedMaterial {
 public:
  /// `lattice` carries the fields. All must outlive this.
  DeformedMaterial(const LevelSet<2>& psi, const Lattice<2>& lattice, const RingField& displacement,
                   double magnification, double contact_azimuth, Below below, const Ground& ground = {});

  /// The material of every sector, its cells divided into parts x parts squares, cut ones clipped. Cells
  /// whose undeformed position is outside the circle about `centre` (picture coordinates) are omitted.
  std::vector<DrawnPiece> pieces(const NamedField& scalar, int parts, const Vec<2>& centre,
                                 double radius) const;

  /// A place before the deformation (body frame) in picture coordinates, without and with its displacement.
  Vec<2> undeformed(const Vec<2>& x) const;
  Vec<2> drawn(const Vec<2>& x) const;

  /// The maximum by which the tread is moved up [m].
  double max_press() const;

 private:
  /// A point of a cell in sector 0.
  struct CellPoint {
    Vec<2> x;  ///< Cartesian
    double radius, azimuth;
    std::array<double, 9> shape;  ///< values of the field's shape functions there
  };

  /// The polygons of material of a cell in sector 0.
  struct CellPieces {
    int cell;
    Vec<2> middle;  ///< Cartesian
    std::vector<CellPoint> points;
    std::vector<std::vector<int>> polygons;  ///< indices of points
  };

  CellPieces cell_pieces(int cell, const std::vector<MaterialPolygon>& polygons, int parts) const;
  std::vector<DrawnPoint> drawn(const CellPieces& pieces, int sector, const NamedField& scalar) const;
  Vec<2> moved(const Vec<2>& x, double radius, double azimuth, const Vec<2>& displacement) const;
  double press_at(double azimuth) const;

  const LevelSet<2>& psi_;
  const Lattice<2>& lattice_;
  const RingField& displacement_;
  double magnification_;
  AxleRotation to_picture_;  ///< that moves the contact to the bottom, before the second axis is reversed
  Ground ground_;
  double level_;               ///< of the ground below the axle of the undeformed wheel [m]
  std::vector<double> press_;  ///< of the tread, at equal azimuths round the ring [m]; empty: nothing below
};

}  // namespace wheelwright
