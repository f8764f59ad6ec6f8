#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "isophote/core/check.h"
#include "isophote/core/error.h"
#include "isophote/load/scene_toml.h"

using namespace isophote;

namespace {

void check_medium(const SceneToml::Medium& medium) {
  for (const Rgb& c : {medium.scattering, medium.absorption, medium.emission}) {
    ISOPHOTE_CHECK(std::min({c.r, c.g, c.b}), >=, 0);
    ISOPHOTE_CHECK(is_finite(c), ==, true);
  }
  ISOPHOTE_CHECK(is_black(medium.scattering + medium.absorption + medium.emission), ==, false);
  ISOPHOTE_CHECK(std::abs(medium.g), <, 1);
  ISOPHOTE_CHECK(medium.box && medium.boundary, ==, false);
  ISOPHOTE_CHECK(medium.height && medium.grid, ==, false);
  if (medium.box) {
    const Vec3 size = medium.box->size();
    ISOPHOTE_CHECK(std::min({size.x, size.y, size.z}), >, 0);
    ISOPHOTE_CHECK(is_finite(size), ==, true);
  }
  if (medium.height) ISOPHOTE_CHECK(medium.height->height, >, 0);
  if (medium.height) ISOPHOTE_CHECK(std::isfinite(medium.height->base), ==, true);
  if (medium.grid) ISOPHOTE_CHECK(static_cast<float>(medium.grid->scale), >, 0);
  if (medium.grid) ISOPHOTE_CHECK(medium.grid->name.empty() || medium.grid->file.path.empty(), ==, false);
  if (medium.boundary) ISOPHOTE_CHECK(medium.boundary->mesh.empty(), ==, false);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const SceneToml toml = parse_scene_toml(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.toml");
    ISOPHOTE_CHECK(toml.scene.path.empty(), ==, false);
    ISOPHOTE_CHECK(toml.media.size(), <=, std::size_t{32});
    for (const SceneToml::Medium& medium : toml.media) check_medium(medium);
  } catch (const UserError& error) {
    const std::string message = error.what();
    ISOPHOTE_CHECK(message.substr(0, 10), ==, "fuzz.toml:");
    ISOPHOTE_CHECK(message.find('\n'), ==, std::string::npos);
  }
  return 0;
}
