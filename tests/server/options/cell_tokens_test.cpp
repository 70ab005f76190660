#include "server/options/cell_tokens.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "server/files/data_files.hpp"
#include "server/options/options.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class CellTokensOfARoster : public testing::Test {
 protected:
  CellTokensOfARoster() {
    std::string name = (fs::temp_directory_path() / "xr3-tokens-XXXXXX").string();
    home_ = ::mkdtemp(name.data());
    options_.roster = (home_ / "class.csv").string();
    options_.is_private = true;
    options_.cell_choices = {CellChoice{"ada", "", "", {}}};
  }
  ~CellTokensOfARoster() override { fs::remove_all(home_); }

  std::string path() const { return options_.roster + ".tokens"; }
  void write(const std::string& text) const {
    std::ofstream(path()) << text;
    fs::permissions(path(), fs::perms::owner_read | fs::perms::owner_write);
  }
  std::vector<CellPlan> assigned(const std::vector<std::string>& names) const {
    std::vector<CellPlan> plans;
    for (const std::string& name : names) plans.push_back({name, "", "", 0});
    assign_tokens(options_, plans);
    return plans;
  }
  std::string refusal() const {
    try {
      assigned({"ada"});
    } catch (const ExitError& error) {
      return error.what();
    }
    return "";
  }

  fs::path home_;
  ServeOptions options_;
};

TEST_F(CellTokensOfARoster, AreMadeOnceAndKept) {
  const auto first = assigned({"ada", "bob"});
  EXPECT_GE(first[0].token.size(), kMinTokenBytes);
  EXPECT_NE(first[0].token, first[1].token);
  EXPECT_EQ(fs::status(path()).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  const auto second = assigned({"eve", "ada"});
  EXPECT_EQ(second[1].token, first[0].token);
  const CellTokens kept = read_cell_tokens(path());
  EXPECT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept.at("bob"), first[1].token) << "bob may come back";
  EXPECT_EQ(fs::status(path()).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(CellTokensOfARoster, WithoutPrivateThereAreNone) {
  options_.is_private = false;
  EXPECT_EQ(assigned({"ada"})[0].token, "");
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(CellTokensOfARoster, WithoutARosterTheyAreNewEachTime) {
  options_.roster.clear();
  EXPECT_NE(assigned({"ada"})[0].token, assigned({"ada"})[0].token);
}

TEST_F(CellTokensOfARoster, ATokenFileIsUsedInstead) {
  const std::string file = (home_ / "ada.token").string();
  std::ofstream(file) << "sixteen letters of ada\n";
  std::vector<CellPlan> plans{{"ada", "", "", 0, file}};
  assign_tokens(options_, plans);
  EXPECT_EQ(plans[0].token, "sixteen letters of ada");
  EXPECT_FALSE(fs::exists(path()));
  plans.push_back({"bob", "", "", 0, file});
  EXPECT_THROW(assign_tokens(options_, plans), TokenError);
}

TEST_F(CellTokensOfARoster, AFileThatOthersMayReadIsRefused) {
  write("{}");
  fs::permissions(path(), fs::perms::others_read, fs::perm_options::add);
  EXPECT_THAT(refusal(), HasSubstr("type: chmod 600 " + path()));
}

TEST_F(CellTokensOfARoster, AnotherFileIsRefusedAndStays) {
  for (const std::string text :
       {"", "[]", "{", R"({"ada":1})", R"({"a b":"sixteen letters of ada"})", R"({"ada":"short"})",
        R"({"ada":"sixteen letters \n of ada"})"}) {
    write(text);
    EXPECT_THAT(refusal(), HasSubstr(path() + ": ")) << text;
    EXPECT_THAT(refusal(), HasSubstr("move it away")) << text;
    EXPECT_EQ(read_file(path()).text, text);
  }
}

}  // namespace
}  // namespace xr3
