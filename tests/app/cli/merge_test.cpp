#include "app/cli/requests.h"
#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/support/scratch.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

namespace tyndall::test::merge_test {
namespace fs = std::filesystem;

namespace {

/// What the films of a set have in common, and one of them may have otherwise.
struct Shard {
  std::uint32_t first = 0, last = 4;
  int width = 6;
  std::string seed = "0", radius = "1", sampler = "sobol", adaptive = "false", version = "1.0";
  std::string isa = "scalar";
  bool with_film = true;
};

std::string scene_of(const Shard& shard) {
  return R"({"tyndall": 1, "image": {"width": )" + std::to_string(shard.width) +
         R"(, "height": 5}, "render": {"seed": )" + shard.seed + R"(, "sampler": ")" + shard.sampler +
         R"(", "adaptive": )" + shard.adaptive +
         R"(}, "materials": {"m": {"type": "lambertian", "albedo": [1, 1, 1]}}, "objects": [{"type": "sphere",
         "center": [0, 0, 0], "radius": )" +
         shard.radius + R"(, "material": "m"}]})";
}

fs::path write_shard(const fs::path& file, const Shard& shard) {
  Film film = make_film(shard.width, 5, {0, 0, shard.width, 5}, shard.first, 2);
  for (FilmPixel& pixel : film.pixels) {
    for (std::uint32_t i = shard.first; i < shard.last; ++i)
      add_sample(pixel, i & 1u, {0.25f * static_cast<float>(i % 7), 0.5f, 1}, 1 / film.quantum);
    pixel.taken = shard.last - shard.first;
  }
  write_exr(file, film, {}, {scene_of(shard), "", {shard.version, shard.isa, false}, shard.with_film});
  return file;
}

/// Files of samples 0:24 in shards of random sizes.
std::vector<fs::path> write_set(const fs::path& folder, std::mt19937& random) {
  std::vector<fs::path> files;
  for (std::uint32_t from = 0, to = 0; from < 24; from = to) {
    to = std::min<std::uint32_t>(24, from + 2 + static_cast<std::uint32_t>(random() % 5));
    Shard shard;
    shard.first = from, shard.last = to;
    files.push_back(write_shard(folder / (std::to_string(from) + "-" + std::to_string(to) + ".exr"), shard));
  }
  return files;
}

/// What merging says; "": it was done.
std::string problem_of(const std::vector<fs::path>& parts, const fs::path& output) {
  CommandRequest command;
  for (const auto& part : parts) command.operands.push_back(part.string());
  command.outputs = {output};
  try {
    const int code = run_merge(command);
    REQUIRE(code == 0);
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

/// Whether the message names the file.
bool names(const std::string& message, const fs::path& file) {
  const std::size_t at = message.find(file.filename().string());
  return at != message.npos;
}

struct WrongSet {
  std::string kind;
  std::vector<fs::path> parts;
  fs::path wrong;           ///< the message names it
  bool names_both = false;  ///< and one of the others
};

/// What one shard has otherwise.
struct Change {
  const char* kind;
  void (*make)(Shard&);
  bool names_both = true;
};
const Change changes[] = {{"overlap", [](Shard& shard) { shard.first -= 1; }},
                          {"scene", [](Shard& shard) { shard.radius = "2"; }},
                          {"seed", [](Shard& shard) { shard.seed = "1"; }},
                          {"size", [](Shard& shard) { shard.width = 7; }},
                          {"version", [](Shard& shard) { shard.version = "0.9"; }},
                          {"sampler", [](Shard& shard) { shard.sampler = "random"; }},
                          {"adaptive", [](Shard& shard) { shard.adaptive = "true"; }, false},
                          {"film", [](Shard& shard) { shard.with_film = false; }, false},
                          {"gap", [](Shard& shard) { shard.last -= 1; }}};
constexpr int kinds = static_cast<int>(std::size(changes)) + 4;

/// A set of which one shard is wrong, in the way of that number: a copy of a right one, with a change.
WrongSet wrong_set(const std::vector<fs::path>& right, const fs::path& folder, int kind, std::mt19937& random) {
  WrongSet set{"", {}, {}, true};
  for (const fs::path& file : right) {
    set.parts.push_back(folder / file.filename());
    fs::copy_file(file, set.parts.back());
  }
  const std::size_t at = 1 + random() % (set.parts.size() - 2);
  const std::string name = set.parts[at].filename().string();
  Shard shard;
  shard.first = static_cast<std::uint32_t>(std::stoul(name));
  shard.last = static_cast<std::uint32_t>(std::stoul(name.substr(name.find('-') + 1)));
  set.wrong = set.parts[at];
  const auto damage = [&](const char* text, auto change) {
    set.kind = text;
    set.names_both = false;
    std::string bytes = read_text(set.wrong);
    change(bytes);
    write_text(set.wrong, bytes);
  };
  if (kind >= 4) {
    const Change& change = changes[kind - 4];
    change.make(shard);
    write_shard(set.wrong, shard);
    set.kind = change.kind;
    set.names_both = change.names_both;
    if (set.kind == "gap") set.wrong = set.parts[at + 1];
  } else if (kind == 3) {
    set.kind = "duplicate";
    set.parts.push_back(folder / "again.exr");
    fs::copy_file(set.wrong, set.parts.back());
  } else if (kind == 2) {
    set.kind = "gap";
    set.parts.erase(set.parts.begin() + static_cast<std::ptrdiff_t>(at));
    set.wrong = set.parts[at];
  } else if (kind == 1) {
    damage("cut", [&](std::string& bytes) { bytes.resize(1 + random() % (bytes.size() - 1)); });
  } else {  // in the film's text or in its pixels, behind the attributes that say nothing of it
    damage("flipped", [&](std::string& bytes) {
      const std::size_t from = bytes.find("film.taken"), place = from + 200 + random() % (bytes.size() - from - 200);
      bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
    });
  }
  std::shuffle(set.parts.begin(), set.parts.end(), random);
  return set;
}

}  // namespace

TEST_SUITE("merge command" * doctest::skip(!has_openexr())) {
  TEST_CASE("merge: sets with a wrong shard are refused, with its name and that of another") {
    std::mt19937 random(21);
    std::vector<std::vector<fs::path>> right;
    for (int i = 0; i < 5; ++i) right.push_back(write_set(scratch_folder("merge_right" + std::to_string(i)), random));
    const int sets = thorough() ? 200 : 60;
    int refused = 0, harmless = 0;
    for (int round = 0; refused < sets; ++round) {
      const fs::path folder = scratch_folder("merge_wrong"), output = folder / "m.pfm";
      const WrongSet set = wrong_set(right[random() % right.size()], folder, round % kinds, random);
      const std::string message = problem_of(set.parts, output);
      CAPTURE(set.kind);
      CAPTURE(message);
      if (message.empty()) {  // a bit that is not of the film
        REQUIRE(set.kind == "flipped");
        ++harmless;
        continue;
      }
      ++refused;
      REQUIRE_FALSE(fs::exists(output));
      const bool other = std::any_of(set.parts.begin(), set.parts.end(),
                                     [&](const fs::path& f) { return f != set.wrong && names(message, f); });
      if (set.kind == "duplicate")
        REQUIRE((names(message, set.wrong) || names(message, "again.exr")));
      else
        REQUIRE(names(message, set.wrong));
      if (set.names_both) REQUIRE(other);
    }
    CHECK(harmless < 16);
  }

  TEST_CASE("merge: shards of several instruction sets are merged, and say so; an old one without a version fits all") {
    const fs::path folder = scratch_folder("merge_mixed");
    std::vector<fs::path> parts;
    for (std::uint32_t i = 0; i < 3; ++i) {
      Shard shard;
      shard.first = 2 * i, shard.last = 2 * i + 2;
      shard.isa = i == 1 ? "avx2" : "scalar";
      if (i == 0) shard.version.clear();
      parts.push_back(write_shard(folder / (std::to_string(i) + ".exr"), shard));
    }
    do {
      CHECK(problem_of(parts, folder / "m.exr").empty());
      CHECK(read_film_label(folder / "m.exr")->isa == "several: avx2, scalar");
    } while (std::next_permutation(parts.begin(), parts.end()));
  }
}

}  // namespace tyndall::test::merge_test
