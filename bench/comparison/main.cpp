// What the comparison of the field computes; bench/figures runs it and makes the tables and pictures.
#include <fmt/format.h>

#include <cstdio>

#include "comparison/equal_records.h"
#include "comparison/plane_figures.h"
#include "comparison/set_up.h"

namespace isophote::bench {
namespace {

constexpr const char* usage =
    "usage: bench_figures points SCENE SIZE LIGHT COUNT RAYS FILE\n"
    "       bench_figures line\n"
    "       bench_figures derivatives FOLDER\n"
    "       bench_figures equal SCENE SIZE LIGHT SEED RAYS FILE VARIANT,... COUNT,... [PICTURES]\n"
    "where gathers hit they follow paths, or read one fine cache: LIGHT is paths or fixed\n";

bool is_fixed(const std::string& light) {
  if (light != "fixed" && light != "paths") throw UsageError("LIGHT is paths or fixed, not '" + light + "'");
  return light == "fixed";
}

int run(const std::vector<std::string>& arguments) {
  const auto is = [&](const char* verb, std::size_t fewest, std::size_t most) {
    return !arguments.empty() && arguments[0] == verb && arguments.size() > fewest && arguments.size() <= most + 1;
  };
  if (is("points", 6, 6)) {
    const SetUp scene(arguments[1], arguments[2], is_fixed(arguments[3]));
    write_points(arguments[6], make_points(scene.job(), std::stoul(arguments[4]), std::stoi(arguments[5])));
  } else if (is("equal", 8, 9)) {
    const SetUp scene(arguments[1], arguments[2], is_fixed(arguments[3]));
    Job job = scene.job();
    job.seed = std::stoull(arguments[4]);
    job.strata = Strata::about(std::stoi(arguments[5]));
    Comparison comparison{split(arguments[7], ','), {}, arguments.size() > 9 ? arguments[9] : ""};
    for (const std::string& count : split(arguments[8], ',')) comparison.counts.push_back(std::stoul(count));
    compare_at_equal_records(job, read_points(arguments[6]), comparison);
  } else if (is("line", 0, 0)) {
    print_line();
  } else if (is("derivatives", 1, 1)) {
    draw_derivatives(arguments[1], all_threads());
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
    fmt::print(stderr, "bench_figures: {}\n", error.what());
    return 1;
  }
}
