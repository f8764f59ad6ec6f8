#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "isophote/cache/record_file.h"
#include "isophote/core/error.h"
#include "isophote/core/ray.h"
#include "support/records.h"
#include "support/sign_record_file.h"

namespace isophote::test {

namespace fs = std::filesystem;

/// Where things lie in a file: magic, version, scene, length of the settings, settings, survey with threshold, count,
/// records; basis, count and records of radiance; count and records of media, twice; checksum.
inline constexpr std::size_t settings_at = 24, survey_bytes = 17, record_bytes = 235, radiance_head_bytes = 9,
                             radiance_record_bytes = 117, coefficient_bytes = 12, volume_record_bytes = 177;
/// Of a file without radiance and media, but for its settings and records.
inline constexpr std::size_t empty_bytes = settings_at + survey_bytes + 4 * 8 + 1 + 8;

class RecordFileTest : public testing::Test {
 protected:
  void SetUp() override {
    path_ = (fs::path(testing::TempDir()) /
             ("records_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name())))
                .string();
    fs::remove_all(path_);
  }
  void TearDown() override { fs::remove_all(path_); }

  static RecordFile sample(int count) {
    RandomPlaces random(17);
    RecordFile file{0x0123456789abcdefull, "method=bounded\na=0.2\nseed=7\n", {true, 0.5f, 2, 3}, 0.1f, {}};
    for (int i = 0; i < count; ++i) {
      Record r = round_record(random.point({-5, -5, -5}, {5, 5, 5}), random.direction(), random.number(0.1f, 1), 5);
      r.footprint.shape.xx *= 1.5f, r.footprint.shape.yy *= 1.5f;
      r.footprint.shape.xy = random.number(-0.4f, 0.4f);
      r.footprint.unscaled = random.number(0, 9);
      r.footprint.smallest = random.number(0, 0.1f);
      r.footprint.largest = i % 2 ? infinity : 3;
      r.footprint.falloff = i % 2 ? Falloff::tent : Falloff::ward;
      r.footprint.order = static_cast<std::uint8_t>(i % 3);
      r.curvature_scale = random.number(0, 1e-6f);
      r.jet.hessian = {random.number(-1, 1), random.number(-1, 1), random.number(-1, 1),
                       random.number(-1, 1), random.number(-1, 1), random.number(-1, 1)};
      r.gradient_scale = random.number(0, 1);
      r.jet.value = random.colour(0, 1e6f);
      r.jet.translational = random.gradient(3);
      r.jet.rotational = random.gradient(3);
      r.jet.standard_error = random.number(0, 1e3f);
      r.jet.gradient_error = i % 2 ? infinity : 4;
      r.jet.rays = 200;
      r.jet.distances.harmonic_mean = i % 2 ? infinity : 2;
      for (int s = i % 3; s < Obstacles::sectors; s += 3) r.jet.distances.obstacles.meet(s, random.number(0, 9));
      file.records.push_back(r);
    }
    return file;
  }

  /// The same with two records of radiance: of one band, and of three with gradients.
  static RecordFile with_radiance(int count) {
    RecordFile file = sample(count);
    RandomPlaces random(23);
    file.basis = Basis::spherical;
    for (const int bands : {1, 3}) {
      RadianceRecord& r = file.radiance.emplace_back();
      static_cast<Site&>(r) = sample(1).records[0];
      const auto coefficients = [&](Coefficients& all) {
        for (int i = 0; i < bands * bands; ++i) all.push_back(random.colour(-2, 2));
      };
      coefficients(r.jet.value);
      if (bands > 1) coefficients(r.jet.translational.x), coefficients(r.jet.translational.y);
      r.jet.rays = 300;
      r.jet.distances.harmonic_mean = 2;
      r.jet.distances.obstacles.meet(3, 1);
    }
    return file;
  }

  /// The same with three records of media: of light of surfaces in one band and in three with gradients, the second of
  /// them in logarithms; and one of light of media.
  static RecordFile with_media(int count) {
    RecordFile file = sample(count);
    RandomPlaces random(29);
    for (const int bands : {1, 3, 2}) {
      VolumeRecord& r = file.volumes[bands == 2].emplace_back();
      static_cast<Site&>(r) = sample(1).records[0];
      r.normal = {}, r.media = bands == 3 ? 5 : 0x80000001;
      r.footprint.falloff = Falloff::smooth, r.footprint.order = 1, r.footprint.logarithmic = bands == 3;
      const auto fill = [&](Coefficients& all) {
        for (int i = 0; i < bands * bands; ++i) all.push_back(random.colour(-2, 2));
      };
      fill(r.jet.value);
      r.jet.value[0] = random.colour(1, 3);
      if (bands > 1) fill(r.jet.translational.x), fill(r.jet.translational.y), fill(r.jet.translational.z);
      r.jet.hessian = {random.number(-1, 1), random.number(-1, 1), random.number(-1, 1),
                       random.number(-1, 1), random.number(-1, 1), random.number(-1, 1)};
      r.jet.value_sum = random.number(0, 2), r.jet.gradient_sum = random.number(0, 2);
      if (bands > 1) r.jet.obstacles.meet(11, random.number(0, 2));
      r.jet.standard_error = random.number(0, 1);
      r.jet.rays = 2048;
      r.jet.distances.harmonic_mean = random.number(0, 2);
    }
    return file;
  }

  std::string bytes() const {
    std::ostringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }
  void put(const std::string& content) const { std::ofstream(path_, std::ios::binary) << content; }
  /// The same with the checksum that belongs to it.
  void put_signed(const std::string& content) const { put(sign_record_file(content)); }
  /// Why the file is refused; empty where it is not.
  std::string refusal() const {
    try {
      read_records(path_);
    } catch (const UserError& error) {
      EXPECT_EQ(std::string(error.what()).find(path_ + ": "), 0u) << error.what();
      return std::string(error.what()).substr(path_.size() + 2);
    }
    return "";
  }

  std::string path_;
};

inline void put_integer(std::string& bytes, std::size_t at, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes[at + i] = static_cast<char>(value >> (8 * i));
}

}  // namespace isophote::test
