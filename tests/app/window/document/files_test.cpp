#include "app/window/document/document.h"
#include "app/window/document/job_queue.h"
#include "app/window/document/numbered_files.h"
#include "core/base/error.h"
#include "tests/support/news.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace tyndall::test::files_test {
namespace fs = std::filesystem;

namespace {

/// What writes numbered files, in a folder of its own, which is the current one while this lives.
struct Writer {
  fs::path before = fs::current_path();
  News news;
  MessageLine messages{nullptr};
  JobQueue jobs{[this] { news.tell(); }};
  NumberedFiles files{{".txt", ".more"}, jobs, messages, nullptr};

  explicit Writer(const std::string& folder) { fs::current_path(scratch_folder(folder)); }
  ~Writer() { fs::current_path(before); }
  /// Waits for so many jobs, all in all, and takes their results.
  bool collect(int done) {
    CHECK(news.wait_until([&] { return news.told() >= done; }));
    return jobs.collect();
  }
};

}  // namespace

TEST_CASE("numbered names: never one that exists, with any of the endings") {
  const fs::path folder = scratch_folder("numbered_names");
  const auto next = [&](int from) { return numbered_base(folder, "a", from, {".png", ".exr"}); };
  CHECK(next(1) == folder / "a-001");
  write_text(folder / "a-001.png", "");
  write_text(folder / "a-002.exr", "");
  fs::create_symlink("nowhere", folder / "a-003.png");
  CHECK(next(1) == folder / "a-004");
  CHECK(number_of(next(7)) == 7);
}

TEST_CASE("no number is given twice, and what was written, or why not, is told in one line") {
  Writer writer("numbered_work");
  const auto& now = writer.messages.current();
  const fs::path first = writer.files.next_base("a"), second = writer.files.next_base("a");
  CHECK(first.filename() == "a-001");
  CHECK(second.filename() == "a-002");
  writer.files.write(first, [](const fs::path&) { return std::string("written\n\xff"); });
  CHECK(writer.collect(1));
  CHECK_FALSE(writer.jobs.collect());
  CHECK(now.text == "written\\n\\xff");
  CHECK_FALSE(now.error);
  writer.files.write(second, [](const fs::path&) -> std::string { throw IoError("no room"); });
  writer.collect(2);
  CHECK(now.text == "no room");
  CHECK(now.error);
}

TEST_CASE("no file is overwritten that another window or program has written since the number was given") {
  Writer writer("numbered_raced");
  NumberedFiles other({".txt", ".more"}, writer.jobs, writer.messages, nullptr);
  const auto write = [](const std::string& text) {
    return [text](const fs::path& base) {
      write_text(base.string() + ".txt", text);
      return base.filename().string();
    };
  };
  const fs::path one = writer.files.next_base("a"), two = other.next_base("a");
  CHECK(one == two);
  writer.files.write(one, write("first"));
  other.write(two, write("second"));
  writer.collect(2);
  CHECK(writer.messages.current().text == "a-002");
  CHECK(read_text("a-001.txt") == "first");
  CHECK(read_text("a-002.txt") == "second");
  write_text("a-003.more", "of another program");
  CHECK(other.next_base("a").filename() == "a-004");
}

TEST_CASE("a film is waited for, but not when the picture changed or the window closes") {
  int requested = 0;
  const auto yes = [] { return true; };
  const auto no = [] { return false; };
  const auto late = [&] {
    Film film = make_film(2, 2, {0, 0, 2, 2}, 0, 1);
    for (FilmPixel& pixel : film.pixels) pixel.taken = ++requested > 8 ? 1 : 0;
    return film;
  };
  CHECK(wait_for_film(late, yes, yes).pixels.size() == 4);
  CHECK(wait_for_film(late, no, yes).pixels.empty());
  requested = 0;
  CHECK(wait_for_film(late, yes, no).pixels.empty());
}

TEST_CASE("jobs run in order elsewhere, results here, and none is lost at the end") {
  std::vector<int> order;
  std::atomic<int> ran = 0;
  News news;
  {
    JobQueue jobs([&] { news.tell(); });
    CHECK(jobs.idle());
    for (int k = 0; k < 3; ++k)
      jobs.run([&, k]() -> JobQueue::Result {
        ++ran;
        return [&, k] { order.push_back(k); };
      });
    CHECK(news.wait_until([&] { return news.told() == 3; }));
    CHECK(order.empty());
    CHECK_FALSE(jobs.idle());
    jobs.collect();
    CHECK(jobs.idle());
    CHECK(order == std::vector<int>{0, 1, 2});
    for (int k = 0; k < 3; ++k)
      jobs.run([&]() -> JobQueue::Result {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the queue goes before these jobs have run
        ++ran;
        return {};
      });
  }
  CHECK(ran == 6);
}

TEST_CASE("a thread works when it is asked to or its time has come, after a pause, and once more at its end if asked") {
  std::atomic<int> done = 0;
  News news;
  const auto work = [&] {
    news.tell();
    return ++done == 1 ? BackgroundThread::Time(1) : BackgroundThread::never;
  };
  {
    BackgroundThread thread(work);
    thread.ask();
    CHECK(news.wait_until([&] { return done == 2; }));
    thread.ask();
  }
  CHECK(done == 3);
  {
    BackgroundThread thread(work, std::chrono::hours(1));
    thread.ask();
    CHECK(news.wait_until([&] { return done == 4; }));
    thread.ask();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(done == 4);
  }
  CHECK(done == 5);
}

}  // namespace tyndall::test::files_test
