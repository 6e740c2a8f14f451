#pragma once
#include "core/base/vec.h"
#include "core/system/child.h"
#include "core/system/connection.h"
#include "core/system/locks.h"

#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace tyndall_book {
using vector = tyndall::Vec3d;
}
#include "app/book/tyndall/book/questions.h"

namespace tyndall {

/// A reader's program that has come to its first ray, and from then on answers when it is asked. It runs under guard,
/// until this is destroyed or it ends by itself. Its functions throw IoError where it has ended.
class OwnProgram {
 public:
  /// Starts it. name: what messages call it. For seconds, go_on see let_run().
  OwnProgram(std::string name, ChildPlan plan, double seconds, std::function<bool()> go_on);
  ~OwnProgram();
  OwnProgram(const OwnProgram&) = delete;
  OwnProgram& operator=(const OwnProgram&) = delete;

  /// It is ended in so many seconds from now on, or if go_on, which is asked now and then, says so; may be empty.
  void let_run(double seconds, std::function<bool()> go_on);

  /// What tyndall/book/hooks.h tells: a letter and a text.
  struct Message {
    char kind = 0;
    std::string text;
  };
  /// The next message; nothing: it has ended, see end(), or has said nothing for so long; 0: as long as it takes.
  std::optional<Message> next_message(int milliseconds = 0);

  /// What its functions answer, see tyndall/book/questions.h. count: the questions are repeated up to that number; 0:
  /// they are not. For any number of threads.
  template <class A, class Q>
  std::vector<A> ask(char letter, double object, const std::vector<Q>& questions, std::size_t count = 0) {
    std::vector<A> answers(count > 0 ? count : questions.size());
    const std::string bytes = exchange(
        {double(letter), object, static_cast<double>(count), static_cast<double>(questions.size() * sizeof(Q))},
        questions.data());
    if (bytes.size() != answers.size() * sizeof(A)) fail();
    std::memcpy(answers.data(), bytes.data(), bytes.size());
    return answers;
  }
  /// The members of an object, as text.
  std::string describe(char kind, double object) { return exchange({double(kind), object}, ""); }
  /// Linear colours of places in the picture.
  std::vector<Vec3d> samples(const std::vector<tyndall_book::pixel_place>& places) {
    return ask<Vec3d>('p', 0, places);
  }

  /// How it ended, after something has found that it did.
  const ChildEnd& end();

 private:
  [[noreturn]] void fail() const;
  std::string exchange(const tyndall_book::question& head, const void* questions);

  OpenFile channel_;
  std::string name_;
  std::atomic<bool> stops_ = false;
  Mutex wanted_mutex_;
  std::chrono::steady_clock::time_point deadline_;
  std::function<bool()> go_on_;
  Mutex mutex_;  ///< one question at a time
  std::shared_future<ChildEnd> end_;
};

/// What a program shows: a scene, or samples of its own.
struct ProgramScene {
  std::string json;                          ///< a scene file's text, with size, samples and depth; "": there is none
  std::string reason;                        ///< why there is none, in one sentence
  int width = 0, height = 0, samples = 0;    ///< of its picture
  std::vector<std::string> notes;            ///< what the user should know, a line each
  std::vector<std::filesystem::path> files;  ///< of the reader's, that were read
  std::shared_ptr<OwnProgram> own;           ///< computes what it would
  bool fuzz_on_sphere = false;               ///< its metals are those of the fourth edition
  bool matt_in_sphere = false;               ///< its matt surfaces are those of the first edition
  bool short_frame = false;                  ///< it divides by width - 1 and height - 1
  bool draws_by_pdf = false;                 ///< it draws directions as the third book does, from mixtures
  bool has_noise = false;                    ///< it has textures of noise, whose lattice is its own
  bool has_images = false;                   ///< it has textures of images, which it reads by a curve of its own
};

}  // namespace tyndall
