// The only file that compiles stb's functions for pictures: the decoders of BMP and TGA, for which there is no library
// of their own, and the writers of PNG and HDR. Each further decoder is one more way in for a hostile file. stb's PNG
// decoder does not look at checksums, its JPEG decoder writes past a damaged Huffman table, and its HDR decoder loops
// forever on a file that is cut off.
#include "core/image/image_io_file.h"

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <string_view>

#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace {

/// stb's writer does not look whether it got the memory that it asked for. What it has taken is listed here, so that an
/// exception can end it and nothing is lost.
struct alignas(std::max_align_t) Block {
  Block *before = nullptr, *after = nullptr;
};
thread_local Block* newest_block = nullptr;

void leave_list(Block* block) {
  (block->after ? block->after->before : newest_block) = block->before;
  if (block->before) block->before->after = block->after;
}
void enter_list(Block* block) {
  block->before = newest_block;
  block->after = nullptr;
  if (newest_block) newest_block->after = block;
  newest_block = block;
}

void give_back(void* memory) {
  if (!memory) return;
  Block* block = static_cast<Block*>(memory) - 1;
  leave_list(block);
  std::free(block);
}

/// More room for `old` (null: room for something new). Throws std::bad_alloc; then `old` stays.
void* take(void* old, std::size_t size) {
  Block* block = old ? static_cast<Block*>(old) - 1 : nullptr;
  if (block) leave_list(block);
  auto* taken = static_cast<Block*>(std::realloc(block, sizeof(Block) + size));
  if (taken || block) enter_list(taken ? taken : block);
  if (!taken) throw std::bad_alloc();
  return taken + 1;
}

}  // namespace

#define STBIW_MALLOC(size) take(nullptr, size)
#define STBIW_REALLOC(memory, size) take(memory, size)
#define STBIW_FREE(memory) give_back(memory)
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace tyndall {
namespace {

void append(void* to, void* data, int size) {
  const auto* from = static_cast<const std::uint8_t*>(data);
  auto& bytes = *static_cast<std::vector<std::uint8_t>*>(to);
  bytes.insert(bytes.end(), from, from + size);
}

/// What `encode` appends to the bytes that it gets. Throws std::bad_alloc.
template <class Encode>
std::vector<std::uint8_t> encoded(Encode encode) {
  std::vector<std::uint8_t> bytes;
  try {
    if (encode(&bytes) == 0) throw std::bad_alloc();
    return bytes;
  } catch (...) {
    while (newest_block) give_back(newest_block + 1);
    throw;
  }
}

}  // namespace

Samples decode_stb(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  const int size = static_cast<int>(bytes.size());
  Samples samples;
  int channels = 0;
  const bool known = stbi_info_from_memory(bytes.data(), size, &samples.width, &samples.height, &channels) != 0;
  samples.channels = channels == 2 || channels == 4 ? 4 : 3;
  std::unique_ptr<stbi_uc, void (*)(void*)> pixels(nullptr, &stbi_image_free);
  if (known)
    pixels.reset(stbi_load_from_memory(bytes.data(), size, &samples.width, &samples.height, &channels,
                                       static_cast<int>(samples.channels)));
  if (!pixels) {  // without memory stb says so, or nothing at all
    const char* reason = stbi_failure_reason();
    if (!reason || reason == std::string_view("outofmem")) throw std::bad_alloc();
    cannot_read(file, std::string("damaged: ") + reason);
  }
  const auto count = static_cast<std::size_t>(samples.width) * static_cast<std::size_t>(samples.height);
  samples.bytes.assign(pixels.get(), pixels.get() + samples.channels * count);
  return samples;
}

std::vector<std::uint8_t> encode_png(int width, int height, const std::uint8_t* rgb) {
  return encoded([&](void* to) { return stbi_write_png_to_func(append, to, width, height, 3, rgb, 3 * width); });
}

std::vector<std::uint8_t> encode_hdr(int width, int height, const float* rgb) {
  return encoded([&](void* to) { return stbi_write_hdr_to_func(append, to, width, height, 3, rgb); });
}

}  // namespace tyndall
