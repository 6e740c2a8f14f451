#pragma once
#include "camera.h"
#include "shapes.h"

/// What the reader's functions are asked when his world stands, and what is told of it.
namespace tyndall_book {

/// How the world answers that we put in the place of his: whether a ray meets anything, and what. The record is his.
using world_answer = bool (*)(const void* ray, double low, double high, void* record);
inline world_answer& probe_answer() {
  static world_answer answer;
  return answer;
}

/// Sky, depth and arithmetic of the reader's ray_color(), which is asked on worlds of one object or none.
template <class N>
class light_text {
 public:
  using ray = typename N::ray;
  using rays = ray_traits<ray>;
  using material = typename N::material;
  light_text(const session& s, const scene_text& scene) : s_(s), scene_(scene) { probe_answer() = answer; }

  /// JSON. Throws not_taken where it is neither one colour nor a gradient from top to bottom.
  std::string sky() {
    const vector top = sky_at({}, {0, 1, 0}), bottom = sky_at({}, {0, -1, 0});
    const auto check = [&](vector from, vector to) {
      const double a = 0.5 * (normalized(to).y + 1);
      const vector found = sky_at(from, to);
      if (!(largest(found - ((1 - a) * bottom + a * top)) <= rays::precision() * std::fmax(1, largest(top))))
        throw not_taken{"the sky of ray_color() is neither one colour nor a gradient from top to bottom"};
      if (!(found.x >= 0 && found.y >= 0 && found.z >= 0))
        throw not_taken{"the sky of ray_color() is darker than black"};
    };
    const vector eye = rays::origin(*static_cast<const ray*>(s_.ray_at(0.5 * s_.width, 0.5 * s_.height)));
    for (int k = 0; k < 20000; ++k) {  // what the camera sees
      const ray& seen =
          *static_cast<const ray*>(s_.ray_at(random_.between(0, s_.width), random_.between(0, s_.height)));
      check(rays::origin(seen), rays::direction(seen));
    }
    constexpr int rows = 1024, columns = 2048;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const double y = 1 - 2 * (row + 0.5) / rows, angle = 2 * pi * (column + 0.5) / columns,
                     r = std::sqrt(1 - y * y);
        check(column % 2 ? eye : vector{30.0 * row, -40, 7.0 * column},
              (1 + column % 3) * vector{r * std::cos(angle), y, r * std::sin(angle)});
      }
    return near(top, bottom, 1e-9)
               ? triple(top)
               : "{\"type\":\"gradient\",\"bottom\":" + triple(bottom) + ",\"top\":" + triple(top) + "}";
  }
  /// The longest path, in scattering events; checks the arithmetic of one and of two hits.
  int events() {
    if (!s_.has_other_worlds || (!scene_.matt && !scene_.shining)) return larger(s_.depth - 1, 0);
    check_interval();
    if (scene_.shining) expect(scene_.light, ask({scene_.shining}), "a light");
    if (!scene_.matt) return larger(s_.depth - 1, 0);
    if (!N::has_densities) {
      const vector sky = ask({scene_.matt});
      const vector to = second_;
      expect(product(scene_.albedo, sky_at({}, to)), sky, "one hit");
      if (scene_.shining)
        expect(product(scene_.albedo, scene_.light), ask({scene_.matt, scene_.shining}), "a hit and a light");
    }
    constexpr std::size_t limit = 3000;
    std::size_t hits = 0;
    for (int k = 0; k < 10; ++k) ask(std::vector<const void*>(limit, scene_.matt)), hits = larger(hits, hits_);
    return hits >= limit ? 100000 : static_cast<int>(hits) - 1;
  }

 private:
  static vector product(vector a, vector b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  void expect(vector wanted, vector found, const char* of) const {
    if (near(wanted, found, 100 * rays::precision())) return;
    throw not_taken{"ray_color(): of " + std::string(of) + " it makes " + words(found) + ", the books' would make " +
                    words(wanted)};
  }
  vector colour(vector from, vector to) {
    const ray query = rays::make(from, to, 0.5);
    typename N::probe world;
    return s_.colour(&query, static_cast<typename N::shape*>(&world));
  }
  vector sky_at(vector from, vector to) {
    if (!s_.has_other_worlds) {
      const ray query = rays::make(from + (1e7 / length(to)) * to, to, 0.5);
      return s_.colour(&query, nullptr);
    }
    materials_.clear(), hits_ = 0;
    return colour(from, to);
  }
  /// What comes of a ray that hits these, one after the other, and then nothing.
  vector ask(const std::vector<const void*>& materials) {
    materials_ = materials, hits_ = 0;
    return colour({0, 1, 0}, {0.6, -0.8, 0});
  }
  static bool answer(const void* query, double low, double high, void* record) {
    if (hits_ == 0) low_ = low, high_ = high;
    if (hits_ == 1) second_ = rays::direction(*static_cast<const ray*>(query));
    if (hits_ == materials_.size()) return false;
    fill(*static_cast<typename N::record*>(record), materials_[hits_++]);
    return true;
  }
  void check_interval() {
    ask({});
    if (low_ <= 0)
      throw not_taken{"ray_color() takes hits at t = 0, so that half of the light meets the surface that it leaves"};
    if (low_ > 0.05 || high_ < 1e4)
      throw not_taken{"ray_color() looks for hits at t from " + number(low_) + " to " + number(high_) + " only"};
  }
  static void fill(typename N::record& record, const void* any_material) {
    record = make_record<N>({{0, 0, 0}});
    auto* m = const_cast<material*>(static_cast<const material*>(any_material));
    decltype(auto) member = material_member(record);
    using M = std::decay_t<decltype(member)>;
    if constexpr (std::is_assignable<M&, material*>::value)
      member = m;
    else if constexpr (std::is_assignable<M&, std::shared_ptr<material>>::value)
      member = std::shared_ptr<material>(m, [](material*) {});
    else
      throw not_taken{"ray_color() cannot be asked of single hits"};
  }

  const session& s_;
  const scene_text& scene_;
  random_numbers random_;
  inline static std::vector<const void*> materials_;  ///< what the asked ray hits
  inline static std::size_t hits_ = 0;                ///< how often it has
  inline static double low_ = 0, high_ = 0;           ///< between which it looks for its first hit
  inline static vector second_;                       ///< its direction behind that
};

template <class N>
std::string scene_of(const session& s, scene_text& out) {
  world_text<N>(out).add(static_cast<const typename N::shape*>(s.world), {});
  const std::string camera = camera_text<N>(s).text();
  light_text<N> light(s, out);
  const std::string sky = light.sky();
  const int events = light.events();
  std::string text = "{\"tyndall\":1,\"image\":{\"width\":" + std::to_string(s.width) +
                     ",\"height\":" + std::to_string(s.height) + "},\n" + camera + ",\n\"background\":" + sky +
                     ",\n\"render\":{\"spp\":" + std::to_string(larger(s.samples, 1)) +
                     ",\"max_depth\":" + std::to_string(events) + "},\n\"textures\":{" + out.textures +
                     "},\n\"materials\":{" + out.materials + "},\n\"objects\":[";
  for (std::size_t k = 0; k < out.objects.size(); ++k) text += (k > 0 ? ",\n" : "\n") + out.objects[k];
  return text + "\n]}\n";
}

/// Tells the scene, or why there is none.
template <class N>
void tell_scene(const session& s) {
  std::string reason;
  try {
    if (std::getenv("TYNDALL_BOOK_ONLY_SAMPLES")) throw not_taken{std::getenv("TYNDALL_BOOK_ONLY_SAMPLES")};
    scene_text out;
    const std::string scene = scene_of<N>(s, out);
    for (const std::string& note : out.notes) tell('N', note);
    tell('R', std::string(out.fuzz_on_sphere ? "sphere " : "") + (out.matt_in_sphere ? "filled " : "") +
                  (s.less ? "frame " : "") + (out.has_noise ? "noise " : "") + (out.has_images ? "image " : "") +
                  (N::has_densities ? "pdf " : ""));
    return tell('S', scene);
  } catch (const not_taken& why) {
    reason = why.reason;
  } catch (const std::exception& error) {
    reason = error.what();
  } catch (...) {
    reason = "an exception of the program's own";
  }
  tell('O', reason);
}

/// Computes samples as the reader's program does, for as long as they are asked for: a number of them, and two numbers
/// each, the place in pixels, are answered by three.
inline void serve(const session& s) {
  const auto receive = [](void* to, std::size_t size) {
    for (char* at = static_cast<char*>(to); size > 0;) {
      const auto got = read(channel(), at, size);
      if (got <= 0) std::_Exit(0);
      at += got, size -= static_cast<std::size_t>(got);
    }
  };
  for (;;) {
    std::uint64_t count = 0;
    receive(&count, sizeof count);
    std::vector<double> places(2 * count), colours;
    receive(places.data(), places.size() * sizeof(double));
    for (std::uint64_t k = 0; k < count; ++k) {
      vector made{NAN, NAN, NAN};
      try {
        made = s.colour(s.ray_at(places[2 * k], places[2 * k + 1]), nullptr);
      } catch (...) {  // a sample without a value is told
      }
      colours.insert(colours.end(), {made.x, made.y, made.z});
    }
    send_bytes(colours.data(), colours.size() * sizeof(double));
  }
}

inline void tell_picture(const session& s) {
  tell('P', std::to_string(s.width) + " " + std::to_string(s.height) + " " + std::to_string(s.samples));
  for (const auto& name : opened_files::get().missing) tell('F', name.second);
}
template <class N>
[[noreturn]] void take_over_world(const session& s) {
  tell_picture(s);
  tell_scene<N>(s);
  serve(s);
  std::_Exit(0);
}
/// Where the reader's classes cannot be read.
[[noreturn]] inline void take_samples(const session& s) {
  tell_picture(s);
  tell('O', "its classes are not those of the books");
  serve(s);
  std::_Exit(0);
}

}  // namespace tyndall_book
