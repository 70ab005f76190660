// JsonDocument and JsonValue, compared with nlohmann-json; and Reading.
#include "protocol/json/document.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/codec.hpp"
#include "protocol/json/syntax.hpp"

namespace xr3 {
namespace {

const std::vector<std::string>& texts() {
  static const std::vector<std::string> all = {
      "{}",
      "[]",
      " [ 1 , -2.5 , 1e3 , 0 , -0 , -0.0 , 18446744073709551615 , 123456789012345678901234567890 "
      "] ",
      "[1e-400, -1e-400, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308]",
      R"({"a":{},"b":[],"c":[[],{}],"":null,"t":true,"f":false,"s":""})",
      R"({"e":"\"\\\/\b\f\n\r\t","u":"\u00e9\u20AC\ud83d\ude00\u0000\u001f\u007f","é":"é€😀"})",
      R"({"\u0061":1,"a\/b":{"m~n":[{"x":[0,1,{"y":"z"}]}]}})",
      "\xEF\xBB\xBF{\"a\":\r\n[true,\n\tfalse]\n}\n",
      "\"text\"",
      "17",
  };
  return all;
}

void expect_same(JsonValue value, const Json& json) {
  EXPECT_EQ(value.is_object(), json.is_object());
  EXPECT_EQ(value.is_list(), json.is_array());
  EXPECT_EQ(value.is_text(), json.is_string());
  EXPECT_EQ(value.is_number(), json.is_number());
  EXPECT_EQ(value.is_boolean(), json.is_boolean());
  EXPECT_EQ(value.is_null(), json.is_null());
  EXPECT_EQ(value.json_size(), json.dump().size()) << json;
  EXPECT_EQ(value.to_json(), json);
  EXPECT_EQ(value.to_json().dump(), json.dump());
  if (json.is_boolean()) EXPECT_EQ(value.is_true(), json.get<bool>());
  if (json.is_number()) EXPECT_EQ(value.number(), json.get<double>()) << json;
  if (json.is_string()) {
    const auto& text = json.get_ref<const std::string&>();
    EXPECT_EQ(value.text(), text);
    EXPECT_EQ(value.text_size(), text.size());
    EXPECT_TRUE(value.is(text));
    EXPECT_FALSE(value.is(text + "x"));
    EXPECT_FALSE(value.is("x" + text));
  }
  if (!json.is_structured()) return;
  ASSERT_EQ(value.size(), json.size());
  std::size_t index = 0;
  for (const auto& [name, inner] : json.items()) {
    const JsonValue found = json.is_object() ? value.find(name) : value.element(index);
    ++index;
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(static_cast<bool>(found.name()), json.is_object());
    if (json.is_object()) EXPECT_EQ(found.name().text(), name);
    expect_same(found, inner);
  }
  EXPECT_FALSE(value.element(json.size()));
  EXPECT_FALSE(value.find("no such member"));
}

TEST(JsonDocument, HasTheValuesOfTheText) {
  for (const std::string& text : texts()) {
    SCOPED_TRACE(text);
    const JsonDocument document(text);
    ASSERT_EQ(document.fault(), JsonDocument::SyntaxFault::kNone);
    expect_same(document.root(), Json::parse(text));
  }
}

void expect_pointers(JsonValue root, JsonValue value, const std::string& pointer) {
  EXPECT_EQ(value.pointer_from(root), pointer);
  EXPECT_EQ(root.at(pointer), value) << pointer;
  EXPECT_EQ(root.nearest(pointer + "/there/is/none"), value) << pointer;
  if (!value.is_structured()) return;
  std::size_t index = 0;
  for (const JsonValue inner : value) {
    const JsonValue name = inner.name();
    expect_pointers(root, inner,
                    name ? child_pointer(pointer, name.text()) : child_pointer(pointer, index++));
  }
}

TEST(JsonDocument, FindsPointersInBothDirections) {
  for (const std::string& text : texts()) {
    const JsonDocument document(text);
    expect_pointers(document.root(), document.root(), "");
  }
  const JsonDocument document(R"({"a":[0,{"b":[1,2]}]})");
  const JsonValue inner = document.root().at("/a/1");
  EXPECT_EQ(inner.at("/b/1").pointer_from(inner), "/b/1");
  for (const char* pointer : {"/b", "/a/2", "/a/x", "/a/1x", "/a/-1", "/a/1/b/0/0"})
    EXPECT_FALSE(document.root().at(pointer)) << pointer;
}

TEST(JsonDocument, TruncatesLongPointers) {
  const std::string text = "{\"" + std::string(100'000, 'n') + "\":[[1]]}";
  const JsonDocument document(text);
  const JsonValue inner = document.root().element(0).element(0).element(0);
  EXPECT_TRUE(inner.is(1));
  EXPECT_EQ(inner.pointer_from(document.root()), "/" + std::string(256, 'n'));
}

/// The text with one to three random insertions, deletions or replacements.
std::string mutated(std::string text, std::minstd_rand& random) {
  constexpr std::string_view kBytes = "{}[]\",:\\ue0129-+.tfn \n\x01\x7F\xC3\xA9\xED\xA0\xF0\xFF";
  for (std::size_t i = random() % 3 + 1; i > 0; --i) {
    const std::size_t at = random() % (text.size() + 1);
    const std::size_t replaced = random() % 2;
    text.replace(at, std::min(replaced, text.size() - at), random() % 3,
                 kBytes[random() % kBytes.size()]);
  }
  return text;
}

TEST(JsonDocument, AcceptsTheSameTextsAsTheParser) {
  std::minstd_rand random(1);
  int good = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string text = mutated(texts()[random() % texts().size()], random);
    const JsonDocument document(text);
    const bool is_good = document.fault() == JsonDocument::SyntaxFault::kNone;
    ASSERT_EQ(is_good, Json::accept(text)) << text;
    if (!is_good) {
      const Finding finding = fault_finding(document, "f");
      ASSERT_FALSE(finding.found.empty() || finding.allowed.empty()) << text;
      continue;
    }
    ++good;
    ASSERT_EQ(document.root().to_json(), Json::parse(text)) << text;
  }
  EXPECT_GT(good, 1000);
}

std::vector<std::string> twice(const std::string& text) {
  const JsonDocument document(text);
  std::vector<std::string> pointers;
  document.for_each_duplicate(
      [&](JsonValue member) { pointers.push_back(member.pointer_from(document.root())); });
  return pointers;
}

TEST(JsonDocument, FindsDuplicateNames) {
  using Pointers = std::vector<std::string>;
  EXPECT_EQ(twice(R"({"a":1,"b":2,"ab":3,"":4})"), Pointers{});
  EXPECT_EQ(twice(R"({"b":{"a":2,"a":3},"a":1,"c":0,"a":4,"a":5})"),
            (Pointers{"/b/a", "/a", "/a"}));
  EXPECT_EQ(twice(R"({"é":1,"\u00e9":2,"x\ny":1,"\u0078\u000ay":2})"), (Pointers{"/é", "/x\ny"}));
  EXPECT_EQ(twice(R"([{"":1},{"":1,"":2}])"), Pointers{"/1/"});
}

TEST(JsonDocument, TheLastDuplicateApplies) {
  const JsonDocument document(R"({"a":1,"a":2})");
  EXPECT_TRUE(document.root().find("a").is(2));
}

TEST(JsonDocument, AnEmptyValueHasNoKind) {
  const JsonValue nothing;
  EXPECT_FALSE(nothing.is_object() || nothing.is_list() || nothing.is_text() || nothing.is_null() ||
               nothing.is_boolean() || nothing.is_number() || nothing.is("") || nothing.is(0) ||
               nothing.find("a") || nothing.name());
}

TEST(JsonDocument, TruncatesTextBetweenCharacters) {
  const JsonDocument document(R"(["ééé","\u00e9\u00e9\u00e9","abc"])");
  const JsonValue root = document.root();
  EXPECT_EQ(root.element(0).text(3), "éé");
  EXPECT_EQ(root.element(1).text(3), "éé");
  EXPECT_EQ(root.element(2).text(2), "ab");
}

TEST(JsonDocument, StopsCountingAtTheLimit) {
  const JsonDocument document(R"([["0123456789","0123456789"],1])");
  EXPECT_GT(document.root().json_size(5), 5U);
  EXPECT_EQ(document.root().json_size(), 31U);
}

TEST(JsonDocument, ReportsErrors) {
  const JsonDocument broken("{\"a\":}");
  EXPECT_EQ(broken.fault(), JsonDocument::SyntaxFault::kSyntax);
  EXPECT_EQ(broken.complaint().position, 6U);
  EXPECT_FALSE(broken.root());
  const std::string lists = "{\"a\":" + std::string(40, '[');
  const JsonDocument deep(lists);
  EXPECT_EQ(deep.fault(), JsonDocument::SyntaxFault::kTooDeep);
}

// --- Reading.

TEST(Reading, KeepsTheFirstErrorsAndCountsTheRest) {
  std::string text = R"({"length_unit":"mm")";
  for (int i = 0; i < 250; ++i) text += ",\n\"x" + std::to_string(i) + "\":0";
  const JsonSource source(text + "}", "f");
  data::Reading reading(source);
  struct Nothing {};
  Nothing nothing;
  const data::Members<Nothing> members = {data::length_unit_member<Nothing>()};
  EXPECT_TRUE(data::read_object({reading, source.root()}, members, nothing));
  EXPECT_EQ(reading.errors(), 250U) << "unknown members";
  EXPECT_FALSE(reading.is_sound("/length_unit")) << "not checked in large documents";
  const Findings findings = reading.take_findings();
  ASSERT_EQ(findings.size(), 101U);
  EXPECT_EQ(findings[99].line, 101);
  EXPECT_EQ(findings[99].pointer, "/x99");
  EXPECT_EQ(to_text(findings[100]), "f:101: and 150 more like these");
  EXPECT_TRUE(has_errors({findings[100]}));
}

TEST(Reading, TruncatesLongNames) {
  const std::string name(100'000, 'n');
  const JsonSource source(
      "{\"length_unit\":\"mm\",\"" + name + "\":{\"a\":1,\"a\":2},\"" + name + "\":0}", "f");
  const Findings findings = data::Reading(source).take_findings();
  ASSERT_EQ(findings.size(), 2U);
  for (const Finding& finding : findings) {
    EXPECT_LT(finding.pointer.size(), 300U);
    EXPECT_LT(finding.found.size(), 300U);
  }
}

}  // namespace
}  // namespace xr3
