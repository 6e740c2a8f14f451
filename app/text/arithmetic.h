#pragma once
#include <optional>
#include <string_view>

/// Sums that a user types in place of a number.
namespace tyndall {

/// The value of "1/4", "2*pi", "(1 + 0.5)^2" or "sqrt(2)": + - * / ^, parentheses, pi and sqrt, with the usual order.
/// Nothing for what is no such sum, or has no finite value.
std::optional<double> evaluate(std::string_view text);

}  // namespace tyndall
