#ifdef TYNDALL_OPENEXR

#include "core/image/image_io_exr.h"

#include "core/base/fnv1a.h"
#include "core/image/whole_file.h"

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <bit>
#include <cassert>
#include <deque>
#include <exception>
#include <type_traits>

namespace tyndall {

bool has_openexr() { return true; }

std::string checksum_text(const Film& film, const Embedded& embedded) {
  const FilmLabel& label = embedded.label;
  const std::string with = embedded.scene + '\0' + label.version + '\0' + label.isa + (label.unfinished ? "1" : "0");
  return hash_text(film_checksum(film, with + label.contents));
}

std::vector<FilmChannel> film_channels(const Film& film) {
  static_assert(std::endian::native == std::endian::little, "the low word of a limb comes first");
  std::vector<FilmChannel> channels;
  const auto add = [&channels](const std::string& name, const auto& number, std::size_t stride) {
    for (std::size_t word = 0; word < 2; ++word)
      channels.push_back({name + "01"[word], reinterpret_cast<const char*>(&number) + 4 * word, stride});
  };
  const FilmPixel& pixel = film.pixels.front();
  for (std::size_t half = 0; half < 2; ++half)
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const std::string name = std::string("film.") + "AB"[half] + '.' + "RGB"[channel] + '.';
      add(name + "high", pixel.sum[half][channel].high, sizeof pixel);
      add(name + "low", pixel.sum[half][channel].low, sizeof pixel);
      if (!film.emission.empty())
        add(name + "emission", film.emission.front().sum[half][channel], sizeof(EmissionSums));
    }
  channels.push_back({"film.taken", &pixel.taken, sizeof pixel});
  channels.push_back({"film.rejectedA", &pixel.rejected[0], sizeof pixel});
  channels.push_back({"film.rejectedB", &pixel.rejected[1], sizeof pixel});
  channels.push_back({"film.truncated", &pixel.truncated, sizeof pixel});
  return channels;
}

namespace {

/// The file as OpenEXR sees it. OpenEXR ignores errors while it finishes a file, so the first one is kept here and
/// thrown by rethrow().
class Stream : public Imf::OStream {
 public:
  Stream(WholeFile& out, const std::string& name) : OStream(name.c_str()), out_(out) {}

  void write(const char bytes[], int count) override {
    guard([&] { out_.write(std::as_bytes(std::span(bytes, static_cast<std::size_t>(count)))); });
  }
  std::uint64_t tellp() override { return out_.position(); }
  void seekp(std::uint64_t position) override {
    guard([&] { out_.seek(position); });
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  template <class Action>
  void guard(Action action) {
    try {
      action();
    } catch (...) {
      if (!error_) error_ = std::current_exception();
      throw;
    }
  }

  WholeFile& out_;
  std::exception_ptr error_;
};

/// What makes the channels film.* a film.
void describe_film(Imf::Header& header, const Film& film, const Embedded& embedded) {
  header.insert(exr_name::width, Imf::IntAttribute(film.width));
  header.insert(exr_name::height, Imf::IntAttribute(film.height));
  header.insert(exr_name::first_sample, Imf::DoubleAttribute(film.first_sample));
  header.insert(exr_name::quantum, Imf::DoubleAttribute(film.quantum));
  const ExactSum& cut = film.cut_throughput;
  header.insert(exr_name::cut_throughput,
                Imf::StringAttribute(std::to_string(cut.high) + " " + std::to_string(cut.low)));
  header.insert(exr_name::film_format, Imf::IntAttribute(film_format));
  header.insert(exr_name::unfinished, Imf::IntAttribute(embedded.label.unfinished ? 1 : 0));
  header.insert(exr_name::version, Imf::StringAttribute(embedded.label.version));
  header.insert(exr_name::isa, Imf::StringAttribute(embedded.label.isa));
  static_assert(std::is_trivially_copyable_v<PlannedSamples>);
  const std::string planned(reinterpret_cast<const char*>(film.planned.data()),
                            film.planned.size() * sizeof(PlannedSamples));
  if (!planned.empty()) header.insert(exr_name::planned, Imf::StringAttribute(planned));
  header.insert(exr_name::checksum, Imf::StringAttribute(checksum_text(film, embedded)));
}

Imf::Header make_header(const Film& film, const Embedded& embedded) {
  const Region& r = film.region;
  const Imath::Box2i display({0, 0}, {film.width - 1, film.height - 1}), data({r.x0, r.y0}, {r.x1 - 1, r.y1 - 1});
  Imf::Header header(display, data);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = 1;  // higher levels take longer and save nothing: half of the bits are noise
  Imf::addChromaticities(header, Imf::Chromaticities());  // those of Rec.709
  header.insert("software", Imf::StringAttribute("Tyndall " TYNDALL_VERSION));
  if (embedded.film) describe_film(header, film, embedded);
  if (!embedded.scene.empty()) header.insert(exr_name::scene, Imf::StringAttribute(embedded.scene));
  if (!embedded.stats.empty()) header.insert(exr_name::stats, Imf::StringAttribute(embedded.stats));
  const std::string& contents = embedded.label.contents;
  if (!contents.empty()) header.insert(exr_name::contents, Imf::StringAttribute(contents));
  return header;
}

/// Adds channels to the header and the frame buffer. The values are written from where they are: keep them until then.
struct Picture {
  Imf::Header header;
  Imf::FrameBuffer buffer{};
  std::deque<std::vector<half>> halves{};

  void add(const std::string& name, Imf::PixelType type, const void* first, std::size_t stride) {
    header.channels().insert(name, Imf::Channel(type));
    buffer.insert(name, Imf::Slice::Make(type, first, header.dataWindow(), stride));
  }
  void add_floats(const std::string& prefix, const std::vector<std::string>& channels,
                  const std::vector<float>& values) {
    for (std::size_t i = 0; i < channels.size(); ++i)
      add(prefix + channels[i], Imf::FLOAT, values.data() + i, channels.size() * sizeof(float));
  }
  void add_layer(const Layer& layer) {
    if (!layer.half) return add_floats(layer.name + ".", layer.channels, layer.values);
    const std::vector<half>& values = halves.emplace_back(layer.values.begin(), layer.values.end());
    for (std::size_t i = 0; i < layer.channels.size(); ++i)
      add(layer.name + "." + layer.channels[i], Imf::HALF, values.data() + i, layer.channels.size() * sizeof(half));
  }
  void add_film(const Film& film) {
    for (const FilmChannel& channel : film_channels(film)) add(channel.name, Imf::UINT, channel.first, channel.stride);
  }
  void write(const std::filesystem::path& file) const {
    WholeFile out(file);
    Stream stream(out, file.string());
    try {
      Imf::OutputFile exr(stream, header);
      exr.setFrameBuffer(buffer);
      exr.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
    } catch (const std::exception& error) {
      stream.rethrow();
      cannot_write(file, error.what());
    }
    stream.rethrow();
    out.commit();
  }
};

}  // namespace

void write_exr(const std::filesystem::path& file, const Film& film, const std::vector<Layer>& layers,
               const Embedded& embedded, const LinearImage* image) {
  check_writable(file, film.region.width(), film.region.height());
  assert(!image || image->rgb.size() == 3 * film.pixels.size());
  const std::vector<float> resolved = image ? std::vector<float>() : resolve(film);
  const std::vector<float>& rgb = image ? image->rgb : resolved;
  Picture picture{make_header(film, embedded)};
  picture.add_floats("", {"R", "G", "B"}, rgb);
  for (const Layer& layer : layers) {
    assert(layer.values.size() == film.pixels.size() * layer.channels.size());
    picture.add_layer(layer);
  }
  if (embedded.film) picture.add_film(film);
  picture.write(file);
}

void write_checkpoint(const std::filesystem::path& file, const Film& film, const Embedded& embedded) {
  check_writable(file, film.region.width(), film.region.height());
  Picture picture{make_header(film, embedded)};
  picture.header.compression() = Imf::NO_COMPRESSION;
  picture.add_film(film);
  picture.write(file);
}

}  // namespace tyndall

#else

#include "core/image/image_io.h"
#include "core/image/image_io_file.h"

// What stands for all that reads and writes EXR files.
namespace tyndall {

/// What users are told about EXR files if OpenEXR was not found when the build was configured.
constexpr const char* without_openexr = "this build has no EXR images (OpenEXR was not found when it was configured)";

bool has_openexr() { return false; }

void write_exr(const std::filesystem::path& file, const Film&, const std::vector<Layer>&, const Embedded&,
               const LinearImage*) {
  cannot_write(file, without_openexr);
}

void write_checkpoint(const std::filesystem::path& file, const Film&, const Embedded&) {
  cannot_write(file, without_openexr);
}

LinearImage read_exr(const std::filesystem::path& file, const std::optional<std::string>&) {
  cannot_read(file, without_openexr);
}

std::optional<Film> read_film(const std::filesystem::path& file) {
  if (image_kind(read_bytes(file, 16)) == ImageKind::exr) cannot_read(file, without_openexr);
  return {};
}

std::optional<Film> read_film_frame(const std::filesystem::path& file) { return read_film(file); }

std::optional<FilmLabel> read_film_label(const std::filesystem::path&) { return {}; }

std::optional<std::string> exr_text(const std::filesystem::path& file, const std::string&) {
  cannot_read(file, without_openexr);
}

}  // namespace tyndall

#endif
