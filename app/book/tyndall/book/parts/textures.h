#pragma once
#include "scene_text.h"

#include <cstdlib>
#include <fstream>

/// The books' textures, and as much of stb_image as the reader's main() may call.
struct texture {
  virtual ~texture() = default;
  virtual color value(double, double, const point3&) const { return color(); }
  /// The texture as the scene has it: a colour, or the quoted name of a texture.
  virtual std::string tyndall_text(tyndall_book::scene_text&) const {
    tyndall_book::refuse(tyndall_book::class_of(*this) + ": Tyndall has no such texture");
  }
};

struct solid_color : texture {
  color albedo, color_value;

  solid_color() = default;
  solid_color(const vec3& colour) : albedo(colour), color_value(colour) {}
  solid_color(double red, double green, double blue) : solid_color(vec3(red, green, blue)) {}
  color value(double, double, const point3&) const override { return albedo; }
  std::string tyndall_text(tyndall_book::scene_text&) const override { return tyndall_book::triple(albedo); }
};
using constant_texture = solid_color;

struct checker_texture : texture {
  /// Editions 1 to 3 take the sign of sin(10 x) sin(10 y) sin(10 z): the same pattern, by cubes of this edge.
  double scale = tyndall_book::half_turn / 10;
  tyndall_book::ref<texture> even, odd;

  checker_texture(tyndall_book::ref<texture> a, tyndall_book::ref<texture> b) : even(a), odd(b) {}
  checker_texture(const vec3& a, const vec3& b)
      : checker_texture(make_shared<solid_color>(a), make_shared<solid_color>(b)) {}
  checker_texture(double edge, tyndall_book::ref<texture> a, tyndall_book::ref<texture> b)
      : scale(edge), even(a), odd(b) {}
  checker_texture(double edge, const vec3& a, const vec3& b)
      : checker_texture(edge, make_shared<solid_color>(a), make_shared<solid_color>(b)) {}
  std::string tyndall_text(tyndall_book::scene_text& out) const override {
    if (!tyndall_book::of_class<checker_texture>(*this)) return texture::tyndall_text(out);
    return out.name_of(*this, out.textures, [&] {
      return "{\"type\":\"checker\",\"scale\":" + tyndall_book::number(scale) + ",\"even\":" + colour_of(even, out) +
             ",\"odd\":" + colour_of(odd, out) + "}";
    });
  }

 private:
  static std::string colour_of(const shared_ptr<texture>& part, tyndall_book::scene_text& out) {
    if (!part) tyndall_book::refuse("checker_texture: one of its colours is missing");
    if (!tyndall_book::of_class<solid_color>(*part))
      tyndall_book::refuse("checker_texture of " + tyndall_book::class_of(*part) +
                           ": Tyndall's checker takes two colours, not textures");
    return part->tyndall_text(out);
  }
};

namespace tyndall_book {

/// Told the size of the picture that main() writes: see loop.h.
void take_size(int width, int height);

/// Files by the bytes that stand for them: see stbi_load().
inline std::map<const void*, std::string>& files_of_bytes() {
  static std::map<const void*, std::string> files;
  return files;
}

/// Folders that images are looked for from, each with its line end: the reader's, else the current one.
inline std::string folders_of_images() {
  const char* given = std::getenv("TYNDALL_BOOK_FOLDERS");
  const char* images = std::getenv("RTW_IMAGES");
  return (images && *images ? std::string(images) + "\n" : "") + (given ? given : ".\n");
}

/// The whole path of an image, which lies in one of the folders, or in images/ there or in one of six folders above.
inline std::string find_image(const std::string& name) {
  const std::string folders = name.rfind('/', 0) == 0 ? "\n" : folders_of_images();
  for (std::size_t at = 0; at < folders.size(); at = folders.find('\n', at) + 1) {
    std::string folder = folders.substr(at, folders.find('\n', at) - at);
    if (!folder.empty()) folder += "/";
    for (int above = 0; above <= 6; ++above, folder += "../")
      for (const std::string& file : {folder + name, folder + "images/" + name}) {
        char* whole = std::ifstream(file) ? realpath(file.c_str(), nullptr) : nullptr;
        const std::string found = whole ? whole : "";
        std::free(whole);
        if (!found.empty()) return found;
      }
  }
  refuse("image_texture: " + name + " is neither in the folder of the program nor in images/ there or above");
}

}  // namespace tyndall_book

struct image_texture : texture {
  std::string file;

  image_texture() = default;
  image_texture(const char* name) : file(name) {}
  image_texture(const std::string& name) : file(name) {}
  image_texture(const unsigned char* bytes, int, int) : file(tyndall_book::files_of_bytes()[bytes]) {}
  std::string tyndall_text(tyndall_book::scene_text& out) const override {
    if (!tyndall_book::of_class<image_texture>(*this)) return texture::tyndall_text(out);
    if (file.empty()) tyndall_book::refuse("image_texture: its bytes do not come from stbi_load()");
    out.has_images = true;
    return out.name_of(*this, out.textures, [&] {
      return "{\"type\":\"image\",\"file\":" + tyndall_book::quoted(tyndall_book::find_image(file)) + "}";
    });
  }
};

/// Draws as many random numbers as the books' class, so that what is placed at random after it is placed alike: 256
/// vectors and three permutations.
struct perlin {
  perlin() { tyndall_book::skip_random(256 * 3 + 3 * 255); }
  double noise(const point3&) const { return 0; }
  double turb(const point3&, int = 7) const { return 0; }
};

struct noise_texture : texture {
  perlin noise;
  double scale = 1;

  noise_texture() = default;
  noise_texture(double frequency) : scale(frequency) {}
  std::string tyndall_text(tyndall_book::scene_text& out) const override {
    if (!tyndall_book::of_class<noise_texture>(*this)) return texture::tyndall_text(out);
    return out.name_of(*this, out.textures, [&] {
      return "{\"type\":\"noise\",\"style\":\"marble\",\"scale\":" + tyndall_book::number(scale) + "}";
    });
  }
};

/// Bytes that stand for the file: only image_texture looks at them.
TYNDALL_BOOK_HELPER unsigned char* stbi_load(const char* file, int* width, int* height, int* channels, int) {
  auto* bytes = new unsigned char[4]();
  tyndall_book::files_of_bytes()[bytes] = file;
  *width = *height = 1;
  *channels = 3;
  return bytes;
}
TYNDALL_BOOK_HELPER void stbi_image_free(void*) {}

/// Pictures that main() writes by itself cannot be taken over, as they may be anything, unless they come out of a loop
/// that has been followed.
TYNDALL_BOOK_HELPER int stbi_write_png(const char*, int width, int height, int, const void*, int) {
  tyndall_book::take_size(width, height);
  tyndall_book::refuse("main() writes its picture by stbi_write_png(): there are no pixels to take over");
}
TYNDALL_BOOK_HELPER int stbi_write_jpg(const char*, int width, int height, int, const void*, int) {
  tyndall_book::take_size(width, height);
  tyndall_book::refuse("main() writes its picture by stbi_write_jpg(): there are no pixels to take over");
}
TYNDALL_BOOK_HELPER int stbi_write_bmp(const char*, int width, int height, int, const void*) {
  tyndall_book::take_size(width, height);
  tyndall_book::refuse("main() writes its picture by stbi_write_bmp(): there are no pixels to take over");
}
TYNDALL_BOOK_HELPER void stbi_flip_vertically_on_write(int) {}
TYNDALL_BOOK_HELPER void stbi_set_flip_vertically_on_load(int flip) {
  if (flip) tyndall_book::refuse("stbi_set_flip_vertically_on_load(): Tyndall reads images upright");
}
