#include "wheelwright/case/bound_key.h"

namespace wheelwright {
namespace {

/// Binds a field to its value in the table.
template <class Struct>
struct FieldBinder {
  using Field = decltype(BoundKey::field);
  Struct& table;

  template <class Value>
  Place<BoundTable, Value> at(const Place<Struct, Value>& member) const {
    return Place<BoundTable, Value>(member.in(table));
  }

  Field operator()(const NumberField<Struct>& f) const {
    return NumberField<BoundTable>{at(f.member), f.range, f.factor};
  }
  Field operator()(const OptionalNumberField<Struct>& f) const {
    return OptionalNumberField<BoundTable>{at(f.member), f.range, f.default_text, f.factor};
  }
  Field operator()(const IntegerField<Struct>& f) const {
    return IntegerField<BoundTable>{at(f.member), f.range, f.default_text};
  }
  Field operator()(const OptionalIntegerField<Struct>& f) const {
    return OptionalIntegerField<BoundTable>{at(f.member), f.range, f.default_text, f.default_word};
  }
  Field operator()(const TextField<Struct>& f) const {
    return TextField<BoundTable>{at(f.member), f.default_text, f.rule};
  }
  Field operator()(const PointField<Struct>& f) const {
    return PointField<BoundTable>{at(f.member), f.range};
  }
  Field operator()(const OptionalPointField<Struct>& f) const {
    return OptionalPointField<BoundTable>{at(f.member), f.range, f.default_text};
  }
  Field operator()(const PointsField<Struct>& f) const {
    return PointsField<BoundTable>{at(f.member), f.range};
  }
  Field operator()(const LossFactorField<Struct>& f) const {
    return LossFactorField<BoundTable>{at(f.member), f.range, f.default_text};
  }
  Field operator()(const WordField<Struct>& f) const { return WordField<BoundTable>{at(f.member), f.words}; }
  Field operator()(const OptionalWordField<Struct>& f) const {
    return OptionalWordField<BoundTable>{at(f.member), f.words, f.default_text};
  }
  Field operator()(const ChoiceField<Struct>& f) const {
    return ChoiceField<BoundTable>{f.words, [&f, t = &table](const BoundTable&) { return f.get(*t); },
                                   [&f, t = &table](BoundTable&, int i) { f.set(*t, i); },
                                   [&f, t = &table](const BoundTable&) { return f.place(*t); }};
  }
  Field operator()(const QuantityField<Struct>& f) const { return QuantityField<BoundTable>{at(f.member)}; }
};

/// Its values are those of a quantity of this kind.
void set_range(BoundKey& key, UnitKind kind) {
  std::visit(
      [&](auto& field) {
        if constexpr (requires { field.range; }) field.range = values_of(kind);
      },
      key.field);
}

}  // namespace

template <class Struct>
BoundKeys bound(const std::vector<Key<Struct>>& keys, Struct& table) {
  BoundKeys result;
  result.reserve(keys.size());
  for (const Key<Struct>& key : keys)
    result.push_back({key.name, key.unit, std::visit(FieldBinder<Struct>{table}, key.field), key.meaning,
                      key.presence, key.instead_of});
  if constexpr (requires { table.quantity; })
    for (BoundKey& key : result)
      if (key.unit == unit_of_quantity) set_range(key, kind(table.quantity));
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(Struct) template BoundKeys bound(const std::vector<Key<Struct>>&, Struct&);
WHEELWRIGHT_INSTANTIATE(Case)
WHEELWRIGHT_INSTANTIATE(Wheel)
WHEELWRIGHT_INSTANTIATE(RingMaterial)
WHEELWRIGHT_INSTANTIATE(MaterialLayer)
WHEELWRIGHT_INSTANTIATE(MaterialCord)
WHEELWRIGHT_INSTANTIATE(Load)
WHEELWRIGHT_INSTANTIATE(CaseLoad)
WHEELWRIGHT_INSTANTIATE(Contact)
WHEELWRIGHT_INSTANTIATE(HoleRing)
WHEELWRIGHT_INSTANTIATE(HoleCircle)
WHEELWRIGHT_INSTANTIATE(HoleSphere)
WHEELWRIGHT_INSTANTIATE(HoleTapered)
WHEELWRIGHT_INSTANTIATE(HoleGroove)
WHEELWRIGHT_INSTANTIATE(SavedShape)
WHEELWRIGHT_INSTANTIATE(CircleShape)
WHEELWRIGHT_INSTANTIATE(EllipseShape)
WHEELWRIGHT_INSTANTIATE(SlotShape)
WHEELWRIGHT_INSTANTIATE(PolygonShape)
WHEELWRIGHT_INSTANTIATE(AnnulusShape)
WHEELWRIGHT_INSTANTIATE(SpokeShape)
WHEELWRIGHT_INSTANTIATE(FileShape)
WHEELWRIGHT_INSTANTIATE(PictureShape)
WHEELWRIGHT_INSTANTIATE(Grid)
WHEELWRIGHT_INSTANTIATE(GhostPenalty)
WHEELWRIGHT_INSTANTIATE(Heat)
WHEELWRIGHT_INSTANTIATE(Objective)
WHEELWRIGHT_INSTANTIATE(ObjectiveTerm)
WHEELWRIGHT_INSTANTIATE(Constraint)
WHEELWRIGHT_INSTANTIATE(Volume)
WHEELWRIGHT_INSTANTIATE(Optimizer)
WHEELWRIGHT_INSTANTIATE(Output)
WHEELWRIGHT_INSTANTIATE(Expectation)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
