#include "isophote/apps/render_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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
  add_flag(files, "--show-error", request.error_picture);
  add_flag(files, "--show-density", request.density_picture);
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

}  // namespace

void check_request(const RenderRequest& request) {
  if (request.outputs.empty() && request.stats.empty() && request.save_cache.empty() &&
      request.records_picture.empty() && request.error_picture.empty() && request.density_picture.empty())
    throw UsageError(
        "nothing to write: give -o FILE.exr or FILE.png (or --stats, --show-records, --show-error, "
        "--show-density, --save-cache)");
  for (const std::string& output : request.outputs)
    if (!output.ends_with(".exr") && !output.ends_with(".png"))
      throw UsageError(fmt::format("-o {}: the name must end in .exr or .png", output));
  if (!request.record_colour.empty() && request.records_picture.empty())
    throw UsageError("--record-colour is of the picture of --show-records: give that too");
  if (wanted_slice(request) && request.records_picture.empty())
    throw UsageError("--slice is of the picture of --show-records: give that too");
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

std::optional<Plane> wanted_slice(const RenderRequest& request) {
  if (!request.slice) return std::nullopt;
  const std::string& text = *request.slice;
  const std::size_t end = text.find(';');
  if (end == std::string::npos) throw UsageError(fmt::format("--slice: wants X,Y,Z;NX,NY,NZ, not '{}'", text));
  try {
    const Vec3 point = parsed_triple(text.substr(0, end));
    const Vec3d normal(parsed_triple(text.substr(end + 1)));
    if (!(length(normal) > 0)) throw UsageError("the normal is 0");
    return Plane{point, Vec3(normalize(normal))};
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--slice: {}", error.what()));
  }
}

void check_against_scene(const RenderRequest& request, const Scene& scene) {
  const bool scatters = std::any_of(scene.media.begin(), scene.media.end(),
                                    [](const Medium& medium) { return !is_black(medium.scattering); });
  if (request.slice && !scatters)
    throw UsageError(fmt::format("--slice cuts records in media: {} has no media that scatter", request.scene));
}

void check_outputs(const RenderRequest& request) {
  for (const NamedFile& file : all_outputs(request)) AtomicFile{file.path};
}

void check_against_method(const RenderRequest& request, const RenderSettings& settings, const Method& method) {
  if (settings.lazy && !request.preview.empty())
    throw UsageError("--order lazy is one pass from the top: it takes no --preview");
  if (request.refine > 0) {
    if (!request.check) throw UsageError("--refine goes by the measured error: it takes no --no-check");
    if (!request.load_cache.empty())
      throw UsageError("--refine works on the records that this run makes: it takes no --load-cache");
    if (settings.a || settings.records || settings.lazy || !method.caches())
      throw UsageError(
          "--refine works towards an --error, with caches built in rounds: it takes no --a, --records, "
          "--order lazy or method 'path'");
  }
  if (request.slice && method.caches() && !method.volume.caches())
    throw UsageError("--slice cuts records in media: without --media cache there are none");
  if (method.caches()) return;
  const std::pair<const char*, const std::string*> needing_records[] = {{"--save-cache", &request.save_cache},
                                                                        {"--load-cache", &request.load_cache},
                                                                        {"--show-records", &request.records_picture},
                                                                        {"--show-error", &request.error_picture},
                                                                        {"--show-density", &request.density_picture}};
  for (const auto& [flag, file] : needing_records)
    if (!file->empty()) throw UsageError(fmt::format("method 'path' caches nothing: it takes no {}", flag));
}

}  // namespace isophote::app
