#pragma once

#include "isophote/validity/record.h"

namespace isophote::test {

/// A record in the middle of the back wall of scenes::cornell_box(), its radius a sixth of the picture's width.
inline Record back_wall_record() {
  Record record;
  record.position = {0, 1, -1}, record.normal = {0, 0, 1};
  record.footprint = Footprint::disk(0.3f, 1);
  record.jet.value = Rgb(1);
  return record;
}

}  // namespace isophote::test
