#pragma once
#include "app/book/run_guarded.h"
#include "app/book/tyndall/book/questions.h"
#include "core/system/connection.h"
#include "core/system/locks.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace tyndall {

/// A reader's program that has come to its first ray, and from then on answers when it is asked. It runs under guard,
/// until this is destroyed or it ends by itself. Its functions throw IoError where it has ended.
class OwnProgram {
 public:
  /// Starts it. name: what messages call it. It is ended if it has not told what it has in these seconds, or if go_on,
  /// which is asked now and then, says so.
  OwnProgram(std::string name, ChildPlan plan, double seconds, std::function<bool()> go_on);
  ~OwnProgram();
  OwnProgram(const OwnProgram&) = delete;
  OwnProgram& operator=(const OwnProgram&) = delete;

  /// What tyndall/book/hooks.h tells: a letter and a text.
  struct Message {
    char kind = 0;
    std::string text;
  };
  /// The next message; nothing: it has ended, see end().
  std::optional<Message> next_message();
  /// It has these seconds from now on.
  void set_deadline(double seconds);
  /// From now on it may take as long as it likes, and nobody is asked.
  void set_lasting();

  /// What its functions answer, see tyndall/book/questions.h. count: the questions are repeated up to that number; 0:
  /// they are not. For any number of threads.
  template <class A, class Q>
  std::vector<A> ask(char letter, double object, const std::vector<Q>& questions, std::size_t count = 0) {
    std::vector<A> answers(count > 0 ? count : questions.size());
    exchange({double(letter), object, static_cast<double>(answers.size()), static_cast<double>(questions.size())},
             questions.data(), questions.size() * sizeof(Q), answers.data(), answers.size() * sizeof(A));
    return answers;
  }
  /// Linear colours, three numbers each, of places in pixels, two numbers each.
  std::vector<double> samples(const std::vector<double>& places);
  /// The members of shapes (s), materials (m) or textures (t), each text with a form feed behind it.
  std::string describe(char kind, const std::vector<double>& objects);

  /// How it ended, after something has found that it did.
  const ChildEnd& end();

 private:
  bool is_wanted();
  void send(const void* bytes, std::size_t size);
  void exchange(const tyndall_book::question& head, const void* question, std::size_t question_size, void* answer,
                std::size_t answer_size);

  OpenFile channel_;
  std::string name_;
  std::chrono::steady_clock::time_point deadline_;
  std::atomic<bool> stops_ = false;
  Mutex wanted_mutex_;
  std::function<bool()> go_on_;  ///< empty: it lasts
  ChildEnd end_;
  Mutex mutex_;  ///< one question at a time
  std::thread thread_;
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
