#include "app/text/json_text.h"

#include "core/base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

/// What is not UTF-8, as in the name of a file, becomes \xff.
std::string json_string(std::string_view text) {
  return in_quotes(printable(text, std::numeric_limits<std::size_t>::max()));
}

}  // namespace

void JsonText::add(std::string_view key, std::string_view text) { add_json(key, json_string(text)); }

void JsonText::add(std::string_view key, const std::vector<std::string>& texts) {
  std::string json = "[";
  for (const std::string& text : texts) json += (&text == texts.data() ? "" : ", ") + json_string(text);
  add_json(key, json + "]");
}

void JsonText::add_number(std::string_view key, double number) {
  add_json(key, std::isfinite(number) ? number_text(number) : "null");
}

void JsonText::add_json(std::string_view key, std::string_view json) {
  members_ += (keys_.empty() ? "" : ",") + ("\n  " + in_quotes(key)) + ": ";
  members_ += json;
  keys_.emplace_back(key);
}

bool JsonText::contains(std::string_view key) const {
  return std::find(keys_.begin(), keys_.end(), key) != keys_.end();
}

std::string JsonText::text() const { return "{" + members_ + "\n}\n"; }

}  // namespace tyndall
