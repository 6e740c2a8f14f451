#ifdef TYNDALL_OPENEXR

#include "core/image/image_io_exr.h"

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace tyndall {
namespace {

[[noreturn]] void damaged_film(const std::filesystem::path& file, const std::string& what) {
  cannot_read(file, "its film is damaged: " + what);
}

template <class Attribute>
auto value_of(const std::filesystem::path& file, const Imf::Header& header, const char* name) {
  const auto* attribute = header.findTypedAttribute<Attribute>(name);
  if (attribute == nullptr) damaged_film(file, std::string("no ") + name);
  return attribute->value();
}

void check_format(const std::filesystem::path& file, const Imf::Header& header) {
  const auto* format = header.findTypedAttribute<Imf::IntAttribute>(exr_name::film_format);
  if (format != nullptr && format->value() > film_format)
    cannot_read(file, "found a film in format " + std::to_string(format->value()) + ", expected at most " +
                          std::to_string(film_format) + ": a newer version of Tyndall wrote it");
}

/// The rounds of adaptive sampling. Every pixel must be where the round of its cell can have brought it.
void read_planned(const std::filesystem::path& file, const Imf::Header& header, Film& film) {
  const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(exr_name::planned);
  if (attribute == nullptr) return;
  const std::string& bytes = attribute->value();
  film.planned.resize(planned_cells(film.region));
  if (bytes.size() != film.planned.size() * sizeof(PlannedSamples))
    damaged_film(file, std::string(exr_name::planned) + " does not fit the picture");
  std::memcpy(film.planned.data(), bytes.data(), bytes.size());
  const auto width = static_cast<std::size_t>(film.region.width());
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const std::size_t row = i / width / planned_cell_edge, column = i % width / planned_cell_edge;
    const PlannedSamples& planned = film.planned[row * planned_columns(film.region) + column];
    if (planned.from > film.pixels[i].taken || film.pixels[i].taken > planned.to || planned.to > (1u << 24u))
      damaged_film(file, std::string(exr_name::planned) + " and its counts contradict each other");
  }
}

/// The film's size, region and settings, without pixels.
Film read_frame(const std::filesystem::path& file, const Imf::Header& header) {
  check_format(file, header);
  const Imath::Box2i& window = header.dataWindow();
  const auto [region_width, region_height] = size_of(file, window);
  Film film;
  film.width = value_of<Imf::IntAttribute>(file, header, exr_name::width);
  film.height = value_of<Imf::IntAttribute>(file, header, exr_name::height);
  if (window.min.x < 0 || window.min.y < 0 || window.max.x >= film.width || window.max.y >= film.height)
    damaged_film(file, "its data window is not within the image");
  film.region = {window.min.x, window.min.y, window.min.x + region_width, window.min.y + region_height};
  const double first = value_of<Imf::DoubleAttribute>(file, header, exr_name::first_sample);
  if (!(first >= 0 && first <= std::numeric_limits<std::uint32_t>::max() && first == std::floor(first)))
    damaged_film(file, std::string(exr_name::first_sample) + " is no sample index");
  film.first_sample = static_cast<std::uint32_t>(first);
  film.quantum = value_of<Imf::DoubleAttribute>(file, header, exr_name::quantum);
  int exponent = 0;
  if (!(film.quantum > 0) || !std::isfinite(film.quantum) || std::frexp(film.quantum, &exponent) != 0.5)
    damaged_film(file, std::string(exr_name::quantum) + " is no power of two");
  std::istringstream sum(value_of<Imf::StringAttribute>(file, header, exr_name::cut_throughput));
  if (!(sum >> film.cut_throughput.high >> film.cut_throughput.low))
    damaged_film(file, std::string(exr_name::cut_throughput) + " is no sum");
  return film;
}

/// Refuses counts that contradict each other, for example more rejected samples than there are: differences would
/// wrap around.
void check_counts(const std::filesystem::path& file, const Film& film) {
  for (FilmPixel pixel : film.pixels) {
    const std::uint32_t rejected[2] = {pixel.rejected[0], pixel.rejected[1]};
    pixel.rejected[0] = pixel.rejected[1] = 0;
    const bool good = rejected[0] <= counted(film, pixel, 0) && rejected[1] <= counted(film, pixel, 1) &&
                      pixel.taken <= std::numeric_limits<std::uint32_t>::max() - film.first_sample;
    if (!good) damaged_film(file, "its counts contradict each other");
  }
}

/// The text of an attribute; "": there is none.
std::string text_in(const Imf::Header& header, const char* name) {
  const auto* found = header.findTypedAttribute<Imf::StringAttribute>(name);
  return found == nullptr ? std::string() : found->value();
}

FilmLabel label_in(const Imf::Header& header) {
  const auto* unfinished = header.findTypedAttribute<Imf::IntAttribute>(exr_name::unfinished);
  return {text_in(header, exr_name::version), text_in(header, exr_name::isa),
          unfinished != nullptr && unfinished->value() != 0, text_in(header, exr_name::contents)};
}

/// What `read` finds in an EXR that holds a film; nothing in all other files.
template <class Read>
auto with_film(const std::filesystem::path& file, const Read& read)
    -> std::optional<decltype(read(std::declval<Imf::MultiPartInputFile&>()))> {
  if (image_kind(read_bytes(file, 16)) != ImageKind::exr) return {};
  return with_exr(file, [&](Imf::MultiPartInputFile& exr) {
    const bool has = exr.header(0).channels().findChannel("film.taken") != nullptr;
    return has ? std::optional(read(exr)) : std::nullopt;
  });
}

Film read_film_of(const std::filesystem::path& file, Imf::MultiPartInputFile& exr) {
  const Imf::Header& header = exr.header(0);
  const Imf::ChannelList& present = header.channels();
  Film film = read_frame(file, header);
  const auto count = static_cast<std::size_t>(film.region.width()) * static_cast<std::size_t>(film.region.height());
  film.pixels.resize(count);
  if (present.findChannel("film.A.R.emission0")) film.emission.resize(count);
  ExrTarget target{{}, header.dataWindow()};
  for (const FilmChannel& channel : film_channels(film)) {
    const Imf::Channel* found = present.findChannel(channel.name);
    if (found == nullptr || found->type != Imf::UINT)
      damaged_film(file, "no channel " + channel.name + " of type uint");
    target.add(channel.name, Imf::UINT, channel.first, channel.stride);
  }
  target.read(exr, 0);
  check_counts(file, film);
  read_planned(file, header, film);
  const std::string checksum = text_in(header, exr_name::checksum);  // films from before there was one have none
  if (!checksum.empty() && checksum != checksum_text(film, {text_in(header, exr_name::scene), "", label_in(header)}))
    damaged_film(file, "it is not what its checksum says");
  return film;
}

}  // namespace

std::optional<Film> read_film(const std::filesystem::path& file) {
  return with_film(file, [&](Imf::MultiPartInputFile& exr) { return read_film_of(file, exr); });
}

std::optional<Film> read_film_frame(const std::filesystem::path& file) {
  return with_film(file, [&](Imf::MultiPartInputFile& exr) { return read_frame(file, exr.header(0)); });
}

std::optional<FilmLabel> read_film_label(const std::filesystem::path& file) {
  return with_film(file, [&](Imf::MultiPartInputFile& exr) {
    check_format(file, exr.header(0));
    return label_in(exr.header(0));
  });
}

std::optional<std::string> exr_text(const std::filesystem::path& file, const std::string& name) {
  return with_exr(file, [&](Imf::MultiPartInputFile& exr) {
    const auto* text = exr.header(0).findTypedAttribute<Imf::StringAttribute>(name);
    return text == nullptr ? std::nullopt : std::optional(text->value());
  });
}

}  // namespace tyndall

#endif
