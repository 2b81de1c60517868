#include "mesh/pipeline/solution_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "mesh/pipeline/hdf5_image.h"
#include "mesh/pipeline/solution_archive.h"
#include "mesh/pipeline/solution_check.h"
#include "mesh/pipeline/solution_schema.h"
#include "solver/base/check.h"
#include "solver/base/sha256.h"
#include "solver/scene/convex_solids.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// The first byte is not text; line ends follow that a transfer in text mode would change.
constexpr std::string_view kMagic = "\x89Penumbra solution\r\n\x1a\n";
constexpr std::string_view kHdf5Magic = "\x89HDF\r\n\x1a\n";
constexpr std::size_t kDigestSize = 64;
// The first schema with the light of each emitter.
constexpr int kSchemaWithEmitters = 5;
// The first schema with the texture coordinates of faces.
constexpr int kSchemaWithTexture = 6;

// The header in front of the HDF5 image: the magic, lines of text, zeros.
std::string Header(int schema, const std::string& version, std::size_t length, const std::string& digest) {
  std::string header =
      fmt::format("{}schema {}\nversion {}\nlength {}\nsha256 {}\n", kMagic, schema, version, length, digest);
  PENUMBRA_CHECK(header.size() < kSolutionHeaderSize);
  header.resize(kSolutionHeaderSize, '\0');
  return header;
}

// The digest of the whole file, with zeros in place of the digest's own digits.
std::string Digest(std::string_view header, std::size_t digest_at, std::string_view rest) {
  Sha256 digest;
  digest.Update(header.substr(0, digest_at)).Update(std::string(kDigestSize, '0'));
  return digest.Update(header.substr(digest_at + kDigestSize)).Update(rest).Finish();
}

// The value of the text's first line "KEY VALUE"; removes the line from the text.
std::optional<std::string_view> TakeLine(std::string_view& text, std::string_view key) {
  const std::size_t end = text.find('\n');
  if (end == text.npos || !text.starts_with(key)) return std::nullopt;
  const std::string_view value = text.substr(key.size(), end - key.size());
  text.remove_prefix(end + 1);
  return value;
}

std::optional<std::uint64_t> Number(std::optional<std::string_view> digits) {
  std::uint64_t number = 0;
  if (!digits) return std::nullopt;
  const auto [end, error] = std::from_chars(digits->data(), digits->data() + digits->size(), number);
  if (error != std::errc() || end != digits->data() + digits->size()) return std::nullopt;
  return number;
}

struct Envelope {
  int schema = 0;
  std::string version;
  std::string_view image;  // the HDF5 image
};

// The parts of a complete file. Throws Hdf5Error.
Envelope Open(std::string_view bytes) {
  constexpr const char* kDamaged =
      "the file is damaged or cut off; take a copy that is whole, or solve again";
  if (!bytes.starts_with(kMagic)) {
    if (bytes.starts_with(kHdf5Magic) || bytes.find(kHdf5Magic) == kSolutionHeaderSize)
      throw Hdf5Error(
          "it is an HDF5 file, but no solution of penumbra; give one that `penumbra solve -o` wrote");
    throw Hdf5Error(
        "it is neither a scene nor a solution; give an OBJ file or what `penumbra solve -o` wrote");
  }
  if (bytes.size() < kSolutionHeaderSize) throw Hdf5Error(kDamaged);
  const std::string_view header = bytes.substr(0, kSolutionHeaderSize);
  std::string_view rest = header.substr(kMagic.size());
  const auto schema = Number(TakeLine(rest, "schema "));
  const auto version = TakeLine(rest, "version ");
  const auto length = Number(TakeLine(rest, "length "));
  const auto digest = TakeLine(rest, "sha256 ");
  if (!schema || !version || length != bytes.size() || !digest || digest->size() != kDigestSize)
    throw Hdf5Error(kDamaged);
  const auto digest_at = static_cast<std::size_t>(digest->data() - bytes.data());
  if (Digest(header, digest_at, bytes.substr(kSolutionHeaderSize)) != *digest) throw Hdf5Error(kDamaged);
  if (std::cmp_less(*schema, kOldestSolutionSchema) || std::cmp_greater(*schema, kSolutionSchema))
    throw Hdf5Error(fmt::format(
        "it was written by {} version of penumbra, {} (schema {}, this one reads {} to {}); solve again",
        std::cmp_less(*schema, kSolutionSchema) ? "an older" : "a newer", *version, *schema,
        kOldestSolutionSchema, kSolutionSchema));
  return {static_cast<int>(*schema), std::string(*version), bytes.substr(kSolutionHeaderSize)};
}

StoredSolution Read(const Envelope& envelope) {
  const Hdf5Reader file(envelope.image);
  ArchiveReader archive(&file);
  StoredSolution stored;
  stored.version = envelope.version;
  stored.schema = envelope.schema;
  archive.Text("options", stored.options);
  archive.Text("report", stored.report);

  auto scene = std::make_unique<Scene>();
  DescribeScene(archive, *scene);
  if (envelope.schema >= kSchemaWithTexture) DescribeTextureCoordinates(archive, scene->faces);
  CheckScene(*scene);
  for (Patch& patch : scene->patches)
    patch = MakePatch(patch.Vertices(), patch.material, patch.object, patch.faces);
  FindConvexSolids(*scene);

  PatchVisibility::Rows rows;
  DescribeVisibility(archive, rows);
  CheckVisibility(*scene, rows);
  stored.state.visibility = PatchVisibility(std::move(rows));

  std::vector<Element> elements;
  DescribeElements(archive, elements);
  stored.state.solution.forest = RestoreForest(*scene, elements);
  DescribeLight(archive, stored.state.solution);
  CheckLight(stored.state.solution);

  std::vector<MeshKind> kind;
  DescribeMesh(archive, stored.state.mesh, kind);
  if (kind.size() != 1 || (kind[0] != MeshKind::kInterpolant && kind[0] != MeshKind::kFlat))
    throw Hdf5Error("its mesh is of no kind that a solution has");
  stored.state.mesh_kind = kind[0];
  CheckMesh(*scene, stored.state.mesh);
  if (envelope.schema >= kSchemaWithEmitters) DescribeEmitters(archive, stored.state.emitters);
  CheckEmitters(stored.state.solution, stored.state.mesh, stored.state.emitters);
  stored.scene = std::move(scene);
  return stored;
}

// Throws InputError if Read() would reject the file, so that an unreadable file does not replace a readable
// one.
void CheckKept(const Pipeline& pipeline) {
  try {
    CheckScene(pipeline.scene());
    CheckVisibility(pipeline.scene(), pipeline.visibility().rows());
    CheckLight(pipeline.solution());
    CheckMesh(pipeline.scene(), pipeline.mesh());
    CheckEmitters(pipeline.solution(), pipeline.mesh(), pipeline.emitters());
  } catch (const Hdf5Error& error) {
    throw InputError(fmt::format(
        "{}: error: the solution is not fit to be kept: {}; nothing is written: this is a mistake of the "
        "program, and another --error may get around it",
        pipeline.scene().name, error.what()));
  }
}

}  // namespace

bool LooksLikeSolution(std::string_view beginning) {
  return beginning.starts_with(kMagic.substr(0, 1)) ||
         beginning.substr(0, kSolutionHeaderSize).find('\0') != beginning.npos;
}

std::string EncodeSolution(const Pipeline& pipeline, const std::string& options, const std::string& report,
                           const std::string& version) {
  const std::vector<MeshKind> kind = {pipeline.mesh_kind().value()};
  PENUMBRA_CHECK(kind[0] == MeshKind::kInterpolant || kind[0] == MeshKind::kFlat);
  CheckKept(pipeline);
  Hdf5Writer file;
  ArchiveWriter archive(&file);
  archive.Text("options", options);
  archive.Text("report", report);
  DescribeScene(archive, pipeline.scene());
  DescribeTextureCoordinates(archive, pipeline.scene().faces);
  DescribeVisibility(archive, pipeline.visibility().rows());
  const std::span<const Element> elements = pipeline.solution().forest.elements();
  const std::vector<Element> copy(elements.begin(), elements.end());
  DescribeElements(archive, copy);
  DescribeLight(archive, pipeline.solution());
  DescribeMesh(archive, pipeline.mesh(), kind);
  const std::vector<EmitterLight> emitters(pipeline.emitters().begin(), pipeline.emitters().end());
  DescribeEmitters(archive, emitters);
  DescribeDiscontinuities(archive, pipeline.Discontinuities());

  const std::string image = file.Finish();
  const std::size_t length = kSolutionHeaderSize + image.size();
  const std::string blank = Header(kSolutionSchema, version, length, std::string(kDigestSize, '0'));
  const std::string digest = Digest(blank, blank.rfind("sha256 ") + 7, image);
  return Header(kSolutionSchema, version, length, digest) + image;
}

StoredSolution DecodeSolution(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kLongestMessage = 200;  // [bytes]: the message may quote the file
  try {
    return Read(Open(bytes));
  } catch (const Hdf5Error& error) {
    throw ErrorAt(file, 0, Printable(error.what(), kLongestMessage));
  }
}

}  // namespace penumbra
