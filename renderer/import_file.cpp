#include "renderer/import_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>
#include <vector>

#include "core/error.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCommonFormats =
    "common ones are .glb, .gltf, .obj, .ply, .fbx, .dae, .stl, .3ds, .blend and .x3d";

std::string shown_size(std::uintmax_t bytes) {
  constexpr std::array<const char*, 4> units = {"bytes", "KiB", "MiB", "GiB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < units.size(); ++unit) value /= 1024;
  std::ostringstream out;
  out << std::setprecision(3) << value << ' ' << units[unit];
  return out.str();
}

/// The file of the same folder that was probably meant; empty when none is near.
std::string likely_name(const fs::path& missing) {
  constexpr std::size_t enough = 1000;
  const fs::path folder = missing.has_parent_path() ? missing.parent_path() : fs::path(".");
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    names.push_back(entry->path().filename().string());
    if (names.size() == enough) break;
  }
  return nearest_name(missing.filename().string(), names);
}

void check_exists(const std::string& file, const fs::file_status& status) {
  if (fs::exists(status)) return;
  const std::string likely = likely_name(file);
  throw Error({"no such file", file,
               likely.empty() ? "give the path of a model file" : "did you mean " + likely + "?"});
}

void check_kind(const std::string& file, const fs::file_status& status) {
  if (fs::is_directory(status))
    throw Error({"is a folder, not a model", file, "name the model file inside it"});
  if (!fs::is_regular_file(status))
    throw Error({"is a device or a pipe, not a file", file, "copy the model into a file first"});
}

void check_size(const std::string& file, std::uintmax_t max_bytes) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(file, error);
  if (error) throw Error({"its size is not known (" + error.message() + ")", file, ""});
  if (bytes == 0) throw Error({"the file is empty", file, "export or copy the model once more"});
  if (bytes > max_bytes)
    throw Error({"the file has " + shown_size(bytes) + ", the limit is " + shown_size(max_bytes),
                 file, "reduce the model or split it"});
}

void check_readable(const std::string& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || stream.get() == std::ifstream::traits_type::eof())
    throw Error({std::string("cannot be opened: ") + std::strerror(errno ? errno : EIO), file,
                 "check the permissions of the file and its folders"});
}

bool one_of(const std::string& extension, std::initializer_list<std::string_view> extensions) {
  return std::ranges::find(extensions, extension) != extensions.end();
}

void check_format(const std::string& file) {
  const std::string extension = lower_extension(file);
  if (one_of(extension, {".osg", ".osgt", ".osgb", ".osgx", ".ive"}))
    throw Error(
        {"OpenSceneGraph's own formats are not read", file,
         "convert it with OpenSceneGraph's tool: osgconv model" + extension + " model.obj"});
  if (extension.empty())
    throw Error({"the file name has no extension, so its format is not known", file,
                 std::string("name it after its format; ") + kCommonFormats});
  if (one_of(extension, {".png", ".jpg", ".jpeg", ".tga", ".bmp", ".gif", ".tif", ".tiff"}))
    throw Error(
        {"is a picture, not a model", file, std::string("give a model; ") + kCommonFormats});
  if (!Assimp::Importer().IsExtensionSupported(extension))
    throw Error({"models in the format " + extension + " are not read", file,
                 std::string("convert it; ") + kCommonFormats});
}

std::uintmax_t size_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t bytes = fs::is_regular_file(file, error) ? fs::file_size(file, error) : 0;
  return error ? 0 : bytes;
}

bool is_ply_type(const std::string& word) {
  return one_of(word, {"char", "uchar", "short", "ushort", "int", "uint", "float", "double", "int8",
                       "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"});
}

/// One line of a PLY header (Turk, "The PLY Polygon File Format", 1994) as it must be. Before the
/// first element, writers put all sorts of remarks.
bool good_ply_line(const std::string& line, std::uintmax_t file_bytes, bool in_elements) {
  std::istringstream words(line);
  std::string keyword, first, second, third;
  words >> keyword >> first >> second >> third;
  if (keyword == "element") {
    std::uintmax_t count = 0;
    return std::istringstream(second) >> count && count <= file_bytes;
  }
  if (keyword != "property") return !in_elements || one_of(keyword, {"", "comment", "obj_info"});
  if (first == "list") return in_elements && is_ply_type(second) && is_ply_type(third);
  return in_elements && is_ply_type(first) && !second.empty();
}

/// Assimp 5.2's PLY loader crashes or never ends where the header is damaged or cut off.
void check_ply_header(const std::string& file) {
  constexpr std::size_t enough_bytes = 1 << 20;
  const std::uintmax_t file_bytes = size_of(file);
  std::string head(std::min<std::uintmax_t>(file_bytes, enough_bytes), '\0');
  std::ifstream(file, std::ios::binary)
      .read(head.data(), static_cast<std::streamsize>(head.size()));
  std::istringstream stream(head);
  bool in_elements = false;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line == "end_header") return;
    in_elements = in_elements || line.starts_with("element");
    if (number == 1 ? line != "ply" : !good_ply_line(line, file_bytes, in_elements))
      throw Error({"line " + std::to_string(number) +
                       " of its header is damaged or claims more than the file holds",
                   file, "copy or export the model once more"});
  }
  throw Error({"its header has no end", file, "copy or export the model once more"});
}

constexpr std::uintmax_t kFixedPart = std::uintmax_t{2} << 30;
/// Compressed text (Collada in a .zae) grows most: ten times unpacked, twenty times as a tree.
constexpr std::uintmax_t kPerByte = 100;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCanLimit = false;
#else
constexpr bool kCanLimit = true;
#endif

/// The limit is one of the process.
std::mutex& budget_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Address space in use now (proc(5), statm).
std::uintmax_t process_bytes() {
  std::uintmax_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE));
}

/// proc(5), meminfo; the largest number where it is not known.
std::uintmax_t free_bytes() {
  std::ifstream meminfo("/proc/meminfo");
  std::string name;
  std::string unit;
  for (std::uintmax_t kibibytes = 0; meminfo >> name >> kibibytes; std::getline(meminfo, unit))
    if (name == "MemAvailable:") return kibibytes * 1024;
  return std::numeric_limits<std::uintmax_t>::max();
}

std::uintmax_t model_bytes(const std::string& model_file) {
  if (lower_extension(model_file) != ".gltf") return size_of(model_file);
  const fs::path folder = fs::path(model_file).parent_path();
  std::uintmax_t bytes = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end;
       !error && entry != end; entry.increment(error))
    bytes += size_of(entry->path());
  return bytes;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string lower_extension(const std::string& file) {
  return lower_case(fs::path(file).extension().string());
}

void check_model_file(const std::string& file, std::uintmax_t max_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  check_exists(file, status);
  check_kind(file, status);
  check_format(file);
  check_size(file, max_bytes);
  check_readable(file);
  if (lower_extension(file) == ".ply") check_ply_header(file);
}

MemoryBudget::MemoryBudget(std::uintmax_t bytes) : alone_(budget_mutex()) {
  if (!kCanLimit || getrlimit(RLIMIT_AS, &before_) != 0) return;
  rlimit limit = before_;
  limit.rlim_cur = std::min<rlim_t>(before_.rlim_cur, process_bytes() + bytes);
  lowered_ = setrlimit(RLIMIT_AS, &limit) == 0;
}

MemoryBudget::~MemoryBudget() {
  if (lowered_) setrlimit(RLIMIT_AS, &before_);
}

std::uintmax_t reading_budget_bytes(const std::string& model_file) {
  return std::min(kFixedPart + kPerByte * model_bytes(model_file), free_bytes());
}

}  // namespace vindu
