// Reads any bytes as an OpenEXR file; of one that can be an environment, light is sampled.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "isophote/core/check.h"
#include "isophote/core/error.h"
#include "isophote/image/exr.h"
#include "isophote/scene/environment.h"

namespace {

using namespace isophote;

constexpr std::uint64_t memory = 64 << 20;

/// Light as a scene file may have it: neither negative nor beyond 1e30.
EnvironmentMap environment_of(RgbImage image) {
  for (Rgb& c : image.pixels)
    for (int i = 0; i < 3; ++i) c[i] = c[i] > 0 ? std::min(c[i], 1e30f) : 0;
  return {std::move(image), 0.5f};
}

void check_light(const Environment& environment, Vec2 point, float pdf) {
  const Vec3 direction = environment.direction(point);
  ISOPHOTE_CHECK(std::abs(length(direction) - 1), <, 1e-4f);
  const Rgb radiance = environment.radiance(point);
  ISOPHOTE_CHECK(is_finite(radiance), ==, true);
  ISOPHOTE_CHECK(std::min({radiance.r, radiance.g, radiance.b}), >=, 0.0f);
  ISOPHOTE_CHECK(pdf, >=, 0.0f);
  const Vec2 back = environment.point(direction);
  ISOPHOTE_CHECK(is_finite(environment.radiance(back)), ==, true);
}

void use(const EnvironmentMap& map) {
  const Environment environment(map);
  for (int i = 0; i < 16; ++i) {
    const Vec2 u{(static_cast<float>(i) + 0.5f) / 16, static_cast<float>(i * 5 % 16) / 16};
    check_light(environment, u, 0);
    if (environment.rest_power() > 0) {
      const Vec2 point = environment.sample_rest(u);
      check_light(environment, point, environment.rest_pdf(point));
    }
    if (environment.peak_power() > 0) {
      const Vec2 point = environment.sample_peaks(u);
      check_light(environment, point, environment.peak_pdf(point));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path =
      (std::filesystem::temp_directory_path() / ("fuzz_exr." + std::to_string(getpid()))).string();
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const ExrFile file = read_exr(path, memory);
    const std::size_t pixels = static_cast<std::size_t>(file.width) * static_cast<std::size_t>(file.height);
    for (const ExrFile::Channel& channel : file.channels) ISOPHOTE_CHECK(channel.values.size(), ==, pixels);
    if (pixels <= 1 << 16) use(environment_of(read_exr_layer(path, "", memory)));
  } catch (const UserError& error) {
    ISOPHOTE_CHECK(std::string(error.what()).find('\n'), ==, std::string::npos);
  }
  std::filesystem::remove(path);
  return 0;
}
