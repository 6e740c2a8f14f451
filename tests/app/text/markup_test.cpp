#include "app/text/markup.h"

#include "core/base/error.h"

#include <doctest/doctest.h>

namespace tyndall::test::markup_test {

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

}  // namespace tyndall::test::markup_test
