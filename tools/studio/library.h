// The studio's templates: YAML files in folders, each with a thumbnail NAME.png and a photo beside
// it. Goes nowhere else: no "..", no links out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tools/report/report.h"

namespace retarget::studio {

struct LibraryFile {
  std::string text;   // YAML
  std::string hash;   // of the text
  std::string photo;  // bytes of the picture that it names; empty: none, or not there
};

struct LibrarySave {
  std::string id, text;
  std::string expected_hash;  // of the file as it was last seen; empty: a new file is meant
  bool overwrite = false;
  std::string thumbnail;               // PNG; empty: none
  std::string photo, photo_extension;  // bytes; empty: none
};

// All methods throw InputError, or StudioError 404 (no such template) and 409 (`reason` is
// "read_only", "exists" or "changed").
class StudioLibrary {
 public:
  // Templates of one folder and its subfolders' template.yaml. Without a folder: those that are
  // shipped, which are never written, and the user's own. `named`: one file more, from anywhere.
  StudioLibrary(const std::string& folder, const std::string& named);

  // [{id, name, description, tags, read_only, modified, has_thumbnail, error?}], by name.
  report::Json List();
  std::string folder() const;  // where new templates go; may not be there yet
  // Id of the file that was named at the start; empty without one.
  const std::string& named_id() const { return named_id_; }

  LibraryFile Read(const std::string& id);
  // How a template's photo is called beside it.
  std::string PhotoFile(const std::string& id, const std::string& extension);
  std::string Thumbnail(const std::string& id);  // bytes
  // Hash of what was written.
  std::string Save(const LibrarySave& save);
  std::string Duplicate(const std::string& id, const std::string& as);
  void Delete(const std::string& id);

  // Folders that clips may be taken from.
  std::vector<std::filesystem::path> ClipFolders() const;

  // No save is under way any more, nor will be.
  void Close() { mutex_.lock(); }

 private:
  struct Root {
    std::filesystem::path folder;
    bool read_only;
  };
  struct Place {
    std::filesystem::path path;
    bool read_only;
  };
  struct Listed {
    int64_t modified;
    uintmax_t size;
    report::Json entry;
  };

  std::optional<Place> Find(const std::string& id) const;
  Place Existing(const std::string& id) const;
  std::filesystem::path PlaceFor(const std::string& id);
  LibraryFile ReadAt(const Place& place) const;
  void AddListed(const std::string& id, const Place& place, report::Json* list);
  std::string WriteAll(const std::filesystem::path& path, const LibrarySave& save);

  std::vector<Root> roots_;  // earlier ones hide templates of later ones
  std::string named_id_;
  Place named_;
  std::map<std::string, Listed> listed_;
  std::mutex mutex_;
};

}  // namespace retarget::studio
