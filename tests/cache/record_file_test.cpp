#include "isophote/cache/record_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "isophote/core/error.h"
#include "isophote/core/ray.h"
#include "support/records.h"
#include "support/sign_record_file.h"

namespace isophote::test {
namespace {

namespace fs = std::filesystem;

/// Where things lie in a file: magic, version, scene, length of the settings, settings, survey, count, records,
/// checksum.
constexpr std::size_t settings_at = 24, survey_bytes = 13, record_bytes = 230;

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
    RecordFile file{0x0123456789abcdefull, "method=bounded\na=0.2\nseed=7\n", {true, 0.5f, 2, 3}, {}};
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
      r.jet.distances.harmonic_mean = i % 2 ? infinity : 2;
      for (int s = i % 3; s < Obstacles::sectors; s += 3) r.jet.distances.obstacles.meet(s, random.number(0, 9));
      file.records.push_back(r);
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

void put_integer(std::string& bytes, std::size_t at, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes[at + i] = static_cast<char>(value >> (8 * i));
}

TEST_F(RecordFileTest, RoundTripKeepsEveryBit) {
  for (const int count : {0, 1, 50}) {
    const RecordFile file = sample(count);
    write_records(path_, file);
    const RecordFile back = read_records(path_);
    EXPECT_EQ(back.scene, file.scene);
    EXPECT_EQ(back.settings, file.settings);
    EXPECT_EQ(back.pilot, file.pilot);
    ASSERT_EQ(back.records.size(), file.records.size());
    for (std::size_t i = 0; i < file.records.size(); ++i) {
      const Record &a = file.records[i], &b = back.records[i];
      EXPECT_EQ(a.position, b.position);
      EXPECT_EQ(a.normal, b.normal);
      EXPECT_EQ(a.footprint.shape, b.footprint.shape);
      EXPECT_EQ(a.footprint.normal_scale, b.footprint.normal_scale);
      EXPECT_EQ(a.footprint.radius, b.footprint.radius);
      EXPECT_EQ(a.footprint.unscaled, b.footprint.unscaled);
      EXPECT_EQ(a.footprint.smallest, b.footprint.smallest);
      EXPECT_EQ(a.footprint.largest, b.footprint.largest);
      EXPECT_EQ(a.footprint.falloff, b.footprint.falloff);
      EXPECT_EQ(a.footprint.order, b.footprint.order);
      EXPECT_EQ(a.gradient_scale, b.gradient_scale);
      EXPECT_EQ(a.curvature_scale, b.curvature_scale);
      EXPECT_EQ(a.jet.hessian, b.jet.hessian);
      EXPECT_EQ(a.jet.value, b.jet.value);
      EXPECT_EQ(a.jet.standard_error, b.jet.standard_error);
      EXPECT_EQ(a.jet.rays, b.jet.rays);
      EXPECT_EQ(a.jet.translational, b.jet.translational);
      EXPECT_EQ(a.jet.rotational, b.jet.rotational);
      EXPECT_EQ(a.jet.distances.harmonic_mean, b.jet.distances.harmonic_mean);
      EXPECT_EQ(a.jet.distances.obstacles, b.jet.distances.obstacles);
    }
    const std::string first = bytes();
    EXPECT_EQ(first.size(),
              settings_at + file.settings.size() + survey_bytes + 16 + record_bytes * static_cast<std::size_t>(count));
    write_records(path_, back);
    EXPECT_EQ(bytes(), first);
  }
}

TEST_F(RecordFileTest, IsLittleEndianAndVersioned) {
  write_records(path_, sample(1));
  const std::string content = bytes();
  EXPECT_EQ(content.substr(0, 12), std::string("ISOPHREC\3\0\0\0", 12));
  EXPECT_EQ(static_cast<unsigned char>(content[12]), 0xef);  // the scene's lowest byte
  std::string later = content;
  put_integer(later, 8, 4, 4);
  put_signed(later);
  EXPECT_EQ(refusal(), "has version 4, this program reads 3");
}

TEST_F(RecordFileTest, EveryFlippedByteIsRefused) {
  write_records(path_, sample(1));
  const std::string whole = bytes();
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const int flip : {0x01, 0x80}) {
      std::string harmed = whole;
      harmed[i] = static_cast<char>(harmed[i] ^ flip);
      put(harmed);
      EXPECT_NE(refusal(), "") << "byte " << i;
    }
}

TEST_F(RecordFileTest, EveryTruncationAndAnExtensionIsRefused) {
  write_records(path_, sample(2));
  const std::string whole = bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    put(whole.substr(0, size));
    EXPECT_NE(refusal(), "") << size << " bytes";
  }
  put(whole + '\0');
  EXPECT_NE(refusal(), "");
}

TEST_F(RecordFileTest, WrongLengthsWithARightChecksumAreRefused) {
  const RecordFile file = sample(3);
  write_records(path_, file);
  const std::string whole = bytes();
  const std::size_t count_at = settings_at + file.settings.size() + survey_bytes;
  for (const std::uint64_t count :
       {0ull, 2ull, 4ull, 1ull << 32, 0xffffffffffffffffull, 0xffffffffffffffffull / record_bytes + 4}) {
    std::string crafted = whole;
    put_integer(crafted, count_at, count, 8);
    put_signed(crafted);
    EXPECT_NE(refusal().find("malformed"), std::string::npos) << count;
  }
  for (const std::uint64_t length : {std::uint64_t{0}, file.settings.size() - 1, file.settings.size() + 1,
                                     whole.size() - 39, whole.size(), std::uint64_t{0xffffffff}}) {
    std::string crafted = whole;
    put_integer(crafted, settings_at - 4, length, 4);
    put_signed(crafted);
    EXPECT_NE(refusal().find("malformed"), std::string::npos) << length;
  }
}

TEST_F(RecordFileTest, ASurveyOfNonsenseIsRefused) {
  const RecordFile file = sample(1);
  write_records(path_, file);
  const std::string whole = bytes();
  const std::size_t survey_at = settings_at + file.settings.size();
  for (const unsigned known : {2u, 0x80u, 0xffu}) {
    std::string crafted = whole;
    put_integer(crafted, survey_at, known, 1);
    put_signed(crafted);
    EXPECT_NE(refusal().find("survey"), std::string::npos) << known;
  }
  std::string negative = whole;
  negative[survey_at + 4] |= '\x80';
  put_signed(negative);
  EXPECT_NE(refusal().find("survey"), std::string::npos);
}

// Whoever signs a file of nonsense still does not get it into a lookup.
TEST_F(RecordFileTest, UnusableRecordsWithARightChecksumAreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::function<void(Record&)>> harms = {
      [&](Record& r) { r.position.y = nan; },
      [&](Record& r) {
        r.normal = {0, 0, 2};
      },
      [&](Record& r) {
        r.normal = {0, 0, 0};
      },
      [&](Record& r) { r.footprint.shape.xx = -1; },
      [&](Record& r) { r.footprint.shape.zz = infinity; },
      [&](Record& r) { r.footprint.shape.xy = nan; },
      [&](Record& r) { r.footprint.shape.xy = r.footprint.shape.xx; },  // a positive diagonal, but a saddle
      [&](Record& r) { r.footprint.shape.yz = 2 * r.footprint.shape.zz; },
      [&](Record& r) { r.footprint.shape.zz *= 0.99f; },  // reaches beyond the radius
      [&](Record& r) { r.footprint.radius *= 0.99f; },
      [&](Record& r) { r.footprint.normal_scale = nan; },
      [&](Record& r) { r.footprint.normal_scale = -1; },
      [&](Record& r) { r.footprint.radius = 0; },
      [&](Record& r) { r.footprint.radius = infinity; },
      [&](Record& r) { r.footprint.unscaled = nan; },
      [&](Record& r) { r.footprint.smallest = r.footprint.radius * 2; },
      [&](Record& r) { r.footprint.largest = r.footprint.radius / 2; },
      [&](Record& r) { r.footprint.largest = nan; },
      [&](Record& r) { r.footprint.falloff = static_cast<Falloff>(3); },
      [&](Record& r) { r.footprint.order = 3; },
      [&](Record& r) { r.curvature_scale = -1; },
      [&](Record& r) { r.jet.hessian.xy = nan; },
      [&](Record& r) { r.curvature_scale = 1, r.jet.hessian.xx = 3e38f; },
      [&](Record& r) { r.gradient_scale = nan; },
      [&](Record& r) { r.gradient_scale = 1.5f; },
      [&](Record& r) { r.jet.value.g = infinity; },
      [&](Record& r) { r.jet.value.g = nan; },
      [&](Record& r) { r.jet.value.b = -1e-3f; },
      [&](Record& r) { r.jet.value.r = 3e38f; },
      [&](Record& r) { r.jet.translational.z.b = nan; },
      [&](Record& r) { r.jet.translational.y.g = -2e30f / r.footprint.radius; },
      [&](Record& r) { r.jet.rotational.x.r = nan; },
      [&](Record& r) { r.jet.rotational.z.b = 3e38f; },
      [&](Record& r) { r.jet.distances.harmonic_mean = nan; },
      [&](Record& r) { r.jet.distances.obstacles.nearest[5] = 0x8001; },  // negative
      [&](Record& r) { r.jet.distances.obstacles.nearest[15] = 0x7fc0; },
  };
  for (std::size_t i = 0; i < harms.size(); ++i) {
    RecordFile file = sample(3);
    harms[i](file.records[1]);
    write_records(path_, file);
    EXPECT_EQ(refusal(), "record 1 is malformed") << "harm " << i;
  }
}

TEST_F(RecordFileTest, WhatIsNoRecordFile) {
  EXPECT_EQ(refusal(), "cannot be opened");
  for (const std::string& content :
       {std::string(), std::string("ISOPHRE"), std::string("\x89PNG\r\n\x1a\n and more")}) {
    put(content);
    EXPECT_EQ(refusal(), "is not a record file");
  }
  fs::remove(path_);
  fs::create_directory(path_);
  EXPECT_EQ(refusal(), "is not a regular file");
  EXPECT_THROW(write_records(path_, sample(1)), UserError);
}

// Neither what never ends is read to its end, nor is a count believed before there are records to it.
TEST_F(RecordFileTest, HugeFilesAreRefusedAtOnce) {
  path_ = "/dev/zero";
  EXPECT_EQ(refusal(), "is not a regular file");
  SetUp();
  write_records(path_, sample(1));
  const std::string head = bytes().substr(0, settings_at);
  for (const std::size_t start : {std::size_t{0}, settings_at}) {  // the rest is a hole, which takes no disk
    put(head.substr(0, start));
    fs::resize_file(path_, 1ull << 40);
    EXPECT_NE(refusal(), "") << start;
  }
  std::string counting = head;
  put_integer(counting, settings_at - 4, 0, 4);
  const std::uint64_t count = (1ull << 40) / record_bytes;
  counting.resize(settings_at + survey_bytes + 8);
  put_integer(counting, settings_at + survey_bytes, count, 8);
  put(counting);
  fs::resize_file(path_, settings_at + survey_bytes + 16 + record_bytes * count);
  EXPECT_EQ(refusal(), "record 0 is malformed");
}

// A footprint may be flatter than its radius along any axis.
TEST_F(RecordFileTest, FlatFootprintsAreKept) {
  RecordFile file = sample(1);
  Footprint& f = file.records[0].footprint;
  const Vec3 axis = normalize(Vec3{1, 2, -2});
  for (const float height : {1.0f, 0.5f, 0.1f, 0.01f}) {
    const float base = 1 / (f.radius * f.radius), more = base / (height * height) - base;
    f.shape = {base + more * axis.x * axis.x, more * axis.x * axis.y, more * axis.x * axis.z,
               base + more * axis.y * axis.y, more * axis.y * axis.z, base + more * axis.z * axis.z};
    write_records(path_, file);
    EXPECT_EQ(refusal(), "") << height;
  }
}

TEST_F(RecordFileTest, MismatchesNameTheReason) {
  const RecordFile file = sample(1);
  const auto reason = [&](std::uint64_t scene, const std::string& settings) -> std::string {
    try {
      require_match("x.rec", file, scene, settings);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(reason(file.scene, file.settings), "");
  EXPECT_EQ(reason(file.scene + 1, file.settings), "x.rec: its records were made for another scene");
  EXPECT_EQ(reason(file.scene, "method=bounded\na=0.3\nseed=8\n"),
            "x.rec: its records were made with other settings: a=0.2 there, a=0.3 here");
  EXPECT_EQ(reason(file.scene, "method=bounded\na=0.2\n"),
            "x.rec: its records were made with other settings: seed=7 there, nothing here");
  EXPECT_EQ(reason(file.scene, file.settings + "rays=800\n"),
            "x.rec: its records were made with other settings: nothing there, rays=800 here");
}

}  // namespace
}  // namespace isophote::test
