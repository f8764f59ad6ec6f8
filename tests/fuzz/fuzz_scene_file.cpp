#include <cstdint>
#include <string>
#include <string_view>

#include "isophote/core/check.h"
#include "isophote/core/error.h"
#include "isophote/load/scene_toml.h"

using namespace isophote;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const SceneToml toml = parse_scene_toml(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.toml");
    ISOPHOTE_CHECK(toml.scene.path.empty(), ==, false);
  } catch (const UserError& error) {
    const std::string message = error.what();
    ISOPHOTE_CHECK(message.substr(0, 10), ==, "fuzz.toml:");
    ISOPHOTE_CHECK(message.find('\n'), ==, std::string::npos);
  }
  return 0;
}
