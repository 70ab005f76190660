// Lines, comments, duplicates and syntax errors of a data file's text.
#include "protocol/json/source.hpp"

#include <gtest/gtest.h>

#include <string>

namespace xr3 {
namespace {

TEST(JsonSource, FindsTheLineOfEveryValue) {
  const JsonSource source("{\n\"a\": [1,\n2\n,\n{\"b\":\n3}],\n\"c\": \"x\"\n}", "f");
  EXPECT_EQ(source.line_of(""), 1);
  EXPECT_EQ(source.line_of("/a"), 2);
  EXPECT_EQ(source.line_of("/a/0"), 2);
  EXPECT_EQ(source.line_of("/a/1"), 3);
  EXPECT_EQ(source.line_of("/a/2"), 5);
  EXPECT_EQ(source.line_of("/a/2/b"), 5) << "a member is where its name is";
  EXPECT_EQ(source.line_of("/c"), 7);
}

TEST(JsonSource, AMissingMemberHasTheLineOfItsParent) {
  const JsonSource source("{\n\"a\": {\n}\n}", "f");
  EXPECT_EQ(source.line_of("/a/b/c"), 2);
  EXPECT_EQ(source.line_of("/b"), 1);
}

TEST(JsonSource, EscapesPointers) {
  const JsonSource source("{\n\"a/b\": 1,\n\"m~n\": 2}", "f");
  EXPECT_EQ(child_pointer("", "a/b"), "/a~1b");
  EXPECT_EQ(source.line_of("/a~1b"), 2);
  EXPECT_EQ(source.line_of("/m~0n"), 3);
}

TEST(JsonSource, CountsCommentLines) {
  const JsonSource source("* one\n{\n  * two {[\"\n\"a\": 1\n\t*\n}\n* three", "f");
  EXPECT_TRUE(source.root().at("/a").is(1.0));
  EXPECT_EQ(source.line_of("/a"), 4);
}

TEST(JsonSource, KeepsAsterisksInsideLines) {
  const JsonSource source("{\"a\": \"* no comment\",\n\"b\": \"**\"}", "f");
  EXPECT_TRUE(source.root().at("/a").is("* no comment"));
}

TEST(JsonSource, AcceptsWindowsLineEndsAndAByteOrderMark) {
  const JsonSource source("\xEF\xBB\xBF{\r\n* comment\r\n\"a\": 1\r\n}\r\n", "f");
  EXPECT_EQ(source.line_of("/a"), 3);
}

TEST(JsonSource, ReportsDuplicateMembers) {
  const JsonSource source("{\"a\": 1,\n\"b\": {\"a\": 2, \"a\": 3},\n\"a\": 4}", "f");
  std::vector<JsonValue> duplicates;
  source.document().for_each_duplicate([&](JsonValue member) { duplicates.push_back(member); });
  ASSERT_EQ(duplicates.size(), 2U);
  EXPECT_EQ(duplicates[0].pointer_from(source.root()), "/b/a");
  EXPECT_EQ(duplicates[1].pointer_from(source.root()), "/a");
  EXPECT_EQ(source.line_of(duplicates[1]), 3);
}

Finding syntax_error_of(const std::string& text) {
  try {
    const JsonSource source(text, "f");
  } catch (const DataError& error) {
    EXPECT_EQ(error.findings().size(), 1U);
    return error.findings().front();
  }
  ADD_FAILURE() << "no error in " << text;
  return {};
}

struct SyntaxCase {
  std::string text;
  int line;
  int column;
  std::string found;
  std::string allowed;
};

TEST(JsonSource, ReportsSyntaxErrors) {
  const std::string value = "a value: a number, \"text\", true, false, null, [ or {";
  const std::string name = "a member name in double quotes";
  const SyntaxCase cases[] = {
      {"", 1, 1, "the end of the file", value},
      {"{", 1, 2, "the end of the file", name},
      {"{\"a\":1,}", 1, 8, "} after a comma", name},
      {"{\"a\" 1}", 1, 6, "1", "a colon after the member name"},
      {"{\"a\":1\n \"b\":2}", 2, 2, "\"b\"", "a comma or }"},
      {"[1,2", 1, 5, "the end of the file", "a comma or ]"},
      {"{\"a\":[1}", 1, 8, "}", "a comma or ]"},
      {"{'a':1}", 1, 2, "'", name},
      {"{\"a\":tru}", 1, 6, "tru", value},
      {"{\"a\":01}", 1, 7, "01", "a comma or }"},
      {"{\"a\":+1}", 1, 6, "+1", value},
      {"{\xC3\xA4: 1}", 1, 2, "\\xc3", name},
      {"{}x", 1, 3, "x", "nothing after the end of the value"},
      {"{\"a\":1.}", 1, 8, "an unfinished number", "digits"},
      {"{\"a\":-1e999}", 1, 11, "a number that is too large", "numbers up to 1e308"},
      {"{\"a\":\"x\ny\"}", 1, 8, "a line end or control character inside text", "text on one line"},
      {"{\"a\":\"\\q\"}", 1, 8, "an unknown escape after \\", "\\\" \\\\ \\/ \\b"},
      {"{\"a\":\"\xFF\"}", 1, 7, "a byte that is not UTF-8", "text in UTF-8"},
      {"{\"a\":\"b}", 1, 9, "text without its closing quote", "text in double quotes"},
  };
  for (const SyntaxCase& expected : cases) {
    const Finding finding = syntax_error_of(expected.text);
    SCOPED_TRACE(expected.text + " -> " + to_text(finding));
    EXPECT_EQ(finding.line, expected.line);
    EXPECT_EQ(finding.column, expected.column);
    EXPECT_EQ(finding.found, expected.found);
    EXPECT_EQ(finding.allowed.substr(0, expected.allowed.size()), expected.allowed);
  }
}

TEST(JsonSource, QuotesNothingOfATokenForItsMeaning) {
  EXPECT_EQ(syntax_error_of("{\"a\":\"a surrogate number overflow\n\"}").found,
            "a line end or control character inside text");
  EXPECT_EQ(syntax_error_of("{\"a\":" + std::string(100'000, '1') + "}").found,
            "a number that is too large");
  const Finding finding = syntax_error_of("{\"" + std::string(100'000, 'x') + "; expected ']'");
  EXPECT_EQ(finding.found, "text without its closing quote");
  EXPECT_EQ(finding.column, 100'017);
}

TEST(JsonSource, RefusesNulBytes) {
  for (const std::string& after : {std::string(), std::string("x"), std::string("{}")}) {
    const Finding finding = syntax_error_of("{\"a\":\n1}" + std::string(1, '\0') + after);
    EXPECT_EQ(to_text(finding), "f:2:3: found a NUL byte; allowed: JSON in UTF-8");
  }
}

TEST(JsonSource, TellsOfUtf16) {
  const std::string little_endian("{\0}\0", 4);
  const std::string big_endian("\0{\0}", 4);
  for (const std::string& text :
       {little_endian, big_endian, "\xFF\xFE" + little_endian, "\xFE\xFF" + big_endian})
    EXPECT_EQ(to_text(syntax_error_of(text)), "f:1:1: found UTF-16; allowed: UTF-8");
}

TEST(JsonSource, RejectsDeepNesting) {
  const std::string deep(100000, '[');
  EXPECT_EQ(syntax_error_of(deep).found, "lists and objects deeper than 32");
}

TEST(Finding, IsOneLineOfText) {
  Finding finding{Severity::kError, "arm.json", 12, 0, "/joints/3", "-5", "a number above 0"};
  EXPECT_EQ(to_text(finding), "arm.json:12: /joints/3: found -5; allowed: a number above 0");
  finding.severity = Severity::kWarning;
  EXPECT_EQ(to_text(finding),
            "arm.json:12: warning: /joints/3: found -5; allowed: a number above 0");
  finding = {Severity::kError, "arm.json", 12, 7, "", "}", "a comma or ]"};
  EXPECT_EQ(to_text(finding), "arm.json:12:7: found }; allowed: a comma or ]");
}

}  // namespace
}  // namespace xr3
