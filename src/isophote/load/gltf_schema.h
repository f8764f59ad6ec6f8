#pragma once

#include <nlohmann/json_fwd.hpp>

#include "isophote/load/memory_budget.h"

namespace isophote {

/// Checks a glTF document against what is read of the glTF 2.0 schema and of the supported extensions: types, required
/// keys, lengths of arrays, every index in range, numbers that fit a float. What is not read is removed, and numbers
/// become floating point, because the parser behind would cut integers to 32 bits. Throws UserError `PLACE: reason`.
void apply_schema(nlohmann::json& document, MemoryBudget& budget);

}  // namespace isophote
