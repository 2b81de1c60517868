#include "mesh/pipeline/hdf5_image.h"

#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <new>
#include <utility>

#include "solver/base/check.h"

namespace penumbra {
namespace {

constexpr std::size_t kGrowth = std::size_t{1} << 20;  // step by which the image in memory grows [bytes]
constexpr std::size_t kChunk = std::size_t{1} << 20;   // unit of compression [bytes]
constexpr std::size_t kWorthCompressing = std::size_t{1} << 12;  // [bytes]
// For an office of 13,551 triangles: 3.41 MB without compression, 1.60 MB in 0.04 s at level 1, 1.57 MB at
// level 6, 1.56 MB in 0.25 s at level 9.
constexpr unsigned kDeflateLevel = 1;

// Every call of the library must hold this lock, because the library serves one thread at a time.
std::unique_lock<std::recursive_mutex> HoldLibrary() {
  static std::recursive_mutex library;
  return std::unique_lock(library);
}

// A new name for a file in memory. Files with equal names would be shared. REQUIRES: the caller holds the
// lock of the library.
std::string NewName() {
  static std::uint64_t count = 0;
  return "solution " + std::to_string(count++);
}

// True if the library's last failure was a failed allocation.
bool MemoryEnded() {
  bool ended = false;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_DOWNWARD,
      [](unsigned, const H5E_error2_t* error, void* found) {
        if (error->maj_num == H5E_RESOURCE &&
            (error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC))
          *static_cast<bool*>(found) = true;
        return herr_t{0};
      },
      &ended);
  return ended;
}

// Throws std::bad_alloc after a failed allocation, otherwise Hdf5Error.
[[noreturn]] void FailOver(const std::string& what) {
  if (MemoryEnded()) throw std::bad_alloc();
  throw Hdf5Error(what);
}

// An identifier of the library, closed at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id_ < 0) FailOver(what);
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, hid_t{-1})), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

  void Close(const std::string& what) {
    if (close_(std::exchange(id_, hid_t{-1})) < 0) FailOver(what);
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void Succeed(herr_t status, const std::string& what) {
  if (status < 0) FailOver(what);
}

// Stops the library from printing errors, which is its default.
void Silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

hid_t FileType(ScalarType type) {
  switch (type) {
    case ScalarType::kUint8:
      return H5T_STD_U8LE;
    case ScalarType::kInt32:
      return H5T_STD_I32LE;
    case ScalarType::kUint32:
      return H5T_STD_U32LE;
    case ScalarType::kUint64:
      return H5T_STD_U64LE;
    case ScalarType::kFloat:
      return H5T_IEEE_F32LE;
    case ScalarType::kDouble:
      return H5T_IEEE_F64LE;
  }
  return H5I_INVALID_HID;
}

hid_t MemoryType(ScalarType type) {
  switch (type) {
    case ScalarType::kUint8:
      return H5T_NATIVE_UINT8;
    case ScalarType::kInt32:
      return H5T_NATIVE_INT32;
    case ScalarType::kUint32:
      return H5T_NATIVE_UINT32;
    case ScalarType::kUint64:
      return H5T_NATIVE_UINT64;
    case ScalarType::kFloat:
      return H5T_NATIVE_FLOAT;
    case ScalarType::kDouble:
      return H5T_NATIVE_DOUBLE;
  }
  return H5I_INVALID_HID;
}

// Properties of files that exist in memory only.
Handle MemoryAccess() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "no property list");
  Succeed(H5Pset_fapl_core(access, kGrowth, 0), "no file in memory");
  // The oldest format: newer formats have checksums, which H5Fget_file_image() makes invalid.
  Succeed(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), "no such version of the format");
  return access;
}

Handle WithoutTimes(hid_t kind) {
  Handle creation(H5Pcreate(kind), H5Pclose, "no property list");
  Succeed(H5Pset_obj_track_times(creation, false), "times cannot be left out");
  return creation;
}

// The type of UTF-8 texts of any length. REQUIRES: the caller holds the lock of the library.
Handle TextOfAnyLength(const std::string& what) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, what);
  Succeed(H5Tset_size(type, H5T_VARIABLE), what);
  Succeed(H5Tset_cset(type, H5T_CSET_UTF8), what);
  return type;
}

}  // namespace

struct Hdf5Writer::Impl {
  Handle file;
  Handle links;  // creates paths with all groups on the way

  void MakeGroups(const std::string& path) const {
    for (std::size_t at = path.find('/'); at != path.npos; at = path.find('/', at + 1)) {
      const std::string group = path.substr(0, at);
      if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
      const Handle creation = WithoutTimes(H5P_GROUP_CREATE);
      const Handle made(H5Gcreate2(file, group.c_str(), links, creation, H5P_DEFAULT), H5Gclose, group);
    }
  }

  void Write(const std::string& path, hid_t file_type, hid_t memory_type, hid_t space, hid_t creation,
             const void* data) const {
    MakeGroups(path);
    const Handle set(H5Dcreate2(file, path.c_str(), file_type, space, links, creation, H5P_DEFAULT), H5Dclose,
                     path);
    if (data) Succeed(H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), path);
  }
};

Hdf5Writer::Hdf5Writer() {
  const auto held = HoldLibrary();
  Silence();
  const Handle access = MemoryAccess(), creation = WithoutTimes(H5P_FILE_CREATE);
  impl_.reset(new Impl{
      Handle(H5Fcreate(NewName().c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "no file in memory"),
      Handle(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "no property list")});
}

Hdf5Writer::~Hdf5Writer() {
  const auto held = HoldLibrary();
  impl_.reset();
}

void Hdf5Writer::Write(const std::string& path, ScalarType type, const ArrayShape& shape, const void* data) {
  PENUMBRA_CHECK(!shape.empty());
  const auto held = HoldLibrary();
  std::vector<hsize_t> extent(shape.begin(), shape.end());
  std::size_t row = H5Tget_size(FileType(type));
  for (std::size_t i = 1; i < shape.size(); ++i) row *= shape[i];
  const Handle space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose,
                     path);
  const Handle creation = WithoutTimes(H5P_DATASET_CREATE);
  if (row * shape[0] >= kWorthCompressing) {
    std::vector<hsize_t> chunk = extent;
    chunk[0] = std::min<hsize_t>(extent[0], std::max<std::size_t>(1, kChunk / row));
    Succeed(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), path);
    Succeed(H5Pset_shuffle(creation), path);
    Succeed(H5Pset_deflate(creation, kDeflateLevel), path);
  }
  impl_->Write(path, FileType(type), MemoryType(type), space, creation, row * shape[0] > 0 ? data : nullptr);
}

void Hdf5Writer::WriteText(const std::string& path, const std::string& text) {
  const auto held = HoldLibrary();
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, path);
  Succeed(H5Tset_size(type, std::max<std::size_t>(1, text.size())), path);
  Succeed(H5Tset_strpad(type, H5T_STR_NULLPAD), path);
  Succeed(H5Tset_cset(type, H5T_CSET_UTF8), path);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, path);
  impl_->Write(path, type, type, space, WithoutTimes(H5P_DATASET_CREATE), text.c_str());
}

void Hdf5Writer::WriteStrings(const std::string& path, const std::vector<std::string>& texts) {
  const auto held = HoldLibrary();
  const Handle type = TextOfAnyLength(path);
  const hsize_t count = texts.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, path);
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  impl_->Write(path, type, type, space, WithoutTimes(H5P_DATASET_CREATE),
               texts.empty() ? nullptr : pointers.data());
}

void Hdf5Writer::WriteAttribute(const std::string& path, const std::string& name, const std::string& text) {
  const auto held = HoldLibrary();
  const Handle type = TextOfAnyLength(name);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Handle attribute(H5Acreate_by_name(impl_->file, path.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, name);
  const char* pointer = text.c_str();
  Succeed(H5Awrite(attribute, type, &pointer), name);
}

std::string Hdf5Writer::Finish() {
  const auto held = HoldLibrary();
  Succeed(H5Fflush(impl_->file, H5F_SCOPE_GLOBAL), "the file in memory cannot be finished");
  const ssize_t size = H5Fget_file_image(impl_->file, nullptr, 0);
  if (size < 0) throw Hdf5Error("the file in memory cannot be taken");
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(impl_->file, image.data(), image.size()) != size)
    throw Hdf5Error("the file in memory cannot be taken");
  impl_.reset();
  return image;
}

struct Hdf5Reader::Impl {
  Handle file;
  std::size_t size;  // size of the image [bytes]

  Handle Open(const std::string& path) const {
    return Handle(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, path + " is missing");
  }
};

Hdf5Reader::Hdf5Reader(std::string_view image) {
  const auto held = HoldLibrary();
  Silence();
  const Handle access = MemoryAccess();
  // The library copies the image and does not change it.
  Succeed(H5Pset_file_image(access, const_cast<char*>(image.data()), image.size()), "it cannot be read");
  impl_.reset(
      new Impl{Handle(H5Fopen(NewName().c_str(), H5F_ACC_RDONLY, access), H5Fclose, "it is no HDF5 file"),
               image.size()});
}

Hdf5Reader::~Hdf5Reader() {
  const auto held = HoldLibrary();
  impl_.reset();
}

ArrayShape Hdf5Reader::Shape(const std::string& path) const {
  const auto held = HoldLibrary();
  const Handle set = impl_->Open(path);
  const Handle space(H5Dget_space(set), H5Sclose, path);
  const int dimensions = H5Sget_simple_extent_ndims(space);
  if (dimensions < 0) throw Hdf5Error(path + " has no shape");
  std::vector<hsize_t> extent(static_cast<std::size_t>(dimensions));
  if (dimensions > 0 && H5Sget_simple_extent_dims(space, extent.data(), nullptr) != dimensions)
    throw Hdf5Error(path + " has no shape");
  // Prevents the allocation of rows that the file cannot contain.
  constexpr double kMostDeflated = 1100;  // upper bound of bytes per compressed byte; deflate reaches 1032
  double bytes = static_cast<double>(H5Tget_size(Handle(H5Dget_type(set), H5Tclose, path)));
  // Rows without values would take no place in the file, but they do in memory.
  const bool has_rows = !extent.empty() && extent[0] > 0;
  for (const hsize_t n : extent) bytes *= static_cast<double>(has_rows ? std::max<hsize_t>(n, 1) : n);
  const double stored = static_cast<double>(std::min<hsize_t>(H5Dget_storage_size(set), impl_->size));
  if (bytes > kMostDeflated * stored) throw Hdf5Error(path + " is larger than the file can hold");
  return {extent.begin(), extent.end()};
}

void Hdf5Reader::Read(const std::string& path, ScalarType type, const ArrayShape& shape, void* data) const {
  const auto held = HoldLibrary();
  if (Shape(path) != shape) throw Hdf5Error(path + " has another shape");
  const Handle set = impl_->Open(path);
  const Handle stored(H5Dget_type(set), H5Tclose, path);
  if (H5Tequal(stored, FileType(type)) <= 0) throw Hdf5Error(path + " holds another type");
  if (std::count(shape.begin(), shape.end(), 0U) > 0) return;
  Succeed(H5Dread(set, MemoryType(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data), path + " cannot be read");
}

std::string Hdf5Reader::ReadText(const std::string& path) const {
  const auto held = HoldLibrary();
  const Handle set = impl_->Open(path);
  const Handle type(H5Dget_type(set), H5Tclose, path);
  if (!Shape(path).empty() || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
    throw Hdf5Error(path + " is no text");
  if (H5Tget_size(type) > impl_->size) throw Hdf5Error(path + " is longer than the file");
  std::string text(H5Tget_size(type), '\0');
  Succeed(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), path + " cannot be read");
  text.erase(text.find_last_not_of('\0') + 1);
  return text;
}

}  // namespace penumbra
