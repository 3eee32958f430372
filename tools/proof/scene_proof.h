// The proof of a written scene, and what it says in words and as JSON.
#pragma once

#include <string>

#include "io/scene/scene_motion.h"
#include "solver/proof/proof.h"
#include "tools/report/report.h"

namespace retarget::proof {

using report::Json;

solver::Proof ProveScene(const io::SceneMotion& scene, const solver::MetricsContext& subject,
                         const Requirements& limits);

// "tangle 1", "foot drift a".
std::string NameOf(const solver::Statement& statement);

// "proved for all t: ...", or what is lost or not decided first: when, which limbs, which value.
std::string ProofSentence(const solver::Proof& proof, const solver::MetricsContext& subject);
// The same of one finding, without "not proved".
std::string FindingSentence(const solver::Proof& proof, const solver::Finding& finding,
                            const solver::MetricsContext& subject);

// `proof` of report.json: whether, the sentence, how much work, the findings, and the intervals
// (first key of each) in which something is not proved.
Json ProofJson(const solver::Proof& proof, const solver::MetricsContext& subject);
// kind, limit, the worst value met, and the bound where it is proved.
Json StatementsJson(const solver::Proof& proof);
Json FindingsJson(const solver::Proof& proof, const solver::MetricsContext& subject);

}  // namespace retarget::proof
