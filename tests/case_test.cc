#include "wheelwright/case/case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <tuple>

#include "wheelwright/case/conflicts.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/number_text.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/suggest.h"
#include "wheelwright/case/toml_guard.h"
#include "wheelwright/case/write.h"
#include "wheelwright/files/checksum.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

using Kind = Diagnostic::Kind;

const std::filesystem::path source(WHEELWRIGHT_SOURCE_DIR);

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<std::filesystem::path> toml_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

std::string texts(const std::vector<Diagnostic>& problems) {
  std::string result;
  for (const auto& problem : problems) result += problem.text() + "\n";
  return result;
}

std::string kind_name(Kind kind) {
  switch (kind) {
    case Kind::unreadable:
      return "unreadable";
    case Kind::empty:
      return "empty";
    case Kind::syntax:
      return "syntax";
    case Kind::unknown_key:
      return "unknown_key";
    case Kind::missing_key:
      return "missing_key";
    case Kind::wrong_type:
      return "wrong_type";
    case Kind::out_of_range:
      return "out_of_range";
    case Kind::conflict:
      return "conflict";
    case Kind::drawing:
      return "drawing";
  }
  return "";
}

using Place = std::tuple<int, std::string, std::string>;  // line, kind, key

/// The problems that the comments "#! kind key kind key" of a bad case announce.
std::multiset<Place> announced(const std::string& text) {
  std::multiset<Place> result;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto mark = line.find("#! ");
    if (mark == std::string::npos) continue;
    std::istringstream words(line.substr(mark + 3));
    std::string kind, key;
    while (words >> kind) {
      if (kind != "syntax" && kind != "empty") words >> key;
      result.emplace(number, kind, key);
      key.clear();
    }
  }
  return result;
}

std::multiset<Place> places(const std::vector<Diagnostic>& problems) {
  std::multiset<Place> result;
  for (const auto& problem : problems) result.emplace(problem.line, kind_name(problem.kind), problem.key);
  return result;
}

Case with_holes() {
  Case c;
  c.output.folder = "runs/test";
  c.holes.rings = {ring_sections().example};
  c.holes.circles = {circle_sections().example};
  int order = 0;
  for_each_shape_section([&](const auto& section) {
    section.in(c) = {section.example};
    section.in(c)[0].order = ++order;
  });
  const auto drawings = source / "tests" / "drawings";
  const auto place = [&](auto& shape) {
    shape.path = drawings / shape.path;
    shape.checksum = fmt::format("crc32:{:08x}", checksum(contents(shape.path)));
  };
  place(c.shapes.files[0]);
  place(c.shapes.pictures[0]);
  c.expectations = {expectation_sections().example};
  return c;
}

TEST(Syntax, InvalidBytesAreReportedOncePerLine) {
  const auto problems = parse_case("[wheel]\n# caf\xe9 \xe9\n# fine\n#  \xff\n", "case.toml").problems;
  std::vector<std::pair<int, int>> places;
  for (const Diagnostic& d : problems)
    if (d.kind == Diagnostic::Kind::syntax) places.emplace_back(d.line, d.column);
  EXPECT_EQ(places, (std::vector<std::pair<int, int>>{{2, 6}, {4, 4}}));
}

TEST(CaseFile, EveryProblemOfEveryBadCaseIsReportedOnItsLine) {
  const auto files = toml_files(source / "tests" / "bad_cases");
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    const CaseResult result = read_case(file);
    EXPECT_FALSE(result.value) << file;
    EXPECT_EQ(places(result.problems), announced(contents(file))) << texts(result.problems);
  }
}

TEST(CaseFile, ProblemsComeInTheOrderOfTheFile) {
  const auto problems = read_case(source / "tests" / "bad_cases" / "everything.toml").problems;
  EXPECT_TRUE(std::is_sorted(problems.begin(), problems.end(),
                             [](const auto& a, const auto& b) { return a.line < b.line; }));
}

TEST(CaseFile, EveryExampleIsAccepted) {
  for (const char* folder : {"cases", "cases/paper"}) {
    for (const auto& file : toml_files(source / folder)) {
      const CaseResult result = read_case(file);
      EXPECT_TRUE(result.value) << texts(result.problems);
    }
  }
}

TEST(CaseFile, HolesOfThePapersWheel) {
  const CaseResult result = read_case(source / "cases" / "holes16.toml");
  ASSERT_TRUE(result.value) << texts(result.problems);
  Case expected;
  expected.title = result.value->title;
  expected.output.folder = "runs/holes16";
  expected.optimizer.method = OptimizerMethod::descent;
  expected.optimizer.tolerance = 0;
  expected.optimizer.rim_band = 0.005;
  expected.optimizer.tread_band = 0.01;
  expected.grid.tread_levels = 0;
  expected.holes.rings = {{.count = 16, .center_radius = 0.27, .radius = 0.04, .phase = {}}};
  EXPECT_EQ(*result.value, expected);
  const auto holes = sector_holes(*result.value);
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_DOUBLE_EQ(holes[0].centre_azimuth, sector_angle(*result.value) / 2);
}

TEST(CaseFile, OmittedKeysHaveTheirDefaults) {
  Case expected;
  expected.output.folder = "runs/short";
  const CaseResult result = parse_case("[wheel]", "some/short.toml");
  ASSERT_TRUE(result.value) << texts(result.problems);
  EXPECT_EQ(*result.value, expected);
}

TEST(CaseFile, TheTemplateIsTheDefaultCaseWithOneRing) {
  Case expected;
  expected.output.folder = "runs/template";
  expected.holes.rings = {ring_sections().example};
  const CaseResult result = parse_case(case_template(), "template.toml");
  ASSERT_TRUE(result.value) << texts(result.problems);
  EXPECT_EQ(*result.value, expected);
}

/// Removes the comment sign of every key of the template that is commented out.
std::string with_all_keys(std::string text) {
  std::istringstream lines(text);
  std::string line, result;
  bool is_solid = false;  // of a section of holes that need the width of the wheel
  while (std::getline(lines, line)) {
    if (line.find('[') < 2)
      is_solid = line.find("[[holes.sphere]]") < 2 || line.find("[[holes.tapered]]") < 2 ||
                 line.find("[[holes.groove]]") < 2;
    const bool has_value = !line.ends_with("=") && !is_solid;
    if (line.size() > 1 && line[0] == '#' && line[1] != ' ' && has_value) line.erase(0, 1);
    if (!line.starts_with("force")) result += line + "\n";
  }
  return result;
}

TEST(CaseFile, TheTemplatesCommentedHolesAreValid) {
  const CaseResult result =
      parse_case(with_all_keys(case_template()), source / "tests" / "drawings" / "template.toml");
  ASSERT_TRUE(result.value) << texts(result.problems);
  EXPECT_EQ(result.value->holes.circles, std::vector{circle_sections().example});
  EXPECT_EQ(result.value->expectations, std::vector{expectation_sections().example});
}

TEST(CaseFile, AResolvedCaseReadsBackEqual) {
  Case c = with_holes();
  c.title = "quotes \" and \\ and a bell \a, umlaut ü\n";
  c.load.force = 1e4 / 3;
  c.load.horizontal_force = -123.4;
  c.load.body_force = {-1.5, 1e4 / 7};
  c.load.hole_pressure = 2e4;
  c.contact = {.method = ContactMethod::penalty,
               .theta = 1.0 / 3,
               .gamma_0 = 12.5,
               .friction = 0.3,
               .quadrature_points = 20};
  c.grid.level_set_degree = 1;
  c.grid.tread_levels = 3;
  c.ghost_penalty = {.kind = GhostPenaltyKind::paper, .xi = 1e-3};
  c.volume = {.control = VolumeControl::paper, .target = 0.7};
  c.objective = {.strain_energy = 0.5,
                 .uniformity_dual = 100,
                 .uniformity_l2 = 2,
                 .annulus_matches_dual = 7,
                 .annulus = 0.005,
                 .length = 0.02,
                 .mean = MeanStress::held,
                 .terms = {{.quantity = built_in("peak_pressure"), .weight = 0.25}}};
  c.optimizer.velocity = VelocityKind::harmonic;
  c.optimizer.rim_band = 0.006;
  c.optimizer.tread_band = 0.011;
  c.output.pictures_every = 3;
  c.expectations = {
      {.quantity = built_in("uniformity_dual"), .value = 1.0 / 3, .margin = 0.2, .iteration = 0},
      {.quantity = built_in("peak_von_mises"), .value = 2e6, .iteration = {}}};
  const CaseResult result = parse_case(to_toml(c), "resolved.toml");
  ASSERT_TRUE(result.value) << texts(result.problems);
  EXPECT_EQ(*result.value, c);
}

TEST(CaseFile, ATravelInsteadOfALoadReadsBackEqual) {
  Case c = with_holes();
  c.load.travel = 5e-4;
  c.load.torque = 12;
  c.contact.friction = 0.3;
  const CaseResult result = parse_case(to_toml(c), "resolved.toml");
  ASSERT_TRUE(result.value) << texts(result.problems);
  EXPECT_EQ(*result.value, c);
}

TEST(CaseFile, RandomNumbersInOtherUnitsSurviveReadingAndWriting) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> degrees(-360, 360), kilograms(1, 1e4);
  for (int i = 0; i < 200; ++i) {
    const std::string text = fmt::format(
        "[load]\nmass = {}\n[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.04\nphase = {}\n",
        kilograms(random), degrees(random));
    const CaseResult first = parse_case(text, "random.toml");
    ASSERT_TRUE(first.value) << texts(first.problems);
    const CaseResult second = parse_case(to_toml(*first.value), "random.toml");
    ASSERT_TRUE(second.value) << texts(second.problems);
    EXPECT_EQ(*second.value, *first.value);
  }
}

TEST(CaseFile, UnitsBecomeSi) {
  const auto by_mass = parse_case("[load]\nmass = 100", "x.toml"),
             by_force = parse_case("[load]\nforce = 981", "x.toml");
  EXPECT_DOUBLE_EQ(by_mass.value->load.force, by_force.value->load.force);
  const auto ring =
      parse_case("[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.04\nphase = 90\n", "x.toml");
  EXPECT_DOUBLE_EQ(*ring.value->holes.rings[0].phase, std::numbers::pi / 2);
}

TEST(CaseFile, TheReferencePageIsFresh) {
  EXPECT_EQ(contents(source / "docs" / "case-reference.md"), case_reference_markdown())
      << "write it again: wheelwright reference > docs/case-reference.md";
}

TEST(CaseFile, UnreadableFilesAreReported) {
  const std::filesystem::path folder = source / "cases", fails_when_read = "/proc/self/mem";
  for (const auto& file : {folder / "no_such_file.toml", folder, folder / "holes16.toml" / "x",
                           std::filesystem::path(), fails_when_read}) {
    const auto problems = read_case(file).problems;
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].kind, Kind::unreadable);
  }
}

TEST(CaseFile, EndlessFileIsTooLong) {
  const auto problems = read_case("/dev/zero").problems;
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].kind, Kind::syntax);
}

TEST(CaseFile, MistakesInTheSyntaxDoNotHideOneAnother) {
  std::string text = "[wheel]\n";
  std::multiset<Place> expected;
  for (int line = 2; line <= 11; ++line) {
    text += line % 2 ? fmt::format("unknown_{} = 1\n", line) : "width = 1 m\n";
    if (line % 2)
      expected.emplace(line, "unknown_key", fmt::format("wheel.unknown_{}", line));
    else
      expected.emplace(line, "syntax", "");
  }
  EXPECT_EQ(places(parse_case(text, "x.toml").problems), expected);
}

// Every key in turn, with values that it must refuse.

struct BadValue {
  std::string value;
  Kind kind;
};

std::vector<BadValue> beyond(const Range& range) {
  const double step = 1 + std::abs(range.high) * 1e-3;
  return {{fmt::format("{:.0f}", std::floor(range.low - step)), Kind::out_of_range},
          {fmt::format("{:.0f}", std::ceil(range.high + step)), Kind::out_of_range}};
}

template <class Field>
constexpr bool is_point = false;
template <class Struct>
constexpr bool is_point<PointField<Struct>> = true;
template <class Struct>
constexpr bool is_point<OptionalPointField<Struct>> = true;

template <class Field>
constexpr bool is_list_of_points = false;
template <class Struct>
constexpr bool is_list_of_points<PointsField<Struct>> = true;

template <class Field>
std::vector<BadValue> bad_values(const Field& field) {
  if constexpr (
      requires { field.words; } || requires { field.built_in_words(); }) {
    return {{"\"no such word\"", Kind::out_of_range}, {"1", Kind::wrong_type}, {"true", Kind::wrong_type}};
  } else if constexpr (!requires { field.range; }) {
    return {{"1", Kind::wrong_type}, {"[]", Kind::wrong_type}, {"{}", Kind::wrong_type}};
  } else if constexpr (is_list_of_points<Field>) {
    return {{"1.0", Kind::wrong_type},
            {"[0.27, 0.01]", Kind::wrong_type},
            {"[[0.27, 0.01], [0.28, 0.01], [0.28]]", Kind::wrong_type},
            {"[[0.27, 0.01], [0.28, \"0\"], [0.28, 0.02]]", Kind::wrong_type},
            {"[[0.27, 0.01], [0.28, 0.01]]", Kind::out_of_range},
            {"[[0.27, nan], [0.28, 0.01], [0.28, 0.02]]", Kind::out_of_range}};
  } else if constexpr (is_point<Field>) {
    return {{"1.0", Kind::wrong_type},
            {"[1, 2, 3]", Kind::wrong_type},
            {"[0.27, \"0\"]", Kind::wrong_type},
            {"[nan, 0]", Kind::out_of_range},
            {"[0.27, inf]", Kind::out_of_range}};
  } else {
    auto values = beyond(field.range);
    for (const char* wrong : {"\"1\"", "true", "[1]", "{}", "1979-05-27"})
      values.push_back({wrong, Kind::wrong_type});
    return values;
  }
}

/// The case as a file in which the line of one key is replaced.
struct Edited {
  std::string text;
  int line;
};

/// A wheel in 3D with all kinds of holes.
Case with_solid_holes() {
  Case c;
  c.output.folder = "runs/test";
  c.wheel.dimension = 3;
  c.holes.spheres = {sphere_sections().example};
  c.holes.tapered = {tapered_sections().example};
  c.holes.grooves = {groove_sections().example};
  return c;
}

/// A wheel that begins with a saved shape.
Case with_saved_shape() {
  static const auto file =
      std::filesystem::temp_directory_path() / fmt::format("wheelwright_{}.levelset", getpid());
  Case c = with_solid_holes();
  c.wheel.dimension = 2;
  c.holes = {};
  c.holes.rings = {ring_sections().example};
  const std::string bytes = level_set_file(initial_shape<2>(c));
  std::ofstream(file, std::ios::binary) << bytes;
  c.holes = {};
  c.saved_shape.from = file;
  c.saved_shape.checksum = fmt::format("crc32:{:08x}", checksum(std::string(bytes.rbegin(), bytes.rend())));
  return c;
}

/// A case without problems that has the section.
Case case_with(const std::string& header) {
  if (header == "[[holes.sphere]]" || header == "[[holes.tapered]]" || header == "[[holes.groove]]")
    return with_solid_holes();
  if (header == "[shape]") return with_saved_shape();
  Case c = with_holes();
  c.constraints = {constraint_sections().example};
  c.constraints[0].at_least = 1;
  if (header == "[[load.case]]") c.load.cases = {load_case_sections().example};
  if (header == "[[material.layer]]") c.layers = {material_layer_sections().example};
  if (header == "[[material.cord]]") c.cords = {material_cord_sections().example};
  if (header == "[[objective.term]]") c.objective.terms = {objective_term_sections().example};
  return c;
}

Edited replace_key(const std::string& header, std::string_view key, std::string_view replaced_by) {
  std::istringstream lines(to_toml(case_with(header)));
  std::string line, text;
  bool inside = header.empty();
  int place = 0;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.starts_with("[")) inside = line == header;
    const bool here =
        inside && place == 0 &&
        (line.starts_with(fmt::format("{} =", key)) || line.starts_with(fmt::format("# {}:", key)));
    if (here) place = number;
    text += (here ? std::string(replaced_by) : line) + "\n";
  }
  return {text, place};
}

template <class SomeSection>
std::string header_of(const SomeSection& section) {
  if constexpr (requires { section.path(); })
    return fmt::format("[[{}]]", section.path());
  else
    return section.name.empty() ? "" : fmt::format("[{}]", section.name);
}

void expect_only(const Edited& edited, Kind kind) {
  const CaseResult result = parse_case(edited.text, "edited.toml");
  ASSERT_GT(edited.line, 0) << edited.text;
  ASSERT_EQ(result.problems.size(), 1u) << edited.text << texts(result.problems);
  EXPECT_EQ(result.problems[0].line, edited.line) << texts(result.problems);
  EXPECT_EQ(kind_name(result.problems[0].kind), kind_name(kind)) << texts(result.problems);
}

/// The key whose line in the resolved case is replaced: `force` stands for `mass` and `travel` too.
template <class Struct>
std::string_view written_key(const std::vector<Key<Struct>>& keys, const Key<Struct>& key) {
  std::string_view written = key.name;
  for (const auto& other : keys)
    if (are_alternatives(other, key) && std::holds_alternative<NumberField<Struct>>(other.field))
      written = other.name;
  // Two names of one optional number: the later one is written.
  for (const auto& other : keys)
    for (const auto& same : keys) {
      const auto* number = std::get_if<OptionalNumberField<Struct>>(&other.field);
      const auto* twin = std::get_if<OptionalNumberField<Struct>>(&same.field);
      if (number && twin && &other > &same && number->member == twin->member && are_alternatives(other, key))
        written = other.name;
    }
  return written;
}

TEST(CaseKeys, EveryKeyRefusesValuesOutOfRangeAndOfTheWrongType) {
  int tried = 0;
  for_each_section([&](const auto& section) {
    for (const auto& key : section.keys) {
      const auto values = std::visit([](const auto& field) { return bad_values(field); }, key.field);
      for (const BadValue& bad : values) {
        const std::string line = fmt::format("{} = {}", key.name, bad.value);
        expect_only(replace_key(header_of(section), written_key(section.keys, key), line), bad.kind);
        ++tried;
      }
    }
  });
  EXPECT_GT(tried, 200);
}

double just_below(double x) { return x == 0 ? -1e-300 : std::nextafter(x, -HUGE_VAL); }
double just_above(double x) { return -just_below(-x); }

std::string exact_text(double x) { return fmt::format("{:.17g}", x); }

/// The values of a range that end it, and those next to them that are beyond it, as a file writes them.
struct RangeEnds {
  std::vector<std::string> inside, outside;
};

RangeEnds ends(const Range& range, bool whole) {
  if (whole)
    return {{fmt::format("{:.0f}", range.low), fmt::format("{:.0f}", range.high)},
            {fmt::format("{:.0f}", range.low - 1), fmt::format("{:.0f}", range.high + 1), "2147483648",
             "-2147483649", "4294967297", "9223372036854775807", "-9223372036854775808"}};
  const bool low_open = range.low_end == Range::End::open, high_open = range.high_end == Range::End::open;
  return {{exact_text(low_open ? just_above(range.low) : range.low),
           exact_text(high_open ? just_below(range.high) : range.high)},
          {exact_text(low_open ? range.low : just_below(range.low)),
           exact_text(high_open ? range.high : just_above(range.high)), "1e300", "-1e300"}};
}

TEST(CaseKeys, EveryRangeEndsWhereItIsDeclared) {
  int tried = 0;
  const auto try_key = [&](const auto& section, const auto& key, const auto& field) {
    if constexpr (requires { field.range; }) {
      using Field = std::decay_t<decltype(field)>;
      const bool point = is_point<Field>;
      const RangeEnds values = ends(
          field.range, !point && !is_list_of_points<Field> && !requires { field.factor; });
      const auto edited = [&](const std::string& value) {
        const auto form = is_list_of_points<Field> ? "{} = [[0.27, 0.01], [0.28, {}], [0.28, 0.02]]"
                          : point                  ? "{} = [0.27, {}]"
                                                   : "{} = {}";
        return replace_key(header_of(section), written_key(section.keys, key),
                           fmt::format(fmt::runtime(form), key.name, value));
      };
      for (const auto& value : values.outside) expect_only(edited(value), Kind::out_of_range);
      for (const auto& value : values.inside)
        for (const auto& problem : parse_case(edited(value).text, "x.toml").problems)
          EXPECT_EQ(kind_name(problem.kind), "conflict") << problem.text();
      tried += static_cast<int>(values.outside.size());
    }
  };
  for_each_section([&](const auto& section) {
    for (const auto& key : section.keys)
      std::visit([&](const auto& field) { try_key(section, key, field); }, key.field);
  });
  EXPECT_GT(tried, 200);
}

TEST(CaseKeys, NoNumberMayBeNanOrInfinite) {
  for_each_section([&](const auto& section) {
    for (const auto& key : section.keys) {
      const bool is_real = std::visit(
          [](const auto& field) {
            return requires { field.factor; };
          },
          key.field);
      if (!is_real) continue;
      for (const char* bad : {"nan", "-nan", "inf", "-inf"})
        expect_only(replace_key(header_of(section), written_key(section.keys, key),
                                fmt::format("{} = {}", key.name, bad)),
                    Kind::out_of_range);
    }
  });
}

TEST(CaseKeys, EveryMisspeltKeyIsUnknownAndItsRightNameIsSuggested) {
  for_each_section([&](const auto& section) {
    for (const auto& key : section.keys) {
      const auto* replaced = find_key(section.keys, key.instead_of);
      const bool is_needed =
          key.presence == Presence::required || (replaced && replaced->presence == Presence::required);
      if (is_needed || key.name.size() < 4) continue;
      const std::string misspelt = fmt::format("{}{}", key.name, key.name.back());
      const Edited edited =
          replace_key(header_of(section), written_key(section.keys, key), misspelt + " = 1");
      expect_only(edited, Kind::unknown_key);
      const auto problems = parse_case(edited.text, "edited.toml").problems;
      EXPECT_NE(problems.at(0).remedy.find(key.name), std::string::npos) << texts(problems);
    }
  });
}

TEST(CaseKeys, EveryDefaultIsInRange) {
  const CaseResult result = parse_case(to_toml(with_holes()), "x.toml");
  EXPECT_TRUE(result.value) << texts(result.problems);
}

TEST(Suggestion, EditDistanceIsAMetricOnExamples) {
  EXPECT_EQ(edit_distance("sectors", "sectors"), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("sitting", "kitten"), 3);
  EXPECT_EQ(edit_distance("thete", "theta"), 1);
  EXPECT_EQ(edit_distance("tehta", "theta"), 1);
  EXPECT_FALSE(did_you_mean("volume", {"theta", "width"}));
}

TEST(TomlGuard, DepthCountsOutsideStringsAndCommentsOnly) {
  const std::string dots(50000, '.');
  EXPECT_FALSE(exceeded_parser_limit("a = \"" + dots + "\" # " + dots));
  EXPECT_FALSE(exceeded_parser_limit("a = '''" + dots + "\n" + dots + "'''\nb = 1"));
  EXPECT_FALSE(exceeded_parser_limit("a = \"\\\"" + dots + "\""));
  std::string numbers = "a = [";
  for (int i = 0; i < 1000; ++i) numbers += "0.5, ";
  EXPECT_FALSE(exceeded_parser_limit(numbers + "]"));
  const auto deep = exceeded_parser_limit("b = 1\n\"=\"" + dots + "a = 1");
  ASSERT_TRUE(deep);
  EXPECT_EQ(deep->line, 2);
  EXPECT_TRUE(exceeded_parser_limit("x = {a" + dots + " = 1}"));
  EXPECT_TRUE(exceeded_parser_limit(std::string(1 << 21, ' ')));
}

TEST(TomlGuard, HostileTextsGiveProblemsInsteadOfCrashes) {
  std::string keys, tables = "a = ";
  for (int i = 0; i < 50000; ++i) keys += "a.";
  for (int i = 0; i < 50000; ++i) tables += "{a=";
  for (const std::string& text : {keys + "a = 1", "[" + keys + "a]", "a = " + std::string(50000, '['), tables,
                                  std::string("\xff\xfe\x00", 3), std::string("\"unterminated"),
                                  std::string("a = '''"), std::string(1 << 21, 'a')})
    EXPECT_FALSE(parse_case(text, "hostile.toml").problems.empty());
}

std::string repeated(std::string_view part, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += part;
  return result;
}

TEST(TomlGuard, LongTextsAreRefusedOnTheirLine) {
  constexpr int times = 100000;
  const std::string first_lines = "title = \"x\"\n[wheel]\n";
  const std::vector<std::string> lines{repeated("a.", times) + "b = 1",
                                       repeated("a .\t", times) + "b = 1",
                                       repeated("\"a\".", times) + "b = 1",
                                       "[" + repeated("a.", times) + "b]",
                                       "[[" + repeated("a.", times) + "b]]",
                                       "x = {" + repeated("a.", times) + "b = 1}",
                                       "x = " + repeated("[", times),
                                       "x = " + repeated("{a=", times),
                                       "x = " + repeated("[{a=", times),
                                       repeated("[", times),
                                       "x = 1" + repeated("0", times),
                                       "x = 1." + repeated("0", times) + "e" + repeated("9", times),
                                       "width = \"" + repeated("ü", times) + "\"",
                                       "x = \"" + repeated("\\", times + 1),
                                       repeated("x", times),
                                       repeated("=", times),
                                       repeated("\xff", times),
                                       "# \xe2\x82"};
  for (const std::string& line : lines) {
    const auto problems = parse_case(first_lines + line, "long.toml").problems;
    ASSERT_EQ(problems.size(), 1u) << line.substr(0, 20) << texts(problems);
    EXPECT_EQ(problems[0].line, 3) << line.substr(0, 20);
    EXPECT_LT(problems[0].text().size(), 500u) << line.substr(0, 20);
  }
}

TEST(TomlGuard, ThousandsOfMistakesAreAllReported) {
  std::string text;
  for (int i = 0; i < 20000; ++i) text += fmt::format("x{} = 1\n", i);
  EXPECT_EQ(parse_case(text, "many.toml").problems.size(), 20000u);
}

/// The number that a TOML parser reads; NaN where the text is no TOML number. As in a case file, an integer
/// is a number too.
double read_as_toml(const std::string& text) try {
  const toml::table table = toml::parse("x = " + text);
  if (const auto* integer = table.get_as<std::int64_t>("x")) return static_cast<double>(integer->get());
  if (const auto* number = table.get_as<double>("x")) return number->get();
  return std::nan("");
} catch (const toml::parse_error&) {
  return std::nan("");
}

void expect_to_read_back(double value) {
  for (const double x : {value, -value}) {
    const std::string text = number_text(x);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), x) << text;
    EXPECT_EQ(read_as_toml(text), x) << text;
  }
}

TEST(NumberText, ReadsBackAsTheSameNumber) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    // Any bits: all exponents are equally likely. A cleared exponent makes a subnormal number.
    const std::uint64_t bits = random() >> 1, fraction = (std::uint64_t{1} << 52) - 1;
    if (const double any = std::bit_cast<double>(bits); std::isfinite(any)) expect_to_read_back(any);
    expect_to_read_back(std::bit_cast<double>(bits & fraction));
    // Integers below 2^53, with any number of digits.
    expect_to_read_back(static_cast<double>((random() >> 11) >> (i % 53)));
  }
  for (int exponent = -323; exponent <= 308; ++exponent) {
    const double power_of_ten = std::strtod(fmt::format("1e{}", exponent).c_str(), nullptr);
    expect_to_read_back(power_of_ten);
    expect_to_read_back(std::nextafter(power_of_ten, HUGE_VAL));
    expect_to_read_back(std::nextafter(power_of_ten, 0));
  }
  using Limits = std::numeric_limits<double>;
  for (const double x : {0.0, Limits::denorm_min(), Limits::min(), Limits::max(), std::ldexp(1, 53)})
    expect_to_read_back(x);
}

TEST(NumberText, HasNoSuperfluousDigits) {
  EXPECT_EQ(number_text(300), "300");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(200e6), "2e8");
  EXPECT_EQ(number_text(1e13), "1e13");
  EXPECT_EQ(number_text(-1.5e7), "-15e6");
  EXPECT_EQ(number_text(1e16), "1e16");
}

TEST(Derived, ThePapersWheel) {
  Case c;
  c.grid.tread_levels = 0;
  EXPECT_NEAR(load_per_metre(c), 24525, 1e-9);
  EXPECT_NEAR(c.material.mu(), 67.567568e6, 1);
  EXPECT_NEAR(c.material.lambda(), 1621.62162e6, 10);
  EXPECT_NEAR(c.material.contact_modulus(), 259.875260e6, 1);
  EXPECT_NEAR(hertz_half_width(c), 6.39170e-3, 1e-8);
  EXPECT_NEAR(hertz_peak_pressure(c), 2.442714e6, 1);
  EXPECT_NEAR(cells_per_contact_patch(c), 2.3, 0.01);
  EXPECT_EQ(dof_bound(c), 2 * 57 * 768);
  EXPECT_EQ(total_load_positions(c), 128);
  EXPECT_DOUBLE_EQ(bands(c).rim.thickness, 0.01);
}

// The fewest levels that give 8 cells per patch in a run and 36 in results; a given number is taken as it is.
TEST(Derived, TheTreadIsAsFineAsTheContactNeeds) {
  Case c;
  EXPECT_EQ(tread_levels(c), 2);
  EXPECT_EQ(tread_levels_of_results(c), 4);
  for (const double load : {1.0, 300.0, 2943.0, 1e5}) {
    c.load.force = load;
    for (const int levels : {tread_levels(c), tread_levels_of_results(c)}) {
      Case given = c;
      given.grid.tread_levels = levels;
      const double wanted = levels == tread_levels(c) ? 8 : 36, cells = cells_per_contact_patch(given);
      const bool is_limited = c.contact.quadrature_points * (1 << levels) * 2 > (wanted == 8 ? 80 : 160);
      EXPECT_TRUE(cells >= wanted || is_limited) << load;
      EXPECT_TRUE(levels == 0 || cells < 2 * wanted) << load;
    }
  }
  c.grid.tread_levels = 1;
  EXPECT_EQ(tread_levels(c), 1);
  EXPECT_EQ(tread_levels_of_results(c), 1);
}

TEST(CaseFile, TheWordAutoIsTheDefaultOfTheTreadsLevels) {
  const auto automatic = parse_case("[grid]\ntread_levels = \"auto\"\n", "a.toml");
  ASSERT_TRUE(automatic.value) << texts(automatic.problems);
  EXPECT_FALSE(automatic.value->grid.tread_levels);
  const auto again = parse_case(to_toml(*automatic.value), "a.toml");
  ASSERT_TRUE(again.value) << texts(again.problems);
  EXPECT_EQ(*again.value, *automatic.value);
  EXPECT_FALSE(parse_case("[grid]\ntread_levels = \"many\"\n", "a.toml").value);
}

TEST(Derived, TheSmallestHoleOfRingsAndCircles) {
  Case c;  // cells of 5 by 4.42 mm
  c.holes = {};
  EXPECT_EQ(smallest_hole_in_cells(c), std::numeric_limits<double>::infinity());
  c.holes.rings = {{.count = 16, .center_radius = 0.27, .radius = 0.04, .phase = {}}};
  EXPECT_NEAR(smallest_hole_in_cells(c), 16, 1e-12);
  c.holes.circles = {{.center = {0.26, 0.03}, .radius = 0.01}};
  EXPECT_NEAR(smallest_hole_in_cells(c), 16, 1e-12) << "part of a larger hole";
  c.holes.circles = {{.center = {0.23, 0}, .radius = 0.01}};
  EXPECT_NEAR(smallest_hole_in_cells(c), 4, 1e-12);
  c.grid.radial_cells *= 2;
  EXPECT_NEAR(smallest_hole_in_cells(c), 0.02 * 384 / (2 * std::numbers::pi * 0.27), 1e-12);
}

TEST(Derived, TheHertzianPressureCarriesTheLoad) {
  Case c;
  c.wheel.outer_radius = 0.5;
  c.material = {{.youngs_modulus = 3e6, .poissons_ratio = 0.2}, {}};
  const double half_ellipse = std::numbers::pi / 2 * hertz_half_width(c) * hertz_peak_pressure(c);
  EXPECT_NEAR(half_ellipse, load_per_metre(c), 1e-12 * load_per_metre(c));
}

TEST(Derived, MinimumGammaAtThePapersThetas) {
  const Material material{.youngs_modulus = 200e6, .poissons_ratio = 0.48};
  EXPECT_EQ(minimum_gamma_0(-1, material), 0);
  EXPECT_NEAR(minimum_gamma_0(0, material), 10, 0.05);
  EXPECT_NEAR(minimum_gamma_0(1, material), 100, 0.5);
  const Material stiffer{.youngs_modulus = 1, .poissons_ratio = 0.48};
  EXPECT_DOUBLE_EQ(minimum_gamma_0(1, stiffer), minimum_gamma_0(1, material));
}

// At half of the minimum the tread's stiffness is indefinite, for every aspect; the minimum is enough.
TEST(Derived, MinimumGammaFollowsTheAspectOfTheCells) {
  for (const int angular_cells : {62, 124, 248}) {
    Case c;
    c.wheel = {.inner_radius = 0.02516, .outer_radius = 0.03102, .width = 0.0367, .sectors = 31};
    c.material = {{.youngs_modulus = 44e9, .poissons_ratio = 0.48}, {}};
    c.grid.radial_cells = 17;
    c.grid.angular_cells = angular_cells;
    c.grid.tread_levels = 1;
    c.contact.theta = 1;
    ASSERT_GT(tread_cell_aspect(c), 2);
    const double minimum = minimum_gamma_0(1, c.material, tread_cell_aspect(c));
    EXPECT_GT(minimum, 1.2 * minimum_gamma_0(1, c.material));
    for (const bool is_enough : {true, false}) {
      c.contact.gamma_0 = (is_enough ? 1 : 0.5) * minimum;
      const auto solver = make_solver(rolling_model<2>(c));
      EXPECT_EQ(bool(solver), is_enough) << angular_cells;
    }
  }
}

TEST(Derived, MinimumGammaOfNearlyIncompressibleMaterialGrowsOnlyForPositiveTheta) {
  const Material last{.youngs_modulus = 200e6, .poissons_ratio = 0.485},
      rubber{.youngs_modulus = 200e6, .poissons_ratio = 0.4999};
  for (const double theta : {-1.0, -0.5, 0.0})
    EXPECT_NEAR(minimum_gamma_0(theta, rubber), minimum_gamma_0(theta, last),
                0.01 * minimum_gamma_0(theta, last));
  EXPECT_GT(minimum_gamma_0(0.24, rubber), 100 * minimum_gamma_0(0.24, last));
}

TEST(Derived, InPlaneStressAreThoseOfTheEquivalentMaterial) {
  Case sheet, equivalent;
  sheet.material = {{.youngs_modulus = 70e6, .poissons_ratio = 0.4, .plane = Plane::stress}, {}};
  equivalent.material = {sheet.material.plane_strain_equivalent(), {}};
  EXPECT_DOUBLE_EQ(sheet.material.contact_modulus(), 70e6);
  EXPECT_DOUBLE_EQ(hertz_half_width(sheet), hertz_half_width(equivalent));
  for (const double theta : {-1.0, 0.0, 0.3, 1.0})
    EXPECT_DOUBLE_EQ(minimum_gamma_0(theta, sheet.material), minimum_gamma_0(theta, equivalent.material));
}

TEST(Derived, HolesOfOneSector) {
  Case c;
  c.wheel.sectors = 4;
  c.holes.rings = {{.count = 16, .center_radius = 0.27, .radius = 0.04, .phase = 0.1}};
  c.holes.circles = {{.center = {0.0, 0.25}, .radius = 0.01}};
  const auto holes = sector_holes(c);
  ASSERT_EQ(holes.size(), 5u);
  for (int i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(holes[i].centre_azimuth, 0.1 + i * std::numbers::pi / 8);
  EXPECT_DOUBLE_EQ(holes[4].centre_azimuth, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(holes[4].centre_radius, 0.25);
}

// What the advice of a conflict names must itself be free of conflict.

TEST(Conflicts, HolesMayTouchTheBandsButNotEnterThem) {
  Case c;
  c.holes.rings = {{.count = 16, .center_radius = 0.255, .radius = 0.045, .phase = {}}};
  EXPECT_TRUE(conflicts(c).empty());
  c.holes.rings[0].radius = 0.0451;
  EXPECT_EQ(conflicts(c).size(), 1u);
}

// A default band is thinner than the rows of cells that must be full only on coarse grids.
TEST(Conflicts, CoarseGridsNeedTheirOwnBands) {
  const auto n = [](int radial_cells, std::optional<double> rim, std::optional<double> tread) {
    Case c;
    c.grid.radial_cells = radial_cells;
    c.optimizer.rim_band = rim;
    c.optimizer.tread_band = tread;
    return conflicts(c).size();
  };
  EXPECT_EQ(n(28, {}, {}), 0u);
  EXPECT_EQ(n(27, {}, {}), 1u);
  EXPECT_EQ(n(14, {}, {}), 1u);
  EXPECT_EQ(n(13, {}, {}), 2u);
  EXPECT_EQ(n(14, {}, 0.02), 0u);
  EXPECT_EQ(n(13, 0.14 / 13, 0.28 / 13), 0u);
  EXPECT_EQ(n(13, 0.01, 0.02), 2u);
  for (const double annulus : {0.005, 0.01, 0.02}) {
    Case c;
    c.objective.uniformity_annulus = 1;
    c.objective.annulus = annulus;
    EXPECT_TRUE(conflicts(c).empty());
    c.grid.radial_cells = 56;
    EXPECT_TRUE(conflicts(c).empty());
  }
}

// A hole ends at least a tenth of a cell from the rows that must be full.
TEST(Conflicts, HolesDoNotTouchTheFullRows) {
  Case c;
  c.optimizer.rim_band = 0.005;
  const double h = 2 * std::numbers::pi * 0.27 / 384;  // the shorter edge of a cell
  for (const auto& [gap, n] : {std::pair{0.0, 1u}, {0.09, 1u}, {0.11, 0u}}) {
    c.holes.rings = {{.count = 16, .center_radius = 0.245 + gap * h, .radius = 0.04, .phase = {}}};
    EXPECT_EQ(conflicts(c).size(), n) << gap;
  }
}

// The bands of the default grid are one and two of its cells, 5 mm each, of a ring from 200 to 340 mm.
TEST(Conflicts, TheTargetVolumeLiesBetweenTheBandsAndAFullRing) {
  Case c;
  c.holes.rings = {{.count = 16, .center_radius = 0.27, .radius = 0.03, .phase = {}}};
  c.optimizer.rim_band = 0.005;
  c.optimizer.tread_band = 0.010;
  const double bands =
      (0.205 * 0.205 - 0.20 * 0.20 + 0.34 * 0.34 - 0.33 * 0.33) / (0.34 * 0.34 - 0.20 * 0.20);
  const double one_cell = 16.0 / (28 * 384);
  for (const auto& [target, is_possible] : {std::pair{bands - 1e-9, false},
                                            {bands + 1e-9, true},
                                            {1 - one_cell - 1e-9, true},
                                            {1.0, false},
                                            {1 - one_cell + 1e-9, false}}) {
    c.volume.target = target;
    EXPECT_EQ(conflicts(c).empty(), is_possible) << target;
  }
  c.volume.target = 0.5;
  EXPECT_TRUE(conflicts(c).empty());
  c.holes = {};
  EXPECT_EQ(conflicts(c).size(), 1u);
}

// Degree 2 takes all, and so does plane stress, where nothing is nearly incompressible.
TEST(Conflicts, NearlyIncompressibleMaterialNeedsDegreeTwo) {
  for (const auto& [nu, degree, plane, n] : {std::tuple{0.485, 1, Plane::strain, 0},
                                             {0.486, 1, Plane::strain, 1},
                                             {0.486, 2, Plane::strain, 0},
                                             {0.49999, 2, Plane::strain, 0},
                                             {0.499995, 2, Plane::strain, 1},
                                             {0.499995, 1, Plane::strain, 2},
                                             {0.499995, 1, Plane::stress, 0}}) {
    Case c;
    c.material.poissons_ratio = nu;
    c.material.plane = plane;
    c.grid.degree = degree;
    EXPECT_EQ(conflicts(c).size(), static_cast<std::size_t>(n)) << nu << ", degree " << degree;
  }
}

// Only splines have such a radius, and only holes and rings that are wide enough leave room for it.
TEST(Conflicts, MinimumRadiusNeedsSuitableEdgesAndHoles) {
  Case c =
      parse_case(
          "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.04\n[optimizer]\nminimum_radius = "
          "0.01\n",
          "wheel.toml")
          .value.value();
  ASSERT_TRUE(conflicts(c).empty());
  const auto refused = [](const Case& with) {
    const auto found = conflicts(with);
    return found.size() == 1 &&
           std::ranges::find(found[0].keys, key_of(&Optimizer::minimum_radius)) != found[0].keys.end();
  };
  Case other = c;
  other.grid.level_set_degree = 1;
  EXPECT_TRUE(refused(other));
  other = c;
  other.optimizer.method = OptimizerMethod::descent;
  EXPECT_TRUE(refused(other));
  for (const double radius : {0.042, 0.071}) {  // the widest hole; the ring
    other = c;
    other.optimizer.minimum_radius = radius;
    EXPECT_TRUE(refused(other)) << radius;
  }
  other.optimizer.minimum_radius = 0.039;
  EXPECT_TRUE(conflicts(other).empty());
}

TEST(Conflicts, NitscheNeedsALargeGammaForThetaZeroAndOneOnly) {
  for (const auto& [theta, enough, too_small] : {std::tuple{0.0, 10.0, 9.9}, std::tuple{1.0, 100.0, 99.0}}) {
    Case c;
    c.contact.theta = theta;
    c.contact.gamma_0 = enough;
    EXPECT_TRUE(conflicts(c).empty());
    c.contact.gamma_0 = too_small;
    EXPECT_EQ(conflicts(c).size(), 1u);
    c.contact.method = ContactMethod::penalty;
    EXPECT_TRUE(conflicts(c).empty());
  }
}

// Where the load is given, friction holds less than its share of it, and that at the tread's radius a torque;
// where the travel is given, or a body force adds to the load, what it holds is not known beforehand.
TEST(Conflicts, FrictionMustResistLoadsOnTheRim) {
  Case c;
  c.load.force = 1000;
  c.contact.friction = 0.5;
  for (const double direction : {1, -1}) {
    c.load.torque = 0;
    for (const auto& [push, holds] : {std::pair{499.0, true}, {500.0, false}, {501.0, false}}) {
      c.load.horizontal_force = direction * push;
      EXPECT_EQ(conflicts(c).empty(), holds) << push;
    }
    c.load.horizontal_force = 0;
    for (const auto& [share, holds] : {std::pair{0.99, true}, {1.01, false}}) {
      c.load.torque = direction * share * 500 * c.wheel.outer_radius;
      EXPECT_EQ(conflicts(c).empty(), holds) << share;
    }
  }
  Case travels = c, heavy = c;
  travels.load.travel = 1e-3;
  heavy.load.body_force = {0, 1e4};
  EXPECT_TRUE(conflicts(travels).empty());
  EXPECT_TRUE(conflicts(heavy).empty());
}

// Neighbouring holes that touch all round cut the tread off; a single hole has no neighbour.
TEST(Conflicts, HolesMustNotTouchAllAround) {
  Case c;
  const double centre = 0.25, touching = centre * std::sin(std::numbers::pi / 32);
  c.wheel.sectors = 32;
  c.load.positions = 4;
  for (const auto& [radius, apart] : {std::pair{0.99 * touching, true}, {touching, false}}) {
    c.holes.rings = {{.count = 32, .center_radius = centre, .radius = radius, .phase = {}}};
    EXPECT_EQ(conflicts(c).empty(), apart) << radius;
  }
  c.wheel.sectors = 1;
  c.holes.rings = {{.count = 1, .center_radius = centre, .radius = 0.02, .phase = {}}};
  EXPECT_TRUE(conflicts(c).empty());
}

TEST(Conflicts, OneWeightIsEnoughForAnObjective) {
  for (double Objective::*weight : {&Objective::strain_energy, &Objective::uniformity_annulus,
                                    &Objective::uniformity_dual, &Objective::uniformity_l2}) {
    Case c;
    c.objective.strain_energy = 0;
    EXPECT_EQ(conflicts(c).size(), 1u);
    c.objective.*weight = 1;
    EXPECT_TRUE(conflicts(c).empty());
  }
}

TEST(Conflicts, ExpectationsReachToTheLastShape) {
  Case c;
  c.expectations.emplace_back();
  for (const int behind : {0, 1}) {
    c.expectations[0].iteration = c.optimizer.iterations + behind;
    EXPECT_EQ(conflicts(c).size(), behind);
  }
}

TEST(Conflicts, AngularCellsMustHoldEqualSectors) {
  for (int cells = 1; cells <= 1000; ++cells) {
    Case c;
    c.grid.angular_cells = cells;
    EXPECT_EQ(conflicts(c).empty(), cells % 16 == 0);
  }
}

}  // namespace
}  // namespace wheelwright
