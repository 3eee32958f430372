// `retarget certificate check DIR` and `retarget certificate diff A B`.
#include "tools/proof/certificate.h"

#include <fmt/format.h>

#include "tools/cli/commands.h"

namespace retarget::cli {

int RunCertificateCheck(const std::string& folder, bool json) {
  const proof::CertificateCheck check = proof::CheckCertificate(folder);
  const bool holds = check.wrong.empty();
  if (json) {
    const report::Json out = {
        {"holds", holds}, {"instants", check.instants}, {"wrong", check.wrong}};
    fmt::print("{}\n", out.dump(1));
    return holds ? kDone : kMissed;
  }
  for (const std::string& line : check.wrong) fmt::print("WRONG {}\n", line);
  fmt::print("{} ({} instants looked at)\n",
             holds ? "the certificate holds" : "the certificate does NOT hold", check.instants);
  return holds ? kDone : kMissed;
}

int RunCertificateDiff(const std::array<std::string, 2>& folders) {
  const std::vector<std::string> lines = proof::CertificateDiff(proof::ReadCertificate(folders[0]),
                                                                proof::ReadCertificate(folders[1]));
  for (const std::string& line : lines) fmt::print("{}\n", line);
  if (lines.empty()) fmt::print("both certify the same\n");
  return kDone;
}

}  // namespace retarget::cli
