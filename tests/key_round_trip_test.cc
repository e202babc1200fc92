#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/takes_any_case.h"
#include "wheelwright/case/case_key.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/key_value.h"
#include "wheelwright/case/load_values.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/run/commands/command_json.h"
#include "wheelwright/run/observers/command_log.h"

// Every key, with a value other than its default, by every path that carries it. The tests visit the
// declarations: a new key is in them at once, and fails wherever it was forgotten.

namespace wheelwright {
namespace {

using testing::TakesAnyCase;

// Structs that differ from one in a single key, by the kinds of fields.

std::vector<double> other_numbers(const Range& range, double now, double factor) {
  std::vector<double> numbers;
  for (const double x : {1.1 * now / factor, 0.5 * now / factor, 1.01 * now / factor, 0.001, 0.01, 0.1, 0.25,
                         0.5, 1.0, 1.5, 30.0, 1000.0})
    if (range.contains(x) && x * factor != now) numbers.push_back(x * factor);
  return numbers;
}

template <class Struct, class Field>
std::vector<Struct> variations_of(const Struct& s, const Field& field) {
  std::vector<Struct> result;
  const auto add = [&](const auto& value) {
    if constexpr (requires { field.member; }) field.member.in(result.emplace_back(s)) = value;
  };
  if constexpr (std::is_same_v<Field, NumberField<Struct>>) {
    for (const double x : other_numbers(field.range, field.member.in(s), field.factor)) add(x);
  } else if constexpr (std::is_same_v<Field, OptionalNumberField<Struct>>) {
    for (const double x : other_numbers(field.range, field.member.in(s).value_or(0), field.factor)) add(x);
  } else if constexpr (std::is_same_v<Field, IntegerField<Struct>>) {
    const int now = field.member.in(s);
    for (const int n : {now + 1, now - 1, 2 * now, now / 2})
      if (field.range.contains(n) && n != now) add(n);
  } else if constexpr (std::is_same_v<Field, OptionalIntegerField<Struct>>) {
    for (const int n : {1, 2}) add(n);
  } else if constexpr (std::is_same_v<Field, TextField<Struct>>) {
    for (const char* text : {"other \"text\"", "other", "kerb"}) add(text);
  } else if constexpr (std::is_same_v<Field, PointField<Struct>> ||
                       std::is_same_v<Field, OptionalPointField<Struct>>) {
    for (const double x : {0.28, 3.0}) add(std::array<double, 2>{x, 1.0 / 30});
    add(std::array{0.21, 0.23});  // ranges of radii of layers
    add(std::array{0.33, 0.332});
  } else if constexpr (std::is_same_v<Field, WordField<Struct>> ||
                       std::is_same_v<Field, OptionalWordField<Struct>>) {
    for (const std::string_view word : field.words)
      if (field.member.in(s) != std::string(word)) add(std::string(word));
  } else if constexpr (std::is_same_v<Field, PointsField<Struct>>) {
    const std::vector<std::array<double, 2>> some{{-0.1, 0}, {0, 0.001}, {0.1, 0}};
    add(field.member.in(s).empty() ? some : field.member.in(s));
    field.member.in(result[0])[1][0] += 1e-3;
  } else if constexpr (std::is_same_v<Field, LossFactorField<Struct>>) {
    add(LossFactor({{1.0 / 30, 0.05}, {100, 0.12}}));
    add(LossFactor(0.07));
  } else if constexpr (std::is_same_v<Field, QuantityField<Struct>>) {
    for (const Quantity& quantity : Quantities())
      if (quantity != field.member.in(s)) add(quantity);
  } else {
    for (int k = 0; k < static_cast<int>(field.words.size()); ++k)
      if (k != field.get(s)) field.set(result.emplace_back(s), k);
  }
  return result;
}

template <class Struct>
std::vector<Struct> variations(const Struct& s, const std::vector<Key<Struct>>& keys,
                               const Key<Struct>& key) {
  std::vector<Struct> result =
      std::visit([&](const auto& field) { return variations_of(s, field); }, key.field);
  for (Struct& other : result) reset_alternatives(other, keys, key);
  return result;
}

const std::filesystem::path in_folder_of_drawings = WHEELWRIGHT_SOURCE_DIR "/tests/drawings/case.toml";

Case a_wheel(int dimension) {
  Case c;
  c.wheel.dimension = dimension;
  c.wheel.sectors = 8;
  c.material = {{.youngs_modulus = 5e7, .poissons_ratio = 0.3, .density = 1000}, {}};
  c.contact.friction = 0.5;
  c.output.folder = "runs/here";
  return c;
}

template <class Struct>
void make_orthotropic(Struct& s) {
  s.youngs_modulus_radial = s.youngs_modulus_azimuthal = s.youngs_modulus_axial = 5e7;
  s.poissons_ratio_radial_azimuthal = s.poissons_ratio_radial_axial = s.poissons_ratio_azimuthal_axial = 0.3;
  s.shear_modulus_radial_azimuthal = s.shear_modulus_radial_axial = s.shear_modulus_azimuthal_axial = 2e7;
}

/// Cases each of which allows other keys to be changed.
std::vector<Case> starting_points() {
  std::vector<Case> cases;
  for (const int dimension : {2, 3}) {
    const Case plain = a_wheel(dimension);
    Case frictionless = plain, loads = plain, bounded = plain, minimizing = plain, orthotropic = plain;
    make_orthotropic(orthotropic.material);
    frictionless.contact.friction = 0;
    frictionless.contact.quadrature_points = 2;
    frictionless.grid.angular_cells = 96;
    frictionless.grid.tread_levels = 0;
    loads.load.cases = {{.name = "kerb"}};
    minimizing.objective.minimize = built_in("mean_travel");
    for (Case* c : {&loads, &bounded, &minimizing})
      c->constraints = {{.quantity = built_in("strain_energy"), .at_most = 5}};
    Case kerb = plain;
    kerb.load.ground = "kerb";
    kerb.load.ground_radius = 0.005;
    kerb.load.ground_height = 0.01;
    kerb.load.ground_profile = {{-0.1, 0}, {0, 0.001}, {0.1, 0}};
    Case equal = bounded;
    equal.constraints = {{.quantity = built_in("strain_energy"), .equals = 5}};
    for (const FatigueMeasure measure :
         {FatigueMeasure::crossland, FatigueMeasure::goodman, FatigueMeasure::principal_strain}) {
      Case tired = plain;
      FatigueConstants& constants = tired.material;
      constants = {.fatigue_measure = measure, .fatigue_exponent = 5};
      if (measure == FatigueMeasure::principal_strain)
        constants.fatigue_strain = 0.02;
      else
        constants.fatigue_limit = 2e6;
      if (measure == FatigueMeasure::crossland) constants.fatigue_pressure_factor = 0.3;
      if (measure == FatigueMeasure::goodman) constants.ultimate_strength = 2e7;
      cases.push_back(tired);
    }
    Case warm = plain;
    warm.material.loss_factor = 0.1;
    warm.material.conductivity = 0.3;
    warm.load.speed = 1;
    warm.heat.convection = 20;
    cases.push_back(warm);
    Case soft = plain;
    soft.contact.theta = 0;
    soft.material.model = MaterialModel::mooney_rivlin;
    soft.contact.gamma_0 = 20;
    soft.grid.tread_levels = 0;
    Case soft_layer = soft;
    soft_layer.layers = {MaterialLayer{}};
    soft_layer.layers[0].outer_radius = 0.25;
    Case layered = plain;
    layered.layers = {{.name = "kerb", .outer_radius = 0.25}};
    layered.layers[0].density = 2000;
    layered.objective.terms = {{.quantity = built_in("peak_von_mises")}};
    layered.constraints = {{.quantity = built_in("peak_von_mises"), .at_most = 1e6}};
    layered.expectations = {{.quantity = built_in("mass"), .value = 5}};
    Case of_layer = layered;
    of_layer.objective = {.minimize = built_in("peak_von_mises")};
    cases.insert(cases.end(), {plain, frictionless, loads, bounded, minimizing, equal, kerb, orthotropic,
                               layered, of_layer, soft, soft_layer});
    if (dimension == 3) {
      Case moulded = plain;
      moulded.optimizer.made = Manufacture::moulded;
      moulded.optimizer.parting_plane = 0.5 * moulded.wheel.width;
      cases.push_back(moulded);
      moulded.optimizer.parting_plane.reset();
      cases.push_back(moulded);
      Case printed = plain;
      printed.optimizer.made = Manufacture::printed;
      printed.optimizer.overhang = 0.5;
      printed.optimizer.stands_on = SideFace::larger_z;
      cases.push_back(printed);
    }
  }
  return cases;
}

const std::vector<HoleRing> a_ring{{.count = 16, .center_radius = 0.27, .radius = 0.01, .phase = {}}};

/// The case with tables of the section, of spokes one of each kind that has keys of its own.
template <class Struct>
Case with_tables(Case c, const SectionArray<Struct>& section) {
  auto& tables = section.in(c);
  if (tables.empty()) tables = {section.example};
  if constexpr (std::is_same_v<Struct, SpokeShape>) {
    tables.resize(4, section.example);
    tables[0].angle = 0.2;
    tables[1].kind = SpokeKind::curved;
    tables[1].bend = 0.5;
    tables[2].kind = SpokeKind::forked;
    tables[2].spread = 0.1;
    tables[3].inner_radius = 0.24;
    tables[3].outer_radius = 0.3;
  }
  if constexpr (std::is_same_v<Struct, MaterialLayer>) {
    tables.resize(2, section.example);
    tables[1].name = "core";
    tables[0].inner_radius.reset();
    tables[0].outer_radius = 0.22;
    if (c.contact.theta != 0)
      make_orthotropic(tables[1]);
    else  // large deformation, which knows isotropic layers only
      for (MaterialLayer& layer : tables) layer.model = MaterialModel::mooney_rivlin;
    static_cast<FatigueConstants&>(tables[1]) = c.material;
  }
  if constexpr (std::is_same_v<Struct, MaterialCord>) {  // another place for it is at 0.25 m
    c.layers = {material_layer_sections().example};
    c.layers[0].inner_radius = 0.235;
    c.layers[0].outer_radius = 0.255;
    c.layers[0].holes = LayerHoles::none;
  }
  if constexpr (requires { tables[0].order; })
    for (std::size_t i = 0; i < tables.size(); ++i) tables[i].order = static_cast<int>(i) + 1;
  if (c.holes == Holes{}) c.holes.rings = a_ring;
  return c;
}
template <class Struct>
Case with_tables(Case c, const Section<Struct>&) {
  c.holes.rings = a_ring;
  return c;
}

template <class Struct>
std::vector<Struct*> tables_of(Case& c, const SectionArray<Struct>& section) {
  std::vector<Struct*> tables;
  for (Struct& table : section.in(c)) tables.push_back(&table);
  return tables;
}
template <class Struct>
std::vector<Struct*> tables_of(Case& c, const Section<Struct>& section) {
  return {&section.in(c)};
}

/// Of the cases that differ from `c` in this key, the first one that is free of conflicts: written and read
/// back.
template <class SomeSection, class Struct>
std::optional<std::pair<Case, Case>> written_and_read(const Case& c, const SomeSection& section,
                                                      const Key<Struct>& key) {
  CaseResult start = parse_case(to_toml(with_tables(c, section)), in_folder_of_drawings);
  if (!start.value) return {};
  for (std::size_t i = 0; i < tables_of(*start.value, section).size(); ++i)
    for (const Struct& other : variations(*tables_of(*start.value, section)[i], section.keys, key)) {
      Case written = *start.value;
      *tables_of(written, section)[i] = other;
      if (CaseResult read = parse_case(to_toml(written), in_folder_of_drawings); read.value)
        return std::pair(std::move(written), *std::move(read.value));
    }
  return {};
}

/// Keys that need another file, or one with another picture: saved_shape_test and drawing_files_test have
/// them.
bool needs_another_file(std::string_view name) {
  return name == "path" || name == "from" || name == "checksum" || name == "layout";
}

TEST(KeyRoundTrip, EveryKeyIsWrittenToAFileAndReadBack) {
  const std::vector<Case> starts = starting_points();
  int n_keys = 0;
  for_each_section([&](const auto& section) {
    for (const auto& key : section.keys) {
      if (needs_another_file(key.name)) continue;
      std::set<int> dimensions;
      for (const Case& start : starts) {
        if (dimensions.contains(start.wheel.dimension)) continue;
        const auto both = written_and_read(start, section, key);
        if (!both) continue;
        EXPECT_TRUE(both->second == both->first) << section.name << "." << key.name;
        dimensions.insert(start.wheel.dimension);
      }
      EXPECT_FALSE(dimensions.empty()) << section.name << "." << key.name << ": no value is accepted";
      ++n_keys;
    }
  });
  EXPECT_GT(n_keys, 120);
}

/// Loads that differ from the default in one key.
std::vector<std::pair<std::string, Load>> loads_with_one_value() {
  std::vector<std::pair<std::string, Load>> loads;
  for (const Key<Load>& key : load_section().keys) {
    const std::vector<Load> others = variations(Load{}, load_section().keys, key);
    EXPECT_FALSE(others.empty()) << key.name;
    if (!others.empty()) loads.emplace_back(key.name, others.front());
  }
  return loads;
}

TEST(KeyRoundTrip, EveryValueOfALoadIsInTheLogOfCommands) {
  for (const auto& [name, load] : loads_with_one_value()) {
    const auto log = parse_command_log(log_line({{3, 1}, NewLoad{load, "kerb"}}));
    ASSERT_TRUE(log) << name << ": " << log.failure().reason;
    EXPECT_EQ(log->front().command.get_if<NewLoad>()->load, load) << name;
  }
}

/// A page sends back the load that it was sent, with one value changed.
std::string command_of_a_page(const Load& shown, const Load& wanted, std::optional<std::string> load_case) {
  using Json = nlohmann::ordered_json;
  Json command{{"do", "load"}};
  command.update(Json::parse(load_json(shown)));
  const Json values = Json::parse(load_json(wanted));
  for (const auto& [key, value] : values.items())
    if (!command.contains(key) || command[key] != value) command[key] = value;
  if (load_case) command["load_case"] = *load_case;
  return command.dump();
}

TEST(KeyRoundTrip, EveryValueOfALoadIsSetByAPage) {
  for (const auto& [name, load] : loads_with_one_value()) {
    TakesAnyCase run(a_wheel(3));
    const auto command = parse_command(command_of_a_page(run.current_case().load, load, {}));
    ASSERT_TRUE(command) << name << ": " << command.failure().reason;
    ASSERT_TRUE(command->execute(run)) << name;
    EXPECT_EQ(run.current_case().load, load) << name;
  }
}

TEST(KeyRoundTrip, ACommandSaysEveryValueThatActs) {
  std::set<std::string> said;
  for (const auto& [name, load] : loads_with_one_value()) said.insert(load_text(load));
  EXPECT_EQ(said.size() + 1, loads_with_one_value().size());  // mass and force are the same value
}

/// Load cases that change one value, with the name of its key.
std::vector<std::pair<std::string, CaseLoad>> load_cases_with_one_value() {
  std::vector<std::pair<std::string, CaseLoad>> cases;
  for (const Key<CaseLoad>& key : load_case_sections().keys)
    if (find_key(load_section().keys, key.name))
      cases.emplace_back(key.name,
                         variations(CaseLoad{.name = "kerb"}, load_case_sections().keys, key).front());
  return cases;
}

TEST(KeyRoundTrip, EveryValueOfALoadCaseReplacesThatOfItsSection) {
  for (const auto& [name, load_case] : load_cases_with_one_value()) {
    Case c = a_wheel(2);
    c.load.cases = {load_case};
    const Load single = with_load_case(c, 0).load;
    const auto wanted = value(*find_key(load_case_sections().keys, name), load_case);
    ASSERT_TRUE(wanted) << name;
    EXPECT_EQ(value(*find_key(load_section().keys, name), single), wanted) << name;
    Load others = single;
    set_value(*find_key(load_section().keys, name), others,
              value(*find_key(load_section().keys, name), Load{}));
    EXPECT_EQ(others, Load{}) << name;
  }
}

TEST(KeyRoundTrip, EveryValueOfALoadCaseIsSetByAPage) {
  for (const auto& [name, load_case] : load_cases_with_one_value()) {
    Case c = a_wheel(2);
    c.load.cases = {{.name = "road", .torque = 3}, {.name = "kerb", .speed = 5}};
    TakesAnyCase run(c);
    Case wanted = c;
    wanted.load.cases = {load_case};
    Load load = with_load_case(wanted, 0).load;
    const auto command = parse_command(command_of_a_page(with_load_case(c, 1).load, load, "kerb"));
    ASSERT_TRUE(command) << name << ": " << command.failure().reason;
    ASSERT_TRUE(command->execute(run)) << name;
    EXPECT_EQ(with_load_case(run.current_case(), 1).load, load) << name;
    EXPECT_EQ(with_load_case(run.current_case(), 0).load, with_load_case(c, 0).load) << name;
  }
}

}  // namespace
}  // namespace wheelwright
