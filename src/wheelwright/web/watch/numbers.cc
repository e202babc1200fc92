#include "wheelwright/web/watch/numbers.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "wheelwright/output/report/numbers_json.h"
#include "wheelwright/run/results/own_numbers.h"
#include "wheelwright/run/results/remarks.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/run/study/feature_warnings.h"
#include "wheelwright/run/study/roughness_warning.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/regrid.h"
#include "wheelwright/shape/evolution/volume.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

template <int dim>
Json values_json(const DescribedWheel<dim>& wheel) {
  Json values = Json::object();
  for (const WheelNumber<dim>& number : numbers_of(wheel))
    if (const auto value = known_value(number, wheel)) values[number.key] = *value;
  return values;
}

template <int dim>
double share(const LevelSet<dim>& psi, double measure) {
  return measure / sector_measure<dim>(psi.lattice.grid());
}

template <int dim>
Json warnings_json(const Case& c, const DescribedWheel<dim>& before, const DescribedWheel<dim>& now) {
  Json texts = Json::array();
  if (!now.loaded) texts.push_back(now.loaded.failure().detail);
  if (now.loaded)
    if (auto text = deformation_warning(now.loaded->deformation); !text.empty())
      texts.push_back(std::move(text));
  for (auto& text : too_warm(now)) texts.push_back(std::move(text));
  if (now.outline)
    for (auto& text : feature_warnings(c, *now.outline)) texts.push_back(std::move(text));
  if (auto text = roughness_warning(c, roughness(now), roughness(before)); !text.empty())
    texts.push_back(std::move(text));
  for (auto& text : warnings(c)) texts.push_back(std::move(text));
  for (const Remark& remark : remarks(c, before.load_case, judged(before), judged(now)))
    texts.push_back(remark.text);
  return texts;
}

}  // namespace

template <int dim>
DescribedWheel<dim> WatchedNumbers<dim>::initial_wheel(const BoardView<dim>& view, int load_case) {
  const std::scoped_lock lock(mutex_);
  const WatchedShape<dim>& now = *view.shape;
  const auto known = std::ranges::find_if(initial_, [&](const Initial& initial) {
    return initial.source == now.source && initial.solver == now.solver && initial.load_case == load_case;
  });
  if (known != initial_.end()) return known->wheel;
  std::erase_if(initial_, [&](const Initial& initial) { return initial.source != now.source; });
  const LevelSet<dim> psi = regrid(view.first->psi, now.psi.lattice);
  SolvedStates<dim> states =
      now.solver->states(psi, distinct_positions(*now.solver, *now.load_cases, psi), Interrupt());
  if (states && load_case > 0)
    states =
        (*states)->under(with_loads((*states)->model(), (*now.load_cases)[load_case].model), Interrupt());
  auto wheel = described_wheel<dim>(*now.solver, psi, share(psi, material_measure(psi)), states, {},
                                    own_numbers(*now.source, *now.solver, psi));
  if (!now.load_cases->empty()) wheel.load_case = (*now.load_cases)[load_case].name;
  initial_.push_back({now.source, now.solver, load_case, wheel});
  return wheel;
}

template <int dim>
std::string WatchedNumbers<dim>::json(const BoardView<dim>& view, int load_case) {
  const WatchedShape<dim>& shape = *view.shape;
  const auto now = described_wheel<dim>(*shape.solver, shape.psi, share(shape.psi, shape.measure),
                                        shape.solutions[load_case], {},
                                        own_numbers(*shape.source, *shape.solver, shape.psi));
  const auto before = initial_wheel(view, load_case);
  const Json json{{"shape_version", view.shape_version},
                  {"load_case", load_case},
                  {"rows", shown_numbers(numbers_of(now))},
                  {"before", values_json(before)},
                  {"now", values_json(now)},
                  {"warnings", warnings_json(*shape.source, before, now)}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

template class WatchedNumbers<2>;
template class WatchedNumbers<3>;

}  // namespace wheelwright
