#pragma once

namespace retarget::api {
inline constexpr const char* kVersion = RETARGET_VERSION;
inline constexpr const char* kGenerator = "retarget " RETARGET_VERSION;
}  // namespace retarget::api
