#include "core/base/text.h"

#include <doctest/doctest.h>

#include <bit>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace tyndall::test::text_test {

TEST_CASE("printable: one line of UTF-8, whatever comes in") {
  CHECK(printable("a\nb\tc\r\x1b[31m\x7f") == "a\\nb\\tc\\r\\u001b[31m\\u007f");
  CHECK(printable("Grüße, 世界 🙂") == "Grüße, 世界 🙂");
  CHECK(printable("a\xc2\x9b"
                  "b") == "a\\u009bb");                                     // a control character of two bytes
  CHECK(printable("\xff\xc3(\xe2\x82") == "\\xff\\xc3(\\xe2\\x82");         // broken letters
  CHECK(printable("\xc0\xaf\xed\xa0\x80") == "\\xc0\\xaf\\xed\\xa0\\x80");  // too long; a surrogate
  CHECK(printable("\xf5\x80\x80\x80\xf4\x8f\xbf\xbf") == "\\xf5\\x80\\x80\\x80\xf4\x8f\xbf\xbf");
  CHECK(printable(std::string_view("a\0b", 3)) == "a\\u0000b");
  CHECK(printable("aäb", 2) == "aä…");
  CHECK(printable("ab", 2) == "ab");
}

TEST_CASE("printable: what ends or turns a line, and what XML refuses") {
  CHECK(printable("a\u2028b\u2029c\u202ed\u2066e") == "a\\u2028b\\u2029c\\u202ed\\u2066e");
  CHECK(printable("\xef\xbf\xbe\xef\xbf\xbf") == "\\ufffe\\uffff");
  CHECK(printable("\u2027\u202f\ufffd\U0001f642") == "\u2027\u202f\ufffd\U0001f642");
  CHECK(all_printable(std::string(1000, '\n')).size() == 2000);
}

TEST_CASE("UTF-8: surrogates, long forms and cut letters are none") {
  CHECK(is_utf8(""));
  CHECK(is_utf8("a\n\x01 Grüße, 世界 🙂 \xef\xbf\xbe"));
  for (const char* bytes : {"\xff", "a\xed\xa0\x80", "\xc0\xaf", "\xe2\x82", "\xf5\x80\x80\x80"})
    CHECK_FALSE(is_utf8(bytes));
}

TEST_CASE("shortened: whole letters") {
  CHECK(shortened("abc", 3) == "abc");
  CHECK(shortened("abcd", 3) == "abc…");
  CHECK(shortened("aäb", 2) == "a…");
  CHECK(shortened("aäb", 3) == "aä…");
  CHECK(size_of_letters("aäb", 2) == 1);
  CHECK(size_of_letters("aäb", 9) == 4);
}

TEST_CASE("next_letter: one after the other, also where a byte belongs to none") {
  std::vector<std::uint32_t> letters;
  for (std::size_t at = 0; at < 9;) letters.push_back(next_letter("aä…\xffz\xe2", at));
  CHECK(letters == std::vector<std::uint32_t>{'a', 0xe4, 0x2026, 0xfffd, 'z', 0xfffd});
}

TEST_CASE("in_quotes: JSON's escapes") { CHECK(in_quotes("a\"b\\c/\n\x01ä") == "\"a\\\"b\\\\c/\\n\\u0001ä\""); }

TEST_CASE("number_text: the shortest decimal that reads back") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(100000) == "100000");
  CHECK(number_text(-1) == "-1");
  CHECK(number_text(0) == "0");
  CHECK(number_text(-0.0) == "-0.0");  // "-0" would be read as a whole number, without its sign
  CHECK(number_text(1.0 / 3) == "0.3333333333333333");
  CHECK(number_text(1e22) == "1e+22");
  CHECK(number_text(1e-7) == "1e-07");
  CHECK(number_text(0.1 + 0.2) == "0.30000000000000004");
  CHECK(number_text(std::numeric_limits<double>::infinity()) == "inf");
  CHECK(number_text(-std::numeric_limits<double>::infinity()) == "-inf");
  CHECK(number_text(std::numeric_limits<double>::quiet_NaN()) == "nan");
}

TEST_CASE("number_text: every double reads back") {
  std::mt19937_64 bits(7);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(bits());
    if (value != value) continue;
    CHECK(std::bit_cast<std::uint64_t>(std::strtod(number_text(value).c_str(), nullptr)) ==
          std::bit_cast<std::uint64_t>(value));
  }
}

TEST_CASE("closest: the name that was meant, or none") {
  const std::vector<std::string_view> keys{"look_from", "look_at", "vup", "vfov"};
  CHECK(closest("lookfrom", keys) == "look_from");
  CHECK(closest("look_form", keys) == "look_from");  // two neighbours swapped are one edit
  CHECK(closest("vfow", keys) == "vfov");
  CHECK(closest("vpu", keys) == "vup");
  CHECK(closest("aperture", keys) == "");
  CHECK(closest("", keys) == "");
  CHECK(closest("x", {"y"}) == "y");
  CHECK(closest(std::string(1000000, 'x'), {"y"}) == "");
  CHECK(did_you_mean("vfow", keys) == " (did you mean \"vfov\"?)");
  CHECK(did_you_mean("aperture", keys) == "");
  CHECK(one_of({"a"}) == "\"a\"");
  CHECK(one_of({"a", "b"}) == "one of \"a\", \"b\"");
}

}  // namespace tyndall::test::text_test
