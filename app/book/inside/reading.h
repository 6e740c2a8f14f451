#pragma once
#include "app/book/inside/inside.h"
#include "core/base/sampling.h"

#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

/// A scene from the world of a reader's program: its objects tell their members, and what its functions answer must be
/// what the books' would.
namespace tyndall {

namespace book = tyndall_book;

constexpr double endless = HUGE_VAL;

double largest(Vec3d a);
/// Whether two values agree to that part of them, or of 1 if they are smaller.
bool is_near(double a, double b, double precision);
bool is_near(Vec3d a, Vec3d b, double precision);
/// As a JSON array.
std::string triple(Vec3d a);

/// Random numbers, the same ones each time.
class RandomNumbers {
 public:
  double between(double a, double b) { return a + (b - a) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double next() { return between(0, 1); }
  Vec3d on_sphere() { return tyndall::on_sphere(Pair<double>{next(), next()}); }

 private:
  std::mt19937_64 engine_;
};

/// Why something cannot be taken over, for the user.
struct NotTaken {
  std::string reason;
};

/// An object of the program's, by its members.
class Described : public book::description {
 public:
  std::string class_name, file;  ///< file: that was read before it was made; "": none

  /// The numbers of all members of the kind, whose keys have the part.
  std::vector<double> all(char kind, const std::string& part = "") const;
  std::vector<double> numbers() const { return all('n'); }
  /// Of vectors.
  std::vector<Vec3d> vectors(const std::string& part = "") const;
  /// The first of such numbers; if there is none, the other one.
  double named(const std::string& part, double otherwise) const;
  /// All of the kind, without null pointers.
  std::vector<const void*> objects(char kind) const;
  /// Whether it has members of the kind, if only an empty list.
  bool has(char kind) const;
  [[noreturn]] void refuse(const std::string& why) const { throw NotTaken{class_name + ": " + why}; }

  void take_numbers(char kind, const char* key, const double* numbers, int count) override;
  void take_object(char kind, const char* key, const void* object) override;

 private:
  struct Member {
    char kind;
    std::string key;  ///< of its name
    std::vector<double> numbers{};
    const void* object = nullptr;
  };
  std::vector<Member> members_;
};

/// What is known of a program while its scene is made.
struct Reading {
  const book::program_functions& program;
  book::picture_told& picture;
  double precision;                                ///< what two computations of the same number may differ by
  std::string textures{}, materials{};             ///< members of JSON objects
  const void *matt = nullptr, *shining = nullptr;  ///< a material that scatters one colour, and one that shines
  Vec3d albedo{}, light{};                         ///< their colours
  std::set<const void*> one_sided{};               ///< materials that shine where their normals point to
  std::map<const void*, Described> described_ones{};
  std::map<const void*, std::string> names{};
  std::map<std::string, int> counts{};

  const Described& described(char kind, const void* object);
  /// The quoted name of a texture or material, which is added to `list` when it is asked for first. text: makes it; a
  /// colour needs no name.
  std::string name_of(const void* object, const std::string& kind, std::string& list,
                      const std::function<std::string()>& text);
};

std::string material_name(Reading& reading, const void* material);
std::string texture_name(Reading& reading, const void* texture);
std::string medium_colour(Reading& reading, const void* material);
/// The objects, between commas.
std::string read_world(Reading& reading);
std::string read_camera(Reading& reading);
std::string read_sky(Reading& reading);
/// The longest path, in scattering events; checks the arithmetic of one and of two hits.
int read_depth(Reading& reading);

/// The text of a scene file, or why there is none, in one sentence. picture: what is found is added.
std::string read_scene(const book::program_functions& program, book::picture_told& picture);

}  // namespace tyndall
