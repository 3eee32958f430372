#pragma once

namespace retarget::api {

extern const char* const kVersion;    // "0.1.0"
extern const char* const kGenerator;  // "retarget 0.1.0", in what is written

}  // namespace retarget::api
