#include "isophote/load/vdb.h"

#include "isophote/core/error.h"

namespace isophote {

std::shared_ptr<const DensityGrid> read_vdb(const std::string&, const std::string&, float, MemoryBudget&) {
  throw UserError("this program was built without OpenVDB, which .vdb files need");
}

}  // namespace isophote
