#include <gtest/gtest.h>

#include <numeric>

#include "isophote/core/error.h"
#include "isophote/image/exr.h"
#include "test_files.h"

namespace isophote {
namespace {

using testing_files::temporary;

TEST(ExrMemory, WhatDoesNotFitInMemoryIsRefused) {
  constexpr int size = 512;
  ExrFile file;
  file.width = file.height = size;
  const std::vector<std::string> names{"R", "G", "B", "depth.Z", "normal.X", "normal.Y", "normal.Z", "other.R"};
  for (const std::string& name : names) file.add(name, std::vector<float>(size * size, 0.5f));
  const std::string path = temporary("a.exr");
  write_exr(path, file);
  const auto refusal = [&](const auto& read) -> std::string {
    try {
      read();
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  // 1 MiB a channel, and what OpenEXR itself keeps: under 1 MiB.
  constexpr std::uint64_t mebi = 1 << 20;
  EXPECT_EQ(refusal([&] { read_exr(path, 9 * mebi); }), "");
  EXPECT_EQ(refusal([&] { read_exr(path, 8 * mebi); }),
            path + ": cannot read EXR: it does not fit in memory: needs 9 MiB, there are 8");
  EXPECT_EQ(refusal([&] { read_exr_layer(path, "", 4 * mebi); }), "");
  EXPECT_NE(refusal([&] { read_exr_layer(path, "", 3 * mebi); }), "");
}

TEST(ExrLayer, ALayerByItselfIsTheSame) {
  ExrFile file;
  file.width = 7, file.height = 5;
  for (const char* name : {"R", "G", "B", "normal.X", "normal.Y", "normal.Z", "half.R"}) {
    std::vector<float> values(35);
    std::iota(values.begin(), values.end(), 100 * static_cast<float>(file.channels.size()));
    file.add(name, values);
  }
  const std::string path = temporary("a.exr");
  write_exr(path, file);
  for (const char* layer : {"", "normal"}) EXPECT_EQ(read_exr_layer(path, layer).pixels, file.rgb(layer).pixels);
  try {
    read_exr_layer(path, "half");
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_EQ(error.what(), path + ": cannot read EXR: no layer 'half'; there is: R,G,B, normal");
  }
}

}  // namespace
}  // namespace isophote
