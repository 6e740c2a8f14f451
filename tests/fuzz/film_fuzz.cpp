// Films in EXR files: the label, the frame and the film itself, which is then added to another one and drawn.
#include "core/film/film.h"
#include "core/image/image_io.h"
#include "tests/fuzz/fuzz_input.h"

using namespace tyndall;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(data, size);
  fuzz::survives<ImageFileError>([&] { read_film_label(file.path()); });
  fuzz::survives<ImageFileError>([&] { read_film_frame(file.path()); });
  fuzz::survives<ImageFileError>([&] { read_embedded_stats(file.path()); });
  fuzz::survives<ImageFileError>([&] {
    std::optional<Film> film = read_film(file.path());
    if (!film) return;
    Film next = make_film(film->width, film->height, film->region, 4, film->quantum, !film->emission.empty());
    for (FilmPixel& pixel : next.pixels) pixel.taken = 3;
    const std::vector<FilmPart> parts = {{"fuzz", *film}, {"next", next}};
    fuzz::survives<MergeError>([&] { resolve(merge(parts, [&](std::size_t i) { return parts[i].film; })); });
  });
  return 0;
}
