#include "summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace wheelwright::bench {

double Samples::fastest() const {
  return seconds_.empty() ? std::numeric_limits<double>::quiet_NaN()
                          : *std::min_element(seconds_.begin(), seconds_.end());
}

double Samples::median() const {
  if (seconds_.empty()) return std::numeric_limits<double>::quiet_NaN();
  auto sorted = seconds_;
  const auto middle = sorted.begin() + sorted.size() / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

Samples& GridTimes::phase(const std::string& name) {
  for (auto& [existing, samples] : phases)
    if (existing == name) return samples;
  return phases.emplace_back(name, Samples{}).second;
}

const Samples* GridTimes::find_phase(const std::string& name) const {
  for (const auto& [existing, samples] : phases)
    if (existing == name) return &samples;
  return nullptr;
}

namespace {

using Column = std::function<std::string(const GridTimes&)>;

/// One row of a table with a column for every grid.
std::string row(const std::string& label, const std::vector<GridTimes>& grids, const Column& cell) {
  std::string text = fmt::format("| {} |", label);
  for (const GridTimes& grid : grids) text += fmt::format(" {} |", cell(grid));
  return text;
}

std::string heading(const std::string& label, const std::vector<GridTimes>& grids) {
  std::string rule = "|---|";
  for (size_t i = 0; i < grids.size(); ++i) rule += "---|";
  return row(label, grids, [](const GridTimes& grid) { return grid.grid; }) + "\n" + rule + "\n";
}

std::string milliseconds(const Samples& samples) {
  return std::isnan(samples.fastest())
             ? "-"
             : fmt::format("{:.2f} ({:.2f})", 1e3 * samples.fastest(), 1e3 * samples.median());
}

double total_flops(const GridTimes& grid) {
  double sum = 0;
  for (const KernelWork& kernel : grid.work) sum += kernel.flops;
  return sum;
}

std::string exponent(double coarse, double fine, double unknowns_ratio) {
  const double value = std::log(fine / coarse) / std::log(unknowns_ratio);
  return std::isnan(value) ? "-" : fmt::format("{:.2f}", value);
}

std::string times_table(const Measurements& m, const std::string& exponents_from) {
  const auto from = std::find_if(m.grids.begin(), m.grids.end(),
                                 [&](const GridTimes& grid) { return grid.grid == exponents_from; });
  const GridTimes& fine = m.grids.back();
  const double ratio = from == m.grids.end() ? 0 : double(fine.unknowns) / from->unknowns;
  const auto with_exponent = [&](const std::string& text, const Samples* a, const Samples* b) {
    return text + fmt::format(" {} |\n", a && b ? exponent(a->fastest(), b->fastest(), ratio) : "-");
  };

  std::string header = heading("ms, fastest (median)", m.grids);
  header.insert(header.find('\n'), " exponent |");
  header.insert(header.size() - 1, "---|");
  std::string text = header;
  text +=
      row("unknowns", m.grids, [](const GridTimes& grid) { return fmt::to_string(grid.unknowns); }) + " |\n";
  for (const auto& [name, samples] : fine.phases)
    text += with_exponent(row(name, m.grids,
                              [&name = name](const GridTimes& grid) {
                                const Samples* phase = grid.find_phase(name);
                                return phase ? milliseconds(*phase) : "-";
                              }),
                          from == m.grids.end() ? nullptr : from->find_phase(name), &samples);
  text += with_exponent(
      row("**one shape**", m.grids, [](const GridTimes& grid) { return milliseconds(grid.shape); }),
      from == m.grids.end() ? nullptr : &from->shape, &fine.shape);
  return text;
}

std::string work_table(const Measurements& m) {
  const double rate = m.dense_product_flops / m.dense_product.fastest();
  std::string text = heading("Gflop", m.grids);
  for (size_t k = 0; k < m.grids.back().work.size(); ++k)
    text += row(m.grids.back().work[k].kernel, m.grids,
                [k](const GridTimes& grid) {
                  return k < grid.work.size() ? fmt::format("{:.3f}", 1e-9 * grid.work[k].flops) : "-";
                }) +
            "\n";
  text += row("sum", m.grids,
              [](const GridTimes& grid) { return fmt::format("{:.3f}", 1e-9 * total_flops(grid)); }) +
          "\n";
  text += row("the sum at the rate of a dense product, ms", m.grids,
              [&](const GridTimes& grid) { return fmt::format("{:.2f}", 1e3 * total_flops(grid) / rate); }) +
          "\n";
  text += row("one shape takes that time", m.grids,
              [&](const GridTimes& grid) {
                return fmt::format("{:.1f} times", grid.shape.fastest() * rate / total_flops(grid));
              }) +
          "\n";
  return text;
}

}  // namespace

namespace {

std::string positions_line(const std::string& what, const std::map<int, Samples>& positions) {
  if (positions.size() < 2) return "";
  const auto& [few, few_samples] = *positions.begin();
  const auto& [many, many_samples] = *positions.rbegin();
  return fmt::format("{}: {} load positions: {} ms; {}: {} ms; {:.2f} times.\n\n", what, few,
                     milliseconds(few_samples), many, milliseconds(many_samples),
                     many_samples.fastest() / few_samples.fastest());
}

}  // namespace

std::string summary(const Measurements& m, const std::string& exponents_from) {
  std::string text = times_table(m, exponents_from) + "\n";
  text += fmt::format("Dense product (dgemm, 512 x 512): {:.1f} Gflop/s at best, {:.1f} in the median.\n\n",
                      1e-9 * m.dense_product_flops / m.dense_product.fastest(),
                      1e-9 * m.dense_product_flops / m.dense_product.median());
  text += work_table(m) + "\n";
  text += positions_line("Mirror images left out", m.positions);
  text += positions_line("All positions solved", m.all_positions);
  text += heading("MB", m.grids);
  text += row("peak memory", m.grids,
              [](const GridTimes& grid) { return fmt::format("{:.0f}", 1e-6 * grid.peak_memory); }) +
          "\n";
  return text;
}

}  // namespace wheelwright::bench
