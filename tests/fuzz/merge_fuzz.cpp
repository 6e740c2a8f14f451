// Merging: the input describes films of 2 x 2 pixels, 6 bytes each. What is merged has just the samples of all parts.
#include "core/film/film.h"
#include "tests/fuzz/fuzz_input.h"

#include <numeric>

using namespace tyndall;

namespace {

FilmPart part_of(const std::uint8_t* bytes) {
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<FilmPart> parts;
  for (; size >= 6 && parts.size() < 20; data += 6, size -= 6) parts.push_back(part_of(data));
  if (parts.empty()) return 0;
  fuzz::survives<MergeError>([&] {
    const Film film = merge(parts, [&](std::size_t part) { return parts[part].film; });
    std::uint64_t samples = 0;
    for (const FilmPart& part : parts) samples += samples_of(part.film);
    if (samples_of(film) != samples) std::abort();
  });
  return 0;
}
