#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "wheelwright/mechanics/elasticity/isotropic_law.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// The material law at every place of the ring: annular layers that are bonded to each other, each of one
/// material. Laws are always looked up by place. Thin cords may be bonded to it along circles.
template <int dim>
class Materials {
 public:
  /// What lies between the next layer inside, or the rim, and a radius.
  struct Layer {
    double outer_radius;  ///< [m]; that of the last layer does not matter: it reaches the tread
    std::shared_ptr<const MaterialLaw<dim>> law;
    std::string name = {};  ///< for people
  };

  /// Cords side by side along a circle, as thick as a line.
  struct Cord {
    double radius;     ///< [m]
    double stiffness;  ///< E A per width along the axle [N/m]
  };

  Materials() : Materials(Material()) {}

  /// The same material everywhere.
  Materials(const Material& everywhere) : Materials(std::make_shared<IsotropicLaw<dim>>(everywhere)) {}
  Materials(std::shared_ptr<const MaterialLaw<dim>> everywhere) : layers_{{0, std::move(everywhere)}} {}

  /// Layers from the rim to the tread, at least one. The radii between them must be those of lines of the
  /// model's grid (fit()), below its condensed rows (TreadGrid): the response of a stiff band on a soft layer
  /// would not decay within half the ring.
  explicit Materials(std::vector<Layer> layers, std::vector<Cord> cords = {})
      : layers_(std::move(layers)), cords_(std::move(cords)) {}

  const std::vector<Layer>& layers() const { return layers_; }
  const std::vector<Cord>& cords() const { return cords_; }

  /// The stiffness of the cords on the outer line of a radial row [N/m]; 0 if there is none.
  double cords_on(const PolarGrid<dim>& grid, int row) const {
    double stiffness = 0;
    for (const Cord& cord : cords_)
      if (grid.nearest_line(cord.radius).line == row + 1) stiffness += cord.stiffness;
    return stiffness;
  }

  /// Whether all laws are those of small strains.
  bool are_linear() const {
    return std::all_of(layers_.begin(), layers_.end(),
                       [](const Layer& layer) { return layer.law->is_linear(); });
  }

  /// The radii between layers [m].
  std::vector<double> interfaces() const {
    std::vector<double> radii;
    for (auto layer = layers_.begin(); layer + 1 != layers_.end(); ++layer)
      radii.push_back(layer->outer_radius);
    return radii;
  }

  /// The index of the layer in which a circle lies.
  int layer_at(double radius) const {
    int layer = 0;
    while (layer + 1 < static_cast<int>(layers_.size()) && radius > layers_[layer].outer_radius) ++layer;
    return layer;
  }

  const MaterialLaw<dim>& at_radius(double radius) const { return *layers_[layer_at(radius)].law; }

  /// The law of the cells of a radial row, counted from the rim.
  const MaterialLaw<dim>& in_row(const PolarGrid<dim>& grid, int row) const {
    return at_radius(grid.middle_of_row(row));
  }

  /// Whether the cells of a row and of the next one outside belong to different layers.
  bool is_interface(const PolarGrid<dim>& grid, int row) const {
    return layer_at(grid.middle_of_row(row)) != layer_at(grid.middle_of_row(row + 1));
  }

  /// Whether all radii between layers and those of cords are those of lines of a grid, up to a millionth of a
  /// cell.
  bool fit(const PolarGrid<dim>& grid) const {
    const auto is_line = [&](double radius) {
      const auto [line, distance] = grid.nearest_line(radius);
      return line > 0 && line < grid.cells[0] && std::abs(distance) < 1e-6 * grid.row_height(line);
    };
    return std::all_of(layers_.begin(), layers_.end() - 1,
                       [&](const Layer& layer) { return is_line(layer.outer_radius); }) &&
           std::all_of(cords_.begin(), cords_.end(), [&](const Cord& cord) { return is_line(cord.radius); });
  }

  /// The law at the tread, which meets the ground.
  const MaterialLaw<dim>& at_tread() const { return *layers_.back().law; }

  /// The largest modulus by which a layer is scaled, MaterialLaw::scaling_modulus() [Pa].
  double stiffest() const {
    double modulus = 0;
    for (const Layer& layer : layers_) modulus = std::max(modulus, layer.law->scaling_modulus());
    return modulus;
  }

 private:
  std::vector<Layer> layers_;
  std::vector<Cord> cords_ = {};
};

}  // namespace wheelwright
