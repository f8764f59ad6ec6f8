#pragma once

#include <span>
#include <string>
#include <vector>

#include "isophote/apps/commands.h"
#include "isophote/apps/settings.h"
#include "isophote/integrate/volume_slice.h"
#include "isophote/load/scene_file.h"

namespace isophote::app {

// What of a request can be judged before the work. All throw UsageError, except where a file cannot be written.

/// Flags that cannot work are refused before anything is read.
void check_request(const RenderRequest& request);

/// Refuses outputs that would overwrite what the scene was read from. (Of `request.scene` check_request knows.)
void check_scene_is_kept(const RenderRequest& request, std::span<const std::string> scene_files);

/// A file that cannot be written is found out before the work, not after it. Throws UserError.
void check_outputs(const RenderRequest& request);

/// The plane of --slice, if one was given.
std::optional<Plane> wanted_slice(const RenderRequest& request);

/// Refuses what there is nothing of in the scene.
void check_against_scene(const RenderRequest& request, const Scene& scene);

/// What the chosen way of rendering cannot do is refused, not left undone: what `check_method` does not know of.
void check_against_method(const RenderRequest& request, const RenderSettings& settings, const Method& method);

}  // namespace isophote::app
