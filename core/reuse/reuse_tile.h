#pragma once
#include "core/reuse/reuse.h"
#include "core/transport/path.h"

/// Renders a tile job with reuse of second vertices: see reuse.h.
namespace tyndall {

TYNDALL_INLINE int block_start(int at, int size) { return at / size * size; }

/// Enumerates the groups that hold samples of a tile job, as many at a time as ReusedPaths hold.
class ReuseGroups {
 public:
  TYNDALL_INLINE ReuseGroups(const SceneView& s, const TileJob& job)
      : job_(job),
        width_(s.width),
        height_(s.height),
        x_(block_start(job.tile.x0, block_width)),
        y_(block_start(job.tile.y0, block_height)) {
    if (job.tile.x0 >= job.tile.x1) y_ = job.tile.y1;
    enter_block();
  }

  /// Fills in the next groups. Returns false if there are none left.
  TYNDALL_INLINE bool next(ReusedPaths& paths) {
    paths.clear();
    paths.groups = 0;
    while (paths.groups < ReusedPaths::max_groups && y_ < job_.tile.y1) {
      add_group(paths);
      advance();
    }
    return paths.groups > 0;
  }

 private:
  TYNDALL_INLINE void advance() {
    if (++group_ < group_spacing * group_spacing) return;
    group_ = 0;
    if (++index_ < last_) return;
    x_ += block_width;
    if (x_ >= job_.tile.x1) x_ = block_start(job_.tile.x0, block_width), y_ += block_height;
    enter_block();
  }

  /// Sets the range of sample indices that any pixel of the block wants.
  TYNDALL_INLINE void enter_block() {
    index_ = job_.first, last_ = job_.last;
    if (!job_.first_of) return;
    index_ = ~0u, last_ = 0;
    for (int y = y_; y < y_ + block_height; ++y)
      for (int x = x_; x < x_ + block_width; ++x) {
        if (!in_tile(x, y)) continue;
        const int i = place(x, y);
        if (job_.first_of[i] >= job_.last_of[i]) continue;
        if (job_.first_of[i] < index_) index_ = job_.first_of[i];
        if (job_.last_of[i] > last_) last_ = job_.last_of[i];
      }
  }

  TYNDALL_INLINE int place(int x, int y) const {
    return (y - job_.tile.y0) * (job_.tile.x1 - job_.tile.x0) + x - job_.tile.x0;
  }

  TYNDALL_INLINE bool in_tile(int x, int y) const {
    return x >= job_.tile.x0 && x < job_.tile.x1 && y >= job_.tile.y0 && y < job_.tile.y1;
  }

  TYNDALL_INLINE bool wants(int x, int y) const {
    if (!in_tile(x, y)) return false;
    if (!job_.first_of) return true;
    const int i = place(x, y);
    return index_ >= job_.first_of[i] && index_ < job_.last_of[i];
  }

  /// Adds the group if some of its pixels want the current sample.
  TYNDALL_INLINE void add_group(ReusedPaths& paths) {
    if (index_ >= last_) return;
    const int left = x_ + group_ % group_spacing, top = y_ + group_ / group_spacing, at = paths.groups;
    bool wanted = false;
    for (int k = 0; k < group_size; ++k) {
      const int x = left + k % group_columns * group_spacing, y = top + k / group_columns * group_spacing;
      const bool wants_this = wants(x, y);
      wanted = wanted || wants_this;
      const int slot = k * ReusedPaths::max_groups + at;
      paths.pixel[slot] = wants_this                  ? place(x, y)
                          : x < width_ && y < height_ ? ReusedPaths::unwanted
                                                      : ReusedPaths::outside;
    }
    if (!wanted) return;
    paths.x[at] = left, paths.y[at] = top, paths.index[at] = index_;
    ++paths.groups;
  }

  const TileJob& job_;
  int width_, height_;                  ///< of the picture
  int x_, y_;                           ///< upper left corner of the block
  int group_ = 0;                       ///< index within the block
  std::uint32_t index_ = 0, last_ = 0;  ///< current sample; end of the range that the block wants
};

/// 1 / throughput (brightest channel) with which a path came to its second vertex.
TYNDALL_INLINE float over_carried(const ReusedPaths& reused, int slot) {
  const float x = reused.albedo[0][slot], y = reused.albedo[1][slot], z = reused.albedo[2][slot];
  const float maximum = x > y ? x : y;
  return 1 / (maximum > z ? maximum : z);
}

/// The samples of the groups, in the order in which lanes take them, and the end of their paths: see AloneSamples.
class GroupSamples {
 public:
  TYNDALL_INLINE GroupSamples(ReusedPaths& reused, SubpixelLights in_rows, const TileFilm& film)
      : shared_(reused), subpixel_lights_(in_rows), film_(film) {
    skip();
  }
  TYNDALL_INLINE bool empty() const { return member_ == group_size; }
  TYNDALL_INLINE const SubpixelLights& subpixel_lights() const { return subpixel_lights_; }
  TYNDALL_INLINE const ReusedPaths& reused() const { return shared_; }
  /// Fills lanes with the next samples, as long as there are any.
  template <int lanes>
  TYNDALL_INLINE void take(CameraSamples<lanes>& to) {
    for (int& k = to.count; k < lanes && !empty(); ++k) {
      to.x[k] = shared_.x[group_] + member_ % group_columns * group_spacing;
      to.y[k] = shared_.y[group_] + member_ / group_columns * group_spacing;
      to.index[k] = shared_.index[group_], to.slot[k] = member_ * ReusedPaths::max_groups + group_;
      ++group_;
      skip();
    }
  }

  template <class F>
  TYNDALL_INLINE void on_event(const auto& s, Paths<F>& p, const Event<F>& e, MaskOf<F> met) {
    const auto second =
        mask_and(mask_and(met, is_diffuse(s, e)), mask_and(equal(p.depth, IntOf<F>(1)), mask_from_bits<F>(p.first)));
    if (any(second)) note_second(s, p, e, second, shared_), p.second |= bits(second);
  }
  /// Exempts paths from roulette at their first vertex, so that their second vertex can be reused.
  template <class F>
  TYNDALL_INLINE MaskOf<F> on_scatter(const auto& s, Paths<F>& p, const Event<F>& e, MaskOf<F> scattering) {
    const auto first = mask_and(mask_and(scattering, is_diffuse(s, e)), equal(p.depth, IntOf<F>(0)));
    if (any(first)) note_first(s, p, e, first, shared_), p.first |= bits(first);
    return first;
  }
  template <class F>
  TYNDALL_INLINE IntOf<F> slot_of(const Paths<F>& p) const {
    return select(mask_from_bits<F>(p.second), p.slot + IntOf<F>(leaves_second), p.slot);
  }

  /// Stores what the paths in the lanes `ended` have gathered.
  template <class F>
  TYNDALL_INLINE void on_end(const auto& s, const Paths<F>& p, std::uint32_t ended, std::uint32_t cut) {
    if (!ended) return;
    const Vec3<F> gathered = weighed(s, p, p.radiance), left = weighed(s, p, p.throughput);
    alignas(64) float r[lanes_of<F>], g[lanes_of<F>], b[lanes_of<F>], carried[lanes_of<F>];
    alignas(64) std::int32_t slots[lanes_of<F>];
    store(r, gathered.x), store(g, gathered.y), store(b, gathered.z), store(slots, p.slot);
    store(carried, max_component(left));
    for (; ended; ended &= ended - 1) {
      const int lane = __builtin_ctz(ended), slot = slots[lane], pixel = shared_.pixel[slot];
      const bool left_second = p.second >> lane & 1u;
      auto& to = left_second ? shared_.leaving : shared_.own;
      const float scale = left_second ? over_carried(shared_, slot) : 1;
      const bool branch = p.branch >> lane & 1u;
      if (branch)
        add(slot, {r[lane], g[lane], b[lane]});
      else
        to[0][slot] = scale * r[lane], to[1][slot] = scale * g[lane], to[2][slot] = scale * b[lane];
      if (pixel < 0) continue;
      if (film_.emission && (p.straight >> lane & 1u))
        add_emission(film_.emission[pixel], half_of(slot), {r[lane], g[lane], b[lane]}, film_.per_quantum);
      if (!branch) ++film_.pixels[pixel].taken;
      if (!(cut >> lane & 1u)) continue;
      ++film_.pixels[pixel].truncated;
      film_.counts.cut_throughput.add(static_cast<double>(carried[lane]));
    }
  }
  /// Stores the light of a specular path from an event of a path that may still go on.
  TYNDALL_INLINE void add(std::int32_t at, Vec3f light) {
    const bool left_second = at >= leaves_second;
    const std::int32_t slot = left_second ? at - leaves_second : at, pixel = shared_.pixel[slot];
    if (left_second) {
      const float scale = over_carried(shared_, slot);
      shared_.by_specular_paths[0][slot] += scale * light.x;
      shared_.by_specular_paths[1][slot] += scale * light.y;
      shared_.by_specular_paths[2][slot] += scale * light.z;
    } else if (pixel >= 0) {
      add_sample(film_.pixels[pixel], half_of(slot), light, film_.per_quantum);
    }
  }

 private:
  /// Added to the slot of light that a path gathers after its second vertex.
  static constexpr std::int32_t leaves_second = 1 << 30;

  TYNDALL_INLINE std::uint32_t half_of(int slot) const { return shared_.index[slot % ReusedPaths::max_groups] & 1u; }
  /// Moves to the next pixel that is in the picture.
  TYNDALL_INLINE void skip() {
    for (; member_ < group_size; group_ = 0, ++member_)
      for (; group_ < shared_.groups; ++group_)
        if (shared_.pixel[member_ * ReusedPaths::max_groups + group_] != ReusedPaths::outside) return;
  }

  ReusedPaths& shared_;
  SubpixelLights subpixel_lights_;  ///< of the rows of the groups
  const TileFilm& film_;
  int member_ = 0, group_ = 0;
};

template <class F>
TYNDALL_INLINE Vec3<F> load_vector(const float (&columns)[3][ReusedPaths::room], int slot) {
  return {load<F>(columns[0] + slot), load<F>(columns[1] + slot), load<F>(columns[2] + slot)};
}

/// Pdf with which a path scatters from the first vertex at slot `from` to the second one at slot `to`: per area, or per
/// volume in a medium, times a factor that is the same for all first vertices; 0 where the segment is blocked. lanes:
/// the groups that have that second vertex.
template <class F>
TYNDALL_INLINE F link_pdf(const auto& s, const ReusedPaths& p, int from, int to, MaskOf<F> lanes, TileCounts& counts) {
  const Vec3<F> start = load_vector<F>(p.first.point, from), to_second = load_vector<F>(p.second.point, to) - start;
  const F square = max(dot(to_second, to_second), F(1e-30f)), distance = sqrt(square);
  const Ray<F> ray{start, (F(1.0f) / distance) * to_second, F(0.0f), load_int<F>(p.first.surface + from)};
  // At each end a cosine on a surface; in a medium 1/4 at the start and 1 at the end.
  F leaves = load<F>(p.first.even + from) + dot(load_vector<F>(p.first.facing, from), ray.direction);
  F arrives = load<F>(p.second.even + to) - dot(load_vector<F>(p.second.facing, to), ray.direction);
  if (from == to) {  // the path did come this way, even if a rounded cosine denies it
    leaves = max(leaves, F(1e-6f)), arrives = max(arrives, F(1e-6f));
  } else {
    lanes = mask_and(lanes, mask_and(less(F(0.0f), leaves), less(F(0.0f), arrives)));
    if (!any(lanes)) return F(0.0f);
    const auto queries = static_cast<std::uint32_t>(__builtin_popcount(bits(lanes)));
    counts.rays += queries, counts.shadow_rays += queries;
    lanes = mask_and_not(lanes, blocked_towards(s, ray, distance, load_int<F>(p.second.surface + to), -1, lanes));
  }
  F pdf = leaves * arrives / square;
  if (s.has_media()) pdf = pdf * pass_media(s, ray, distance, lanes);
  return select(lanes, pdf, F(0.0f));
}

/// Adds the light that leaves each second vertex to the samples of all first vertices of its group that it reaches.
template <class F>
TYNDALL_INLINE void reuse_second_vertices(const auto& s, ReusedPaths& p, TileCounts& counts) {
  constexpr int row = ReusedPaths::max_groups;
  for (int group = 0; group < p.groups; group += lanes_of<F>)
    for (int to = group; to < ReusedPaths::room; to += row) {
      const auto there = less_equal(F(0.0f), load<F>(p.second.even + to));
      if (!any(there)) continue;
      F pdf[group_size], total = F(0.0f);
      for (int k = 0; k < group_size; ++k) {
        pdf[k] = link_pdf<F>(s, p, group + k * row, to, there, counts);
        total = total + pdf[k];
      }
      const F scale = select(less(F(0.0f), total), F(1.0f) / max(total, F(1e-37f)), F(0.0f));
      const Vec3<F> leaving = scale * load_vector<F>(p.leaving, to);
      for (int k = 0; k < group_size; ++k) {
        const int at = group + k * row;
        const auto reached = less(F(0.0f), pdf[k]);
        if (!any(reached)) continue;
        for (int c = 0; c < 3; ++c) {
          const F colour = c == 0 ? leaving.x : c == 1 ? leaving.y : leaving.z, old = load<F>(p.own[c] + at);
          store(p.own[c] + at, select(reached, mul_add(load<F>(p.albedo[c] + at), pdf[k] * colour, old), old));
        }
      }
    }
}

/// Adds the light of specular paths to what leaves the second vertices. To be called once all paths of the groups have
/// ended.
TYNDALL_INLINE void add_specular_paths_to_leaving(const auto& s, ReusedPaths& reused) {
  if (!s.has_specular_paths()) return;
  for (int slot = 0; slot < ReusedPaths::room; ++slot)
    for (int c = 0; c < 3 && reused.second.even[slot] >= 0; ++c)
      reused.leaving[c][slot] += reused.by_specular_paths[c][slot];
}

/// Adds the samples of the groups to the tile job's film.
TYNDALL_INLINE void add_groups(const ReusedPaths& reused, const TileFilm& film) {
  for (int slot = 0; slot < ReusedPaths::room; ++slot) {
    const int pixel = reused.pixel[slot];
    if (pixel < 0) continue;
    const std::uint32_t half = reused.index[slot % ReusedPaths::max_groups] & 1u;
    add_sample(film.pixels[pixel], half, {reused.own[0][slot], reused.own[1][slot], reused.own[2][slot]},
               film.per_quantum);
  }
}

/// Renders a tile job whose paths reuse second vertices. follow(samples): takes all samples of a GroupSamples.
template <class F>
TYNDALL_INLINE void render_tile_reusing(const auto& s, const TileJob& job, const TileFilm& film, const auto& follow) {
  ReusedPaths reused;
  ReuseGroups groups(s, job);
  const SubpixelLights subpixel_lights =
      subpixel_lights_in_rows({s.subpixel_lights, s.subpixel_lights + s.subpixel_light_count},
                              block_start(job.tile.y0, block_height), job.tile.y1 + block_height);
  while (groups.next(reused)) {
    GroupSamples samples(reused, subpixel_lights, film);
    follow(samples);
    add_specular_paths_to_leaving(s, reused);
    reuse_second_vertices<F>(s, reused, film.counts);
    add_groups(reused, film);
  }
}

}  // namespace tyndall
