#pragma once

#include <string>
#include <vector>

#include "isophote/apps/settings.h"

namespace isophote::app {

/// What `isophote render` was asked for.
struct RenderRequest {
  std::string scene;
  std::vector<std::string> outputs;             ///< .exr or .png
  std::string stats, preview, records_picture;  ///< files; empty: none
  std::string save_cache, load_cache;
  std::string progress;  ///< bar, json, none; empty: bar on a terminal
  int threads = 0;       ///< 0: all
  bool check = true;
  int refine = 0;                                             ///< times at most
  std::vector<std::pair<std::string, std::string>> settings;  ///< flags of settings.h's table, in their order
};

struct CompareRequest {
  std::string image, reference, second, layer, error_picture;
  bool json = false;
  double fail_above = -1;  ///< relative RMSE; negative: never
  int block = 1;           ///< average both over blocks of this size first
};

// Each returns the exit code: 0 done, 1 failed. They throw UserError and UsageError.
int render(const RenderRequest& request);
int compare(const CompareRequest& request);
int methods();

}  // namespace isophote::app
