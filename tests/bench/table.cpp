#include "tests/bench/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

namespace tyndall::bench {
namespace {

std::string text_of(const Json& row, const Column& column) {
  const auto at = row.find(column.key);
  if (at == row.end() || at->is_null()) return "-";
  if (at->is_string()) return at->get<std::string>();
  const double value = at->get<double>();
  if (!std::isfinite(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", std::max(column.digits, 0), value);
  return text;
}

void print_cell(const std::string& text, const Column& column, bool last) {
  const int width = column.digits < 0 ? -column.width : column.width;
  std::printf("%*s%s", width, text.c_str(), last ? "\n" : "  ");
}

}  // namespace

Table::Table(const std::string& title, std::vector<Column> columns) : columns_(std::move(columns)) {
  std::printf("\n%s\n", title.c_str());
  for (Column& column : columns_) {
    column.width = std::max(column.width, static_cast<int>(std::strlen(column.heading)));
    print_cell(column.heading, column, &column == &columns_.back());
  }
  std::fflush(stdout);
}

void Table::add(Json row) {
  for (const Column& column : columns_) print_cell(text_of(row, column), column, &column == &columns_.back());
  std::fflush(stdout);
  rows_.push_back(std::move(row));
}

void print_note(const std::string& text) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

}  // namespace tyndall::bench
