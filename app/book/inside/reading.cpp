#include "app/book/inside/reading.h"

#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>

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
  for (const Member& one : members_)
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
std::vector<const void*> Described::objects(char kind) const {
  std::vector<const void*> found;
  for (const Member& one : members_)
    if (one.kind == kind && one.object) found.push_back(one.object);
  return found;
}
bool Described::has(char kind) const {
  return std::any_of(members_.begin(), members_.end(), [&](const Member& one) { return one.kind == kind; });
}
void Described::take_numbers(char kind, const char* key, const double* numbers, int count) {
  members_.push_back({kind, key, {numbers, numbers + count}});
}
void Described::take_object(char kind, const char* key, const void* object) {
  members_.push_back({kind, key, {}, object});
  if (kind == 'c') class_name = printable(book::class_name(key)), file = book::file_of(object);
}

const Described& Reading::described(char kind, const void* object) {
  const auto [at, is_new] = described_ones.try_emplace(object);
  if (is_new) program.describe(kind, object, at->second);
  return at->second;
}

std::string Reading::name_of(const void* object, const std::string& kind, std::string& list,
                             const std::function<std::string()>& text) {
  if (const auto known = names.find(object); known != names.end()) return known->second;
  const std::string made = text();
  if (made[0] != '{') return names[object] = made;
  names[object] = in_quotes(kind + " " + std::to_string(++counts[kind]));
  list += (list.empty() ? "" : ",\n") + names[object] + ":" + made;
  return names[object];
}

std::string read_scene(const book::program_functions& program, book::picture_told& picture) try {
  Reading reading{program, picture, program.is_float ? 2e-3 : 1e-6};
  picture.draws_by_pdf = program.draws_by_pdf, picture.decodes_images = program.decodes_images;
  const std::string objects = read_world(reading), camera = read_camera(reading), sky = read_sky(reading);
  return fmt::format(
      "{{\"tyndall\":1,\"image\":{{\"width\":{},\"height\":{}}},\n{},\n\"background\":{},\n\"render\":{{\"spp\":{},"
      "\"max_depth\":{}}},\n\"textures\":{{{}}},\n\"materials\":{{{}}},\n\"objects\":[{}]}}\n",
      picture.width, picture.height, camera, sky, std::max(picture.samples, 1), read_depth(reading), reading.textures,
      reading.materials, objects);
} catch (const NotTaken& why) {
  return why.reason;
} catch (...) {
  return "one of its functions throws an exception";
}

}  // namespace tyndall
