// A program of somebody else that uses <tyndall/watch.h>. Arguments: what to do, the picture to write ("-": open the
// window), and for some more.
#include <tyndall/watch.h>

#include <array>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

namespace {

struct Xyz {
  float x, y, z;
};
struct Rgb {
  double r, g, b;
};
struct E {
  double e[3];
};
class Functions {  // as the books' vec3
 public:
  explicit Functions(double grey) : e_{grey, grey, grey} {}
  double x() const { return e_[0]; }
  double y() const { return e_[1]; }
  double z() const { return e_[2]; }

 private:
  double e_[3];
};
struct Index {
  double& operator[](int i) { return value[i]; }
  double value[3];
};

/// Whether every usual kind of colour is taken apart rightly.
bool takes_all_colours() {
  bool all = true;
  const auto see = [&](const auto& colour, double grey) {
    all = all && tyndall::watch_details::take_apart(colour) == std::array{grey, grey, grey};
  };
  see(Xyz{1, 1, 1}, 1);
  see(Rgb{2, 2, 2}, 2);
  see(E{{3, 3, 3}}, 3);
  see(Functions(4), 4);
  see(Index{{5, 5, 5}}, 5);
  see(std::array<float, 3>{6, 6, 6}, 6);
  see(7, 7);
  return all;
}

/// Column, row and sample index.
Xyz place(double x, double y, std::uint64_t sample) {
  return {static_cast<float>(std::floor(x)), static_cast<float>(std::floor(y)), static_cast<float>(sample)};
}

int many_threads(tyndall::WatchOptions options) {
  std::atomic<int> now{0}, most{0};
  options.threads = 3;
  const int code = tyndall::watch(
      64, 64,
      [&](double x, double y, std::uint64_t sample) {
        const int all = ++now;
        for (int seen = most; seen < all && !most.compare_exchange_weak(seen, all);) {
        }
        std::this_thread::sleep_for(std::chrono::microseconds(20));
        --now;
        return place(x, y, sample);
      },
      options);
  std::printf("at most %d at once\n", most.load());
  return code;
}

/// Whether what belongs to the whole process is as it was: rounding, the locale, signals, standard output.
int keeps_process(const tyndall::WatchOptions& options) {
  const auto handler = [](int) {};
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(number, handler);
  std::setlocale(LC_ALL, "C");
  std::fesetround(FE_UPWARD);
  bool rounds = true;
  const int code = tyndall::watch(
      20, 20,
      [&](double, double, std::uint64_t) {
        rounds = rounds && std::fegetround() == FE_UPWARD;
        return Xyz{1, 1, 1};
      },
      options);
  bool signals = true;
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE})
    signals = signals && std::signal(number, SIG_DFL) == handler;
  std::printf("%s %s %s %s\n", rounds ? "rounds" : "-", std::fegetround() == FE_UPWARD ? "still" : "-",
              signals ? "signals" : "-", std::setlocale(LC_ALL, nullptr));
  return code;
}

int slow(const tyndall::WatchOptions& options, double seconds) {
  return tyndall::watch(
      64, 64,
      [&](double x, double y, std::uint64_t sample) {
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        return place(x, y, sample);
      },
      options);
}

int fails(const tyndall::WatchOptions& options, const std::string& how) {
  return tyndall::watch(
      40, 30,
      [&](double x, double y, std::uint64_t sample) {
        if (sample != 2 || std::floor(x) != 3 || std::floor(y) != 4) return Xyz{0.5f, 0.5f, 0.5f};
        if (how == "throws") throw std::runtime_error("no mesh\nhere");
        if (how == "throws-other") throw 5;
        if (how == "nan") return Xyz{1, std::numeric_limits<float>::quiet_NaN(), 1};
        return Xyz{1, 1, std::numeric_limits<float>::infinity()};
      },
      options);
}

}  // namespace

int main(int count, char** arguments) {
  const std::string what = count > 1 ? arguments[1] : "", file = count > 2 ? arguments[2] : "-",
                    more = count > 3 ? arguments[3] : "";
  tyndall::WatchOptions options;
  options.spp = 9;
  options.title = "probe";
  if (file != "-") options.output = file;
  if (what == "colours") return takes_all_colours() ? 0 : 1;
  if (what == "place" || what == "window") {
    if (what == "window") options.spp = 64, options.reference = more;
    return tyndall::watch(40, 30, place, options);
  }
  if (what == "twice") {
    const int first = tyndall::watch(40, 30, place, options);
    if (!options.output.empty()) options.output = "again-" + options.output;
    return first == 0 ? tyndall::watch(40, 30, place, options) : first;
  }
  if (what == "threads") return many_threads(options);
  if (what == "process") return keeps_process(options);
  if (what == "slow") return slow(options, std::atof(more.c_str()));
  if (what == "size") return tyndall::watch(std::atoi(arguments[3]), std::atoi(arguments[4]), place, options);
  if (what == "null") return tyndall_watch(4, 4, nullptr, nullptr, nullptr);
  if (what == "wrong-size") {
    tyndall_watch_options empty = {};
    return tyndall_watch(
        4, 4, [](void*, double, double, std::uint64_t, double*) {}, nullptr, &empty);
  }
  if (what == "silent") {  // never sets the colour
    tyndall_watch_options plain = TYNDALL_WATCH_OPTIONS;
    plain.output = options.output.c_str(), plain.spp = 1;
    return tyndall_watch(
        4, 4, [](void*, double, double, std::uint64_t, double*) {}, nullptr, &plain);
  }
  if (what == "wrong-threads" || what == "wrong-reference") {
    if (what == "wrong-threads")
      options.threads = -1;
    else
      options.reference = "cover";
    return tyndall::watch(4, 4, place, options);
  }
  return fails(options, what);
}
