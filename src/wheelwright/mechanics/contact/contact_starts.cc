#include "wheelwright/mechanics/contact/contact_starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace wheelwright {
namespace {

/// A point of a column a number of columns ahead.
struct Neighbour {
  int columns, point;
};

/// Finds, for every point of a column, the nearest point `shift` columns ahead, at the same place along the
/// axle.
template <int dim>
std::vector<Neighbour> neighbours(const ContactPoints<dim>& at, double shift) {
  std::vector<Neighbour> result;
  for (const auto& from : at.places) {
    const double target = from.columns + shift;
    const int whole = static_cast<int>(std::floor(target));
    Neighbour nearest{whole, 0};
    double smallest = std::numeric_limits<double>::infinity();
    for (int columns = whole - 1; columns <= whole + 1; ++columns)
      for (int q = 0; q < at.per_column(); ++q) {
        if (std::abs(at.places[q].along_axle - from.along_axle) > 1e-9) continue;
        const double distance = std::abs(columns + at.places[q].columns - target);
        if (distance >= smallest) continue;
        smallest = distance;
        nearest = {columns, q};
      }
    result.push_back(nearest);
  }
  return result;
}

}  // namespace

template <int dim>
ContactUnknowns<dim> hertz_start(const ReducedContact<dim>& contact, double load, double radius,
                                 double reduced_modulus, double centre) {
  const double half_width = 2 * std::sqrt(load * radius / (std::numbers::pi * reduced_modulus));
  const double peak = 2 * load / (std::numbers::pi * half_width);
  ContactUnknowns<dim> x{std::vector<Vec<dim>>(contact.points().size(), Vec<dim>{}),
                         std::vector<double>(contact.n_free())};
  for (size_t i = 0; i < contact.points().size(); ++i) {
    const double s = (contact.points()[i].position[1] - centre) / half_width;
    x.augmented[i][0] =
        std::abs(s) < 1 ? -peak * std::sqrt(1 - s * s) : contact.points()[i].gamma * contact.points()[i].gap;
  }
  return x;
}

template <int dim>
ContactUnknowns<dim> zero_start(const ReducedContact<dim>& contact) {
  return {std::vector<Vec<dim>>(contact.points().size(), Vec<dim>{}), std::vector<double>(contact.n_free())};
}

template <int dim>
ContactUnknowns<dim> undeformed_start(const ReducedContact<dim>& contact) {
  const std::vector<double> free(contact.n_free());
  return {contact.without_contact(free), free};
}

template <int dim>
ContactUnknowns<dim> start_from(const ReducedContact<dim>& contact, const ContactState<dim>& other) {
  const ContactPoints<dim>& at = contact.tread().at;
  const std::vector<Neighbour> nearest = neighbours(at, other.ground - at.ground);
  ContactUnknowns<dim> x{{}, std::vector<double>(contact.n_free())};
  for (int i = 0; i < contact.n_points(); ++i) {
    const ZonePoint<dim>& point = contact.points()[i];
    Vec<dim> open{};
    open[0] = point.gamma * std::max(0.0, point.gap - rim_displacement(point, other.rim)[0]);
    const auto [columns, q] = nearest[at.point_of_column(i)];
    const int column = at.column(i) + columns;
    x.augmented.push_back(
        column >= 0 && column < other.zone.n_columns ? other.augmented[at.per_column() * column + q] : open);
  }
  return x;
}

template <int dim>
ContactUnknowns<dim> touching(const ReducedContact<dim>& contact, ContactUnknowns<dim> guess) {
  const auto presses = [](const FreeMotion& motion) { return motion.direction.towards_ground != 0; };
  const auto motion = std::ranges::find_if(contact.rim().free, presses);
  const auto touches = [](const Vec<dim>& z) { return z[0] < 0; };
  if (motion == contact.rim().free.end() || std::ranges::any_of(guess.augmented, touches)) return guess;
  const double load = motion->force + work(contact.preload_resultant(), motion->direction);
  int nearest = 0;
  const auto distance = [&](int i) {
    return contact.points()[i].gap + contact.preload(i)[0] / contact.points()[i].gamma;
  };
  for (int i = 1; i < contact.n_points(); ++i)
    if (distance(i) < distance(nearest)) nearest = i;
  guess.augmented[nearest][0] = -load / contact.points()[nearest].weight;
  return guess;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                     \
  template ContactUnknowns<dim> hertz_start(const ReducedContact<dim>&, double, double, double, double); \
  template ContactUnknowns<dim> undeformed_start(const ReducedContact<dim>&);                            \
  template ContactUnknowns<dim> zero_start(const ReducedContact<dim>&);                                  \
  template ContactUnknowns<dim> start_from(const ReducedContact<dim>&, const ContactState<dim>&);        \
  template ContactUnknowns<dim> touching(const ReducedContact<dim>&, ContactUnknowns<dim>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
