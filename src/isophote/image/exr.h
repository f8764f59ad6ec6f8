#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "isophote/image/image.h"
#include "isophote/image/physical_memory.h"

namespace isophote {

/// The channels of an OpenEXR file, 32-bit floats. A layer of colours is three channels `name.R`, `name.G`, `name.B`;
/// the unnamed layer is `R`, `G`, `B` (and `A`).
struct ExrFile {
  struct Channel {
    std::string name;
    std::vector<float> values;  // width * height
  };
  int width = 0, height = 0;
  std::vector<Channel> channels;

  const Channel* find(const std::string& name) const;
  void add(const std::string& name, std::vector<float> values);
  /// Adds `layer`.R/.G/.B, or plain R/G/B where `layer` is empty; `suffixes` may be "XYZ".
  void add_rgb(const std::string& layer, const RgbImage& image, const char* suffixes = "RGB");
  /// The colours of a layer. Throws UserError naming the layer and listing those there are.
  RgbImage rgb(const std::string& layer) const;
  std::vector<std::string> layers() const;
};

/// Reads any scan-line or tiled single-part EXR (half and float channels). Throws UserError `PATH: reason`, also for
/// sizes above 2^28 pixels and for what takes more than `memory` bytes, which are refused before anything is allocated.
ExrFile read_exr(const std::string& path, std::uint64_t memory = physical_memory());

/// The colours of one layer, the only channels that are read and kept. Throws UserError as `read_exr` and ExrFile::rgb
/// do.
RgbImage read_exr_layer(const std::string& path, const std::string& layer, std::uint64_t memory = physical_memory());

/// Writes under a temporary name in the same folder and renames, so that nothing half-written ever has the final name.
/// Identical contents give identical bytes. Throws UserError.
void write_exr(const std::string& path, const ExrFile& file);

}  // namespace isophote
