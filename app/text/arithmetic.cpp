#include "app/text/arithmetic.h"

#include "core/base/math.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace tyndall {
namespace {

constexpr int deepest = 50;  // nested parentheses

/// Reads a sum from left to right; `failed` once something is not as expected.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::optional<double> all() {
    const double value = sum();
    skip();
    if (failed_ || !rest().empty() || !std::isfinite(value)) return {};
    return value;
  }

 private:
  std::string_view rest() const { return std::string_view(text_).substr(at_); }
  void skip() { at_ = std::min(text_.find_first_not_of(' ', at_), text_.size()); }
  bool take(std::string_view word) {
    skip();
    if (!rest().starts_with(word)) return false;
    at_ += word.size();
    return true;
  }

  double sum() {
    double value = product();
    for (;;) {
      if (take("+"))
        value += product();
      else if (take("-"))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    double value = signed_power();
    for (;;) {
      if (take("*"))
        value *= signed_power();
      else if (take("/"))
        value /= signed_power();
      else
        return value;
    }
  }
  double signed_power() {
    if (++depth_ > deepest) return fail();
    double value = 0;
    if (take("-"))
      value = -signed_power();
    else if (take("+"))
      value = signed_power();
    else
      value = power();
    --depth_;
    return value;
  }
  double power() {
    const double base = single();
    return take("^") ? std::pow(base, signed_power()) : base;
  }
  double single() {
    if (take("pi") || take("π")) return pi;
    const bool root = take("sqrt");
    if (take("(")) {
      const double value = sum();
      if (!take(")")) return fail();
      return root ? std::sqrt(value) : value;
    }
    return root ? fail() : number();
  }
  double number() {
    skip();
    const char first = at_ < text_.size() ? text_[at_] : '\0';
    if (first != '.' && (first < '0' || first > '9')) return fail();  // no signs and no words here
    const auto digits = [&](std::size_t from) {
      return std::min(text_.find_first_not_of("0123456789", from), text_.size());
    };
    std::size_t end = digits(at_);
    if (end < text_.size() && text_[end] == '.') end = digits(end + 1);
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      const std::size_t sign = end + 1 < text_.size() && (text_[end + 1] == '+' || text_[end + 1] == '-') ? 1 : 0;
      const std::size_t after = digits(end + 1 + sign);
      if (after > end + 1 + sign) end = after;
    }
    if (text_.substr(at_, end - at_) == ".") return fail();
    const double value = std::strtod(text_.substr(at_, end - at_).c_str(), nullptr);
    at_ = end;
    return value;
  }
  double fail() {
    failed_ = true;
    at_ = text_.size();
    return 0;
  }

  std::string text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
};

}  // namespace

std::optional<double> evaluate(std::string_view text) { return Reader(text).all(); }

}  // namespace tyndall
