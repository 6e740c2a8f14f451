#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <tyndall/tyndall.h>

#include <cstdint>
#include <exception>
#include <optional>
#include <string>

/// The classes of the Python package; app/python/tyndall/__init__.py adds what is simpler to say in Python. Numbers and
/// pictures are not copied: arrays look into the picture, which they keep alive.
namespace {

namespace py = pybind11;
using WithoutLock = py::call_guard<py::gil_scoped_release>;

/// What f() returns, without the interpreter's lock.
template <class F>
auto unlocked(const F& f) {
  const py::gil_scoped_release released;
  return f();
}

/// Floats of a picture, which it keeps alive, as an array that cannot be written to.
template <auto values>
py::array_t<float> array_of(const py::object& self) {
  const auto& picture = self.cast<const tyndall::Picture&>();
  const std::vector<float>& found = *unlocked([&] { return &(picture.*values)(); });
  const std::size_t height = static_cast<std::size_t>(picture.height()),
                    width = static_cast<std::size_t>(picture.width());
  std::vector<std::size_t> shape{height, width};
  if (found.size() > height * width) shape.push_back(found.size() / (height * width));
  py::array_t<float> array(shape, found.data(), self);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Renders without the interpreter's lock. Between passes it looks whether Ctrl-C was pressed, and calls `progress`.
tyndall::Picture render(const tyndall::Scene& scene, tyndall::RenderOptions options, const py::object& progress) {
  options.progress = [&](const tyndall::Progress& now) {
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress.is_none()) return true;
    const py::object answer = progress(now);
    if (answer.is_none()) return true;
    const int truth = PyObject_IsTrue(answer.ptr());
    if (truth < 0) throw py::error_already_set();
    return truth != 0;
  };
  return unlocked([&] { return tyndall::render(scene, options); });
}

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
std::vector<float> numbers(const Floats& array) { return {array.data(), array.data() + array.size()}; }

/// Names of files need not be UTF-8: Python's own functions give the same text for them.
py::object text_of(const std::string& bytes) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "surrogateescape"));
}

void add_error(py::module_& module) {
  static PyObject* error = PyErr_NewExceptionWithDoc(
      "tyndall.Error", "Why something cannot be done, in one line; its parts are file, place, found and expected.",
      PyExc_ValueError, nullptr);
  module.add_object("Error", py::reinterpret_borrow<py::object>(error));
  py::register_exception_translator([](std::exception_ptr thrown) {  // NOLINT: pybind11 wants it by value
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const tyndall::Error& why) {
      const py::object instance = py::reinterpret_borrow<py::object>(error)(text_of(why.what()));
      instance.attr("file") = text_of(why.file);
      instance.attr("place") = text_of(why.place);
      instance.attr("found") = text_of(why.found);
      instance.attr("expected") = text_of(why.expected);
      PyErr_SetObject(error, instance.ptr());
    }
  });
}

void add_scene(py::module_& module) {
  using tyndall::Scene;
  py::class_<Scene>(module, "Scene")
      .def(py::init<>())
      .def(py::init<const Scene&>())
      .def_static("_load", &Scene::load, WithoutLock())
      .def_static("_parse", &Scene::parse, WithoutLock())
      .def("_set_json", &Scene::set_json, WithoutLock())
      .def("_get_json", &Scene::get_json, WithoutLock())
      .def("_remove", &Scene::remove, WithoutLock())
      .def("_add_json", &Scene::add_json, WithoutLock())
      .def("json", &Scene::json, WithoutLock(), "The scene file's text, in normal form.")
      .def("_save", &Scene::save, WithoutLock())
      .def_property_readonly("width", &Scene::width, "Pixels.")
      .def_property_readonly("height", &Scene::height, "Pixels.")
      .def_property_readonly("_folder", [](const Scene& scene) { return py::bytes(scene.folder()); });
}

void add_film(py::module_& module) {
  using tyndall::Film;
  py::class_<Film>(module, "Film")
      .def_static("_load", &Film::load, WithoutLock())
      .def_static("_merge", &Film::merge, WithoutLock())
      .def("_save", &Film::save, WithoutLock())
      .def_property_readonly("picture", py::cpp_function(&Film::picture, WithoutLock()), "What these samples show.")
      .def_property_readonly("scene", &Film::scene, "What it is a film of.")
      .def_property_readonly("_width", &Film::width)
      .def_property_readonly("_height", &Film::height)
      .def_property_readonly("spp", &Film::spp, "Samples a pixel.")
      .def_property_readonly("hash", &Film::hash, "16 hexadecimal digits: image_hash of the command's --stats.");
}

void add_picture(py::module_& module) {
  using tyndall::Picture;
  py::class_<tyndall::Progress>(module, "Progress")
      .def_readonly("spp", &tyndall::Progress::spp)
      .def_readonly("seconds", &tyndall::Progress::seconds)
      .def_readonly("error", &tyndall::Progress::error)
      .def_readonly("mrays_per_s", &tyndall::Progress::mrays_per_s);
  py::class_<Picture>(module, "Picture")
      .def_property_readonly(
          "array", &array_of<&Picture::rgb>,
          "height x width x 3, float32, linear radiance, top row first; a view that cannot be written to.")
      .def_property_readonly("error_map", &array_of<&Picture::error_map>,
                             "height x width: the estimated relative error around each pixel.")
      .def_property_readonly("clean", &array_of<&Picture::clean>,
                             "height x width x 3: the clean view, if render(clean=True) made one.")
      .def_property_readonly("_albedo", &array_of<&Picture::albedo>)
      .def_property_readonly("_normal", &array_of<&Picture::normal>)
      .def_property_readonly("_depth", &array_of<&Picture::depth>)
      .def_property_readonly("width", &Picture::width, "Pixels.")
      .def_property_readonly("height", &Picture::height, "Pixels.")
      .def_property_readonly("error", &Picture::error,
                             "Estimated relative error; infinite with fewer than 2 samples a pixel.")
      .def_property_readonly("error_is_reliable", &Picture::error_is_reliable,
                             "False where rare bright paths make up most of the error.")
      .def_property_readonly("clean_error", &Picture::clean_error, "Estimated relative error of the clean view.")
      .def_property_readonly("hash", &Picture::hash, "16 hexadecimal digits: image_hash of the command's --stats.")
      .def_property_readonly("clean_hash", &Picture::clean_hash, "The same of the clean view: denoised_hash.")
      .def_property_readonly("spp", &Picture::spp, "Samples a pixel; where pixels differ, their mean.")
      .def_property_readonly("seconds", &Picture::seconds, "That rendering took.")
      .def_property_readonly("stopped", &Picture::stopped, "The progress function stopped it.")
      .def_property_readonly(
          "rejected", &Picture::rejected,
          "Samples that were left out: not finite, or brighter than any light of the scene explains.")
      .def_property_readonly("film", &Picture::film, "The samples, to save, merge or go on with.")
      .def_property_readonly("scene", &Picture::scene, "The scene that it shows.")
      .def("_save", &Picture::save, WithoutLock())
      .def("_repr_png_", [](const Picture& picture) {
        const std::vector<unsigned char> bytes = unlocked([&] { return picture.png(); });
        return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      });
}

void add_render(py::module_& module) {
  using tyndall::Region;
  // In the order of the members.
  py::class_<Region>(module, "Region").def(py::init<int, int, int, int>());
  py::class_<tyndall::RenderOptions>(module, "RenderOptions")
      .def(py::init<std::uint32_t, double, double, bool, int, std::string, std::optional<Region>, std::uint32_t,
                    std::optional<tyndall::Film>>());
  module.def("render", &render);
}

/// In the order of the fields of the package's own Comparison.
py::tuple fields_of(const tyndall::Comparison& c) {
  const auto channels = [](const tyndall::Vec3& v) { return py::make_tuple(v.x, v.y, v.z); };
  return py::make_tuple(c.mse, c.rmse, c.relmse, c.psnr, c.flip, channels(c.mean_image), channels(c.mean_reference),
                        c.blocks, c.block_score, c.block_limit, c.worst_z, c.only_noise, c.z, c.unclear_blocks,
                        c.enough_spp);
}

void add_compare(py::module_& module) {
  module.def("compare_pictures", [](const tyndall::Picture& image, const tyndall::Picture& reference) {
    return fields_of(unlocked([&] { return tyndall::compare(image, reference); }));
  });
  module.def("compare_arrays", [](const Floats& image, const Floats& reference, int width, int height) {
    const std::vector<float> a = numbers(image), b = numbers(reference);
    return fields_of(unlocked([&] { return tyndall::compare(a, b, width, height); }));
  });
}

}  // namespace

PYBIND11_MODULE(_tyndall, module) {
  module.doc() = "The library libtyndall; the package tyndall is its face.";
  add_error(module);
  add_scene(module);
  add_film(module);
  add_picture(module);
  add_render(module);
  add_compare(module);
  module.def("built_in", &tyndall::Scene::built_in, WithoutLock(), "Names of the built-in scenes.");
  module.attr("__version__") = tyndall::version();
}
