#include "tools/studio/library.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "io/files.h"
#include "io/template_file.h"
#include "io/text/quoted.h"
#include "io/text/read_file.h"
#include "tools/studio/error.h"
#include "tools/studio/image.h"
#include "tools/studio/paths.h"

namespace retarget::studio {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kMostText = 1 << 20;      // bytes of a template
constexpr uintmax_t kMostPicture = 16 << 20;  // of a photo or thumbnail
constexpr const char* kTemplate = "template.yaml";

[[noreturn]] void RefuseReadOnly(const std::string& id) {
  throw StudioError(409, fmt::format("{} is shipped and stays as it is; save it as another", id),
                    "read_only");
}

}  // namespace

StudioLibrary::StudioLibrary(const std::string& folder, const std::string& named) {
  const fs::path shipped = ShippedDataFolder();
  if (folder.empty()) {
    roots_ = {
        {UserTemplateFolder(), false}, {shipped / "templates", true}, {shipped / "holds", true}};
  } else {
    if (!fs::is_directory(folder)) throw InputError("--library " + folder + ": is no folder");
    roots_ = {{fs::canonical(folder), IsWithin(folder, shipped)}};
  }
  if (named.empty()) return;
  std::error_code error;
  const fs::path path = fs::canonical(named, error);
  if (error) throw InputError("--template " + named + ": cannot be opened");
  named_id_ = CheckedId(path.filename() == kTemplate ? path.parent_path().filename().string()
                                                     : path.stem().string());
  const std::optional<Place> known = Find(named_id_);
  if (known && fs::equivalent(known->path, path)) return;
  while (Find(named_id_)) named_id_ += " (named at start)";
  named_ = {path, IsWithin(path, shipped)};
}

std::string StudioLibrary::folder() const { return roots_[0].folder.string(); }

std::vector<fs::path> StudioLibrary::ClipFolders() const {
  std::vector<fs::path> folders;
  for (const Root& root : roots_) folders.push_back(root.folder);
  const fs::path shipped = ShippedDataFolder() / "holds";
  if (std::find(folders.begin(), folders.end(), shipped) == folders.end()) {
    folders.push_back(shipped);
  }
  return folders;
}

std::optional<StudioLibrary::Place> StudioLibrary::Find(const std::string& id) const {
  CheckedId(id);
  if (!named_.path.empty() && id == named_id_) return named_;
  for (const Root& root : roots_) {
    for (const fs::path& path : {root.folder / (id + ".yaml"), root.folder / id / kTemplate}) {
      if (IsFileWithin(path, root.folder)) return Place{path, root.read_only};
    }
  }
  return std::nullopt;
}

StudioLibrary::Place StudioLibrary::Existing(const std::string& id) const {
  const std::optional<Place> place = Find(id);
  if (!place) {
    throw StudioError(404, fmt::format("the library has no template \"{}\"", io::Printable(id)));
  }
  return *place;
}

LibraryFile StudioLibrary::ReadAt(const Place& place) const {
  LibraryFile file;
  file.text = ReadAtMost(place.path, kMostText);
  file.hash = io::HashOf(file.text);
  return file;
}

LibraryFile StudioLibrary::Read(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const Place place = Existing(id);
  LibraryFile file = ReadAt(place);
  const TemplatePosture posture = io::ParseTemplate(file.text, place.path.filename().string());
  if (!posture.photo || !IsPlainName(posture.photo->file)) return file;
  const fs::path photo = place.path.parent_path() / posture.photo->file;
  std::error_code error;
  if (!IsFileWithin(photo, place.path.parent_path())) return file;
  if (fs::file_size(photo, error) > kMostPicture || error) return file;
  std::string bytes = io::ReadFile(photo.string());
  if (ImageKindOf(bytes)) file.photo = std::move(bytes);
  return file;
}

std::string StudioLibrary::Thumbnail(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const fs::path path = Existing(id).path, picture = ThumbnailOf(path);
  if (IsFileWithin(picture, path.parent_path())) {
    std::string bytes = ReadAtMost(picture, kMostPicture);
    if (ImageKindOf(bytes)) return bytes;
  }
  throw StudioError(404, fmt::format("{} has no thumbnail", id));
}

void StudioLibrary::AddListed(const std::string& id, const Place& place, report::Json* list) {
  std::error_code error;
  const fs::file_time_type time = fs::last_write_time(place.path, error);
  const uintmax_t size = fs::file_size(place.path, error);
  const int64_t modified = time.time_since_epoch().count();
  Listed& known = listed_[place.path.string()];
  if (known.entry.is_null() || known.modified != modified || known.size != size) {
    known = {modified, size, {{"id", id}, {"name", id}, {"description", ""}}};
    known.entry["tags"] = report::Json::array();
    known.entry["read_only"] = place.read_only;
    known.entry["modified"] = fmt::format(
        "{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::file_clock::to_sys(
                                     std::chrono::time_point_cast<std::chrono::seconds>(time))));
    try {
      const TemplatePosture posture =
          io::ParseTemplate(ReadAt(place).text, place.path.filename().string());
      known.entry["name"] = posture.name;
      known.entry["description"] = posture.description;
      known.entry["tags"] = posture.keywords;
    } catch (const InputError& refusal) {
      known.entry["error"] = refusal.what();
    }
  }
  list->push_back(known.entry);
  list->back()["has_thumbnail"] = IsFileWithin(ThumbnailOf(place.path), place.path.parent_path());
}

report::Json StudioLibrary::List() {
  const std::lock_guard lock(mutex_);
  std::map<std::string, Place> found;
  if (!named_.path.empty()) found.emplace(named_id_, named_);
  for (const Root& root : roots_) {
    std::error_code error;
    for (const auto& item : fs::directory_iterator(root.folder, error)) {
      const bool folder = item.is_directory(error);
      const fs::path path = folder ? item.path() / kTemplate : item.path();
      const std::string id = item.path().stem().string();
      if (path.extension() != ".yaml" || !IsFileWithin(path, root.folder)) continue;
      if (!folder && !IsPlainName(id)) continue;
      found.emplace(folder ? item.path().filename().string() : id, Place{path, root.read_only});
    }
  }
  report::Json list = report::Json::array();
  for (const auto& [id, place] : found) AddListed(id, place, &list);
  std::stable_sort(list.begin(), list.end(), [](const report::Json& x, const report::Json& y) {
    return x["name"] < y["name"];
  });
  return list;
}

fs::path StudioLibrary::PlaceFor(const std::string& id) {
  const std::optional<Place> place = Find(id);
  if (place && place->read_only) RefuseReadOnly(id);
  if (place) return place->path;
  if (roots_[0].read_only) {
    throw StudioError(409, "the shipped library stays as it is; start with --library FOLDER",
                      "read_only");
  }
  return roots_[0].folder / (id + ".yaml");
}

std::string StudioLibrary::PhotoFile(const std::string& id, const std::string& extension) {
  const std::lock_guard lock(mutex_);
  return fmt::format("{}.photo.{}", PlaceFor(id).stem().string(), extension);
}

std::string StudioLibrary::WriteAll(const fs::path& path, const LibrarySave& save) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (!save.thumbnail.empty()) io::WriteFile(ThumbnailOf(path).string(), save.thumbnail, true);
  for (const fs::path& photo : PhotosOf(path)) {
    const bool ours = !save.photo.empty() && photo.extension() == "." + save.photo_extension;
    if (ours) {
      io::WriteFile(photo.string(), save.photo, true);
    } else {
      fs::remove(photo, error);
    }
  }
  io::WriteFile(path.string(), save.text, true);
  return io::HashOf(save.text);
}

std::string StudioLibrary::Save(const LibrarySave& save) {
  const std::lock_guard lock(mutex_);
  const fs::path path = PlaceFor(save.id);
  if (fs::exists(path) && !save.overwrite) {
    if (save.expected_hash.empty()) {
      throw StudioError(409, fmt::format("there is a template \"{}\" already", save.id), "exists");
    }
    if (ReadAt({path, false}).hash != save.expected_hash) {
      throw StudioError(409,
                        fmt::format("{} was changed elsewhere since it was opened here", save.id),
                        "changed");
    }
  }
  return WriteAll(path, save);
}

std::string StudioLibrary::Duplicate(const std::string& id, const std::string& as) {
  const LibraryFile file = Read(id);
  LibrarySave copy;
  copy.id = CheckedId(as);
  copy.text = file.text;
  if (!file.photo.empty()) {
    TemplatePosture posture = io::ParseTemplate(file.text, id);
    copy.photo = file.photo;
    copy.photo_extension = ImageKindOf(file.photo)->extension;
    posture.photo->file = PhotoFile(copy.id, copy.photo_extension);
    copy.text = io::FormatTemplate(posture);
  }
  try {
    copy.thumbnail = Thumbnail(id);
  } catch (const StudioError&) {  // it has none
  }
  Save(copy);
  return copy.id;
}

void StudioLibrary::Delete(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const Place place = Existing(id);
  if (place.read_only) RefuseReadOnly(id);
  std::error_code error;
  fs::remove(place.path, error);
  if (error) throw StudioError(500, fmt::format("{} cannot be deleted", id));
  fs::remove(ThumbnailOf(place.path), error);
  for (const fs::path& photo : PhotosOf(place.path)) fs::remove(photo, error);
  listed_.erase(place.path.string());
}

}  // namespace retarget::studio
