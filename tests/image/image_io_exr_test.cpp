#include "core/image/image_io.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cctype>
#include <limits>
#include <random>

namespace tyndall::test::image_io_exr_test {
namespace fs = std::filesystem;

namespace {

/// A region of a larger image, with sums of both signs, limbs of every size and all counters in use.
Film wild_film() {
  Film film = make_film(50, 40, {7, 5, 30, 28}, 4'000'000'001u, 0x1p-3);
  std::mt19937_64 engine(5);
  for (FilmPixel& pixel : film.pixels) {
    for (auto& half : pixel.sum) {
      for (ExactSum& sum : half) {
        sum.high = static_cast<std::int64_t>(engine()) >> engine() % 64;
        sum.low = static_cast<std::int64_t>(engine()) >> engine() % 64;
      }
    }
    pixel.taken = static_cast<std::uint32_t>(engine() % 1000 + 100);
    pixel.rejected[0] = static_cast<std::uint32_t>(engine() % 30);
    pixel.rejected[1] = static_cast<std::uint32_t>(engine() % 30);
    pixel.truncated = static_cast<std::uint32_t>(engine());
  }
  film.cut_throughput = {std::numeric_limits<std::int64_t>::max(), -7};
  film.pixels[0].sum[0][0] = {std::numeric_limits<std::int64_t>::min(), -1};
  return film;
}

std::vector<Layer> some_layers(const Film& film) {
  std::vector<Layer> layers = {{"albedo", {"R", "G", "B"}, {}}, {"normal", {"X", "Y", "Z"}, {}}, {"depth", {"Z"}, {}}};
  for (Layer& layer : layers) layer.values.assign(film.pixels.size() * layer.channels.size(), 0.5f);
  return layers;
}

const Embedded notes = {"{\"name\": \"Nebel über Glas\"}", "{\"spp\": 16}"};

/// The bytes of an EXR with a small film.
std::string small_exr(const fs::path& folder) {
  write_exr(folder / "small.exr", make_film(3, 2, {0, 0, 3, 2}, 0, 1), {}, notes);
  return read_text(folder / "small.exr");
}

}  // namespace

TEST_CASE("EXR: a film's emission comes back, bit for bit, and a film without it has none") {
  const fs::path folder = scratch_folder("emission");
  Film film = make_film(5, 4, {1, 0, 5, 3}, 0, 2, true);
  std::mt19937_64 engine(6);
  for (EmissionSums& pixel : film.emission)
    for (auto& half : pixel.sum)
      for (std::int64_t& sum : half) sum = static_cast<std::int64_t>(engine()) >> engine() % 64;
  write_exr(folder / "lamps.exr", film, {}, notes);
  CHECK(read_film(folder / "lamps.exr") == film);
  film.emission.clear();
  write_exr(folder / "none.exr", film, {}, notes);
  CHECK(read_film(folder / "none.exr") == film);
}

TEST_CASE("exr: a build without OpenEXR says so" * doctest::skip(has_openexr())) {
  const fs::path file = scratch_folder("exr_none") / "a.exr";
  const std::string text = "this build has no EXR images (OpenEXR was not found when it was configured)";
  CHECK_THROWS_WITH_AS(write_exr(file, wild_film(), {}, {}), (file.string() + ": cannot write: " + text).c_str(),
                       ImageFileError);
  write_text(file, "\x76\x2f\x31\x01....");
  const std::string cannot_read = file.string() + ": cannot read: " + text;
  CHECK_THROWS_WITH_AS(read_image(file), cannot_read.c_str(), ImageFileError);
  CHECK_THROWS_WITH_AS(read_film(file), cannot_read.c_str(), ImageFileError);
  CHECK_THROWS_WITH_AS(read_embedded_scene(file), cannot_read.c_str(), ImageFileError);
}

TEST_SUITE("exr" * doctest::skip(!has_openexr())) {
  TEST_CASE("exr: the film comes back bit for bit") {
    const fs::path file = scratch_folder("exr_film") / "a.exr";
    const Film film = wild_film();
    write_exr(file, film, some_layers(film), notes);
    const std::optional<Film> back = read_film(file);
    REQUIRE(back.has_value());
    CHECK(*back == film);
  }

  TEST_CASE("exr: the picture is the film's means, of the region's size") {
    const fs::path file = scratch_folder("exr_picture") / "a.exr";
    Film film = make_film(9, 8, {2, 3, 7, 6}, 0, 2);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      add_sample(film.pixels[i], 0, {static_cast<float>(i), 0.1f, -1.5f}, 0.5);
      film.pixels[i].taken = 1;
    }
    write_exr(file, film, {}, {});
    const LinearImage image = read_image(file);
    CHECK(image.width == 5);
    CHECK(image.height == 3);
    CHECK(image.rgb == resolve(film));
  }

  TEST_CASE("exr: carries the scene") {
    const fs::path folder = scratch_folder("exr_scene");
    const Film film = make_film(3, 2, {0, 0, 3, 2}, 0, 1);
    write_exr(folder / "a.exr", film, {}, notes);
    CHECK(read_embedded_scene(folder / "a.exr") == notes.scene);
    write_exr(folder / "b.exr", film, {}, {});
    CHECK_FALSE(read_embedded_scene(folder / "b.exr").has_value());
    const std::string large(3'000'000, 'x');
    write_exr(folder / "c.exr", film, {}, {large, ""});
    CHECK(read_embedded_scene(folder / "c.exr") == large);
  }

  TEST_CASE("exr: the same film gives the same bytes") {
    const fs::path folder = scratch_folder("exr_same");
    const Film film = wild_film();
    write_exr(folder / "a.exr", film, some_layers(film), notes);
    write_exr(folder / "b.exr", film, some_layers(film), notes);
    CHECK(read_text(folder / "a.exr") == read_text(folder / "b.exr"));
  }

  TEST_CASE("exr: says what wrote it and what its colours mean") {
    const std::string bytes = small_exr(scratch_folder("exr_attributes_known"));
    CHECK(bytes.find(std::string("software\0string\0", 16)) != bytes.npos);
    CHECK(bytes.find("Tyndall " TYNDALL_VERSION) != bytes.npos);
    CHECK(bytes.find(std::string("chromaticities\0chromaticities\0", 30)) != bytes.npos);
  }

  TEST_CASE("exr: without its film it has the same picture, scene and layers, and is smaller") {
    const fs::path folder = scratch_folder("exr_lean");
    const Film film = wild_film();
    Embedded lean = notes;
    lean.film = false;
    write_exr(folder / "a.exr", film, some_layers(film), notes);
    write_exr(folder / "b.exr", film, some_layers(film), lean);
    CHECK(read_image(folder / "b.exr").rgb == read_image(folder / "a.exr").rgb);
    CHECK(read_embedded_scene(folder / "b.exr") == notes.scene);
    CHECK_FALSE(read_film(folder / "b.exr").has_value());
    CHECK_FALSE(read_film_label(folder / "b.exr").has_value());
    CHECK(read_text(folder / "b.exr").find("film.") == std::string::npos);
    CHECK(5 * fs::file_size(folder / "b.exr") < fs::file_size(folder / "a.exr"));
  }

  TEST_CASE("exr: layers take 16 bits a value where that is enough, colours always 32") {
    const fs::path folder = scratch_folder("exr_half");
    const Film film = make_film(3, 2, {0, 0, 3, 2}, 0, 1);
    std::vector<Layer> layers = some_layers(film);
    layers[0].half = true;
    write_exr(folder / "a.exr", film, layers, {});
    const std::string bytes = read_text(folder / "a.exr");
    const auto type_of = [&](const std::string& channel) {
      return static_cast<int>(bytes[bytes.find('\0' + channel + '\0') + channel.size() + 2]);
    };
    CHECK(type_of("albedo.G") == 1);
    CHECK(type_of("normal.X") == 2);
    CHECK(type_of("G") == 2);
  }

  TEST_CASE("exr: no film in other images") {
    const fs::path file = scratch_folder("exr_other") / "a.pfm";
    write_pfm(file, {1, 1, {1, 2, 3}});
    CHECK_FALSE(read_film(file).has_value());
    CHECK_THROWS_AS(read_film(file.parent_path() / "none.exr"), ImageFileError);
  }

  TEST_CASE("exr: a film that contradicts itself is refused") {
    const fs::path folder = scratch_folder("exr_contradiction");
    Film film = make_film(3, 2, {0, 0, 3, 2}, 0, 1);
    film.pixels[4].taken = 3;
    film.pixels[4].rejected[1] = 2;
    write_exr(folder / "a.exr", film, {}, {});
    CHECK_THROWS_WITH_AS(
        read_film(folder / "a.exr"),
        ((folder / "a.exr").string() + ": cannot read: its film is damaged: its counts contradict each other").c_str(),
        ImageFileError);
    CHECK(read_image(folder / "a.exr").width == 3);  // the picture itself is well
    film = make_film(3, 2, {0, 0, 3, 2}, 4294967295u, 1);
    film.pixels[0].taken = 1;
    write_exr(folder / "a.exr", film, {}, {});
    CHECK_THROWS_AS(read_film(folder / "a.exr"), ImageFileError);
  }

  TEST_CASE("exr: damaged attributes and channels are refused by name") {
    const fs::path folder = scratch_folder("exr_attributes");
    const std::string good = small_exr(folder);
    const auto message = [&](const std::string& from, const std::string& to) -> std::string {
      std::string bytes = good;
      bytes.replace(bytes.find(from), from.size(), to);
      write_text(folder / "a.exr", bytes);
      try {
        read_film(folder / "a.exr");
      } catch (const ImageFileError& error) {
        return std::string(error.what()).substr((folder / "a.exr").string().size());
      }
      return "none";
    };
    CHECK(message("tyndall:unit", "tyndall:Unit") == ": cannot read: its film is damaged: no tyndall:unit");
    CHECK(message("film.B.G.low1", "film.B.G.lowX") ==
          ": cannot read: its film is damaged: no channel film.B.G.low1 of type uint");
    CHECK(message("film.taken", "film.Taken") == "none");  // another program's channels: no film
    const std::string quantum("tyndall:unit\0double\0\x08\0\0\0", 24);
    CHECK(message(quantum + std::string(6, '\0') + "\xf0\x3f", quantum + std::string(6, '\0') + "\xf8\x3f") ==
          ": cannot read: its film is damaged: tyndall:unit is no power of two");
    const std::string cut("tyndall:cut_throughput\0string\0\3\0\0\0", 34);
    CHECK(message(cut + "0 0", cut + "0 x") == ": cannot read: its film is damaged: tyndall:cut_throughput is no sum");
    const std::string width("tyndall:width\0int\0\4\0\0\0", 22);
    CHECK(message(width + '\3', width + '\2') ==
          ": cannot read: its film is damaged: its data window is not within the image");
  }

  TEST_CASE("exr: a film with a bit that has flipped anywhere is refused, or still the same") {
    const fs::path folder = scratch_folder("exr_bits");
    const Film film = wild_film();
    write_exr(folder / "a.exr", film, {}, notes);
    const std::string good = read_text(folder / "a.exr");
    const std::size_t names = good.find("channels"), header = good.find("tyndall:scene") + 60;
    std::mt19937 engine(8);
    int refused = 0;
    for (int round = 0; round < 600; ++round) {
      std::string bytes = good;
      const std::size_t reach = round % 2 == 0 ? good.size() : header;
      std::size_t at = engine() % reach;
      // Without their names, film and checksum would be another program's business.
      if (round % 2 == 1 && at < header && at >= names && std::isalpha(static_cast<unsigned char>(bytes[at]))) continue;
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << engine() % 8));
      write_text(folder / "b.exr", bytes);
      try {
        const std::optional<Film> back = read_film(folder / "b.exr");
        if (back) REQUIRE(*back == film);
      } catch (const ImageFileError&) {
        ++refused;
      }
    }
    CHECK(refused > 200);
  }
}

}  // namespace tyndall::test::image_io_exr_test
