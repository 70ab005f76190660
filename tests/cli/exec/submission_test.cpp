#include "cli/exec/submission.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "cli/exec/run_folder.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

class SubmissionTest : public testing::Test {
 protected:
  fs::path write(const std::string& name) {
    const fs::path path = folder_.file(name.c_str());
    fs::create_directories(path.parent_path());
    std::ofstream(path) << "print()\n";
    return path;
  }

  RunFolder folder_{std::nullopt};
};

TEST_F(SubmissionTest, AFileIsRunItself) {
  const fs::path file = write("ada.py");
  EXPECT_EQ(main_of(file, "main.py"), file);
  EXPECT_EQ(main_of(file, ""), file);
}

TEST_F(SubmissionTest, OfAFolderTheNamedFileIsRun) {
  const fs::path main = write("ada/main.py");
  write("ada/other.py");
  EXPECT_EQ(main_of(main.parent_path(), "main.py"), main);
  EXPECT_EQ(main_of(main.parent_path(), ""), main.parent_path());
}

TEST_F(SubmissionTest, WithoutTheNamedFileTheOnlyOneOfItsKindIsRun) {
  const fs::path pick = write("ada/pick.py");
  write("ada/notes.txt");
  EXPECT_EQ(main_of(pick.parent_path(), "main.py"), pick);
  write("ada/place.py");
  EXPECT_EQ(main_of(pick.parent_path(), "main.py"), std::nullopt);
  EXPECT_EQ(main_of(write("bob/notes.txt").parent_path(), "main.py"), std::nullopt);
}

TEST_F(SubmissionTest, AFolderInTheFolderIsNoFile) {
  const fs::path folder = write("ada/main.py/x.py").parent_path().parent_path();
  EXPECT_EQ(main_of(folder, "main.py"), std::nullopt);
}

TEST_F(SubmissionTest, TheTextOfItsFilesDiffersIfOneWasChangedAddedOrRemoved) {
  const fs::path main = write("ada/main.py");
  const fs::path ada = main.parent_path();
  const std::string first = files_of(ada);
  EXPECT_TRUE(first.ends_with(" 8 main.py\n")) << first;
  write("ada/.git/index");
  write("ada/__pycache__/main.pyc");
  EXPECT_EQ(files_of(ada), first);
  const fs::path other = write("ada/parts/other.py");
  EXPECT_TRUE(files_of(ada).ends_with(" 8 parts/other.py\n"));
  fs::remove(other);
  EXPECT_EQ(files_of(ada), first);
  std::ofstream(main) << "PRINT()\n";
  EXPECT_NE(files_of(ada), first);
}

TEST_F(SubmissionTest, OfALargeFileSizeAndTimeCount) {
  const fs::path file = write("ada.bin");
  fs::resize_file(file, std::size_t{16} << 20U);
  const std::string hashed = files_of(file);
  EXPECT_EQ(hashed.find(' '), 64U) << hashed;
  fs::resize_file(file, (std::size_t{16} << 20U) + 1);
  EXPECT_NE(files_of(file).find(' '), 64U);
}

TEST_F(SubmissionTest, OfARefusedSubmissionTheReasonCounts) {
  const fs::path link = folder_.file("ada.py");
  fs::create_symlink("/etc/passwd", link);
  EXPECT_EQ(files_of(link), why_refused(link) + "\n");
}

}  // namespace
}  // namespace xr3
