// What the studio answers where it cannot do as asked; bad messages are InputErrors (400).
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace retarget::studio {

class StudioError : public std::runtime_error {
 public:
  StudioError(int status, const std::string& sentence, std::string why = "")
      : std::runtime_error(sentence), status_(status), reason_(std::move(why)) {}
  int status() const { return status_; }                 // of HTTP
  const std::string& reason() const { return reason_; }  // a word for the page, or empty

 private:
  int status_;
  std::string reason_;
};

}  // namespace retarget::studio
