// The module glint._glint: glint/glint.h and glint/compare.h for Python; python/glint wraps it.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstring>

#include "glint/compare.h"
#include "glint/gl/context.h"
#include "glint/glint.h"

namespace py = pybind11;

namespace {

using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;
using ByteArray = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

/// A NumPy array that takes ownership of the values.
template <typename Value>
py::array_t<Value> arrayOf(std::vector<Value>&& values, std::vector<py::ssize_t> shape) {
  auto* const kept = new std::vector<Value>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Value>*>(p); });
  return py::array_t<Value>(std::move(shape), kept->data(), owner);
}

py::array_t<float> arrayOf(glint::Image&& image) {
  return arrayOf(std::move(image.values), {image.height, image.width, 4});
}

/// Image or Codes from an array (height, width, 4).
template <typename Picture, typename Array>
Picture pictureOf(const Array& array) {
  if (array.ndim() != 3 || array.shape(2) != 4)
    throw glint::InputError("a picture is an array of the shape (height, width, 4)");
  Picture picture;
  picture.width = int(array.shape(1));
  picture.height = int(array.shape(0));
  picture.values.assign(array.data(), array.data() + array.size());
  return picture;
}

template <typename Value, std::size_t Size>
std::vector<std::array<Value, Size>> rowsOf(
    const py::array_t<Value, py::array::c_style | py::array::forcecast>& array, const char* what) {
  if (array.size() == 0) return {};
  if (array.ndim() != 2 || array.shape(1) != py::ssize_t(Size))
    throw glint::InputError(std::string(what) + ": give an array of the shape (count, " +
                            std::to_string(Size) + ")");
  std::vector<std::array<Value, Size>> rows(std::size_t(array.shape(0)));
  std::memcpy(rows.data(), array.data(), sizeof(Value) * std::size_t(array.size()));
  return rows;
}

std::vector<std::byte> bytesOf(const py::bytes& bytes) {
  const std::string_view view = bytes;
  const auto* const first = reinterpret_cast<const std::byte*>(view.data());
  return {first, first + view.size()};
}

glint::Arrays arraysOf(
    const FloatArray& positions, const py::array_t<std::uint32_t, py::array::c_style>& indices,
    const FloatArray& normals, const FloatArray& colors, const FloatArray& texcoords,
    const py::bytes& texture, std::string name, std::string material, bool twoSided,
    const py::array_t<double, py::array::c_style | py::array::forcecast>& place) {
  glint::Arrays arrays;
  arrays.positions = rowsOf<float, 3>(positions, "positions");
  arrays.indices.assign(indices.data(), indices.data() + indices.size());
  arrays.normals = rowsOf<float, 3>(normals, "normals");
  arrays.colors = rowsOf<float, 4>(colors, "colors");
  arrays.texcoords = rowsOf<float, 2>(texcoords, "texcoords");
  arrays.texture = bytesOf(texture);
  arrays.name = std::move(name);
  arrays.material = std::move(material);
  arrays.twoSided = twoSided;
  if (place.ndim() != 2 || place.shape(0) != 4 || place.shape(1) != 4)
    throw glint::InputError("place: give an array of the shape (4, 4)");
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      arrays.place[std::size_t(4 * column + row)] = place.at(row, column);
  return arrays;
}

py::dict dictOf(glint::Differences&& found) {
  py::dict result;
  result["same"] = found.same;
  result["values"] = found.values;
  result["failures"] = found.failures;
  result["worst"] = found.worst;
  const py::ssize_t width = found.map.empty() ? 0 : found.width;
  result["map"] = arrayOf(std::move(found.map), {found.map.empty() ? 0 : found.height, width});
  return result;
}

/// Runs without Python's global lock, so that other threads keep running.
template <typename Work>
auto unlocked(Work work) {
  const py::gil_scoped_release release;
  return work();
}

}  // namespace

PYBIND11_MODULE(_glint, module) {
  static py::exception<glint::Error> error(module, "Error", PyExc_RuntimeError);
  static py::exception<glint::InputError> inputError(module, "InputError", error.ptr());
  static py::exception<glint::ContextError> contextError(module, "ContextError", error.ptr());
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const glint::InputError& e) {
      PyErr_SetString(inputError.ptr(), e.what());
    } catch (const glint::ContextError& e) {
      PyErr_SetString(contextError.ptr(), e.what());
    } catch (const glint::Error& e) {
      PyErr_SetString(error.ptr(), e.what());
    }
  });
  module.attr("__version__") = GLINT_VERSION;

  py::class_<glint::Model>(module, "Model")
      .def_static("load",
                  [](const std::string& path) {
                    return unlocked([&] { return glint::Model::load(path); });
                  })
      .def_static("from_memory",
                  [](const py::bytes& bytes) {
                    const std::vector<std::byte> file = bytesOf(bytes);
                    return unlocked([&] { return glint::Model::fromMemory(file); });
                  })
      .def_static("from_arrays",
                  [](const std::vector<glint::Arrays>& parts) {
                    return unlocked([&] { return glint::Model::fromArrays(parts); });
                  })
      .def("warnings", &glint::Model::warnings)
      .def("bounds", &glint::Model::bounds);
  py::class_<glint::Arrays>(module, "Arrays").def(py::init(&arraysOf));

  py::class_<glint::Session>(module, "Session")
      .def(py::init([](const std::string& backend) {
        return unlocked([&] { return std::make_unique<glint::Session>(backend); });
      }))
      .def("description", &glint::Session::description)
      .def("draw",
           [](glint::Session& session, const glint::Model& model, const glint::Options& look) {
             return arrayOf(unlocked([&] { return session.draw(model, look); }));
           })
      .def("layers", [](glint::Session& session, const glint::Model& model,
                        const glint::Options& look, const std::vector<std::string>& names) {
        py::dict result;
        for (auto& [name, image] : unlocked([&] { return session.layers(model, look, names); }))
          result[py::str(name)] = arrayOf(std::move(image));
        return result;
      });

  const auto rulesOf = [](std::vector<std::pair<std::string, double>> limits,
                          std::vector<std::string> metrics, double tolerance, bool ignoreAlpha) {
    return glint::CompareRules{std::move(limits), std::move(metrics), tolerance, ignoreAlpha};
  };
  module.def("compare_linear",
             [=](const FloatArray& a, const FloatArray& b,
                 std::vector<std::pair<std::string, double>> limits,
                 std::vector<std::string> metrics, double tolerance, bool ignoreAlpha) {
               const auto rules = rulesOf(limits, metrics, tolerance, ignoreAlpha);
               const auto one = pictureOf<glint::Image>(a), other = pictureOf<glint::Image>(b);
               return dictOf(unlocked([&] { return glint::comparePictures(one, other, rules); }));
             });
  module.def("compare_codes",
             [=](const ByteArray& a, const ByteArray& b,
                 std::vector<std::pair<std::string, double>> limits,
                 std::vector<std::string> metrics, double tolerance, bool ignoreAlpha) {
               const auto rules = rulesOf(limits, metrics, tolerance, ignoreAlpha);
               const auto one = pictureOf<glint::Codes>(a), other = pictureOf<glint::Codes>(b);
               return dictOf(unlocked([&] { return glint::comparePictures(one, other, rules); }));
             });
  module.def("compare_files",
             [=](const std::string& a, const std::string& b,
                 std::vector<std::pair<std::string, double>> limits,
                 std::vector<std::string> metrics, double tolerance, bool ignoreAlpha) {
               const auto rules = rulesOf(limits, metrics, tolerance, ignoreAlpha);
               return dictOf(unlocked([&] { return glint::compareFiles(a, b, rules); }));
             });
  module.def("read", [](const std::string& path) {
    return arrayOf(unlocked([&] { return glint::readPicture(path); }));
  });
  module.def("write", [](const std::string& path, const FloatArray& array) {
    const auto picture = pictureOf<glint::Image>(array);
    unlocked([&] { glint::writePicture(path, picture); });
  });
  module.def("write_codes", [](const std::string& path, const ByteArray& array) {
    const auto picture = pictureOf<glint::Codes>(array);
    unlocked([&] { glint::writePicture(path, picture); });
  });
  module.def("encode", [](const FloatArray& array, float scale) {
    const auto picture = pictureOf<glint::Image>(array);
    glint::Codes codes = unlocked([&] { return glint::encoded(picture, scale); });
    return arrayOf(std::move(codes.values), {codes.height, codes.width, 4});
  });
}
