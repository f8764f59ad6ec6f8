#pragma once

#include <filesystem>

#include "isophote/load/memory_budget.h"
#include "isophote/load/scene_toml.h"

namespace isophote {

/// Adds the media that a scene file names to a scene. Grids are read from `folder`, their paths added to `files`;
/// meshes that bound media are taken out of what there is to see. Throws UserError `FILE:LINE: reason`.
void add_media(const std::vector<SceneToml::Medium>& sources, const std::filesystem::path& folder, MemoryBudget& budget,
               Scene& scene, std::vector<std::string>& files);

}  // namespace isophote
