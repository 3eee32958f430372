// certificate.json: what was proved of a scene, for programs that were not there (docs/proof.md).
#pragma once

#include <string>
#include <vector>

#include "tools/proof/scene_proof.h"

namespace retarget::proof {

inline constexpr const char* kCertificate = "certificate.json";

// The text of the file: statement, tolerances, the scene's hash, version, topology, findings, and
// per key interval the halvings, the stretches and each statement's bound, rounded outward.
std::string FormatCertificate(const solver::Proof& proof, const solver::MetricsContext& subject,
                              const std::string& scene_glb, const std::string& generator);

// SHA-256 of what a proof is about: bodies, tags, holds, contacts.
std::string SubjectHash(const solver::MetricsContext& subject);

// The certificate of a run's folder. Throws InputError.
Json ReadCertificate(const std::string& folder);

// Whether the certificate of a run's folder holds, by an implementation that shares nothing with
// the one that made it but the reader of GLB files (solver/proof/advancement.h). A sentence for
// each thing that is wrong; none: it holds. Throws InputError where files are missing or damaged.
struct CertificateCheck {
  std::vector<std::string> wrong;
  long instants = 0;  // that were looked at
};
CertificateCheck CheckCertificate(const std::string& folder);

// What differs between the certificates of two runs, a line each.
std::vector<std::string> CertificateDiff(const Json& a, const Json& b);

}  // namespace retarget::proof
