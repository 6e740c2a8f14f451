#pragma once
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// Tables of figures, on the screen and as JSON.
namespace tyndall::bench {

using Json = nlohmann::ordered_json;

/// A column of a table that is printed.
struct Column {
  const char* key;      ///< of the value in a row
  const char* heading;  ///< with the unit
  int digits = -1;      ///< after the point; -1: text, to the left
  int width = 0;        ///< at least that of the heading
};

/// A table that is printed row by row, as the figures come. Rows may hold more than is printed.
class Table {
 public:
  /// Prints the title and the headings.
  Table(const std::string& title, std::vector<Column> columns);
  /// Prints a row ("-" where it has no value) and keeps it.
  void add(Json row);
  const Json& rows() const { return rows_; }

 private:
  std::vector<Column> columns_;
  Json rows_ = Json::array();
};

/// A line below a table.
void print_note(const std::string& text);

}  // namespace tyndall::bench
