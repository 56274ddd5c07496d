// emmy_benchmark: Google Benchmark's program, which records what it times.

#include <benchmark/benchmark.h>

#include "absl/strings/str_cat.h"
#include "emmy/base/build_info.h"

int main(int argc, char** argv) {
  const emmy::BuildInfo build = emmy::GetBuildInfo();
  benchmark::AddCustomContext(
      "emmy",
      absl::StrCat(build.version, ", ", build.compiler, ", ", build.flags));
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
