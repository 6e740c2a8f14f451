#include "app/book/reading.h"

#include "app/book/program_outline.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <sstream>

namespace tyndall {

double largest(Vec3d a) { return std::fmax(std::fabs(a.x), std::fmax(std::fabs(a.y), std::fabs(a.z))); }
bool is_near(double a, double b, double precision) {
  return std::fabs(a - b) <= precision * std::fmax(1.0, std::fmax(std::fabs(a), std::fabs(b)));
}
bool is_near(Vec3d a, Vec3d b, double precision) {
  return largest(a - b) <= precision * std::fmax(1.0, std::fmax(largest(a), largest(b)));
}
std::string triple(Vec3d a) { return fmt::format("[{},{},{}]", a.x, a.y, a.z); }

std::vector<double> Described::all(char kind, const std::string& part) const {
  std::vector<double> found;
  for (const Member& one : members)
    if (one.kind == kind && one.key.find(part) != std::string::npos)
      found.insert(found.end(), one.numbers.begin(), one.numbers.end());
  return found;
}
std::vector<Vec3d> Described::vectors(const std::string& part) const {
  const std::vector<double> numbers = all('v', part);
  std::vector<Vec3d> found;
  for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) found.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
  return found;
}
double Described::named(const std::string& part, double otherwise) const {
  const std::vector<double> found = all('n', part);
  return found.empty() ? otherwise : found[0];
}

const Described& Reading::described(char kind, double object) {
  const auto [at, is_new] = described_ones.try_emplace(object);
  Described& made = at->second;
  if (!is_new) return made;
  std::istringstream lines(program.describe(kind, object));
  std::getline(lines, made.class_name), std::getline(lines, made.file);
  made.class_name = printable(made.class_name);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    Described::Member& member = made.members.emplace_back();
    words >> member.kind >> member.key, member.key = key_of(member.key);
    for (std::string word; words >> word;) member.numbers.push_back(std::strtod(word.c_str(), nullptr));
  }
  return made;
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
