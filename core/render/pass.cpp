#include "core/render/pass.h"

#include "core/film/groups.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace tyndall {
namespace {

constexpr int max_tile = 64;  // kernels take at most max_tile² pixels (max_tile_pixels)

/// Edge of tiles whose tile jobs have about `paths` paths: a multiple of `minimum`.
int chosen_tile(double paths, std::uint32_t samples, int step, int minimum) {
  const double pixels = paths * step * step / std::max(1u, samples);
  return std::clamp(static_cast<int>(std::sqrt(pixels)) / minimum * minimum, minimum, max_tile);
}

int rounded_down(int at, int step) { return at / step * step; }
int divided_up(int quantity, int step) { return (quantity + step - 1) / step; }

/// Calls visit(x, y, i) for the pixels of a tile whose x and y are multiples of step; i: index within the tile.
template <class Visit>
void for_each_pixel(const Region& tile, int step, const Visit& visit) {
  for (int y = divided_up(tile.y0, step) * step; y < tile.y1; y += step)
    for (int x = divided_up(tile.x0, step) * step; x < tile.x1; x += step)
      visit(x, y, static_cast<std::size_t>((y - tile.y0) * tile.width() + x - tile.x0));
}

/// The memory in which a tile job gathers its samples. Pixels that the job does not sample hold leftovers: where only
/// every 8th pixel is sampled, clearing all of them would take far longer than sampling.
struct TileBuffer {
  std::vector<FilmPixel> pixels;
  std::vector<EmissionSums> emission;
  std::vector<std::uint32_t> first, last;  ///< see list_lacking

  void clear(const Region& tile, int step, bool with_emission) {
    const std::size_t size = static_cast<std::size_t>(tile.width()) * static_cast<std::size_t>(tile.height());
    pixels.resize(std::max(pixels.size(), size));
    emission.resize(with_emission ? pixels.size() : 0);
    for_each_pixel(tile, step, [&](int, int, std::size_t i) {
      pixels[i] = {};
      if (with_emission) emission[i] = {};
    });
  }
};

/// The buffer of a thread, kept from job to job: after its first job a thread allocates nothing.
TileBuffer& own_buffer() {
  std::shared_ptr<void>& memory = thread_pool_memory();
  if (!memory) memory = std::make_shared<TileBuffer>();
  return *static_cast<TileBuffer*>(memory.get());
}

/// Number of wanted samples that the pixels of a part lack, on average.
std::uint32_t mean_lack(const Film& film, const std::vector<std::uint32_t>& wanted, const Region& part) {
  std::uint64_t sum = 0;
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x) {
      const std::size_t i = film.index(x, y);
      sum += wanted[i] - std::min(wanted[i], film.pixels[i].taken);
    }
  return static_cast<std::uint32_t>(sum / static_cast<std::uint64_t>(std::int64_t{part.width()} * part.height()));
}

/// Fills in the first and last sample of the next tile job, for each pixel of a tile. Pixels that lack samples get so
/// many that the job has about `paths` paths. Returns false if no pixel lacks any.
bool list_lacking(const Film& film, const std::vector<std::uint32_t>& wanted, const Region& tile, double paths,
                  std::vector<std::uint32_t>& first, std::vector<std::uint32_t>& last) {
  first.clear(), last.clear();
  std::uint32_t lacking = 0, deepest = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const std::size_t i = film.index(x, y);
      first.push_back(film.first_sample + film.pixels[i].taken);
      last.push_back(std::max(first.back(), film.first_sample + wanted[i]));
      lacking += last.back() > first.back();
      deepest = std::max(deepest, last.back() - first.back());
    }
  if (lacking == 0) return false;
  const std::uint32_t maximum = std::max(static_cast<std::uint32_t>(paths) / lacking, 1u);
  if (deepest > maximum + maximum / 2)  // else this job takes all, so that no small rest is left over
    for (std::size_t i = 0; i < last.size(); ++i) last[i] = std::min(last[i], first[i] + maximum);
  return true;
}

}  // namespace

Kernels kernels_of(const std::string& isa) {
  if (const auto kernels = choose_kernels(isa)) return *kernels;
  throw std::invalid_argument("no kernel for instruction set \"" + isa + "\"");
}

Pass::Pass(Region region, std::uint32_t first, std::uint32_t last, int step, int skip_step, Tiling tiling)
    : region_(region), first_(first), last_(last), step_(step), skip_step_(skip_step) {
  cut(tiling, last - first);
}

Pass::Pass(const Film& film, std::vector<std::uint32_t> wanted, const Region& part, Tiling tiling)
    : region_(part), wanted_(std::move(wanted)) {
  cut(tiling, mean_lack(film, wanted_, part));
}

void Pass::cut(Tiling tiling, std::uint32_t samples) {
  // Coarse passes sample every 8th pixel. A tile job that cuts a block of groups in two traces all of it twice.
  const int minimum = tiling.any_edge ? step_ : tiling.reuses_paths ? std::max(block_width, block_height) : 8;
  paths_per_tile_ = tiling.paths;
  tile_ = tiling.edge > 0 ? std::min(tiling.edge, max_tile) : chosen_tile(tiling.paths, samples, step_, minimum);
  left_ = rounded_down(region_.x0, tiling.reuses_paths ? block_width : 1);
  top_ = rounded_down(region_.y0, tiling.reuses_paths ? block_height : 1);
  columns_ = divided_up(region_.x1 - left_, tile_);
  rows_ = divided_up(region_.y1 - top_, tile_);
  done_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

Region Pass::tile(int index) const {
  const int x = left_ + index % columns_ * tile_, y = top_ + index / columns_ * tile_;
  return {std::max(x, region_.x0), std::max(y, region_.y0), std::min(x + tile_, region_.x1),
          std::min(y + tile_, region_.y1)};
}

bool Pass::run(const RenderEngine& engine, Film& film, const std::atomic<bool>& give_up,
               const std::function<void()>& poll) {
  const auto job = [&](int index) {
    auto& done = done_[static_cast<std::size_t>(index)];
    if (done || give_up.load(std::memory_order_relaxed)) return;
    done = wanted_.empty() ? run_job({tile(index), step_, skip_step_, first_, last_}, engine, film)
                           : fill_tile(index, engine, film, give_up);
  };
  engine.thread_pool.for_each(columns_ * rows_, job, poll);
  film.cut_throughput.add(ExactSum{cut_high_.exchange(0), cut_low_.exchange(0)});
  return std::all_of(done_.begin(), done_.end(), [](std::uint8_t d) { return d != 0; });
}

/// Runs units until the tile's pixels have what is wanted. False if `give_up` was set before.
bool Pass::fill_tile(int index, const RenderEngine& engine, Film& film, const std::atomic<bool>& give_up) {
  TileBuffer& buffer = own_buffer();
  const Region where = tile(index);
  for (;;) {
    if (!list_lacking(film, wanted_, where, paths_per_tile_, buffer.first, buffer.last)) return true;
    if (give_up.load(std::memory_order_relaxed)) return false;
    if (!run_job({where, 1, 0, 0, 0, buffer.first.data(), buffer.last.data()}, engine, film)) return false;
  }
}

/// Adds the samples of a tile job to the film; its first ones replace what the pixels held. False if a source of
/// samples has left the job.
bool Pass::run_job(const TileJob& job, const RenderEngine& engine, Film& film) {
  TileBuffer& buffer = own_buffer();
  buffer.clear(job.tile, job.step, !film.emission.empty());
  TileCounts counts;
  EmissionSums* const emission = buffer.emission.empty() ? nullptr : buffer.emission.data();
  if (!engine.render_tile(job, film.quantum, buffer.pixels.data(), counts, emission)) return false;
  const bool replace = !job.first_of && job.first == film.first_sample;
  std::uint64_t paths = 0, rejected = 0, truncated = 0;
  for_each_pixel(job.tile, job.step, [&](int x, int y, std::size_t i) {
    const FilmPixel& from = buffer.pixels[i];
    if (!from.taken) return;
    paths += from.taken, rejected += from.rejected[0] + from.rejected[1], truncated += from.truncated;
    FilmPixel& to = film.at(x, y);
    if (replace) to = {};
    add_pixel(to, from);
    if (!emission) return;
    EmissionSums& sums = film.emission[film.index(x, y)];
    if (replace) sums = {};
    add_emission(sums, emission[i]);
  });
  paths_.fetch_add(paths, std::memory_order_relaxed);
  rejected_.fetch_add(rejected, std::memory_order_relaxed);
  truncated_.fetch_add(truncated, std::memory_order_relaxed);
  rays_.fetch_add(counts.rays, std::memory_order_relaxed);
  shadow_rays_.fetch_add(counts.shadow_rays, std::memory_order_relaxed);
  splits_.fetch_add(counts.splits, std::memory_order_relaxed);
  cut_high_.fetch_add(counts.cut_throughput.high, std::memory_order_relaxed);
  cut_low_.fetch_add(counts.cut_throughput.low, std::memory_order_relaxed);
  return true;
}

}  // namespace tyndall
