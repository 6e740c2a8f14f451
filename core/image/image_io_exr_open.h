#pragma once
#include "core/base/limits.h"
#include "core/image/image_io_exr.h"
#include "core/image/image_io_file.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <new>
#include <utility>

/// How EXR files are opened for reading: for the files of this folder that include OpenEXR.
namespace tyndall {

/// Runs `read` on the opened EXR. Whatever goes wrong becomes an ImageFileError that names the file.
template <class Read>
auto with_exr(const std::filesystem::path& file, Read read) {
  try {
    check_exr(file);
    Imf::MultiPartInputFile exr(file.c_str());
    return read(exr);
  } catch (const ImageFileError&) {
    throw;
  } catch (const std::bad_alloc&) {
    cannot_read(file, "not enough memory" + memory_limit_text());
  } catch (const std::exception& error) {
    cannot_read(file, error.what());
  }
}

/// The channels to read, and where their values go.
struct ExrTarget {
  Imf::FrameBuffer buffer;
  Imath::Box2i window;

  void add(const std::string& name, Imf::PixelType type, void* first, std::size_t stride) {
    buffer.insert(name, Imf::Slice::Make(type, first, window, stride));
  }
  void read(Imf::MultiPartInputFile& exr, int number) {
    Imf::InputPart part(exr, number);
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
  }
};

/// The size of a data window.
inline std::pair<int, int> size_of(const std::filesystem::path& file, const Imath::Box2i& window) {
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  check_readable(file, width, height);
  return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace tyndall
