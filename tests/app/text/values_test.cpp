#include "app/text/values.h"
#include "app/text/markup.h"
#include "core/base/error.h"

#include <doctest/doctest.h>

#include <string>

namespace tyndall::test::values_test {

using Values = std::vector<std::string>;

TEST_CASE("whole numbers: the whole text must be a number, and in range") {
  CHECK(read_whole("64", 1, 100) == 64);
  CHECK(read_whole("-3", -5, 5) == -3);
  for (const char* text : {"", "abc", "1.5", "12x", " 1", "0", "101", "99999999999999999999", "0x10", "1e3"})
    CHECK_THROWS_AS(read_whole(text, 1, 100), UsageError);
  CHECK_THROWS_WITH(read_whole("0", 1, 100), R"(found "0", expected a whole number from 1 to 100)");
}

TEST_CASE("numbers: must be finite and in range") {
  CHECK(read_number("0.25", at_least(0), "") == 0.25);
  CHECK(read_number("1e-3", above(0), "") == 1e-3);
  CHECK(read_number("-2", any_number(), "") == -2);
  for (const char* text : {"nan", "inf", "-inf", "1e999", "", "-1", "1,5", "2 "})
    CHECK_THROWS_AS(read_number(text, at_least(0), "a number >= 0"), UsageError);
  CHECK_THROWS_WITH(read_number("-1", at_least(0), "a number >= 0"), R"(found "-1", expected a number >= 0)");
}

TEST_CASE("sizes, sample ranges and regions: whole numbers with signs between them, not empty") {
  CHECK(read_size("640x480").width == 640);
  CHECK(read_size("640x480").height == 480);
  for (const char* text : {"640", "640x", "x480", "640x480x3", "0x10", "10x-1", "10X10", "640 x 480", "1.5x2", "x"})
    CHECK_THROWS_AS(read_size(text), UsageError);
  CHECK(read_samples("16:32").first == 16);
  CHECK(read_samples("16:32").last == 32);
  CHECK(read_samples("4294967294:4294967295").first == 4294967294u);
  for (const char* text : {"16", "16:", ":16", "16:16", "17:16", "-1:5", "0:4294967296", "1:2:3", "0:16777217"})
    CHECK_THROWS_AS(read_samples(text), UsageError);
  CHECK_THROWS_AS(read_frames("-1:5"), UsageError);
  CHECK(read_region("1,2,30,40") == Region{1, 2, 30, 40});
  for (const char* text : {"1,2,30", "1,2,30,40,50", "5,5,5,9", "5,5,9,5", "-1,0,5,5", "0,0,5,5.5", "0 0 5 5"})
    CHECK_THROWS_AS(read_region(text), UsageError);
}

TEST_CASE("overrides: a pointer, then everything after the first =") {
  CHECK(read_override("/materials/gold/fuzz=0.2").pointer == "/materials/gold/fuzz");
  CHECK(read_override("/name=a=b").value == "a=b");
  CHECK(read_override("/name=").value.empty());
  for (const char* text : {"fuzz=1", "/fuzz", "", "=1"}) CHECK_THROWS_AS(read_override(text), UsageError);
}

TEST_CASE("names: a near miss gets a suggestion") {
  CHECK(read_name("aces", {"srgb", "aces"}) == 1);
  CHECK_THROWS_WITH(read_name("shlick", {"exact", "schlick"}),
                    R"(found "shlick", expected one of "exact", "schlick" (did you mean "schlick"?))");
  CHECK_THROWS_WITH(read_name("zzz", {"exact", "schlick"}), R"(found "zzz", expected one of "exact", "schlick")");
}

TEST_CASE("sweep: steps include both ends and are the numbers that a user would type; lists hold anything") {
  CHECK(read_sweep_axis("/a/b=0:0.4:5").pointer == "/a/b");
  for (const auto& [text, values] : {std::pair{"/a/b=0:0.4:5", Values{"0", "0.1", "0.2", "0.3", "0.4"}},
                                     {"/a=-0.3:0.3:7", {"-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"}},
                                     {"/a=2:1:2", {"2", "1"}},
                                     {"/a=[0,0.1,5e-1]", {"0", "0.1", "0.5"}},
                                     {"/a=[\"gold\", \"glass\"]", {"gold", "glass"}},
                                     {"/a=gold,glass", {"gold", "glass"}},
                                     {"/a=[gold,glass]", {"gold", "glass"}},
                                     {"/a=[[0,1,2],[3,4,5]]", {"[0, 1, 2]", "[3, 4, 5]"}}})
    CHECK(read_sweep_axis(text).values == values);
  for (const char* text : {"", "a=1:2:3", "/a", "/a=", "/a=1", "/a=1:2", "/a=1:2:1", "/a=1:2:x", "/a=1:2:99999999",
                           "/a=1:1:3", "/a=[1]", "/a=gold,gold", "/a=gold,", "/a=nan:1:3", "/a=[]"})
    CHECK_THROWS_AS(read_sweep_axis(text), UsageError);
}

TEST_CASE("name pattern: numbers with and without leading zeros, percent signs, values; nothing else, and once") {
  CHECK(name_for(read_numbered_name("f/%04d.png"), 7) == "f/0007.png");
  CHECK(name_for(read_numbered_name("f/%04d.png"), 12345) == "f/12345.png");
  CHECK(name_for(read_numbered_name("f-%d.png"), 7) == "f-7.png");
  CHECK(name_for(read_numbered_name("100%%-%02d"), 7) == "100%-07");
  CHECK(name_for(read_valued_name("d/%v.exr"), "a/b") == "d/a_b.exr");
  for (const char* name : {"f.png", "%04d-%04d.png", "%s.png", "%4d.png", "%.png", "%", "%012d.png", "%v.png"})
    CHECK_THROWS_AS(read_numbered_name(name), UsageError);
  for (const char* name : {"f.exr", "%d.exr", "%v%v.exr", "%4v.exr", "%04v.exr"})
    CHECK_THROWS_AS(read_valued_name(name), UsageError);
}

TEST_CASE("markup: references for what begins or ends something; what XML cannot hold at all becomes text") {
  CHECK(in_xml("a < b > \"c\" & 'd' ]]>") == "a &lt; b &gt; &quot;c&quot; &amp; &#39;d&#39; ]]&gt;");
  CHECK(in_html("a < b > \"c\" & 'd'") == "a &lt; b > &quot;c&quot; &amp; &#39;d&#39;");
  CHECK(in_xml("a\n\x01\x1b\xff\xed\xa0\x80") == "a\\n\\u0001\\u001b\\xff\\xed\\xa0\\x80");
  CHECK(in_html("\xef\xbf\xbe Grüße") == "\\ufffe Grüße");
}

TEST_CASE("fields of CSV and words of a shell are quoted where these need it") {
  CHECK(in_csv("gold") == "gold");
  CHECK(in_csv("a \"b\", c") == "\"a \"\"b\"\", c\"");
  CHECK(in_csv("two\nlines") == "\"two\nlines\"");
  CHECK(in_shell("it's") == "'it'\\''s'");
}

TEST_CASE("a template gets its texts where their names stand; a name that it has not is refused") {
  const std::string script = from_template("blender.py", {{"scene", "\"{{scene}} {{more}}\""}});
  CHECK(script.find("\nDATA = \"{{scene}} {{more}}\"\n") != std::string::npos);  // what was put in is not looked at
  CHECK_THROWS_AS(from_template("blender.py", {{"scene", ""}, {"more", ""}}), IoError);
  CHECK_THROWS_AS(from_template("no such file", {{"scene", ""}}), IoError);
}

}  // namespace tyndall::test::values_test
