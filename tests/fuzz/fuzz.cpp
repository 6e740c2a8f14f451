// The target for libFuzzer. The variable TYNDALL_FUZZ names what reads the bytes: it must neither crash nor hang, and
// the only exceptions that may come out are those for users, with one line of text.
#include "app/cli/requests.h"
#include "app/text/values.h"
#include "core/accuracy/error.h"
#include "core/film/film.h"
#include "core/image/image_io.h"
#include "core/scene/load.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// Bytes as a file that lies in memory only.
class MemoryFile {
 public:
  explicit MemoryFile(Bytes bytes) : descriptor_(memfd_create("fuzz", 0)) {
    if (descriptor_ < 0 || ::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
      std::abort();
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// Runs a reader. Error: the exception that it may throw.
template <class Error, class Read>
void survives(Read read) {
  try {
    read();
  } catch (const Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
}

std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// Command lines: each line of the input is an argument.
void read_arguments(Bytes bytes) {
  std::vector<std::string> arguments;
  std::istringstream in{std::string(text_of(bytes))};
  for (std::string line; std::getline(in, line);) arguments.push_back(line);
  survives<UsageError>([&] { read_command(arguments); });
}

/// The measures of compare, on images of any finite or other values: the input is a width and floats.
void compare_images(Bytes bytes) {
  if (bytes.empty()) return;
  const std::size_t width = 1 + bytes[0] % 16, row = 3 * width, floats = (bytes.size() - 1) / sizeof(float) / 2;
  const std::size_t height = floats / row;
  if (height == 0) return;
  std::vector<float> a(row * height), b(row * height);
  std::memcpy(a.data(), bytes.data() + 1, a.size() * sizeof(float));
  std::memcpy(b.data(), bytes.data() + 1 + a.size() * sizeof(float), b.size() * sizeof(float));
  image_error(a, b);
  for (const float value : flip_map(a, b, static_cast<int>(width), static_cast<int>(height)))
    if (value < 0 || value > 1.001f) std::abort();
}

/// Films in EXR files: the label, the frame and the film itself, which is then added to another one and drawn.
void read_films(Bytes bytes) {
  const MemoryFile file(bytes);
  survives<ImageFileError>([&] { read_film_label(file.path()); });
  survives<ImageFileError>([&] { read_film_frame(file.path()); });
  survives<ImageFileError>([&] { read_embedded_stats(file.path()); });
  survives<ImageFileError>([&] {
    std::optional<Film> film = read_film(file.path());
    if (!film) return;
    Film next = make_film(film->width, film->height, film->region, 4, film->quantum, !film->emission.empty());
    for (FilmPixel& pixel : next.pixels) pixel.taken = 3;
    const std::vector<FilmPart> parts = {{"fuzz", *film}, {"next", next}};
    survives<MergeError>([&] { resolve(merge(parts, [&](std::size_t i) { return parts[i].film; })); });
  });
}

/// Images of all formats, by their first bytes: PNG, PPM, JPEG, PFM, HDR, EXR, BMP, TGA.
void read_images(Bytes bytes) {
  const MemoryFile file(bytes);
  survives<ImageFileError>([&] {
    const LinearImage image = read_image(file.path());
    if (image.rgb.size() != 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
      std::abort();
  });
  survives<ImageFileError>([&] { read_image(file.path().string() + ":a"); });  // a layer, where it has one
  survives<ImageFileError>([&] { read_texture(file.path()); });
  survives<ImageFileError>([&] { read_embedded_scene(file.path()); });
}

FilmPart part_of(Bytes bytes) {
  const std::uint32_t first = bytes[0] % 8u == 7u ? 0xfffffff0u + bytes[1] % 16u : bytes[1];
  const double quantum = (bytes[2] & 1u) != 0 ? 2 : 1;
  const int right = (bytes[2] & 2u) != 0 ? 3 : 2;
  Film film = make_film(3, 3, {right - 2, 0, right, 2}, first, quantum, (bytes[2] & 4u) != 0);
  for (FilmPixel& pixel : film.pixels) pixel.taken = bytes[3];
  film.pixels[bytes[4] % 4].taken = bytes[5];
  return {std::to_string(first), std::move(film)};
}

std::uint64_t samples_of(const Film& film) {
  return std::accumulate(film.pixels.begin(), film.pixels.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const FilmPixel& pixel) { return sum + pixel.taken; });
}

/// The input describes films of 2 x 2 pixels, 6 bytes each. What is merged has just the samples of all parts.
void merge_films(Bytes bytes) {
  std::vector<FilmPart> parts;
  for (; bytes.size() >= 6 && parts.size() < 20; bytes = bytes.subspan(6)) parts.push_back(part_of(bytes));
  if (parts.empty()) return;
  survives<MergeError>([&] {
    const Film film = merge(parts, [&](std::size_t part) { return parts[part].film; });
    std::uint64_t samples = 0;
    for (const FilmPart& part : parts) samples += samples_of(part.film);
    if (samples_of(film) != samples) std::abort();
  });
}

/// What is read can be written, and reads again as the same scene.
void read_scenes(Bytes bytes) {
  survives<SceneError>([&] {
    const Scene scene = read_scene(text_of(bytes), "fuzz", "/nowhere");
    if (!(read_scene(write_scene(scene), "again", "/nowhere") == scene)) std::abort();
  });
}

/// --set POINTER=VALUE: the input is a line with an override, then another.
void set_values(Bytes bytes) {
  const std::string_view text = text_of(bytes), first = text.substr(0, text.find('\n'));
  const std::string_view second = first.size() < text.size() ? text.substr(first.size() + 1) : std::string_view();
  std::vector<Override> overrides;
  survives<UsageError>([&] {
    for (const std::string_view one : {first, second}) overrides.push_back(read_override(std::string(one)));
  });
  const std::string_view scene = R"({"tyndall": 1, "camera": {"vfov": 40}, "materials": {"white": {"type": "lambertian",
    "albedo": [0.7, 0.7, 0.7]}}, "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "white"}]})";
  survives<SceneError>([&] { read_scene(scene, "fuzz", "/nowhere", overrides); });
}

struct Reader {
  const char* name;
  void (*read)(Bytes);
};
constexpr Reader readers[] = {
    {"arguments", read_arguments}, {"compare", compare_images}, {"film", read_films}, {"image", read_images},
    {"merge", merge_films},        {"scene", read_scenes},      {"set", set_values}};

const Reader& chosen() {
  const char* name = std::getenv("TYNDALL_FUZZ");
  const auto* found = std::find_if(std::begin(readers), std::end(readers),
                                   [&](const Reader& reader) { return name && std::strcmp(reader.name, name) == 0; });
  if (found == std::end(readers)) std::abort();
  return *found;
}

}  // namespace
}  // namespace tyndall

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tyndall::Reader& reader = tyndall::chosen();
  reader.read({data, size});
  return 0;
}
