#include "isophote/core/atomic_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "isophote/core/error.h"

namespace isophote {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("atomic_file_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const char* name) const { return (folder_ / name).string(); }
  static std::string content(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(AtomicFileTest, HasItsNameOnlyAfterCommit) {
  AtomicFile file(path("a"));
  file.stream() << "one" << '\0' << "two\n";
  file.stream().flush();
  EXPECT_FALSE(fs::exists(path("a")));
  EXPECT_EQ(files(), 1u);  // the temporary is in the same folder, so that renaming never copies
  file.commit();
  EXPECT_EQ(content(path("a")), std::string("one\0two\n", 8));
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, LeavesTheOlderFileAndNoTemporaryOnFailure) {
  std::ofstream(path("a")) << "old";
  EXPECT_THROW(
      {
        AtomicFile file(path("a"));
        file.stream() << "half";
        throw std::runtime_error("interrupted");
      },
      std::runtime_error);
  EXPECT_EQ(content(path("a")), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, ReplacesAnOlderFile) {
  std::ofstream(path("a")) << "something longer than the new text";
  AtomicFile file(path("a"));
  file.stream() << "new";
  file.commit();
  EXPECT_EQ(content(path("a")), "new");
}

TEST_F(AtomicFileTest, ReplacesWhatALinkLeadsToAndKeepsTheLink) {
  fs::create_directory(folder_ / "there");
  std::ofstream(path("there/old")) << "old";
  fs::create_symlink("there/old", path("link"));
  fs::create_symlink("link", path("link to a link"));
  fs::create_symlink(path("there/new"), path("link to what is not there yet"));
  for (const char* name : {"link to a link", "link to what is not there yet"}) {
    AtomicFile file(path(name));
    file.stream() << "new";
    file.commit();
    EXPECT_TRUE(fs::is_symlink(path(name)));
    EXPECT_EQ(content(path(name)), "new");
  }
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("there/old")), "new");
  EXPECT_EQ(content(path("there/new")), "new");
  EXPECT_EQ(files(), 4u);
}

TEST_F(AtomicFileTest, RefusesARingOfLinks) {
  fs::create_symlink("b", path("a"));
  fs::create_symlink("a", path("b"));
  EXPECT_THROW(AtomicFile{path("a")}, UserError);
  EXPECT_EQ(files(), 2u);
}

TEST_F(AtomicFileTest, FailedWritesAreNotCommitted) {
  AtomicFile file(path("a"));
  file.stream() << "x";
  file.stream().setstate(std::ios::badbit);  // as a full disk does
  EXPECT_THROW(file.commit(), UserError);
  EXPECT_FALSE(fs::exists(path("a")));
}

TEST_F(AtomicFileTest, RefusesFoldersAndDevicesAndMissingFolders) {
  for (const std::string& bad : {folder_.string(), std::string("/dev/null"), path("no/such/folder")}) {
    try {
      AtomicFile file(bad);
      ADD_FAILURE() << bad << " was opened";
    } catch (const UserError& error) {
      EXPECT_EQ(std::string(error.what()).find(bad + ": cannot write: "), 0u) << error.what();
    }
  }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace isophote
