#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "isophote/cache/catalogue.h"
#include "isophote/scene/scene.h"

namespace isophote::app {

/// Everything `render` can be told, with its defaults. Flags and scene files write here through one table.
struct RenderSettings {
  std::string method = "cached", estimator, metric, glossy_estimator, glossy_metric, media_estimator, media_metric;
  std::optional<int> width, height;
  std::string camera;
  int samples = 16;
  std::optional<double> error;  ///< none: default_error
  std::optional<float> a;
  std::optional<int> rays;  ///< of a record; 0: as many as the error asks; none: the method's own
  std::optional<int> max_depth, records;
  std::optional<Secondary> secondary;
  std::optional<bool> leak_test, regress, glossy_window;
  std::optional<Glossy> glossy;
  std::optional<InScattering> media;
  std::optional<float> glossy_a, glossy_contrast, media_a;
  std::optional<Basis> basis;
  bool lazy = false;
  std::optional<float> min_pixels, max_pixels, min_view, max_view, min_radius, max_radius;
  std::optional<bool> bound_gradient;
  std::optional<float> bound_neighbours;
  std::optional<int> extrapolate;
  std::optional<float> aspect;
  std::optional<Falloff> weight;
  std::uint64_t seed = 0;
  std::optional<float> exposure;  ///< stops; none: chosen from the picture
};

/// Wanted mean relative error where neither an error, a threshold nor a number of records is given.
inline constexpr double default_error = 0.03;
/// Rays of a record where they do not adapt and no number is given.
inline constexpr int default_rays = 800;

/// One setting: `--name VALUE` on the command line, `name = VALUE` in a scene file's [film] or [method] table.
struct Option {
  std::string_view table, name, values, help;
  void (*apply)(RenderSettings&, const std::string& value);  ///< throws UsageError saying what it wants
  bool caches = false;                                       ///< means something only to methods that cache
};
std::span<const Option> options();

/// Applies one setting of a scene file. Throws UserError `PLACE: reason` for unknown keys and bad values.
void apply_setting(RenderSettings& settings, const std::string& table, const std::string& name,
                   const std::string& value, const std::string& place);

/// "x,y,z". Throws UsageError saying what it wants.
Vec3 parsed_triple(const std::string& text);

/// The method these settings ask for, its combination checked.
Method chosen_method(const RenderSettings& settings);

/// Bounds on radii in words; "none" where there are none.
std::string describe(const RadiusBounds& bounds);

/// A camera of the scene by name or index, or `eye;target;fov` in scene units and degrees. Throws UsageError.
Camera chosen_camera(const RenderSettings& settings, const Scene& scene);

}  // namespace isophote::app
