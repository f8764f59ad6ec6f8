#pragma once

#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "isophote/core/error.h"
#include "isophote/integrate/job.h"
#include "isophote/load/scene_file.h"

namespace isophote::bench {

/// A loop on as many threads as the machine has.
inline ParallelFor all_threads() {
  return thread_for(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
}

/// A scene with all that building caches in it takes.
class SetUp {
 public:
  SetUp(const std::string& scene, const std::string& size)
      : loaded_(load_scene(scene, [](const std::string&) {})), rays_(loaded_.scene), emitters_(loaded_.scene) {
    const std::size_t cross = size.find('x');
    if (cross == std::string::npos) throw UsageError("a size is WIDTHxHEIGHT, not '" + size + "'");
    width_ = std::stoi(size.substr(0, cross)), height_ = std::stoi(size.substr(cross + 1));
  }
  SetUp(const SetUp&) = delete;
  SetUp& operator=(const SetUp&) = delete;

  Job job() const {
    Job job{World{loaded_.scene, rays_, emitters_}, loaded_.scene.cameras.at(0)};
    job.width = width_, job.height = height_;
    job.parallel = all_threads();
    return job;
  }

 private:
  LoadedScene loaded_;
  RayCaster rays_;
  Emitters emitters_;
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
