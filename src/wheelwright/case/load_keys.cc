#include <type_traits>

#include "wheelwright/case/case_key.h"
#include "wheelwright/case/common_keys.h"
#include "wheelwright/case/ground_of.h"

namespace wheelwright {

namespace {

std::vector<Key<Load>> ground_keys() {
  return {
      {.name = "ground",
       .field = WordField<Load>{&Load::ground, {ground_words.begin(), ground_words.end()}},
       .meaning = "the rigid ground, straight along the axle; drum: the outside of a drum or roller; "
                  "internal_drum: the inside of a drum or ring; bar: a round bar on flat ground; kerb: a "
                  "step up "
                  "towards larger azimuth; profile: that of ground_profile"},
      {.name = "ground_radius",
       .unit = "m",
       .field = OptionalNumberField<Load>{&Load::ground_radius, length, "none"},
       .meaning = "radius of the drum, of the bar, or of the kerb's edge, which is sharp without it"},
      {.name = "ground_height",
       .unit = "m",
       .field = OptionalNumberField<Load>{&Load::ground_height, length, "none"},
       .meaning = "height of the kerb, or of the bar's highest line, above the flat ground, on which the "
                  "bar lies without it; a bar as high as its radius is half sunk"},
      {.name = "ground_place",
       .unit = "m",
       .field = NumberField<Load>{&Load::ground_place, between(-1000, 1000)},
       .meaning = "where the bar's axis, the kerb's face or the profile's origin is along the ground, from "
                  "below the axle, towards larger azimuth"},
      {.name = "ground_profile",
       .unit = "m",
       .field = PointsField<Load>{&Load::ground_profile, between(-1000, 1000), "none"},
       .meaning =
           "[[along, height], ...]: points of the ground, ascending along it, with straight lines "
           "between them and level ground beyond; heights are above flat ground; or the name of a CSV file "
           "with these two columns"}};
}

/// With the keys of the ground before its last one.
Section<Load> with_ground(Section<Load> section) {
  const auto keys = ground_keys();
  section.keys.insert(section.keys.end() - 1, keys.begin(), keys.end());
  return section;
}

}  // namespace

const Section<Load>& load_section() {
  static const Section<Load> section = with_ground(
      {.name = "load",
       .meaning = "the load on the wheel, the same in all load positions",
       .in = [](Case& c) -> Load& { return c.load; },
       .keys = {
           {.name = "mass",
            .unit = "kg",
            .field = NumberField<Load>{&Load::force, between(1e-9, 1e9), standard_gravity},
            .meaning = "mass carried by the whole width, under 9.81 m/s^2"},
           {.name = "force",
            .unit = "N",
            .field = NumberField<Load>{&Load::force, between(1e-8, 1e10)},
            .meaning = "force carried by the whole width",
            .instead_of = "mass"},
           {.name = "travel",
            .unit = "m",
            .field = OptionalNumberField<Load>{&Load::travel, above(0, 1000), "the rim carries the load"},
            .meaning = "prescribed travel of the rim towards the ground; the force is then a result",
            .instead_of = "mass"},
           {.name = "horizontal_force",
            .unit = "N",
            .field = NumberField<Load>{&Load::horizontal_force, between(-1e10, 1e10)},
            .meaning = "force on the rim along the ground, towards larger azimuth, on the whole width; "
                       "if it is 0 the rim does not move along the ground"},
           {.name = "lateral_force",
            .unit = "N",
            .field = NumberField<Load>{&Load::lateral_force, between(-1e10, 1e10)},
            .meaning = "in 3D, force on the rim along the axle, towards larger z; if it is 0 the rim does "
                       "not move along the axle"},
           {.name = "camber",
            .unit = "deg",
            .field = NumberField<Load>{&Load::camber, between(-30, 30), degree_of_arc},
            .meaning =
                "in 3D, the angle by which the wheel leans: its side at larger z is closer to the ground"},
           {.name = "torque",
            .unit = "N m",
            .field = NumberField<Load>{&Load::torque, between(-1e10, 1e10)},
            .meaning = "driving or braking torque on the rim, towards larger azimuth, on the whole "
                       "width; if it is 0 the rim does not turn"},
           {.name = "body_force",
            .unit = "N/m^3",
            .field = PointField<Load>{&Load::body_force, between(-1e12, 1e12)},
            .meaning = "[along, down]: force per volume of the structure, along the ground towards "
                       "larger azimuth, and downwards; [0, 9.81 * density] is its weight"},
           {.name = "hole_pressure",
            .unit = "Pa",
            .field = NumberField<Load>{&Load::hole_pressure, between(-1e12, 1e12)},
            .meaning = "pressure p on the boundary of the holes: g_N = -p n in (1)"},
           {.name = "speed",
            .unit = "m/s",
            .field = NumberField<Load>{&Load::speed, between(0, 1000)},
            .meaning = "speed v of the axle along the ground: centrifugal load density (v / R_e)^2 r per "
                       "volume; travel and stiffness are measured from where the rotating "
                       "wheel stands without load; needs material.density"},
           {.name = "positions",
            .field = IntegerField<Load>{&Load::positions, between(1, 1000)},
            .meaning = "N_d: number of load positions per sector, any on any grid"}}});
  return section;
}

namespace {

constexpr std::string_view unchanged = "that of [load]";

/// The keys of [load] that set `of_section`, for load cases, where they set `of_case`.
template <class Of, class Value>
void add_changeable(std::vector<Key<CaseLoad>>& keys, Of Load::*of_section,
                    std::optional<Value> CaseLoad::*of_case) {
  const Load sample;
  for (const Key<Load>& key : load_section().keys) {
    if (place(key, sample) != &(sample.*of_section)) continue;
    std::visit(
        [&](const auto& field) {
          const auto add = [&](auto field_of_case) {
            keys.push_back({.name = key.name,
                            .unit = key.unit,
                            .field = std::move(field_of_case),
                            .meaning = key.meaning,
                            .instead_of = key.instead_of});
          };
          constexpr bool is_number = std::is_same_v<Value, double>,
                         is_word = std::is_same_v<Value, std::string>;
          if constexpr (is_number && requires { field.factor; })
            add(OptionalNumberField<CaseLoad>{of_case, field.range, unchanged, field.factor});
          else if constexpr (is_word && requires { field.words; })
            add(OptionalWordField<CaseLoad>{of_case, field.words, unchanged});
          else if constexpr (!is_number && !is_word && requires { field.range; })
            add(OptionalPointField<CaseLoad>{of_case, field.range, unchanged});
        },
        key.field);
  }
}

/// The keys of a load case: all that it does not have are those of [load] for all load cases.
std::vector<Key<CaseLoad>> load_case_keys() {
  std::vector<Key<CaseLoad>> keys{
      {.name = "name",
       .field = TextField<CaseLoad>{&CaseLoad::name, ""},
       .meaning = "a word of letters, digits, - and _, for constraints and for the columns of history.csv",
       .presence = Presence::required},
      {.name = "weight",
       .field = NumberField<CaseLoad>{&CaseLoad::weight, between(0, 1e9)},
       .meaning = "weight of this load in the objective; 0: it is used only in constraints"},
      {.name = "distance_share",
       .field = OptionalNumberField<CaseLoad>{&CaseLoad::distance_share, between(0, 1),
                                              "no life under all load cases is shown"},
       .meaning = "share of the distance that is driven under this load, for the fatigue life under all load "
                  "cases; all of them have one, 1 in sum"}};
  add_changeable(keys, &Load::force, &CaseLoad::force);
  add_changeable(keys, &Load::travel, &CaseLoad::travel);
  add_changeable(keys, &Load::horizontal_force, &CaseLoad::horizontal_force);
  add_changeable(keys, &Load::torque, &CaseLoad::torque);
  add_changeable(keys, &Load::body_force, &CaseLoad::body_force);
  add_changeable(keys, &Load::hole_pressure, &CaseLoad::hole_pressure);
  add_changeable(keys, &Load::speed, &CaseLoad::speed);
  add_changeable(keys, &Load::ground, &CaseLoad::ground);
  add_changeable(keys, &Load::ground_radius, &CaseLoad::ground_radius);
  add_changeable(keys, &Load::ground_height, &CaseLoad::ground_height);
  add_changeable(keys, &Load::ground_place, &CaseLoad::ground_place);
  const Key<Load>& profile = *find_key(load_section().keys, "ground_profile");
  keys.push_back({.name = profile.name,
                  .unit = profile.unit,
                  .field = PointsField<CaseLoad>{&CaseLoad::ground_profile,
                                                 std::get<PointsField<Load>>(profile.field).range, unchanged},
                  .meaning = profile.meaning});
  return keys;
}

CaseLoad example_load_case() {
  CaseLoad kerb;
  kerb.name = "kerb";
  kerb.force = 600 * standard_gravity;
  return kerb;
}

}  // namespace

const SectionArray<CaseLoad>& load_case_sections() {
  static const SectionArray<CaseLoad> sections{
      .parent = "load",
      .name = "case",
      .meaning =
          "one of several loads under which the wheel is optimized, all with one factorization; missing keys "
          "are taken from [load]; the first one is the load of pictures, pressures and numbers without a "
          "load case ([several loads](optimization.md))",
      .in = [](Case& c) -> std::vector<CaseLoad>& { return c.load.cases; },
      .example = example_load_case(),
      .keys = load_case_keys()};
  return sections;
}

Section<Load> load_section(const Load& load) {
  Section<Load> section = load_section();
  for (std::size_t i = 0; i < load.own.size(); ++i) {
    const OwnLoadKey& key = *load.own[i].key;
    section.keys.push_back({.name = key.name,
                            .unit = key.unit,
                            .field = NumberField<Load>{Place<Load, double>(i), key.range, key.factor},
                            .meaning = key.meaning});
  }
  return section;
}

SectionArray<CaseLoad> load_case_sections(const Load& load) {
  using OfCase = Place<CaseLoad, std::optional<double>>;
  SectionArray<CaseLoad> sections = load_case_sections();
  sections.blank.own = no_changes(load.own);
  for (std::size_t i = 0; i < load.own.size(); ++i) {
    const OwnLoadKey& key = *load.own[i].key;
    sections.keys.push_back(
        {.name = key.name,
         .unit = key.unit,
         .field = OptionalNumberField<CaseLoad>{OfCase(i), key.range, unchanged, key.factor},
         .meaning = key.meaning});
  }
  return sections;
}

}  // namespace wheelwright
