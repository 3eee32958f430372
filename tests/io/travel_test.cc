// The way of clips that stride in place, against clips whose way is known: it is taken away, and
// must come back.
#include "model/body/travel.h"

#include <gtest/gtest.h>

#include "io/load_clip.h"
#include "tests/test_data.h"

namespace retarget {
namespace {

Clip ClipOf(const io::LoadedClip& loaded) {
  const double fps = 1 / loaded.file.motion.frame_time;
  return loaded.Resampled(fps, 0, loaded.file.motion.num_frames());
}

io::LoadedClip Load(const std::string& path) {
  io::ClipOptions options;
  options.path = path;
  return io::LoadClip(options);
}

TEST(Travel, AWalkOnTheSpotGetsItsWayBack) {
  const io::LoadedClip loaded = Load(ProjectPath("data/holds/supported_walk/b.bvh"));
  const Clip walk = ClipOf(loaded);
  EXPECT_FALSE(FindTravel(loaded.body, walk, {}).clear()) << "it has its own";
  Clip on_the_spot = walk;
  // A treadmill takes away the mean way; the sway about it stays.
  const Vec3 way = walk.frames.back().root_position - walk.frames[0].root_position;
  const int last = walk.num_frames() - 1;
  for (int t = 0; t <= last; ++t) {
    on_the_spot.frames[t].root_position -= Vec3(way.x(), 0, way.z()) * t / last;
  }
  const Travel travel = FindTravel(loaded.body, on_the_spot, {});
  ASSERT_TRUE(travel.clear());
  for (int t = 0; t <= last; ++t) {
    const Vec3 expected = Vec3(way.x(), 0, way.z()) * t / last;
    EXPECT_LT((travel.offset[t] - expected).norm(), 0.01 * way.norm()) << "frame " << t;
  }
}

TEST(Travel, ClipsThatStandOrWalkKeepTheirOwn) {
  for (const char* clip :
       {"hug/a.bvh", "hug/b.bvh", "bear_hug/a.bvh", "full_nelson/b.bvh", "fireman_carry/a.bvh",
        "fireman_carry/b.bvh", "rear_choke/a.bvh", "octopus_hold/a.bvh", "piggyback/b.bvh"}) {
    const io::LoadedClip loaded = Load(ProjectPath("data/holds/") + clip);
    EXPECT_FALSE(FindTravel(loaded.body, ClipOf(loaded), {}).clear()) << clip;
  }
}

TEST(Travel, AGaitInPlaceIsTheTravellingOne) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string folder = SharedPath("data/faults/23_in_place_walk/");
  const io::LoadedClip recovered = Load(folder + "in_place.bvh");
  const io::LoadedClip right = Load(folder + "travelling.bvh");
  const Clip is = ClipOf(recovered), should = ClipOf(right);
  ASSERT_EQ(is.num_frames(), should.num_frames());
  for (int t = 0; t < is.num_frames(); ++t) {
    const Vec3 moved = is.frames[t].root_position - is.frames[0].root_position;
    const Vec3 expected = should.frames[t].root_position - should.frames[0].root_position;
    EXPECT_LT((moved - expected).norm(), 0.02) << "frame " << t;
  }
  EXPECT_TRUE(std::any_of(
      recovered.facts.notes.begin(), recovered.facts.notes.end(),
      [](const std::string& note) { return note.find("walks in place") != std::string::npos; }));
  io::ClipOptions keep;
  keep.path = folder + "in_place.bvh";
  keep.keep_in_place = true;
  const Clip kept = ClipOf(io::LoadClip(keep));
  EXPECT_LT((kept.frames.back().root_position - kept.frames[0].root_position).norm(), 0.1);
}

TEST(Travel, RealClipsThatTravelKeepTheirOwn) {
  SKIP_WITHOUT_SHARED_DATA();
  int clips = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SharedPath("data/clips"))) {
    if (entry.path().extension() != ".bvh") continue;
    const io::LoadedClip loaded = Load(entry.path());
    EXPECT_FALSE(FindTravel(loaded.body, ClipOf(loaded), {}).clear()) << entry.path();
    ++clips;
  }
  EXPECT_GT(clips, 5);
}

}  // namespace
}  // namespace retarget
