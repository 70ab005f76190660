// Tokens from a file, from the environment and generated; invalid tokens.
#include "server/options/token.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "server/files/data_files.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;

class TokenTest : public testing::Test {
 protected:
  TokenTest() { ::unsetenv(kTokenVariable); }
  ~TokenTest() override {
    ::unsetenv(kTokenVariable);
    fs::remove(path_);
  }

  std::string read(const std::string& content) {
    std::ofstream(path_) << content;
    return read_token(TokenFile{path_});
  }

  std::string path_ = testing::TempDir() + "xr3-token-" + std::to_string(::getpid());
};

TEST_F(TokenTest, ReadsAFileWithoutItsLastLineEnd) {
  EXPECT_EQ(read("sixteen letters!"), "sixteen letters!");
  EXPECT_EQ(read("sixteen letters!\n"), "sixteen letters!");
  EXPECT_EQ(read("sixteen letters!\r\n"), "sixteen letters!");
}

TEST_F(TokenTest, RejectsInvalidTokensWithoutShowingThem) {
  for (const std::string& wrong :
       {std::string(), std::string("\n"), std::string("fifteen letters"),
        std::string("two lines of\ntext, both long"), std::string(kMaxTokenBytes + 1, 'x')}) {
    try {
      read(wrong);
      ADD_FAILURE() << wrong;
    } catch (const TokenError& error) {
      EXPECT_NE(std::string(error.what()).find(path_), std::string::npos);
      EXPECT_EQ(std::string(error.what()).find("letters"), std::string::npos);
    }
  }
  EXPECT_THROW(read_token(TokenFile{path_ + ".missing"}), FileError);
}

TEST_F(TokenTest, ReadsTheEnvironment) {
  ::setenv(kTokenVariable, "of the environment", 1);
  EXPECT_EQ(read_token(TokenInEnvironment{}), "of the environment");
  ::setenv(kTokenVariable, "", 1);
  EXPECT_THROW(read_token(TokenInEnvironment{}), TokenError);
}

TEST_F(TokenTest, AGeneratedTokenIsLongAndUrlSafe) {
  const std::string token = read_token(FreshToken{});
  EXPECT_EQ(token.size(), 32U);
  EXPECT_EQ(token.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                    "0123456789-_"),
            std::string::npos);
  EXPECT_NE(token, read_token(FreshToken{}));
  EXPECT_EQ(read_token(NoToken{}), "");
}

TEST_F(TokenTest, ChecksThePermissionsOfTheFile) {
  read("sixteen letters!");
  fs::permissions(path_, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_FALSE(others_may_read(path_));
  fs::permissions(path_, fs::perms::others_read, fs::perm_options::add);
  EXPECT_TRUE(others_may_read(path_));
  EXPECT_FALSE(others_may_read(path_ + ".missing"));
}

}  // namespace
}  // namespace xr3
