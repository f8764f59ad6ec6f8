// A host of isophote::cache with no scene of its own: it stands in the middle of a sphere that glows on one half, hands
// over what its rays see there, and reads the irradiance around that place back from a cache.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "isophote/cache/catalogue.h"
#include "isophote/cache/record_cache.h"
#include "isophote/sampling/sampler.h"

namespace {

constexpr float sphere_radius = 2;

isophote::HemisphereGather look_around(int rays) {
  isophote::HemisphereGather gather;
  gather.strata = isophote::Strata::about(rays);
  for (int j = 0; j < gather.strata.polar; ++j) {
    for (int k = 0; k < gather.strata.azimuthal; ++k) {
      isophote::Sampler sampler(isophote::Purpose::record, 1, 0, static_cast<std::uint32_t>(gather.samples.size()));
      isophote::GatherSample sample;
      sample.direction = gather.frame.to_world(gather.strata.direction(j, k, sampler.next2()));
      sample.distance = sphere_radius;
      sample.normal = -sample.direction;
      sample.radiance = isophote::Rgb(sample.direction.x > 0 ? 1.0f : 0.0f);
      gather.samples.push_back(sample);
    }
  }
  return gather;
}

void expect_near(const char* what, float value, double expected, double tolerance) {
  std::printf("%s: %.4f, expected %.4f\n", what, value, expected);
  if (!(std::abs(value - expected) <= tolerance)) std::exit(1);
}

}  // namespace

int main() {
  const isophote::Method method = isophote::find_method("ward1992");
  const isophote::View view{.pixel = 0.001f, .scene_scale = 2 * sphere_radius};
  const isophote::Record record = method.make_record(look_around(4096), view);

  isophote::RecordCache cache({{-2, -2, -2}, {2, 2, 2}});
  cache.insert(record);

  // Half of the hemisphere glows with radiance 1: E = pi/2. A step d towards that half changes it by 4 d / (pi R) of
  // itself.
  const double irradiance = std::numbers::pi / 2, step = 0.05;
  const double change = irradiance * 4 * step / (std::numbers::pi * sphere_radius);
  const isophote::Vec3 up{0, 0, 1};
  const auto here = cache.interpolate({{0, 0, 0}, up, up});
  const auto beside = cache.interpolate({{static_cast<float>(step), 0, 0}, up, up});
  if (!here || !beside) return 1;
  expect_near("irradiance", here->g, irradiance, 0.01 * irradiance);
  expect_near("change over a step", beside->g - here->g, change, 0.05 * change);
  if (cache.interpolate({{1.9f, 0, 0}, up, up})) return 1;  // too far for the record
  return 0;
}
