// Flying edges over the fields of polygonize_bench.cpp, with normals.
#include <benchmark/benchmark.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include "bench/stone_fields.h"

namespace talus {
namespace {

void flying_edges_stones(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  std::vector<std::vector<float>> fields;
  for (int i = 0; i < 64; ++i)
    fields.push_back(bench::stone_field(side, static_cast<std::uint64_t>(i)));
  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetValue(0, 0.0);
  filter->SetComputeNormals(true);
  filter->SetComputeGradients(false);
  filter->SetComputeScalars(false);
  std::size_t triangles = 0;
  for (auto _ : state)
    for (std::vector<float>& field : fields) {
      vtkNew<vtkFloatArray> samples;
      samples->SetArray(field.data(), static_cast<vtkIdType>(field.size()), 1);
      vtkNew<vtkImageData> image;
      image->SetDimensions(side, side, side);
      image->GetPointData()->SetScalars(samples);
      filter->SetInputData(image);
      filter->Update();
      triangles += static_cast<std::size_t>(filter->GetOutput()->GetNumberOfPolys());
    }
  state.counters["triangles_per_s"] =
      benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsRate);
}
BENCHMARK(flying_edges_stones)->Arg(16)->Arg(30)->ArgName("side")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus
