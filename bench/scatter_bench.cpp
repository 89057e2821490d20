// Promises: the plots of the paper's figure 1, three diagrams with some 100, 900 and 8 100 cells,
// in less than 0.15 s, where the paper took 3.63 s for them and their stones; a million plots on a
// square kilometre, piece by piece, in less than 20 s and 2 GB.
#include <vector>

#include "bench/measure.h"
#include "talus/scatter/make_plots.h"

namespace talus::bench {
namespace {

void count(benchmark::State& state, const PlotReport& report) {
  double sites = 0, plots = 0;
  for (const ClassReport& size : report.classes) {
    sites += static_cast<double>(size.sites);
    plots += static_cast<double>(size.plots);
  }
  state.counters["sites"] = sites;
  state.counters["plots"] = plots;
  state.counters["coverage"] = report.coverage();
}

// Of [Sakurai2010] table 1, a pixel a centimetre: classes with their areas.
void figure(benchmark::State& state, std::vector<SizeClass> classes) {
  const PlotParams params{.classes = std::move(classes)};
  const Bound bound(state, 0.15);
  PlotResult result;
  for (auto _ : state) result = make_bounded_plots(params, 1, {{0, 0}, {10, 10}});
  count(state, result.report);
}

std::vector<SizeClass> three(double large, double middle, double small) {
  return {{.radius = 0.9, .area_share = large},
          {.radius = 0.3, .area_share = middle},
          {.radius = 0.1, .area_share = small}};
}

void square(benchmark::State& state, double edge) {
  const PlotParams params{.classes = {{.radius = 2, .area_share = 0.2},
                                      {.radius = 1, .area_share = 0.2},
                                      {.radius = 0.5, .area_share = 0.25}}};
  const Bound bound(state, 20);
  PlotReport report;
  for (auto _ : state) {
    report = {};
    for (const Box2& piece : cut_into_pieces(params, {{0, 0}, {edge, edge}}))
      report.add(make_plots(params, 1, piece).report);
  }
  count(state, report);
}

constexpr auto kUnit = benchmark::kMillisecond;
BENCHMARK_CAPTURE(figure, small_1, three(0.2, 0.24, 0.56))->Unit(kUnit);
BENCHMARK_CAPTURE(figure, 11a, {{.radius = 0.9, .area_share = 0.5}})->Unit(kUnit);
BENCHMARK_CAPTURE(figure, 11b, {{.radius = 0.3, .area_share = 0.5}})->Unit(kUnit);
BENCHMARK_CAPTURE(figure, 11c, {{.radius = 0.1, .area_share = 0.5}})->Unit(kUnit);
BENCHMARK_CAPTURE(figure, 12a, three(0.5, 0.25, 0.25))->Unit(kUnit);
BENCHMARK_CAPTURE(figure, 12b, three(0.25, 0.5, 0.25))->Unit(kUnit);
BENCHMARK_CAPTURE(figure, 12c, three(0.25, 0.25, 0.5))->Unit(kUnit);
BENCHMARK_CAPTURE(square, kilometre, 1000)->Unit(kUnit);
BENCHMARK_CAPTURE(square, small, 100)->Unit(kUnit);

}  // namespace
}  // namespace talus::bench
