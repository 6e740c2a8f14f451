#pragma once
#include "app/book/own_program.h"
#include "core/base/sampling.h"

#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

/// A scene from a reader's program that has come to its first ray: its objects tell their members, and what its
/// functions answer must be what the books' would.
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
struct Described {
  struct Member {
    char kind = 0;    ///< see description in tyndall/book/take.h
    std::string key;  ///< of its name
    std::vector<double> numbers;
  };
  std::string class_name, file;  ///< file: that was read before it was made; "": none
  std::vector<Member> members;

  /// The numbers of all members of the kind, whose keys have the part.
  std::vector<double> all(char kind, const std::string& part = "") const;
  /// Of vectors.
  std::vector<Vec3d> vectors(const std::string& part = "") const;
  /// The first of such numbers; if there is none, the other one.
  double named(const std::string& part, double otherwise) const;
  [[noreturn]] void refuse(const std::string& why) const { throw NotTaken{class_name + ": " + why}; }
};

/// What is known of a program while its scene is made. Objects of the program's are named by their addresses.
struct Reading {
  ProgramScene& scene;
  OwnProgram& program;
  book::picture_told picture{};
  double precision = 1e-6;              ///< what two computations of the same number may differ by
  std::string textures{}, materials{};  ///< members of JSON objects
  double matt = 0, shining = 0;         ///< a material that scatters one colour, and one that shines
  Vec3d albedo{}, light{};              ///< their colours
  std::set<double> one_sided{};         ///< materials that shine where their normals point to
  std::map<double, Described> described_ones{};
  std::map<double, std::string> names{};
  std::map<std::string, int> counts{};

  const Described& described(char kind, double object);
  /// The quoted name of a texture or material, which is added to `list` when it is asked for first. text: makes it; a
  /// colour needs no name.
  std::string name_of(double object, const std::string& kind, std::string& list,
                      const std::function<std::string()>& text);
};

std::string material_name(Reading& reading, double material);
std::string texture_name(Reading& reading, double texture);
std::string medium_colour(Reading& reading, double material);
/// The objects, between commas.
std::string read_world(Reading& reading);
std::string read_camera(Reading& reading);
std::string read_sky(Reading& reading);
/// The longest path, in scattering events; checks the arithmetic of one and of two hits.
int read_depth(Reading& reading);

}  // namespace tyndall
