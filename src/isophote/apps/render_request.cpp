#include "isophote/apps/render_request.h"

#include <fmt/format.h>

#include <algorithm>

#include "isophote/apps/output_files.h"
#include "isophote/core/atomic_file.h"
#include "isophote/core/error.h"

namespace isophote::app {
namespace {

using Files = std::vector<NamedFile>;

/// Adds a file where the flag was given.
void add_flag(Files& files, const std::string& flag, const std::string& path) {
  if (!path.empty()) files.push_back({flag + " " + path, path});
}

Files pictures_to_look_at(const RenderRequest& request) {
  Files files;
  add_flag(files, "--preview", request.preview);
  add_flag(files, "--show-records", request.records_picture);
  return files;
}

/// All outputs but the cache, which alone may replace one of the inputs: the cache it began with.
Files outputs_but_cache(const RenderRequest& request) {
  Files files = pictures_to_look_at(request);
  for (const std::string& output : request.outputs) add_flag(files, "-o", output);
  add_flag(files, "--stats", request.stats);
  return files;
}

Files all_outputs(const RenderRequest& request) {
  Files files = outputs_but_cache(request);
  add_flag(files, "--save-cache", request.save_cache);
  return files;
}

const Option& option_named(const std::string& name) {
  const auto options = app::options();
  return *std::find_if(options.begin(), options.end(), [&](const Option& o) { return o.name == name; });
}

/// Flags that decide the same thing, and flags that method `path` has no use for. (A scene file may hold settings for
/// another method, and a flag may override what the scene file decides.)
void check_flags(const RenderRequest& request, const Method& method) {
  std::string deciding;
  for (const auto& [name, value] : request.settings) {
    if (!method.caches() && option_named(name).caches)
      throw UsageError(fmt::format("method 'path' caches nothing: it takes no --{}", name));
    if (name != "error" && name != "a" && name != "records") continue;
    if (!deciding.empty())
      throw UsageError(fmt::format("--{} and --{} both decide how many records there are: give one", deciding, name));
    deciding = name;
  }
}

}  // namespace

void check_request(const RenderRequest& request) {
  if (request.outputs.empty() && request.stats.empty() && request.records_picture.empty() && request.save_cache.empty())
    throw UsageError("nothing to write: give -o FILE.exr or FILE.png (or --stats, --show-records, --save-cache)");
  for (const std::string& output : request.outputs)
    if (!output.ends_with(".exr") && !output.ends_with(".png"))
      throw UsageError(fmt::format("-o {}: the name must end in .exr or .png", output));
  for (const NamedFile& file : pictures_to_look_at(request)) require_png(file);
  check_distinct(all_outputs(request));
  check_kept(Files{{"the scene", request.scene}}, all_outputs(request));
  if (!request.load_cache.empty())
    check_kept(Files{{"the records of --load-cache", request.load_cache}}, outputs_but_cache(request));
}

void check_scene_is_kept(const RenderRequest& request, std::span<const std::string> scene_files) {
  Files inputs;
  for (const std::string& file : scene_files) inputs.push_back({file + ", which the scene is read from", file});
  check_kept(inputs, all_outputs(request));
}

void check_outputs(const RenderRequest& request) {
  for (const NamedFile& file : all_outputs(request)) AtomicFile{file.path};
}

RenderSettings merged_settings(const RenderRequest& request, const std::vector<Setting>& from_file) {
  RenderSettings settings;
  for (const Setting& s : from_file) apply_setting(settings, s.table, s.key, s.value, s.place);
  for (const auto& [name, value] : request.settings) {
    try {
      option_named(name).apply(settings, value);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("--{}: {}", name, error.what()));
    }
  }
  return settings;
}

void check_against_method(const RenderRequest& request, const RenderSettings& settings, const Method& method) {
  check_flags(request, method);
  if (settings.lazy && !request.preview.empty())
    throw UsageError("--order lazy is one pass from the top: it takes no --preview");
  if (!method.caches() &&
      !(request.save_cache.empty() && request.load_cache.empty() && request.records_picture.empty()))
    throw UsageError("method 'path' caches nothing: it takes no --save-cache, --load-cache or --show-records");
  if (request.refine > 0) {
    if (!request.check) throw UsageError("--refine goes by the measured error: it takes no --no-check");
    if (settings.a || settings.records || settings.lazy || !method.caches())
      throw UsageError(
          "--refine works towards an --error, with caches built in rounds: it takes no --a, --records, "
          "--order lazy or method 'path'");
  }
  if (settings.records && (settings.lazy || !request.load_cache.empty()))
    throw UsageError("--records builds caches in rounds and from nothing: it takes no --order lazy or --load-cache");
}

}  // namespace isophote::app
