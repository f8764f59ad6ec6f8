// CPU time of each estimator on one gather, beside the gather itself. One thread, repeated in turn, medians. Prints
// JSON.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "isophote/integrate/gather.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/pilot.h"
#include "isophote/load/scene_file.h"

namespace isophote {
namespace {

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

template <class Work>
double cpu_seconds(Work&& work) {
  const Clock before = Clock::now();
  work();
  return (Clock::now() - before).cpu;
}

int run(const char* path, int rays, int repeats) {
  const LoadedScene loaded = load_scene(path, [](const std::string&) {});
  const RayCaster caster(loaded.scene);
  const Emitters emitters(loaded.scene);
  Job job{World{loaded.scene, caster, emitters}, loaded.scene.cameras.front()};
  const FlushDenormals flush;
  RayCounts counts;
  const std::vector<Place> places = random_places(job, counts);
  std::vector<HemisphereGather> gathers(places.size());
  std::vector<double> gathering;
  std::vector<std::vector<double>> shares(estimators().size()), times = shares;
  float sink = 0;
  for (int i = 0; i < repeats; ++i) {
    gathering.push_back(cpu_seconds([&] {
      for (std::size_t p = 0; p < places.size(); ++p)
        gather_hemisphere(job.world, {}, places[p], Strata::about(rays), places[p].key, gathers[p], counts);
    }));
    for (std::size_t e = 0; e < estimators().size(); ++e) {
      times[e].push_back(cpu_seconds([&] {
        for (const HemisphereGather& gather : gathers) sink += estimators()[e].estimate(gather).value.r;
      }));
      shares[e].push_back(times[e].back() / gathering.back());
    }
  }
  const double microseconds = 1e6 / static_cast<double>(places.size());
  fmt::print("{{\"gather\": {{\"microseconds\": {:.1f}}}", median(gathering) * microseconds);
  for (std::size_t e = 0; e < estimators().size(); ++e)
    fmt::print(", \"{}\": {{\"microseconds\": {:.1f}, \"of_gather\": {:.4f}}}", estimators()[e].name,
               median(times[e]) * microseconds, median(shares[e]));
  fmt::print("}}\n");
  return sink >= 0 ? 0 : 1;  // which keeps the estimates from being left out
}

}  // namespace
}  // namespace isophote

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: bench_estimators SCENE RAYS [REPEATS]\n");
    return 2;
  }
  return isophote::run(argv[1], std::atoi(argv[2]), argc > 3 ? std::atoi(argv[3]) : 7);
}
