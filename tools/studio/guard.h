// Who may speak to the studio: pages that it served itself, on this machine.
#pragma once

#include <optional>
#include <string>

namespace retarget::studio {

// 32 hexadecimal digits of the system's randomness.
std::string RandomToken();

// What a request says of where it comes from.
struct RequestOrigin {
  std::string host;                   // header Host
  std::optional<std::string> origin;  // header Origin
  std::string token;                  // as the header or the URL has it
};

class StudioGuard {
 public:
  explicit StudioGuard(std::string token) : token_(std::move(token)) {}
  void set_port(int port) { port_ = port; }
  const std::string& token() const { return token_; }

  // Throws StudioError (403): another host's name (a page of the net whose name leads here), an
  // origin of another page, a token that is missing or wrong.
  void Check(const RequestOrigin& request) const;

 private:
  std::string token_;
  int port_ = 0;
};

inline constexpr size_t kMostBytes = 16 << 20;     // of any body
inline constexpr size_t kMostJsonBytes = 1 << 20;  // of a message

// Throws StudioError (413).
void CheckMessageSize(size_t bytes);

}  // namespace retarget::studio
