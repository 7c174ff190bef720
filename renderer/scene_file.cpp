#include "renderer/scene_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>

#include "core/error.h"
#include "core/new_file.h"
#include "renderer/scene_archive.h"

namespace vindu {
namespace {

constexpr std::array<char, 8> kMagic = {'V', 'S', 'C', 'E', 'N', 'E', '\r', '\n'};
/// To be raised with any change of what scene_archive.h describes, and where packing makes
/// something better of the same model: what is in a cache is then packed anew.
constexpr std::uint32_t kFormat = 4;

struct Header {
  std::array<char, 8> magic{};
  std::uint32_t format = 0;
  std::uint32_t unused = 0;
  std::uint64_t content_bytes = 0;
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Header) % kAlignment == 0);

/// Notices damage, not malice: eight bytes at a time, mixed as in FNV-1a.
std::uint64_t checksum_of(std::span<const std::uint8_t> bytes) {
  constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  std::uint64_t sum = 0xcbf29ce484222325ULL;
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), 8);
    sum = std::rotl((sum ^ word) * kPrime, 29);
  }
  for (const std::uint8_t byte : bytes) sum = (sum ^ byte) * kPrime;
  return sum;
}

/// A file's bytes, mapped into memory while it lives: processes that show the same scene share
/// them.
class MappedFile {
 public:
  explicit MappedFile(const std::string& file) {
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw Error({"cannot be opened", file, "pack the model: vindu pack MODEL"});
    struct stat status {};
    if (fstat(descriptor, &status) == 0 && status.st_size > 0) {
      size_ = static_cast<std::size_t>(status.st_size);
      data_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE | MAP_POPULATE, descriptor, 0);
    }
    close(descriptor);
    if (data_ == MAP_FAILED) size_ = 0;
  }
  ~MappedFile() {
    if (size_ > 0) munmap(data_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::uint8_t> bytes() const {
    return {static_cast<const std::uint8_t*>(data_), size_};
  }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

[[noreturn]] void refuse(const std::string& what, const std::string& file) {
  throw Error({what, file, "pack the model again: vindu pack MODEL --out FILE"});
}

/// The content, after what stands before it.
std::span<const std::uint8_t> checked_content(std::span<const std::uint8_t> bytes,
                                              const std::string& file) {
  Header header;
  if (bytes.size() < sizeof(Header)) refuse("is no packed scene", file);
  std::memcpy(&header, bytes.data(), sizeof(Header));
  const auto content = bytes.subspan(sizeof(Header));
  if (header.magic != kMagic) refuse("is no packed scene", file);
  if (header.format != kFormat || header.unused != 0)
    refuse("was packed by another version of Vindu", file);
  if (header.content_bytes != content.size() || header.checksum != checksum_of(content))
    refuse("is damaged or cut off", file);
  return content;
}

}  // namespace

void write_scene_file(const PackedScene& packed, const std::string& file) {
  SceneWriter writer;
  writer(packed);
  const std::vector<std::uint8_t> content = writer.take();
  const Header header{kMagic, kFormat, 0, content.size(), checksum_of(content)};
  const std::string remedy = "see whether the disk is full, or choose another --out";
  NewFile fresh(file, unfinished_scene_file(file, getpid()));
  std::ofstream stream(fresh.beside(), std::ios::binary);
  stream.write(reinterpret_cast<const char*>(&header), sizeof(Header));
  stream.write(reinterpret_cast<const char*>(content.data()),
               static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) throw Error({"cannot be written", file, remedy});
  fresh.place(remedy);
}

PackedScene read_scene_file(const std::string& file) {
  const auto mapped = std::make_shared<const MappedFile>(file);
  PackedScene packed = scene_from(checked_content(mapped->bytes(), file), file);
  packed.memory = mapped;
  return packed;
}

PackedScene scene_from(std::span<const std::uint8_t> content, const std::string& file) {
  SceneReader reader(content);
  PackedScene packed;
  reader(packed);
  if (!reader.good() || !reader.at_end()) refuse("is damaged or cut off", file);
  if (const std::string fault = fault_of(packed); !fault.empty())
    refuse("is damaged (" + fault + ")", file);
  return packed;
}

}  // namespace vindu
