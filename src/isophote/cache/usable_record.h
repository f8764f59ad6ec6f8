#pragma once

#include "isophote/validity/volume_record.h"

namespace isophote {

/// Is everything in a record finite and such that lookups can add it up? What comes from outside may hold anything.
bool usable(const Record& record);
bool usable(const RadianceRecord& record);
bool usable(const VolumeRecord& record);
bool usable(const Pilot& pilot);

}  // namespace isophote
