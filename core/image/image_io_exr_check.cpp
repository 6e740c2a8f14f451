#ifdef TYNDALL_OPENEXR

#include "core/image/image_io_exr.h"
#include "core/system/files.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace tyndall {
namespace {

/// Reads a file's values one after the other; nothing of it is kept.
struct ExrBytes {
  const std::filesystem::path& file;
  std::uint64_t left = std::filesystem::file_size(file);  ///< bytes that were not read yet
  ReadStream stream{open_stream(file, "rb")};

  [[noreturn]] void damaged(const std::string& what) const { cannot_read(file, "damaged: " + what); }
  void take(void* to, std::uint64_t count) {
    if (count > left || std::fread(to, 1, count, stream.get()) != count) damaged("the EXR's header ends early");
    left -= count;
  }
  template <class T>
  T take() {
    T value{};
    take(&value, sizeof value);
    return value;
  }
  void skip(std::uint64_t count) {
    if (count > left || fseeko(stream.get(), static_cast<off_t>(count), SEEK_CUR) != 0)
      damaged("the EXR's header ends early");
    left -= count;
  }
  /// A name, which ends with a zero byte.
  std::string take_name() {
    std::string name;
    for (char c = take<char>(); c != 0; c = take<char>()) {
      if (name.size() == 255) damaged("a name in the EXR's header is longer than 255 bytes");
      name += c;
    }
    return name;
  }
};

struct ExrChannel {
  std::uint64_t bytes = 4, every_x = 1, every_y = 1;
};

/// What memory depends on: the attributes of one part of an EXR that say how large its picture is.
struct ExrPart {
  std::array<std::int32_t, 4> window{0, 0, -1, -1};  ///< xMin, yMin, xMax, yMax
  std::uint8_t compression = 0;
  std::uint32_t tile_width = 0, tile_height = 0;  ///< 0: rows
  std::vector<ExrChannel> channels;
  std::uint64_t chunks = 0;  ///< as the attribute chunkCount says; 0: it is not there
  bool deep = false;         ///< many depths a pixel: its pixels are never read
};

/// Bytes that a value of this type has; 0: as many as the attribute says.
std::uint64_t fixed_size(std::string_view type) {
  static constexpr std::pair<std::string_view, std::uint64_t> types[] = {
      {"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
      {"compression", 1}, {"double", 8},   {"envmap", 1},
      {"float", 4},       {"int", 4},      {"keycode", 28},
      {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
      {"m44f", 64},       {"m44d", 128},   {"rational", 8},
      {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
      {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
      {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}};
  for (const auto& [name, size] : types)
    if (name == type) return size;
  return 0;
}

/// The list of channels: names, each with 16 bytes, and an empty name. end: how many bytes are left behind it.
std::vector<ExrChannel> take_channels(ExrBytes& in, std::uint64_t end) {
  std::vector<ExrChannel> channels;
  while (!in.take_name().empty()) {
    const auto type = in.take<std::uint32_t>();
    in.skip(4);
    const auto every_x = in.take<std::int32_t>(), every_y = in.take<std::int32_t>();
    if (type > 2 || every_x < 1 || every_y < 1 || in.left <= end) in.damaged("its list of channels");
    channels.push_back({type == 1 ? 2u : 4u, static_cast<std::uint64_t>(every_x), static_cast<std::uint64_t>(every_y)});
  }
  return channels;
}

/// Values that hold lengths of their own, for which OpenEXR takes memory before it looks whether they can be right.
void skip_nested(ExrBytes& in, std::string_view type, std::uint64_t size) {
  const std::uint64_t end = in.left - size;
  if (type == "stringvector") {
    while (in.left > end) in.skip(in.take<std::uint32_t>());
  } else if (type == "preview") {
    const std::uint64_t width = in.take<std::uint32_t>(), height = in.take<std::uint32_t>();
    if (width > size || height > size) in.damaged("its preview");
    in.skip(4 * width * height);
  } else if (type == "idmanifest") {
    if (in.take<std::uint32_t>() / 1100 > size) in.damaged("its list of names");
    in.skip(in.left > end ? in.left - end : 0);
  } else {
    in.skip(size - (type == "floatvector" ? size % 4 : 0));
  }
}

/// Reads the value of an attribute; keeps what says how large the picture is.
void take_value(ExrBytes& in, ExrPart& part, const std::string& name, const std::string& type) {
  const std::uint64_t size = in.take<std::uint32_t>(), end = in.left - size, fixed = fixed_size(type);
  if (size > in.left || (fixed != 0 && size != fixed))
    in.damaged("its attribute " + name + " says that it has " + std::to_string(size) + " bytes");
  if (type == "box2i" && name == "dataWindow")
    part.window = in.take<std::array<std::int32_t, 4>>();
  else if (type == "compression" && name == "compression")
    part.compression = in.take<std::uint8_t>();
  else if (type == "int" && name == "chunkCount")
    part.chunks = in.take<std::uint32_t>();
  else if (type == "string" && name == "type") {
    std::string kind(std::min<std::uint64_t>(size, 4), '\0');
    in.take(kind.data(), kind.size());
    in.skip(size - kind.size());
    part.deep = kind == "deep";  // "deepscanline" or "deeptile"
  } else if (type == "chlist")
    part.channels = take_channels(in, end);
  else if (type == "tiledesc" && name == "tiles") {
    part.tile_width = in.take<std::uint32_t>();
    part.tile_height = in.take<std::uint32_t>();
    in.skip(1);
  } else
    skip_nested(in, type, size);
  if (in.left != end) in.damaged("its attribute " + name + " does not fill its " + std::to_string(size) + " bytes");
}

/// How rows are compressed, in the order of OpenEXR's codes: how many rows are one chunk, and how far one can shrink.
struct ExrCompression {
  std::uint64_t rows, max_ratio;
};
ExrCompression compression_of(std::uint8_t code) {
  constexpr ExrCompression known[] = {{1, 1},     {1, 64},    {1, 1400},  {16, 1400},   {32, 1400},
                                      {16, 1400}, {32, 1400}, {32, 1400}, {32, 100000}, {256, 100000}};
  return code < std::size(known) ? known[code] : known[0];
}

std::uint64_t over(std::uint64_t length, std::uint64_t step) { return (length + step - 1) / step; }

/// The number of tiles. Refuses tiles much larger than the picture: OpenEXR takes memory for a row of whole ones.
std::uint64_t count_tiles(ExrBytes& in, const ExrPart& part, std::uint64_t width, std::uint64_t height) {
  const std::uint64_t x = part.tile_width, y = part.tile_height;
  std::uint64_t pixel = 1;  // bytes
  for (const ExrChannel& channel : part.channels) pixel += channel.bytes;
  constexpr std::uint64_t small = 32u << 20u;
  const bool large = x > 2 * width || y > 2 * height;
  if (x == 0 || y == 0 || (large && std::max(x, width) * y > small / pixel))
    in.damaged("its tiles have " + std::to_string(x) + " x " + std::to_string(y) + " pixels");
  return over(width, x) * over(height, y);
}

/// The least bytes that the table of chunks and the pixels of a part take. several: the file has more than one part;
/// then each may be tiled or not.
std::uint64_t min_size(ExrBytes& in, const ExrPart& part, bool tiled, bool several) {
  const std::int64_t columns = std::int64_t{part.window[2]} - part.window[0] + 1;
  const std::int64_t rows = std::int64_t{part.window[3]} - part.window[1] + 1;
  check_readable(in.file, columns, rows);
  const auto width = static_cast<std::uint64_t>(columns), height = static_cast<std::uint64_t>(rows);
  const ExrCompression compression = compression_of(part.compression);
  std::uint64_t bytes = 0, chunks = part.chunks;
  if (part.deep) return 8 * chunks;
  for (const ExrChannel& channel : part.channels)
    bytes += channel.bytes * over(width, channel.every_x) * over(height, channel.every_y);
  if (!tiled || several) chunks = std::max(chunks, over(height, compression.rows));
  if (tiled || part.tile_width != 0) chunks = std::max(chunks, count_tiles(in, part, width, height));
  return std::max(8 * chunks, bytes / compression.max_ratio);
}

}  // namespace

void check_exr(const std::filesystem::path& file) {
  ExrBytes in{file};
  if (!in.stream) in.damaged("it cannot be opened");
  in.skip(4);  // the mark of an EXR
  const auto flags = in.take<std::uint32_t>();
  const bool tiled = (flags & 0x200u) != 0, deep = (flags & 0x800u) != 0, several = (flags & 0x1000u) != 0;
  if (deep && !several) cannot_read(file, deep_data);
  std::vector<ExrPart> found;
  for (std::string name = in.take_name(); !name.empty(); name = in.take_name()) {
    ExrPart& part = found.emplace_back();
    for (; !name.empty(); name = in.take_name()) take_value(in, part, name, in.take_name());
    if (!several) break;
  }
  std::uint64_t minimum = 0;
  for (const ExrPart& part : found) minimum += min_size(in, part, tiled, several);
  check_enough(file, in.left, minimum);
}

}  // namespace tyndall

#endif
