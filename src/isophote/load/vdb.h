#pragma once

#include <memory>
#include <string>

#include "isophote/load/memory_budget.h"
#include "isophote/scene/density_grid.h"

namespace isophote {

/// The grid of that name in an OpenVDB file, its values times `scale`: a fog volume of floats whose transform is
/// affine. Inactive voxels count as empty. Throws UserError with the bare reason for anything else, and where the
/// program was built without OpenVDB.
std::shared_ptr<const DensityGrid> read_vdb(const std::string& path, const std::string& grid, float scale,
                                            MemoryBudget& budget);

}  // namespace isophote
