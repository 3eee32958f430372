/// The face of the library: two clips and a template in, a solved and verified scene out, all in
/// memory. `#include <retarget/retarget.h>`, link `retarget::retarget` (docs/api.md).
///
/// Nothing here prints, exits or keeps state between calls; several runs may go on at once in
/// different threads. Lengths are metres, angles radians, times seconds, Y is up.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/clip_options.h"
#include "io/named_bytes.h"
#include "io/settings_file.h"
#include "io/template_file.h"
#include "model/rig/rig.h"
#include "model/settings.h"
#include "solver/metrics/diagnosis.h"
#include "solver/proof/proof.h"
#include "solver/retarget.h"

namespace retarget {

/// Output frames [first, last), counted from where the clips start.
struct FrameRange {
  int first = 0, last = 0;
};

/// What the figures of scene.glb look like: capsules, or the clips' own glTF characters.
enum class Show { kFigures, kCharacters };

/// How the motion on a BVH clip's own rig begins: as it is, or with a T-pose before its first
/// frame, which tools that retarget by a rest pose take from there.
enum class Rest { kKeep, kTPose };

/// What is asked of a run.
/// What messages call the fields of a request: a program puts its own options here.
struct RequestWords {
  std::string frames = "Request::frames";
  std::string template_at = "Request::template_at";
  std::string show = "Request::show";
  std::string rest = "Request::rest";
  std::string also = "Request::also";
};

struct Request {
  /// Figure a and figure b: a path, or bytes with a name.
  std::array<io::ClipOptions, 2> clip;
  /// The template posture (YAML, docs/template_format.md): a path, or the text with a name.
  std::string template_path;
  std::string template_text = {};
  /// Defaults; io::ParseSettings and io::SetByName read the keys of `retarget config`.
  Settings settings = {};
  double fps = 30;
  /// Which frames are solved; none: as many as both clips have.
  std::optional<FrameRange> frames = {};
  /// The instant that is laid into the template, s from the clips' starts.
  double template_at = 0;
  Show show = Show::kFigures;
  /// Whether report.html is made (a few MB).
  bool page = true;
  Rest rest = Rest::kKeep;
  // Files of the scene beside the others: "npz", "csv" (docs/data_out.md).
  std::vector<std::string> also = {};
  RequestWords words = {};
};

/// How a run ended.
enum class Status { kSolved, kRequirementMissed, kLimitReached, kInterrupted };

/// 0, 3, 4 or 130.
int ExitCodeOf(Status status);

struct Result {
  Status status = Status::kSolved;

  /// Everything on the way: tangles, the scene, placements, the simulated baseline, the start, the
  /// iterations, costs by term, the solved motion.
  solver::RetargetResult run;
  /// Both figures' motions on the 20-segment body, one clip each, equal numbers of frames: the
  /// placed clips before editing, the forward simulation, and the solved scene.
  const std::array<Clip, 2>& source() const { return run.scene.source; }
  const std::array<Clip, 2>& baseline() const { return run.simulation.motion; }
  const std::array<Clip, 2>& solved() const { return run.solved; }

  /// Measured on what is written, frames and instants between them (docs/metrics.md).
  solver::Metrics source_metrics, baseline_metrics, metrics;
  /// What scene.glb keeps at every instant, not at sampled ones (docs/proof.md).
  solver::Proof proof;
  /// Every requirement with its value, limit, and place of the worst; judged by the proof.
  std::vector<solver::RequirementCheck> requirements;
  /// One for each requirement that is missed: what works against it there.
  std::vector<solver::Diagnosis> diagnoses;
  /// What a user should know: of the files, the template and the solve; a line each.
  std::vector<std::string> notes;

  /// The solved motion on each clip's own rig, in the file's units and axes, at the clip's own
  /// rate.
  std::array<RigMotion, 2> rig_motion;
  /// The files that the program writes: scene.glb, source.glb, baseline.glb, a.<ext>, b.<ext> with
  /// what belongs to them, report.json, report.html (Request::page), config.yaml, certificate.json,
  /// scene.npz, scene.csv (Request::also).
  std::vector<io::NamedBytes> files;
  /// The bytes of one of them; empty where there is none of this name.
  const std::string& File(const std::string& name) const;
};

/// Called after every iteration of the solve, in the thread that called Run; false stops it, and
/// the best so far is the result.
using Progress = solver::Progress;

/// Runs the whole way. Throws InputError where the request cannot be done: one line that says which
/// file, key or field, and what was expected.
Result Run(const Request& request, const Progress& progress = {});

/// What a requirement is called: "tangle 1", "foot drift a".
std::string RequirementName(const solver::RequirementCheck& requirement);
/// What is missed where, why, and which option of the program would help, in one sentence.
std::string DiagnosisText(const solver::Diagnosis& diagnosis, const Result& result);

/// "0.1.0"
const char* Version();

}  // namespace retarget
