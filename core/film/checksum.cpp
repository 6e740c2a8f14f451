#include "core/film/checksum.h"

#include <bit>
#include <cstring>

namespace tyndall {
namespace {

/// Mixes in 8 bytes at a time. Each step is invertible, so that films that differ in one word always get different
/// sums. Four sums in turn, so that the processor can start the next multiplication before the last one is done.
class Checksum {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const char*>(data);
    for (; size >= 32; bytes += 32, size -= 32) {
      std::uint64_t words[4];
      std::memcpy(words, bytes, sizeof words);
      for (int i = 0; i < 4; ++i) mix(sums_[i], words[i]);
    }
    for (; size > 0; ++bytes, --size) mix(sums_[0], static_cast<unsigned char>(*bytes));
  }
  template <class Number>
  void add_number(Number number) {
    mix(sums_[1], static_cast<std::uint64_t>(number));
  }
  std::uint64_t value() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t part : sums_) mix(sum, part);
    return sum;
  }

 private:
  static void mix(std::uint64_t& sum, std::uint64_t word) {
    sum = (sum ^ word) * 0x9e3779b97f4a7c15u;  // odd, so that the step is invertible
    sum ^= sum >> 29;
  }

  std::uint64_t sums_[4] = {1, 2, 3, 4};
};

}  // namespace

std::uint64_t film_checksum(const Film& film, std::string_view text) {
  Checksum sum;
  const Region& r = film.region;
  for (const int number : {film.width, film.height, r.x0, r.y0, r.x1, r.y1}) sum.add_number(number);
  sum.add_number(film.first_sample);
  sum.add_number(std::bit_cast<std::uint64_t>(film.quantum));
  sum.add_number(film.cut_throughput.high);
  sum.add_number(film.cut_throughput.low);
  sum.add_number(film.emission.size());
  sum.add_number(film.planned.size());
  sum.add_number(text.size());
  sum.add(film.pixels.data(), film.pixels.size() * sizeof(FilmPixel));
  sum.add(film.emission.data(), film.emission.size() * sizeof(EmissionSums));
  sum.add(film.planned.data(), film.planned.size() * sizeof(PlannedSamples));
  sum.add(text.data(), text.size());
  return sum.value();
}

}  // namespace tyndall
