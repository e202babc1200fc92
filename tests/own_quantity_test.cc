#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/run_support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/quantities/functionals/boundary_integral.h"
#include "wheelwright/run/session/run.h"
#include "wheelwright/web/watch/board_observer.h"
#include "wheelwright/web/watch/frame.h"

// A quantity that a program adds: from its case file to all that a run writes.

namespace wheelwright::testing {
namespace {

constexpr double reference = 0.3;  // [m]

/// int |x|^2 / reference^2 ds over the edges of one sector [m].
template <int dim>
class OuterEdges : public BoundaryIntegral<dim> {
 public:
  std::string name() const override { return "outer_edges"; }

 private:
  typename BoundaryIntegral<dim>::Density density(const Vec<dim>& x) const override {
    const double scale = 1 / (reference * reference);
    Vec<dim> gradient{};
    for (int d = 0; d < 2; ++d) gradient[d] = 2 * scale * x[d];
    return {scale * (x[0] * x[0] + x[1] * x[1]), gradient};
  }
};

QuantityRow outer_edges() {
  return {.name = "outer_edges",
          .unit = UnitKind::length,
          .meaning = "length of the edges, weighted by the square of the radius",
          .of = Positions::none,
          .functional = []<int dim>(const QuantityContext<dim>&) {
            return std::make_shared<const OuterEdges<dim>>();
          }};
}

Quantities with_outer_edges() {
  Quantities quantities;
  quantities.add(outer_edges());
  return quantities;
}

/// Twice the mean travel in 2D only, so that it can be compared with a built-in quantity.
QuantityRow doubled_travel() {
  return {.name = "doubled_travel",
          .unit = UnitKind::length,
          .meaning = "twice the travel",
          .functional = [](const QuantityContext<2>& context) {
            auto term = functional_of(built_in("travel"), Over::positions, context);
            term->weight = 2;
            return term;
          }};
}

const std::string terms = R"(
[[objective.term]]
quantity = "outer_edges"
weight = 3
[[constraint]]
quantity = "outer_edges"
at_most = "900 mm"
)";

Case case_of(const std::string& text, const Quantities& quantities = with_outer_edges()) {
  const auto read = parse_case(text, "case.toml", {quantities});
  for (const auto& problem : read.problems) ADD_FAILURE() << problem.text();
  return *read.value;
}

class StopAfter : public Observer<2> {
 public:
  StopAfter(CommandQueue& commands, int shapes) : commands_(commands), shapes_(shapes) {}
  void operator()(const Event<2>& event, const RunView<2>&) override {
    const auto* done = std::get_if<TrialDone<2>>(&event);
    if (done && done->trial.verdict == Verdict::accepted && done->state.iteration == shapes_)
      commands_.push(Stop{});
  }

 private:
  CommandQueue& commands_;
  int shapes_;
};

class OwnQuantity : public TemporaryFolder {
 protected:
  std::string file(const std::string& run, const char* name) { return content(folder() / run / name); }
  std::vector<std::string> header(const std::string& run) {
    return split(split(file(run, "history.csv"), '\n').front(), ',');
  }
  bool has(const std::vector<std::string>& words, const std::string& word) {
    return std::ranges::find(words, word) != words.end();
  }
};

TEST(OwnQuantities, HaveNamesOfTheirOwn) {
  Quantities quantities = with_outer_edges();
  EXPECT_THROW(quantities.add(outer_edges()), std::invalid_argument);
  EXPECT_THROW(quantities.add({.name = "stiffness", .unit = UnitKind::stiffness, .meaning = ""}),
               std::invalid_argument);
  EXPECT_THROW(quantities.add({.name = "two words", .unit = UnitKind::ratio, .meaning = ""}),
               std::invalid_argument);
  EXPECT_EQ(quantities.names().size(), Quantities().names().size() + 1);
  EXPECT_TRUE(quantities.find("outer_edges"));
  EXPECT_FALSE(Quantities().find("outer_edges"));
}

TEST(OwnQuantities, AreKnownToTheirProgramAlone) {
  const std::string text = small_case(1, terms);
  EXPECT_FALSE(parse_case(text, "case.toml").value);
  const Case c = case_of(text);
  EXPECT_NEAR(*c.constraints.front().at_most, 0.9, 1e-12);
  EXPECT_EQ(case_of(to_toml(c)), c);
}

TEST(OwnQuantities, OfOneDimensionAreRefusedInTheOther) {
  Quantities quantities;
  quantities.add(doubled_travel());
  const auto is_accepted = [&](int dimension, const std::string& quantity) {
    std::string text =
        small_case(1, fmt::format("[[constraint]]\nquantity = \"{}\"\nat_most = 1\n", quantity));
    text.insert(text.find("sectors"), fmt::format("dimension = {}\n", dimension));
    return parse_case(text, "case.toml", {quantities}).value.has_value();
  };
  EXPECT_TRUE(is_accepted(2, "doubled_travel"));
  EXPECT_TRUE(is_accepted(3, "travel"));
  EXPECT_FALSE(is_accepted(3, "doubled_travel"));
}

/// The mean over the positions, with the weight of its factory.
TEST(OwnQuantities, AreAggregatedAsBuiltInOnes) {
  Quantities quantities;
  quantities.add(doubled_travel());
  const auto study = make_study<2>(case_of(small_case(1, R"(
[[constraint]]
quantity = "doubled_travel"
at_most = 1
[[constraint]]
quantity = "travel"
at_most = 1
)"),
                                           quantities));
  ASSERT_TRUE(study) << study.failure().detail;
  const auto evaluated = evaluate_of(*study)({study->initial, nullptr}, nullptr);
  ASSERT_TRUE(evaluated) << evaluated.failure().detail;
  const auto& e = evaluated->evaluation;
  EXPECT_DOUBLE_EQ(e.function("doubled_travel").value, 2 * e.function("travel").value);
  EXPECT_EQ(e.function("doubled_travel").unit, UnitKind::length);
}

Evaluation<2> evaluation_of(const std::string& more) {
  const auto study = make_study<2>(case_of(small_case(1, more)));
  return evaluate_of(*study)({study->initial, nullptr}, nullptr)->evaluation;
}

/// The energies are summed over the load positions, a further term is its quantity once. Shapes do not depend
/// on the load, so that their terms count once in several load cases too.
TEST(OwnQuantities, AreTermsOfTheObjective) {
  const std::string travel = R"(
[[objective.term]]
quantity = "travel"
weight = 200
[[constraint]]
quantity = "travel"
at_most = 1
)",
                    two_loads =
                        "[[load.case]]\nname = \"one\"\n[[load.case]]\nname = \"two\"\nweight = 0.5\n";
  const auto value = [](const Evaluation<2>& e, const char* name) { return e.function(name).value; };
  const double energy = value(evaluation_of(""), "objective");
  const auto e = evaluation_of(terms + travel);
  const double edges = 3 * value(e, "outer_edges"), motion = 200 * value(e, "travel");
  EXPECT_NEAR(value(e, "objective"), energy + edges + motion, 1e-9 * energy);
  EXPECT_NEAR(value(evaluation_of(terms + travel + two_loads), "objective"), 1.5 * (energy + motion) + edges,
              1e-9 * energy);
}

TEST(OwnQuantities, AreTermsOnceAndWithOneWeight) {
  const auto is_accepted = [](const std::string& more) {
    return parse_case(small_case(1, more), "case.toml", {with_outer_edges()}).value.has_value();
  };
  const auto term = [](const std::string& quantity) {
    return fmt::format("[[objective.term]]\nquantity = \"{}\"\nweight = 1\n", quantity);
  };
  EXPECT_TRUE(is_accepted(term("outer_edges") + term("peak_pressure")));
  EXPECT_FALSE(is_accepted(term("outer_edges") + term("outer_edges")));
  EXPECT_FALSE(is_accepted(term("uniformity_dual")));
  EXPECT_FALSE(is_accepted(term("minimum_wall")));
  EXPECT_FALSE(is_accepted(term("objective")));
}

TEST(OwnUnits, AreTheSameForEqualTexts) {
  const UnitKind a = own_unit("Pa^2 m"), b = own_unit("K/m");
  EXPECT_EQ(own_unit("Pa^2 m"), a);
  EXPECT_NE(a, b);
  EXPECT_STREQ(unit<2>(a), "Pa^2 m");
  EXPECT_STREQ(shown_unit(b, 3, 0.1).name, "K/m");
  EXPECT_EQ(shown_unit(a, 2, 0.1).factor, 1);
  EXPECT_STREQ(own_unit_text(UnitKind::energy), "");
}

/// A resumed run reads the unit from its checkpoint.
TEST_F(OwnQuantity, MayHaveAUnitOfItsOwn) {
  Quantities quantities;
  QuantityRow row = outer_edges();
  row.unit = own_unit("edge");
  quantities.add(row);
  std::string text = small_case(4, terms);
  text.replace(text.find("\"900 mm\""), 8, "0.9");
  const Case c = case_of(text, quantities);
  {
    auto run = wheelwright::Run<2>::begin(c, folder() / "run");
    CommandQueue commands;
    run->add(std::make_unique<StopAfter>(commands, 2));
    run->execute(commands);
  }
  {
    auto run = wheelwright::Run<2>::resume(c, folder() / "run");
    ASSERT_TRUE(run);
    CommandQueue commands;
    run->execute(commands);
  }
  const auto columns = header("run");
  for (const char* column :
       {"outer_edges [edge]", "bounded outer_edges [edge]", "multiplier of outer_edges [J/m per edge]"})
    EXPECT_TRUE(has(columns, column)) << column;
  const auto summary = nlohmann::json::parse(file("run", "summary.json"));
  EXPECT_EQ(summary["bounds"][0]["unit"], "edge");
  EXPECT_TRUE(summary["after"].contains("outer_edges"));
  EXPECT_NE(file("run", "report.html").find("\"outer_edges [edge]\""), std::string::npos);
}

TEST_F(OwnQuantity, IsInHistoryPagesAndCheckpointsWithItsUnit) {
  const Case c = case_of(small_case(4, terms));
  auto board = std::make_shared<Board<2>>();
  {
    auto run = wheelwright::Run<2>::begin(c, folder() / "straight");
    ASSERT_TRUE(run);
    run->add(std::make_unique<BoardObserver<2>>(board));
    CommandQueue commands;
    run->execute(commands);
  }
  const auto columns = header("straight");
  for (const char* column : {"outer_edges [m]", "bounded outer_edges [m]", "bound of outer_edges [m]",
                             "multiplier of outer_edges [J/m per m]"})
    EXPECT_TRUE(has(columns, column)) << column;

  const auto frame = nlohmann::json::parse(frame_json<2>(board->view(), {}, {}));
  EXPECT_EQ(frame["settings"]["bounds"][0]["quantity"], "outer_edges");
  for (const auto& bound : {frame["settings"]["bounds"][0], frame["bounds"][0]})
    EXPECT_EQ(bound["shown"]["unit"], "mm");
  EXPECT_TRUE(frame["numbers"].contains("outer_edges"));

  const auto summary = nlohmann::json::parse(file("straight", "summary.json"));
  EXPECT_EQ(summary["bounds"][0]["name"], "outer_edges");
  EXPECT_EQ(summary["bounds"][0]["unit"], "m");
  const double edges = summary["after"]["outer_edges_m"];
  EXPECT_NEAR(edges, summary["bounds"][0]["value"].get<double>(), 1e-9);
  const std::string page = file("straight", "report.html");
  EXPECT_NE(page.find("\"bound_units\":[{\"unit\":\"mm\""), std::string::npos);
  EXPECT_NE(page.find("\"outer_edges [m]\""), std::string::npos);
  EXPECT_NE(page.find("{\"key\":\"outer_edges_m\",\"label\":\"outer_edges\",\"unit\":\"mm\""),
            std::string::npos);

  {
    auto run = wheelwright::Run<2>::begin(c, folder() / "stopped");
    CommandQueue commands;
    run->add(std::make_unique<StopAfter>(commands, 2));
    run->execute(commands);
  }
  auto resumed = wheelwright::Run<2>::resume(c, folder() / "stopped");
  ASSERT_TRUE(resumed);
  EXPECT_EQ(resumed->resumption().shape, 2);
  CommandQueue commands;
  resumed->execute(commands);
  EXPECT_EQ(without_times(file("stopped", "history.csv")), without_times(file("straight", "history.csv")));
  EXPECT_EQ(file("stopped", "shape.levelset"), file("straight", "shape.levelset"));
}

}  // namespace
}  // namespace wheelwright::testing
