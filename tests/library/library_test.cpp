#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <tyndall/tyndall.h>
#include <unistd.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

/// The library as its users see it: the header and the shared library alone. TYNDALL_PROGRAM names the program, whose
/// pictures must have the same bits.
namespace {

using tyndall::Scene;

Scene small(const std::string& name) {
  Scene scene = Scene::load(name);
  scene.set("/image/width", 48);
  scene.set("/image/height", 32);
  return scene;
}

tyndall::RenderOptions samples(std::uint32_t spp) {
  tyndall::RenderOptions options;
  options.spp = spp;
  return options;
}

std::string hash_of(const Scene& scene, std::uint32_t spp = 2) { return render(scene, samples(spp)).hash(); }

/// What a command prints.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> part{};
  while (pipe && std::fgets(part.data(), static_cast<int>(part.size()), pipe.get())) text += part.data();
  return text;
}

/// The value of a text in a JSON object.
std::string text_in(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\": \"");
  REQUIRE_MESSAGE(at != std::string::npos, json);
  const std::size_t begin = at + key.size() + 5;
  return json.substr(begin, json.find('"', begin) - begin);
}

/// What happens when a wrong call is made.
template <class Call>
tyndall::Error error_of(const Call& call) {
  try {
    call();
  } catch (const tyndall::Error& error) {
    return error;
  }
  FAIL("nothing was wrong");
  std::abort();
}

std::string scratch(const std::string& name) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tyndall-library-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  return folder / name;
}

}  // namespace

TEST_CASE("library: all built-in scenes have the bits of the command, also where numbers next to zero are flushed") {
  const char* program = std::getenv("TYNDALL_PROGRAM");
  REQUIRE(program);
  const auto names = Scene::built_in();
  CHECK(names.size() >= 53);
  for (const std::string& name : names) {
    CAPTURE(name);
    const std::string file = scratch("picture.pfm");
    const std::string figures = output_of(std::string(program) + " render " + name +
                                          " --size 48x32 --spp 2 -q --stats - -o " + file + " 2>/dev/null");
#if defined(__x86_64__)
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040);  // flush to zero, denormals are zero
    const unsigned set = _mm_getcsr();
#endif
    const std::string hash = hash_of(small(name));
#if defined(__x86_64__)
    CHECK(_mm_getcsr() == set);
    _mm_setcsr(before);
#endif
    CHECK(hash == text_in(figures, "image_hash"));
  }
}

TEST_CASE("library: the caller's rounding mode changes no bit, and is not changed") {
  const Scene scene = small("cover");
  const std::string hash = hash_of(scene);
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const std::string seen = hash_of(small("cover"));
    const int after = std::fegetround();
    std::fesetround(FE_TONEAREST);
    CHECK(seen == hash);
    CHECK(after == mode);
  }
}

TEST_CASE("library: two threads render at once, and a child process after fork") {
  const Scene scene = small("cornell-smoke");
  const std::string hash = hash_of(scene);
  std::string first, second;
  std::thread one([&] { first = hash_of(scene); }), two([&] { second = hash_of(scene); });
  one.join(), two.join();
  CHECK(first == hash);
  CHECK(second == hash);
  const pid_t child = fork();
  if (child == 0) _exit(hash_of(scene) == hash && hash_of(small("cornell-smoke")) == hash ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(status == 0);
}

TEST_CASE("library: a scene of builders is the scene of the same file") {
  Scene made;
  made.set("/image/width", 40);
  made.set("/image/height", 30);
  made.set("/camera/look_from", tyndall::Vec3{0, 1, 4});
  made.set_json("/background", R"({"type": "gradient", "bottom": [1, 1, 1], "top": [0.5, 0.7, 1]})");
  made.add("squares", tyndall::Checker{0.5, {0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}});
  made.add("ground", tyndall::Lambertian{"squares"});
  made.add("gold", tyndall::Metal{{0.8, 0.6, 0.2}, 0.3});
  made.add("a/b~c", tyndall::Dielectric{1.5});
  made.add(tyndall::Sphere{{0, -100, 0}, 100, "ground"});
  tyndall::Sphere moving{{1, 1, 0}, 0.5, "gold"};
  moving.center_end = tyndall::Vec3{1, 1.5, 0};
  moving.name = "ball";
  made.add(moving);
  made.add(tyndall::Sphere{{-1, 1, 0}, -0.5, "a/b~c"});
  tyndall::Box box{{0, 0, 0}, {1, 1, 1}, "gold"};
  box.transform = {tyndall::RotateY{15}, tyndall::Translate{{0, 0.5, -1}}};
  made.add(box);
  made.add(tyndall::Medium{tyndall::Sphere{{0, 1, 0}, 2}, 0.1, {0.5, 0.6, 0.7}, 0.2});
  const Scene read = Scene::parse(R"({
    "tyndall": 1, "image": {"width": 40, "height": 30}, "camera": {"look_from": [0, 1, 4]},
    "background": {"type": "gradient", "bottom": [1, 1, 1], "top": [0.5, 0.7, 1]},
    "textures": {"squares": {"type": "checker", "scale": 0.5, "even": [0.1, 0.1, 0.1], "odd": [0.9, 0.9, 0.9]}},
    "materials": {"ground": {"type": "lambertian", "albedo": "squares"},
                  "gold": {"type": "metal", "albedo": [0.8, 0.6, 0.2], "fuzz": 0.3},
                  "a/b~c": {"type": "dielectric", "refractive_index": 1.5}},
    "objects": [
      {"type": "sphere", "center": [0, -100, 0], "radius": 100, "material": "ground"},
      {"type": "sphere", "center": [1, 1, 0], "center_end": [1, 1.5, 0], "radius": 0.5, "material": "gold", "name": "ball"},
      {"type": "sphere", "center": [-1, 1, 0], "radius": -0.5, "material": "a/b~c"},
      {"type": "box", "min": [0, 0, 0], "max": [1, 1, 1], "material": "gold",
       "transform": [{"rotate_y": 15}, {"translate": [0, 0.5, -1]}]},
      {"type": "medium", "boundary": {"type": "sphere", "center": [0, 1, 0], "radius": 2}, "density": 0.1,
       "albedo": [0.5, 0.6, 0.7], "g": 0.2}]})");
  CHECK(made.json() == read.json());
  CHECK(hash_of(made) == hash_of(read));
}

TEST_CASE("library: values are read with their defaults, and taken out") {
  Scene scene = Scene::load("metal-spheres");
  CHECK(scene.get_json("/camera/defocus_angle") == "0");
  CHECK(scene.get_json("/render/integrator") == "\"mis\"");
  CHECK(scene.get_json("/image/width") == std::to_string(scene.width()));
  scene.set("/camera/vfov", 33.5);
  CHECK(scene.get_json("/camera/vfov") == "33.5");
  scene.add("mirror", tyndall::Metal{{1, 1, 1}});
  CHECK(scene.get_json("/materials/mirror/fuzz") == "0");
  scene.remove("/materials/mirror");
  CHECK(error_of([&] { scene.get_json("/materials/mirror"); }).place == "/materials/mirror");
  const std::string before = scene.json();
  CHECK(error_of([&] { scene.remove("/objects/99"); }).found == "nothing");
  CHECK(scene.json() == before);
}

TEST_CASE("library: errors say file, place, found and expected, and leave the scene as it was") {
  Scene scene = small("cover");
  const std::string before = scene.json();
  const tyndall::Error fuzz = error_of([&] { scene.add("gold", tyndall::Metal{{0.8, 0.6, 0.2}, 1.5}); });
  CHECK(fuzz.place == "/materials/gold/fuzz");
  CHECK(fuzz.found == "1.5");
  CHECK(std::string(fuzz.what()).find("/materials/gold/fuzz: found 1.5, expected ") != std::string::npos);
  const tyndall::Error material = error_of([&] { scene.add(tyndall::Sphere{{0, 0, 0}, 1, "nothing"}); });
  CHECK(material.found == "\"nothing\"");
  CHECK(error_of([&] { scene.add(tyndall::Sphere{{0, 0, 0}, 0, "glass"}); }).place.find("/objects/") == 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(error_of([&] { scene.set("/camera/vfov", nan); }).found == "nan");
  CHECK(error_of([&] { scene.set("/camera/vfov", 200); }).place == "/camera/vfov");
  CHECK(error_of([&] { scene.set("camera", 2); }).found == "pointer \"camera\"");
  CHECK(scene.json() == before);
  CHECK(error_of([] { Scene::load("no-such-scene"); }).file == "no-such-scene");
  CHECK(error_of([] { Scene::load("-"); }).file == "-");
  CHECK(error_of([] { Scene::parse("{"); }).place.find("line 1") == 0);
  CHECK(error_of([] { tyndall::Film::load("/no/film.exr"); }).what() != std::string());
  const auto refused = [&](auto change) {
    tyndall::RenderOptions options = samples(1);
    change(options);
    return error_of([&] { render(scene, options); }).place;
  };
  CHECK(refused([](auto& o) { o.isa = "mmx"; }) == "isa");
  CHECK(refused([](auto& o) { o.threads = -1; }) == "threads");
  CHECK(refused([nan](auto& o) { o.time = nan; }) == "time");
  CHECK(refused([](auto& o) { o.target_error = -1; }) == "target_error");
  CHECK(refused([](auto& o) { o.region = tyndall::Region{0, 0, 49, 32}; }) == "region");
  CHECK(refused([](auto& o) { o.spp = 4000000000u; }) == "spp");
}

TEST_CASE("library: films go on, are saved, read and merged with the same bits") {
  const Scene scene = small("cornell-box");
  const std::string whole = hash_of(scene, 8);
  tyndall::RenderOptions more = samples(8);
  more.film = render(scene, samples(3)).film();
  CHECK(render(scene, more).hash() == whole);
  const std::string file = scratch("film.exr");
  render(scene, samples(3)).film().save(file);
  more.film = tyndall::Film::load(file);
  CHECK(more.film->spp() == 3);
  CHECK(render(scene, more).hash() == whole);
  tyndall::RenderOptions rest = samples(5);
  rest.first_sample = 3;
  const tyndall::Film merged = tyndall::Film::merge({render(scene, rest).film(), render(scene, samples(3)).film()});
  CHECK(merged.hash() == whole);
  CHECK(merged.picture().hash() == whole);
  more.film = render(small("cover"), samples(2)).film();
  CHECK(error_of([&] { render(scene, more); }).place == "film");
  CHECK(error_of([&] {
          tyndall::Film::merge({render(scene, rest).film(), render(scene, rest).film()});
        }).what() != std::string());
}

TEST_CASE("library: a film of a texture that has changed since is neither gone on with nor merged") {
  const std::string texture = scratch("texture.png"), file = scratch("textured.exr");
  const auto paint = [&texture](const char* scene) { render(small(scene), samples(1)).save(texture); };
  const auto textured = [&texture] {
    Scene scene = small("earth");
    scene.set("/textures/planet/file", std::filesystem::absolute(texture).string());
    return scene;
  };
  paint("cornell-box");
  tyndall::RenderOptions rest = samples(2);
  rest.first_sample = 1;
  const tyndall::Film old = render(textured(), rest).film();
  render(textured(), samples(1)).film().save(file);
  paint("cover");
  tyndall::RenderOptions more = samples(3);
  more.film = tyndall::Film::load(file);
  const tyndall::Error wrong = error_of([&] { render(textured(), more); });
  CHECK(wrong.place == "film");
  CHECK(wrong.found == "a film of other pixels in its textures or sky");
  CHECK(error_of([&] { tyndall::Film::merge({render(textured(), samples(1)).film(), old}); }).place == "parts");
  CHECK(tyndall::Film::merge({*more.film, old}).spp() == 3);
}

TEST_CASE("library: pictures have the sizes that are promised, and stop when asked") {
  Scene scene = small("showroom");
  tyndall::RenderOptions options = samples(4);
  options.clean = true;
  const tyndall::Picture picture = render(scene, options);
  const std::size_t pixels = 48 * 32;
  CHECK(picture.rgb().size() == 3 * pixels);
  CHECK(picture.clean().size() == 3 * pixels);
  CHECK(picture.error_map().size() == pixels);
  CHECK(picture.albedo().size() == 3 * pixels);
  CHECK(picture.normal().size() == 3 * pixels);
  CHECK(picture.albedo() != picture.normal());
  CHECK(picture.depth().size() == pixels);
  CHECK(picture.spp() == 4);
  CHECK(picture.error() > 0);
  CHECK(std::isfinite(picture.clean_error()));
  CHECK(picture.png().size() > 100);
  CHECK(error_of([&] { render(scene, samples(4)).clean(); }).place == "clean");
  for (const char* name : {"p.png", "p.exr", "p.ppm", "p.pfm", "p.hdr"}) {
    picture.save(scratch(name));
    CHECK(std::filesystem::file_size(scratch(name)) > 100);
  }
  CHECK(hash_of(Scene::load(scratch("p.png")), 4) == picture.hash());
  CHECK(error_of([&] { picture.save(scratch("p.gif")); }).what() != std::string());
  CHECK(error_of([&] { picture.save("/no/such/folder/p.png"); }).what() != std::string());
  tyndall::RenderOptions endless;
  endless.time = 1000;
  int calls = 0;
  endless.progress = [&](const tyndall::Progress& now) { return now.spp < 2 && ++calls < 1000; };
  CHECK(render(scene, endless).stopped());
}

TEST_CASE("library: what a progress function throws comes out as it is") {
  struct Mine : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  const Scene scene = small("cornell-box");
  tyndall::RenderOptions options;
  options.progress = [](const tyndall::Progress&) -> bool { throw Mine("of mine"); };
  CHECK_THROWS_WITH_AS(render(scene, options), "of mine", Mine);
  options.progress = [](const tyndall::Progress&) -> bool { throw 7; };
  CHECK_THROWS_AS(render(scene, options), int);
}

TEST_CASE("library: what was moved from says so, and can be assigned to") {
  Scene scene = small("cornell-box");
  const Scene kept = std::move(scene);
  CHECK(kept.width() > 0);
  CHECK_THROWS_AS(scene.width(), tyndall::Error);
  CHECK_THROWS_AS(scene.json(), tyndall::Error);
  CHECK_THROWS_AS(scene.set("/camera/vfov", 30), tyndall::Error);
  CHECK_THROWS_AS(scene.add_json("{}"), tyndall::Error);
  CHECK_THROWS_AS(scene.save("never.json"), tyndall::Error);
  CHECK_THROWS_AS(render(scene), tyndall::Error);
  scene = kept;
  tyndall::Picture picture = render(scene, samples(1));
  const tyndall::Picture other = std::move(picture);
  CHECK_THROWS_AS(picture.rgb(), tyndall::Error);
  CHECK_THROWS_AS(picture.film(), tyndall::Error);
  tyndall::Film film = other.film();
  const tyndall::Film later = std::move(film);
  CHECK_THROWS_AS(film.hash(), tyndall::Error);
  CHECK_THROWS_AS(tyndall::Film::merge({film, later}), tyndall::Error);
  CHECK(later.hash() == other.hash());
}

TEST_CASE("library: comparisons are the command's, and know noise") {
  Scene scene = small("cornell-box");
  const tyndall::Picture a = render(scene, samples(32));
  scene.set("/render/seed", 7);
  const tyndall::Picture b = render(scene, samples(32));
  const tyndall::Comparison noise = tyndall::compare(a, b);
  CHECK(noise.relmse > 0);
  CHECK(noise.blocks > 0);
  CHECK(noise.only_noise);
  CHECK(noise.z < 4);
  CHECK(noise.unclear_blocks < noise.blocks);
  scene.set("/camera/vfov", 44);
  CHECK(tyndall::compare(a, render(scene, samples(32))).z > 4);
  const tyndall::Comparison same = tyndall::compare(a, a);
  CHECK(same.mse == 0);
  CHECK(same.z == 0);
  CHECK(std::isinf(same.psnr));
  CHECK(tyndall::compare(a.rgb(), b.rgb(), 48, 32).relmse == noise.relmse);
  CHECK(error_of([&] { tyndall::compare(a.rgb(), {}, 48, 32); }).place == "pixels");
  CHECK(error_of([&] {
          tyndall::compare(a,
                           render(Scene::parse(R"({"tyndall": 1, "image": {"width": 9, "height": 9}})"), samples(1)));
        }).place == "image");
}

int main(int argc, char** argv) {
  doctest::Context context(argc, argv);
  return context.run();
}
