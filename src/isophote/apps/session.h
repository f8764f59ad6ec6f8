#pragma once

#include <optional>

#include "isophote/apps/commands.h"
#include "isophote/apps/progress_display.h"
#include "isophote/apps/settings.h"
#include "isophote/apps/threads.h"
#include "isophote/cache/record_cache.h"
#include "isophote/integrate/build.h"
#include "isophote/load/scene_file.h"

namespace isophote::app {

/// Flags win over the scene file, the scene file over defaults. Throws UsageError, naming the flag.
RenderSettings merged_settings(const SceneRequest& request, const std::vector<Setting>& from_file);

/// Refuses, by UsageError, flags that decide the same thing, and what the chosen method has no use for. (A scene file
/// may hold settings for another method, and a flag may override what the scene file decides.)
void check_method(const SceneRequest& request, const RenderSettings& settings, const Method& method);

/// A scene, and what it takes to build its cache: what the verbs that work on one share.
class Session {
 public:
  explicit Session(const SceneRequest& request);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Reads the scene and settles what is wanted of it, which may then be judged; `prepare` makes the job of it.
  void read();
  void prepare();

  const RenderSettings& settings() const { return settings_; }
  const LoadedScene& loaded() const { return loaded_; }
  const Method& method() const { return method_; }
  int threads() const { return threads_.count(); }
  const Clock& start() const { return start_; }
  ProgressDisplay& display() { return display_; }
  Job& job() { return *job_; }

  /// The records of --load-cache, or none.
  RecordCache starting_cache();
  /// Adds what the picture lacks; with --records, builds anew.
  BuildReport build(RecordCache& cache);
  /// The records as pictures read them: fitted to each other, where the method does that. Else nothing: as they are.
  std::optional<RecordCache> fitted(const RecordCache& cache, RayCounts& counts) const;
  void save(const RecordCache& cache, const std::string& path) const;

 private:
  const SceneRequest& request_;
  Threads threads_;
  Interruptible interruptible_;
  ProgressDisplay display_;
  Clock start_;
  RenderSettings settings_;
  LoadedScene loaded_;
  Method method_;
  std::optional<RayCaster> rays_;
  std::optional<Emitters> emitters_;
  std::optional<Media> media_;
  std::optional<Job> job_;
};

}  // namespace isophote::app
