#include <tyndall/watch.h>

#include "app/files/memory.h"
#include "app/files/open_scene.h"
#include "app/files/outputs.h"
#include "app/files/watched_function.h"
#include "app/text/standard_streams.h"
#include "app/window/window.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/thread_pool.h"
#include "core/image/image.h"
#include "core/image/image_io_file.h"
#include "core/render/render.h"

#include <fmt/core.h>

#include <algorithm>
#include <cfenv>
#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

/// The library for programs of others: what <tyndall/watch.h> promises, by the parts of the program.
namespace tyndall {
namespace {

constexpr const char* no_window = "; with the option output the picture is written to a file, without a window";

/// Whether denormal numbers are taken for 0, as programs compiled with -ffast-math ask for.
bool flushes_to_zero() {
#ifdef __SSE2__
  constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x40;
  return (_mm_getcsr() & (flush_to_zero | denormals_are_zero)) != 0;
#else
  return false;
#endif
}

/// While it lives, this thread and those that it starts compute as the IEEE standard says and as pictures need it:
/// rounding to nearest, with denormal numbers, without traps. In the end all is as it was: a program that was compiled
/// with -ffast-math has no denormal numbers, others may round otherwise. Also restores the locale's character type,
/// which the window system sets.
class Host {
 public:
  Host() : differs_(std::fegetround() != FE_TONEAREST || flushes_to_zero()) {
    const char* name = std::setlocale(LC_CTYPE, nullptr);
    character_type_ = name ? name : "C";
    std::fegetenv(&arithmetic_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~Host() {
    std::fesetenv(&arithmetic_);
    std::setlocale(LC_CTYPE, character_type_.c_str());
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Calls the program's function with the program's own arithmetic. From any thread.
  WatchedFunction::Function in_its_arithmetic(WatchedFunction::Function called) const {
    if (!differs_) return called;
    return [this, called = std::move(called)](double x, double y, std::uint64_t sample, double rgb[3]) {
      struct Back {
        ~Back() { std::fesetenv(FE_DFL_ENV); }
      } back;
      std::fesetenv(&arithmetic_);
      called(x, y, sample, rgb);
    };
  }

 private:
  bool differs_;  ///< in arithmetic
  std::fenv_t arithmetic_{};
  std::string character_type_;
};

std::string text(const char* option) { return option ? option : ""; }

/// The options as this library knows them: those of an older header lack members, which then have their defaults.
tyndall_watch_options whole(const tyndall_watch_options* given) {
  tyndall_watch_options options = TYNDALL_WATCH_OPTIONS;
  if (!given) return options;
  if (given->size < offsetof(tyndall_watch_options, threads) + sizeof(int) || given->size > 4096)
    throw UsageError(fmt::format("watch: size of the options: found {}, expected sizeof(tyndall_watch_options), {}",
                                 given->size, sizeof options));
  std::memcpy(&options, given, std::min(given->size, sizeof options));
  return options;
}

void check(int width, int height, bool has_function, const tyndall_watch_options& options) {
  constexpr int max_size = 65536;
  const auto refuse = [](const std::string& what) { throw UsageError("watch: " + what); };
  if (!has_function) refuse("found no function, expected one that computes samples");
  if (std::min(width, height) < 1 || std::max(width, height) > max_size)
    refuse(fmt::format("found a picture of {}x{} pixels, expected 1 to {} each way", width, height, max_size));
  if (options.threads < 0 || options.threads > max_threads)
    refuse(fmt::format("threads: found {}, expected 1 to {}", options.threads, max_threads));
  if (options.spp > max_samples) refuse(fmt::format("spp: found {}, expected at most {}", options.spp, max_samples));
}

/// What the caller wants. The scene has the picture's size and the settings of its samples, and no objects.
WindowOptions order_of(int width, int height, const tyndall_watch_options& options,
                       WatchedFunction::Function function) {
  WindowOptions order;
  order.function = std::make_shared<WatchedFunction>(std::move(function));
  order.threads = std::max(options.threads, 1);
  order.hosted = true;
  order.scene.name = options.title && *options.title ? options.title : "watch";
  order.scene.folder = ".";
  order.scene.is_picture = true;
  Scene& scene = order.scene.scene;
  scene.width = width, scene.height = height;
  scene.render.seed = options.seed;
  if (options.spp > 0) scene.render.spp = static_cast<int>(options.spp);
  return order;
}

void write_picture(const WindowOptions& order, const std::string& output, const std::string& reference) {
  const Scene& scene = order.scene.scene;
  if (!reference.empty())
    throw UsageError("watch: reference: found " + in_quotes(reference) +
                     ", expected none beside output: only the window compares");
  const std::vector<std::filesystem::path> files{output};
  check_image_names(files);
  check_can_write(output);
  check_memory({.width = scene.width, .height = scene.height, .place = "watch", .files = files}, free_memory());
  const std::shared_ptr<const PreparedScene> prepared = prepare(scene);
  RenderOptions options;
  options.threads = order.threads;
  options.spp = static_cast<std::uint32_t>(scene.render.spp.value_or(64));
  options.samples = order.function->source();
  const RenderResult result = render(*prepared, options);
  const LinearImage image{scene.width, scene.height, resolve(result.film)};
  const auto nothing = [](const std::filesystem::path&) { return Embedded{"", "", {}, false}; };
  for (const std::string& problem : write_images({result.film, image, scene.display, nothing, {}}, files))
    throw IoError(problem);
}

#ifdef TYNDALL_WINDOW
/// Whether the file is a picture to compare with as it is, and not to be rendered.
bool is_picture_file(const std::filesystem::path& name) {
  const std::filesystem::path file = picture_name(name).file;
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) &&
         image_kind(read_bytes(file, kind_size)) != ImageKind::unknown;
}

void add_reference(const std::string& reference, WindowOptions& order) {
  if (is_picture_file(reference)) {
    order.reference = reference;
    return;
  }
  SceneRequest request;
  request.what = reference;
  order.reference_scene = open_scene(request);
  order.reference_scene->scene.width = order.scene.scene.width;
  order.reference_scene->scene.height = order.scene.scene.height;
}

/// One window at a time: the libraries that draw it are of the whole process.
void show_window(WindowOptions& order, const std::string& reference) {
  static std::mutex window;
  const std::unique_lock only(window, std::try_to_lock);
  if (!only) throw UsageError("watch: a window is open; expected one at a time");
  check_memory({.width = order.scene.scene.width, .height = order.scene.scene.height, .window = true}, free_memory());
  if (const char* log = std::getenv("TYNDALL_UI_LOG")) order.ui_log = log;  // for tests
  if (!reference.empty()) add_reference(reference, order);
  try {
    run_window(order);
  } catch (const IoError& error) {
    throw IoError(error.what() + std::string(no_window));
  }
}
#else
void show_window(WindowOptions&, const std::string&) {
  throw IoError(std::string("this build has no window") + no_window);
}
#endif

int run(int width, int height, tyndall_watch_function function, void* user, const tyndall_watch_options* given) {
  const tyndall_watch_options options = whole(given);
  check(width, height, function != nullptr, options);
  const Host host;
  WindowOptions order = order_of(width, height, options,
                                 host.in_its_arithmetic([=](double x, double y, std::uint64_t sample, double rgb[3]) {
                                   function(user, x, y, sample, rgb);
                                 }));
  const std::string output = text(options.output), reference = text(options.reference);
  if (output.empty())
    show_window(order, reference);
  else
    write_picture(order, output, reference);
  const auto failures = order.function->problems();
  if (failures > 1)  // one was told already
    complain(fmt::format("{} samples have failed; the first: {}", failures, order.function->first_problem()));
  return failures > 0 ? 1 : 0;
}

}  // namespace
}  // namespace tyndall

int tyndall_watch(int width, int height, tyndall_watch_function function, void* user,
                  const tyndall_watch_options* options) {
  try {
    return tyndall::run(width, height, function, user, options);
  } catch (const std::exception&) {
    return tyndall::told_exit_code();
  }
}

void tyndall_watch_fail(const char* reason) {
  if (!tyndall::WatchedFunction::fail(reason)) tyndall::complain(tyndall::text(reason));
}
