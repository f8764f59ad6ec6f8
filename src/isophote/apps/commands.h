#pragma once

#include <optional>
#include <string>
#include <vector>

#include "isophote/apps/settings.h"

namespace isophote::app {

/// What every verb that works on a scene is told.
struct SceneRequest {
  std::string scene;
  std::string load_cache;                                     ///< file; empty: none
  std::string progress;                                       ///< bar, json, none; empty: bar on a terminal
  int threads = 0;                                            ///< 0: all
  std::vector<std::pair<std::string, std::string>> settings;  ///< flags of settings.h's table, in their order
};

/// What `isophote render` was asked for.
struct RenderRequest : SceneRequest {
  std::vector<std::string> outputs;        ///< .exr or .png
  std::string stats, preview, save_cache;  ///< files; empty: none
  std::string records_picture, error_picture, density_picture;
  std::string record_colour;         ///< radius or error; empty: radius
  std::optional<std::string> slice;  ///< "X,Y,Z;NX,NY,NZ"; none: amid the records in media
  bool check = true;
  int refine = 0;  ///< times at most
};

/// What `isophote explain` was asked for.
struct ExplainRequest : SceneRequest {
  std::string pixel;    ///< "X,Y", from the top left
  std::string picture;  ///< file; empty: none
  bool json = false;
};

struct CompareRequest {
  std::string image, other, reference, second, layer, error_picture;
  bool json = false;
  std::optional<double> fail_above;  ///< relative RMSE; none: never
  int block = 1;                     ///< average both over blocks of this size first
};

// Each returns the exit code: 0 done, 1 failed. They throw UserError and UsageError.
int render(const RenderRequest& request);
int explain(const ExplainRequest& request);
int compare(const CompareRequest& request);
int methods();

}  // namespace isophote::app
