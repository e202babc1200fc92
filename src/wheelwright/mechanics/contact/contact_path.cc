#include "wheelwright/mechanics/contact/contact_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "wheelwright/mechanics/contact/contact_tangent.h"

namespace wheelwright {
namespace {

using Unknowns = ContactUnknowns<2>;

/// y += factor x.
void add(double factor, const Unknowns& x, Unknowns& y) {
  for (size_t i = 0; i < y.augmented.size(); ++i)
    for (int d = 0; d < 2; ++d) y.augmented[i][d] += factor * x.augmented[i][d];
  for (size_t k = 0; k < y.rim.size(); ++k) y.rim[k] += factor * x.rim[k];
}

/// The pieces on which the contact law of a point is linear.
enum class Piece { open, stick, slide_forward, slide_backward };

/// A border of a piece, as an oriented line through the origin: inside, normal . z > 0.
struct Border {
  Vec<2> normal;
  Piece beyond;
};

Piece piece_of(const Vec<2>& z, double friction) {
  const ContactStatus status = contact_status<2>(z, friction);
  if (!status.touches) return Piece::open;
  if (!status.slides) return Piece::stick;
  return z[1] > 0 ? Piece::slide_forward : Piece::slide_backward;
}

/// The borders of a piece; for an open one, which ends where z_n = 0, `z` determines the piece beyond.
std::vector<Border> borders(Piece piece, const Vec<2>& z, double friction) {
  switch (piece) {
    case Piece::open:
      return {{{1, 0}, z[1] > 0 ? Piece::slide_forward : Piece::slide_backward}};
    case Piece::stick:
      return {{{-friction, -1}, Piece::slide_forward}, {{-friction, 1}, Piece::slide_backward}};
    case Piece::slide_forward:
      return {{{-1, 0}, Piece::open}, {{friction, 1}, Piece::stick}};
    case Piece::slide_backward:
      return {{{-1, 0}, Piece::open}, {{friction, -1}, Piece::stick}};
  }
  return {};
}

Mat<2> tangent_of(Piece piece, double friction) {
  switch (piece) {
    case Piece::open:
      return {};
    case Piece::stick:
      return {{{1, 0}, {0, 1}}};
    case Piece::slide_forward:
      return {{{1, 0}, {-friction, 0}}};
    case Piece::slide_backward:
      return {{{1, 0}, {friction, 0}}};
  }
  return {};
}

/// A change of the tangent by one point's change of piece: residual . normal^T.
struct Change {
  int point;
  Vec<2> normal;
  Unknowns solved;  ///< tangent before^-1 . residual
  double ratio;     ///< of the tangent's determinants, after to before

  /// Whether the tangent after is singular: `solved` is its null vector.
  bool is_singular() const { return !(std::abs(ratio) > 1e-10) || !std::isfinite(ratio); }

  /// From a solution with the tangent before to that with the tangent after.
  void apply(Unknowns& x) const { add(-dot<2>(normal, x.augmented[point]) / ratio, solved, x); }
};

/// The tangent of the problem on one set of pieces: a factored one and the changes since.
class ChangingTangent {
 public:
  explicit ChangingTangent(ContactTangent<2> factored) : factored_(std::move(factored)) {}

  int n_changes() const { return static_cast<int>(changes_.size()); }

  Unknowns solve(const Unknowns& residual) const {
    Unknowns x = factored_.solve(residual);
    for (const Change& change : changes_) change.apply(x);
    return x;
  }

  /// The change when a point leaves a piece through a border.
  Change change_at(const ReducedContact<2>& contact, int point, const Border& border, Piece from) const {
    // The difference of the two pieces' tangents is traction . normal^T, as the law is continuous.
    const Mat<2> before = tangent_of(from, contact.friction()),
                 after = tangent_of(border.beyond, contact.friction());
    const double squared = dot<2>(border.normal, border.normal);
    Vec<2> traction{};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) traction[i] += (after[i][j] - before[i][j]) * border.normal[j] / squared;
    Change change{point, border.normal, solve(contact.residual_of(point, traction)), 0};
    change.ratio = 1 + dot<2>(change.normal, change.solved.augmented[point]);
    return change;
  }

  void add_change(Change change) { changes_.push_back(std::move(change)); }

 private:
  ContactTangent<2> factored_;
  std::vector<Change> changes_;
};

/// The place at which a path from x along `direction` meets the next border.
struct Crossing {
  double distance = std::numeric_limits<double>::infinity();
  int point = -1;
  Border border = {};
};

Crossing next_crossing(const std::vector<Piece>& pieces, double friction, const Unknowns& x, double sense,
                       const Unknowns& direction) {
  Crossing next;
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Vec<2>& z = x.augmented[i];
    for (Border border : borders(pieces[i], z, friction)) {
      const double rate = sense * dot<2>(border.normal, direction.augmented[i]);
      if (rate >= 0) continue;
      const double distance = std::max(0.0, dot<2>(border.normal, z)) / -rate;
      if (distance >= next.distance) continue;
      if (pieces[i] == Piece::open)
        border.beyond = z[1] + distance * sense * direction.augmented[i][1] > 0 ? Piece::slide_forward
                                                                                : Piece::slide_backward;
      next = {distance, static_cast<int>(i), border};
    }
  }
  return next;
}

/// Perturbs the start: from symmetric starts many points would reach their borders at once.
void disturb(Unknowns& x) {
  constexpr double golden_ratio = 0.6180339887498949, relative = 1e-3;
  double fraction = 0;
  for (Vec<2>& z : x.augmented)
    for (double& component : z) {
      fraction = std::fmod(fraction + golden_ratio, 1);
      component *= 1 + relative * (fraction - 0.5);
    }
}

/// A point (x, t) of the path, in the middle of a piece or on its border, and the direction that leads on.
class Path {
 public:
  /// Empty if the tangent at the start is singular.
  static std::optional<Path> from(const ReducedContact<2>& contact, const Unknowns& start) {
    auto factored = ContactTangent<2>::at(contact, start);
    if (!factored) return {};
    return Path(contact, start, *std::move(factored));
  }

  const Unknowns& x() const { return x_; }

  /// Whether t = 1 lies on this piece; then the path goes there.
  bool ends() {
    const double left = 1 - t_;
    if (sense_ < 0 || next_.distance < left) return false;
    go(left);
    return true;
  }

  /// Continues to the next piece. Returns false if the path leads to infinity, its direction is undefined, or
  /// it does not leave a place where many pieces meet, because rounding decides its direction.
  bool turn() {
    if (next_.point < 0) return false;
    if (tangent_.n_changes() >= most_changes) refresh();
    if (tangent_.n_changes() >= most_changes_at_a_corner) return false;
    go(next_.distance);
    const Crossing crossing = next_;
    const Change change = change_at(crossing);
    if (change.is_singular()) {
      if (!pass(crossing, change)) return false;
    } else
      enter(crossing, change);
    look_ahead();
    return true;
  }

 private:
  /// Changes by which a factored tangent is corrected: a few percent of the unknowns.
  static constexpr int most_changes = 64;
  /// The same at a corner of the contact law, where the tangent cannot be factored anew.
  static constexpr int most_changes_at_a_corner = 4 * most_changes;

  Path(const ReducedContact<2>& contact, const Unknowns& start, ContactTangent<2> tangent)
      : contact_(&contact),
        x_(start),
        start_residual_(contact.residual(start)),
        pieces_(pieces_of(start)),
        tangent_(std::move(tangent)),
        rate_(tangent_.solve(start_residual_)) {
    look_ahead();
  }

  Change change_at(const Crossing& crossing) const {
    return tangent_.change_at(*contact_, crossing.point, crossing.border, pieces_[crossing.point]);
  }

  void enter(const Crossing& crossing, Change change) {
    if (change.ratio < 0) sense_ = -sense_;
    change.apply(rate_);
    tangent_.add_change(std::move(change));
    pieces_[crossing.point] = crossing.border.beyond;
  }

  /// Passes a piece whose tangent is singular, such as the one on which the last point that sticks begins to
  /// slide: there x moves along the tangent's null vector, as the rim does along the ground, while t stays,
  /// up to the border of another point. Both changes are made at once, as they commute: the other one first.
  bool pass(const Crossing& crossing, const Change& into) {
    std::vector<Piece> pieces = pieces_;
    pieces[crossing.point] = crossing.border.beyond;
    const Crossing other = next_crossing(pieces, contact_->friction(), x_, 1, into.solved);
    if (other.point < 0 || other.point == crossing.point) return false;
    add(other.distance, into.solved, x_);
    for (const Crossing* each : {&other, &crossing}) {
      Change change = change_at(*each);
      if (change.is_singular()) return false;
      enter(*each, std::move(change));
    }
    return true;
  }

  std::vector<Piece> pieces_of(const Unknowns& x) const {
    std::vector<Piece> result;
    for (const Vec<2>& z : x.augmented) result.push_back(piece_of(z, contact_->friction()));
    return result;
  }

  void look_ahead() { next_ = next_crossing(pieces_, contact_->friction(), x_, -sense_, rate_); }

  void go(double distance) {
    add(-sense_ * distance, rate_, x_);
    t_ += sense_ * distance;
  }

  /// Factors the tangent anew and removes the rounding errors of x. This is done in the middle of a piece,
  /// where the unknowns tell the pieces of all points; a piece that is too short for that is passed.
  void refresh() {
    Unknowns middle = x_;
    add(-sense_ * next_.distance / 2, rate_, middle);
    if (pieces_of(middle) != pieces_) return;
    auto factored = ContactTangent<2>::at(*contact_, middle);
    if (!factored) return;
    go(next_.distance / 2);
    tangent_ = ChangingTangent(*std::move(factored));
    Unknowns error = contact_->residual(x_);
    add(-(1 - t_), start_residual_, error);
    add(-1, tangent_.solve(error), x_);
    rate_ = tangent_.solve(start_residual_);
    look_ahead();
  }

  const ReducedContact<2>* contact_;
  Unknowns x_;
  double t_ = 0;
  Unknowns start_residual_;
  std::vector<Piece> pieces_;
  ChangingTangent tangent_;
  Unknowns rate_;     ///< -dx/dt
  double sense_ = 1;  ///< 1 if t increases along the path, -1 if it decreases
  Crossing next_;
};

}  // namespace

PathEnd<2> follow_path(const ReducedContact<2>& contact, ContactUnknowns<2> start, const Interrupt& interrupt,
                       int steps_before) {
  const int most_turns = 1000 + 20 * contact.n_points();
  disturb(start);
  PathEnd<2> end{std::move(start)};
  auto path = Path::from(contact, end.x);
  while (path && end.turns < most_turns && !interrupt.requested()) {
    interrupt.report({0, 1, steps_before + end.turns});
    end.arrives = path->ends();
    if (end.arrives || !path->turn()) break;
    ++end.turns;
  }
  if (end.arrives) end.x = path->x();
  return end;
}

}  // namespace wheelwright
