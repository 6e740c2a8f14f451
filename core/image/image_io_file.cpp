#include "core/image/image_io_file.h"

#include "core/base/elementary.h"
#include "core/base/text.h"
#include "core/image/tonemap.h"
#include "core/system/files.h"
#include "core/system/open_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cmath>

namespace tyndall {
namespace {

/// Why no image has this size; "": some have.
std::string size_problem(std::int64_t width, std::int64_t height) {
  if (width > 0 && height > 0 && width <= max_image_pixels && height <= max_image_pixels / width) return "";
  return "found an image of " + std::to_string(width) + " x " + std::to_string(height) +
         " pixels, expected 1 to 2^28 in all";
}

/// A TGA has no mark: it is told by values of its header that can hardly be anything else.
/// Truevision TGA File Format Specification, version 2.0.
bool is_tga(std::span<const std::uint8_t> start) {
  if (start.size() < kind_size) return false;
  const unsigned palette = start[1], type = start[2], bits = start[16];
  const bool mapped = type == 1 || type == 9, coloured = type == 2 || type == 3 || type == 10 || type == 11;
  const bool known_bits = bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32;
  return known_bits && ((palette == 1 && (mapped || coloured)) || (palette == 0 && coloured));
}

using Profile = std::span<const std::uint8_t>;

/// A signed number of 16 bits and 16 bits behind the point.
double fixed(Profile bytes, std::size_t at) { return static_cast<std::int32_t>(high_first(bytes, at, 4)) / 65536.0; }

bool says(Profile bytes, std::size_t at, std::string_view text) {
  return bytes.size() >= at + text.size() &&
         std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

/// The data of a tag; empty if it is not there.
Profile tag(Profile profile, std::string_view name) {
  const std::uint32_t count = high_first(profile, 128, 4);
  for (std::size_t at = 132; at < 132 + std::size_t{12} * count && at + 12 <= profile.size(); at += 12) {
    const std::size_t start = high_first(profile, at + 4, 4), size = high_first(profile, at + 8, 4);
    if (says(profile, at, name) && start <= profile.size() && size <= profile.size() - start)
      return profile.subspan(start, size);
  }
  return {};
}

/// A curve that is one of five formulas.
std::optional<double> by_formula(Profile curve, double x) {
  constexpr std::size_t counts[] = {1, 3, 4, 5, 7};
  const std::uint32_t formula = high_first(curve, 8, 2);
  if (formula > 4 || curve.size() < 12 + 4 * counts[formula]) return {};
  std::array<double, 7> p{};  // g, a, b, c, d, e, f
  for (std::size_t i = 0; i < counts[formula]; ++i) p[i] = fixed(curve, 12 + 4 * i);
  const auto [g, a, b, c, d, e, f] = p;
  const auto power = [&, g = g, a = a, b = b] { return to_the_power(std::max(a * x + b, 0.0), g); };
  if (formula == 0) return to_the_power(x, g);
  if (formula <= 2) return x >= -b / a ? power() + c : c;
  return x >= d ? power() + e : c * x + f;
}

/// The value of a curve at x in [0, 1].
std::optional<double> value(Profile curve, double x) {
  if (says(curve, 0, "para")) return by_formula(curve, x);
  const std::size_t count = high_first(curve, 8, 4);
  if (!says(curve, 0, "curv") || count > (curve.size() - std::min<std::size_t>(curve.size(), 12)) / 2) return {};
  if (count == 0) return x;
  if (count == 1) return to_the_power(x, high_first(curve, 12, 2) / 256.0);
  const double place = x * static_cast<double>(count - 1);
  const auto before = std::min(static_cast<std::size_t>(place), count - 2);
  const double low = high_first(curve, 12 + 2 * before, 2), high = high_first(curve, 14 + 2 * before, 2);
  return (low + (place - static_cast<double>(before)) * (high - low)) / 65535;
}

bool has_srgb_curve(Profile curve) {
  for (int i = 0; i <= 32; ++i) {
    const auto found = value(curve, i / 32.0);
    const double expected = static_cast<double>(srgb_decode(static_cast<float>(i) / 32));
    if (!found || !(std::abs(*found - expected) <= 0.012)) return false;
  }
  return true;
}

bool is_near(Profile primary, const std::array<double, 3>& xyz) {
  if (!says(primary, 0, "XYZ ") || primary.size() < 20) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(fixed(primary, 8 + 4 * i) - xyz[i]) <= 0.003)) return false;
  return true;
}

}  // namespace

void cannot_read(const std::filesystem::path& file, const std::string& why) {
  throw ImageFileError(file.string() + ": cannot read: " + printable(why));
}

void cannot_write(const std::filesystem::path& file, const std::string& why) {
  throw ImageFileError(file.string() + ": cannot write: " + printable(why));
}

void check_readable(const std::filesystem::path& file, std::int64_t width, std::int64_t height) {
  if (const std::string problem = size_problem(width, height); !problem.empty()) cannot_read(file, problem);
}

void check_enough(const std::filesystem::path& file, std::uint64_t size, std::uint64_t minimum) {
  if (size < minimum)
    cannot_read(file, "damaged: found " + std::to_string(size) + " bytes, expected at least " +
                          std::to_string(minimum) + " for the size that it says");
}

void check_writable(const std::filesystem::path& file, std::int64_t width, std::int64_t height) {
  if (const std::string problem = size_problem(width, height); !problem.empty()) cannot_write(file, problem);
}

void check_writable(const std::filesystem::path& file, const LinearImage& image) {
  check_writable(file, image.width, image.height);
  assert(image.rgb.size() ==
         std::size_t{3} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file, std::size_t limit) {
  const ReadStream stream(open_stream(file, "rb"));
  if (!stream) cannot_read(file, error_text(errno));
  std::vector<std::uint8_t> bytes;
  for (std::size_t size = 0, want = 0; size == want && size < limit;) {
    want = std::min(limit, std::max<std::size_t>(2 * size, 65536));
    bytes.resize(want);
    size += std::fread(bytes.data() + size, 1, want - size, stream.get());
    if (std::ferror(stream.get()) != 0) cannot_read(file, error_text(errno));
    bytes.resize(size);
  }
  return bytes;
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file) {
  std::vector<std::uint8_t> bytes = read_bytes(file, max_file_size + 1);
  if (bytes.size() > max_file_size) cannot_read(file, "longer than 2 GiB");
  return bytes;
}

ImageKind image_kind(std::span<const std::uint8_t> start) {
  const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
  if (text.starts_with("\x89PNG\r\n\x1a\n")) return ImageKind::png;
  if (text.starts_with("\xff\xd8\xff")) return ImageKind::jpeg;
  if (text.starts_with("\x76\x2f\x31\x01")) return ImageKind::exr;
  for (const std::string_view mark : {"#?RADIANCE\n", "#?RADIANCE\r\n", "#?RGBE\n", "#?RGBE\r\n"})
    if (text.starts_with(mark)) return ImageKind::hdr;
  if (text.starts_with("BM") && text.size() >= 6 && text.find('\0') != text.npos) return ImageKind::bmp;
  if (text.size() > 2 && text[0] == 'P' && (is_space(text[2]) || text[2] == '#')) {
    if (text[1] == 'F' || text[1] == 'f') return ImageKind::pfm;
    if (text[1] >= '1' && text[1] <= '7') return ImageKind::ppm;
  }
  return is_tga(start) ? ImageKind::tga : ImageKind::unknown;
}

double power_of_exponent(double exponent) {
  constexpr double usual = 0.45455;  // as PNG's gAMA writes 1 / 2.2
  return std::abs(exponent / usual - 1) <= 0.05 ? srgb_curve : 1 / exponent;
}

std::vector<float> light_table(unsigned largest, double power) {
  std::vector<float> light;
  light.reserve(largest + 1);
  for (unsigned number = 0; number <= largest; ++number) {
    const float part = static_cast<float>(number) / static_cast<float>(largest);
    light.push_back(power == srgb_curve ? srgb_decode(part)
                                        : static_cast<float>(to_the_power(static_cast<double>(part), power)));
  }
  return light;
}

PictureFile picture_of(const Samples& samples, double power) {
  const std::vector<float> light = light_table(samples.largest, power);
  const std::size_t size = samples.largest > 255 ? 2 : 1, step = size * samples.channels;
  const auto number = [&](std::size_t at) -> unsigned {
    return size == 1 ? samples.bytes[at] : samples.bytes[at] * 256u + samples.bytes[at + 1];
  };
  PictureFile picture;
  picture.bits = size == 1 ? 8 : 16;
  picture.image.width = samples.width, picture.image.height = samples.height;
  picture.image.rgb.reserve(samples.bytes.size() / step * 3);
  for (std::size_t at = 0; at < samples.bytes.size(); at += step) {
    for (std::size_t c = 0; c < 3; ++c) picture.image.rgb.push_back(light[number(at + c * size)]);
    if (samples.channels == 4 && number(at + 3 * size) < samples.largest) picture.has_alpha = true;
  }
  return picture;
}

std::uint32_t high_first(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  if (at > bytes.size() || size > bytes.size() - at) return 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8 | bytes[at + i];
  return value;
}

std::uint32_t low_first(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size && at + i < bytes.size(); ++i) value |= std::uint32_t{bytes[at + i]} << 8 * i;
  return value;
}

void add_remark(PictureFile& picture, const std::filesystem::path& file, const std::string& text) {
  picture.remarks.push_back(file.string() + ": " + printable(text));
}

LinearImage oriented(LinearImage stored, const Orientation& orientation) {
  if (orientation == Orientation{}) return stored;
  const auto columns = static_cast<std::size_t>(stored.width), rows = static_cast<std::size_t>(stored.height);
  const std::size_t width = orientation.columns ? rows : columns, height = orientation.columns ? columns : rows;
  LinearImage picture{static_cast<int>(width), static_cast<int>(height), {}};
  picture.rgb.reserve(stored.rgb.size());
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t across = orientation.from_right ? width - 1 - x : x;
      const std::size_t down = orientation.from_bottom ? height - 1 - y : y;
      const std::size_t pixel = orientation.columns ? across * columns + down : down * columns + across;
      picture.rgb.insert(picture.rgb.end(), &stored.rgb[3 * pixel], &stored.rgb[3 * pixel] + 3);
    }
  return picture;
}

Orientation exif_orientation(std::span<const std::uint8_t> tiff) {
  if (tiff.size() < 8 || tiff[0] != tiff[1] || (tiff[0] != 'I' && tiff[0] != 'M')) return {};
  const auto number = [&](std::size_t at, std::size_t size) -> std::size_t {
    return tiff[0] == 'M' ? high_first(tiff, at, size) : low_first(tiff, at, size);
  };
  const std::size_t directory = number(4, 4);
  if (directory > tiff.size() - 2) return {};
  const std::size_t count = std::min(number(directory, 2), (tiff.size() - directory - 2) / 12);
  for (std::size_t entry = 0; entry < count; ++entry) {
    const std::size_t at = directory + 2 + 12 * entry;
    if (number(at, 2) != 0x0112) continue;
    const std::size_t value = number(at + 8, 2);  // 1 to 8; the tag is a number of 2 bytes
    const bool from_right = value == 2 || value == 3 || value == 6 || value == 7;
    const bool from_bottom = value == 3 || value == 4 || value == 7 || value == 8;
    return {value >= 5 && value <= 8, from_right, from_bottom};
  }
  return {};
}

bool is_srgb_profile(Profile profile) {
  if (!says(profile, 36, "acsp")) return false;
  if (says(profile, 16, "GRAY")) return has_srgb_curve(tag(profile, "kTRC"));
  // sRGB's primaries, adapted to the white D50 of profiles.
  return says(profile, 16, "RGB ") && is_near(tag(profile, "rXYZ"), {0.4360, 0.2225, 0.0139}) &&
         is_near(tag(profile, "gXYZ"), {0.3851, 0.7169, 0.0971}) &&
         is_near(tag(profile, "bXYZ"), {0.1431, 0.0606, 0.7139}) && has_srgb_curve(tag(profile, "rTRC")) &&
         has_srgb_curve(tag(profile, "gTRC")) && has_srgb_curve(tag(profile, "bTRC"));
}

}  // namespace tyndall
