#include "display/glb_file.h"

#include <cstdint>

#include "display/mesh_bytes.h"

namespace penumbra {
namespace {

// The chunk of a GLB file, filled up to a multiple of four bytes.
std::string Chunk(std::uint32_t type, std::string bytes, char filler) {
  bytes.append((4 - bytes.size() % 4) % 4, filler);
  std::string chunk;
  AppendBytes(chunk, static_cast<std::uint32_t>(bytes.size()));
  AppendBytes(chunk, type);
  return chunk + bytes;
}

}  // namespace

std::string GlbFile(const std::string& json, const std::string& buffer) {
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942, kVersion = 2;
  std::string chunks = Chunk(kJsonChunk, json, ' ');
  if (!buffer.empty()) chunks += Chunk(kBinaryChunk, buffer, '\0');
  std::string bytes = "glTF";
  AppendBytes(bytes, kVersion);
  AppendBytes(bytes, static_cast<std::uint32_t>(12 + chunks.size()));
  return bytes + chunks;
}

}  // namespace penumbra
