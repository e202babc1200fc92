#include "wheelwright/case/keys.h"

namespace wheelwright {

const Section<Output>& output_section() {
  static const Section<Output> section{
      .name = "output",
      .meaning = "the output of a run",
      .in = [](Case& c) -> Output& { return c.output; },
      .keys = {
          {.name = "folder",
           .field = TextField<Output>{&Output::folder, "runs/ and the name of the case file",
                                      TextRule::path_below},
           .meaning = "folder of the run, below the current one; the option --output accepts any folder"},
          {.name = "vtu_every",
           .unit = "shapes",
           .field = IntegerField<Output>{&Output::vtu_every, between(0, 1000000)},
           .meaning = "how often fields are written for ParaView, and whether at the end those of all load "
                      "positions are; 0 means never"},
          {.name = "pictures_every",
           .unit = "shapes",
           .field = IntegerField<Output>{&Output::pictures_every, between(0, 1000000)},
           .meaning =
               "how often the loaded wheel, its shape gradient and its level set are drawn in the folder "
               "shapes; 0 means never; the last shape is always drawn under load"},
          {.name = "checkpoint_every",
           .unit = "shapes",
           .field = IntegerField<Output>{&Output::checkpoint_every, between(0, 1000000)},
           .meaning = "how often the run is saved for `wheelwright resume`; 0 means only after "
                      "checkpoint_seconds"},
          {.name = "checkpoint_seconds",
           .unit = "s",
           .field = NumberField<Output>{&Output::checkpoint_seconds, between(0, 1e9)},
           .meaning = "time after which the next shape is saved too; 0 means never"},
          {.name = "errors",
           .field = choice<&Output::errors>({"estimated", "none"}),
           .meaning =
               "estimated: the last shape is solved on a finer grid too, from which the errors of its "
               "numbers "
               "follow; that takes about as long as three shapes, and is left out where memory is short"}}};
  return section;
}

namespace {

Expectation example_expectation() {
  Expectation energy;
  energy.quantity = built_in("strain_energy");
  energy.value = 35;
  energy.margin = 0.01;
  return energy;
}

}  // namespace

const SectionArray<Expectation>& expectation_sections() {
  static const SectionArray<Expectation> sections{
      .parent = "",
      .name = "expect",
      .meaning =
          "an expected result; a run that finds another value reports it and ends with exit code 7; any "
          "number of tables",
      .in = [](Case& c) -> std::vector<Expectation>& { return c.expectations; },
      .example = example_expectation(),
      .keys = {{.name = "quantity",
                .field = QuantityField<Expectation>{&Expectation::quantity},
                .meaning = "a column of history.csv",
                .presence = Presence::required},
               {.name = "layer",
                .field = TextField<Expectation>{&Expectation::layer, "the whole ring"},
                .meaning = "the layer whose quantity it is, by its name"},
               {.name = "value",
                .unit = unit_of_quantity,
                .field = NumberField<Expectation>{&Expectation::value, values_of(UnitKind::energy)},
                .meaning = "expected value, in the unit of history.csv; stresses in Pa; a temperature may be "
                           "any above absolute zero",
                .presence = Presence::required},
               {.name = "margin",
                .field = NumberField<Expectation>{&Expectation::margin, above(0, 1)},
                .meaning = "accepted deviation, relative to the value; of a temperature of 0 deg C in K"},
               {.name = "iteration",
                .field = OptionalIntegerField<Expectation>{&Expectation::iteration, between(0, 1000000),
                                                           "the last shape"},
                .meaning = "number of the accepted shape; 0 is the initial shape"},
               {.name = "load_case",
                .field = TextField<Expectation>{&Expectation::load_case, "the first one"},
                .meaning = "the name of the [[load.case]] to which it applies"}}};
  return sections;
}

}  // namespace wheelwright
