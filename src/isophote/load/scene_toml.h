#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isophote/load/scene_file.h"

namespace isophote {

/// What a scene file says, before any file that it names is opened.
struct SceneToml {
  struct File {
    std::string path;   ///< as written
    std::string place;  ///< "FILE:LINE"
  };
  struct Environment {
    File file;
    double rotation = 0;   ///< degrees
    double intensity = 1;  ///< factor on every pixel
  };
  /// What fills a part of space. Coefficients are those at density 1.
  struct Medium {
    struct Grid {
      File file;
      std::string name;
      double scale = 1;  ///< factor on density
    };
    struct Boundary {
      std::string mesh;   ///< name of a mesh or a node of the glTF file
      std::string place;  ///< "FILE:LINE"
    };
    std::string place;  ///< "FILE:LINE"
    std::string name;
    Rgb scattering, absorption;  ///< 1/m
    Rgb emission;                ///< W/m3/sr
    float g = 0;                 ///< in (-1, 1)
    std::optional<HeightDensity> height;
    std::optional<Grid> grid;  ///< never beside `height`
    std::optional<Box> box;
    std::optional<Boundary> boundary;  ///< never beside `box`; neither: what there is to see
  };
  File scene;
  std::optional<Environment> environment;
  std::vector<Medium> media;  ///< at most 32
  std::vector<Setting> settings;
};

/// The path of a file that the scene file, which lies in `folder`, names. Throws UserError with the place where it is
/// named where there is none.
std::string resolve(const SceneToml::File& file, const std::filesystem::path& folder);

/// Parses the text of a scene file; `name` stands before messages. Throws UserError `NAME:LINE: reason`.
SceneToml parse_scene_toml(std::string_view text, const std::string& name);

}  // namespace isophote
