#pragma once

#include <span>

#include "isophote/scene/scene.h"

namespace isophote {

/// The triangles of these meshes as one closed surface that faces outwards: vertices at equal places become one, and
/// all triangles are turned over where they enclose a negative volume. Throws UserError with the bare reason where an
/// edge is not shared by just two triangles that turn it opposite ways, or where nothing is enclosed.
ClosedMesh closed_mesh(std::span<const Mesh* const> meshes);

}  // namespace isophote
