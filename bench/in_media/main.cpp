// What the sections about media of docs/benchmarks.md compute; bench/media_records.py runs it and makes tables and
// pictures.
#include <fmt/format.h>

#include <cstdio>

#include "comparison/set_up.h"
#include "in_media/floor_gradients.h"
#include "in_media/media_records.h"
#include "isophote/image/exr.h"

namespace isophote::bench {
namespace {

constexpr const char* usage =
    "usage: bench_media truths SCENE SIZE POINTS PATHS FILE\n"
    "       bench_media records SCENE SIZE SEED GATHERS RAYS FILE COUNT,... [PICTURES PATHS]\n"
    "       bench_media paths SCENE SIZE SAMPLES FILE\n"
    "       bench_media floor FOLDER\n";

int run(const std::vector<std::string>& arguments) {
  const auto is = [&](const char* verb, std::size_t fewest, std::size_t most) {
    return !arguments.empty() && arguments[0] == verb && arguments.size() > fewest && arguments.size() <= most + 1;
  };
  if (is("truths", 5, 5)) {
    const SetUp scene(arguments[1], arguments[2], false);
    write_truths(arguments[5], path_truths(scene.job(), std::stoul(arguments[3]), std::stoi(arguments[4])));
  } else if (is("records", 7, 9)) {
    const SetUp scene(arguments[1], arguments[2], false);
    Job job = scene.job();
    job.seed = std::stoull(arguments[3]);
    job.strata = Strata::about(std::stoi(arguments[5]));
    MediaComparison comparison;
    comparison.gathers = std::stoi(arguments[4]);
    for (const std::string& count : split(arguments[7], ',')) comparison.counts.push_back(std::stoul(count));
    if (arguments.size() > 9) comparison.pictures = arguments[8], comparison.paths = arguments[9];
    compare_media_records(job, read_truths(arguments[6]), comparison);
  } else if (is("paths", 4, 4)) {
    const SetUp scene(arguments[1], arguments[2], false);
    Job job = scene.job();
    job.samples = std::stoi(arguments[3]);
    ExrFile file{job.width, job.height, {}};
    file.add_rgb("", in_scattered_by_paths(job));
    write_exr(arguments[4], file);
  } else if (is("floor", 1, 1)) {
    draw_floor_gradients(arguments[1], all_threads());
  } else {
    fmt::print(stderr, "{}", usage);
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace isophote::bench

int main(int argc, char** argv) {
  try {
    return isophote::bench::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_media: {}\n", error.what());
    return 1;
  }
}
