#include "planner/base/json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "planner/base/error.h"

namespace regrasp {
namespace json_test {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct BadJson {
  std::string text;
  std::string words;  ///< required in the message
};

TEST(ParseJson, RefusesWhatIsNotStrictJson) {
  const std::vector<BadJson> cases = {
      {"", "not valid JSON"},
      {" \n", "not valid JSON"},
      {R"({"a": 1, "a": 2})", "key \"a\": repeated"},
      {R"({"a": 1, "\u0061": 2})", "key \"a\": repeated"},
      {R"([{"x": {"b": 1, "c": [], "b": 3}}])", "key \"b\": repeated"},
      {R"({"a\nb": 1, "a\nb": 2})", R"(key "a\nb": repeated)"},
      {R"({"a": 1} x)", "not valid JSON"},
      {R"({"a": 1}{"a": 1})", "not valid JSON"},
      {R"({"a": 1)", ": line 1, column 8: not valid JSON, expected ',' or '}', found end of input"},
      {R"({"a": 1,})", "expected a string, found '}'"},
      {R"({a: 1})", ": line 1, column 2: not valid JSON, expected a string"},
      {"# x", "bad.json: line 1, column 1: not valid JSON, expected a value"},
      {"[1e999]", "bad.json: line 1, column 2: number too large, found 1e999"},
      {"[-1e999]", "bad.json: line 1, column 2: number too large, found -1e999"},
      {"{\"1e999 \\\" 1e999\": [1e9,\n\n  11e999, 1e999]}",
       "bad.json: line 3, column 3: number too large, found 11e999"},
      {"[1" + std::string(400, '0') + "]",
       "number too large, found 1" + std::string(59, '0') + "..."},
      {"[NaN]", "not valid JSON"},
      {"[nan]", "not valid JSON"},
      {"[Infinity]", "not valid JSON"},
      {"[-inf]", "not valid JSON"},
      {"[01]", "expected ',' or ']', found a number"},
      {"[0x10]", "not valid JSON"},
      {"[1,5", "not valid JSON"},
      {"[1] // comment", "not valid JSON, expected end of input"},
      {"\"\xff\xfe\"", "ill-formed UTF-8"},
      {"\"\xc3\"", "ill-formed UTF-8"},
      {"{\"\xed\xa0\x80\": 1}", "ill-formed UTF-8"},
      {"\"line\nbreak\"", "not valid JSON"},
      {std::string("[1]\0", 4), "a NUL byte"},
      {std::string("[1]\0{", 5), "a NUL byte"},
      {"[\x7f]", "not valid JSON"},
      {"{\"\x7f\": 1, \"\x7f\": 2}", ": repeated"},
      {"{\"\xc2\x9b\": 1, \"\xc2\x9b\": 2}", ": repeated"},
      {"\xEF\xBB\xBF", "not valid JSON"},
      {"\xEF\xBB", "not valid JSON"},
  };
  for (const auto& [text, words] : cases) {
    try {
      const Json json = ParseJson(text, "bad.json");
      ADD_FAILURE() << text << " was read as " << json;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith("bad.json: "));
      EXPECT_THAT(error.what(), HasSubstr(words)) << text;
      EXPECT_THAT(error.what(), Not(HasSubstr("json.exception")));
      EXPECT_THAT(error.what(), Not(HasSubstr("last read")));
      for (const char* c = error.what(); *c != 0; ++c) {
        // One line without terminal control characters.
        EXPECT_TRUE(*c >= 0x20 && *c < 0x7f) << text;
      }
    }
  }
}

TEST(ParseJson, SkipsAByteOrderMarkAndKeepsTheOrderOfKeys) {
  const Json json = ParseJson("\xEF\xBB\xBF{\"b\": 1, \"a\": {\"b\": 2}, \"c\": {\"b\": 3}}", "t");
  EXPECT_EQ(json.dump(), R"({"b":1,"a":{"b":2},"c":{"b":3}})");
}

std::string Nested(int depth) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += i % 2 == 0 ? "[" : "{\"a\":";
  text += "1";
  for (int i = depth; i-- > 0;) text += i % 2 == 0 ? "]" : "}";
  return text;
}

TEST(ParseJson, ReadsTheDeepestNestingAndRefusesMore) {
  EXPECT_NO_THROW(static_cast<void>(ParseJson(Nested(kMaxJsonDepth), "t")));
  EXPECT_THROW(static_cast<void>(ParseJson(Nested(kMaxJsonDepth + 1), "t")), InputError);
  for (const char c : {'[', '{'}) {
    EXPECT_THROW(static_cast<void>(ParseJson(std::string(5'000'000, c), "t")), InputError);
  }
  std::string objects;
  for (int i = 0; i < 1'000'000; ++i) objects += "{\"a\":";
  EXPECT_THROW(static_cast<void>(ParseJson(objects, "t")), InputError);
}

std::string ObjectOf(std::size_t members) {
  std::string text = "{";
  for (std::size_t i = 0; i < members; ++i) {
    text += (i > 0 ? ",\"" : "\"") + std::to_string(i) + "\":0";
  }
  return text + "}";
}

TEST(ParseJson, ReadsTheLargestObjectAndRefusesALargerOneAnywhere) {
  EXPECT_EQ(ParseJson(ObjectOf(kMaxJsonMembers), "t").size(), kMaxJsonMembers);
  EXPECT_NO_THROW(static_cast<void>(
      ParseJson("[" + ObjectOf(kMaxJsonMembers) + "," + ObjectOf(kMaxJsonMembers) + "]", "t")));
  for (const std::size_t members : {kMaxJsonMembers + 1, std::size_t{1'000'000}}) {
    // If the smaller object is accepted, parsing the larger one takes hours.
    if (HasFailure()) return;
    const std::string large = ObjectOf(members);
    for (const std::string& text : {large, "{\"a\": [" + large + "]}"}) {
      try {
        static_cast<void>(ParseJson(text, "large.json"));
        ADD_FAILURE() << text.size() << " bytes were read";
      } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "large.json: object with more than 256 members");
      }
    }
  }
}

TEST(FormatJson, DoublesComeBackAsTheSameBits) {
  for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -2.5, 12345678.9}) {
    const Json back = ParseJson(FormatJson(Json{{"x", value}}), "t");
    EXPECT_EQ(back.at("x").get<double>(), value);
  }
}

TEST(FormatJson, BytesThatAreNoUtf8BecomeReplacements) {
  EXPECT_EQ(FormatJson(Json("cu\xFF"
                            "be.obj")),
            "\"cu\uFFFD"
            "be.obj\"\n");
}

TEST(FormatJson, EndsWithALineEnd) { EXPECT_EQ(FormatJson(Json{{"x", 1}}), "{\n \"x\": 1\n}\n"); }

}  // namespace json_test
}  // namespace regrasp
