#include "server/options/roster.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace xr3 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// `ada rhino-xr3/flat 9800` for each cell.
std::vector<std::string> cells_of(std::string_view text) {
  const auto reading = read_roster(text, "class");
  EXPECT_EQ(to_text(reading.findings), "") << text;
  std::vector<std::string> cells;
  for (const CellChoice& each : reading.value.value_or(std::vector<CellChoice>{}))
    cells.push_back(each.name + " " + each.robot + "/" + each.workcell +
                    (each.port ? " " + std::to_string(*each.port) : ""));
  return cells;
}

std::string findings_of(std::string_view text) {
  const auto reading = read_roster(text, "class");
  EXPECT_FALSE(reading.value) << text;
  return to_text(reading.findings);
}

TEST(Roster, IsATableWithAHeader) {
  EXPECT_THAT(cells_of("name\nada\nbob"), ElementsAre("ada /", "bob /"));
  EXPECT_THAT(cells_of("port,name,workcell,robot\n9800,ada,flat,rhino-xr3\n,bob,,\n,eve\n"),
              ElementsAre("ada rhino-xr3/flat 9800", "bob /", "eve /"));
}

TEST(Roster, IsReadAsSpreadsheetsWriteIt) {
  EXPECT_THAT(cells_of("name;robot\r\nada;\r\n\"bob\";\"a \"\"b\"\";c\"\r\n;\r\n\r\n"),
              ElementsAre("ada /", "bob a \"b\";c/"));
  EXPECT_THAT(cells_of("name\trobot\nada\t\nbob\tx\n"), ElementsAre("ada /", "bob x/"));
  EXPECT_THAT(cells_of(" name , robot \n ada , \"x\" \n"), ElementsAre("ada x/"));
}

TEST(Roster, IsAListOfObjects) {
  EXPECT_THAT(
      cells_of("\n[{\"name\":\"ada\"},\n {\"name\":\"bob\",\"robot\":\"r\",\"workcell\":\"w\","
               "\"port\":0}]"),
      ElementsAre("ada /", "bob r/w 0"));
}

TEST(Roster, CellsHaveTheirLineAndTokenFile) {
  const auto table = read_roster("name,token_file\n\nada,a.token\n", "class.csv").value;
  ASSERT_TRUE(table);
  EXPECT_EQ(table->front().source, "class.csv:3");
  EXPECT_EQ(table->front().token_file, "a.token");
  const auto list = read_roster("[\n{\"name\":\"ada\"}]", "class.json").value;
  ASSERT_TRUE(list);
  EXPECT_EQ(list->front().source, "class.json:2");
}

TEST(Roster, ErrorsHaveTheirLine) {
  EXPECT_THAT(findings_of(""), HasSubstr("class:1: found nothing; allowed: a header"));
  EXPECT_THAT(findings_of("name\n"), HasSubstr("class:1: found no row"));
  EXPECT_THAT(findings_of("name,mail\nada,x\n"), HasSubstr("class:1: found the column \"mail\""));
  EXPECT_THAT(findings_of("name,name\n"), HasSubstr("twice the column \"name\""));
  EXPECT_THAT(findings_of("robot\nx\n"), HasSubstr("no column \"name\""));
  EXPECT_THAT(findings_of("name\nAda L\n"), HasSubstr("class:2: found the name \"Ada L\""));
  EXPECT_THAT(findings_of("name,robot\n,x\n"), HasSubstr("class:2: found no name"));
  EXPECT_THAT(findings_of("name\nada\nbob\nada\n"),
              HasSubstr("class:4: found the name \"ada\" of line 2"));
  EXPECT_THAT(findings_of("name,port\nada,65536\n"),
              HasSubstr("class:2: found the port \"65536\""));
  EXPECT_THAT(findings_of("name\nada,x\n"),
              HasSubstr("class:2: found the field \"x\" after the last"));
  EXPECT_THAT(findings_of("name\n\"ada\n"), HasSubstr("class:2: found a quote that is not closed"));
  EXPECT_THAT(findings_of("name\n\"a\"da\n"), HasSubstr("after a quote"));
  EXPECT_THAT(findings_of("[{\"name\":\"ada\",\"mail\":1}]"), HasSubstr("unknown member"));
  EXPECT_THAT(findings_of("{\"name\":\"ada\"}"), HasSubstr("a list"));
  EXPECT_THAT(findings_of("[{\"name\":\"ada\",\"port\":\"1\"}]"), HasSubstr("/0/port"));
  EXPECT_THAT(findings_of("[{\"name\":"), HasSubstr("class:1"));
  EXPECT_THAT(findings_of("name\nA B\nC D\n"), HasSubstr("class:3"));
}

}  // namespace
}  // namespace xr3
