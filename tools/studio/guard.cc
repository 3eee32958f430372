#include "tools/studio/guard.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <stdexcept>

#include "tools/studio/error.h"

namespace retarget::studio {
namespace {

// In a time that does not tell how much of it was right.
bool SameToken(const std::string& given, const std::string& token) {
  unsigned difference = given.size() != token.size();
  for (size_t k = 0; k < token.size(); ++k) {
    const unsigned char g = k < given.size() ? given[k] : 0;
    difference |= g ^ static_cast<unsigned char>(token[k]);
  }
  return difference == 0;
}

}  // namespace

std::string RandomToken() {
  std::array<unsigned char, 16> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the system gives no random numbers");
  }
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

void StudioGuard::Check(const RequestOrigin& request) const {
  const std::string local = fmt::format("127.0.0.1:{}", port_);
  const std::string named = fmt::format("localhost:{}", port_);
  if (request.host != local && request.host != named) {
    throw StudioError(403, "the studio answers requests to " + local + " only");
  }
  if (request.origin && *request.origin != "http://" + request.host) {
    throw StudioError(403, "the studio answers its own page only");
  }
  if (!SameToken(request.token, token_)) {
    throw StudioError(403, "open the address that `retarget studio` printed: its token is missing");
  }
}

void CheckMessageSize(size_t bytes) {
  if (bytes <= kMostJsonBytes) return;
  throw StudioError(
      413, fmt::format("the message has {} bytes, expected at most {}", bytes, kMostJsonBytes));
}

}  // namespace retarget::studio
