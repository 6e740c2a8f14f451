#include "app/text/markup.h"

#include <doctest/doctest.h>

namespace tyndall::test::markup_test {

TEST_CASE("markup: references for what begins or ends something") {
  CHECK(in_xml("a < b > \"c\" & 'd' ]]>") == "a &lt; b &gt; &quot;c&quot; &amp; &#39;d&#39; ]]&gt;");
  CHECK(in_html("a < b > \"c\" & 'd'") == "a &lt; b > &quot;c&quot; &amp; &#39;d&#39;");
}

TEST_CASE("markup: what XML cannot hold, not even as a reference, becomes text") {
  CHECK(in_xml("a\n\x01\x1b\xff\xed\xa0\x80") == "a\\n\\u0001\\u001b\\xff\\xed\\xa0\\x80");
  CHECK(in_html("\xef\xbf\xbe Grüße") == "\\ufffe Grüße");
}

TEST_CASE("fields of CSV and words of a shell are quoted where these need it") {
  CHECK(in_csv("gold") == "gold");
  CHECK(in_csv("a \"b\", c") == "\"a \"\"b\"\", c\"");
  CHECK(in_csv("two\nlines") == "\"two\nlines\"");
  CHECK(in_shell("it's") == "'it'\\''s'");
}

}  // namespace tyndall::test::markup_test
