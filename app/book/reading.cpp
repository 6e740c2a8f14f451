#include "app/book/reading.h"

#include "app/book/program_outline.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <sstream>

namespace tyndall {

double largest(Vector a) { return std::fmax(std::fabs(a.x), std::fmax(std::fabs(a.y), std::fabs(a.z))); }
bool is_near(double a, double b, double precision) {
  return std::fabs(a - b) <= precision * std::fmax(1.0, std::fmax(std::fabs(a), std::fabs(b)));
}
bool is_near(Vector a, Vector b, double precision) {
  return largest(a - b) <= precision * std::fmax(1.0, std::fmax(largest(a), largest(b)));
}
std::string triple(Vector a) { return fmt::format("[{},{},{}]", a.x, a.y, a.z); }

std::vector<double> Described::all(char kind) const {
  std::vector<double> found;
  for (const Member& one : members)
    if (one.kind == kind) found.insert(found.end(), one.numbers.begin(), one.numbers.end());
  return found;
}
std::vector<Vector> Described::vectors(const std::string& part) const {
  std::vector<Vector> found;
  for (const Member& one : members)
    if (one.kind == 'v' && key_of(one.name).find(part) != std::string::npos)
      found.push_back({one.numbers[0], one.numbers[1], one.numbers[2]});
  return found;
}
const double* Described::named(const std::string& part) const {
  for (const Member& one : members)
    if (one.kind == 'n' && key_of(one.name).find(part) != std::string::npos) return one.numbers.data();
  return nullptr;
}

Described described_by(const std::string& text) {
  Described made;
  std::istringstream lines(text);
  std::getline(lines, made.class_name), std::getline(lines, made.file);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    Described::Member member;
    words >> member.kind >> member.name;
    for (std::string word; words >> word;) member.numbers.push_back(std::strtod(word.c_str(), nullptr));
    made.members.push_back(member);
  }
  made.class_name = printable(made.class_name);
  return made;
}

const Described& Reading::described(char kind, double object) {
  describe(kind, {object});
  return described_ones[object];
}

void Reading::describe(char kind, std::vector<double> wanted) {
  std::erase_if(wanted, [&](double one) { return described_ones.contains(one); });
  if (wanted.empty()) return;
  std::istringstream texts(program.describe(kind, wanted));
  std::string text;
  for (const double one : wanted)
    if (std::getline(texts, text, '\f')) described_ones[one] = described_by(text);
}

std::string Reading::name_of(double object, const std::string& kind, std::string& list,
                             const std::function<std::string()>& text) {
  if (const auto known = names.find(object); known != names.end()) return known->second;
  const std::string made = text();
  if (made[0] != '{') return names[object] = made;
  names[object] = in_quotes(kind + " " + std::to_string(++counts[kind]));
  list += (list.empty() ? "" : ",\n") + names[object] + ":" + made;
  return names[object];
}

}  // namespace tyndall
