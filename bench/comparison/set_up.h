#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "isophote/core/error.h"
#include "isophote/integrate/build.h"
#include "isophote/integrate/job.h"
#include "isophote/load/scene_file.h"

namespace isophote::bench {

/// A loop on as many threads as the machine has.
inline ParallelFor all_threads() {
  return thread_for(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
}

/// A scene with all that building caches in it takes. `fixed_light`: gathers read one fine cache, the same for every
/// user of a scene and size, where they hit; else they follow paths.
class SetUp {
 public:
  SetUp(const std::string& scene, const std::string& size, bool fixed_light)
      : loaded_(load_scene(scene, [](const std::string&) {})), rays_(loaded_.scene), emitters_(loaded_.scene) {
    if (!loaded_.scene.media.empty()) media_.emplace(loaded_.scene);
    const std::size_t cross = size.find('x');
    if (cross == std::string::npos) throw UsageError("a size is WIDTHxHEIGHT, not '" + size + "'");
    width_ = std::stoi(size.substr(0, cross)), height_ = std::stoi(size.substr(cross + 1));
    if (fixed_light) make_light();
  }
  SetUp(const SetUp&) = delete;
  SetUp& operator=(const SetUp&) = delete;

  Job job() const {
    Job job{World{loaded_.scene, rays_, emitters_}, loaded_.scene.cameras.at(0)};
    job.world.media = media_ ? &*media_ : nullptr;
    job.width = width_, job.height = height_;
    job.parallel = all_threads();
    job.light = light_ ? &*light_ : nullptr;
    return job;
  }

 private:
  void make_light() {
    Job fine = job();
    fine.method = find_method("cached");
    fine.method.adaptive = false;
    fine.strata = Strata::about(3200);
    RecordCache cache = empty_cache(fine);
    build_in_rounds(fine, cache);
    light_.emplace(std::move(cache));
  }

  LoadedScene loaded_;
  RayCaster rays_;
  Emitters emitters_;
  std::optional<Media> media_;
  std::optional<RecordCache> light_;
  int width_ = 0, height_ = 0;
};

inline std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace isophote::bench
