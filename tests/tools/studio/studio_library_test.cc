// The studio's library: what is saved is what is read, nothing shipped or of another page is lost,
// and nothing outside of its folder is touched.
#include <atomic>
#include <thread>

#include "io/template_file.h"
#include "io/text/base64.h"
#include "tests/tools/studio/studio_program.h"
#include "tools/studio/image.h"
#include "tools/studio/library.h"
#include "tools/studio/paths.h"

namespace retarget::studio {
namespace {

// The smallest of each kind that says what it is.
const std::string kPng = std::string("\x89PNG\r\n\x1a\n") + "not decoded";
const std::string kJpeg = "\xff\xd8\xff\xe0 not decoded";
const std::string kWebp = std::string("RIFF\1\2\3\4WEBPVP8 ", 16);

std::string Base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t k = 0; k < bytes.size(); k += 3) {
    uint32_t bits = 0;
    for (size_t j = 0; j < 3; ++j) {
      bits = bits << 8 | (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0);
    }
    for (size_t j = 0; j < 4; ++j) {
      text += k + j > bytes.size() ? '=' : digits[bits >> (18 - 6 * j) & 63];
    }
  }
  return text;
}

TEST(StudioImage, Base64) {
  // RFC 4648, section 10.
  const std::pair<const char*, const char*> known[] = {{"", ""},
                                                       {"Zg==", "f"},
                                                       {"Zm8=", "fo"},
                                                       {"Zm9v", "foo"},
                                                       {"Zm9vYg==", "foob"},
                                                       {"Zm9vYmE=", "fooba"},
                                                       {"Zm9vYmFy", "foobar"},
                                                       {"+/+/", "\xfb\xff\xbf"}};
  for (const auto& [text, bytes] : known) {
    EXPECT_EQ(io::DecodeBase64(text), bytes);
    EXPECT_EQ(Base64(bytes), text);
  }
  for (const char* bad : {"Z", "Zg", "Zg=", "Zm9v Zg==", "Z===", "====", "=m9v", "Zm=v", "Zm9-"}) {
    EXPECT_THROW(io::DecodeBase64(bad), InputError) << bad;
  }
}

TEST(StudioImage, KindsAreToldByContent) {
  EXPECT_STREQ(ImageKindOf(kPng)->type, "image/png");
  EXPECT_STREQ(ImageKindOf(kJpeg)->type, "image/jpeg");
  EXPECT_STREQ(ImageKindOf(kWebp)->type, "image/webp");
  for (const char* bad : {"", "RIFF", "<svg>", "GIF89a", "\x89PNG", "<!doctype html>"}) {
    EXPECT_FALSE(ImageKindOf(bad)) << bad;
  }
}

TEST(StudioLibrary, NamesStayInTheirFolder) {
  EXPECT_EQ(CheckedId("my choke.yaml"), "my choke");
  EXPECT_EQ(CheckedId("Würgegriff (2)"), "Würgegriff (2)");
  for (const std::string& bad :
       {std::string(), std::string("."), std::string(".."), std::string("../x"), std::string("a/b"),
        std::string("/etc/passwd"), std::string("a\\b"), std::string(".hidden"),
        std::string("a\nb"), std::string("a\0b", 3), std::string(200, 'x'), std::string(".yaml"),
        std::string("x "), std::string("x."), std::string("c:x")}) {
    EXPECT_THROW(CheckedId(bad), InputError) << bad;
  }
}

report::Json List(Studio* studio) {
  report::Json by_id = report::Json::object();
  const report::Json library = studio->Get("/api/library").json;
  for (const report::Json& entry : library["templates"]) {
    by_id[entry["id"].get<std::string>()] = entry;
  }
  return by_id;
}

TEST(StudioLibrary, WhatIsSavedIsWhatIsRead) {
  Studio studio;
  const std::string session = studio.Open();
  ASSERT_EQ(studio.Post("/api/load", {{"session", session}, {"template", "bear_hug"}}).status, 200);
  studio.Do(session, {{{"op", "set_name"}, {"name", "my hug"}},
                      {{"op", "set_tags"}, {"tags", {"soft", "mine"}}},
                      {{"op", "move_figure"}, {"figure", "a"}, {"shift", {0, 0, -0.01}}}});
  const std::string yaml = studio.Get("/api/yaml?session=" + session).body;
  const auto saved = studio.Post(
      "/api/save", {{"session", session}, {"as", "hug two"}, {"thumbnail", Base64(kPng)}});
  ASSERT_EQ(saved.status, 200) << saved.body;
  EXPECT_EQ(saved.json["id"], "hug two");
  EXPECT_EQ(saved.json["state"]["saved_as"], "hug two");
  EXPECT_EQ(saved.json["state"]["dirty"], false);
  const std::string folder = studio.Get("/api/library").json["folder"];
  EXPECT_EQ(ReadWholeFile(folder + "/hug two.yaml"), yaml);
  // `retarget --template` reads it with the same function.
  EXPECT_EQ(io::FormatTemplate(io::ReadTemplate(folder + "/hug two.yaml")), yaml);
  EXPECT_EQ(studio.Get("/api/library/thumbnail?id=hug%20two").body, kPng);
  const report::Json entry = List(&studio)["hug two"];
  EXPECT_EQ(entry["name"], "my hug");
  EXPECT_EQ(entry["tags"], report::Json({"soft", "mine"}));
  EXPECT_EQ(entry["read_only"], false);
  EXPECT_EQ(entry["has_thumbnail"], true);
  const Outcome check =
      RunProgram(studio.scratch, "template --check \"" + folder + "/hug two.yaml\"");
  EXPECT_TRUE(check.code == 0 || check.code == 3) << check.err;
  // Nothing but these two files was left.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 2);
}

TEST(StudioLibrary, TheShippedOnesStayAsTheyAre) {
  Studio studio;
  const std::string shipped = ReadWholeFile(kHold + "/template.yaml");
  const std::string session = studio.Open();
  ASSERT_TRUE(List(&studio)["bear_hug"]["read_only"]);
  studio.Post("/api/load", {{"session", session}, {"template", "bear_hug"}});
  studio.Do(session, {{{"op", "swap_figures"}}});
  for (const bool overwrite : {false, true}) {
    for (const report::Json& message :
         {report::Json{{"session", session}, {"overwrite", overwrite}},
          report::Json{{"session", session}, {"id", "bear_hug"}, {"overwrite", overwrite}},
          report::Json{{"session", session}, {"as", "bear_hug"}, {"overwrite", overwrite}}}) {
      const auto reply = studio.Post("/api/save", message);
      ExpectRefusal(reply, 409, "bear_hug");
      EXPECT_EQ(reply.json["reason"], "read_only");
    }
  }
  EXPECT_EQ(studio.Post("/api/delete", {{"id", "bear_hug"}}).json["reason"], "read_only");
  EXPECT_EQ(studio.Post("/api/duplicate", {{"id", "bear_hug"}, {"as", "bear_hug"}}).status, 409);
  EXPECT_EQ(ReadWholeFile(kHold + "/template.yaml"), shipped);
  ASSERT_EQ(studio.Post("/api/duplicate", {{"id", "bear_hug"}, {"as", "copy"}}).status, 200);
  const std::string folder = studio.Get("/api/library").json["folder"];
  EXPECT_EQ(ReadWholeFile(folder + "/copy.yaml"), shipped);
  EXPECT_EQ(studio.Post("/api/duplicate", {{"id", "bear_hug"}, {"as", "copy"}}).json["reason"],
            "exists");
  EXPECT_EQ(studio.Post("/api/delete", {{"id", "copy"}}).status, 200);
  EXPECT_FALSE(fs::exists(folder + "/copy.yaml"));
  ExpectRefusal(studio.Post("/api/delete", {{"id", "copy"}}), 404, "copy");
  // Also where its folder is named as the library.
  Studio inside({"--library", ProjectPath("data/holds")});
  const std::string other = inside.Open();
  EXPECT_EQ(inside.Post("/api/save", {{"session", other}, {"as", "new"}}).json["reason"],
            "read_only");
}

TEST(StudioLibrary, TwoPagesDoNotOverwriteEachOther) {
  Scratch folder;
  fs::copy_file(kHold + "/template.yaml", folder / "hug.yaml");
  Studio studio({"--library", folder / ""});
  const std::string one = studio.Open(), two = studio.Open();
  for (const std::string& session : {one, two}) {
    ASSERT_EQ(studio.Post("/api/load", {{"session", session}, {"template", "hug"}}).status, 200);
    studio.Do(session, {{{"op", "set_name"}, {"name", session}}});
  }
  EXPECT_EQ(studio.Post("/api/save", {{"session", one}}).status, 200);
  EXPECT_EQ(studio.Post("/api/save", {{"session", one}}).status, 200);  // its own is no conflict
  const auto refused = studio.Post("/api/save", {{"session", two}});
  ExpectRefusal(refused, 409, "changed");
  EXPECT_EQ(refused.json["reason"], "changed");
  EXPECT_EQ(io::ReadTemplate(folder / "hug.yaml").name, one);
  EXPECT_EQ(studio.Post("/api/save", {{"session", two}, {"overwrite", true}}).status, 200);
  EXPECT_EQ(io::ReadTemplate(folder / "hug.yaml").name, two);
  EXPECT_EQ(studio.Post("/api/save", {{"session", one}}).json["reason"], "changed");
  // An editor beside the studio counts as well.
  std::ofstream(folder / "hug.yaml", std::ios::app) << "# by hand\n";
  EXPECT_EQ(studio.Post("/api/save", {{"session", two}}).json["reason"], "changed");
  EXPECT_EQ(studio.Post("/api/save", {{"session", two}, {"as", "hug"}}).json["reason"], "changed");
  // A name that is taken asks, too.
  EXPECT_EQ(studio.Post("/api/save", {{"session", one}, {"as", "second"}}).status, 200);
  EXPECT_EQ(studio.Post("/api/save", {{"session", two}, {"as", "second"}}).json["reason"],
            "exists");
}

// Many saves at once: the file is one of them, whole.
TEST(StudioLibrary, SavesAtOnceLeaveOneWholeFile) {
  Scratch folder;
  Studio studio({"--library", folder / ""});
  std::vector<std::thread> pages;
  std::atomic<int> saved = 0;
  for (int k = 0; k < 6; ++k) {
    const std::string session = studio.Open();
    studio.Do(session, {{{"op", "set_name"}, {"name", "page " + std::to_string(k)}},
                        {{"op", "set_description"}, {"description", std::string(9000, 'a' + k)}}});
    pages.emplace_back([&studio, &saved, session] {
      httplib::Client client("127.0.0.1", studio.port);
      const report::Json message = {{"session", session}, {"as", "same"}, {"overwrite", true}};
      for (int n = 0; n < 10; ++n) {
        const auto result =
            client.Post("/api/save", studio.Token(), message.dump(), "application/json");
        saved += result && result->status == 200;
      }
    });
  }
  for (std::thread& page : pages) page.join();
  EXPECT_EQ(saved, 60);
  const TemplatePosture posture = io::ReadTemplate(folder / "same.yaml");
  EXPECT_EQ(posture.description, std::string(9000, 'a' + (posture.name.back() - '0')));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / ""), fs::directory_iterator{}), 1);
}

TEST(StudioLibrary, LinksOutAndForeignNamesAreNotFollowed) {
  Scratch outside, folder;
  const std::string secret = outside.Write("secret.yaml", ReadWholeFile(kHold + "/template.yaml"));
  outside.Write("secret.png", kPng);
  fs::create_symlink(secret, folder / "link.yaml");
  fs::create_directory_symlink(outside / "", folder / "way");
  fs::create_directory(folder / "inner");
  fs::create_symlink(secret, folder / "inner/template.yaml");
  fs::copy_file(kHold + "/template.yaml", folder / "real.yaml");
  fs::create_symlink(outside / "secret.png", folder / "real.png");
  folder.Write("broken.yaml", "format: 1\nname: [");
  fs::create_symlink(kHold + "/a.bvh", folder / "linked.bvh");
  Studio studio({"--library", folder / ""});
  const report::Json list = List(&studio);
  EXPECT_EQ(list.size(), 2u) << list.dump();
  EXPECT_TRUE(list.contains("real"));
  EXPECT_EQ(list["real"]["has_thumbnail"], false);
  EXPECT_TRUE(list["broken"].contains("error"));
  const std::string session = studio.Open();
  for (const char* id : {"link", "way", "way/secret", "inner", "../secret", "..", "/etc/passwd",
                         "real/../link", "%2e%2e/secret", ""}) {
    const auto reply = studio.Post("/api/load", {{"session", session}, {"template", id}});
    EXPECT_TRUE(reply.status == 400 || reply.status == 404) << id << reply.status;
    EXPECT_FALSE(studio.Get(std::string("/api/library/thumbnail?id=") + id).status == 200) << id;
    EXPECT_FALSE(studio.Post("/api/delete", {{"id", id}}).status == 200) << id;
  }
  EXPECT_EQ(studio.Get("/api/library/thumbnail?id=real").status, 404);
  for (const char* as : {"../out", "a/b", "..", ".x", "link/../y"}) {
    EXPECT_EQ(studio.Post("/api/save", {{"session", session}, {"as", as}}).status, 400) << as;
  }
  // Over a link: the link is replaced, not what it leads to.
  EXPECT_EQ(
      studio.Post("/api/save", {{"session", session}, {"as", "link"}, {"overwrite", true}}).status,
      200);
  EXPECT_EQ(ReadWholeFile(secret), ReadWholeFile(kHold + "/template.yaml"));
  EXPECT_FALSE(fs::is_symlink(folder / "link.yaml"));
  const report::Json clips = studio.Get("/api/clips").json;
  for (const report::Json& clip : clips["files"]) {
    EXPECT_NE(clip["id"], "linked.bvh");
  }
  EXPECT_FALSE(fs::exists(outside / "out.yaml"));
}

TEST(StudioLibrary, PhotosGoWithTheirTemplate) {
  Scratch folder;
  const std::string start = folder.Write("start.jpg", kJpeg);
  fs::create_directory(folder / "library");
  Studio studio({"--library", folder / "library", "--photo", start});
  const report::Json opened = studio.Post("/api/session", report::Json::object()).json;
  const std::string session = opened["session"], photo = "/api/photo?session=" + session;
  EXPECT_EQ(opened["start"]["photo"], true);
  EXPECT_EQ(studio.Get(photo).body, kJpeg);
  EXPECT_EQ(studio.client->Get(photo, studio.Token())->get_header_value("Content-Type"),
            "image/jpeg");
  ASSERT_EQ(studio.Post("/api/save", {{"session", session}, {"as", "posed"}}).status, 200);
  EXPECT_EQ(ReadWholeFile(folder / "library/posed.photo.jpg"), kJpeg);
  EXPECT_EQ(io::ReadTemplate(folder / "library/posed.yaml").photo->file, "posed.photo.jpg");

  // Another picture, taken back and done again.
  EXPECT_EQ(studio.PostBytes(photo, kPng).status, 200);
  EXPECT_EQ(studio.Get(photo).body, kPng);
  studio.Do(session, {{{"op", "undo"}}});
  EXPECT_EQ(studio.Get(photo).body, kJpeg);
  studio.Do(session, {{{"op", "redo"}}});
  ASSERT_EQ(studio.Post("/api/save", {{"session", session}}).status, 200);
  EXPECT_FALSE(fs::exists(folder / "library/posed.photo.jpg"));
  EXPECT_EQ(ReadWholeFile(folder / "library/posed.photo.png"), kPng);

  ASSERT_EQ(studio.Post("/api/duplicate", {{"id", "posed"}, {"as", "twin"}}).status, 200);
  EXPECT_EQ(io::ReadTemplate(folder / "library/twin.yaml").photo->file, "twin.photo.png");
  ASSERT_EQ(studio.Post("/api/delete", {{"id", "posed"}}).status, 200);
  const std::string other = studio.Open();
  ASSERT_EQ(studio.Post("/api/load", {{"session", other}, {"template", "twin"}}).status, 200);
  EXPECT_EQ(studio.Get("/api/photo?session=" + other).body, kPng);
  EXPECT_EQ(studio.Delete("/api/photo?session=" + other).status, 200);
  ExpectRefusal(studio.Get("/api/photo?session=" + other), 404, "photo");

  // A template that names a file elsewhere gets no picture from there.
  for (const std::string& name : {std::string("../start.jpg"), start}) {
    TemplatePosture posture = io::ReadTemplate(kHold + "/template.yaml");
    posture.photo = TemplatePhoto{name, 0.5, 1, Eigen::Vector2d::Zero()};
    std::ofstream(folder / "library/thief.yaml") << io::FormatTemplate(posture);
    studio.Post("/api/load", {{"session", other}, {"template", "thief"}});
    EXPECT_EQ(studio.Get("/api/photo?session=" + other).status, 404) << name;
    const auto saved = studio.Post("/api/save", {{"session", other}});
    EXPECT_TRUE(saved.json.contains("warning"));
  }
}

TEST(StudioLibrary, ATemplateFromElsewhereIsSavedWhereItIs) {
  Scratch elsewhere;
  fs::copy_file(kHold + "/template.yaml", elsewhere / "mine.yaml");
  Studio studio({"--template", elsewhere / "mine.yaml"});
  const std::string session = studio.Open();
  studio.Do(session, {{{"op", "set_name"}, {"name", "changed"}}});
  ASSERT_EQ(studio.Post("/api/save", {{"session", session}}).json["id"], "mine");
  EXPECT_EQ(io::ReadTemplate(elsewhere / "mine.yaml").name, "changed");
  EXPECT_TRUE(List(&studio).contains("mine"));
  // After an undo past a load, saving does not write into the other's file.
  studio.Post("/api/load", {{"session", session}, {"template", "bear_hug"}});
  studio.Do(session, {{{"op", "undo"}}});
  EXPECT_EQ(studio.Get("/api/state?session=" + session).json["state"]["saved_as"], "mine");
  EXPECT_EQ(studio.Get("/api/state?session=" + session).json["state"]["dirty"], false);
}

}  // namespace
}  // namespace retarget::studio
