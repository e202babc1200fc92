#include <benchmark/benchmark.h>

#include <random>

#include "wheelwright/cad/drawing/composed_level_set.h"
#include "wheelwright/cad/drawing/parts.h"

using namespace wheelwright;

namespace {

/// Closed outlines of eight wavy Bezier curves each, evenly spread over the ring.
Figure blobs(int count) {
  Figure figure{Fill::hole, {}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> wave(0.8, 1.2);
  for (int k = 0; k < count; ++k) {
    const Affine frame = polar_frame(0.23 + 0.08 * (k % 4) / 3, 2 * std::numbers::pi * k / count, 0);
    DrawnLoop loop;
    std::vector<Point> corners;
    for (int i = 0; i < 8; ++i) corners.push_back(polar(0.008 * wave(random), i * std::numbers::pi / 4));
    for (int i = 0; i < 8; ++i) {
      const Point &a = corners[i], &b = corners[(i + 1) % 8];
      loop.curves.push_back(
          Curve::cubic(a, a + 0.25 * Point{-a[1], a[0]}, b - 0.25 * Point{-b[1], b[0]}, b).mapped(frame));
    }
    figure.outlines.push_back({{loop}});
  }
  return figure;
}

/// From a drawing of that many curves to its level set, on the whole wheel.
void level_set_of_a_drawing(benchmark::State& state) {
  const Figure figure = blobs(static_cast<int>(state.range(0)) / 8);
  const Lattice<2> lattice({0.20, 0.34, 0.12, 1, {28, 384}}, 2);
  for (auto _ : state) benchmark::DoNotOptimize(make_level_set(lattice, Composition({figure})));
}
BENCHMARK(level_set_of_a_drawing)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
