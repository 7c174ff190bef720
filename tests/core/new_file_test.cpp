// Files that come into their place in one step.
#include "core/new_file.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;

class NewFiles : public ::testing::Test {
 protected:
  NewFiles() { fs::create_directories(folder_); }
  ~NewFiles() override { fs::remove_all(folder_); }

  std::string text() const {
    std::ifstream stream(file_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const std::string folder_ = ::testing::TempDir() + "vindu-new-" + std::to_string(::getpid());
  const std::string file_ = folder_ + "/a.txt";
};

TEST_F(NewFiles, AreNotThereBeforeTheyAreWhole) {
  std::ofstream(file_) << "old";
  NewFile fresh(file_);
  fresh.write("new", "");
  EXPECT_EQ(text(), "old");
  fresh.place("");
  EXPECT_EQ(text(), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(NewFiles, ThatAreGivenUpLeaveNothing) {
  { NewFile(file_).write("half", ""); }
  EXPECT_EQ(files(), 0u);
}

TEST_F(NewFiles, SayWhatToDoWhereTheyCannotBeWritten) {
  const auto said = [](const std::string& file) -> std::string {
    try {
      NewFile fresh(file);
      fresh.write("x", "choose another --out");
      fresh.place("choose another --out");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(said(folder_ + "/nowhere/a.txt"), ::testing::HasSubstr("choose another --out"));
  fs::create_directory(file_);
  EXPECT_THAT(said(file_), ::testing::HasSubstr("choose another --out"));
  EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace vindu
